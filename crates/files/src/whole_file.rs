//! Atomically written files: written under a temporary name in the same folder, then renamed.
//!
//! A process that is killed leaves its temporary file behind, which the next one that writes into the folder removes. Files being written are
//! locked by their process until it ends, so that leftovers are those that can be
//! locked. Between creation and locking, another process may remove a file as a leftover; its existence is therefore checked after locking,
//! and it is created again where it was removed. On a file system without locks nothing is removed. Temporary folders contain a
//! file that is locked in the same way.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::{NamedTempFile, TempDir};

/// Prefix of temporary files, followed by [`RANDOM`] letters and digits.
const PREFIX: &str = ".gearwear-";
/// Prefix of temporary folders.
const FOLDER_PREFIX: &str = "gearwear-validation-";
/// Number of random letters and digits.
const RANDOM: usize = 6;
/// Locked file in a temporary folder.
const LOCK: &str = ".in-use";

/// Writes `path` with `fill`; after an error its previous content is unchanged.
pub fn write(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = temporary(folder)?;
    let mut out = BufWriter::new(file.as_file_mut());
    fill(&mut out)?;
    out.flush()?;
    drop(out);
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

/// Temporary file in `folder` with the permissions of an ordinary new file (the umask applies); leftovers there are removed.
pub fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    for name in temporary_names(folder, PREFIX) {
        let path = folder.join(name);
        if path.symlink_metadata().is_ok_and(|found| found.is_file())
            && let Some(_held) = left_over(&path)
        {
            let _ = fs::remove_file(path);
        }
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).rand_bytes(RANDOM);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    loop {
        let file = builder.tempfile_in(folder)?;
        let _ = file.as_file().lock();
        if file.path().exists() {
            return Ok(file);
        }
    }
}

/// Temporary folder that is removed on drop, or, after its process was killed, when the next such folder is created.
#[derive(Debug)]
pub struct TemporaryFolder {
    folder: TempDir,
    _in_use: File,
}

impl TemporaryFolder {
    /// Creates a folder in the system's folder for temporary files.
    pub fn new() -> io::Result<Self> {
        let all = std::env::temp_dir();
        for name in temporary_names(&all, FOLDER_PREFIX) {
            let path = all.join(name);
            if path.symlink_metadata().is_ok_and(|found| found.is_dir())
                && let Some(_held) = left_over(&path.join(LOCK))
            {
                let _ = fs::remove_dir_all(path);
            }
        }
        loop {
            let folder = tempfile::Builder::new().prefix(FOLDER_PREFIX).rand_bytes(RANDOM).tempdir()?;
            let lock = folder.path().join(LOCK);
            let in_use = match File::create(&lock) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                created => created?,
            };
            let _ = in_use.lock();
            if lock.exists() {
                return Ok(Self { folder, _in_use: in_use });
            }
        }
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Names in `folder` with `prefix` and random characters.
fn temporary_names(folder: &Path, prefix: &str) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    names.filter(|name| name.strip_prefix(prefix).is_some_and(is_random)).collect()
}

fn is_random(rest: &str) -> bool {
    rest.len() == RANDOM && rest.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

/// File at `path`, locked until it is dropped; `None` where a process writes it.
fn left_over(path: &Path) -> Option<File> {
    let file = fs::OpenOptions::new().write(true).open(path).ok()?;
    file.try_lock().is_ok().then_some(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leftovers_go_and_what_is_in_use_stays() {
        let dir = tempfile::tempdir().unwrap();
        let [left, of_others, folder] =
            [".gearwear-aB3dE9", ".gearwear-notes.txt", ".gearwear-folder"].map(|name| dir.path().join(name));
        fs::write(&left, "half a fi").unwrap();
        fs::write(&of_others, "mine").unwrap();
        fs::create_dir(&folder).unwrap();
        let in_use = temporary(dir.path()).unwrap();
        assert!(!left.exists() && of_others.exists() && folder.exists());
        write(&dir.path().join("whole"), |out| out.write_all(b"file")).unwrap();
        assert!(in_use.path().exists());
        assert_eq!(fs::read(dir.path().join("whole")).unwrap(), b"file");
    }

    #[test]
    fn folders_in_use_stay() {
        let one = TemporaryFolder::new().unwrap();
        let other = TemporaryFolder::new().unwrap();
        assert!(one.path().exists() && other.path().exists());
    }
}
