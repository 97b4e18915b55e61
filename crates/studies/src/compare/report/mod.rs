//! The files of a comparison of measured profiles with a run, written from its [`CompareRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `compare.csv` | the points, measured and simulated |
//! | `report.html` | `page` |
//! | `compare.json` | the figures |

mod figures;
mod page;

use gearwear::report::output_files;
use std::path::Path;

use crate::compare::record::{CompareRecord, CompareRow};
use gearwear::report::csv_table::{CsvFiles, Provenance, table};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "compare.json";
const POINTS: &str = "compare.csv";

/// Writes all files of `record` into `dir`, which is made if need be.
pub fn write(record: &CompareRecord, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    let provenance = Provenance::of_scene(&record.program_version, &record.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    let rows: Vec<CompareRow> = record.profiles.iter().flat_map(|of| &of.rows).copied().collect();
    csv.place(POINTS, |out| table(out, &rows))?;
    csv.finish()?;
    place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes()))?;
    place(dir, LAST, |out| write_json(out, record)).map(drop)
}
