//! A comparison as it is asked for, on the command line and in the library alike: the run, the measured files, and whether they fit together.

use std::path::Path;

use super::question::{CompareOptions, ComparisonQuestion, FittedGears, Refused, scale_coefficients};
use super::record::CompareRecord;
use super::run_folder::{RunFolder, RunFolderError};
use super::study::{self, CompareError};
use gearwear::measured_flank::file::{self, MeasuredFile};
use gearwear::scene::loaded::{LoadError, LoadedScene, SceneText};
use gearwear_bodies::gear::error::PairError;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_physics::observer::Observer;

/// Why profiles cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareFault {
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
pub struct PreparedComparison {
    folder: RunFolder,
    scene: LoadedScene,
    question: ComparisonQuestion,
}

impl PreparedComparison {
    /// Of the finished run in the folder `run` with the profiles in the texts `measured`.
    pub fn open(run: &Path, measured: &[SceneText], asked: &CompareOptions) -> Result<Self, CompareFault> {
        let mut files = Vec::with_capacity(measured.len());
        for SceneText { name, text } in measured {
            let file = file::parse(text, &asked.traces)
                .map_err(|error| Refused { name: name.clone(), error: error.into() })?;
            files.push((name.clone(), file));
        }
        Self::of_files(run, &files, asked)
    }

    /// Of the finished run in the folder `run` with measured files and their names.
    pub fn of_files(
        run: &Path,
        files: &[(String, MeasuredFile)],
        asked: &CompareOptions,
    ) -> Result<Self, CompareFault> {
        let folder = RunFolder::with_snapshots(run)?;
        let scene = LoadedScene::open(folder.scene_path())?;
        let resolved = &scene.resolved;
        folder.check_scene(resolved)?;
        let pair = GearPair::new(&resolved.scene.pair)?;
        let question = ComparisonQuestion::new(asked, files, &folder, resolved, &pair)?;
        Ok(Self { folder, scene, question })
    }

    /// The same with `factor` times the wear coefficients of `gear`, which is not measured: those of its mate are fitted alone.
    pub fn with_mate(mut self, gear: Gear, factor: f64) -> Self {
        scale_coefficients(&mut self.scene.resolved.scene, gear, factor);
        self.question.fitted = FittedGears::Alone(gear.mate());
        // The wear that the run kept is that of its own coefficients.
        self.question.profiles.iter_mut().for_each(|of| of.as_run_um = None);
        self
    }

    pub fn carry_out(&self, observer: &dyn Observer) -> Result<CompareRecord, CompareError> {
        study::run(&self.question, &self.folder, &self.scene, observer)
    }
}
