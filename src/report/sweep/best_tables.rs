//! The tables of the page: the best combination by each figure, and the combinations without a result.

use super::contour_figures::capitalised;
use super::section_plane::range;
use crate::report::html::number::{count, figure as shown_number, given};
use crate::report::html::page::escape;
use crate::simulation::sweep_figures::FIGURES;
use crate::simulation::sweep_record::{SweepRecord, SweepRow};

/// Combinations without a result that the page lists; all are in the table.
const MOST_LISTED: usize = 20;
/// The column of sentences.
const ERROR: &str = "error";

/// A table of text cells; the first column names the row, and a column called `error` holds sentences.
fn table(caption: &str, columns: &[String], rows: impl Iterator<Item = Vec<String>>) -> String {
    let class = |name: &String| if name == ERROR { " class=\"how\"" } else { "" };
    let head: String =
        columns.iter().map(|name| format!("<th scope=\"col\"{}>{}</th>", class(name), escape(name))).collect();
    let body: String = rows
        .map(|cells| {
            let mut cells = cells.iter().map(|cell| escape(cell)).zip(columns);
            let name = cells.next().map(|(cell, _)| cell).unwrap_or_default();
            let rest: String = cells.map(|(cell, column)| format!("<td{}>{cell}</td>", class(column))).collect();
            format!("<tr><th scope=\"row\">{name}</th>{rest}</tr>\n")
        })
        .collect();
    format!(
        "<table>\n<caption>{}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n",
        escape(caption)
    )
}

fn keys(record: &SweepRecord) -> impl Iterator<Item = String> + '_ {
    record.identity.axes.iter().map(|axis| axis.key.clone())
}

fn values(row: &SweepRow) -> impl Iterator<Item = String> + '_ {
    row.values.iter().map(|&value| given(value))
}

/// For each figure the range over all combinations, and where it is least.
pub fn best(record: &SweepRecord) -> String {
    let columns: Vec<String> =
        ["figure", "least", "greatest", "unit"].map(str::to_owned).into_iter().chain(keys(record)).collect();
    let rows = FIGURES.iter().filter_map(|figure| {
        let (least, greatest) = range(record, figure)?;
        let mut cells =
            vec![capitalised(figure.title), shown_number(least), shown_number(greatest), figure.unit.to_owned()];
        let best = record.least(figure).filter(|_| figure.less_is_better && least < greatest);
        match best {
            Some((row, _)) => cells.extend(values(row)),
            None => cells.extend(record.identity.axes.iter().map(|_| "–".to_owned())),
        }
        Some(cells)
    });
    table("Each figure over all combinations, and where it is least", &columns, rows)
}

/// The combinations without a result; empty where all have one.
pub fn failed(record: &SweepRecord) -> String {
    let failed: Vec<&SweepRow> = record.rows.iter().filter(|row| row.error.is_some()).collect();
    if failed.is_empty() {
        return String::new();
    }
    let columns: Vec<String> =
        ["combination".to_owned()].into_iter().chain(keys(record)).chain([ERROR.to_owned()]).collect();
    let rows = failed.iter().take(MOST_LISTED).map(|row| {
        let error = row.error.clone().unwrap_or_default();
        [row.index.to_string()].into_iter().chain(values(row)).chain([error]).collect()
    });
    let more = if failed.len() > MOST_LISTED { format!(", the first {MOST_LISTED}") } else { String::new() };
    let caption = format!("{} combinations without a result{more}", count(failed.len() as u64));
    format!("<div class=\"errors\">{}</div>\n", table(&caption, &columns, rows))
}
