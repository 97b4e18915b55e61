//! The files that a scene names – a calibration and a curve of tooth stiffness – read and checked against it.

use std::path::Path;
use std::sync::Arc;

use super::gear_file::InitialFlankFile;
use super::scene_text::{LoadError, SceneText};
use super::{Problem, Resolved, short_hash};
use crate::measured_flank::file::ValueKind;
use crate::measured_flank::initial;
use crate::measured_flank::teeth::{ChosenBy, TraceChoice};
use gearwear_bodies::gear::measured_flank::MeasuredFlank;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_files::size_limit::SizeLimit;
use gearwear_physics::calibration::{Calibration, identity::CalibrationIdentity};
use gearwear_physics::contact::settings::{Foundation, MatchCriterion, SurfaceKind};
use gearwear_physics::mesh_cycle::settings::Coupling;
use gearwear_physics::operation::Scene;
use gearwear_physics::stiffness::curve::PairCompliance;
use gearwear_physics::stiffness::curve_file;
use gearwear_physics::stiffness::settings::StiffnessSettings;

/// The key that names a calibration.
pub const CALIBRATION: &str = "contact.calibration";
/// The key that names a curve of tooth stiffness.
pub const CURVE: &str = "stiffness.curve";
/// The keys that name a measured flank.
pub(super) const INITIAL_FLANK: PerGear<&str> =
    PerGear { pinion: "pair.pinion.initial_flank.file", wheel: "pair.wheel.initial_flank.file" };
/// Every key that names a file.
pub(super) const KEYS: [&str; 4] = [CALIBRATION, CURVE, INITIAL_FLANK.pinion, INITIAL_FLANK.wheel];
/// Size of a file that a scene names.
const MOST: SizeLimit = SizeLimit { of: "a file that a scene names", megabytes: 64 };
/// Part of a load that counts as within a range.
const ROUNDING: f64 = 1e-9;

const CALIBRATION_ALLOWED: &str = "a file that gearwear calibrate wrote for this pair";
const MAKE_CALIBRATION: &str = "gearwear calibrate SCENE --out FILE makes one";
const CURVE_ALLOWED: &str = "a data file (CSV) of the stiffness along the path of contact";
const FLANK_ALLOWED: &str = "a measured profile of this flank, as gearwear compare reads it";
const FLANK_HELP: &str = "docs/compare.md says what stands in it; gearwear export RUN writes the worn flank of a run";
const CURVE_HELP: &str = "the file lies beside the scene; gearwear schema says what stands in it";

/// A file that a scene names.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedFile {
    /// The key that names it, such as `contact.calibration`.
    pub key: &'static str,
    /// Name as the scene gives it.
    pub name: String,
    /// Contents of the file.
    pub bytes: Vec<u8>,
}

/// The files a scene names, read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NamedFiles {
    /// `contact.calibration`.
    pub calibration: Option<Calibration>,
    /// `stiffness.curve`.
    pub stiffness_curve: Option<PairCompliance>,
    /// `initial_flank` of each gear.
    pub initial_flanks: PerGear<Option<Arc<MeasuredFlank>>>,
    /// The files as they were read.
    pub as_read: Vec<NamedFile>,
}

impl NamedFiles {
    /// Differences of the calibration's pair from that of `resolved`; empty without a calibration.
    pub fn foreign_to(&self, resolved: &Resolved) -> Vec<String> {
        self.calibration.as_ref().map_or_else(Vec::new, |calibration| foreign(calibration, resolved))
    }

    /// Hash of the calibration, the stiffness curve and the measured flanks; empty where there is none.
    pub fn hash(&self) -> String {
        let calibration = self.calibration.as_ref().map(Calibration::to_json);
        let curve = self.stiffness_curve.as_ref().map(|curve| format!("{curve:?}"));
        let flanks = Gear::BOTH.into_iter().filter_map(|gear| {
            let flank = self.initial_flanks[gear].as_ref()?;
            Some(format!("{} {flank:?}", gear.name()))
        });
        let all: String = calibration.into_iter().chain(curve).chain(flanks).collect();
        if all.is_empty() { all } else { short_hash(all.as_bytes()) }
    }

    /// Gives the pair of `resolved` its measured flanks.
    pub(super) fn put_flanks_into(&self, resolved: &mut Resolved) {
        for gear in Gear::BOTH {
            resolved.scene.pair.gears[gear].measured_flank.clone_from(&self.initial_flanks[gear]);
        }
    }

