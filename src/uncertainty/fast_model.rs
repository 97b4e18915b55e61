//! Contact surface of the samples: that of the scene, or a calibrated Winkler foundation, which takes a fraction of its time.
//!
//! Finite elements of the scene as given calibrate K/H and the stiffness of the teeth once. The foundation takes [`POSITIONS`] positions and
//! [`FLANK_POINTS`] points at most: on 400 positions the wear of FZG type C is 0.2 % greater, that of its tip edges 0.5 % less, and 750 points change
//! neither by more than 0.4 %. On 100 positions tip edges of deeply worn pairs differ by more than is taken. Adaptive steps may err by [`TOLERANCE`] of the
//! shallowest depth that counts, the greatest wear of either gear as given or a limit: a third fewer mesh cycles of a 19/57 pair worn by 25 and 10 µm, whose
//! wear moves by 5e-5. The scene is then run on both surfaces, as given, with all uncertain keys low, with all high, and with some low and others high such
//! that every two keys are once apart: the profile slopes of both
//! gears do nothing while they are alike. With y the figure on the scene's own surface and y' that on the foundation, as given (0) or with the keys so (±),
//!
//! ```text
//! correction   c = y₀/y'₀            difference   d = max |c y'±/y± − 1|
//! ```
//!
//! Where no correction is above [`GREATEST_CORRECTION`] and no difference above [`GREATEST_DIFFERENCE`], the samples are run on the foundation, their
//! figures corrected, and the difference of each figure is added to the error that its samples vary.

use serde::Serialize;

use super::life::DepthLimit;
use super::sampled_run::{SampledQuestion, UncertaintyStudyError, outputs_of, run_of};
use crate::runs;
use crate::scene::loaded::{FinestNumerics, LoadedScene};
use crate::scene::opened::OpenedScene;
use crate::varied_scene::{StudiedRun, VariedScene, in_words, one_line};
use gearwear_physics::assessment::calibrate::{CalibrateError, CalibrationExtent};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::observer::Observer;
use gearwear_physics::stiffness::settings::StiffnessSettings;
use gearwear_physics::wear::settings::WearOfPair;

/// Greatest relative difference of a figure, corrected, between both surfaces.
pub const GREATEST_DIFFERENCE: f64 = 0.05;
/// Greatest relative difference of a figure as given that is corrected.
pub const GREATEST_CORRECTION: f64 = 0.1;
/// Most positions from A to E on the foundation.
pub const POSITIONS: usize = 150;
/// Most points of a flank on the foundation.
pub const FLANK_POINTS: usize = 375;
/// Least tolerance of adaptive steps on the foundation over the shallowest depth that counts.
pub const TOLERANCE: f64 = 0.02;
/// Shares of the distributions where both surfaces are compared too.
const LOW_AND_HIGH: [f64; 2] = [0.05, 0.95];
/// Number of runs from which a fast model pays.
const FEW_RUNS: usize = 24;

/// Contact surface of the samples, and why.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct SampledSurface {
    /// As in `contact.surface`.
    pub surface: String,
    pub because: String,
}

/// Scene that the samples vary.
pub(super) struct SampledScene {
    pub varied: VariedScene,
    pub surface: SampledSurface,
    /// Figure on the surface of the scene over that of the samples, both as given, of each output, then of the depth of each limit; empty where the samples
    /// are on the scene's own.
    pub corrections: Vec<f64>,
    /// Greatest relative difference of each figure, corrected so, to the surface of the scene; empty likewise.
    pub differences: Vec<f64>,
}

impl SampledScene {
    /// Scene on its own surface.
    pub(super) fn as_given(
        scene: &OpenedScene,
        question: &SampledQuestion,
        because: String,
    ) -> Result<Self, UncertaintyStudyError> {
        let varied = VariedScene::new(scene, false);
        let varied = varied.map_err(|problems| UncertaintyStudyError::Run(in_words(&problems)))?;
        let varied = varied.with_torque_curve(question.reads_torque_curve());
        let scenes = scene.each();
        let mut surfaces: Vec<&str> = scenes.all().iter().map(|pair| pair.scene().contact.surface.name()).collect();
        surfaces.dedup();
        let surface = surfaces.join(" and ");
        Ok(Self {
            varied,
            surface: SampledSurface { surface, because },
            corrections: Vec::new(),
            differences: Vec::new(),
        })
    }

