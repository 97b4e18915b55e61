//! The tables of a run as columns of numbers: what its CSV files hold, for those who want arrays.
//!
//! Rows, names and meanings are those that `csv_table` writes. Numbers keep their bits; one that was not computed, an
//! empty field of the file, is NaN.

mod gather;

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::Serialize;

use super::fem_pair::pressure_table;
use super::{csv_table, slice_table, tables, unit};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::fem_pair::FemPairRecord;
use gearwear_physics::results::run::RunRecord;

/// A table as columns of the same length.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name of its file, without the ending.
    pub name: &'static str,
    /// In the order of the file.
    pub columns: Vec<Column>,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, which ends in its unit.
    pub name: String,
    /// What it holds, as `columns.json` says it.
    pub meaning: String,
    /// Its unit in an engineer's words; none where it has none.
    pub unit: Option<&'static str>,
    /// One value a row.
    pub values: Values,
}

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers; NaN where one was not computed.
    Numbers(Vec<f64>),
    /// Whole numbers: numbers of slices, points, phases.
    Counts(Vec<i64>),
    /// What is so or not.
    Flags(Vec<bool>),
    /// Names.
    Words(Vec<String>),
}

/// The table called `name` of a run: `pinion`, `wheel`, `history`, `profiles`, `mesh_cycle`, `film`, `torque_curve` or `slices`; none for another name, or where
/// the run has no such table.
pub fn of_run(record: &RunRecord, name: &str) -> Option<Table> {
    Some(match name {
        "pinion" => table("pinion", tables::flank(&record.flanks[Gear::Pinion])),
        "wheel" => table("wheel", tables::flank(&record.flanks[Gear::Wheel])),
        "history" => table("history", &record.history),
        "profiles" => table("profiles", tables::profiles(record)),
        "mesh_cycle" => table("mesh_cycle", &record.mesh_cycle),
        "film" if !record.film.is_empty() => table("film", &record.film),
        "torque_curve" if !record.torque_curve.is_empty() => table("torque_curve", &record.torque_curve),
        "slices" => {
            table("slices", slice_table::rows(record.slices.as_ref()?, &record.summary.geometry.curvature_radius_mm))
        }
        _ => return None,
    })
}

/// The table called `name` of a pair in contact by finite elements: `mesh_cycle` or `pressure`; none for another name.
pub fn of_fem_pair(record: &FemPairRecord, name: &str) -> Option<Table> {
    Some(match name {
        "mesh_cycle" => table("mesh_cycle", &record.mesh_cycle),
        "pressure" => table("pressure", pressure_table::rows(&record.pressure)),
        _ => return None,
    })
}

/// A cell of a table whose columns are named by what is asked; empty where there is nothing to say.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell<'a> {
    Whole(Option<i64>),
    Number(Option<f64>),
    Text(Option<Cow<'a, str>>),
}

impl Cell<'_> {
    pub fn count(value: usize) -> Self {
        Self::Whole(i64::try_from(value).ok())
    }
}

/// The table called `name` with these columns and rows of cells; whole numbers of which some are missing become numbers.
pub fn of_cells<'a>(
    name: &'static str,
    columns: Vec<csv_table::Column>,
    rows: impl IntoIterator<Item = Vec<Cell<'a>>>,
) -> Table {
    let mut cells: Vec<Vec<Cell<'a>>> = columns.iter().map(|_| Vec::new()).collect();
    for row in rows {
        cells.iter_mut().zip(row).for_each(|(column, cell)| column.push(cell));
    }
    let column = |((name, meaning), cells): (csv_table::Column, Vec<Cell<'a>>)| Column {
        unit: unit::of(&name),
        name,
        meaning,
        values: values(cells),
    };
    Table { name, columns: columns.into_iter().zip(cells).map(column).collect() }
}

fn values(cells: Vec<Cell<'_>>) -> Values {
    let whole = |cell: &Cell<'_>| if let Cell::Whole(value) = cell { *value } else { None };
    if let Some(counts) = cells.iter().map(whole).collect() {
        return Values::Counts(counts);
    }
    if let Some(Cell::Text(_)) = cells.first() {
        let word = |cell| if let Cell::Text(Some(text)) = cell { text.into_owned() } else { String::new() };
        return Values::Words(cells.into_iter().map(word).collect());
    }
    let number = |cell| match cell {
        Cell::Whole(value) => value.map_or(f64::NAN, |value| value as f64),
        Cell::Number(value) => value.unwrap_or(f64::NAN),
        Cell::Text(_) => f64::NAN,
    };
    Values::Numbers(cells.into_iter().map(number).collect())
}

/// The table called `name` of these records, a column for each of their fields.
pub fn table<R: Serialize + JsonSchema>(name: &'static str, rows: impl IntoIterator<Item = R>) -> Table {
    let columns = csv_table::columns::<R>();
    let values = gather::columns(rows, columns.len());
    let column = |((name, meaning), values): (csv_table::Column, Values)| Column {
        unit: unit::of(&name),
        name,
        meaning,
        values,
    };
    Table { name, columns: columns.into_iter().zip(values).map(column).collect() }
}
