//! Files read into memory whole, each kind up to a size of its own: a device, a pipe without an end and a file of zeros are refused before
//! they fill the memory.

use std::fs::{File, FileType};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Greatest size of a kind of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SizeLimit {
    /// Kind of file, with its article: "a scene".
    pub of: &'static str,
    /// Greatest size, MB of 2²⁰ bytes.
    pub megabytes: u64,
}

impl SizeLimit {
    /// Content of the file at `path`.
    ///
    /// # Errors
    /// Those of the system; [`ErrorKind::InvalidInput`] for a device, [`ErrorKind::FileTooLarge`] beyond the limit.
    pub fn read(self, path: &Path) -> io::Result<Vec<u8>> {
        let file = File::open(path)?;
        let found = file.metadata()?;
        if is_device(found.file_type()) {
            return Err(io::Error::new(ErrorKind::InvalidInput, "it is a device, not a file"));
        }
        if found.is_file() && found.len() > self.bytes() {
            return Err(self.exceeded());
        }
        self.read_from(file)
    }

    /// Content of the file at `path`, which is text.
    ///
    /// # Errors
    /// As [`Self::read`]; [`ErrorKind::InvalidData`], with its line, for a byte that is not UTF-8.
    pub fn read_to_string(self, path: &Path) -> io::Result<String> {
        String::from_utf8(self.read(path)?).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
            io::Error::new(ErrorKind::InvalidData, format!("line {line} is not UTF-8 text"))
        })
    }

    /// All that `input` gives.
    ///
    /// # Errors
    /// Those of the system; [`ErrorKind::FileTooLarge`] beyond the limit.
    pub fn read_from(self, input: impl Read) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        input.take(self.bytes() + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > self.bytes() { Err(self.exceeded()) } else { Ok(bytes) }
    }

    /// Greatest size, bytes.
    pub const fn bytes(self) -> u64 {
        self.megabytes << 20
    }

    fn exceeded(self) -> io::Error {
        io::Error::new(ErrorKind::FileTooLarge, format!("it exceeds {} MB, the most of {}", self.megabytes, self.of))
    }
}

#[cfg(unix)]
fn is_device(kind: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    kind.is_char_device() || kind.is_block_device()
}

#[cfg(not(unix))]
fn is_device(_kind: FileType) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const NOTE: SizeLimit = SizeLimit { of: "a note", megabytes: 1 };

    #[test]
    fn the_limit_itself_is_read_and_one_byte_more_is_not() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("note");
        let file = File::create(&path).unwrap();
        file.set_len(1 << 20).unwrap();
        assert_eq!(NOTE.read(&path).unwrap().len(), 1 << 20);
        file.set_len((1 << 20) + 1).unwrap();
        let error = NOTE.read(&path).unwrap_err();
        assert_eq!(
            (error.kind(), error.to_string().as_str()),
            (ErrorKind::FileTooLarge, "it exceeds 1 MB, the most of a note")
        );
        assert_eq!(NOTE.read_from(io::repeat(b'y')).unwrap_err().kind(), ErrorKind::FileTooLarge);
    }

    #[cfg(unix)]
    #[test]
    fn devices_are_refused() {
        assert_eq!(NOTE.read(Path::new("/dev/zero")).unwrap_err().to_string(), "it is a device, not a file");
    }

    #[test]
    fn text_that_is_not_utf_8_has_its_line() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("note");
        fs::write(&path, b"one\ntw\xff\n").unwrap();
        assert_eq!(NOTE.read_to_string(&path).unwrap_err().to_string(), "line 2 is not UTF-8 text");
    }
}
