//! The files of a comparison of a measured profile with a run, written from its [`CompareRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `compare.csv` | the points, measured and simulated |
//! | `report.html` | `page` |
//! | `compare.json` | the figures |

mod figures;
mod page;

use std::path::{Path, PathBuf};

use crate::report::tables::{Column, Provenance, table};
use crate::report::{ReportError, create_folder, place, remove, summary};
use crate::studies::compare::record::CompareRecord;

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "compare.json";

/// Columns of `compare.csv`; one row per measured point, from root to tip.
pub const COMPARE: [Column; 8] = [
    ("radius_mm", "distance from the gear's axis, shifted as fitted"),
    ("arc_mm", "length along the flank from the base circle, shifted as fitted"),
    ("measured_um", "measured height, form removed"),
    ("simulated_um", "simulated height after the fit, form removed in the same way"),
    ("difference_um", "measured less simulated"),
    ("as_run_um", "simulated height of the run as it is, form removed in the same way"),
    ("wear_um", "simulated wear depth after the fit"),
    (
        "measured_wear_um",
        "wear depth of the measured profile on the form of the simulation: wear_um less difference_um",
    ),
];

/// Writes all files of `record` into `dir`, which is made if need be; returns their paths in the order written.
///
/// # Errors
/// [`ReportError`].
pub fn write(record: &CompareRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    let provenance = Provenance::of_compare(record);
    Ok(vec![
        place(dir, "compare.csv", |out| table(out, provenance, &COMPARE, &record.rows))?,
        place(dir, "report.html", |out| out.write_all(page::page(record).as_bytes()))?,
        place(dir, LAST, |out| summary::write(out, record))?,
    ])
}