    /// Scene of the samples of `question`: `given`, or the fast one. `nominal` is the run of the scene as given, and the number of runs of the samples.
    pub(super) fn choose(
        scene: &OpenedScene,
        given: Self,
        question: &SampledQuestion,
        nominal: (&StudiedRun, usize),
        observer: &dyn Observer,
    ) -> Result<Self, UncertaintyStudyError> {
        Ok(match Self::on_foundation(scene, &given.varied, question, nominal, observer)? {
            Ok(fast) => fast,
            Err(because) => Self { surface: SampledSurface { because, ..given.surface }, ..given },
        })
    }

    /// Scene on a calibrated foundation, or why it is not taken.
    fn on_foundation(
        scene: &OpenedScene,
        given: &VariedScene,
        question: &SampledQuestion,
        (nominal_run, runs): (&StudiedRun, usize),
        observer: &dyn Observer,
    ) -> Result<Result<Self, String>, UncertaintyStudyError> {
        if question.on_own_surface {
            return Ok(Err("the study asks for the surface of the scene".to_owned()));
        }
        if let Some(because) = scene.each().all().into_iter().find_map(|pair| needs_own_surface(pair, runs)) {
            return Ok(Err(because));
        }
        if !keeps_the_teeth(given, question) {
            return Ok(Err(
                "the uncertain keys change the teeth, and with them the calibration of a fast model".to_owned()
            ));
        }
        let mut foundations = Vec::new();
        for (pair, nominal) in scene.each().all().into_iter().zip(nominal_run.pairs().all()) {
            let worn_um = [&nominal.summary.pinion, &nominal.summary.wheel].map(|wear| wear.peak_wear_um);
            match on_calibrated_foundation(pair, finest_numerics(worn_um, &question.limits), observer)? {
                Ok(pair) => foundations.push(pair),
                Err(because) => return Ok(Err(because)),
            }
        }
        let mut on_foundation = scene.clone();
        let mut foundations = foundations.into_iter();
        on_foundation.change_each(|pair| foundations.by_ref().take(1).for_each(|calibrated| *pair = calibrated));
        let mut fast = Self::as_given(&on_foundation, question, String::new())?;
        fast.varied = fast.varied.with_other_modifications();
        observer.stage("the scene as given, on the fast model");
        let corrections = match at_values(&fast.varied, question, values_at(question, None), observer)? {
            Ok(found) => match corrections(question, nominal_run, &found) {
                Ok(corrections) => corrections,
                Err(because) => return Ok(Err(because)),
            },
            Err(reason) => return Ok(Err(reason)),
        };
        let mut greatest = vec![0.0_f64; corrections.len()];
        for shares in corners(question.uncertain.len()) {
            let values = || values_at(question, Some(&shares));
            let found = match at_values(&fast.varied, question, values(), observer)? {
                Ok(found) => found,
                Err(reason) => return Ok(Err(reason)),
            };
            // Samples that cannot be run are none of the figures.
            let Ok(own) = at_values(given, question, values(), observer)? else { continue };
            match differences(question, &own, &found, &corrections) {
                Ok(found) => greatest.iter_mut().zip(found).for_each(|(most, found)| *most = most.max(found)),
                Err(because) => return Ok(Err(because)),
            }
        }
        let [corrected, greatest_left] = [
            corrections.iter().map(|correction| (correction - 1.0).abs()).fold(0.0, f64::max),
            greatest.iter().copied().fold(0.0, f64::max),
        ];
        let because = format!(
            "a calibrated foundation takes a fraction of the time; its figures are corrected by what they differ as given, {:.1} % at most, and then differ \
             with the keys low or high by {:.1} % at most",
            100.0 * corrected,
            100.0 * greatest_left
        );
        Ok(Ok(Self { surface: SampledSurface { because, ..fast.surface }, corrections, differences: greatest, ..fast }))
    }
}

/// A pair on a foundation that finite elements of it calibrate, or why it is not taken.
fn on_calibrated_foundation(
    scene: &LoadedScene,
    finest: FinestNumerics,
    observer: &dyn Observer,
) -> Result<Result<LoadedScene, String>, UncertaintyStudyError> {
    observer.stage("calibration of the fast model");
    let calibrated = guarded(|| runs::calibrate(scene, CalibrationExtent::FastModel, observer));
    let because = match calibrated {
        Ok(Ok(calibrated)) => {
            let on_foundation = scene.on_calibrated_foundation(calibrated.calibration, finest);
            return Ok(on_foundation.map_err(|error| one_line(&error.to_string())));
        }
        Ok(Err(CalibrateError::Interrupted)) => return Err(UncertaintyStudyError::Interrupted),
        Ok(Err(error)) => error.to_string(),
        Err(error) => error.to_string(),
    };
    Ok(Err(format!("the pair cannot be calibrated: {}", one_line(&because))))
}

