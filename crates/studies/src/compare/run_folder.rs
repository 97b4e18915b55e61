//! Folder of a finished run: `summary.json`, `scene.toml` and the tables. The one reader for all that go on with a finished run.
//!
//! The SHA-256 of `scene.toml` is the summary's scene hash, so that a scene changed after the run is noticed.

use gearwear::report::output_files;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::Value;

use gearwear::evaluate::output::SummaryOutput;
use gearwear::scene::Resolved;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_files::size_limit::SizeLimit;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::run::ReportedBy;

/// Size of the summary and the scene of a run.
const SUMMARY: SizeLimit = SizeLimit { of: "a summary or scene of a run", megabytes: 256 };
/// Size of a table of a run, which has a row for each snapshot, slice and point.
const TABLE: SizeLimit = SizeLimit { of: "a table of a run", megabytes: 4096 };
/// Relative difference up to which times are equal: hours and revolutions round differently.
const SAME_TIME: f64 = 1e-9;

/// Faults of the folder of a run.
#[derive(Debug, thiserror::Error)]
pub enum RunFolderError {
    #[error("{} cannot be read: {reason}; allowed: the folder of a finished gearwear run", path.display())]
    Unreadable { path: PathBuf, reason: io::Error },
    #[error("{}: stopped: found {found}; allowed: completed or limit-reached", path.display())]
    Unfinished { path: PathBuf, found: String },
    #[error("{}: found a scene with hash {found}; allowed: {allowed}, that of {}", path.display(), output_files::SUMMARY)]
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
pub struct RunFolderSummary {
    pub title: String,
    pub program_version: String,
    pub scene_hash: String,
    /// Who reports, and when; none where the scene does not say it.
    pub report: Option<ReportedBy>,
    /// How long the run was, in pinion revolutions.
    pub revolutions: f64,
    stopped: String,
}

/// Columns of numbers by name; an empty field is no number.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NumberColumns(BTreeMap<String, Vec<f64>>);

impl NumberColumns {
    /// Values of a column; none where the file lacks it.
    pub fn get(&self, name: &str) -> &[f64] {
        self.0.get(name).map_or(&[], Vec::as_slice)
    }
}

/// Fields read from a row of the profiles.
#[derive(Debug, Clone, Copy, Deserialize)]
struct KeptProfileRow {
    gear: Gear,
    wear_um: f64,
    revolutions: f64,
}

/// Wear of both flanks at a snapshot, of each point slice after slice.
#[derive(Debug, Clone, PartialEq)]
struct FlankSnapshot {
    revolutions: f64,
    wear_um: PerGear<Vec<f64>>,
}

/// The folder of a finished run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunFolder {
    path: PathBuf,
    pub summary: RunFolderSummary,
    /// All of `summary.json`.
    pub whole_summary: Value,
    scene_toml: String,
    /// None where they were not asked for.
    snapshots: Vec<FlankSnapshot>,
}

impl RunFolder {
    /// Errors that the run states.
    ///
    /// # Errors
    /// A summary that states them otherwise than a run does.
    pub fn total_error(&self) -> Result<TotalError, RunFolderError> {
        TotalError::deserialize(&self.whole_summary["error"]["total"]).map_err(|error| {
            RunFolderError::damaged(&self.path.join(output_files::SUMMARY), 1, error, "what gearwear run writes")
        })
    }

    /// Reads summary and scene of a finished run; tables are read when they are asked for.
    pub fn open(folder: &Path) -> Result<Self, RunFolderError> {
        let path = folder.join(output_files::SUMMARY);
        let text = read(&path, SUMMARY)?;
        let damaged = |error: serde_json::Error| {
            RunFolderError::damaged(&path, error.line() as u64, error, "what gearwear run writes")
        };
        let summary: RunFolderSummary = serde_json::from_str(&text).map_err(damaged)?;
        if !matches!(summary.stopped.as_str(), "completed" | "limit-reached") {
            return Err(RunFolderError::Unfinished { path, found: summary.stopped });
        }
        let whole_summary = serde_json::from_str(&text).map_err(damaged)?;
        // The scene is resolved elsewhere, with better messages; here it must only exist.
        let scene_toml = read(&folder.join(output_files::SCENE), SUMMARY)?;
        Ok(Self { path: folder.to_owned(), summary, whole_summary, scene_toml, snapshots: Vec::new() })
    }

    /// Folder with the wear at the snapshots.
    pub fn with_snapshots(folder: &Path) -> Result<Self, RunFolderError> {
        let opened = Self::open(folder)?;
        let snapshots = snapshots(&folder.join(output_files::PROFILES))?;
        Ok(Self { snapshots, ..opened })
    }

