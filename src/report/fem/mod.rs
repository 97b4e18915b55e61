//! The files of a finite-element problem, written from its [`FemRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `summary.json` | [`gearwear_physics::results::fem_problem::FemSummary`] |
//! | `contact.csv` | [`contact_table`], of plane problems |
//! | `solution.vtu` | displacement and stress at the nodes, for ParaView |
//! | `problem.toml` | the resolved problem |
//! | `report.html` | `page`, in space `page_in_space` |

mod field_figures;
mod page;
mod page_in_space;
mod pressure_figure;

use crate::report::output_files;
use std::io::{self, Write};
use std::path::Path;

use super::csv_table::{Column, CsvFiles, Provenance, table};
use super::files::{ReportError, create_folder, place, remove};
use super::vtu_file;
use gearwear_fem::nodal_fields::add_nodal_fields;
use gearwear_mesh::Mesh;
use gearwear_physics::results::fem_problem::{ContactCurve, FemRecord, FemSolution, PlaneSolution, SpaceSolution};

/// Writes all files of `record` but `summary.json` into `dir`, which is made if need be.
pub fn write_data_and_page(record: &FemRecord, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    place(dir, output_files::PROBLEM, |out| out.write_all(record.problem_toml.as_bytes()))?;
    let page = match &record.solution {
        FemSolution::Plane(plane) => {
            let summary = &record.summary;
            let provenance = Provenance::of_problem(&summary.program_version, &summary.problem_hash);
            let mut csv = CsvFiles::new(dir, provenance);
            csv.place(output_files::CONTACT, |out| contact_table(out, &plane.contacts))?;
            csv.finish()?;
            page::page(record, plane)
        }
        FemSolution::InSpace(space) => {
            // Those of a plane problem that was solved there before would pass for this one's.
            [output_files::CONTACT, output_files::COLUMNS].into_iter().try_for_each(|name| remove(dir, name))?;
            page_in_space::page(record, space)
        }
    };
    place(dir, output_files::SOLUTION, |out| vtu_file::write(out, &solution_mesh(record)))?;
    place(dir, output_files::PAGE, |out| out.write_all(page.as_bytes())).map(drop)
}

/// The mesh of `solution.vtu`.
pub fn solution_mesh(record: &FemRecord) -> Mesh {
    match &record.solution {
        FemSolution::Plane(plane) => solution(plane),
        FemSolution::InSpace(space) => solution_in_space(space),
    }
}

/// Writes `contact.csv`: the nodes of the slave surfaces, each in the order of its surface.
pub fn contact_table(out: &mut dyn Write, contacts: &[ContactCurve]) -> io::Result<Vec<Column>> {
    table(out, contacts.iter().flat_map(|contact| &contact.rows))
}

/// The bodies with displacement, stress and contact pressure at their nodes.
fn solution(record: &PlaneSolution) -> Mesh {
    let mut mesh = record.problem.solid.to_mesh();
    vtu_file::add_solution(&mut mesh, &record.displacement_mm, &record.stress);
    let mut pressure_mpa = vec![0.0; mesh.points.len()];
    for row in record.contacts.iter().flat_map(|contact| &contact.rows) {
        pressure_mpa[row.node as usize] = row.pressure_MPa;
    }
    mesh.add_point_data("pressure_MPa", 1, pressure_mpa);
    mesh
}

/// Bodies in space with displacement and stress at their nodes.
fn solution_in_space(found: &SpaceSolution) -> Mesh {
    let mut mesh = found.problem.solid.to_mesh();
    let von_mises = found.von_mises_MPa.iter().copied();
    add_nodal_fields(&mut mesh, found.displacement_mm.iter().copied(), found.stress_MPa.iter().copied(), von_mises);
    mesh
}
