//! The file of a checkpoint.
//!
//! One line of text that every version can read, then the checkpoint in postcard's format:
//!
//! ```text
//! gearwear checkpoint {"format":1,"program_version":"0.1.0","body_bytes":123456,"body_sha256":"…"}
//! ```
//!
//! Length and SHA-256 tell a file that is incomplete or edited. The program's version is checked too, as another version may compute other
//! last bits.

use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::identity::RunIdentity;
use gearwear_files::content_hash::sha256;
use gearwear_files::whole_file;
use gearwear_physics::simulation::checkpoint::Checkpoint;

/// Version of the format, raised with every change of the content.
const FORMAT: u32 = 5;
const MAGIC: &str = "gearwear checkpoint ";
const PROGRAM_VERSION: &str = env!("CARGO_PKG_VERSION");

/// A checkpoint with the run it is of.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct CheckpointFile {
    /// Scene and input files.
    pub identity: RunIdentity,
    /// Warnings given when the run began.
    pub warnings: Vec<String>,
    /// State of the run.
    pub checkpoint: Checkpoint,
}

/// File to be written.
#[derive(Serialize)]
struct CheckpointBody<'a> {
    identity: &'a RunIdentity,
    warnings: &'a [String],
    checkpoint: &'a Checkpoint,
}

#[derive(Serialize, Deserialize)]
struct CheckpointHeader {
    format: u32,
    program_version: String,
    body_bytes: usize,
    body_sha256: String,
}

/// Error of a checkpoint file.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The system cannot read it.
    #[error("it cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// Another file, or one whose first line was damaged.
    #[error("its first line is not that of a checkpoint")]
    NoCheckpoint,
    /// Written in another format.
    #[error(
        "it has format {found} (gearwear {program_version}), this program, {PROGRAM_VERSION}, reads format {FORMAT}"
    )]
    OtherFormat {
        /// Format of the file.
        found: u32,
        /// The version that wrote it.
        program_version: String,
    },
    /// Written by another version, whose results may differ in their last bits.
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

/// Replaces the checkpoint by one of the run `identity`, atomically.
pub fn write(path: &Path, identity: &RunIdentity, warnings: &[String], checkpoint: &Checkpoint) -> io::Result<()> {
    let body = postcard::to_stdvec(&CheckpointBody { identity, warnings, checkpoint }).map_err(io::Error::other)?;
    let header = CheckpointHeader {
        format: FORMAT,
        program_version: PROGRAM_VERSION.to_owned(),
        body_bytes: body.len(),
        body_sha256: sha256(&body),
    };
    whole_file::write(path, |out| {
        writeln!(out, "{MAGIC}{}", serde_json::to_string(&header)?)?;
        out.write_all(&body)
    })
}

/// Reads the checkpoint at `path`; `None` where there is none.
///
/// # Errors
/// [`CheckpointError`] where it is not one of this version, whole and unchanged.
pub fn read(path: &Path) -> Result<Option<CheckpointFile>, CheckpointError> {
    match fs::read(path) {
        Ok(bytes) => parse(&bytes).map(Some),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.into()),
    }
}

fn parse(bytes: &[u8]) -> Result<CheckpointFile, CheckpointError> {
    let end = bytes.iter().position(|&byte| byte == b'\n').ok_or(CheckpointError::NoCheckpoint)?;
    let line = std::str::from_utf8(&bytes[..end]).ok().and_then(|line| line.strip_prefix(MAGIC));
    let line = line.ok_or(CheckpointError::NoCheckpoint)?;
    let header: CheckpointHeader = serde_json::from_str(line).map_err(|_| CheckpointError::NoCheckpoint)?;
    let body = &bytes[end + 1..];
    if header.format != FORMAT {
        let CheckpointHeader { format: found, program_version, .. } = header;
        return Err(CheckpointError::OtherFormat { found, program_version });
    }
    if header.program_version != PROGRAM_VERSION {
        return Err(CheckpointError::OtherVersion { found: header.program_version });
    }
    if header.body_bytes != body.len() {
        return Err(CheckpointError::Torn { found: body.len(), said: header.body_bytes });
    }
    if header.body_sha256 != sha256(body) {
        return Err(CheckpointError::Damaged);
    }
    postcard::from_bytes(body).map_err(|_| CheckpointError::Damaged)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::PerGear;
    use gearwear_physics::mesh_cycle::Work;
    use gearwear_physics::simulation::advance::StepperState;

    fn written() -> (Vec<u8>, CheckpointFile) {
        let identity = RunIdentity::new("title = \"x\"\n".to_owned(), &[]);
        // Numbers that text would round, and those that no text format has.
        let wear_mm = PerGear { pinion: vec![0.1 + 0.2, f64::MIN_POSITIVE / 3.0], wheel: vec![-0.0, f64::INFINITY] };
        let checkpoint = Checkpoint {
            phase: 1,
            revolutions: 1.0 / 3.0,
            wear_mm,
            stepper: StepperState::default(),
            work: Work { mesh_cycles: 8, ..Work::default() },
            states: Vec::new(),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.bin");
        let warnings = vec!["beware".to_owned()];
        write(&path, &identity, &warnings, &checkpoint).unwrap();
        (fs::read(&path).unwrap(), CheckpointFile { identity, warnings, checkpoint })
    }

    #[test]
    fn a_checkpoint_comes_back_to_the_bit() {
        let (bytes, file) = written();
        let read = parse(&bytes).unwrap();
        assert_eq!(read, file);
        assert!(read.checkpoint.wear_mm.wheel[0].is_sign_negative());
    }

    #[test]
    fn whatever_was_cut_off_or_changed_is_noticed() {
        let (bytes, _) = written();
        for end in 0..bytes.len() {
            assert!(parse(&bytes[..end]).is_err(), "{end} bytes");
        }
        for at in 0..bytes.len() {
            let mut edited = bytes.clone();
            edited[at] ^= 1;
            assert!(parse(&edited).is_err(), "byte {at}");
        }
    }

    #[test]
    fn another_version_or_format_is_named() {
        let (bytes, _) = written();
        let line_end = bytes.iter().position(|&byte| byte == b'\n').unwrap();
        let line = std::str::from_utf8(&bytes[..line_end]).unwrap();
        for (from, to, said) in [
            (
                format!("\"program_version\":\"{PROGRAM_VERSION}\""),
                "\"program_version\":\"99.0.0\"",
                format!("it was written by gearwear 99.0.0, this is {PROGRAM_VERSION}"),
            ),
            (format!("\"format\":{FORMAT}"), "\"format\":99", "format 99".to_owned()),
        ] {
            assert!(line.contains(&from), "{line}");
            let edited = [line.replace(&from, to).as_bytes(), &bytes[line_end..]].concat();
            let message = parse(&edited).unwrap_err().to_string();
            assert!(message.contains(&said), "{message}");
        }
    }
}
