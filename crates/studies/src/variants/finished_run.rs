//! A finished run, as far as it is shown beside others.

use gearwear::report::output_files;
use std::collections::BTreeMap;
use std::path::Path;

use crate::compare::run_folder::{NumberColumns, RunFolder, RunFolderError, RunFolderSummary};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::figures::MainFigure;

/// A finished run.
#[derive(Debug, Clone, PartialEq)]
pub struct FinishedRun {
    /// Name among the others: that of its folder.
    pub name: String,
    pub summary: RunFolderSummary,
    folder: RunFolder,
    /// Errors that it states of itself.
    total: TotalError,
    /// The keys of its scene, `pair.face_width_mm`, with their values as they stand there; title and who reports, which are no difference of
    /// the pair, left out.
    pub scene: BTreeMap<String, String>,
    pub mesh_cycle: NumberColumns,
    pub flanks: PerGear<NumberColumns>,
}

impl FinishedRun {
    /// Reads the folder of a finished run.
    pub fn read(folder: &Path, name: String) -> Result<Self, RunFolderError> {
        Self::of(RunFolder::open(folder)?, name)
    }

    /// Of an opened folder.
    pub fn of(folder: RunFolder, name: String) -> Result<Self, RunFolderError> {
        let mut scene = folder.scene_keys()?;
        scene.retain(|key, _| key != "title" && !key.starts_with("report."));
        Ok(Self {
            name,
            summary: folder.summary.clone(),
            total: folder.total_error()?,
            scene,
            mesh_cycle: folder.table(output_files::MESH_CYCLE)?,
            flanks: PerGear { pinion: folder.table(output_files::PINION)?, wheel: folder.table(output_files::WHEEL)? },
            folder,
        })
    }

    /// A main figure; none where the run did not compute it.
    pub fn figure(&self, figure: &MainFigure) -> Option<f64> {
        self.number(&figure.name)
    }

    /// Number at a path in the summary.
    pub fn number(&self, path: &str) -> Option<f64> {
        self.folder.number(path)
    }

    /// The relative error that the run states of a figure.
    pub fn error(&self, figure: &MainFigure) -> Option<f64> {
        figure.error(&self.total)
    }

    /// Radius and greatest wear over the face width at each point of a flank.
    pub fn wear_profile(&self, gear: Gear) -> (Vec<f64>, Vec<f64>) {
        let flank = &self.flanks[gear];
        let (points, radii, wear) = (flank.get("point"), flank.get("radius_mm"), flank.get("wear_um"));
        let count = points.iter().copied().fold(-1.0, f64::max) + 1.0;
        // A flank has no more points than rows, whatever a damaged table says.
        let count = (count as usize).min(points.len());
        let mut profile = vec![0.0_f64; count];
        for (point, wear_um) in points.iter().zip(wear) {
            if let Some(greatest) = profile.get_mut(*point as usize) {
                *greatest = greatest.max(*wear_um);
            }
        }
        (radii[..count.min(radii.len())].to_vec(), profile)
    }
}
