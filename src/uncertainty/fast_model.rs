//! Contact surface of the samples: that of the scene, or a calibrated Winkler foundation, which takes a fraction of its time.
//!
//! Finite elements of the scene as given calibrate K/H and the stiffness of the teeth once. The scene is then run on both surfaces, as given and with all
//! uncertain keys low and high: where none of the figures asked for differs by more than [`GREATEST_DIFFERENCE`], the samples are run on the foundation,
//! and the greatest difference of each figure is added to the error that its samples vary.

use serde::Serialize;

use super::sampled_run::{SampledQuestion, UncertaintyStudyError, outputs_of, run_of};
use crate::runs;
use crate::scene::loaded::LoadedScene;
use crate::varied_scene::{VariedScene, in_words, one_line};
use gearwear_bodies::gear::GearPair;
use gearwear_physics::assessment::calibrate::{CalibrateError, CalibrationExtent};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::calibration::identity::CalibrationIdentity;
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::observer::Observer;
use gearwear_physics::operation::Scene;
use gearwear_physics::results::worn_pair::WornPair;
use gearwear_physics::stiffness::settings::StiffnessSettings;
use gearwear_physics::wear::settings::WearOfPair;

/// Greatest relative difference of a figure of the scene as given between both surfaces.
pub const GREATEST_DIFFERENCE: f64 = 0.05;
/// Shares of the distributions where both surfaces are compared too, all keys together.
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
    /// Relative difference of each output, then of the depth of each limit, to the surface of the scene; empty where the samples are on that.
    pub differences: Vec<f64>,
}

impl SampledScene {
    /// Scene on its own surface.
    pub(super) fn as_given(scene: &LoadedScene, because: String) -> Result<Self, UncertaintyStudyError> {
        let varied = VariedScene::new(scene, false);
        let varied = varied.map_err(|problems| UncertaintyStudyError::Run(in_words(&problems)))?;
        let surface = scene.scene().contact.surface.name().to_owned();
        Ok(Self { varied, surface: SampledSurface { surface, because }, differences: Vec::new() })
    }

    /// Scene of the samples of `question`: `given`, or the fast one. `nominal` is the run of the scene as given, and the number of runs of the samples.
    pub(super) fn choose(
        scene: &LoadedScene,
        given: Self,
        question: &SampledQuestion,
        nominal: (&WornPair, usize),
        observer: &dyn Observer,
    ) -> Result<Self, UncertaintyStudyError> {
        Ok(match Self::on_foundation(scene, &given.varied, question, nominal, observer)? {
            Ok(fast) => fast,
            Err(because) => Self { surface: SampledSurface { because, ..given.surface }, ..given },
        })
    }

    /// Scene on a calibrated foundation, or why it is not taken.
    fn on_foundation(
        scene: &LoadedScene,
        given: &VariedScene,
        question: &SampledQuestion,
        (nominal_run, runs): (&WornPair, usize),
        observer: &dyn Observer,
    ) -> Result<Result<Self, String>, UncertaintyStudyError> {
        if let Some(because) = needs_own_surface(scene, question, runs) {
            return Ok(Err(because));
        }
        if !keeps_the_pair(scene, given, question) {
            return Ok(Err(
                "the uncertain keys change the pair, and with it the calibration of a fast model".to_owned()
            ));
        }
        observer.stage("calibration of the fast model");
        let calibrated = guarded(|| runs::calibrate(scene, CalibrationExtent::FastModel, observer));
        let calibration = match calibrated {
            Ok(Ok(calibrated)) => calibrated.calibration,
            Ok(Err(CalibrateError::Interrupted)) => return Err(UncertaintyStudyError::Interrupted),
            Ok(Err(error)) => {
                return Ok(Err(format!("the pair cannot be calibrated: {}", one_line(&error.to_string()))));
            }
            Err(error) => return Ok(Err(format!("the pair cannot be calibrated: {}", one_line(&error.to_string())))),
        };
        let on_foundation = match scene.on_calibrated_foundation(calibration) {
            Ok(on_foundation) => on_foundation,
            Err(error) => return Ok(Err(one_line(&error.to_string()))),
        };
        let fast = Self::as_given(&on_foundation, String::new())?;
        observer.stage("the scene as given, on the fast model");
        let mut greatest = vec![0.0_f64; question.outputs.len() + question.limits.len()];
        for share in [None, Some(LOW_AND_HIGH[0]), Some(LOW_AND_HIGH[1])] {
            let values = || values_at(question, share);
            let found = match at_values(&fast.varied, question, values(), observer)? {
                Ok(found) => found,
                Err(reason) => return Ok(Err(reason)),
            };
            let own = match share {
                None => None,
                Some(_) => match at_values(given, question, values(), observer)? {
                    Ok(own) => Some(own),
                    // Samples that cannot be run are none of the figures.
                    Err(_) => continue,
                },
            };
            match differences(question, own.as_ref().unwrap_or(nominal_run), &found) {
                Ok(found) => greatest.iter_mut().zip(found).for_each(|(most, found)| *most = most.max(found)),
                Err(because) => return Ok(Err(because)),
            }
        }
        let because = format!(
            "a calibrated foundation takes a fraction of the time, and the figures, as given and with all keys low or high, differ by {:.1} % at most",
            100.0 * greatest.iter().copied().fold(0.0, f64::max)
        );
        Ok(Ok(Self { surface: SampledSurface { because, ..fast.surface }, differences: greatest, ..fast }))
    }
}

