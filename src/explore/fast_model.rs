//! Fast model of a pair that is explored: a Winkler foundation against Hertz, and the stiffness of the teeth by finite elements of the scene as it was opened.
//!
//! The foundation has Hertz's peak pressure at the pitch point, whatever the pair. The compliance of the teeth over the path of contact, q(ξ), and the part of it that all
//! pairs in mesh share are those of a calibration of the pair as opened. A setting with another path of contact, from A' to E', takes it in proportion,
//!
//! ```text
//! q'(ξ') = q(ξ)          (ξ' − A') / (E' − A') = (ξ − A) / (E − A)
//! ```
//!
//! which finite elements of the setting itself correct a second later. Slices over the face width are few and coupled by plate theory. A scene that has a fast contact surface
//! or a stiffness of its own keeps it.

use toml::Value;

use super::answer::Answer;
use super::{Change, ExploreError, coarser};
use crate::scene::loaded::{CURVE, LoadedScene};
use gearwear_bodies::gear::GearPair;
use gearwear_bodies::gear::path_of_contact::PathOfContact;
use gearwear_physics::assessment::calibrate::{self, CalibrateError, CalibrationExtent};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::observer::Observer;
use gearwear_physics::operation::Scene;
use gearwear_physics::results::run::InputFile;
use gearwear_physics::simulation::settings::Stepping;
use gearwear_physics::stiffness::curve::PairCompliance;
use gearwear_physics::stiffness::curve_file;
use gearwear_physics::stiffness::settings::StiffnessSettings;

/// Flank points and positions where all sections are alike.
const ALIKE: [usize; 2] = [250, 120];
/// Flank points and positions with slices.
const SLICED: [usize; 2] = [150, 40];
/// Number of slices.
const SLICES: usize = 8;
/// Flank points and positions of finite elements.
const OF_ELEMENTS: [usize; 2] = [250, 60];
/// Flank points and positions of slices coupled by finite elements, and their number.
const OF_ELEMENTS_SLICED: ([usize; 2], usize) = ([200, 60], 10);
/// Tolerance of the wear steps over the greatest wear, of the fast model and of finite elements.
const TOLERANCE: [f64; 2] = [0.05, 0.02];
/// Tolerance of the first run, µm.
const FIRST_TOLERANCE_UM: f64 = 0.5;
/// Name of the file of the stiffness.
const STIFFNESS_FILE: &str = "stiffness.csv";

/// Tooth stiffness of the fast model.
enum ToothStiffness {
    /// That of the scene.
    Own,
    /// Finite elements of the pair as opened, whose path of contact reached from A to E.
    Calibrated { compliance: PairCompliance, path_mm: [f64; 2] },
    /// Weber and Banaschek's, as finite elements cannot be made.
    ClosedForm { because: String },
}

/// Fast model of a scene.
pub(super) struct FastModel {
    stiffness: ToothStiffness,
    /// Whether the surface of the scene is fast itself.
    own_surface: bool,
    surface: &'static str,
    has_slices: bool,
    own_tolerance_um: f64,
    /// Greatest wear of the scene as opened, µm.
    greatest_wear_um: Option<f64>,
}

impl FastModel {
    /// Fast model of `given`, calibrated by finite elements where they can be made.
    pub(super) fn calibrated(
        given: &LoadedScene,
        pair: &GearPair,
        observer: &dyn Observer,
    ) -> Result<Self, ExploreError> {
        let scene = given.scene();
        let fast = [SurfaceKind::Winkler, SurfaceKind::Hertz, SurfaceKind::HertzMean];
        let own_surface = fast.contains(&scene.contact.surface) && scene.calibration_file.is_none();
        let stiffness = match (scene.stiffness, &given.files.calibration) {
            (StiffnessSettings::Fem, Some(calibration)) => {
                let compliance = calibration.pair_compliance.clone();
                ToothStiffness::Calibrated { compliance, path_mm: ends_of(&pair.path) }
            }
            (StiffnessSettings::Fem, None) => calibrated(scene, pair, observer)?,
            _ => ToothStiffness::Own,
        };
        let own_tolerance_um = match scene.numerics.stepping {
            Stepping::Adaptive { tolerance_mm } => 1e3 * tolerance_mm,
            Stepping::Fixed { .. } => 0.0,
        };
        Ok(Self {
            stiffness,
            own_surface,
            surface: scene.contact.surface.name(),
            has_slices: scene.slices.is_some(),
            own_tolerance_um,
            greatest_wear_um: None,
        })
    }

