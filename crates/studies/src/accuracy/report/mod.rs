//! The files of a comparison of models by error and run time, written from its [`AccuracyRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `accuracy.json` | [`AccuracyRecord`] |
//! | `accuracy.csv`, `wear_profiles.csv` | [`tables`] |
//! | `over_width.csv` | [`tables`]; of pairs with slices |
//! | `scene.toml` | the resolved scene |
//! | `recommended.toml`, `calibration.json` | the scene of the recommended run, ready for `gearwear run`, and what it reads |
//! | `report.html` | `page` |

mod front_figures;
mod page;
mod profile_figures;
mod run_tables;
pub mod tables;

use gearwear::report::output_files;
use std::path::{Path, PathBuf};

use crate::accuracy::record::{AccuracyRecord, CALIBRATION_FILE, OVER_WIDTH_FILE};
use gearwear::report::csv_table::{CsvFiles, Provenance};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "accuracy.json";
const RECOMMENDED: &str = "recommended.toml";
const RUNS: &str = "accuracy.csv";
const PROFILES: &str = "wear_profiles.csv";

/// Writes all files of `record` into `dir`, which is made if need be; returns their paths in the order written.
pub fn write(record: &AccuracyRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    // What an earlier comparison recommended must not pass for this one's.
    remove(dir, RECOMMENDED)?;
    remove(dir, OVER_WIDTH_FILE)?;
    let provenance = Provenance::of_scene(&record.program_version, &record.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    let mut written = vec![place(dir, output_files::SCENE, |out| out.write_all(record.scene_toml.as_bytes()))?];
    for (name, text) in [(CALIBRATION_FILE, &record.calibration_json), (RECOMMENDED, &record.recommended_toml)] {
        if let Some(text) = text {
            written.push(place(dir, name, |out| out.write_all(text.as_bytes()))?);
        }
    }
    written.extend([
        csv.place(RUNS, |out| tables::runs(out, record))?,
        csv.place(PROFILES, |out| tables::profiles(out, record))?,
    ]);
    if record.has_slices() {
        written.push(csv.place(OVER_WIDTH_FILE, |out| tables::over_width(out, record))?);
    }
    written.extend([
        csv.finish()?,
        place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes()))?,
        place(dir, LAST, |out| write_json(out, record))?,
    ]);
    Ok(written)
}
