//! Uncertain keys that are usual, by one word each.
//!
//! | word | stands for |
//! |---|---|
//! | `coefficient` | the wear coefficient of the law, `lognormal:1.5`: repeated twin-disc and gear tests scatter by ±40 to 60 % |
//! | `coefficient:REGIME` | the same within the range of a regime ([`gearwear_physics::wear::coefficient_range`]) |
//! | `torque` | `operation.pinion_torque_Nm=±5%`, of a stage `operation.torque_Nm` |
//! | `class:N` | slopes of both gears' profiles, and of their helices where the pair has slices, normal about the scene's own values; flank tolerance class N of ISO 1328-1 lies at three standard deviations |

use super::distribution::UncertainError;
use crate::scene::draft::Draft;
use crate::scene::loaded::LoadedScene;
use crate::scene::opened::OpenedScene;
use crate::scene::planetary::mesh::StageMesh;
use gearwear_bodies::gear::{Gear, tolerance};
use gearwear_bodies::reference::statistics::HALF_WIDTH_95;
use gearwear_physics::wear::coefficient_range::CoefficientRange;

/// Tolerance over standard deviation: a capability index of 1.
const TOLERANCE_IN_DEVIATIONS: f64 = 3.0;
/// Key of the wear coefficient in a table of a law.
const COEFFICIENT: &str = "coefficient_m2_per_N";
/// The same in mm³/(N·m).
const COEFFICIENT_IN_MM3: &str = "coefficient_mm3_per_Nm";

/// The keys that `given` stands for, where it is one of the words; otherwise itself. `own` is the scene's own value of a key.
pub(super) fn expanded(
    given: &str,
    scene: &OpenedScene,
    own: impl Fn(&str) -> Option<f64>,
) -> Result<Vec<String>, UncertainError> {
    match given.trim() {
        "coefficient" => Ok(coefficients("lognormal:1.5", scene, own)),
        "torque" if scene.kind().is_pair() => Ok(vec!["operation.pinion_torque_Nm=±5%".to_owned()]),
        "torque" => Ok(vec!["operation.torque_Nm=±5%".to_owned()]),
        word => match (word.strip_prefix("class:"), word.strip_prefix("coefficient:")) {
            (Some(class), _) => of_class(class, scene, own),
            (None, Some(regime)) => of_regime(regime, scene, own),
            (None, None) => Ok(vec![given.to_owned()]),
        },
    }
}

/// Wear coefficients within the range of a regime.
fn of_regime(
    regime: &str,
    scene: &OpenedScene,
    own: impl Fn(&str) -> Option<f64>,
) -> Result<Vec<String>, UncertainError> {
    let range = CoefficientRange::named(regime);
    let CoefficientRange { range_m2_per_n: [low, high], .. } =
        range.ok_or_else(|| UncertainError::Regime { found: regime.trim().to_owned() })?;
    let factor = (high / low).powf(0.5 / HALF_WIDTH_95);
    Ok(coefficients(&format!("lognormal:{:e}:{factor}", (low * high).sqrt()), scene, own))
}

/// Wear coefficients of the scene with a distribution; one for both gears where they have the same.
fn coefficients(distribution: &str, scene: &OpenedScene, own: impl Fn(&str) -> Option<f64>) -> Vec<String> {
    if !scene.kind().is_pair() {
        return coefficients_of_stage(distribution, scene);
    }
    let with = |key: String| format!("{key}={distribution}");
    let of_gears = ["pinion", "wheel"].map(|gear| format!("wear.{gear}.{COEFFICIENT}"));
    match of_gears.each_ref().map(|key| own(key)) {
        [Some(pinion), Some(wheel)] if pinion == wheel => vec![with(format!("wear.{{pinion,wheel}}.{COEFFICIENT}"))],
        [None, None] => vec![with(format!("wear.{COEFFICIENT}"))],
        found => {
            let given = of_gears.into_iter().zip(found).filter(|(_, value)| value.is_some_and(|k| k > 0.0));
            given.map(|(key, _)| with(key)).collect()
        }
    }
}

/// Wear coefficients that the file of a stage gives, of all gears, of one, or of a mesh, each with the distribution.
fn coefficients_of_stage(distribution: &str, scene: &OpenedScene) -> Vec<String> {
    let keys = Draft::parse(&scene.given().text).map_or_else(|_| Vec::new(), |draft| draft.keys());
    let is_of_law = |key: &String| {
        let mut tables = key.split('.').rev().skip(1);
        let is_coefficient = key.ends_with(COEFFICIENT) || key.ends_with(COEFFICIENT_IN_MM3);
        is_coefficient && tables.any(|table| table == "wear")
    };
    keys.into_iter().filter(is_of_law).map(|key| format!("{key}={distribution}")).collect()
}

/// Deviations of a flank tolerance class.
fn of_class(
    class: &str,
    scene: &OpenedScene,
    own: impl Fn(&str) -> Option<f64>,
) -> Result<Vec<String>, UncertainError> {
    let number: Option<u32> = class.trim().parse().ok().filter(|class| tolerance::CLASSES.contains(class));
    let number = number.ok_or_else(|| UncertainError::Class { found: class.trim().to_owned() })?;
    let mut keys = Vec::new();
    for (key_of_gear, pair, gear) in gears(scene) {
        let spec = &pair.scene().pair;
        let diameter_mm = 2.0 * spec.reference_radius_mm(gear).abs();
        let profile_um = tolerance::profile_slope_um(number, spec.normal_module_mm, diameter_mm);
        let helix_um = tolerance::helix_slope_um(number, diameter_mm, spec.face_width_mm);
        let mut add = |name: &str, tolerance_um: f64| {
            let key = format!("{key_of_gear}.{name}");
            let (mean, deviation) = (own(&key).unwrap_or(0.0), tolerance_um / TOLERANCE_IN_DEVIATIONS);
            keys.push(format!("{key}=normal:{mean}:{deviation}"));
        };
        add("profile_slope_deviation_um", profile_um);
        if pair.scene().slices.is_some() {
            add("helix_slope_deviation_um", helix_um);
        }
    }
    Ok(keys)
}

/// Key of the table of each gear, with a pair that it is of.
fn gears(scene: &OpenedScene) -> Vec<(String, &LoadedScene, Gear)> {
    match scene {
        OpenedScene::Pair(pair) => Gear::BOTH.map(|gear| (format!("pair.{}", gear.name()), &**pair, gear)).into(),
        OpenedScene::Planetary(stage) => {
            let gears = [
                ("sun", StageMesh::SunPlanet, Gear::Pinion),
                ("planet", StageMesh::SunPlanet, Gear::Wheel),
                ("ring", StageMesh::PlanetRing, Gear::Wheel),
            ];
            gears.map(|(name, mesh, gear)| (format!("planetary.{name}"), &stage.meshes[mesh], gear)).into()
        }
    }
}