    /// Lets the tolerance of wear steps follow the wear of the scene as opened.
    pub(super) fn follow_wear_of(&mut self, opened: &Answer) {
        self.greatest_wear_um = Some(opened.greatest_wear_um());
    }

    /// Fast model and finite elements in words.
    pub(super) fn in_words(&self) -> [String; 2] {
        let surface = match self.own_surface {
            true => format!("contact surface {}, as the scene has it", self.surface),
            false => "Winkler foundation with Hertz's peak pressure at the pitch point".to_owned(),
        };
        let stiffness = match &self.stiffness {
            ToothStiffness::Own => "stiffness of the teeth as the scene has it".to_owned(),
            ToothStiffness::Calibrated { .. } => {
                "stiffness of the teeth by finite elements of the scene as opened".to_owned()
            }
            ToothStiffness::ClosedForm { because } => {
                format!("stiffness of the teeth by Weber and Banaschek, as {because}")
            }
        };
        let (resolution, elements) = match self.has_slices {
            false => (ALIKE, format!("{} flank points, {} positions", OF_ELEMENTS[0], OF_ELEMENTS[1])),
            true => {
                let ([points, positions], slices) = OF_ELEMENTS_SLICED;
                (SLICED, format!("{slices} slices coupled in space, {points} flank points, {positions} positions"))
            }
        };
        let slices = if self.has_slices { format!(", {SLICES} slices by plate theory") } else { String::new() };
        let [fast_um, elements_um] = TOLERANCE.map(|share| self.tolerance_um(share));
        [
            format!(
                "{surface}; {stiffness}{slices}; {} flank points, {} positions, steps within {fast_um} µm",
                resolution[0], resolution[1]
            ),
            format!("{elements}, steps within {elements_um} µm"),
        ]
    }

    /// Tolerance of wear steps, to two digits: this share of the greatest wear, not below that of the scene.
    fn tolerance_um(&self, share: f64) -> f64 {
        let um = self.greatest_wear_um.map_or(FIRST_TOLERANCE_UM, |wear| share * wear).max(self.own_tolerance_um);
        let um = um.max(1e-3);
        format!("{um:.1e}").parse().unwrap_or(um)
    }

    /// What a scene is changed by: a setting of the sliders, resolved as `scene`.
    pub(super) fn changes(&self, scene: &Scene) -> Vec<Change> {
        let text = |text: &str| Some(Value::String(text.to_owned()));
        let resolution = if scene.slices.is_some() { SLICED } else { ALIKE };
        let mut changes = coarser(scene, resolution, self.tolerance_um(TOLERANCE[0]), false);
        let mut change = |key: &str, value: Option<Value>| changes.push((key.to_owned(), value));
        if !self.own_surface {
            change("contact.calibration", None);
            change("contact.foundation_MPa_per_mm", None);
            change("contact.surface", text(SurfaceKind::Winkler.name()));
            change("contact.match", text("peak-pressure"));
        }
        match &self.stiffness {
            ToothStiffness::Own => {}
            ToothStiffness::Calibrated { .. } => {
                change("stiffness.model", text("simon"));
                change(CURVE, text(STIFFNESS_FILE));
            }
            ToothStiffness::ClosedForm { .. } => change("stiffness.model", text("weber-banaschek")),
        }
        if let Some(slices) = scene.slices {
            change("helical.slices", Some(Value::Integer(slices.count.min(SLICES) as i64)));
            change("helical.coupling", text("slicing"));
        }
        changes
    }

