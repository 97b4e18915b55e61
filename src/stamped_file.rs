//! Files of bytes whose first line says what they are.
//!
//! One line of text that every version can read, then the content in postcard's format:
//!
//! ```text
//! gearwear checkpoint {"format":1,"program_version":"0.1.0","body_bytes":123456,"body_sha256":"…"}
//! ```
//!
//! Length and SHA-256 tell a file that is incomplete or edited. The program's version is checked too, as bytes mean something else to another.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use gearwear_files::content_hash::sha256;

const PROGRAM_VERSION: &str = env!("CARGO_PKG_VERSION");

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
    /// Shorter or longer than its first line states.
    #[error("it is incomplete: {found} bytes where its first line says {said}")]
    Torn {
        /// Length of the file's body, bytes.
        found: usize,
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
        match fs::read(path) {
            Ok(bytes) => self.parse(&bytes).map(Some),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Content of a file with these bytes.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse<B: DeserializeOwned>(self, bytes: &[u8]) -> Result<B, StampedFileError> {
        let other_kind = StampedFileError::OtherKind(self.kind);
        let Some(end) = bytes.iter().position(|&byte| byte == b'\n') else { return Err(other_kind) };
        let magic = self.magic();
        let line = std::str::from_utf8(&bytes[..end]).ok().and_then(|line| line.strip_prefix(&magic));
        let Some(header) = line.and_then(|line| serde_json::from_str::<Header>(line).ok()) else {
            return Err(other_kind);
        };
        let body = &bytes[end + 1..];
        if header.format != self.format {
            let Header { format: found, program_version, .. } = header;
            return Err(StampedFileError::OtherFormat { found, program_version, allowed: self.format });
        }
        if header.program_version != PROGRAM_VERSION {
            return Err(StampedFileError::OtherVersion { found: header.program_version });
        }
        if header.body_bytes != body.len() {
            return Err(StampedFileError::Torn { found: body.len(), said: header.body_bytes });
        }
        if header.body_sha256 != sha256(body) {
            return Err(StampedFileError::Damaged);
        }
        postcard::from_bytes(body).map_err(|_| StampedFileError::Damaged)
    }
}
