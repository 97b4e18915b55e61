//! The rows of a study finished so far, on disk: `rows.jsonl`, one JSON object per line, the first of which says whose rows they are.
//!
//! A line is written with one call as soon as its row is finished. A row may be written again, and the later line counts. A program that
//! ends early loses at most the rows that were being computed; an incomplete last line is dropped when the journal is opened again. A running study
//! locks the file, so that a second start in the same folder is refused, where the file system has locks.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use gearwear_files::size_limit::SizeLimit;
use gearwear_files::whole_file;

/// Name of the journal in the folder of a study.
pub const FILE_NAME: &str = "rows.jsonl";

/// Size of a line, so that a file of zeros is refused before it fills the memory.
const LINE: SizeLimit = SizeLimit { of: "a line of a journal", megabytes: 64 };

/// A study whose rows a journal keeps: what its first line says.
pub trait Kept: Clone + Debug + PartialEq + Serialize + DeserializeOwned {
    type Row: Clone + Debug + PartialEq + Serialize + DeserializeOwned;
    /// The kind of study in words.
    const KIND: &'static str;
    /// Command that writes such journals.
    const COMMAND: &'static str;

    /// Number of a row; of rows with the same number the later one counts.
    fn number(&self, row: &Self::Row) -> usize;

    /// Why a row does not belong to this study; `None` where it does.
    fn refuses(&self, row: &Self::Row) -> Option<String>;

    /// Differences between the study of the journal and the one to be run, in words, each with both values, the journal's first; empty where both
    /// are one.
    fn differences(&self, wanted: &Self) -> Vec<String>;
}

/// Contents of a journal: its first line and, one line each, the rows.
#[derive(Debug, Clone, PartialEq)]
pub struct JournalContents<K: Kept> {
    pub study: K,
    /// Finished rows by number.
    pub rows: BTreeMap<usize, K::Row>,
}

impl<K: Kept> JournalContents<K> {
    pub fn of(study: K) -> Self {
        Self { study, rows: BTreeMap::new() }
    }

    /// Row in a line; the error is the reason why it does not belong to this study.
    pub fn row(&self, line: &str) -> Result<K::Row, String> {
        let row: K::Row = serde_json::from_str(line).map_err(|error| error.to_string())?;
        match self.study.refuses(&row) {
            Some(reason) => Err(reason),
            None => Ok(row),
        }
    }
}

#[derive(Debug)]
pub struct Journal<K: Kept> {
    /// Path and file; `None`: kept in memory alone.
    kept: Option<(PathBuf, File)>,
    pub contents: JournalContents<K>,
}

