//! The tables of the page: the best combination by each figure, what finite elements say of those they verified, and the
//! combinations without a result.

use super::contour_figures::capitalised;
use super::section_plane::range;
use crate::report::html::number::{count, figure as shown_number, given, significant};
use crate::report::html::page::escape;
use crate::studies::sweep::figures::FIGURES;
use crate::studies::sweep::record::{SweepRecord, SweepRow};
use crate::studies::sweep::verification::{CLAIMS, OBJECTIVE, SweepVerification};

/// Combinations without a result that the page lists; all are in the table.
const MOST_LISTED: usize = 20;
/// The column of sentences.
const ERROR: &str = "error";

/// A table of text cells; the first column names the row, and a column called `error` holds sentences.
fn table(caption: &str, columns: &[String], rows: impl Iterator<Item = Vec<String>>) -> String {
    let class = |name: &String| if name == ERROR { " class=\"how\"" } else { "" };
    // A long key may go on in another line after each of its dots.
    let breakable = |name: &String| escape(name).replace('.', ".<wbr>");
    let head: String =
        columns.iter().map(|name| format!("<th scope=\"col\"{}>{}</th>", class(name), breakable(name))).collect();
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

/// A claim as a percentage: more than two digits it does not have.
pub fn within(claim: f64) -> String {
    significant(100.0 * claim, 2) + "\u{202f}%"
}

/// The claims of each verified combination, the worst of all below them, and the reasons of those without an answer.
pub fn verified(record: &SweepRecord, verification: &SweepVerification<'_>) -> String {
    let columns: Vec<String> = ["combination", "chosen as"]
        .map(str::to_owned)
        .into_iter()
        .chain(keys(record))
        .chain([OBJECTIVE.with_unit()])
        .chain(CLAIMS.iter().map(|claim| claim.title.to_owned()))
        .collect();
    let share = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), within);
    let rows = verification.rows.iter().map(|row| {
        let claims = CLAIMS.iter().map(|claim| share((claim.of)(&row.verification.total)));
        let name = [row.index.to_string(), row.verification.chosen.name().to_owned()];
        let wear = row.peak_wear_um.map_or_else(|| "–".to_owned(), shown_number);
        name.into_iter().chain(row.values.iter().map(|&value| given(value))).chain([wear]).chain(claims).collect()
    });
    let worst = CLAIMS
        .iter()
        .map(|claim| share(verification.worst.iter().find(|worst| worst.claim == claim.name).map(|worst| worst.value)));
    let blank = columns.iter().skip(1 + CLAIMS.len()).map(|_| String::new());
    let last = ["worst".to_owned()].into_iter().chain(blank).chain(worst).collect();
    let caption = "Relative difference of each to the same life on finite elements, their own uncertainty added";
    let unanswered = verification.rows.iter().filter(|row| !row.verification.has_answer()).map(|row| {
        let place = row.values.iter().map(|&value| given(value));
        [row.index.to_string()].into_iter().chain(place).chain([row.verification.total.how.clone()]).collect()
    });
    let reasons = match verification.unanswered {
        0 => String::new(),
        n => without(record, &format!("{n} chosen combinations without an answer of finite elements"), unanswered),
    };
    format!("<div class=\"phases\">{}</div>\n{reasons}", table(caption, &columns, rows.chain([last])))
}

/// A table of combinations with the reason why something is missing of each.
fn without(record: &SweepRecord, caption: &str, rows: impl Iterator<Item = Vec<String>>) -> String {
    let columns: Vec<String> =
        ["combination".to_owned()].into_iter().chain(keys(record)).chain([ERROR.to_owned()]).collect();
    format!("<div class=\"errors\">{}</div>\n", table(caption, &columns, rows))
}

/// The combinations without a result; empty where all have one.
pub fn failed(record: &SweepRecord) -> String {
    let failed: Vec<&SweepRow> = record.rows.iter().filter(|row| row.error.is_some()).collect();
    if failed.is_empty() {
        return String::new();
    }
    let rows = failed.iter().take(MOST_LISTED).map(|row| {
        let error = row.error.clone().unwrap_or_default();
        [row.index.to_string()].into_iter().chain(values(row)).chain([error]).collect()
    });
    let more = if failed.len() > MOST_LISTED { format!(", the first {MOST_LISTED}") } else { String::new() };
    without(record, &format!("{} combinations without a result{more}", count(failed.len() as u64)), rows)
}