    /// Checks that `scene`, of the file with this text, lacks no file.
    pub(super) fn complete(&self, text: &str, scene: &Scene) -> Result<(), Box<Problem>> {
        if let (SurfaceKind::Winkler, Foundation::Calibrated(criterion)) =
            (scene.contact.surface, scene.contact.foundation)
        {
            let has = |criterion| self.calibration.as_ref().is_some_and(|c| c.foundation.contains_key(criterion));
            if let Some(lacking) = [&criterion, &MatchCriterion::Approach].into_iter().find(|one| !has(one)) {
                let found = match self.calibration {
                    None => "no file".to_owned(),
                    Some(_) => format!("one without K/H for the {}", lacking.name()),
                };
                return Err(Problem::at_key(text, CALIBRATION, found, CALIBRATION_ALLOWED, MAKE_CALIBRATION).into());
            }
        }
        if let StiffnessSettings::Simon | StiffnessSettings::WangCheng = scene.stiffness
            && self.stiffness_curve.is_none()
        {
            return Err(Problem::at_key(text, CURVE, "no file".to_owned(), CURVE_ALLOWED, CURVE_HELP).into());
        }
        Ok(())
    }
}

/// Bytes of the file `name` that `key` names: one that is `known`, or as it lies in `folder`.
///
/// # Errors
/// Fault of the file, in words.
fn bytes_of(folder: &Path, known: &[NamedFile], key: &str, name: &str) -> Result<Vec<u8>, String> {
    match known.iter().find(|file| file.key == key && file.name == name) {
        Some(file) => Ok(file.bytes.clone()),
        None => MOST.read(&folder.join(name)).map_err(|reason| format!("which cannot be read: {reason}")),
    }
}

/// Text of such a file.
///
/// # Errors
/// Fault of the file, in words.
fn text_of(folder: &Path, known: &[NamedFile], key: &str, name: &str) -> Result<String, String> {
    String::from_utf8(bytes_of(folder, known, key, name)?)
        .map_err(|error| format!("which is not UTF-8 text: byte {}", error.utf8_error().valid_up_to()))
}

/// Calibration named by the scene, with its file.
pub(super) fn calibration(
    folder: &Path,
    known: &[NamedFile],
    given: &SceneText,
    resolved: &Resolved,
) -> Result<Option<(Calibration, NamedFile)>, LoadError> {
    let Some(name) = resolved.scene.calibration_file.clone() else { return Ok(None) };
    let refused = |what: String, help: &str| {
        let found = format!("{name:?}, {what}");
        given.refused(vec![Problem::at_key(&given.text, CALIBRATION, found, CALIBRATION_ALLOWED, help)])
    };
    let text = text_of(folder, known, CALIBRATION, &name).map_err(|what| refused(what, MAKE_CALIBRATION))?;
    let calibration = Calibration::from_json(&text)
        .map_err(|error| refused(format!("which is no calibration: {error}"), "calibrate anew"))?;
    Ok(Some((calibration, NamedFile { key: CALIBRATION, name, bytes: text.into_bytes() })))
}

pub(super) fn of_another_pair(text: &str, name: &str, differences: &[String]) -> Problem {
    let found = format!("{name:?}, which belongs to another pair: {}", differences.join("; "));
    let help = "calibrate this scene, or name the calibration that belongs to it";
    Problem::at_key(text, CALIBRATION, found, CALIBRATION_ALLOWED, help)
}

/// Differences of the pair of `calibration` from that of the scene. Bodies of finite elements count where the scene has `fem`.
fn foreign(calibration: &Calibration, resolved: &Resolved) -> Vec<String> {
    match GearPair::new(&resolved.scene.pair) {
        Ok(pair) => {
            let own = CalibrationIdentity::of(&pair, &resolved.scene.material, &resolved.scene.fem);
            calibration.belongs_to.differences(&own, resolved.file.fem.is_some())
        }
        Err(error) => vec![error.to_string()],
    }
}

