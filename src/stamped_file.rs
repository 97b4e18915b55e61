//! Files of bytes whose first line says what they are.
//!
//! One line of text that every version can read, then the content in postcard's format:
//!
//! ```text
//! gearwear checkpoint {"format":1,"program_version":"0.1.0","body_bytes":123456,"body_sha256":"…"}
//! ```
//!
//! Length and SHA-256 tell a file that is incomplete or edited. The program's version is checked too, as bytes mean something else to another.

use std::cmp::Ordering;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use gearwear_files::content_hash::sha256;

const PROGRAM_VERSION: &str = env!("CARGO_PKG_VERSION");
/// Greatest length of the first line, bytes.
const FIRST_LINE: u64 = 4096;

/// A kind of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// Word of the first line: `checkpoint`.
    pub kind: &'static str,
    /// Version of the content, raised with every change of it.
    pub format: u32,
}

#[derive(Serialize, Deserialize)]
struct Header {
    format: u32,
    program_version: String,
    body_bytes: usize,
    body_sha256: String,
}

/// Error of such a file.
#[derive(Debug, thiserror::Error)]
pub enum StampedFileError {
    /// The system cannot read it.
    #[error("it cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// Another file, or one whose first line was damaged.
    #[error("its first line is not that of a {0}")]
    OtherKind(&'static str),
    /// Written in another format.
    #[error(
        "it has format {found} (gearwear {program_version}), this program, {PROGRAM_VERSION}, reads format {allowed}"
    )]
    OtherFormat {
        /// Format of the file.
        found: u32,
        /// The version that wrote it.
        program_version: String,
        /// Format that is read.
        allowed: u32,
    },
    /// Written by another version.
    #[error("it was written by gearwear {found}, this is {PROGRAM_VERSION}")]
    OtherVersion {
        /// The version that wrote it.
        found: String,
    },
    /// Shorter than its first line states.
    #[error("it is incomplete: {found} bytes where its first line says {said}")]
    Torn {
        /// Length of the file's body, bytes.
        found: usize,
        /// Length stated in the first line, bytes.
        said: usize,
    },
    /// Longer than its first line states.
    #[error("it is longer than the {said} bytes that its first line says")]
    Longer {
        /// Length stated in the first line, bytes.
        said: usize,
    },
    /// Damaged content.
    #[error("it is damaged: its content has another SHA-256 than its first line says")]
    Damaged,
}

impl Stamp {
    fn magic(self) -> String {
        format!("gearwear {} ", self.kind)
    }

    /// Writes a file of this kind with the content `body`.
    pub fn write(self, out: &mut dyn Write, body: &impl Serialize) -> io::Result<()> {
        let body = postcard::to_stdvec(body).map_err(io::Error::other)?;
        let header = Header {
            format: self.format,
            program_version: PROGRAM_VERSION.to_owned(),
            body_bytes: body.len(),
            body_sha256: sha256(&body),
        };
        writeln!(out, "{}{}", self.magic(), serde_json::to_string(&header)?)?;
        out.write_all(&body)
    }

    /// Content of the file at `path`; `None` where there is none.
    ///
    /// # Errors
    /// [`StampedFileError`] where it is not one of this kind and version, whole and unchanged.
    pub fn read<B: DeserializeOwned>(self, path: &Path) -> Result<Option<B>, StampedFileError> {
        match File::open(path) {
            Ok(file) => self.parse(BufReader::new(file)).map(Some),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Content of what `input` gives: no more of it is read than its first line states, and one byte.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse<B: DeserializeOwned>(self, mut input: impl BufRead) -> Result<B, StampedFileError> {
        let header = self.header(&mut input)?;
        if header.format != self.format {
            let Header { format: found, program_version, .. } = header;
            return Err(StampedFileError::OtherFormat { found, program_version, allowed: self.format });
        }
        if header.program_version != PROGRAM_VERSION {
            return Err(StampedFileError::OtherVersion { found: header.program_version });
        }
        let mut body = Vec::new();
        input.take((header.body_bytes as u64).saturating_add(1)).read_to_end(&mut body)?;
        let (found, said) = (body.len(), header.body_bytes);
        match found.cmp(&said) {
            Ordering::Less => return Err(StampedFileError::Torn { found, said }),
            Ordering::Greater => return Err(StampedFileError::Longer { said }),
            Ordering::Equal => {}
        }
        if header.body_sha256 != sha256(&body) {
            return Err(StampedFileError::Damaged);
        }
        postcard::from_bytes(&body).map_err(|_| StampedFileError::Damaged)
    }

    /// The first line.
    fn header(self, input: &mut impl BufRead) -> Result<Header, StampedFileError> {
        let mut first = Vec::new();
        input.take(FIRST_LINE).read_until(b'\n', &mut first)?;
        let line = std::str::from_utf8(&first).ok().and_then(|line| line.strip_suffix('\n'));
        let json = line.and_then(|line| line.strip_prefix(&self.magic()));
        json.and_then(|json| serde_json::from_str(json).ok()).ok_or(StampedFileError::OtherKind(self.kind))
    }
}
