//! The rows finished so far, on disk: `rows.jsonl`, one JSON object per line, the first of which says whose rows they are.
//!
//! A line is written with one call as soon as its combination is finished. A verified row is written again, and the later line counts. A program that
//! ends early loses at most the combinations that were running; an incomplete last line is dropped when the journal is opened again. A running sweep
//! locks the file, so that a second start in the same folder is refused, where the file system has locks.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::sweep::record::{Shard, SweepIdentity, SweepRow};
use gearwear_files::whole_file;

/// Name of the journal in the folder of a sweep.
pub const FILE_NAME: &str = "rows.jsonl";

/// Contents of a journal: its first line and, one line each, the rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JournalContents {
    pub identity: SweepIdentity,
    /// Part of the sweep; `None`: all of it.
    pub shard: Option<Shard>,
    /// Finished rows by index.
    #[serde(skip)]
    pub rows: BTreeMap<usize, SweepRow>,
}

impl JournalContents {
    /// Row in a line; the error is the reason why it does not belong to this sweep.
    pub fn row(&self, line: &str) -> Result<SweepRow, String> {
        let row: SweepRow = serde_json::from_str(line).map_err(|error| error.to_string())?;
        if row.index >= self.identity.combinations() || row.figures.len() != self.identity.figures.len() {
            return Err(format!("a row of another sweep, combination {}", row.index));
        }
        Ok(row)
    }
}

#[derive(Debug)]
pub struct Journal {
    /// Path and file; `None`: kept in memory alone.
    kept: Option<(PathBuf, File)>,
    pub contents: JournalContents,
}

/// Error of reading or writing rows.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    #[error("{} holds no sweep: there is no {FILE_NAME} in it", folder.display())]
    NoSweep { folder: PathBuf },
    #[error("cannot open {}: {source}", path.display())]
    Open { path: PathBuf, source: io::Error },
    #[error("{}, line {line}: {found}; allowed: what gearwear sweep wrote", path.display())]
    Damaged {
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        found: String,
    },
    /// A task or a row that is handed over.
    #[error("found {found}; allowed: tasks and rows of this sweep and this version of the program")]
    Foreign { found: String },
    #[error("{} holds the rows of another sweep: {}", path.display(), differences.join("; "))]
    OtherSweep { path: PathBuf, differences: Vec<String> },
    #[error("{} is being written by another gearwear sweep", path.display())]
    InUse { path: PathBuf },
    #[error("cannot write {}: {source}; {kept} finished rows are kept in it", path.display())]
    Write {
        path: PathBuf,
        /// Rows that were written before.
        kept: usize,
        source: io::Error,
    },
    /// The folder was removed while the sweep ran; the rows were written again.
    #[error("{} was removed while the sweep ran; its {kept} finished rows were written there anew", path.display())]
    Removed {
        path: PathBuf,
        /// Rows that were written again.
        kept: usize,
    },
    #[error("{} was removed while the sweep ran, and cannot be written anew: {source}", path.display())]
    Lost { path: PathBuf, source: io::Error },
}

impl JournalError {
    /// Kind of the system's error, where a file cannot be read or written.
    pub fn of_system(&self) -> Option<io::ErrorKind> {
        match self {
            Self::Open { source, .. } | Self::Write { source, .. } | Self::Lost { source, .. } => Some(source.kind()),
            Self::InUse { .. } => Some(io::ErrorKind::WouldBlock),
            _ => None,
        }
    }
}

/// Reads the journal in `folder` without holding it.
///
/// # Errors
/// [`JournalError`] where there is none, or one that no sweep wrote.
pub fn read(folder: &Path) -> Result<JournalContents, JournalError> {
    let path = folder.join(FILE_NAME);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(source) if source.kind() == io::ErrorKind::NotFound => {
            return Err(JournalError::NoSweep { folder: folder.to_owned() });
        }
        Err(source) => return Err(JournalError::Open { path, source }),
    };
    let contents = parse(&path, whole_lines(&text))?;
    contents.ok_or_else(|| JournalError::NoSweep { folder: folder.to_owned() })
}

/// The text without a last line that was cut short.
fn whole_lines(text: &str) -> &str {
    &text[..text.rfind('\n').map_or(0, |end| end + 1)]
}

/// The contents of a journal's whole lines; `None` where there is none.
fn parse(path: &Path, text: &str) -> Result<Option<JournalContents>, JournalError> {
    let mut contents: Option<JournalContents> = None;
    for (number, line) in text.lines().enumerate() {
        let read = match &mut contents {
            None => serde_json::from_str(line).map(|first| contents = Some(first)).map_err(|error| error.to_string()),
            Some(contents) => contents.row(line).map(|row| drop(contents.rows.insert(row.index, row))),
        };
        read.map_err(|found| JournalError::Damaged { path: path.to_owned(), line: number + 1, found })?;
    }
    Ok(contents)
}

