//! `results.xlsx`: the tables of a run as sheets of one workbook, with a sheet of the main figures and one of what every column holds.
//!
//! Its values are read from the CSV files beside it, whose decimals are those of the same bits, and are stored as the same bits again.

use crate::report::output_files;
use std::io;
use std::path::{Path, PathBuf};

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};
use serde_json::Value;

use super::files::{ReportError, place};
use super::unit;
use gearwear_physics::results::figures;
use gearwear_physics::results::run::{ReportedBy, Summary};

pub(crate) const WORKBOOK: &str = "results.xlsx";

/// Rows that a sheet can hold.
const MOST_ROWS: usize = 1_048_576;
/// Parts of the summary that are no figures of the pair.
const NOT_SHOWN: [&str; 4] = ["stages", "left_out", "wall_s", "work"];

/// Writes the workbook of the `tables`, names of CSV files that stand in `dir`, and of `summary`.
pub(super) fn write(summary: &Summary, tables: &[&str], dir: &Path) -> Result<PathBuf, ReportError> {
    let path = dir.join(WORKBOOK);
    let bytes = bytes(summary, tables, dir).map_err(|source| ReportError::WriteFile { path, source })?;
    place(dir, WORKBOOK, |out| out.write_all(&bytes))
}

fn bytes(summary: &Summary, tables: &[&str], dir: &Path) -> io::Result<Vec<u8>> {
    let meanings: Value = serde_json::from_slice(&std::fs::read(dir.join(output_files::COLUMNS))?)?;
    let mut workbook = Workbook::new();
    // The same bytes for the same run, whenever it is written.
    let created = ExcelDateTime::from_ymd(2000, 1, 1).map_err(io::Error::other)?;
    let ReportedBy { author, company, .. } = summary.report.clone().unwrap_or_default();
    workbook.set_properties(
        &DocProperties::new()
            .set_title(&summary.title)
            .set_author(author.unwrap_or_default())
            .set_company(company.unwrap_or_default())
            .set_creation_datetime(&created),
    );
    let summary = serde_json::to_value(summary)?;
    main_figures(workbook.add_worksheet(), &summary).map_err(io::Error::other)?;
    let mut columns = Vec::new();
    for file in tables {
        let mut reader = csv::Reader::from_path(dir.join(file))?;
        let names = reader.headers()?.clone();
        columns.extend(names.iter().map(|name| {
            let meaning = meanings["files"][file][name].as_str().unwrap_or_default();
            [sheet_name(file), name, unit::of(name).unwrap_or_default(), meaning].map(str::to_owned)
        }));
        table(workbook.add_worksheet(), file, &names, reader.records())?;
    }
    meanings_sheet(workbook.add_worksheet(), &columns).map_err(io::Error::other)?;
    workbook.save_to_buffer().map_err(io::Error::other)
}

fn sheet_name(file: &str) -> &str {
    file.trim_end_matches(".csv")
}

fn heading(sheet: &mut Worksheet, name: &str, titles: &[&str]) -> Result<(), XlsxError> {
    sheet.set_name(name)?;
    sheet.set_freeze_panes(1, 0)?;
    // On paper all columns beside one another.
    sheet.set_landscape().set_print_fit_to_pages(1, 0);
    let bold = Format::new().set_bold();
    for (column, title) in (0..).zip(titles) {
        sheet.write_with_format(0, column, *title, &bold)?;
        sheet.set_column_width(column, (title.chars().count() + 2).max(10) as f64)?;
    }
    Ok(())
}

/// A number where `text` is one, nothing where it is empty, otherwise the text.
fn cell(sheet: &mut Worksheet, row: u32, column: u16, text: &str) -> Result<(), XlsxError> {
    match text.parse::<f64>() {
        _ if text.is_empty() => {}
        Ok(number) if number.is_finite() => drop(sheet.write_number(row, column, number)?),
        _ => drop(sheet.write_string(row, column, text)?),
    }
    Ok(())
}

fn table(
    sheet: &mut Worksheet,
    file: &str,
    names: &csv::StringRecord,
    records: impl Iterator<Item = csv::Result<csv::StringRecord>>,
) -> io::Result<()> {
    heading(sheet, sheet_name(file), &names.iter().collect::<Vec<_>>()).map_err(io::Error::other)?;
    for (row, record) in (1..).zip(records) {
        if row == MOST_ROWS - 1 {
            let rest = format!("More rows than a sheet holds: all of them are in {file}.");
            sheet.write_string(row as u32, 0, rest).map_err(io::Error::other)?;
            break;
        }
        for (column, text) in (0..).zip(&record?) {
            cell(sheet, row as u32, column, text).map_err(io::Error::other)?;
        }
    }
    Ok(())
}

/// Every number and word of the summary under its path in `summary.json`, items of lists numbered from 1.
fn main_figures(sheet: &mut Worksheet, summary: &Value) -> Result<(), XlsxError> {
    heading(sheet, "summary", &["figure", "value", "unit", "meaning"])?;
    for (column, width) in [56.0, 24.0, 18.0, 100.0].into_iter().enumerate() {
        sheet.set_column_width(column as u16, width)?;
    }
    let mut found = Vec::new();
    for (key, value) in summary.as_object().into_iter().flatten().filter(|(key, _)| !NOT_SHOWN.contains(&key.as_str()))
    {
        flatten(key, unit::of(key), value, &mut found);
    }
    for (row, (path, unit, value)) in (1..).zip(found) {
        let meaning = figures::find(&path).map_or("", |figure| figure.meaning.as_str());
        sheet.write_string(row, 0, path)?;
        match value {
            Value::Number(number) => cell(sheet, row, 1, &number.to_string())?,
            Value::String(text) => drop(sheet.write_string(row, 1, text)?),
            Value::Bool(is_so) => drop(sheet.write_boolean(row, 1, *is_so)?),
            _ => {}
        }
        sheet.write_string(row, 2, unit.unwrap_or_default())?;
        sheet.write_string(row, 3, meaning)?;
    }
    Ok(())
}

/// The values below `path`, which have the `unit` of the innermost name that says one.
fn flatten<'a>(
    path: &str,
    unit: Option<&'static str>,
    value: &'a Value,
    found: &mut Vec<(String, Option<&'static str>, &'a Value)>,
) {
    match value {
        Value::Object(parts) => {
            for (key, part) in parts {
                let path = format!("{path}.{key}");
                flatten(&path, unit::of(&path).or(unit), part, found);
            }
        }
        Value::Array(parts) => {
            for (number, part) in parts.iter().enumerate() {
                flatten(&format!("{path}.{}", number + 1), unit, part, found);
            }
        }
        _ => found.push((path.to_owned(), unit.filter(|_| value.is_number()), value)),
    }
}

fn meanings_sheet(sheet: &mut Worksheet, columns: &[[String; 4]]) -> Result<(), XlsxError> {
    heading(sheet, "columns", &["sheet", "column", "unit", "meaning"])?;
    for (column, width) in [14.0, 36.0, 26.0, 100.0].into_iter().enumerate() {
        sheet.set_column_width(column as u16, width)?;
    }
    for (row, texts) in (1..).zip(columns) {
        for (column, text) in (0..).zip(texts) {
            sheet.write_string(row, column, text)?;
        }
    }
    Ok(())
}
