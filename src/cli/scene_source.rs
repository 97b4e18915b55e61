//! Reads and resolves the scene a command is given.

use std::fs;
use std::io::{self, Read};
use std::path::Path;

use gearwear::scene::{Resolved, Scene};

use super::failure::{Failure, InputError, SceneProblems};

/// Reads the scene at `path` (`-`: standard input) and resolves it.
pub fn resolve(path: &Path) -> Result<Resolved, Failure> {
    let (name, bytes) = if path == Path::new("-") {
        let mut bytes = Vec::new();
        ("standard input".to_owned(), io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes))
    } else {
        (path.display().to_string(), fs::read(path))
    };
    let bytes = bytes.map_err(|reason| InputError::Unreadable { name: name.clone(), reason })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..byte].iter().filter(|&&b| b == b'\n').count() + 1;
        InputError::NotUtf8 { name: name.clone(), byte, line }
    })?;
    Scene::from_toml(&text).map_err(|problems| Failure::Scene(SceneProblems { name, text, problems }))
}
