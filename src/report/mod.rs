//! The files a run leaves behind, written from its [`RunRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `summary.json` | [`summary`] |
//! | `pinion.csv`, `wheel.csv`, `history.csv`, `profiles.csv`, `mesh_cycle.csv` | [`tables`] |
//! | `slices.csv`, `flank.vtu` | [`slice_table`], [`flank_mesh`]; only where the sections of the pair differ |
//! | `scene.toml` | the resolved scene, byte for byte, so that its SHA-256 begins with the scene hash |
//! | `report.html` | [`html`] |
//!
//! Each file is written under a temporary name in the same folder and then renamed: a reader sees the whole file or
//! the one before it. `summary.json` comes last, so that its presence says the others are complete.

pub mod calibration;
pub mod chart;
pub mod csv_table;
pub mod fem;
pub mod fem_pair;
pub mod flank_mesh;
pub mod html;
pub mod slice_table;
pub mod summary;
pub mod tables;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use self::csv_table::{Provenance, table};
use crate::gear::Gear;
use crate::results::run::{RunRecord, Summary};
use crate::whole_file;

/// What keeps a report from being written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The output folder does not exist and cannot be made.
    #[error("cannot create the output folder {}", path.display())]
    CreateFolder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something that is not a folder has the output folder's name.
    #[error("{} exists and is not a folder", path.display())]
    NotAFolder {
        /// What is in the way.
        path: PathBuf,
    },
    /// A file of the output folder cannot be written.
    #[error("cannot write {}", path.display())]
    WriteFile {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Writes all files of `record` but `summary.json` into `dir`, which is made if need be; returns their paths in the order
/// written. The files that only a pair with slices has are taken away where `record` has none.
pub fn write_data_and_page(record: &RunRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    let provenance = Provenance::of_scene(&record.summary.program_version, &record.summary.scene_hash);
    let flank = |gear: Gear| move |out: &mut dyn Write| tables::flank(out, provenance, &record.flanks[gear]);
    let mut paths = vec![
        place(dir, "scene.toml", |out| out.write_all(record.scene_toml.as_bytes()))?,
        place(dir, "pinion.csv", flank(Gear::Pinion))?,
        place(dir, "wheel.csv", flank(Gear::Wheel))?,
        place(dir, "history.csv", |out| table(out, provenance, &record.history))?,
        place(dir, "profiles.csv", |out| tables::profiles(out, provenance, record))?,
        place(dir, "mesh_cycle.csv", |out| table(out, provenance, &record.mesh_cycle))?,
    ];
    match &record.slices {
        Some(slices) => {
            let path = &record.summary.geometry.curvature_radius_mm;
            paths.push(place(dir, SLICES, |out| slice_table::slices(out, provenance, slices, path))?);
            paths.push(place(dir, FLANK, |out| flank_mesh::write(out, record, slices))?);
        }
        // What an earlier run left there would pass for this one's.
        None => [SLICES, FLANK].into_iter().try_for_each(|name| remove(dir, name))?,
    }
    paths.push(place(dir, "report.html", |out| out.write_all(html::page(record).as_bytes()))?);
    Ok(paths)
}

const SLICES: &str = "slices.csv";
const FLANK: &str = "flank.vtu";

/// Writes `summary.json` into `dir`, after everything else.
pub fn write_summary(summary: &Summary, dir: &Path) -> Result<PathBuf, ReportError> {
    create_folder(dir)?;
    place(dir, "summary.json", |out| summary::write(out, summary))
}

/// Takes away the `summary.json` of an earlier run, if there is one: it would vouch for files about to be replaced.
pub fn remove_summary(dir: &Path) -> Result<(), ReportError> {
    remove(dir, "summary.json")
}

/// Takes away `dir/name`, if it is there.
pub(crate) fn remove(dir: &Path, name: &str) -> Result<(), ReportError> {
    let path = dir.join(name);
    match fs::remove_file(&path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => Err(ReportError::WriteFile { path, source }),
        _ => Ok(()),
    }
}

/// Checks, before work starts, that files can be written into `dir`; leaves nothing behind that was not there.
pub fn writable(dir: &Path) -> Result<(), ReportError> {
    let missing: Vec<&Path> = dir.ancestors().take_while(|p| !p.as_os_str().is_empty() && !p.exists()).collect();
    let probed = create_folder(dir).and_then(|()| {
        NamedTempFile::new_in(dir).map(drop).map_err(|source| ReportError::WriteFile { path: dir.into(), source })
    });
    // Deepest first. A folder that someone else has filled meanwhile is not empty, stays, and is no error of ours.
    for made in missing {
        let _ = fs::remove_dir(made);
    }
    probed
}

/// Makes `dir` if need be.
pub fn create_folder(dir: &Path) -> Result<(), ReportError> {
    if dir.exists() && !dir.is_dir() {
        return Err(ReportError::NotAFolder { path: dir.into() });
    }
    fs::create_dir_all(dir).map_err(|source| ReportError::CreateFolder { path: dir.into(), source })
}

/// Writes `dir/name` with `fill`, whole or not at all.
pub(crate) fn place(
    dir: &Path,
    name: &str,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<PathBuf, ReportError> {
    let path = dir.join(name);
    match whole_file::write(&path, fill) {
        Ok(()) => Ok(path),
        Err(source) => Err(ReportError::WriteFile { path, source }),
    }
}
