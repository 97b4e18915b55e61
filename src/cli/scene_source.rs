//! Reads the file a command is given, and resolves the scene it holds.

use std::fs;
use std::io::{self, Read};
use std::path::Path;

use crate::pipeline::inputs::Inputs;
use crate::resume::identity::InputFile;
use crate::scene::{Resolved, Scene};

use super::failure::{Failure, InputError, SceneProblems};
use super::{calibration_source, curve_source};

/// The text of a file.
pub struct Text {
    /// Name of the file.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A scene with the file it came from.
pub struct Source {
    /// Name of the file.
    pub name: String,
    /// Its text.
    pub text: String,
    /// What it says.
    pub resolved: Resolved,
    /// The files it names.
    pub inputs: Inputs,
    /// The same as they were read.
    pub files: Vec<InputFile>,
}

/// Reads the text at `path` (`-`: standard input).
pub fn read(path: &Path) -> Result<Text, Failure> {
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
    Ok(Text { name, text })
}

/// Reads the scene at `path` (`-`: standard input), resolves it, and reads the files it names: relative ones lie beside
/// the scene, those of standard input in the current folder.
pub fn resolve(path: &Path) -> Result<Source, Failure> {
    let mut source = resolve_alone(path)?;
    let folder = if path == Path::new("-") { Path::new("") } else { path.parent().unwrap_or(Path::new("")) };
    if let Some((calibration, file)) = calibration_source::read(folder, &mut source)? {
        source.inputs.calibration = Some(calibration);
        source.files.push(file);
    }
    if let Some((curve, file)) = curve_source::read(folder, &source)? {
        source.inputs.stiffness_curve = Some(curve);
        source.files.push(file);
    }
    Ok(source)
}

/// The same without the files the scene names.
pub fn resolve_alone(path: &Path) -> Result<Source, Failure> {
    resolve_text(read(path)?)
}

/// Resolves the scene in a text.
pub fn resolve_text(text: Text) -> Result<Source, Failure> {
    let Text { name, text } = text;
    match Scene::from_toml(&text) {
        Ok(resolved) => Ok(Source { name, text, resolved, inputs: Inputs::default(), files: Vec::new() }),
        Err(problems) => Err(Failure::Scene(SceneProblems { name, text, problems })),
    }
}
