//! The worn flank of a finished run as the file of a measured one, which a comparison reads.
//!
//! Heights are those from the nominal involute along the transverse line of action: less the profile modifications, less the wear at the end of the run.
//! Places are roll lengths between root form circle and tip.

use std::path::Path;

use crate::compare::run_folder::{RunFolder, RunFolderError};
use gearwear::measured_flank::file::{HeightFrom, ValueKind};
use gearwear::measured_flank::mka_export;
use gearwear::measured_flank::profile::MeasuredProfile;
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

/// Format of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlankFormat {
    /// Columns under their names.
    Table,
    /// Text export of curves of a gear measuring machine.
    Mka,
}

impl FlankFormat {
    /// Format by the ending of the file's name: [`Self::Mka`] for `.mka`, upper or lower case.
    pub fn of(path: &Path) -> Self {
        match path.extension() {
            Some(ending) if ending.eq_ignore_ascii_case("mka") => Self::Mka,
            _ => Self::Table,
        }
    }
}

/// The text of the file of a gear of the run in `folder`; of several slices, of that nearest to `width_mm`, or to the middle of the face width.
///
/// # Errors
/// A folder without a finished run, a place outside the face width.
pub fn worn_flank(
    folder: &Path,
    gear: Gear,
    width_mm: Option<f64>,
    format: FlankFormat,
) -> Result<String, ExportError> {
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
    if rho_mm.len() < 2 {
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
    let scale = profile.over_normal(&pair);
    // Without the sign of a zero.
    let heights =
        profile.unworn_um(&pair, 0.0).into_iter().zip(&wear_um).map(|(design, wear)| design - scale * wear + 0.0);
    let mut height_um: Vec<f64> = heights.collect();
    let mut roll_mm: Vec<f64> = rho_mm.iter().map(|rho| rho.abs()).collect();
    if tooth.is_internal() {
        // Roll lengths rise in a file, towards the root of an internal tooth.
        roll_mm.reverse();
        height_um.reverse();
    }
    let place = nearest.filter(|_| has_slices);
    match format {
        FlankFormat::Mka => Ok(mka_export::text(&pair, gear, place.unwrap_or(wanted), &roll_mm, &height_um)),
        FlankFormat::Table => Ok(table_text(gear, folder.summary.revolutions, place, &roll_mm, &height_um)),
    }
}

/// Table of roll lengths and heights, under what it is of.
fn table_text(gear: Gear, revolutions: f64, width_mm: Option<f64>, roll_mm: &[f64], height_um: &[f64]) -> String {
    let mut text = format!("# gear = {}\n# revolutions = {revolutions}\n", gear.name());
    if let Some(width) = width_mm {
        text.push_str(&format!("# width_mm = {width}\n"));
    }
    text.push_str("roll_length_mm,height_um\n");
    roll_mm.iter().zip(height_um).for_each(|(roll, height)| text.push_str(&format!("{roll:.6},{height:.6}\n")));
    text
}
