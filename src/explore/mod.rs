//! Exploring a pair: a scene whose keys are turned like knobs, answered at once by a fast model and soon after by finite elements.
//!
//! [`Session::open`] reads the knobs of a scene ([`slider`]) and calibrates its fast model by finite elements once ([`fast_model`]). Each setting of the sliders is then a
//! scene of its own, in one of three [`Model`]s: that of the scene, the fast one, and finite elements of a resolution that answers in about a second. A setting is
//! checked as any scene is, and its answer ([`answer`]) is that of `gearwear run` with the scene of that model ([`Session::files`]), to the last bit.

pub mod answer;
pub mod fast_model;
pub mod slider;

use std::collections::BTreeMap;
use std::path::Path;

use toml::Value;

use crate::runs;
use crate::scene::draft::Draft;
use crate::scene::key::{as_whole, linked_keys, takes_whole_numbers};
use crate::scene::loaded::{LoadError, LoadedScene, SceneError, SceneText};
use crate::scene::{Problem, Resolved};
use answer::{Answer, Band};
use fast_model::FastModel;
use gearwear_bodies::gear::{GearPair, PairError};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::assessment::{Done, Resumption, RunError};
use gearwear_physics::observer::Observer;
use gearwear_physics::operation::Scene;
use gearwear_physics::results::run::{InputFile, RunRecord, StopReason};
use gearwear_physics::wear::settings::WearOfPair;
use serde::{Deserialize, Serialize};
use slider::{Slider, Sliders};

/// Values of sliders by their name; those not named stand as the scene has them.
pub type Setting = BTreeMap<String, f64>;
/// A change of a scene: a key with its value, or without one to leave it out.
pub type Change = (String, Option<Value>);

/// Model of an answer, and of a scene that is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// That of the scene.
    Own,
    /// Fast one.
    Fast,
    /// Finite elements.
    FiniteElements,
}

/// A question: values of sliders, and the model that is to answer.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    #[serde(default)]
    pub setting: Setting,
    #[serde(default)]
    pub model: Option<Model>,
}

/// Why a setting has no answer.
#[derive(Debug, thiserror::Error)]
pub enum ExploreError {
    /// No slider has this name.
    #[error("unknown slider {name}; allowed: one of this page")]
    UnknownSlider {
        /// Name as given.
        name: String,
    },
    /// A value outside the range of its slider.
    #[error("{name}: found {found}; allowed: {low} to {high}")]
    OutOfRange {
        /// Name of the slider.
        name: String,
        /// Value as given.
        found: f64,
        /// Least value.
        low: f64,
        /// Greatest value.
        high: f64,
    },
    /// The scene with these values is wrong.
    #[error("{}", in_words(.0))]
    Scene(Vec<Problem>),
    /// A file that the scene names is wrong.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The values do not make a pair.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The run came to no end.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A newer setting takes the place of this one, or it takes too long.
    #[error("interrupted: a newer setting takes its place, or it takes too long")]
    Interrupted,
    /// A panic.
    #[error("a defect of the program: {0}")]
    Defect(String),
}

impl From<SceneError> for ExploreError {
    fn from(error: SceneError) -> Self {
        Self::Scene(error.problems)
    }
}