fn cannot_open(path: &Path, source: io::Error) -> JournalError {
    JournalError::Open { path: path.to_owned(), source }
}

/// Opens the file of a journal, or creates it.
fn opened(folder: &Path, path: &Path) -> io::Result<File> {
    fs::create_dir_all(folder)?;
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

/// Cuts the file after its whole lines, and writes the first line of a journal that is `new`.
fn begin_at(file: &mut File, length: usize, new: Option<&JournalContents>) -> io::Result<()> {
    file.set_len(length as u64)?;
    file.seek(SeekFrom::End(0))?;
    new.map_or(Ok(()), |contents| file.write_all(&line_of(contents)?))
}

impl Journal {
    /// Journal kept in memory only.
    pub fn in_memory(identity: &SweepIdentity, shard: Option<Shard>) -> Self {
        Self { kept: None, contents: JournalContents { identity: identity.clone(), shard, rows: BTreeMap::new() } }
    }

    /// Opens the journal of a sweep in `folder`, which is made if need be, and reads the rows it holds already.
    ///
    /// # Errors
    /// [`JournalError`] where it cannot be written, is written by another program now, or is another sweep's.
    pub fn open(folder: &Path, identity: &SweepIdentity, shard: Option<Shard>) -> Result<Self, JournalError> {
        let path = folder.join(FILE_NAME);
        let mut file = opened(folder, &path).map_err(|source| cannot_open(&path, source))?;
        // A file system without locks does not prevent a sweep.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(JournalError::InUse { path });
        }
        let text = io::read_to_string(&file).map_err(|source| cannot_open(&path, source))?;
        let text = whole_lines(&text);
        let Self { contents: new, .. } = Self::in_memory(identity, shard);
        let found = parse(&path, text)?;
        let differences = found.as_ref().map_or_else(Vec::new, |found| differences(found, &new));
        if !differences.is_empty() {
            return Err(JournalError::OtherSweep { path, differences });
        }
        let begun = begin_at(&mut file, text.len(), found.is_none().then_some(&new));
        begun.map_err(|source| cannot_open(&path, source))?;
        Ok(Self { kept: Some((path, file)), contents: found.unwrap_or(new) })
    }

    /// Appends a finished row, or one that was verified since.
    ///
    /// # Errors
    /// A full disk, or a folder that was taken away meanwhile: its rows are then written anew.
    pub fn append(&mut self, row: SweepRow) -> Result<(), JournalError> {
        let rows = &mut self.contents.rows;
        let Some((path, file)) = &mut self.kept else {
            rows.insert(row.index, row);
            return Ok(());
        };
        let kept = rows.len();
        let line = line_of(&row).map_err(|source| JournalError::Write { path: path.clone(), kept, source })?;
        let index = row.index;
        let before = rows.insert(index, row);
        // Writing to an unlinked file would succeed and be lost.
        if !path.exists() {
            return Err(write_anew(path, &self.contents));
        }
        if let Err(source) = file.write_all(&line) {
            match before {
                Some(row) => rows.insert(index, row),
                None => rows.remove(&index),
            };
            return Err(JournalError::Write { path: path.clone(), kept, source });
        }
        Ok(())
    }
}

/// Writes all rows into a new file of the old name.
fn write_anew(path: &Path, contents: &JournalContents) -> JournalError {
    let path = path.to_owned();
    match write(path.parent().unwrap_or(Path::new(".")), contents) {
        Ok(()) => JournalError::Removed { kept: contents.rows.len(), path },
        Err(source) => JournalError::Lost { path, source },
    }
}

/// Writes a journal whole, its rows in the order of the combinations, into `folder`, which is made if need be.
pub fn write(folder: &Path, contents: &JournalContents) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    whole_file::write(&folder.join(FILE_NAME), |out| {
        out.write_all(&line_of(contents)?)?;
        contents.rows.values().try_for_each(|row| out.write_all(&line_of(row)?))
    })
}

fn line_of(item: &impl Serialize) -> io::Result<Vec<u8>> {
    let mut line = serde_json::to_vec(item)?;
    line.push(b'\n');
    Ok(line)
}

/// Differences between the sweep of the journal and the one to be run, each with both values, the journal's first.
fn differences(found: &JournalContents, wanted: &JournalContents) -> Vec<String> {
    let mut differences = found.identity.differences(&wanted.identity);
    if found.shard != wanted.shard {
        let [there, here] = [found.shard, wanted.shard]
            .map(|shard| shard.map_or_else(|| "all of it".to_owned(), |s| format!("shard {}/{}", s.number, s.of)));
        differences.push(format!("the part that is run: {there} and {here}"));
    }
    differences
}
