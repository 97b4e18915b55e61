//! The worn flank of a finished run as the file of a measured one, which a comparison reads.
//!
//! Heights are those from the nominal involute along its normal: less the profile modifications, less the wear at the end of the run. Places are
//! roll lengths, from the root form circle to the tip.

use std::path::Path;

use crate::compare::run_folder::{RunFolder, RunFolderError};
use crate::measurement::file::{HeightFrom, ValueKind};
use crate::measurement::profile::MeasuredProfile;
use gearwear::scene::loaded::{LoadError, LoadedScene};
use gearwear_bodies::gear::error::PairError;
use gearwear_bodies::gear::{Gear, GearPair};

/// Why a flank cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    RunFolder(#[from] RunFolderError),
    #[error(transparent)]
    Pair(#[from] PairError),
    #[error(
        "{file}: found no flank points with radius_mm and wear_um; allowed: what this version of gearwear run writes"
    )]
    NoPoints { file: String },
    #[error("--width: found {found}; allowed: 0 to {face_width_mm}, the face width in mm")]
    Width { found: f64, face_width_mm: f64 },
}

/// The text of the file of a gear of the run in `folder`; of several slices, of that nearest to `width_mm`, or to the middle of the face width.
///
/// # Errors
/// A folder without a finished run, a place outside the face width.
pub fn worn_flank(folder: &Path, gear: Gear, width_mm: Option<f64>) -> Result<String, ExportError> {
    let folder = RunFolder::open(folder)?;
    let scene = LoadedScene::open(folder.scene_path())?;
    folder.check_scene(&scene.resolved)?;
    let pair = GearPair::new(&scene.resolved.scene.pair)?;
    let face_width_mm = pair.spec.face_width_mm;
    if let Some(found) = width_mm.filter(|width| !(0.0..=face_width_mm).contains(width)) {
        return Err(ExportError::Width { found, face_width_mm });
    }
    let file = format!("{}.csv", gear.name());
    let table = folder.table(&file)?;
    let [radius, width, wear] = ["radius_mm", "width_mm", "wear_um"].map(|name| table.get(name));
    let wanted = width_mm.unwrap_or(0.5 * face_width_mm);
    let nearest = width.iter().copied().min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()));
    let has_slices = scene.resolved.scene.slices.is_some();
    let tooth = &pair.teeth[gear];
    let flank = tooth.involute.radius_mm(tooth.root_form_rho_mm())..=tooth.tip_radius_mm;
    let rows = radius.iter().zip(wear).enumerate().filter(|&(row, (radius, wear))| {
        let is_in_slice = !has_slices || width.get(row).copied() == nearest;
        is_in_slice && flank.contains(&tooth.involute.signed(*radius)) && wear.is_finite()
    });
    let (rho_mm, wear_um): (Vec<f64>, Vec<f64>) =
        rows.map(|(_, (&radius, &wear))| (tooth.involute.curvature_radius_mm(radius), wear)).unzip();
    if rho_mm.is_empty() {
        return Err(ExportError::NoPoints { file });
    }
    let profile = MeasuredProfile {
        gear,
        arc_mm: rho_mm.iter().map(|&rho| tooth.involute.arc_mm(rho)).collect(),
        height_um: Vec::new(),
        kind: ValueKind::Height,
        height_from: HeightFrom::Involute,
        leads: Vec::new(),
        teeth_um: Vec::new(),
    };
    let mut text = format!("# gear = {}\n# revolutions = {}\n", gear.name(), folder.summary.revolutions);
    if let Some(width) = nearest.filter(|_| has_slices) {
        text.push_str(&format!("# width_mm = {width}\n"));
    }
    text.push_str("roll_length_mm,height_um\n");
    let design_um = profile.unworn_um(&pair, 0.0);
    let mut lines: Vec<String> = rho_mm
        .iter()
        .zip(design_um.iter().zip(&wear_um))
        // Without the sign of a zero.
        .map(|(rho, (design, wear))| format!("{:.6},{:.6}\n", rho.abs(), design - wear + 0.0))
        .collect();
    if tooth.is_internal() {
        // Roll lengths rise in a file, towards the root of an internal tooth.
        lines.reverse();
    }
    text.push_str(&lines.concat());
    Ok(text)
}
