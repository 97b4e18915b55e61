//! Files of wear coefficient and remaining life, written from their [`LifeRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `remaining_life.csv` | coefficient and life after each measurement |
//! | `predictions.csv` | later measurements, predicted from those before |
//! | `report.html` | `page` |
//! | `remaining_life.json` | all of it |

mod figures;
mod page;

use std::path::Path;

use gearwear::report::csv_table::{CsvFiles, Provenance, table};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};
use gearwear::report::output_files;

use super::record::LifeRecord;

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "remaining_life.json";
const LIVES: &str = "remaining_life.csv";
const PREDICTIONS: &str = "predictions.csv";

/// Writes all files of `record` into `dir`, which is made if need be.
///
/// # Errors
/// A file that cannot be written.
pub fn write(record: &LifeRecord, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    let provenance = Provenance::of_scene(&record.program_version, &record.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    csv.place(LIVES, |out| table(out, record.rows()))?;
    csv.place(PREDICTIONS, |out| table(out, record.predictions()))?;
    csv.finish()?;
    place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes()))?;
    place(dir, LAST, |out| write_json(out, record)).map(drop)
}