/// The uncertain keys where this share of each distribution lies below; none as given.
fn values_at(question: &SampledQuestion, share: Option<f64>) -> Vec<(&str, toml::Value)> {
    let keys = question.uncertain.iter().map(|one| {
        let value = share.map(|share| toml::Value::Float(one.distribution.quantile(share)))?;
        Some((one.key.as_str(), value))
    });
    keys.flatten().collect()
}

/// Run of a scene with these values, or why it cannot be run.
fn at_values(
    varied: &VariedScene,
    question: &SampledQuestion,
    values: Vec<(&str, toml::Value)>,
    observer: &dyn Observer,
) -> Result<Result<WornPair, String>, UncertaintyStudyError> {
    match run_of(varied, values, question, false, observer) {
        Err(UncertaintyStudyError::Run(reason)) => Ok(Err(reason)),
        found => found.map(Ok),
    }
}

/// Relative differences of the figures of `found` from those of `given`, or which is too great.
fn differences(question: &SampledQuestion, given: &WornPair, found: &WornPair) -> Result<Vec<f64>, String> {
    let names = question.outputs.iter().map(|output| output.path.as_str());
    let names = names.chain(question.limits.iter().map(|limit| limit.output));
    let values = figures_of(question, given)?.into_iter().zip(figures_of(question, found)?);
    let of_each = names.zip(values).map(|(name, (given, found))| {
        if given.is_nan() != found.is_nan()
            || given.is_finite() != found.is_finite()
            || (given == 0.0) != (found == 0.0)
        {
            return Err(format!("only one of both surfaces has {name}"));
        }
        let difference = if given == found || given.is_nan() { 0.0 } else { (found / given - 1.0).abs() };
        if difference <= GREATEST_DIFFERENCE {
            return Ok(difference);
        }
        Err(format!(
            "{name} differs on a calibrated Winkler foundation by {:.1} %, more than {:.0} %",
            100.0 * difference,
            100.0 * GREATEST_DIFFERENCE
        ))
    });
    of_each.collect()
}

/// Values of the outputs and of the depths of the limits.
fn figures_of(question: &SampledQuestion, of: &WornPair) -> Result<Vec<f64>, String> {
    let outputs = outputs_of(question, of)?.into_iter().map(|output| output.times(1.0).0);
    let depths = question.limits.iter().map(|limit| limit.depth(&of.history));
    Ok(outputs.chain(depths).collect())
}

/// Why the samples are run on the scene's own surface, where that is known without a calibration.
fn needs_own_surface(scene: &LoadedScene, question: &SampledQuestion, runs: usize) -> Option<String> {
    let of = scene.scene();
    if question.on_own_surface {
        return Some("the study asks for the surface of the scene".to_owned());
    }
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

/// Whether a calibration of the scene belongs to the pair of every sample, tried with all keys low and high.
fn keeps_the_pair(scene: &LoadedScene, given: &VariedScene, question: &SampledQuestion) -> bool {
    let identity = |of: &Scene| {
        let pair = GearPair::new(&of.pair).ok()?;
        Some(CalibrationIdentity::of(&pair, &of.material, &of.fem))
    };
    let own = identity(scene.scene());
    LOW_AND_HIGH.into_iter().all(|share| {
        given.resolved(values_at(question, Some(share))).is_ok_and(|resolved| identity(&resolved.scene) == own)
    })
}
