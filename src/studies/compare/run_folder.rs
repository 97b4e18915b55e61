//! Files of a finished run that a comparison reads: `summary.json` and `profiles.csv`.
//!
//! `scene.toml` lies beside them; its SHA-256 is the summary's scene hash, so that a scene changed after the run is noticed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::gear::{Gear, PerGear};
use crate::scene::Resolved;

const SUMMARY: &str = "summary.json";
const PROFILES: &str = "profiles.csv";
const SCENE: &str = "scene.toml";
/// Relative difference up to which times are equal: hours and revolutions round differently.
const SAME_TIME: f64 = 1e-9;

/// Faults of the folder of a run.
#[derive(Debug, thiserror::Error)]
pub(crate) enum RunFolderError {
    #[error("{} cannot be read: {reason}; allowed: the folder of a finished gearwear run", path.display())]
    Unreadable { path: PathBuf, reason: io::Error },
    #[error("{}: stopped: found {found}; allowed: completed or limit-reached", path.display())]
    Unfinished { path: PathBuf, found: String },
    #[error("{}: found a scene with hash {found}; allowed: {allowed}, that of {SUMMARY}", path.display())]
    OtherScene { path: PathBuf, found: String, allowed: String },
    #[error("{}: line {line}: found {found}; allowed: {allowed}", path.display())]
    Damaged {
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        found: String,
        allowed: String,
    },
}

/// Fields read from the summary.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct RunFolderSummary {
    pub title: String,
    /// How long the run was, in pinion revolutions.
    pub revolutions: f64,
    program_version: String,
    scene_hash: String,
}

/// Fields read from a row of the profiles.
#[derive(Debug, Clone, Copy, Deserialize)]
struct KeptProfileRow {
    gear: Gear,
    wear_um: f64,
    revolutions: f64,
}

/// Wear of both flanks at a snapshot.
#[derive(Debug, Clone, PartialEq)]
struct FlankSnapshot {
    revolutions: f64,
    wear_um: PerGear<Vec<f64>>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RunFolder {
    path: PathBuf,
    pub summary: RunFolderSummary,
    snapshots: Vec<FlankSnapshot>,
}

impl RunFolder {
    pub(crate) fn scene_path(folder: &Path) -> PathBuf {
        folder.join(SCENE)
    }

    /// Reads the folder of a finished run.
    pub(crate) fn read(folder: &Path) -> Result<Self, RunFolderError> {
        let summary = summary(folder)?;
        let snapshots = snapshots(&folder.join(PROFILES))?;
        // The scene is resolved elsewhere, with better messages; here it must only exist.
        read(&folder.join(SCENE))?;
        Ok(Self { path: folder.to_owned(), summary, snapshots })
    }

    /// Checks that `resolved`, from the folder's scene, is the scene of the run.
    ///
    /// # Errors
    /// [`RunFolderError::OtherScene`].
    pub(crate) fn check_scene(&self, resolved: &Resolved) -> Result<(), RunFolderError> {
        let found = resolved.scene_hash();
        if found == self.summary.scene_hash {
            return Ok(());
        }
        let path = Self::scene_path(&self.path);
        Err(RunFolderError::OtherScene { path, found, allowed: self.summary.scene_hash.clone() })
    }

    /// Says that the run was made by another version of the program, if it was.
    pub(crate) fn version_warning(&self) -> Option<String> {
        let (own, its) = (env!("CARGO_PKG_VERSION"), &self.summary.program_version);
        (its != own).then(|| format!("the run was made by gearwear {its}; its scene is run again by {own}"))
    }

    /// Wear depth of each point of a flank, slice after slice, at the snapshot after `revolutions`, if there is one.
    pub(crate) fn wear_um(&self, gear: Gear, revolutions: f64) -> Option<&[f64]> {
        let mut snapshots = self.snapshots.iter();
        let found = snapshots.find(|snapshot| (snapshot.revolutions / revolutions - 1.0).abs() <= SAME_TIME);
        found.map(|snapshot| snapshot.wear_um[gear].as_slice())
    }
}

/// Fields of `S` from the summary of a finished run.
pub(crate) fn summary<S: DeserializeOwned>(folder: &Path) -> Result<S, RunFolderError> {
    #[derive(Deserialize)]
    struct StoppedSummary<S> {
        stopped: String,
        #[serde(flatten)]
        rest: S,
    }
    let path = folder.join(SUMMARY);
    let ended: StoppedSummary<S> = serde_json::from_str(&read(&path)?).map_err(|error| RunFolderError::Damaged {
        path: path.clone(),
        line: error.line() as u64,
        found: error.to_string(),
        allowed: "what gearwear run writes".to_owned(),
    })?;
    if matches!(ended.stopped.as_str(), "completed" | "limit-reached") {
        Ok(ended.rest)
    } else {
        Err(RunFolderError::Unfinished { path, found: ended.stopped })
    }
}

/// The text of a file of a run.
pub(crate) fn read(path: &Path) -> Result<String, RunFolderError> {
    fs::read_to_string(path).map_err(|reason| RunFolderError::Unreadable { path: path.to_owned(), reason })
}

/// The wear in `profiles.csv`.
fn snapshots(path: &Path) -> Result<Vec<FlankSnapshot>, RunFolderError> {
    let text = read(path)?;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut snapshots: Vec<FlankSnapshot> = Vec::new();
    for row in reader.deserialize::<KeptProfileRow>() {
        let row = row.map_err(|error| RunFolderError::Damaged {
            path: path.to_owned(),
            line: error.position().map_or(0, csv::Position::line),
            found: error.to_string(),
            allowed: "the columns gear, wear_um and revolutions as gearwear run writes them".to_owned(),
        })?;
        if snapshots.last().is_none_or(|last| last.revolutions != row.revolutions) {
            let wear_um = PerGear { pinion: Vec::new(), wheel: Vec::new() };
            snapshots.push(FlankSnapshot { revolutions: row.revolutions, wear_um });
        }
        if let Some(snapshot) = snapshots.last_mut() {
            snapshot.wear_um[row.gear].push(row.wear_um);
        }
    }
    Ok(snapshots)
}
