//! The files of a finite-element problem, written from its [`FemRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `summary.json` | [`crate::results::fem_problem::FemSummary`] |
//! | `contact.csv` | [`contact_table`] |
//! | `solution.vtu` | displacement and stress at the nodes, for ParaView |
//! | `problem.toml` | the resolved problem |
//! | `report.html` | `page` |

mod field_figures;
mod page;
mod pressure_figure;

use std::io::{self, Write};
use std::path::Path;

use super::csv_table::{Provenance, table};
use super::files::{ReportError, create_folder, place};
use super::vtu_file;
use crate::mesh::Mesh;
use crate::results::fem_problem::{ContactCurve, FemRecord};

/// Writes all files of `record` but `summary.json` into `dir`, which is made if need be.
pub(crate) fn write_data_and_page(record: &FemRecord, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    let provenance = Provenance::of_problem(&record.summary.program_version, &record.summary.problem_hash);
    place(dir, "problem.toml", |out| out.write_all(record.problem_toml.as_bytes()))?;
    place(dir, "contact.csv", |out| contact_table(out, provenance, &record.contacts))?;
    place(dir, "solution.vtu", |out| vtu_file::write(out, &solution(record)))?;
    place(dir, "report.html", |out| out.write_all(page::page(record).as_bytes())).map(drop)
}

/// Writes `contact.csv`: the nodes of the slave surfaces, each in the order of its surface.
pub(crate) fn contact_table(out: &mut dyn Write, provenance: Provenance, contacts: &[ContactCurve]) -> io::Result<()> {
    table(out, provenance, contacts.iter().flat_map(|contact| &contact.rows))
}

/// The bodies with displacement, stress and contact pressure at their nodes.
fn solution(record: &FemRecord) -> Mesh {
    let mut mesh = record.problem.solid.to_mesh();
    vtu_file::add_solution(&mut mesh, &record.displacement_mm, &record.stress);
    let mut pressure_mpa = vec![0.0; mesh.points.len()];
    for row in record.contacts.iter().flat_map(|contact| &contact.rows) {
        pressure_mpa[row.node as usize] = row.pressure_MPa;
    }
    vtu_file::add(&mut mesh, "pressure_MPa", 1, pressure_mpa);
    mesh
}
