//! Errors of mesh files, with the place, what was found and what is allowed.

use std::fmt;
use std::io;
use std::path::PathBuf;

use super::check::Inconsistency;

/// Reason why a mesh file cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
    /// The file cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// Reading needs more memory than there is.
    #[error("{}: reading it takes some {megabytes} MB of memory, more than can be had; a coarser mesh takes less", path.display())]
    Memory {
        /// Path of the file.
        path: PathBuf,
        /// Memory that reading takes, MB of 2²⁰ bytes.
        megabytes: u64,
    },
    /// The file cannot be written.
    #[error("cannot write {}", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The file name has no ending of a known format.
    #[error("{}: a mesh file ends in {allowed}", path.display())]
    Extension {
        /// Path of the file.
        path: PathBuf,
        /// Known endings.
        allowed: &'static str,
    },
    /// The content of the file is wrong.
    #[error("{}: {fault}", path.display())]
    Content {
        /// Path of the file.
        path: PathBuf,
        /// Fault with its place.
        fault: Box<FileFault>,
    },
    /// The format cannot represent the mesh.
    #[error("{}: {reason}", path.display())]
    CannotHold {
        /// Path of the file.
        path: PathBuf,
        /// Part of the mesh that cannot be represented.
        reason: Box<Unwritable>,
    },
}

/// Fault in the content of a mesh file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub struct FileFault {
    /// Place in the file; `None` for the file as a whole.
    pub place: Option<FilePosition>,
    /// Name of the section or element in the file, or empty.
    pub section: String,
    /// Kind of fault.
    pub problem: FileProblem,
}

/// Place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePosition {
    /// Line, counted from 1.
    Line(usize),
    /// Offset in bytes, counted from 0.
    Byte(usize),
}

/// Kind of fault in a mesh file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FileProblem {
    /// The content differs from what is allowed.
    #[error("found {found}, expected {expected}")]
    Unexpected {
        /// Content of the file.
        found: String,
        /// Allowed content.
        expected: String,
    },
    /// The file ends too early.
    #[error("the file ends where {expected} should follow")]
    Ended {
        /// Missing content.
        expected: String,
    },
    /// A count exceeds what the rest of the file can hold.
    #[error("{count} {what} announced, but the rest of the file holds at most {possible}")]
    Count {
        /// Name of the counted items.
        what: &'static str,
        /// Count in the file.
        count: u64,
        /// Greatest possible count.
        possible: u64,
    },
    /// The mesh would need far more memory than the length of the file.
    #[error("sets and data of this file would come to more than {limit} entries ({LARGEST_EXPANSION} for each byte)")]
    TooLarge {
        /// Number of entries allowed for a file of this length.
        limit: u64,
    },
    /// A node is not in the file, or not yet.
    #[error("node {number} does not exist; nodes must come before what refers to them")]
    NoSuchNode {
        /// Number in the file.
        number: u64,
    },
    /// An element is not in the file, or not yet.
    #[error("element {number} does not exist")]
    NoSuchElement {
        /// Number in the file.
        number: u64,
    },
    /// Two nodes or two elements have the same number.
    #[error("{what} {number} is there twice")]
    Twice {
        /// Node or element.
        what: &'static str,
        /// Number in the file.
        number: u64,
    },
    /// The content is valid but not supported.
    #[error("{what} is not supported; allowed: {allowed}")]
    Unsupported {
        /// Content of the file.
        what: String,
        /// Supported alternatives.
        allowed: String,
    },
    /// An included file cannot be read.
    #[error("the included file {file:?} cannot be read: {reason}")]
    Included {
        /// Name of the file.
        file: String,
        /// Reason.
        reason: String,
    },
    /// The content is not a consistent mesh.
    #[error(transparent)]
    Mesh(#[from] Inconsistency),
}

/// Greatest number of entries of sets and data per byte of file, far above what meshes need. As a set or a data array may
/// be given in a few bytes for the whole mesh, a short file could otherwise need any amount of memory.
pub const LARGEST_EXPANSION: u64 = 100;

/// Reason why a format cannot represent a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unwritable {
    /// The mesh is inconsistent.
    #[error(transparent)]
    Mesh(#[from] Inconsistency),
    /// A name has characters that the format does not allow.
    #[error("{format} cannot hold the name {name:?}: {rule}")]
    Name {
        /// Format.
        format: &'static str,
        /// Name in the mesh.
        name: String,
        /// Rule for names.
        rule: &'static str,
    },
    /// The format has no place for some data.
    #[error("{format} cannot hold the {what} {name:?}: {rule}")]
    Data {
        /// Format.
        format: &'static str,
        /// Kind of data.
        what: &'static str,
        /// Name of the data.
        name: String,
        /// Data that the format can represent.
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

impl fmt::Display for FileFault {
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

impl Unwritable {
    /// Data that a format has no place for.
    pub(super) fn data(format: &'static str, what: &'static str, name: &str, rule: &'static str) -> Self {
        Self::Data { format, what, name: name.to_owned(), rule }
    }
}

impl FileFault {
    /// Fault of the file as a whole.
    pub(super) fn anywhere(section: impl Into<String>, problem: impl Into<FileProblem>) -> Self {
        Self { place: None, section: section.into(), problem: problem.into() }
    }
}

impl FileProblem {
    /// Unexpected content, shortened if it is long.
    pub(super) fn unexpected(found: &str, expected: impl Into<String>) -> Self {
        const SHOWN: usize = 40;
        let mut shown: String = found.chars().take(SHOWN).collect();
        if found.chars().nth(SHOWN).is_some() {
            shown.push('…');
        }
        FileProblem::Unexpected { found: format!("{shown:?}"), expected: expected.into() }
    }

    /// Missing node of a file.
    pub(super) fn no_such_node(number: u64) -> Self {
        FileProblem::NoSuchNode { number }
    }

    /// Missing element of a file.
    pub(super) fn no_such_element(number: u64) -> Self {
        FileProblem::NoSuchElement { number }
    }
}
