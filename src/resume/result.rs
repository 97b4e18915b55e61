//! The whole result of a run in its folder, to the bit: what the tables round nothing of, and what they leave out.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::folder;
use crate::report::files::{place, write_json};
use crate::report::{self, ReportError, RunFiles, output_files};
use crate::stamped_file::{Stamp, StampedFileError};
use gearwear_physics::results::run::RunRecord;

/// What the file says that it is.
const STAMP: Stamp = Stamp { kind: "record", format: 2 };

/// Error of a folder that is to be read as that of a run.
#[derive(Debug, thiserror::Error)]
pub enum ResultError {
    /// No folder, or one that the system does not open.
    #[error("{} cannot be read: {source}", path.display())]
    Unreadable {
        /// The folder, or the file in it.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// A folder of something else, or of a run that is not finished.
    #[error("{}: found no {file}; allowed: the folder of a finished run", folder.display())]
    NoRun {
        /// The folder.
        folder: PathBuf,
        /// File that it lacks.
        file: &'static str,
    },
    /// An unusable file.
    #[error("{}: {source}", path.display())]
    Record {
        /// The file.
        path: PathBuf,
        /// Fault of the file.
        source: StampedFileError,
    },
    /// A summary that was changed, or is of another run.
    #[error("{}: found the summary of another run than {} beside it; allowed: the files of one run, unchanged", path.display(), output_files::RECORD)]
    OtherSummary {
        /// The summary.
        path: PathBuf,
    },
}

/// Writes `record` into its folder `dir`.
pub fn write(record: &RunRecord, dir: &Path) -> Result<PathBuf, ReportError> {
    place(dir, output_files::RECORD, |out| STAMP.write(out, record))
}

/// Writes all files of `record` into `dir`, which is made if need be, with `files` beside the tables.
pub fn write_all(record: &RunRecord, files: &RunFiles, dir: &Path) -> Result<(), ReportError> {
    report::remove_summary(dir)?;
    record.inputs.iter().try_for_each(|file| folder::place(dir, &file.name, &file.bytes))?;
    report::write_files(record, files, dir)?;
    write(record, dir)?;
    report::write_summary(&record.summary, dir).map(drop)
}

/// The run in the folder `dir`, equal to what was written there.
///
/// # Errors
/// [`ResultError`]: no folder, none of a finished run, or one of another version of the program.
pub fn read(dir: &Path) -> Result<RunRecord, ResultError> {
    let unreadable = |path: &Path| {
        let path = path.to_owned();
        move |source| ResultError::Unreadable { path, source }
    };
    fs::read_dir(dir).map_err(unreadable(dir))?;
    let lacks = |file| ResultError::NoRun { folder: dir.to_owned(), file };
    let path = dir.join(output_files::SUMMARY);
    let summary = match folder::MOST.read(&path) {
        Ok(summary) => summary,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(lacks(output_files::SUMMARY)),
        Err(error) => return Err(unreadable(&path)(error)),
    };
    let file = dir.join(output_files::RECORD);
    let record: Option<RunRecord> = STAMP.read(&file).map_err(|source| ResultError::Record { path: file, source })?;
    let record = record.ok_or_else(|| lacks(output_files::RECORD))?;
    let mut written = Vec::new();
    let same = write_json(&mut written, &record.summary).is_ok() && written == summary;
    if same { Ok(record) } else { Err(ResultError::OtherSummary { path }) }
}
