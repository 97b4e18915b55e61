//! Contact surface of the samples: that of the scene, or a calibrated Winkler foundation, which takes a fraction of its time.
//!
//! Finite elements of the scene as given calibrate K/H and the stiffness of the teeth once. The scene is then run on both surfaces: where none of the
//! figures asked for differs by more than [`GREATEST_DIFFERENCE`], the samples are run on the foundation, and the difference of each figure is added to
//! the error that its samples vary.

use serde::Serialize;

use super::sampled_run::{SampledQuestion, UncertaintyStudyError, nominal, outputs_of};
use crate::runs;
use crate::scene::loaded::LoadedScene;
use crate::varied_scene::{VariedScene, in_words, one_line};
use gearwear_physics::assessment::calibrate::{CalibrateError, CalibrationExtent};
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::worn_pair::WornPair;
use gearwear_physics::stiffness::settings::StiffnessSettings;

/// Greatest relative difference of a figure of the scene as given between both surfaces.
pub const GREATEST_DIFFERENCE: f64 = 0.05;

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
    /// Relative difference of each output, then of the depth of each limit, to the surface of the scene; empty where the samples are on that.
    pub differences: Vec<f64>,
}

impl SampledScene {
    /// Scene on its own surface.
    fn as_given(scene: &LoadedScene, because: String) -> Result<Self, UncertaintyStudyError> {
        let varied = VariedScene::new(scene, false);
        let varied = varied.map_err(|problems| UncertaintyStudyError::Nominal(in_words(&problems)))?;
        let surface = scene.scene().contact.surface.name().to_owned();
        Ok(Self { varied, surface: SampledSurface { surface, because }, differences: Vec::new() })
    }

    /// Scene of the samples of `question`, of which `given` is the run of the scene as given.
    pub(super) fn choose(
        scene: &LoadedScene,
        question: &SampledQuestion,
        given: &WornPair,
        observer: &dyn Observer,
    ) -> Result<Self, UncertaintyStudyError> {
        match Self::on_foundation(scene, question, given, observer)? {
            Ok(fast) => Ok(fast),
            Err(because) => Self::as_given(scene, because),
        }
    }

    /// Scene on a calibrated foundation, or why it is not taken.
    fn on_foundation(
        scene: &LoadedScene,
        question: &SampledQuestion,
        given: &WornPair,
        observer: &dyn Observer,
    ) -> Result<Result<Self, String>, UncertaintyStudyError> {
        if let Some(because) = needs_own_surface(scene, question) {
            return Ok(Err(because));
        }
        observer.stage("calibration of the fast model");
        let calibration = match runs::calibrate(scene, CalibrationExtent::FastModel, observer) {
            Ok(calibrated) => calibrated.calibration,
            Err(CalibrateError::Interrupted) => return Err(UncertaintyStudyError::Interrupted),
            Err(error) => return Ok(Err(format!("the pair cannot be calibrated: {}", one_line(&error.to_string())))),
        };
        let on_foundation = match scene.on_calibrated_foundation(calibration) {
            Ok(on_foundation) => on_foundation,
            Err(error) => return Ok(Err(one_line(&error.to_string()))),
        };
        let fast = Self::as_given(&on_foundation, String::new())?;
        if !keeps_the_pair(&fast.varied, question) {
            return Ok(Err(
                "the uncertain keys change the pair, and with it the calibration of a fast model".to_owned()
            ));
        }
        observer.stage("the scene as given, on the fast model");
        let found = match nominal(&fast.varied, question, false, observer) {
            Err(UncertaintyStudyError::Nominal(reason)) => return Ok(Err(reason)),
            found => found?,
        };
        Ok(fast.judged(question, given, &found))
    }

    /// This scene, unless a figure of `found` differs too much from that of `given`.
    fn judged(self, question: &SampledQuestion, given: &WornPair, found: &WornPair) -> Result<Self, String> {
        let names = question.outputs.iter().map(|output| output.path.as_str());
        let names = names.chain(question.limits.iter().map(|limit| limit.output));
        let values = figures_of(question, given)?.into_iter().zip(figures_of(question, found)?);
        let mut differences = Vec::new();
        for (name, (given, found)) in names.zip(values) {
            let difference = if given == found { 0.0 } else { (found / given - 1.0).abs() };
            // Also where a run does not have the figure.
            if !(difference <= GREATEST_DIFFERENCE) {
                return Err(format!(
                    "{name} of the scene as given differs on a calibrated Winkler foundation by {:.1} %, more than {:.0} %",
                    100.0 * difference,
                    100.0 * GREATEST_DIFFERENCE
                ));
            }
            differences.push(difference);
        }
        let greatest = differences.iter().copied().fold(0.0, f64::max);
        let because = format!(
            "a calibrated foundation takes a fraction of the time, and the figures of the scene as given differ by {:.1} % at most",
            100.0 * greatest
        );
        Ok(Self { surface: SampledSurface { because, ..self.surface }, differences, ..self })
    }
}

/// Values of the outputs and of the depths of the limits.
fn figures_of(question: &SampledQuestion, of: &WornPair) -> Result<Vec<f64>, String> {
    let outputs = outputs_of(question, of)?.into_iter().map(|output| output.times(1.0).0);
    let depths = question.limits.iter().map(|limit| limit.depth(&of.history));
    Ok(outputs.chain(depths).collect())
}

/// Why the samples are run on the scene's own surface, where that is known without a calibration.
fn needs_own_surface(scene: &LoadedScene, question: &SampledQuestion) -> Option<String> {
    let of = scene.scene();
    if question.on_own_surface {
        return Some("the study asks for the surface of the scene".to_owned());
    }
    if !matches!(of.contact.surface, SurfaceKind::HalfSpace | SurfaceKind::Fem) {
        return Some(format!("{} is a fast surface itself", of.contact.surface.name()));
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

/// Whether the calibration belongs to the pair of every sample, tried with all keys away from their medians.
fn keeps_the_pair(varied: &VariedScene, question: &SampledQuestion) -> bool {
    [0.25, 0.75].into_iter().all(|share| {
        let values = question
            .uncertain
            .iter()
            .map(|one| (one.key.as_str(), toml::Value::Float(one.distribution.quantile(share))));
        varied.resolved(values).is_ok_and(|resolved| varied.inputs_belong_to(&resolved).is_ok())
    })
}
