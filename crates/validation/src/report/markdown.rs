//! `summary.md`: what a reader of a pull request wants to know, short enough for a comment.
//!
//! GitHub cuts no comment: it refuses one above 65 536 characters. Tables stop before that and say how many rows they leave
//! out; what needs attention comes first.

use super::totals::{self, Totals};
use super::verdict::Verdict;
use super::words::{self, counted, time};
use crate::record::{CaseRecord, Change, Changes, ValidationRecord};

/// Greatest size of each of the six tables in bytes: together below 45 000.
const TABLE_LIMIT: usize = 7_000;

/// Greatest number of characters of a cell: longer messages are on the page.
const CELL_LIMIT: usize = 600;

pub(super) fn text(record: &ValidationRecord, changes: Option<&Changes>) -> String {
    let all_stand = record.not_run.is_empty() && Totals::of(record).passed == record.cases.len();
    let verdict = if all_stand { "✓" } else { "✗" };
    let mut text = format!("## {verdict} Validation suite\n\n{}\n\n", escape(&totals::sentence(record)));
    if !record.not_run.is_empty() {
        let left_out = escape(&record.not_run.join(", "));
        text.push_str(&format!("**Not the whole suite:** it was interrupted before {left_out}.\n\n"));
    }
    text.push_str(&not_as_expected(record));
    if let Some(changes) = changes {
        text.push_str(&changed(changes));
    }
    for (verdict, one, many) in [
        (Verdict::KnownNot, "statement is known not to hold", "statements are known not to hold"),
        (Verdict::CannotBeCompared, "quantity cannot be compared", "quantities cannot be compared"),
    ] {
        text.push_str(&of_verdict(record, verdict, one, many));
    }
    text.push_str(&estimates(record));
    text.push_str(&all_cases(record));
    text.push_str(&format!(
        "gearwear {}, {} tier, {} in {}; details in `report.html`.\n",
        escape(&record.program_version),
        record.tier.map_or("no", |tier| tier.name()),
        counted(record.threads, "thread", "threads"),
        time(record.wall_s),
    ));
    text
}

fn not_as_expected(record: &ValidationRecord) -> String {
    let mut rows = Vec::new();
    for case in record.cases.iter().filter(|case| !case.passed()) {
        if let Some(failure) = &case.failure {
            rows.push(vec![signed(Verdict::CouldNotRun), case.name.clone(), words::NONE.to_owned(), failure.clone()]);
        }
        rows.extend(case.quantities.iter().filter(|quantity| !quantity.as_expected()).map(|quantity| {
            let verdict = Verdict::of_quantity(quantity);
            vec![signed(verdict), case.name.clone(), quantity.name.clone(), words::deviation(quantity)]
        }));
    }
    if rows.is_empty() {
        return String::new();
    }
    format!("### Not as expected\n\n{}\n", table(&["", "case", "quantity", "what was found"], &rows))
}

fn of_verdict(record: &ValidationRecord, verdict: Verdict, one: &str, many: &str) -> String {
    let mut rows = Vec::new();
    for case in &record.cases {
        for quantity in case.quantities.iter().filter(|quantity| Verdict::of_quantity(quantity) == verdict) {
            let target = quantity.target.clone().unwrap_or_else(|| case.targets.join(" "));
            rows.push(vec![target, case.name.clone(), quantity.name.clone(), words::deviation(quantity)]);
        }
    }
    let columns = ["target", "case", "quantity", "what was found, and why"];
    folded(&counted(rows.len(), one, many), &columns, &rows)
}

fn estimates(record: &ValidationRecord) -> String {
    let resting = record.cases.iter().filter(|case| !case.rests_on.is_empty());
    let resting: Vec<_> = resting.map(|case| vec![case.name.clone(), case.rests_on.join("; ")]).collect();
    let heading = counted(resting.len(), "case rests on an estimate", "cases rest on estimates");
    folded(&heading, &["case", "what is estimated"], &resting)
}

fn all_cases(record: &ValidationRecord) -> String {
    let rows: Vec<Vec<String>> = record.cases.iter().map(case_row).collect();
    let columns = ["", "group", "case", "of tolerance", "work", "time"];
    folded(&format!("What each of {} cost", counted(rows.len(), "case", "cases")), &columns, &rows)
}

fn case_row(case: &CaseRecord) -> Vec<String> {
    let share = words::share(words::tightest(case.quantities.iter()).map(|(_, share)| share));
    let [group, name] = [&case.group, &case.name].map(String::clone);
    vec![signed(Verdict::of_case(case)), group, name, share, words::main_work(case), time(case.wall_s)]
}

fn change_rows(changes: &[Change]) -> Vec<Vec<String>> {
    let cells = changes.iter().map(|c| [c.case.clone(), c.what.clone(), words::state(&c.before), words::state(&c.now)]);
    cells.map(Vec::from).collect()
}

fn changed(changes: &Changes) -> String {
    let against = format!("Against version {}", escape(&changes.against_version));
    if changes.worse.is_empty() && changes.better.is_empty() && changes.added.is_empty() && changes.gone.is_empty() {
        return format!("{against}: nothing changed beyond the noise.\n\n");
    }
    let columns = ["case", "what", "before", "now"];
    let mut text = format!("{against}: {} worse, {} better.\n\n", changes.worse.len(), changes.better.len());
    if !changes.worse.is_empty() {
        text.push_str(&format!("### Got worse\n\n{}\n", table(&columns, &change_rows(&changes.worse))));
    }
    text.push_str(&folded("What got better", &columns, &change_rows(&changes.better)));
    for (heading, names) in [("New cases", &changes.added), ("Cases that are gone", &changes.gone)] {
        if !names.is_empty() {
            text.push_str(&format!("{heading}: {}.\n\n", escape(&shortened(&names.join(", "), CELL_LIMIT))));
        }
    }
    text
}

/// A table behind a line that opens it; nothing where there are no rows.
fn folded(heading: &str, columns: &[&str], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    format!("<details>\n<summary>{heading}</summary>\n\n{}\n</details>\n\n", table(columns, rows))
}

/// Markdown table with as many rows as fit into [`TABLE_LIMIT`].
fn table(columns: &[&str], rows: &[Vec<String>]) -> String {
    let mut text = format!("| {} |\n|{}\n", columns.join(" | "), " --- |".repeat(columns.len()));
    for (written, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row.iter().map(|cell| escape(&shortened(cell, CELL_LIMIT))).collect();
        let line = format!("| {} |\n", cells.join(" | "));
        if text.len() + line.len() > TABLE_LIMIT {
            text.push_str(&format!("\n… and {} more in `report.html`.\n", rows.len() - written));
            break;
        }
        text.push_str(&line);
    }
    text
}

fn signed(verdict: Verdict) -> String {
    format!("{} {}", verdict.sign(), verdict.word())
}

/// The text, cut where it has more than `most` letters.
fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        None => text.to_owned(),
        Some((cut, _)) => format!("{}…", &text[..cut]),
    }
}

/// Text escaped for a table cell of Markdown.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\r' => escaped.push(' '),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            // `@` would notify a user.
            '@' => escaped.push_str("&#64;"),
            '|' | '\\' | '`' | '*' | '_' | '[' | ']' | '#' | '~' => {
                escaped.push('\\');
                escaped.push(c);
            }
            _ => escaped.push(c),
        }
    }
    escaped
}
