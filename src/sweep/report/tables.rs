//! `sweep.csv`: one row per combination. `sweep.parquet` has the same columns, and so has the table in memory.

use std::borrow::Cow;
use std::io::{self, Write};

use crate::evaluate::figure;
use crate::report::columns::{Cell, Table, of_cells};
use crate::report::csv_table::{Column, table_of};
use crate::sweep::record::{SweepRecord, SweepRow};

pub struct SweepColumn {
    pub name: String,
    pub meaning: String,
    cell: Box<dyn for<'a> Fn(&'a SweepRow) -> Cell<'a>>,
}

impl SweepColumn {
    fn new(
        name: impl Into<String>,
        meaning: impl Into<String>,
        cell: impl for<'a> Fn(&'a SweepRow) -> Cell<'a> + 'static,
    ) -> Self {
        Self { name: name.into(), meaning: meaning.into(), cell: Box::new(cell) }
    }

    pub fn cell<'a>(&self, row: &'a SweepRow) -> Cell<'a> {
        (self.cell)(row)
    }
}

/// The columns of a sweep: combination, varied keys, status, figures, times, error, verification.
pub fn columns(record: &SweepRecord) -> Vec<SweepColumn> {
    let mut columns =
        vec![SweepColumn::new("index", "number of the combination, from 0", |row| Cell::count(row.index))];
    for (at, axis) in record.identity.axes.iter().enumerate() {
        let meaning = format!("varied: {}", axis.as_given());
        if let Some(words) = axis.words().map(<[String]>::to_vec) {
            columns.push(SweepColumn::new(&axis.key, meaning, move |row| {
                let place = row.values.get(at).map(|&value| value as usize);
                Cell::Text(place.and_then(|place| words.get(place)).map(|word| Cow::Owned(word.clone())))
            }));
            continue;
        }
        let is_whole = axis.whole;
        columns.push(SweepColumn::new(&axis.key, meaning, move |row| {
            let value = row.values.get(at).copied();
            // Whole numbers were checked to be whole.
            if is_whole { Cell::Whole(value.map(|value| value as i64)) } else { Cell::Number(value) }
        }));
    }
    columns.push(SweepColumn::new("status", "ok, or failed: then the figures are empty and error says why", |row| {
        Cell::Text(Some(if row.error.is_none() { "ok" } else { "failed" }.into()))
    }));
    let kind = record.identity.kind;
    for figure in figure::in_sweeps(kind) {
        columns.push(SweepColumn::new(&figure.name, &figure.meaning, |row| Cell::Number(row.figure(figure))));
    }
    for (at, path) in record.identity.figures.iter().enumerate().skip(figure::in_sweeps(kind).len()) {
        columns.push(SweepColumn::new(path, "the number at this path of summary.json", move |row| {
            Cell::Number(row.figures.get(at).copied().flatten())
        }));
    }
    let all_of_it = "wall time of the whole combination, its verification apart";
    let why = "why finite elements verified this row: best, corner, or best and corner; empty: nothing verified it";
    columns.extend([
        SweepColumn::new("warnings", "number of warnings of the run", |row| {
            row.warnings.map_or(Cell::Whole(None), Cell::count)
        }),
        SweepColumn::new("simulation_s", "wall time of the wear run alone", |row| Cell::Number(row.simulation_s)),
        SweepColumn::new("wall_s", all_of_it, |row| Cell::Number(Some(row.wall_s))),
        SweepColumn::new("error", "why there are no figures", |row| {
            Cell::Text(row.error.as_deref().map(Cow::Borrowed))
        }),
        SweepColumn::new("verified", why, |row| {
            Cell::Text(row.verification.as_ref().map(|of| of.chosen.name().into()))
        }),
    ]);
    for claim in figure::claims(kind) {
        let meaning = format!(
            "{}: relative difference from the same wear simulation with finite elements, their own uncertainty added; as in summary.json of a run; \
             empty where not verified",
            claim.title
        );
        columns.push(SweepColumn::new(&claim.name, meaning, move |row| {
            Cell::Number(row.verification.as_ref().and_then(|of| claim.of(&of.total)))
        }));
    }
    for mesh in kind.meshes() {
        let name = mesh.map_or_else(String::new, |mesh| format!("{}.", mesh.table())) + "error.total.how";
        columns.push(SweepColumn::new(name, "how the row was verified, or why that was not possible", move |row| {
            let total = row.verification.as_ref().and_then(|of| of.total.of(mesh));
            Cell::Text(total.map(|total| total.how.as_str().into()))
        }));
    }
    columns
}

fn names(columns: &[SweepColumn]) -> Vec<Column> {
    columns.iter().map(|column| (column.name.clone(), column.meaning.clone())).collect()
}

fn cells<'a>(record: &'a SweepRecord, columns: &[SweepColumn]) -> impl Iterator<Item = Vec<Cell<'a>>> {
    record.rows.iter().map(|row| columns.iter().map(|column| column.cell(row)).collect())
}

pub fn rows(out: &mut dyn Write, record: &SweepRecord) -> io::Result<Vec<Column>> {
    let columns = columns(record);
    table_of(out, names(&columns), cells(record, &columns))
}

/// Table as columns of values.
pub fn table(record: &SweepRecord) -> Table {
    let columns = columns(record);
    of_cells("sweep", names(&columns), cells(record, &columns))
}
