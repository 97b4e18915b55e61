//! A run of the scene with some values of its uncertain keys, and what is read off it.
//!
//! Snapshots, error estimates and verification are left out of the samples; where a life is asked for, their histories have [`MOMENTS`] moments.

use super::design::ScoreCorrelation;
use super::distribution::Uncertain;
use super::kept::ReadOutput;
use super::life::DepthLimit;
use crate::evaluate::output::SummaryOutput;
use crate::journal::JournalError;
use crate::scene::loaded::LoadedScene;
use crate::scene::opened::SceneKind;
use crate::varied_scene::{StudiedRun, VariedScene, in_words, one_line};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::StopReason;

/// Number of moments of a history, evenly over the duration.
const MOMENTS: usize = 20;
/// Least number of finished points for the results of an interrupted study.
pub const FEWEST_SAMPLES: usize = 8;

/// Question, resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledQuestion {
    /// Kind of the scene.
    pub kind: SceneKind,
    pub uncertain: Vec<Uncertain>,
    /// How the keys are correlated, if they are.
    pub correlation: Option<ScoreCorrelation>,
    pub outputs: Vec<SummaryOutput>,
    pub limits: Vec<DepthLimit>,
    /// Points of the sequence.
    pub samples: usize,
    pub seed: u32,
    /// Whether the samples are run on the contact surface of the scene, fast or not.
    pub on_own_surface: bool,
    /// Whether all samples are run, where a response surface would do for most.
    pub run_all: bool,
}

impl SampledQuestion {
    /// Whether an output is of the transmission error over torque.
    pub(super) fn reads_torque_curve(&self) -> bool {
        self.outputs.iter().any(SummaryOutput::is_of_torque_curve)
    }
}

#[derive(Debug, thiserror::Error)]
pub enum UncertaintyStudyError {
    #[error("the scene as given cannot be run: {0}")]
    Run(String),
    #[error("none of {runs} samples has a result; the first says: {first}")]
    AllFailed { runs: usize, first: String },
    #[error("interrupted before {FEWEST_SAMPLES} samples were finished")]
    Interrupted,
    /// Rows that cannot be kept, or are another study's.
    #[error(transparent)]
    Journal(#[from] JournalError),
}

/// Sets [`MOMENTS`] moments of the history, evenly over the duration.
fn take_moments(pair: &mut LoadedScene) {
    let operation = &mut pair.resolved.scene.operation;
    let moments = (1..=MOMENTS).map(|number| operation.pinion_revolutions * number as f64 / MOMENTS as f64);
    operation.snapshots_revolutions = moments.collect();
}

/// Outputs of a run.
pub(super) fn outputs_of(question: &SampledQuestion, found: &StudiedRun) -> Result<Vec<ReadOutput>, String> {
    let summary = serde_json::to_value(found.summary()).map_err(|error| error.to_string())?;
    let outputs = question.outputs.iter().map(|output| ReadOutput {
        value: output.of(&summary).filter(|value| value.is_finite()),
        at_least: output.at_least(&summary),
    });
    Ok(outputs.collect())
}

/// Run of the scene with these values, verified where that is asked for and the scene does not refuse it.
///
/// # Errors
/// [`UncertaintyStudyError::Run`] with the reason, or an interrupt.
pub(super) fn run_of<'a>(
    varied: &VariedScene,
    values: impl IntoIterator<Item = (&'a str, toml::Value)>,
    question: &SampledQuestion,
    verify: bool,
    observer: &dyn Observer,
) -> Result<StudiedRun, UncertaintyStudyError> {
    let run = guarded(|| -> Result<StudiedRun, String> {
        let mut scene = varied.resolved(values).map_err(|problems| in_words(&problems))?;
        varied.inputs_belong_to(&scene)?;
        if verify {
            varied.verify_as_given(&mut scene);
        }
        if !question.limits.is_empty() {
            scene.change_each(take_moments);
        }
        varied.run(&scene, observer)
    });
    match run.unwrap_or_else(|said| Err(format!("a defect of the program: {said}"))) {
        Ok(found) if found.summary().stopped() == StopReason::Interrupted => Err(UncertaintyStudyError::Interrupted),
        Ok(found) => Ok(found),
        Err(_) if observer.interrupted() => Err(UncertaintyStudyError::Interrupted),
        Err(error) => Err(UncertaintyStudyError::Run(one_line(&error))),
    }
}
