//! A scene of either kind whose values are changed and which is resolved again for each of many runs.
//!
//! The text is read once. Defaults are chosen again each time; the named files and the condensed teeth in three dimensions are shared. A planetary stage is run mesh
//! by mesh, and assembled anew with each set of values.

mod pair;
mod run;
mod stage;

pub use pair::VariedPair;
pub use run::{SceneSummary, StudiedRun};
pub use stage::VariedStage;

use crate::runs;
use crate::scene::Problem;
use crate::scene::draft::Draft;
use crate::scene::loaded::LoadedScene;
use crate::scene::opened::{EachMesh, OpenedScene};
use crate::scene::planetary::mesh::StageMesh;
use gearwear_physics::assessment::{Done, RunError};
use gearwear_physics::observer::Observer;

/// A scene of either kind with values exchanged.
#[derive(Debug, Clone)]
pub enum VariedScene {
    Pair(Box<VariedPair>),
    Stage(Box<VariedStage>),
}

impl VariedScene {
    /// Scene of runs of which only the end is kept, from `given` without snapshots.
    pub fn new(given: &OpenedScene, error_estimate: bool) -> Result<Self, Vec<Problem>> {
        Ok(match given {
            OpenedScene::Pair(scene) => Self::Pair(Box::new(VariedPair::new(scene, error_estimate)?)),
            OpenedScene::Planetary(stage) => Self::Stage(Box::new(VariedStage::new(stage, error_estimate)?)),
        })
    }

    /// Each pair changed by `change`.
    fn with_each(self, change: impl Fn(VariedPair) -> VariedPair) -> Self {
        match self {
            Self::Pair(pair) => Self::Pair(Box::new(change(*pair))),
            Self::Stage(stage) => Self::Stage(Box::new(stage.with_each(change))),
        }
    }

    /// The same with the transmission error over torque, if that is `asked` for.
    pub fn with_torque_curve(self, asked: bool) -> Self {
        self.with_each(|pair| pair.with_torque_curve(asked))
    }

    /// Scene whose calibration is good for pairs that differ in their modifications alone.
    pub fn with_other_modifications(self) -> Self {
        self.with_each(VariedPair::with_other_modifications)
    }

    /// The text of the scene, as given.
    pub fn given_text(&self) -> &str {
        match self {
            Self::Pair(pair) => pair.given_text(),
            Self::Stage(stage) => stage.given_text(),
        }
    }

    fn each(&self) -> EachMesh<&VariedPair> {
        match self {
            Self::Pair(pair) => EachMesh::Pair(pair),
            Self::Stage(stage) => EachMesh::Stage(stage.meshes.as_ref()),
        }
    }

    /// Whether the pairs of `scene` are those of the scene as given but for their modifications.
    pub fn keeps_the_teeth(&self, scene: &OpenedScene) -> bool {
        let scenes = scene.each();
        self.each().all().into_iter().zip(scenes.all()).all(|(pair, scene)| pair.keeps_the_teeth(&scene.resolved))
    }

    /// Scene with these values, not verified; a key with alternatives sets all of them.
    ///
    /// # Errors
    /// Everything that is wrong with it; a file that it needs and the scene as given does not name.
    pub fn resolved<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a str, toml::Value)>,
    ) -> Result<OpenedScene, Vec<Problem>> {
        match self {
            Self::Pair(pair) => Ok(pair.variant(pair.resolved(values)?).map_err(|problem| vec![*problem])?.into()),
            Self::Stage(stage) => Ok(OpenedScene::Planetary(Box::new(stage.resolved(values)?))),
        }
    }

    /// Whether the files that the scene names were made for the pairs of `scene`.
    pub fn inputs_belong_to(&self, scene: &OpenedScene) -> Result<(), String> {
        let (pairs, scenes) = (self.each(), scene.each());
        let mut of_each = pairs.all().into_iter().zip(scenes.all());
        of_each.try_for_each(|(pair, scene)| pair.inputs_belong_to(&scene.resolved))
    }

    /// Has the pairs of `scene` verified that the scene as given has verified.
    pub fn verify_as_given(&self, scene: &mut OpenedScene) {
        let pairs = self.each();
        let mut given = pairs.all().into_iter().map(|pair| pair.is_verified());
        scene.change_each(|pair| pair.resolved.scene.verify = given.next().unwrap_or_default());
    }

    /// Runs each pair of `scene` with `run`; any error is returned as text.
    pub fn carry_out<R>(
        &self,
        scene: &OpenedScene,
        observer: &dyn Observer,
        run: impl Fn(Option<StageMesh>, &LoadedScene, &dyn Observer) -> Result<Done<R>, RunError>,
    ) -> Result<EachMesh<R>, String> {
        match scene {
            OpenedScene::Pair(scene) => {
                let run = |scene: &LoadedScene, observer: &dyn Observer| run(None, scene, observer);
                Ok(EachMesh::Pair(pair::carried_out(scene, observer, run)?))
            }
            OpenedScene::Planetary(stage) => Ok(EachMesh::Stage(stage::carried_out(stage, observer, run)?)),
        }
    }

    /// Runs `scene` as a study of many keeps it.
    pub fn run(&self, scene: &OpenedScene, observer: &dyn Observer) -> Result<StudiedRun, String> {
        let pairs = self.carry_out(scene, observer, |_, pair, observer| runs::worn_pair(pair, observer))?;
        StudiedRun::of(scene, pairs).ok_or_else(|| "a scene of another kind".to_owned())
    }
}

/// The first of `keys` that names a phase of the operation which `scene` does not have.
pub fn missing_phase(keys: impl IntoIterator<Item = String>, scene: &Draft) -> Option<String> {
    keys.into_iter().find(|key| {
        let number = key.strip_prefix("operation.phases.").and_then(|rest| rest.split('.').next());
        number.is_some_and(|number| !scene.gives(&format!("operation.phases.{number}")))
    })
}

/// All of `problems` on one line.
pub fn in_words(problems: &[Problem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
