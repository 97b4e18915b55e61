//! A comparison as it is asked for, on the command line and in the library alike: the run, the measured files, and whether they fit together.

use std::path::Path;

use super::question::{Asked, Question, Refused};
use super::record::CompareRecord;
use super::run_folder::{RunFolder, RunFolderError};
use super::study::{self, CompareError};
use crate::gear::GearPair;
use crate::gear::error::PairError;
use crate::measurement::file;
use crate::observer::Observer;
use crate::scene::loaded::{LoadError, LoadedScene, SceneText};

/// What keeps profiles from being compared.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CompareFault {
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    RunFolder(#[from] RunFolderError),
    #[error(transparent)]
    Measured(#[from] Refused),
    #[error(transparent)]
    Pair(#[from] PairError),
}

/// A comparison that can be carried out.
#[derive(Debug)]
pub(crate) struct Prepared {
    folder: RunFolder,
    scene: LoadedScene,
    question: Question,
}

impl Prepared {
    /// Of the finished run in the folder `run` with the profiles in the texts `measured`.
    pub(crate) fn open(run: &Path, measured: &[SceneText], asked: &Asked) -> Result<Self, CompareFault> {
        let folder = RunFolder::with_snapshots(run)?;
        let scene = LoadedScene::open(folder.scene_path())?;
        let resolved = &scene.resolved;
        folder.check_scene(resolved)?;
        let parsed = |text: &SceneText| {
            let file = file::parse(&text.text);
            file.map(|file| (text.name.clone(), file))
                .map_err(|error| Refused { name: text.name.clone(), error: error.into() })
        };
        let files = measured.iter().map(parsed).collect::<Result<Vec<_>, _>>()?;
        let pair = GearPair::new(&resolved.scene.pair)?;
        let question = Question::new(asked, &files, &folder, resolved, &pair)?;
        Ok(Self { folder, scene, question })
    }

    pub(crate) fn carry_out(&self, observer: &dyn Observer) -> Result<CompareRecord, CompareError> {
        study::run(&self.question, &self.folder, &self.scene, observer)
    }
}