/// Every problem with its remedy, one a line.
fn in_words(problems: &[Problem]) -> String {
    let lines = problems.iter().map(|problem| match &problem.help {
        Some(help) => format!("{problem} ({help})"),
        None => problem.to_string(),
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// A scene that is explored.
pub struct Session {
    given: LoadedScene,
    /// The scene as given, read.
    draft: Draft,
    sliders: Sliders,
    fast: FastModel,
}

impl Session {
    /// Scene `given` with its sliders and its calibrated fast model.
    ///
    /// # Errors
    /// A scene that cannot be read again, or that the fast model cannot run.
    pub fn open(given: LoadedScene, observer: &dyn Observer) -> Result<Self, ExploreError> {
        let draft = Draft::parse(&given.given.text).map_err(ExploreError::Scene)?;
        let pair = GearPair::new(&given.scene().pair)?;
        let sliders = Sliders::of(&given, &draft, &pair);
        let fast = FastModel::calibrated(&given, &pair, observer)?;
        let mut session = Self { given, draft, sliders, fast };
        let opened = session.answer(&Setting::new(), Model::Fast, observer)?;
        session.fast.follow_wear_of(&opened);
        Ok(session)
    }

    /// Title of the scene.
    pub fn title(&self) -> &str {
        self.given.resolved.title()
    }

    /// What can be turned.
    pub fn sliders(&self) -> &[Slider] {
        &self.sliders.list
    }

    /// Settings of the fast model and of the finite elements, in words.
    pub fn models(&self) -> [String; 2] {
        self.fast.in_words()
    }

    /// Whether finite elements are compared with coarser ones in each answer. Those in space, and those with severe wear, take too long for that.
    pub fn compares_each_answer(&self) -> bool {
        let scene = self.given.scene();
        scene.slices.is_none() && !scene.wear.may_be_severe()
    }

    /// Runs `setting` with `model`.
    ///
    /// # Errors
    /// What is wrong with the setting, in the words of the scene's checks; a run that comes to no end.
    pub fn answer(&self, setting: &Setting, model: Model, observer: &dyn Observer) -> Result<Answer, ExploreError> {
        let scene = self.scene(setting, model, false)?;
        Ok(Answer::of(&run(&scene, observer)?, model))
    }

    /// Differences of the finite elements of `setting` to others: coarser ones, or on other slices.
    ///
    /// # Errors
    /// As [`Self::answer`].
    pub fn band(&self, setting: &Setting, observer: &dyn Observer) -> Result<Band, ExploreError> {
        let scene = self.scene(setting, Model::FiniteElements, true)?;
        Ok(Band::of(&run(&scene, observer)?.summary))
    }

    /// Answer of finite elements with their differences to coarser ones, in one run.
    ///
    /// # Errors
    /// As [`Self::answer`].
    pub fn verified_answer(&self, setting: &Setting, observer: &dyn Observer) -> Result<Answer, ExploreError> {
        let scene = self.scene(setting, Model::FiniteElements, true)?;
        let record = run(&scene, observer)?;
        let band = Band::of(&record.summary);
        Ok(Answer::of(&record, Model::FiniteElements).with_band(&band))
    }

    /// Scene file of `setting` with `model`, with the files that it names: what `gearwear run` takes for the same answer.
    ///
    /// # Errors
    /// What is wrong with the setting.
    pub fn files(&self, setting: &Setting, model: Model) -> Result<Vec<InputFile>, ExploreError> {
        let (text, named) = self.text(setting, model, false)?;
        let scene = InputFile { name: "scene.toml".to_owned(), bytes: text.into_bytes() };
        Ok([scene].into_iter().chain(named).collect())
    }

    /// Scene of `setting` with its own model and a table `[improve]`, whose free keys are the tip reliefs, and the other modifications that the setting turns, over the
    /// ranges of their sliders.
    ///
    /// # Errors
    /// What is wrong with the setting.
    pub fn to_improve(&self, setting: &Setting) -> Result<InputFile, ExploreError> {
        let (text, _) = self.text(setting, Model::Own, false)?;
        let mut draft = Draft::parse(&text).map_err(ExploreError::Scene)?;
        let free = self.sliders.free(setting).into_iter().map(Value::String).collect();
        draft.set("improve.free", Value::Array(free));
        Ok(InputFile { name: "improve.toml".to_owned(), bytes: draft.to_toml().into_bytes() })
    }

    /// Scene of `setting` with `model`, whose answer is compared with another where it is to be `verified`.
    fn scene(&self, setting: &Setting, model: Model, verified: bool) -> Result<LoadedScene, ExploreError> {
        let (text, named) = self.text(setting, model, verified)?;
        let given = SceneText { name: self.given.given.name.clone(), text };
        let files = self.given.input_files().into_iter().chain(named).collect();
        let folder: &Path = &self.given.folder;
        let scene = LoadedScene::from_parts(given, folder, files)?;
        // Variants of a pair with the same teeth in space share them.
        Ok(LoadedScene { teeth_in_space: self.given.teeth_in_space.clone(), ..scene })
    }

    /// Text of that scene, with the files made for it.
    fn text(&self, setting: &Setting, model: Model, verified: bool) -> Result<(String, Vec<InputFile>), ExploreError> {
        let mut draft = self.draft.clone();
        apply(&mut draft, self.sliders.changes(setting)?);
        let Resolved { scene, .. } = draft.resolve().map_err(ExploreError::Scene)?;
        let mut named = Vec::new();
        match model {
            Model::Own => {}
            Model::Fast => {
                apply(&mut draft, self.fast.changes(&scene));
                named.extend(self.fast.stiffness_file(&scene)?);
            }
            Model::FiniteElements => apply(&mut draft, self.fast.changes_to_finite_elements(&scene, verified)),
        }
        Ok((draft.to_toml(), named))
    }
}

fn apply(draft: &mut Draft, changes: Vec<Change>) {
    for (keys, value) in changes {
        for key in linked_keys(&keys) {
            match &value {
                Some(value) if takes_whole_numbers(&key) => draft.set(&key, as_whole(value)),
                Some(value) => draft.set(&key, value.clone()),
                None => draft.remove(&key),
            }
        }
    }
}

/// Whole record of a complete run; a panic is an error.
fn run(scene: &LoadedScene, observer: &dyn Observer) -> Result<RunRecord, ExploreError> {
    let scene = scene.clone().without_torque_curve();
    let done = guarded(|| runs::run_from(&scene, Resumption::none(), observer));
    let done = done.map_err(|said| ExploreError::Defect(said.to_string()))?;
    match done {
        Err(_) | Ok(Done { failure: Some(_), .. }) if observer.interrupted() => Err(ExploreError::Interrupted),
        Err(failure) | Ok(Done { failure: Some(failure), .. }) => Err(failure.into()),
        Ok(Done { record, failure: None }) if record.summary.stopped == StopReason::Interrupted => {
            Err(ExploreError::Interrupted)
        }
        Ok(Done { record, failure: None }) => Ok(record),
    }
}

/// Greatest number below `most` and `own`, for a resolution that is not to exceed the scene's own.
fn at_most(own: usize, most: usize) -> Option<Value> {
    Some(Value::Integer(own.min(most) as i64))
}

/// Changes of the resolution of `scene`: points, positions and tolerance of steps, without snapshots and estimates of its error.
fn coarser(scene: &Scene, [points, positions]: [usize; 2], tolerance_um: f64, verify: bool) -> Vec<Change> {
    let change = |key: &str, value: Option<Value>| (key.to_owned(), value);
    vec![
        change("operation.snapshots_h", None),
        change("operation.snapshots_revolutions", None),
        change("numerics.flank_points", at_most(scene.numerics.flank_points, points)),
        change("numerics.positions", at_most(scene.numerics.positions, positions)),
        change("numerics.step", Some(Value::String("adaptive".to_owned()))),
        change("numerics.tolerance_um", Some(Value::Float(tolerance_um))),
        change("numerics.error_estimate", Some(Value::Boolean(false))),
        change("numerics.verify", Some(Value::Boolean(verify))),
    ]
}
