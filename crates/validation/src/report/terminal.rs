//! The suite for the terminal: a line for each case, then what is not as it should be, then the totals.

use comfy_table::presets::NOTHING;
use comfy_table::{ContentArrangement, Table};

use super::totals;
use super::verdict::Verdict;
use super::words::{self, time};
use crate::record::{CaseRecord, Changes, ValidationRecord};

/// Least width of a table with the group and the quantity closest to its bound.
const WITH_QUANTITY: u16 = 90;
/// Least width of a table that has the work too.
const WITH_WORK: u16 = 125;
/// Greatest length of a quantity's name, so that it fits on a line.
const NAME: usize = 36;

/// A line a case, the details of whatever is not as expected, and the totals; cells wrap at `width` columns.
pub fn terminal(record: &ValidationRecord, changes: Option<&Changes>, width: Option<u16>) -> String {
    let text =
        [cases(record, width), not_as_expected(record), changes.map_or_else(String::new, changed), totals(record)];
    // Terminals draw the thin spaces of the pages as wide ones or not at all.
    text.concat().replace(['\u{2009}', '\u{202f}'], " ")
}

fn cases(record: &ValidationRecord, width: Option<u16>) -> String {
    let mut table = Table::new();
    table.load_style(NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    if let Some(width) = width {
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(width);
    }
    table.set_header(shown(width, ["", "group", "case", "tol. used", "by", "work", "time"].map(str::to_owned)));
    for case in &record.cases {
        let verdict = Verdict::of_case(case);
        let tightest = words::tightest(case.quantities.iter());
        table.add_row(shown(
            width,
            [
                format!("{} {}", verdict.sign(), verdict.word()),
                case.group.clone(),
                case.name.clone(),
                words::share(tightest.map(|(_, share)| share)),
                tightest.map_or_else(String::new, |(quantity, _)| shortened(&quantity.name)),
                words::main_work(case),
                time(case.wall_s),
            ],
        ));
    }
    format!("{}\n", table.trim_fmt())
}

/// Cells that fit into the width.
fn shown(width: Option<u16>, cells: [String; 7]) -> Vec<String> {
    const LEAST_WIDTH: [u16; 7] = [0, WITH_QUANTITY, 0, 0, WITH_QUANTITY, WITH_WORK, 0];
    let shown = cells.into_iter().zip(LEAST_WIDTH).filter(|&(_, least)| width.is_none_or(|width| width >= least));
    shown.map(|(cell, _)| cell).collect()
}

fn shortened(name: &str) -> String {
    if name.chars().count() <= NAME {
        return name.to_owned();
    }
    format!("{}…", name.chars().take(NAME - 1).collect::<String>().trim_end())
}

fn not_as_expected(record: &ValidationRecord) -> String {
    record.cases.iter().filter(|case| !case.passed()).map(deviations).collect()
}

fn deviations(case: &CaseRecord) -> String {
    let mut text = format!("\n{} {}: {}\n", Verdict::of_case(case).sign(), case.name, case.requirement);
    if let Some(failure) = &case.failure {
        text.push_str(&format!("    could not run: {}\n", failure.replace('\n', "\n    ")));
    }
    for quantity in case.quantities.iter().filter(|quantity| !quantity.as_expected()) {
        let verdict = Verdict::of_quantity(quantity);
        text.push_str(&format!("    {}: {}: {}\n", quantity.name, verdict.word(), words::deviation(quantity)));
        text.push_str(&format!("        source: {}\n", quantity.source));
    }
    text
}

fn changed(changes: &Changes) -> String {
    let mut text = format!(
        "\nagainst version {}: {} worse, {} better, {} added, {} gone\n",
        changes.against_version,
        changes.worse.len(),
        changes.better.len(),
        changes.added.len(),
        changes.gone.len()
    );
    for (word, changes) in [("worse ", &changes.worse), ("better", &changes.better)] {
        for change in changes {
            text.push_str(&format!(
                "    {word} {}: {}: {} → {}\n",
                change.case,
                change.what,
                words::state(&change.before),
                words::state(&change.now)
            ));
        }
    }
    text
}

fn totals(record: &ValidationRecord) -> String {
    let interrupted = match record.not_run.as_slice() {
        [] => String::new(),
        left_out => format!("interrupted: this is not the whole suite; not run: {}\n", left_out.join(", ")),
    };
    format!("\n{interrupted}{}\n", totals::sentence(record))
}
