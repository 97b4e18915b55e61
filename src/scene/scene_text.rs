//! The text of a scene file, and the errors of opening one.

use std::fmt;
use std::io;
use std::path::Path;

use super::{Problem, Resolved};
use gearwear_files::size_limit::SizeLimit;
use gearwear_files::text::decode;
use gearwear_physics::stiffness::curve_file::CurveFileError;

/// Size of a scene or a problem of finite elements.
const SCENE: SizeLimit = SizeLimit { of: "a scene", megabytes: 4 };
/// Size of a file of another program, such as a measured profile.
const FOREIGN: SizeLimit = SizeLimit { of: "a measured file", megabytes: 64 };

/// Text of a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneText {
    /// Name of the file, as messages give it.
    pub name: String,
    /// Text of the file.
    pub text: String,
}

/// Problems of a scene file, with its text.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error("{}", self.in_words())]
pub struct SceneError {
    /// Scene file.
    pub given: SceneText,
    /// Problems, at least one.
    pub problems: Vec<Problem>,
}

/// Display in place of the whole file: a program that returns the error from `main` shows the problems.
impl fmt::Debug for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words())
    }
}

impl SceneError {
    /// The line of the text, from 1, where `problem` begins.
    pub fn line_of(&self, problem: &Problem) -> usize {
        let text = self.given.text.as_bytes();
        let begin = problem.span.as_ref().map_or(0, |span| span.start).min(text.len());
        text[..begin].iter().filter(|&&byte| byte == b'\n').count() + 1
    }

    fn in_words(&self) -> String {
        let lines = self.problems.iter().map(|problem| {
            let help = problem.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
            format!("{}, line {}: {problem}{help}", self.given.name, self.line_of(problem))
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

/// Failure of opening a scene.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error("{name} cannot be read: {reason}")]
    Unreadable {
        /// Name of the file.
        name: String,
        /// The system's reason.
        reason: io::Error,
    },
    /// The file is not UTF-8 text.
    #[error("{name} is not UTF-8 text: byte {byte}, line {line}")]
    NotUtf8 {
        /// Name of the file.
        name: String,
        /// Offset of the first byte that is no text.
        byte: usize,
        /// Line of that byte, from 1.
        line: usize,
    },
    /// The scene is wrong, or names a file that is not what it should be.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The curve of tooth stiffness that the scene names cannot be read as one.
    #[error("{name}: {error}")]
    Curve {
        /// Name of the file.
        name: String,
        /// Fault of the file.
        error: CurveFileError,
    },
}

impl SceneText {
    /// Reads the text at `path` (`-`: standard input).
    pub fn read(path: &Path) -> Result<Self, LoadError> {
        let (name, bytes) = read_bytes(path, SCENE)?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let byte = error.utf8_error().valid_up_to();
            let line = error.as_bytes()[..byte].iter().filter(|&&b| b == b'\n').count() + 1;
            LoadError::NotUtf8 { name: name.clone(), byte, line }
        })?;
        Ok(Self { name, text })
    }

    /// Reads a text of another program at `path` (`-`: standard input), in the encoding it has.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read_foreign(path: &Path) -> Result<Self, LoadError> {
        let (name, bytes) = read_bytes(path, FOREIGN)?;
        Ok(Self { name, text: decode(&bytes) })
    }

    /// Resolves the scene it holds; the files it names stay unread.
    pub fn resolve(&self) -> Result<Resolved, SceneError> {
        Resolved::from_toml(&self.text).map_err(|problems| self.refused(problems))
    }

    /// Error with these problems.
    pub fn refused(&self, problems: Vec<Problem>) -> SceneError {
        SceneError { given: self.clone(), problems }
    }
}

/// Name and bytes of the file at `path` (`-`: standard input).
fn read_bytes(path: &Path, most: SizeLimit) -> Result<(String, Vec<u8>), LoadError> {
    let (name, bytes) = if path == Path::new("-") {
        ("standard input".to_owned(), most.read_from(io::stdin().lock()))
    } else {
        (path.display().to_string(), most.read(path))
    };
    match bytes {
        Ok(bytes) => Ok((name, bytes)),
        Err(reason) => Err(LoadError::Unreadable { name, reason }),
    }
}

/// Folder of the files named in the scene at `path`.
pub(crate) fn folder_of(path: &Path) -> &Path {
    if path == Path::new("-") { Path::new("") } else { path.parent().unwrap_or(Path::new("")) }
}