    /// What it is changed by for finite elements, compared with others where they are to be `verified`.
    pub(super) fn changes_to_finite_elements(&self, scene: &Scene, verified: bool) -> Vec<Change> {
        let (resolution, slices) = match scene.slices {
            None => (OF_ELEMENTS, None),
            Some(own) => (OF_ELEMENTS_SLICED.0, Some(own.count.min(OF_ELEMENTS_SLICED.1))),
        };
        let mut changes = coarser(scene, resolution, self.tolerance_um(TOLERANCE[1]), verified);
        for key in ["contact", "stiffness", "helical.coupling"] {
            changes.push((key.to_owned(), None));
        }
        if let Some(slices) = slices {
            changes.push(("helical.slices".to_owned(), Some(Value::Integer(slices as i64))));
        }
        changes
    }

    /// File of the stiffness of `scene`, where it has one.
    pub(super) fn stiffness_file(&self, scene: &Scene) -> Result<Option<InputFile>, ExploreError> {
        let ToothStiffness::Calibrated { compliance, path_mm } = &self.stiffness else { return Ok(None) };
        let pair = GearPair::new(&scene.pair)?;
        let text = curve_file::to_text(&on_path(compliance, *path_mm, ends_of(&pair.path)));
        Ok(Some(InputFile { name: STIFFNESS_FILE.to_owned(), bytes: text.into_bytes() }))
    }
}

/// Points A and E of a path of contact, mm.
fn ends_of(path: &PathOfContact) -> [f64; 2] {
    [path.start_mm, path.end_mm]
}

/// Compliance of finite elements, or why there is none.
fn calibrated(scene: &Scene, pair: &GearPair, observer: &dyn Observer) -> Result<ToothStiffness, ExploreError> {
    // The transverse section alone: slices are coupled by plate theory.
    let section = Scene { slices: None, ..scene.clone() };
    let kept = Default::default();
    match guarded(|| calibrate::run(&section, CalibrationExtent::FastModel, &kept, observer)) {
        Ok(Ok(calibrated)) => {
            let compliance = calibrated.calibration.pair_compliance;
            Ok(ToothStiffness::Calibrated { compliance, path_mm: ends_of(&pair.path) })
        }
        Ok(Err(CalibrateError::Interrupted)) => Err(ExploreError::Interrupted),
        Ok(Err(error)) => Ok(ToothStiffness::ClosedForm { because: error.to_string() }),
        Err(said) => Ok(ToothStiffness::ClosedForm { because: said.to_string() }),
    }
}

/// Compliance of a pair whose path of contact reaches over `path_mm`, in proportion on one that reaches over `other_mm`.
fn on_path(compliance: &PairCompliance, path_mm: [f64; 2], other_mm: [f64; 2]) -> PairCompliance {
    if path_mm == other_mm {
        return compliance.clone();
    }
    let scale = (other_mm[1] - other_mm[0]) / (path_mm[1] - path_mm[0]);
    let least_mm = 1e-3 * other_mm[1].abs();
    let mapped = compliance.position_mm.iter().map(|position| other_mm[0] + scale * (position - path_mm[0]));
    let (position_mm, mm2_per_n) =
        mapped.zip(&compliance.mm2_per_n).filter(|(position, _)| *position > least_mm).unzip();
    PairCompliance { position_mm, mm2_per_n, ..*compliance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_physics::stiffness::curve::StandsFor;

    /// A compliance that is linear over its path is so over another, with the same ends; its shared part stays.
    #[test]
    fn ver_compliance_in_proportion_on_another_path() {
        let compliance = PairCompliance {
            position_mm: vec![4.0, 8.0, 12.0],
            mm2_per_n: vec![5e-5, 4e-5, 3e-5],
            stands_for: StandsFor::Teeth,
            shared_mm2_per_n: 6e-6,
        };
        let mapped = on_path(&compliance, [4.0, 12.0], [6.0, 10.0]);
        assert_eq!(mapped.position_mm, [6.0, 8.0, 10.0]);
        assert_eq!((mapped.mm2_per_n, mapped.shared_mm2_per_n), (compliance.mm2_per_n.clone(), 6e-6));
        assert_eq!(on_path(&compliance, [4.0, 12.0], [4.0, 12.0]), compliance);
    }
}
