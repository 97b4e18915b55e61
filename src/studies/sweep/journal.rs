//! The rows finished so far, on disk: `rows.jsonl`, one JSON object per line, the first of which says whose rows they are.
//!
//! A line is written with one call as soon as its combination is finished. A row that is verified stands there once more, and
//! the later line counts. Whatever ends the program, what is lost is at most
//! the combinations that were running; a last line that was cut short is dropped when the journal is opened again. While a
//! sweep runs it holds a lock on the file, so that a second start in the same folder is refused, where the file system
//! has locks.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::studies::sweep::record::{Shard, SweepIdentity, SweepRow};
use crate::whole_file;

/// Name of the journal in the folder of a sweep.
pub(crate) const FILE_NAME: &str = "rows.jsonl";

/// Content of a journal: its first line and, one line each, the rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct JournalContents {
    pub identity: SweepIdentity,
    /// Part of the sweep; `None`: all of it.
    pub shard: Option<Shard>,
    /// Finished rows by index.
    #[serde(skip)]
    pub rows: BTreeMap<usize, SweepRow>,
}

impl JournalContents {
    /// The row in a line; an error says why it is none of this sweep.
    pub(crate) fn row(&self, line: &str) -> Result<SweepRow, String> {
        let row: SweepRow = serde_json::from_str(line).map_err(|error| error.to_string())?;
        if row.index >= self.identity.combinations() || row.figures.len() != self.identity.figures.len() {
            return Err(format!("a row of another sweep, combination {}", row.index));
        }
        Ok(row)
    }
}

#[derive(Debug)]
pub(crate) struct Journal {
    /// Place where it is kept; `None`: in memory alone.
    kept: Option<(PathBuf, File)>,
    pub contents: JournalContents,
}

/// Reason why rows cannot be read or kept.
#[derive(Debug, thiserror::Error)]
pub(crate) enum JournalError {
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
    /// The folder was taken away while the sweep ran; the rows were written anew.
    #[error("{} was removed while the sweep ran; its {kept} finished rows were written there anew", path.display())]
    Removed {
        path: PathBuf,
        /// Rows that were written anew.
        kept: usize,
    },
    #[error("{} was removed while the sweep ran, and cannot be written anew: {source}", path.display())]
    Lost { path: PathBuf, source: io::Error },
}

impl JournalError {
    /// Fault in a line, counted from 0.
    fn damaged(path: &Path, line: usize, found: String) -> Self {
        Self::Damaged { path: path.to_owned(), line: line + 1, found }
    }

    /// Kind of the system's error, where a file cannot be read or written.
    pub(crate) fn of_system(&self) -> Option<io::ErrorKind> {
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
pub(crate) fn read(folder: &Path) -> Result<JournalContents, JournalError> {
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
    let mut lines = text.lines().enumerate();
    let Some((_, first)) = lines.next() else { return Ok(None) };
    let contents = serde_json::from_str(first);
    let mut contents: JournalContents = contents.map_err(|error| JournalError::damaged(path, 0, error.to_string()))?;
    for (line, text) in lines {
        let row = contents.row(text).map_err(|found| JournalError::damaged(path, line, found))?;
        contents.rows.insert(row.index, row);
    }
    Ok(Some(contents))
}

impl Journal {
    /// A journal that is not kept.
    pub(crate) fn in_memory(identity: &SweepIdentity, shard: Option<Shard>) -> Self {
        Self { kept: None, contents: JournalContents { identity: identity.clone(), shard, rows: BTreeMap::new() } }
    }

    /// Opens the journal of a sweep in `folder`, which is made if need be, and reads the rows it holds already.
    ///
    /// # Errors
    /// [`JournalError`] where it cannot be written, is written by another program now, or is another sweep's.
    pub(crate) fn open(folder: &Path, identity: &SweepIdentity, shard: Option<Shard>) -> Result<Self, JournalError> {
        let path = folder.join(FILE_NAME);
        let at = |source| JournalError::Open { path: path.clone(), source };
        fs::create_dir_all(folder).map_err(at)?;
        let mut file =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path).map_err(at)?;
        // A file system without locks is no reason not to run.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(JournalError::InUse { path });
        }
        let mut text = String::new();
        file.read_to_string(&mut text).map_err(at)?;
        let text = whole_lines(&text);
        let Self { contents: new, .. } = Self::in_memory(identity, shard);
        let found = parse(&path, text)?;
        let differences = found.as_ref().map_or_else(Vec::new, |found| differences(found, &new));
        if !differences.is_empty() {
            return Err(JournalError::OtherSweep { path, differences });
        }
        file.set_len(text.len() as u64).map_err(at)?;
        file.seek(SeekFrom::End(0)).map_err(at)?;
        if found.is_none() {
            file.write_all(&line_of(&new).map_err(at)?).map_err(at)?;
        }
        Ok(Self { kept: Some((path, file)), contents: found.unwrap_or(new) })
    }

    /// Appends a finished row, or one that was verified since.
    ///
    /// # Errors
    /// A full disk, or a folder that was taken away meanwhile: its rows are then written anew.
    pub(crate) fn append(&mut self, row: SweepRow) -> Result<(), JournalError> {
        let rows = &mut self.contents.rows;
        let Some((path, file)) = &mut self.kept else {
            rows.insert(row.index, row);
            return Ok(());
        };
        let kept = rows.len();
        let failed = |path: &Path, source| JournalError::Write { path: path.to_owned(), kept, source };
        let line = line_of(&row).map_err(|source| failed(path, source))?;
        let index = row.index;
        let before = rows.insert(index, row);
        // A file that was unlinked could still be written to, for nobody.
        if !path.exists() {
            return Err(write_anew(path, &self.contents));
        }
        if let Err(source) = file.write_all(&line) {
            match before {
                Some(row) => rows.insert(index, row),
                None => rows.remove(&index),
            };
            return Err(failed(path, source));
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
pub(crate) fn write(folder: &Path, contents: &JournalContents) -> io::Result<()> {
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

/// Differences between the journal and the sweep that is to be run, there and here.
fn differences(found: &JournalContents, wanted: &JournalContents) -> Vec<String> {
    let mut differences = found.identity.differences(&wanted.identity);
    if found.shard != wanted.shard {
        let [there, here] = [found.shard, wanted.shard].map(|shard| match shard {
            None => "all of it".to_owned(),
            Some(Shard { number, of }) => format!("shard {number}/{of}"),
        });
        differences.push(format!("the part that is run: {there} and {here}"));
    }
    differences
}
