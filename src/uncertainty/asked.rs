//! Question of a study, the same on the command line and in Python, and its errors.

use super::design::{self, CorrelationError, MOST_FACTORS, MOST_SAMPLES};
use super::distribution::{self, UncertainError};
use super::life::{DepthLimit, LimitError};
use super::sampled_run::{SampledQuestion, UncertaintyStudyError};
use super::usual;
use crate::evaluate::figure;
use crate::evaluate::output::{OutputError, SummaryOutput};
use crate::journal::JournalError;
use crate::scene::draft::{Draft, number_at};
use crate::scene::key::linked_keys;
use crate::scene::loaded::SceneError;
use crate::scene::opened::OpenedScene;
use crate::varied_scene::missing_phase;
use gearwear_physics::results::figures;

/// Question of a study of uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct UncertaintyQuestion {
    /// Uncertain keys: `KEY=DISTRIBUTION`, or words for usual ones (docs/sweep.md).
    pub uncertain: Vec<String>,
    /// Correlations of their normal scores: `KEY:KEY=R`.
    pub correlation: Vec<String>,
    /// Figures to keep, as paths in `summary.json`; empty: the greatest wear and tip-edge wear of both gears and the transmission error, worn.
    pub outputs: Vec<String>,
    /// Limits of the wear depth that end the life: `FIGURE=VALUE`.
    pub limits: Vec<String>,
    /// Points of the Sobol sequence, best a power of two; each takes two runs and one more for every uncertain key.
    pub samples: usize,
    /// Seed of the scrambling of the sequence.
    pub seed: u32,
    /// Whether the samples are run on the contact surface of the scene, where a fast model would do.
    pub on_own_surface: bool,
    /// Whether all samples are run, where a response surface would do for most.
    pub run_all: bool,
}

impl Default for UncertaintyQuestion {
    /// 512 samples of no key yet.
    fn default() -> Self {
        Self {
            uncertain: Vec::new(),
            correlation: Vec::new(),
            outputs: Vec::new(),
            limits: Vec::new(),
            samples: 512,
            seed: 1,
            on_own_surface: false,
            run_all: false,
        }
    }
}

impl UncertaintyQuestion {
    /// Notes on figures that are asked for by the name that they had in the version before.
    pub fn notes(&self) -> Vec<String> {
        let of_limits = self.limits.iter().map(|limit| limit.split('=').next().unwrap_or_default());
        figures::notes(self.outputs.iter().map(String::as_str).chain(of_limits).map(str::trim))
    }
}

/// Error of a study of uncertainty.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct UncertaintyError(#[from] pub UncertaintyFault);

#[derive(Debug, thiserror::Error)]
pub enum UncertaintyFault {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Uncertain(#[from] UncertainError),
    #[error(transparent)]
    Correlation(#[from] CorrelationError),
    #[error(transparent)]
    Limit(#[from] LimitError),
    #[error("unknown output {}; allowed: the path of a number in summary.json, such as pinion.peak_wear_um{}", .0.output, .0.nearest.as_ref().map_or_else(String::new, |nearest| format!("; did you mean {nearest}?")))]
    Output(OutputError),
    #[error("found {found} keys; allowed: 1 to {}", MOST_FACTORS - 1)]
    Count { found: usize },
    #[error("found {found} samples; allowed: a whole number from 2 to {MOST_SAMPLES}")]
    Samples { found: usize },
    #[error(transparent)]
    Study(#[from] UncertaintyStudyError),
    #[error(transparent)]
    Journal(#[from] JournalError),
}

impl From<OutputError> for UncertaintyFault {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

impl UncertaintyError {
    /// Fault of the scene itself, if that is the reason.
    pub fn in_the_scene(&self) -> Option<&SceneError> {
        if let UncertaintyFault::Scene(error) = &self.0 { Some(error) } else { None }
    }

    /// Whether the question was sound and the runs failed.
    pub fn is_of_the_runs(&self) -> bool {
        matches!(self.0, UncertaintyFault::Study(_))
    }
}

impl SampledQuestion {
    /// Question `asked`, resolved for `scene`.
    pub fn of(scene: &OpenedScene, asked: &UncertaintyQuestion) -> Result<Self, UncertaintyFault> {
        let kind = scene.kind();
        let draft = Draft::parse(&scene.given().text).map_err(|problems| scene.refused(problems))?;
        let values = OwnValues::of(scene, &draft);
        let own = |key: &str| values.of_key(key);
        let given = asked.uncertain.iter().map(|given| usual::expanded(given, scene, own));
        let given: Vec<String> = given.collect::<Result<Vec<_>, _>>()?.concat();
        let uncertain = distribution::parse_all(given.iter().map(String::as_str), own)?;
        if let Some(key) = missing_phase(uncertain.iter().flat_map(|one| linked_keys(&one.key)), &draft) {
            return Err(UncertainError::NoPhase { key }.into());
        }
        // The error of the model takes one more.
        if !(1..MOST_FACTORS).contains(&uncertain.len()) {
            return Err(UncertaintyFault::Count { found: uncertain.len() });
        }
        if !(2..=MOST_SAMPLES).contains(&asked.samples) {
            return Err(UncertaintyFault::Samples { found: asked.samples });
        }
        let keys: Vec<&str> = uncertain.iter().map(|one| one.key.as_str()).collect();
        let correlation = design::correlation(&keys, &asked.correlation)?;
        let limits =
            asked.limits.iter().map(|text| DepthLimit::parse(kind, text)).collect::<Result<_, LimitError>>()?;
        let outputs: Vec<&str> = match asked.outputs.as_slice() {
            [] => figure::default_outputs(kind),
            given => given.iter().map(|path| path.trim()).collect(),
        };
        let outputs = outputs.into_iter().map(|path| SummaryOutput::of_kind(kind, path)).collect::<Result<_, _>>()?;
        Ok(Self {
            kind,
            uncertain,
            correlation,
            outputs,
            limits,
            samples: asked.samples,
            seed: asked.seed,
            on_own_surface: asked.on_own_surface,
            run_all: asked.run_all,
        })
    }
}

/// The scene's own values of its keys: of a pair with all defaults, of a stage as its file gives them.
enum OwnValues<'a> {
    Pair(toml::Table),
    Stage(&'a Draft, f64),
}

impl<'a> OwnValues<'a> {
    fn of(scene: &OpenedScene, draft: &'a Draft) -> Self {
        match scene {
            OpenedScene::Pair(scene) => Self::Pair(scene.to_toml().parse().unwrap_or_default()),
            OpenedScene::Planetary(stage) => Self::Stage(draft, stage.load_sharing_factor),
        }
    }

    fn of_key(&self, key: &str) -> Option<f64> {
        match self {
            Self::Pair(resolved) => number_at(resolved, key),
            Self::Stage(_, factor) if key == "planetary.load_sharing_factor" => Some(*factor),
            Self::Stage(draft, _) => draft.number(key),
        }
    }
}
