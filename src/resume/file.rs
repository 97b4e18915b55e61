//! The file of a checkpoint, which its first line tells from others ([`stamped_file`](crate::stamped_file)).

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::identity::RunIdentity;
use crate::stamped_file::{Stamp, StampedFileError};
use gearwear_files::whole_file;
use gearwear_physics::simulation::checkpoint::Checkpoint;

/// What the file says that it is.
const STAMP: Stamp = Stamp { kind: "checkpoint", format: 6 };

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

/// Replaces the checkpoint by one of the run `identity`, atomically.
pub fn write(path: &Path, identity: &RunIdentity, warnings: &[String], checkpoint: &Checkpoint) -> io::Result<()> {
    whole_file::write(path, |out| STAMP.write(out, &CheckpointBody { identity, warnings, checkpoint }))
}

/// Reads the checkpoint at `path`; `None` where there is none.
///
/// # Errors
/// Where it is not one of this version, whole and unchanged.
pub fn read(path: &Path) -> Result<Option<CheckpointFile>, StampedFileError> {
    STAMP.read(path)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use gearwear_bodies::gear::PerGear;
    use gearwear_physics::mesh_cycle::Work;
    use gearwear_physics::mesh_cycle::over_life::PeakToPeakOverLife;
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
            over_life: PeakToPeakOverLife::default(),
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
        let read: CheckpointFile = STAMP.parse(bytes.as_slice()).unwrap();
        assert_eq!(read, file);
        assert!(read.checkpoint.wear_mm.wheel[0].is_sign_negative());
    }

    #[test]
    fn whatever_was_cut_off_or_changed_is_noticed() {
        let (bytes, _) = written();
        for end in 0..bytes.len() {
            assert!(STAMP.parse::<CheckpointFile>(&bytes[..end]).is_err(), "{end} bytes");
        }
        for at in 0..bytes.len() {
            let mut edited = bytes.clone();
            edited[at] ^= 1;
            assert!(STAMP.parse::<CheckpointFile>(edited.as_slice()).is_err(), "byte {at}");
        }
    }

    #[test]
    fn another_version_or_format_is_named() {
        let ((bytes, _), version) = (written(), env!("CARGO_PKG_VERSION"));
        let line_end = bytes.iter().position(|&byte| byte == b'\n').unwrap();
        let line = std::str::from_utf8(&bytes[..line_end]).unwrap();
        for (from, to, said) in [
            (
                format!("\"program_version\":\"{version}\""),
                "\"program_version\":\"99.0.0\"",
                format!("it was written by gearwear 99.0.0, this is {version}"),
            ),
            (format!("\"format\":{}", STAMP.format), "\"format\":99", "format 99".to_owned()),
        ] {
            assert!(line.contains(&from), "{line}");
            let edited = [line.replace(&from, to).as_bytes(), &bytes[line_end..]].concat();
            let message = STAMP.parse::<CheckpointFile>(edited.as_slice()).unwrap_err().to_string();
            assert!(message.contains(&said), "{message}");
        }
    }
}
