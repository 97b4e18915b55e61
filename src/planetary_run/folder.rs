//! The whole result of a stage in its folder: written from memory, and read again to the bit.

use std::fs;
use std::path::Path;

use super::record::{PlanetaryRecord, PlanetarySummary};
use super::{MeshFindings, report, transmission_error};
use crate::report::{self as run_report, ReportError, RunFiles, output_files};
use crate::resume::folder;
use crate::resume::result::{self, ResultError};
use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use gearwear_physics::results::run::RunRecord;

/// Writes all files of `record` into `dir`, which is made if need be, with `files` beside the tables.
///
/// # Errors
/// A file that cannot be written.
pub fn write(record: &PlanetaryRecord, files: &RunFiles, dir: &Path) -> Result<(), ReportError> {
    run_report::create_folder(dir)?;
    run_report::remove_summary(dir)?;
    for mesh in StageMesh::BOTH {
        if let Some(run) = &record.meshes[mesh] {
            result::write_all(run, &of_mesh(files, mesh), &dir.join(mesh.folder()))?;
        }
    }
    folder::place(dir, output_files::SCENE, record.scene_toml.as_bytes())?;
    report::write(record, files, dir)
}

/// Files beside the tables of a mesh.
pub(super) fn of_mesh(files: &RunFiles, mesh: StageMesh) -> RunFiles {
    RunFiles { figures: files.figures.as_ref().map(|to| to.join(mesh.folder())), ..files.clone() }
}

/// The stage in the folder `dir`, equal to what was written there.
///
/// # Errors
/// [`ResultError`]: no folder, none of a finished stage, or one of another version of the program.
pub fn read(dir: &Path) -> Result<PlanetaryRecord, ResultError> {
    let lacks = |file| ResultError::NoRun { folder: dir.to_owned(), file };
    let unreadable = |file: &str| {
        let path = dir.join(file);
        move |source| ResultError::Unreadable { path, source }
    };
    fs::read_dir(dir).map_err(unreadable(""))?;
    let text = folder::MOST.read(&dir.join(output_files::SUMMARY)).map_err(|_| lacks(output_files::SUMMARY))?;
    let summary: PlanetarySummary = serde_json::from_slice(&text).map_err(|_| lacks("summary of a planetary stage"))?;
    let meshes: PerMesh<Option<RunRecord>> = PerMesh::try_from_fn(|mesh| match &summary.meshes[mesh] {
        None => Ok(None),
        Some(of_mesh) => {
            let own = dir.join(mesh.folder());
            let run = result::read(&own)?;
            let same = run.summary == *of_mesh;
            if same { Ok(Some(run)) } else { Err(ResultError::OtherSummary { path: own.join(output_files::SUMMARY) }) }
        }
    })?;
    let scene_toml = fs::read_to_string(dir.join(output_files::SCENE)).map_err(unreadable(output_files::SCENE))?;
    let kinematics = &summary.planetary;
    let transmission_error = match (&meshes.sun_planet, &meshes.planet_ring) {
        (Some(sun), Some(ring)) => transmission_error::rows(
            &kinematics.mesh_phase,
            kinematics.ring_mesh_phase,
            MeshFindings::of(sun),
            MeshFindings::of(ring),
        ),
        _ => Vec::new(),
    };
    Ok(PlanetaryRecord { summary, scene_toml, meshes, transmission_error })
}
