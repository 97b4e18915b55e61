//! What can be wrong with a mesh file: where, what was found, what is allowed.

use std::fmt;
use std::io;
use std::path::PathBuf;

use super::check::Inconsistency;

/// Why a mesh file could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
    /// The system does not give the file.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The system does not take the file.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The name does not say which format.
    #[error("{}: a mesh file ends in {allowed}", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
        /// The endings known.
        allowed: &'static str,
    },
    /// What the file holds is wrong.
    #[error("{}: {fault}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        fault: Box<Fault>,
    },
    /// The format cannot hold the mesh.
    #[error("{}: {reason}", path.display())]
    CannotHold {
        /// The file that was to be written.
        path: PathBuf,
        /// What does not fit.
        reason: Box<Unwritable>,
    },
}

/// Something wrong in the content of a mesh file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub struct Fault {
    /// Where in the file; `None` where no single place is at fault.
    pub place: Option<FilePosition>,
    /// Section or element of the file, as the file calls it; empty where there is none.
    pub section: String,
    /// What is wrong.
    pub problem: Problem,
}

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePosition {
    /// A line, counted from 1.
    Line(usize),
    /// An offset in bytes, counted from 0.
    Byte(usize),
}

/// What is wrong at that place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Problem {
    /// Something else stands there than may stand there.
    #[error("found {found}, expected {expected}")]
    Unexpected {
        /// What stands there.
        found: String,
        /// What may stand there.
        expected: String,
    },
    /// The file ends too early.
    #[error("the file ends where {expected} should follow")]
    Ended {
        /// What is missing.
        expected: String,
    },
    /// A count that the rest of the file cannot hold.
    #[error("{count} {what} announced, but the rest of the file holds at most {possible}")]
    Count {
        /// What is counted.
        what: &'static str,
        /// The count in the file.
        count: u64,
        /// How many there can be.
        possible: u64,
    },
    /// The mesh would take far more memory than the file is long.
    #[error("sets and data of this file would come to more than {limit} entries ({LARGEST_EXPANSION} for each byte)")]
    TooLarge {
        /// How many entries are allowed for a file of this length.
        limit: u64,
    },
    /// A node that is not in the file, or not yet.
    #[error("node {number} does not exist; nodes must come before what refers to them")]
    NoSuchNode {
        /// Its number in the file.
        number: u64,
    },
    /// An element that is not in the file, or not yet.
    #[error("element {number} does not exist")]
    NoSuchElement {
        /// Its number in the file.
        number: u64,
    },
    /// A number given to two nodes or two elements.
    #[error("{what} {number} is there twice")]
    Twice {
        /// Node or element.
        what: &'static str,
        /// Its number in the file.
        number: u64,
    },
    /// Something valid that is not read here.
    #[error("{what} is not supported; allowed: {allowed}")]
    Unsupported {
        /// What it is.
        what: String,
        /// What can be used instead.
        allowed: String,
    },
    /// The parts do not make a mesh.
    #[error(transparent)]
    Mesh(#[from] Inconsistency),
}

/// Most entries of sets and data per byte of file: a bound on memory, far above what meshes need. A set or a data array may
/// be given in a few bytes for the whole mesh, so that without it a short file could ask for any amount.
pub const LARGEST_EXPANSION: u64 = 100;

/// Why a format cannot hold a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unwritable {
    /// The mesh contradicts itself.
    #[error(transparent)]
    Mesh(#[from] Inconsistency),
    /// A name has characters that the format has no way to write.
    #[error("{format} cannot hold the name {name:?}: {rule}")]
    Name {
        /// The format.
        format: &'static str,
        /// The name.
        name: String,
        /// What names may be.
        rule: &'static str,
    },
    /// Data the format has no place for.
    #[error("{format} cannot hold the {what} {name:?}: {rule}")]
    Data {
        /// The format.
        format: &'static str,
        /// What it is.
        what: &'static str,
        /// Its name.
        name: String,
        /// What can be held.
        rule: &'static str,
    },
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilePosition::Line(line) => write!(f, "line {line}"),
            FilePosition::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = self.place {
            write!(f, "{place}: ")?;
        }
        if !self.section.is_empty() {
            write!(f, "{}: ", self.section)?;
        }
        self.problem.fmt(f)
    }
}

impl Fault {
    /// A fault of the file as a whole.
    pub(super) fn anywhere(section: impl Into<String>, problem: impl Into<Problem>) -> Self {
        Self { place: None, section: section.into(), problem: problem.into() }
    }
}

impl Problem {
    /// Something else than expected; long findings are cut.
    pub(super) fn unexpected(found: &str, expected: impl Into<String>) -> Self {
        const SHOWN: usize = 40;
        let mut shown: String = found.chars().take(SHOWN).collect();
        if found.chars().nth(SHOWN).is_some() {
            shown.push('…');
        }
        Problem::Unexpected { found: format!("{shown:?}"), expected: expected.into() }
    }
}