/// Error of reading or writing rows.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    #[error("{} holds no {kind}: there is no {FILE_NAME} in it", folder.display())]
    NoStudy { folder: PathBuf, kind: &'static str },
    #[error("cannot open {}: {source}", path.display())]
    Open { path: PathBuf, source: io::Error },
    #[error("{}, line {line}: {found}; allowed: what {command} wrote", path.display())]
    Damaged {
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        found: String,
        command: &'static str,
    },
    /// A task or a row that is handed over.
    #[error("found {found}; allowed: tasks and rows of this sweep and this version of the program")]
    Foreign { found: String },
    #[error("{} holds the rows of another {kind}: {}", path.display(), differences.join("; "))]
    OtherStudy { path: PathBuf, kind: &'static str, differences: Vec<String> },
    #[error("{} is being written by another {command}", path.display())]
    InUse { path: PathBuf, command: &'static str },
    #[error("cannot write {}: {source}; {kept} finished rows are kept in it", path.display())]
    Write {
        path: PathBuf,
        /// Rows that were written before.
        kept: usize,
        source: io::Error,
    },
    /// The folder was removed while the study ran; the rows were written again.
    #[error("{} was removed while the study ran; its {kept} finished rows were written there anew", path.display())]
    Removed {
        path: PathBuf,
        /// Rows that were written again.
        kept: usize,
    },
    #[error("{} was removed while the study ran, and cannot be written anew: {source}", path.display())]
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
/// [`JournalError`] where there is none, or one that no such study wrote or whose first line is cut short.
pub fn read<K: Kept>(folder: &Path) -> Result<JournalContents<K>, JournalError> {
    let path = folder.join(FILE_NAME);
    let file = match File::open(&path) {
        Ok(file) => file,
        Err(source) if source.kind() == io::ErrorKind::NotFound => {
            return Err(JournalError::NoStudy { folder: folder.to_owned(), kind: K::KIND });
        }
        Err(source) => return Err(JournalError::Open { path, source }),
    };
    let (contents, _) = parse(&path, &file)?;
    let found = "a line without an end".to_owned();
    contents.ok_or(JournalError::Damaged { path, line: 1, found, command: K::COMMAND })
}

/// Reads the next line into `line`; whether there is a whole one. The error is the reason why it cannot be read.
fn next_line(file: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<bool> {
    line.clear();
    file.take(LINE.bytes() + 1).read_until(b'\n', line)?;
    match line.len() as u64 > LINE.bytes() {
        true => {
            Err(io::Error::new(io::ErrorKind::FileTooLarge, format!("more than {} MB without an end", LINE.megabytes)))
        }
        false => Ok(line.ends_with(b"\n")),
    }
}

/// The contents of a journal's whole lines, `None` where there is none, and their length in bytes; a last line that was cut short is left out.
fn parse<K: Kept>(path: &Path, file: &File) -> Result<(Option<JournalContents<K>>, u64), JournalError> {
    let mut file = BufReader::new(file);
    let mut contents: Option<JournalContents<K>> = None;
    let (mut line, mut length) = (Vec::new(), 0);
    for number in 1.. {
        let damaged = |found| JournalError::Damaged { path: path.to_owned(), line: number, found, command: K::COMMAND };
        match next_line(&mut file, &mut line) {
            Ok(true) => length += line.len() as u64,
            Ok(false) => break,
            Err(error) if error.kind() == io::ErrorKind::FileTooLarge => return Err(damaged(error.to_string())),
            Err(source) => return Err(cannot_open(path, source)),
        }
        let text = std::str::from_utf8(&line).map_err(|error| error.to_string());
        let read = text.and_then(|text| match &mut contents {
            None => {
                let first = serde_json::from_str(text).map_err(|error| error.to_string())?;
                contents = Some(JournalContents::of(first));
                Ok(())
            }
            Some(contents) => {
                contents.row(text).map(|row| drop(contents.rows.insert(contents.study.number(&row), row)))
            }
        });
        read.map_err(damaged)?;
    }
    Ok((contents, length))
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
fn begin_at<K: Kept>(file: &mut File, length: u64, new: Option<&K>) -> io::Result<()> {
    file.set_len(length)?;
    file.seek(SeekFrom::End(0))?;
    new.map_or(Ok(()), |study| file.write_all(&line_of(study)?))
}

impl<K: Kept> Journal<K> {
    /// Journal kept in memory only.
    pub fn in_memory(study: K) -> Self {
        Self { kept: None, contents: JournalContents::of(study) }
    }

    /// Opens the journal of `study` in `folder`, which is made if need be, and reads the rows it holds already.
    ///
    /// # Errors
    /// [`JournalError`] where it cannot be written, is written by another program now, or is another study's.
    pub fn open(folder: &Path, study: K) -> Result<Self, JournalError> {
        let (path, mut file) = Self::locked(folder)?;
        let (found, whole) = parse::<K>(&path, &file)?;
        let differences = found.as_ref().map_or_else(Vec::new, |found| found.study.differences(&study));
        if !differences.is_empty() {
            return Err(JournalError::OtherStudy { path, kind: K::KIND, differences });
        }
        let begun = begin_at(&mut file, whole, found.is_none().then_some(&study));
        begun.map_err(|source| cannot_open(&path, source))?;
        Ok(Self { kept: Some((path, file)), contents: found.unwrap_or_else(|| JournalContents::of(study)) })
    }

    /// File of the journal, locked.
    fn locked(folder: &Path) -> Result<(PathBuf, File), JournalError> {
        let path = folder.join(FILE_NAME);
        let file = opened(folder, &path).map_err(|source| cannot_open(&path, source))?;
        // A file system without locks does not prevent a study.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(JournalError::InUse { path, command: K::COMMAND });
        }
        Ok((path, file))
    }

    /// Appends a finished row, or one that was written again.
    ///
    /// # Errors
    /// A full disk, or a folder that was taken away meanwhile: its rows are then written anew.
    pub fn append(&mut self, row: K::Row) -> Result<(), JournalError> {
        let number = self.contents.study.number(&row);
        let rows = &mut self.contents.rows;
        let Some((path, file)) = &mut self.kept else {
            rows.insert(number, row);
            return Ok(());
        };
        let kept = rows.len();
        let line = line_of(&row).map_err(|source| JournalError::Write { path: path.clone(), kept, source })?;
        let before = rows.insert(number, row);
        // Writing to an unlinked file would succeed and be lost.
        if !path.exists() {
            return Err(write_anew(path, &self.contents));
        }
        if let Err(source) = file.write_all(&line) {
            match before {
                Some(row) => rows.insert(number, row),
                None => rows.remove(&number),
            };
            return Err(JournalError::Write { path: path.clone(), kept, source });
        }
        Ok(())
    }
}

/// Journal that rows are kept in as they are finished, until one cannot be.
pub struct RowKeeper<'a, K: Kept, F> {
    pub journal: &'a mut Journal<K>,
    /// Called with every row that is kept.
    pub tell: F,
    /// Why no row can be kept any more.
    pub error: Option<JournalError>,
}

impl<K: Kept, F: FnMut(&K::Row)> RowKeeper<'_, K, F> {
    /// Keeps a finished row, if rows can still be kept: what follows a line that was not written whole could not be read again.
    pub fn keep(&mut self, row: K::Row) -> bool {
        if self.error.is_some() {
            return false;
        }
        let number = self.journal.contents.study.number(&row);
        self.error = self.journal.append(row).err();
        if let (None, Some(row)) = (&self.error, self.journal.contents.rows.get(&number)) {
            (self.tell)(row);
        }
        self.error.is_none()
    }
}

/// Writes all rows into a new file of the old name.
fn write_anew<K: Kept>(path: &Path, contents: &JournalContents<K>) -> JournalError {
    let path = path.to_owned();
    match write(path.parent().unwrap_or(Path::new(".")), contents) {
        Ok(()) => JournalError::Removed { kept: contents.rows.len(), path },
        Err(source) => JournalError::Lost { path, source },
    }
}

/// Writes a journal whole, its rows in the order of their numbers, into `folder`, which is made if need be.
pub fn write<K: Kept>(folder: &Path, contents: &JournalContents<K>) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    whole_file::write(&folder.join(FILE_NAME), |out| {
        out.write_all(&line_of(&contents.study)?)?;
        contents.rows.values().try_for_each(|row| out.write_all(&line_of(row)?))
    })
}

fn line_of(item: &impl Serialize) -> io::Result<Vec<u8>> {
    let mut line = serde_json::to_vec(item)?;
    line.push(b'\n');
    Ok(line)
}