/// Warnings of a calibration that is used outside its range or by another version.
pub(super) fn warnings(name: &str, calibration: &Calibration, scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    let version = env!("CARGO_PKG_VERSION");
    if calibration.program_version != version {
        let made = &calibration.program_version;
        warnings.push(format!("{CALIBRATION}: {name} was made by gearwear {made}, this is {version}"));
    }
    let (least, greatest) = calibration.fitted_loads_n_per_mm();
    let Ok(pair) = GearPair::new(&scene.pair) else { return warnings };
    let plates = scene.slices.is_some_and(|slices| slices.coupling != Coupling::Fem);
    if plates && scene.stiffness == StiffnessSettings::Fem && calibration.slices.is_none_or(|fit| !fit.is_of(&pair)) {
        warnings.push(format!(
            "{CALIBRATION}: {name} has no slices of this helix angle and face width: their compliance is that of plate theory, in closed form"
        ));
    }
    let loads = scene.operation.phases.iter().map(|phase| pair.line_load_n_per_mm(phase.pinion_torque_n_mm));
    let is_outside = |load: &f64| *load < least * (1.0 - ROUNDING) || *load > greatest * (1.0 + ROUNDING);
    if let Some(load) = loads.into_iter().find(is_outside) {
        warnings.push(format!(
            "{CALIBRATION}: the line load of {load:.1} N/mm lies outside the loads that {name} was fitted on, {least:.1} to \
             {greatest:.1} N/mm"
        ));
    }
    warnings
}

/// Curve of tooth stiffness named by the scene, where its stiffness model has one, with its file.
pub(super) fn stiffness_curve(
    folder: &Path,
    known: &[NamedFile],
    given: &SceneText,
    resolved: &Resolved,
) -> Result<Option<(PairCompliance, NamedFile)>, LoadError> {
    let scene = &resolved.scene;
    let (StiffnessSettings::Simon | StiffnessSettings::WangCheng, Some(name)) =
        (scene.stiffness, &scene.stiffness_curve_file)
    else {
        return Ok(None);
    };
    let refused = |what: String| {
        let found = format!("{name:?}, {what}");
        given.refused(vec![Problem::at_key(&given.text, CURVE, found, CURVE_ALLOWED, CURVE_HELP)])
    };
    let text = text_of(folder, known, CURVE, name).map_err(refused)?;
    // The pair was checked when the scene was resolved.
    let pair = GearPair::new(&scene.pair).map_err(|error| refused(format!("but {error}")))?;
    let curve = curve_file::parse(&text, &pair.path)
        .map_err(|error| LoadError::Curve { name: folder.join(name).display().to_string(), error })?;
    Ok(Some((curve, NamedFile { key: CURVE, name: name.clone(), bytes: text.into_bytes() })))
}

/// Measured flank that the scene names for a gear, with its file.
pub(super) fn initial_flank(
    folder: &Path,
    known: &[NamedFile],
    given: &SceneText,
    resolved: &mut Resolved,
    gear: Gear,
) -> Result<Option<(Arc<MeasuredFlank>, NamedFile)>, LoadError> {
    let key = INITIAL_FLANK[gear];
    let Some(asked) = resolved.file.pair.gear(gear).and_then(|file| file.initial_flank.clone()) else {
        return Ok(None);
    };
    let InitialFlankFile { file: name, flank: side, tooth, width_mm, cutoff_mm } = asked;
    let refused = |what: String| {
        let found = format!("{name:?}, {what}");
        given.refused(vec![Problem::at_key(&given.text, key, found, FLANK_ALLOWED, FLANK_HELP)])
    };
    let bytes = bytes_of(folder, known, key, &name).map_err(refused)?;
    // The pair was checked when the scene was resolved.
    let pair = GearPair::new(&resolved.scene.pair).map_err(|error| refused(format!("but {error}")))?;
    let choice = TraceChoice { tooth, side, width_mm, by: ChosenBy::Keys };
    let cutoff_mm = cutoff_mm.unwrap_or_else(|| initial::default_cutoff_mm(&pair, gear));
    let read = initial::read(&bytes, &choice, cutoff_mm, &pair, gear).map_err(|error| refused(error.to_string()))?;
    let mut with_flank = resolved.scene.pair.clone();
    if read.kind == ValueKind::Height && with_flank.gears[gear].modification.has_profile_modification() {
        let keys = "tip_relief, root_relief, profile_crowning_um and profile_slope_deviation_um, which the heights have in them, are given as well";
        return Err(refused(format!("but {keys}")).into());
    }
    let uncovered = read.uncovered(&pair, gear);
    let flank = Arc::new(read.flank);
    with_flank.gears[gear].measured_flank = Some(Arc::clone(&flank));
    GearPair::new(&with_flank).map_err(|error| refused(format!("but {error}")))?;
    if let Some(ends) = uncovered {
        let beyond = "beyond, the flank deviates as at the end";
        resolved.warnings.push(format!("{key}: the profile of {name} {ends}; {beyond}"));
    }
    Ok(Some((flank, NamedFile { key, name, bytes })))
}