    pub fn scene_path(&self) -> PathBuf {
        self.path.join(output_files::SCENE)
    }

    /// Number at a path in the summary; none where the run did not compute it.
    pub fn number(&self, path: &str) -> Option<f64> {
        SummaryOutput::find(path).ok()?.of(&self.whole_summary)
    }

    /// Checks that `resolved`, from the folder's scene, is the scene of the run.
    ///
    /// # Errors
    /// [`RunFolderError::OtherScene`].
    pub fn check_scene(&self, resolved: &Resolved) -> Result<(), RunFolderError> {
        let found = resolved.scene_hash();
        if found == self.summary.scene_hash {
            return Ok(());
        }
        Err(RunFolderError::OtherScene { path: self.scene_path(), found, allowed: self.summary.scene_hash.clone() })
    }

    /// Says that the run was made by another version of the program, if it was.
    pub fn version_warning(&self) -> Option<String> {
        let (own, its) = (env!("CARGO_PKG_VERSION"), &self.summary.program_version);
        (its != own).then(|| format!("the run was made by gearwear {its}; its scene is run again by {own}"))
    }

    /// Keys of the scene, such as `pair.face_width_mm`, with their values as written.
    pub fn scene_keys(&self) -> Result<BTreeMap<String, String>, RunFolderError> {
        let table: toml::Table = self.scene_toml.parse().map_err(|error: toml::de::Error| {
            let before = error.span().map_or(0, |span| span.start).min(self.scene_toml.len());
            let line = self.scene_toml.as_bytes()[..before].iter().filter(|&&byte| byte == b'\n').count() as u64 + 1;
            RunFolderError::damaged(&self.scene_path(), line, error.message(), THIS_VERSION)
        })?;
        let mut keys = BTreeMap::new();
        flatten("", &toml::Value::Table(table), &mut keys);
        Ok(keys)
    }

    /// The numbers of a table, such as `mesh_cycle.csv`.
    pub fn table(&self, file: &str) -> Result<NumberColumns, RunFolderError> {
        let path = self.path.join(file);
        let text = read(&path, TABLE)?;
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let refused = |error: csv::Error| RunFolderError::damaged(&path, line_of(&error), error, THIS_VERSION);
        let names: Vec<String> = reader.headers().map_err(refused)?.iter().map(str::to_owned).collect();
        let mut values: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
        for row in reader.records() {
            let row = row.map_err(refused)?;
            // A word, such as true, is no number.
            values.iter_mut().zip(&row).for_each(|(column, field)| column.push(field.parse().unwrap_or(f64::NAN)));
        }
        Ok(NumberColumns(names.into_iter().zip(values).collect()))
    }

    /// Wear depth of each point of a flank, slice after slice, at the snapshot after `revolutions`, if there is one.
    pub fn wear_um(&self, gear: Gear, revolutions: f64) -> Option<&[f64]> {
        let mut snapshots = self.snapshots.iter();
        let found = snapshots.find(|snapshot| (snapshot.revolutions / revolutions - 1.0).abs() <= SAME_TIME);
        found.map(|snapshot| snapshot.wear_um[gear].as_slice())
    }
}

const THIS_VERSION: &str = "what this version of gearwear run writes";

impl RunFolderError {
    fn damaged(path: &Path, line: u64, found: impl ToString, allowed: &str) -> Self {
        Self::Damaged { path: path.to_owned(), line, found: found.to_string(), allowed: allowed.to_owned() }
    }
}

fn line_of(error: &csv::Error) -> u64 {
    error.position().map_or(0, csv::Position::line)
}

/// The text of a file of a run.
fn read(path: &Path, most: SizeLimit) -> Result<String, RunFolderError> {
    most.read_to_string(path).map_err(|reason| RunFolderError::Unreadable { path: path.to_owned(), reason })
}

/// The wear in `profiles.csv`.
fn snapshots(path: &Path) -> Result<Vec<FlankSnapshot>, RunFolderError> {
    let text = read(path, TABLE)?;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut snapshots: Vec<FlankSnapshot> = Vec::new();
    for row in reader.deserialize::<KeptProfileRow>() {
        let allowed = "the columns gear, wear_um and revolutions as gearwear run writes them";
        let row = row.map_err(|error| RunFolderError::damaged(path, line_of(&error), error, allowed))?;
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

/// Every key below `value` with its value.
fn flatten(key: &str, value: &toml::Value, into: &mut BTreeMap<String, String>) {
    match value {
        toml::Value::Table(table) => {
            for (name, value) in table {
                let key = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
                flatten(&key, value, into);
            }
        }
        other => {
            into.insert(key.to_owned(), other.to_string());
        }
    }
}
