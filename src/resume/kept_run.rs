//! A run that is kept in a folder from its beginning on: begun there, continued from its last checkpoint, or read where it is complete.

use std::path::Path;

use super::file::CheckpointFile;
use super::folder::{self, FolderContents, FolderError};
use super::identity::RunIdentity;
use super::keeper::FolderKeeper;
use super::result::{self, ResultError};
use crate::report::{self, ReportError, RunFiles};
use crate::runs;
use crate::scene::loaded::LoadedScene;
use gearwear_physics::assessment::{Done, Resumption, RunError};
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::StopReason;

/// Error of a run that is kept in a folder.
#[derive(Debug, thiserror::Error)]
pub enum KeptRunError {
    /// A folder that the run cannot go on in.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A run that came to an end it cannot be taken beyond.
    #[error("the run in {folder} has ended before its time; nothing of it is left to do")]
    NothingLeft {
        /// The folder.
        folder: String,
    },
    /// The complete run in the folder cannot be read.
    #[error(transparent)]
    Result(#[from] ResultError),
    /// A file cannot be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// Nothing was finished.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// Runs `scene` in the folder `dir`, from the last checkpoint of the same run there, if it has one, and leaves the files of `gearwear run` there. A
/// complete run is read.
///
/// # Errors
/// [`KeptRunError`]: a folder with another run, or that cannot be written; a run that fails.
pub fn run(scene: &LoadedScene, dir: &Path, observer: &dyn Observer) -> Result<Done, KeptRunError> {
    run_with(scene, &RunFiles::default(), dir, observer)
}

/// Runs `scene` in the same way, with `files` beside the tables.
///
/// # Errors
/// As [`run`].
pub fn run_with(
    scene: &LoadedScene,
    files: &RunFiles,
    dir: &Path,
    observer: &dyn Observer,
) -> Result<Done, KeptRunError> {
    scene.check_springs()?;
    let mut scene = scene.clone().naming_copies();
    let identity = RunIdentity::new(scene.resolved.to_toml(), &scene.files.as_read);
    report::writable(dir)?;
    let from = match folder::contents(dir, &identity, &scene.resolved.scene_hash())? {
        FolderContents::Nothing | FolderContents::Begun => {
            report::create_folder(dir)?;
            folder::begin(dir, &identity, &scene.files.as_read)?;
            None
        }
        FolderContents::Checkpoint(found) => {
            let CheckpointFile { warnings, checkpoint, .. } = *found;
            scene.resolved.warnings = warnings;
            Some(checkpoint)
        }
        FolderContents::Ended(stopped) if stopped.is_complete() => {
            return Ok(Done { record: result::read(dir)?, failure: None });
        }
        FolderContents::Ended(_) => return Err(KeptRunError::NothingLeft { folder: dir.display().to_string() }),
    };
    report::remove_summary(dir)?;
    let warnings = scene.resolved.warnings.clone();
    let keeper = FolderKeeper::new(dir, &identity, &warnings);
    let done = runs::run_from(&scene, Resumption { from, keeper: &keeper }, observer)?;
    result::write_all(&done.record, files, dir)?;
    if done.record.summary.stopped != StopReason::Interrupted {
        folder::remove_checkpoint(dir)?;
    }
    Ok(done)
}
