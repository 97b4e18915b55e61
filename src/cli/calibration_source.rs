//! Reads the calibration that a scene names, and refuses one that does not belong to it.

use std::fs;
use std::path::Path;

use crate::calibration::Calibration;
use crate::gear::GearPair;
use crate::pipeline::inputs;
use crate::resume::identity::InputFile;
use crate::scene::Problem;

use super::failure::{Failure, SceneProblems};
use super::scene_source::Source;

const KEY: &str = "contact.calibration";
const ALLOWED: &str = "a file that gearwear calibrate wrote for this pair";
/// Part of a load that counts as within a range.
const ROUNDING: f64 = 1e-9;

/// The calibration of `source` and its file, where it names one; a file that is not absolute lies in `folder`. What the user should
/// know of it joins the scene's warnings.
pub fn read(folder: &Path, source: &mut Source) -> Result<Option<(Calibration, InputFile)>, Failure> {
    let Some(name) = source.resolved.scene.calibration_file.clone() else { return Ok(None) };
    let refused = |what: String, help: &str| {
        Failure::Scene(SceneProblems {
            name: source.name.clone(),
            text: source.text.clone(),
            problems: vec![Problem::of_named_file(&source.text, KEY, format!("{name:?}, {what}"), ALLOWED, help)],
        })
    };
    let path = folder.join(&name);
    let make = "gearwear calibrate SCENE --out FILE makes one";
    let bytes = fs::read(&path).map_err(|reason| refused(format!("which cannot be read: {reason}"), make))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        refused(format!("which is not UTF-8 text: byte {}", error.utf8_error().valid_up_to()), make)
    })?;
    let calibration = Calibration::from_json(&text)
        .map_err(|error| refused(format!("which is no calibration: {error}"), "calibrate anew"))?;

    let scene = &source.resolved.scene;
    // The pair was checked when the scene was resolved.
    let pair = GearPair::new(&scene.pair).map_err(|error| refused(format!("but {error}"), make))?;
    let differences = inputs::foreign(&calibration, &source.resolved);
    if !differences.is_empty() {
        let what = format!("which belongs to another pair: {}", differences.join("; "));
        return Err(refused(what, "calibrate this scene, or name the calibration that belongs to it"));
    }
    let warnings = warnings(&name, &calibration, source, &pair);
    source.resolved.warnings.extend(warnings);
    Ok(Some((calibration, InputFile { key: KEY, name, bytes: text.into_bytes() })))
}

fn warnings(name: &str, calibration: &Calibration, source: &Source, pair: &GearPair) -> Vec<String> {
    let mut warnings = Vec::new();
    let version = env!("CARGO_PKG_VERSION");
    if calibration.program_version != version {
        let made = &calibration.program_version;
        warnings.push(format!("{KEY}: {name} was made by gearwear {made}, this is {version}"));
    }
    let scene = &source.resolved.scene;
    let per_torque = 1.0 / (pair.path.involute.pinion.base_radius_mm * scene.pair.face_width_mm);
    let (least, greatest) = calibration.fitted_loads_n_per_mm();
    let loads = scene.operation.phases.iter().map(|phase| phase.pinion_torque_n_mm * per_torque);
    let is_outside = |load: &f64| *load < least * (1.0 - ROUNDING) || *load > greatest * (1.0 + ROUNDING);
    if let Some(load) = loads.into_iter().find(is_outside) {
        warnings.push(format!(
            "{KEY}: the line load of {load:.1} N/mm lies outside the loads that {name} was fitted on, {least:.1} to \
             {greatest:.1} N/mm"
        ));
    }
    warnings
}
