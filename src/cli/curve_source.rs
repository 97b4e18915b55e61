//! Reads the curve of tooth stiffness that a scene names.

use std::fs;
use std::path::Path;

use crate::gear::GearPair;
use crate::resume::identity::InputFile;
use crate::scene::Problem;
use crate::stiffness::curve::PairCompliance;
use crate::stiffness::curve_file;
use crate::stiffness::settings::StiffnessSettings;

use super::failure::{Failure, InputError, SceneProblems};
use super::scene_source::Source;

const KEY: &str = "stiffness.curve";
const ALLOWED: &str = "a data file (CSV) of the stiffness along the path of contact";
const HELP: &str = "the file lies beside the scene; gearwear schema says what stands in it";

/// The curve of `source` and its file, where its stiffness model has one; a file that is not absolute lies in `folder`.
pub fn read(folder: &Path, source: &Source) -> Result<Option<(PairCompliance, InputFile)>, Failure> {
    let scene = &source.resolved.scene;
    let (StiffnessSettings::Simon | StiffnessSettings::WangCheng, Some(name)) =
        (scene.stiffness, &scene.stiffness_curve_file)
    else {
        return Ok(None);
    };
    let refused = |what: String| {
        Failure::Scene(SceneProblems {
            name: source.name.clone(),
            text: source.text.clone(),
            problems: vec![Problem::of_named_file(&source.text, KEY, format!("{name:?}, {what}"), ALLOWED, HELP)],
        })
    };
    let path = folder.join(name);
    let bytes = fs::read(&path).map_err(|reason| refused(format!("which cannot be read: {reason}")))?;
    let text = String::from_utf8(bytes)
        .map_err(|error| refused(format!("which is not UTF-8 text: byte {}", error.utf8_error().valid_up_to())))?;
    // The pair was checked when the scene was resolved.
    let pair = GearPair::new(&scene.pair).map_err(|error| refused(format!("but {error}")))?;
    let curve = curve_file::parse(&text, &pair.path)
        .map_err(|error| InputError::Curve { name: path.display().to_string(), error })?;
    Ok(Some((curve, InputFile { key: KEY, name: name.clone(), bytes: text.into_bytes() })))
}
