//! The files of a sweep, written from its [`SweepRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `sweep.csv` | [`tables`] |
//! | `columns.json` | what its columns hold |
//! | `sweep.parquet` | the same table, with the feature `parquet` |
//! | `report.html` | `page` |
//! | `scene.toml` | the scene as the user gave it |
//! | `sweep.json` | [`SweepSummary`](crate::sweep::record::SweepSummary) |
//!
//! A shard has neither Parquet table nor page: those are of the whole, which is merged from the shards.

mod best_tables;
mod contour_figures;
mod line_figures;
mod page;
#[cfg(feature = "parquet")]
pub mod parquet_table;
mod section_plane;
pub mod tables;

use crate::report::output_files;
use std::path::Path;

use crate::report::csv_table::{CsvFiles, Provenance};
use crate::report::files::{ReportError, create_folder, place, remove, write_json};
use crate::sweep::record::SweepRecord;

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "sweep.json";
const COMBINATIONS: &str = "sweep.csv";
const PARQUET: &str = "sweep.parquet";

/// Prepares `dir` for a sweep: its scene is written, and what an earlier sweep said of all its rows is taken away.
pub fn begin(scene_toml: &str, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    place(dir, output_files::SCENE, |out| out.write_all(scene_toml.as_bytes())).map(drop)
}

/// Writes all files of `record` into `dir`, which is made if need be.
pub fn write(record: &SweepRecord, dir: &Path) -> Result<(), ReportError> {
    begin(&record.scene_toml, dir)?;
    remove(dir, PARQUET)?;
    let provenance = Provenance::of_scene(&record.identity.program_version, &record.identity.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    csv.place(COMBINATIONS, |out| tables::rows(out, record))?;
    csv.finish()?;
    if record.shard.is_none() {
        #[cfg(feature = "parquet")]
        place(dir, PARQUET, |out| out.write_all(&parquet_table::bytes(record).map_err(std::io::Error::other)?))?;
        place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes()))?;
    }
    place(dir, LAST, |out| write_json(out, &record.summary())).map(drop)
}
