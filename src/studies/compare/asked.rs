//! A comparison as it is asked for, on the command line and in the library alike: the run, the measured file, and whether they fit together.

use std::path::Path;

use super::question::{Asked, Question, QuestionError};
use super::record::CompareRecord;
use super::run_folder::{RunFolder, RunFolderError};
use super::study::{self, CompareError};
use crate::gear::GearPair;
use crate::gear::error::PairError;
use crate::measurement::file;
use crate::observer::Observer;
use crate::scene::loaded::{LoadError, LoadedScene, SceneText};

/// What keeps a profile from being compared.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CompareFault {
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    RunFolder(#[from] RunFolderError),
    #[error("{name}: {error}")]
    Measured { name: String, error: QuestionError },
    #[error(transparent)]
    Pair(#[from] PairError),
}

/// A comparison that can be carried out.
#[derive(Debug)]
pub(crate) struct Prepared {
    folder: RunFolder,
    scene: LoadedScene,
    question: Question,
    /// Name of the measured file.
    measured: String,
}

impl Prepared {
    /// Of the finished run in the folder `run` with the profile in the text `measured`.
    pub(crate) fn open(run: &Path, measured: &SceneText, asked: &Asked) -> Result<Self, CompareFault> {
        let folder = RunFolder::read(run)?;
        let scene = LoadedScene::open(RunFolder::scene_path(run))?;
        let resolved = &scene.resolved;
        folder.check_scene(resolved)?;
        let refused = |error: QuestionError| CompareFault::Measured { name: measured.name.clone(), error };
        let file = file::parse(&measured.text).map_err(|error| refused(error.into()))?;
        let pair = GearPair::new(&resolved.scene.pair)?;
        let question = Question::new(asked, &file, &folder, resolved, &pair).map_err(refused)?;
        let name = Path::new(&measured.name).file_name();
        let measured = name.map_or_else(|| measured.name.clone(), |name| name.to_string_lossy().into_owned());
        Ok(Self { folder, scene, question, measured })
    }

    pub(crate) fn carry_out(&self, observer: &dyn Observer) -> Result<CompareRecord, CompareError> {
        study::run(&self.question, &self.folder, &self.scene, &self.measured, observer)
    }
}
