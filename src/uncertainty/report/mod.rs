//! The files of a study of uncertainty, written from its [`UncertaintyRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `samples.csv` | one row per sample |
//! | `columns.json` | what its columns hold |
//! | `report.html` | `page` |
//! | `scene.toml` | the scene as the user gave it |
//! | `uncertainty.json` | [`UncertaintyRecord`], written last |

mod figures;
mod page;

use crate::report::output_files;
use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use super::record::{MODEL_ERROR, UncertaintyRecord};
use crate::report::columns::{Cell, Table, of_cells};
use crate::report::csv_table::{Column, CsvFiles, Provenance, table_of};
use crate::report::files::{ReportError, create_folder, place, remove, write_json};

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "uncertainty.json";
const SAMPLES: &str = "samples.csv";

/// Creates `dir` or removes the results of an earlier study there.
pub fn begin(dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)
}

/// Writes all files of `record` into `dir`.
pub fn write(record: &UncertaintyRecord, dir: &Path) -> Result<(), ReportError> {
    begin(dir)?;
    place(dir, output_files::SCENE, |out| out.write_all(record.scene_toml.as_bytes()))?;
    let provenance = Provenance::of_scene(&record.program_version, &record.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    csv.place(SAMPLES, |out| samples(out, record))?;
    csv.finish()?;
    place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes()))?;
    place(dir, LAST, |out| write_json(out, record)).map(drop)
}

fn samples(out: &mut dyn Write, record: &UncertaintyRecord) -> io::Result<Vec<Column>> {
    table_of(out, columns(record), rows(record))
}

/// The table of the samples.
pub fn table(record: &UncertaintyRecord) -> Table {
    of_cells("samples", columns(record), rows(record))
}

fn column(name: &str, meaning: String) -> Column {
    (name.to_owned(), meaning)
}

fn columns(record: &UncertaintyRecord) -> Vec<Column> {
    let mut columns = vec![
        column("point", "number of the point of the Sobol sequence, from 0".to_owned()),
        column("matrix", "A and B: independent samples; a key: A with this key from B".to_owned()),
    ];
    columns.extend(record.uncertain.iter().map(|one| column(&one.key, format!("uncertain: {}", one.given))));
    let of_error = format!("{MODEL_ERROR}: where within its bounds, -1 to 1; empty where it is not known");
    columns.push(column("model_error", of_error));
    for output in &record.outputs {
        let unit = if output.unit.is_empty() { String::new() } else { format!(", {}", output.unit) };
        let longer = if output.censored.is_some() { "; empty where it is longer than the duration" } else { "" };
        let meaning = format!("{}{unit}, with the error of the fast model{longer}", output.meaning);
        columns.push(column(&output.output, meaning));
    }
    let read_off = "run, or response surface: read off one that is fitted to those that were run";
    columns.push(column("source", read_off.to_owned()));
    columns.push(column("error", "why there are no figures".to_owned()));
    columns
}

fn rows(record: &UncertaintyRecord) -> impl Iterator<Item = Vec<Cell<'_>>> {
    record.rows.iter().map(|row| {
        let numbers = row.values.iter().map(|&value| Some(value)).chain([row.model_error]);
        let numbers = numbers.chain(row.outputs.iter().copied()).map(Cell::Number);
        let head = [Cell::count(row.point), Cell::Text(Some(Cow::Borrowed(&row.matrix)))];
        let source = if row.is_read_off { "response surface" } else { "run" };
        let tail = [Some(source), row.error.as_deref()].map(|text| Cell::Text(text.map(Cow::Borrowed)));
        head.into_iter().chain(numbers).chain(tail).collect()
    })
}
