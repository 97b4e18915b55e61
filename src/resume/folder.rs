//! The folder of a run, from its beginning on.
//!
//! What is there at any moment, also when the program is killed between two files, must not pass for something else. The order of
//! the beginning: the checkpoint of an earlier run goes first, then come input files and scene, and last goes the summary, which
//! counts only beside a scene of its own hash.

use crate::report::output_files;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::file::{self, CheckpointFile};
use super::identity::{RunIdentity, between_scenes};
use crate::report::ReportError;
use crate::scene::loaded::NamedFile;
use crate::stamped_file::StampedFileError;
use gearwear_files::size_limit::SizeLimit;
use gearwear_files::whole_file;
use gearwear_physics::results::run::StopReason;

/// Size of the scene and the summary of a run.
pub(crate) const MOST: SizeLimit = SizeLimit { of: "a file of a run", megabytes: 256 };
/// The last checkpoint.
pub const CHECKPOINT: &str = "checkpoint.bin";

/// Contents of the folder of a run.
#[derive(Debug, PartialEq)]
pub enum FolderContents {
    /// No run.
    Nothing,
    /// A run without a checkpoint yet.
    Begun,
    /// A run that can be continued.
    Checkpoint(Box<CheckpointFile>),
    /// A run that has ended.
    Ended(StopReason),
}

/// Reason why the run in a folder cannot be continued.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// An unusable checkpoint.
    #[error("{}: {source}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// Fault of the file.
        source: StampedFileError,
    },
    /// The run of another scene, or of other input files.
    #[error("{} holds the run of another scene: {}", path.display(), differences.join("; "))]
    OtherRun {
        /// File of the other run.
        path: PathBuf,
        /// Differences, there and here.
        differences: Vec<String>,
    },
    /// The system cannot read a file.
    #[error("{} cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
}

/// Begins the run of `identity` in the existing folder `dir`, with copies of its input files; the checkpoint of an earlier run is removed first.
pub fn begin(dir: &Path, identity: &RunIdentity, files: &[NamedFile]) -> Result<(), ReportError> {
    remove_checkpoint(dir)?;
    files.iter().try_for_each(|file| place(dir, &file.name, &file.bytes))?;
    place(dir, output_files::SCENE, identity.scene_toml.as_bytes())
}

/// Writes the file `name` in `dir`, in a folder within it if its name says so.
pub fn place(dir: &Path, name: &str, bytes: &[u8]) -> Result<(), ReportError> {
    let path = dir.join(name);
    let written = path.parent().map_or(Ok(()), fs::create_dir_all);
    written
        .and_then(|()| whole_file::write(&path, |out| out.write_all(bytes)))
        .map_err(|source| ReportError::WriteFile { path, source })
}

/// Removes the files that [`begin`] put into `dir`, with input files of these names; what cannot be removed stays.
pub fn abandon(dir: &Path, files: &[String]) {
    for path in files.iter().map(String::as_str).chain([output_files::SCENE]).map(|name| dir.join(name)) {
        let _ = fs::remove_file(&path);
        if let Some(folder) = path.parent().filter(|folder| *folder != dir) {
            // Removed if empty.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Removes the checkpoint in `dir`, if there is one.
pub fn remove_checkpoint(dir: &Path) -> Result<(), ReportError> {
    let path = dir.join(CHECKPOINT);
    match fs::remove_file(&path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => Err(ReportError::WriteFile { path, source }),
        _ => Ok(()),
    }
}

/// Contents of `dir`, of the run of `identity` with the scene hash `scene_hash`.
pub fn contents(dir: &Path, identity: &RunIdentity, scene_hash: &str) -> Result<FolderContents, FolderError> {
    let Some(scene_toml) = read(&dir.join(output_files::SCENE))? else { return Ok(FolderContents::Nothing) };
    refuse_other_run(&dir.join(output_files::SCENE), between_scenes(&scene_toml, &identity.scene_toml))?;
    if let Some(stopped) = read(&dir.join(output_files::SUMMARY))?.and_then(|text| stopped(&text, scene_hash))
        && stopped != StopReason::Interrupted
    {
        return Ok(FolderContents::Ended(stopped));
    }
    let path = dir.join(CHECKPOINT);
    match file::read(&path) {
        Ok(None) => Ok(FolderContents::Begun),
        Ok(Some(found)) => {
            refuse_other_run(&path, found.identity.differences(identity))?;
            Ok(FolderContents::Checkpoint(Box::new(found)))
        }
        Err(source) => Err(FolderError::Checkpoint { path, source }),
    }
}

fn refuse_other_run(path: &Path, differences: Vec<String>) -> Result<(), FolderError> {
    match differences.is_empty() {
        true => Ok(()),
        false => Err(FolderError::OtherRun { path: path.to_owned(), differences }),
    }
}

/// The text of a file; `None` where there is none.
fn read(path: &Path) -> Result<Option<String>, FolderError> {
    match MOST.read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source) => Err(FolderError::Unreadable { path: path.to_owned(), source }),
    }
}

/// How the run of a summary ended; `None` where it is none of the scene.
fn stopped(summary: &str, scene_hash: &str) -> Option<StopReason> {
    let summary: serde_json::Value = serde_json::from_str(summary).ok()?;
    let is_own = summary["scene_hash"] == scene_hash;
    is_own.then(|| StopReason::deserialize(&summary["stopped"]).ok()).flatten()
}
