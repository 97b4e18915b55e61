//! The files of a planetary stage beside those of its meshes.

mod drawing;
mod page;

use std::path::Path;

use super::record::PlanetaryRecord;
use crate::report::csv_table::{CsvFiles, Provenance, table};
use crate::report::files::{place, remove};
use crate::report::{self, ReportError, RunFiles, figure, output_files};

/// Transmission error of the stage over one base pitch.
const TRANSMISSION_ERROR: &str = "transmission_error.csv";

/// Writes all files of the stage but the copy of its file; the summary last.
pub(super) fn write(record: &PlanetaryRecord, files: &RunFiles, dir: &Path) -> Result<(), ReportError> {
    let summary = &record.summary;
    let mut csv = CsvFiles::new(dir, Provenance::of_scene(&summary.program_version, &summary.scene_hash));
    csv.place(TRANSMISSION_ERROR, |out| table(out, &record.transmission_error))?;
    csv.finish()?;
    match files.page {
        true => place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes())).map(drop)?,
        false => remove(dir, output_files::PAGE)?,
    }
    if let Some(figures) = &files.figures {
        figure::write_all(&page::charts(record), figures)?;
    }
    report::write_summary(summary, dir).map(drop)
}
