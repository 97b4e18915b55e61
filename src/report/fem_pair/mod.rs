//! The files of finite-element contact of a gear pair, written from its [`FemPairRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `summary.json` | [`gearwear_physics::results::fem_pair::FemPairSummary`] |
//! | `mesh_cycle.csv`, `pressure.csv` | [`gearwear_physics::results::fem_pair::FemCycleRow`], [`pressure_table`] |
//! | `solution.vtu` | displacement and stress at the nodes, for ParaView |
//! | `scene.toml` | the resolved scene |
//! | `report.html` | `page` |

mod cycle_figures;
mod field_figures;
mod figures_table;
mod page;
mod pressure_figure;
pub mod pressure_table;

use crate::report::output_files;
use std::path::Path;

use nalgebra::Vector2;

use super::csv_table::{CsvFiles, Provenance, table};
use super::files::{ReportError, create_folder, place};
use super::vtu_file;
use gearwear_fem::solid::Solid;
use gearwear_mesh::Mesh;
use gearwear_physics::results::fem_pair::{FemPairRecord, PairSolution};

/// Writes all files of `record` but `summary.json` into `dir`, which is made if need be.
pub fn write_data_and_page(record: &FemPairRecord, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    let provenance = Provenance::of_scene(&record.summary.program_version, &record.summary.scene_hash);
    place(dir, output_files::SCENE, |out| out.write_all(record.scene_toml.as_bytes()))?;
    let mut csv = CsvFiles::new(dir, provenance);
    csv.place(output_files::MESH_CYCLE, |out| table(out, &record.mesh_cycle))?;
    csv.place(output_files::PRESSURE, |out| table(out, pressure_table::rows(&record.pressure)))?;
    csv.finish()?;
    if let Some(solution) = &record.solution {
        place(dir, output_files::SOLUTION, |out| vtu_file::write(out, &mesh(solution)))?;
    }
    place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes())).map(drop)
}

/// The teeth in contact with displacement and stress at their nodes.
fn mesh(solution: &PairSolution) -> Mesh {
    let points_mm = solution.points_mm.iter().map(|p| Vector2::from(*p)).collect();
    let mut mesh = Solid { points_mm, elements: solution.elements.clone() }.to_mesh();
    vtu_file::add_solution(&mut mesh, &solution.displacement_mm, &solution.stress);
    mesh
}