/// Finest resolution of a pair on the foundation, whose gears wear by at most `worn_um` as given.
fn finest_numerics(worn_um: [f64; 2], limits: &[DepthLimit]) -> FinestNumerics {
    let depths_um = worn_um.into_iter().chain(limits.iter().map(|limit| limit.depth_um));
    let tolerance_um = TOLERANCE * depths_um.fold(f64::INFINITY, f64::min);
    FinestNumerics { positions: POSITIONS, flank_points: FLANK_POINTS, tolerance_um }
}

/// Shares of the distributions of `keys` keys where surfaces are compared: all low, all high, and high where a bit of the key's number is set, so that
/// every two keys are once apart.
fn corners(keys: usize) -> Vec<Vec<f64>> {
    let [low, high] = LOW_AND_HIGH;
    let bits = (0..usize::BITS).take_while(|bit| 1 << bit < keys);
    let mixed = bits.map(|bit| (0..keys).map(|key| if key >> bit & 1 == 1 { high } else { low }).collect());
    [vec![low; keys], vec![high; keys]].into_iter().chain(mixed).collect()
}

/// The uncertain keys where these shares of their distributions lie below; none as given.
fn values_at<'q>(question: &'q SampledQuestion, shares: Option<&[f64]>) -> Vec<(&'q str, toml::Value)> {
    let of_keys = question.uncertain.iter().zip(shares.unwrap_or_default());
    of_keys.map(|(one, &share)| (one.key.as_str(), toml::Value::Float(one.distribution.quantile(share)))).collect()
}

/// Run of a scene with these values, or why it cannot be run.
fn at_values(
    varied: &VariedScene,
    question: &SampledQuestion,
    values: Vec<(&str, toml::Value)>,
    observer: &dyn Observer,
) -> Result<Result<StudiedRun, String>, UncertaintyStudyError> {
    match run_of(varied, values, question, false, observer) {
        Err(UncertaintyStudyError::Run(reason)) => Ok(Err(reason)),
        found => found.map(Ok),
    }
}

/// Names of the outputs and of the depths of the limits.
fn names(question: &SampledQuestion) -> impl Iterator<Item = &str> {
    let names = question.outputs.iter().map(|output| output.path.as_str());
    names.chain(question.limits.iter().map(|limit| limit.output))
}

/// Figures of `given` over those of `found`, or which are too far apart.
fn corrections(question: &SampledQuestion, given: &StudiedRun, found: &StudiedRun) -> Result<Vec<f64>, String> {
    let values = figures_of(question, given)?.into_iter().zip(figures_of(question, found)?);
    let of_each = names(question).zip(values).map(|(name, (given, found))| {
        if given.is_finite() != found.is_finite() || (given == 0.0) != (found == 0.0) {
            return Err(format!("only one of both surfaces has {name}"));
        }
        let correction = if given == found || !given.is_finite() { 1.0 } else { given / found };
        within(name, (correction - 1.0).abs(), GREATEST_CORRECTION, "differs")?;
        Ok(correction)
    });
    of_each.collect()
}

/// Relative differences of the figures of `found`, corrected, from those of `given`, or which is too great.
fn differences(
    question: &SampledQuestion,
    given: &StudiedRun,
    found: &StudiedRun,
    corrections: &[f64],
) -> Result<Vec<f64>, String> {
    let values = figures_of(question, given)?.into_iter().zip(figures_of(question, found)?);
    let of_each = names(question).zip(values).zip(corrections).map(|((name, (given, found)), correction)| {
        if given.is_finite() != found.is_finite() || (given == 0.0) != (found == 0.0) {
            return Err(format!("only one of both surfaces has {name}"));
        }
        let found = correction * found;
        let difference = if given == found || !given.is_finite() { 0.0 } else { (found / given - 1.0).abs() };
        within(name, difference, GREATEST_DIFFERENCE, "differs with the keys low or high")?;
        Ok(difference)
    });
    of_each.collect()
}

/// Refuses a difference above the greatest.
fn within(name: &str, difference: f64, greatest: f64, differs: &str) -> Result<(), String> {
    if difference <= greatest {
        return Ok(());
    }
    Err(format!(
        "{name} {differs} on a calibrated Winkler foundation by {:.1} %, more than {:.0} %",
        100.0 * difference,
        100.0 * greatest
    ))
}

