//! Files in the output folder: each is written under a temporary name beside it and then renamed, so that a reader sees the
//! whole file or the one before it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use gearwear_files::whole_file;

/// What keeps a report from being written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The output folder does not exist and cannot be made.
    #[error("cannot create the output folder {}", path.display())]
    CreateFolder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something that is not a folder has the output folder's name.
    #[error("{} exists and is not a folder", path.display())]
    NotAFolder {
        /// What is in the way.
        path: PathBuf,
    },
    /// A file of the output folder cannot be written.
    #[error("cannot write {}", path.display())]
    WriteFile {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Takes away `dir/name`, if it is there.
pub fn remove(dir: &Path, name: &str) -> Result<(), ReportError> {
    let path = dir.join(name);
    match fs::remove_file(&path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => Err(ReportError::WriteFile { path, source }),
        _ => Ok(()),
    }
}

/// Checks, before work starts, that files can be written into `dir`; leaves nothing behind that was not there, nor
/// what a process that was killed left.
pub fn writable(dir: &Path) -> Result<(), ReportError> {
    let missing: Vec<&Path> = dir.ancestors().take_while(|p| !p.as_os_str().is_empty() && !p.exists()).collect();
    let probed = create_folder(dir).and_then(|()| {
        whole_file::temporary(dir).map(drop).map_err(|source| ReportError::WriteFile { path: dir.into(), source })
    });
    // Deepest first. A folder that someone else has filled meanwhile is not empty, stays, and is no error of ours.
    for made in missing {
        let _ = fs::remove_dir(made);
    }
    probed
}

/// Writes a record as indented JSON. A value that is not finite becomes `null`, never `NaN`, which JSON lacks.
pub fn write_json(out: &mut dyn Write, record: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, record)?;
    writeln!(out)
}

pub fn create_folder(dir: &Path) -> Result<(), ReportError> {
    if dir.exists() && !dir.is_dir() {
        return Err(ReportError::NotAFolder { path: dir.into() });
    }
    fs::create_dir_all(dir).map_err(|source| ReportError::CreateFolder { path: dir.into(), source })
}

/// Writes `dir/name` with `fill`, whole or not at all.
pub fn place(
    dir: &Path,
    name: &str,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<PathBuf, ReportError> {
    let path = dir.join(name);
    match whole_file::write(&path, fill) {
        Ok(()) => Ok(path),
        Err(source) => Err(ReportError::WriteFile { path, source }),
    }
}
