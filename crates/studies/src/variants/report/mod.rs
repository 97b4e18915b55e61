//! The files of a comparison of runs, written from its [`VariantsRecord`] and the runs.
//!
//! | file | from |
//! |---|---|
//! | `variants.csv`, `columns.json` | every figure of every run, its error, its difference to the first |
//! | `report.html` | `page` |
//! | `variants.json` | [`VariantsRecord`] |

mod figures;
mod page;

use gearwear::report::output_files;
use std::path::Path;

use super::finished_run::FinishedRun;
use super::record::VariantsRecord;
use gearwear::report::csv_table::{CsvFiles, Provenance, table};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "variants.json";

/// Writes all files of `record` into `dir`, which is made if need be.
pub fn write(record: &VariantsRecord, runs: &[FinishedRun], dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    let mut csv = CsvFiles::new(dir, Provenance::of_scene(&record.program_version, &runs[0].summary.scene_hash));
    csv.place("variants.csv", |out| table(out, &record.rows))?;
    csv.finish()?;
    place(dir, output_files::PAGE, |out| out.write_all(page::page(record, runs).as_bytes()))?;
    place(dir, LAST, |out| write_json(out, record)).map(drop)
}
