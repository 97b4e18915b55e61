//! Keeps the checkpoints of a run in its folder.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use super::file;
use super::folder::CHECKPOINT;
use super::identity::RunIdentity;
use gearwear_physics::simulation::checkpoint::{Checkpoint, Keeper};

/// Least time between two checkpoints.
const LEAST_INTERVAL: Duration = Duration::from_millis(250);
/// Least time between two checkpoints over the time of writing the last one.
const INTERVAL_OVER_WRITING: u32 = 20;

/// Writes checkpoints into the folder of a run, seldom enough to cost no time. A checkpoint that cannot be written does not end the run.
pub struct FolderKeeper<'a> {
    path: PathBuf,
    identity: &'a RunIdentity,
    warnings: &'a [String],
    due: Mutex<Instant>,
    failure: Mutex<Option<io::Error>>,
}

impl<'a> FolderKeeper<'a> {
    /// Keeper for the run `identity` in the folder `out`, whose user was given `warnings`.
    pub fn new(out: &Path, identity: &'a RunIdentity, warnings: &'a [String]) -> Self {
        let due = Mutex::new(Instant::now() + LEAST_INTERVAL);
        Self { path: out.join(CHECKPOINT), identity, warnings, due, failure: Mutex::new(None) }
    }

    /// The last checkpoint's file, and why it could not be written, if so.
    pub fn failure(&self) -> Option<(&Path, io::Error)> {
        let failure = self.failure.lock().ok().and_then(|mut failure| failure.take());
        failure.map(|error| (self.path.as_path(), error))
    }
}

impl Keeper for FolderKeeper<'_> {
    fn is_due(&self) -> bool {
        self.due.lock().is_ok_and(|due| Instant::now() >= *due)
    }

    fn keep(&self, checkpoint: &Checkpoint) {
        let begin = Instant::now();
        let written = file::write(&self.path, self.identity, self.warnings, checkpoint);
        if let Ok(mut failure) = self.failure.lock() {
            *failure = written.err();
        }
        if let Ok(mut due) = self.due.lock() {
            *due = Instant::now() + LEAST_INTERVAL.max(INTERVAL_OVER_WRITING * begin.elapsed());
        }
    }
}