/// Values of the outputs and of the depths of the limits.
fn figures_of(question: &SampledQuestion, of: &StudiedRun) -> Result<Vec<f64>, String> {
    let outputs = outputs_of(question, of)?.into_iter().map(|output| output.times(1.0).0);
    let depths = question.limits.iter().map(|limit| limit.depth(of));
    Ok(outputs.chain(depths).collect())
}

/// Why the samples are run on the scene's own surface, where that is known without a calibration.
fn needs_own_surface(scene: &LoadedScene, runs: usize) -> Option<String> {
    let of = scene.scene();
    if !matches!(of.contact.surface, SurfaceKind::HalfSpace | SurfaceKind::Fem) {
        return Some(format!("{} is a fast surface itself", of.contact.surface.name()));
    }
    if runs < FEW_RUNS {
        return Some(format!("{runs} runs take less time than the calibration of a fast model"));
    }
    if of.wear.may_be_severe() {
        return Some("severe wear depends on where the pressure passes a limit".to_owned());
    }
    if of.slices.is_some() {
        return Some("sections differ over the face width".to_owned());
    }
    if of.contact.surface == SurfaceKind::HalfSpace && of.stiffness != StiffnessSettings::Fem {
        return Some(format!("the stiffness {} is the scene's own", of.stiffness.name()));
    }
    let warms = of.operation.phases.iter().any(|phase| of.material_in(phase) != of.material);
    warms.then(|| "moduli of elasticity follow the temperature of the teeth".to_owned())
}

/// Whether the teeth of every sample are those of the scene but for their modifications, tried with the keys low and high.
fn keeps_the_teeth(given: &VariedScene, question: &SampledQuestion) -> bool {
    corners(question.uncertain.len()).iter().all(|shares| {
        let resolved = given.resolved(values_at(question, Some(shares)));
        resolved.is_ok_and(|resolved| given.keeps_the_teeth(&resolved))
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scene::loaded::SceneText;
    use crate::scene::opened::SceneKind;
    use crate::scene::planetary::PlanetaryScene;
    use gearwear_physics::observer::Unwatched;
    use gearwear_physics::simulation::settings::Stepping;

    /// What two keys do against one another would not be seen where they only move together.
    #[test]
    fn every_two_keys_are_once_apart() {
        for keys in 1..=20 {
            let corners = corners(keys);
            assert!(corners.iter().all(|shares| shares.len() == keys));
            for (one, other) in (0..keys).flat_map(|one| (0..one).map(move |other| (one, other))) {
                assert!(corners.iter().any(|shares| shares[one] != shares[other]), "{keys}: {one} and {other}");
            }
        }
        assert_eq!(corners(1).len(), 2);
    }

    /// A pair, and a mesh of a stage, whose own table lies above that of both, are on the foundation with its positions and points. Its tolerance is theirs
    /// where that of the steps is finer, and their own where it is not.
    #[test]
    fn the_foundation_is_no_finer_than_asked() {
        let text = include_str!("../../examples/planetary_stage.toml").to_owned();
        let stage = PlanetaryScene::from_text(SceneText { name: "stage".to_owned(), text }, Path::new("")).unwrap();
        let [pair, mesh] = [LoadedScene::preset("fzg-c").unwrap(), stage.meshes.planet_ring];
        let limit = DepthLimit::parse(SceneKind::Pair, "pinion.peak_wear_um=12.5").unwrap();
        let limited = std::slice::from_ref(&limit);
        for (scene, worn_um, limits, tolerance_mm) in [
            (&pair, [40.0, 12.5], &[][..], 1e-3 * 0.25),
            (&pair, [40.0, 30.0], limited, 1e-3 * 0.25),
            (&pair, [40.0, 0.0], &[], 1e-3 * 0.05),
            (&mesh, [12.5, 40.0], &[], 1e-3 * 0.25),
        ] {
            let own = scene.scene().numerics;
            assert!(own.positions > POSITIONS && own.flank_points > FLANK_POINTS);
            let finest = finest_numerics(worn_um, limits);
            let found = on_calibrated_foundation(scene, finest, &Unwatched).unwrap().unwrap();
            let found = found.scene();
            assert_eq!(found.contact.surface, SurfaceKind::Winkler);
            assert_eq!((found.numerics.positions, found.numerics.flank_points), (POSITIONS, FLANK_POINTS));
            assert_eq!(found.numerics.stepping, Stepping::Adaptive { tolerance_mm });
        }
    }
}
