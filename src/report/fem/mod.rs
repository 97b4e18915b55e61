//! The files of a finite-element problem, written from its [`FemRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `summary.json` | [`crate::results::fem_problem::FemSummary`] |
//! | `contact.csv` | [`contact_table`] |
//! | `solution.vtu` | `solution_mesh`: displacements and stresses, for ParaView |
//! | `problem.toml` | the resolved problem |
//! | `report.html` | `page` |

mod field_figures;
mod page;
mod pressure_figure;
mod solution_mesh;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::{
    ReportError, create_folder,
    csv_table::{Provenance, table},
    place, summary,
};
use crate::results::fem_problem::{ContactCurve, FemRecord, FemSummary};

/// Writes all files of `record` but `summary.json` into `dir`, which is made if need be; returns their paths in the order
/// written.
pub fn write_data_and_page(record: &FemRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    let provenance = Provenance::of_problem(&record.summary.program_version, &record.summary.problem_hash);
    Ok(vec![
        place(dir, "problem.toml", |out| out.write_all(record.problem_toml.as_bytes()))?,
        place(dir, "contact.csv", |out| contact_table(out, provenance, &record.contacts))?,
        place(dir, "solution.vtu", |out| solution_mesh::write(out, record))?,
        place(dir, "report.html", |out| out.write_all(page::page(record).as_bytes()))?,
    ])
}

/// Writes `summary.json` into `dir`, after everything else.
pub fn write_summary(summary: &FemSummary, dir: &Path) -> Result<PathBuf, ReportError> {
    create_folder(dir)?;
    place(dir, "summary.json", |out| summary::write(out, summary))
}

/// Writes `contact.csv`: the nodes of the slave surfaces, each in the order of its surface.
pub fn contact_table(out: &mut dyn Write, provenance: Provenance, contacts: &[ContactCurve]) -> io::Result<()> {
    table(out, provenance, contacts.iter().flat_map(|contact| &contact.rows))
}
