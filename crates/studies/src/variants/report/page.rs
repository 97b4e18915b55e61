//! `report.html` of runs side by side.

use gearwear::report::output_files;
use maud::{Markup, html};

use super::figures;
use crate::variants::finished_run::FinishedRun;
use crate::variants::record::{VariantRow, VariantsRecord};
use gearwear::report::html::number::{change, figure, percent};
use gearwear::report::html::page::{Page, Plots, files_list, note, section};
use gearwear::report::html::table::{Cell, NONE, line, list};
use gearwear_physics::results::run::ReportedBy;

const DATA_FILES: [(&str, &str); 3] = [
    ("variants.json", "the runs and the keys in which they differ"),
    ("variants.csv", "every figure of every run, its error and its difference to the first"),
    (output_files::COLUMNS, "what the columns of that table hold"),
];

pub(super) fn page(record: &VariantsRecord, runs: &[FinishedRun]) -> String {
    let names: Vec<&str> = record.runs.iter().map(|run| run.name.as_str()).collect();
    let plots = Plots::default();
    Page {
        kind: "Variants side by side",
        title: &names.join(" – "),
        byline: &runs[0].summary.report.as_ref().map(ReportedBy::line).unwrap_or_default(),
        answer: &record.answer,
        interruption: None,
        warnings: &record.warnings,
        main: html! {
            (section("figures", "Main figures", differences(record, &names)))
            (section("keys", "What differs between the scenes", keys(record, &names)))
            (section("plots", "Profiles and mesh cycle", plots.show(&figures::all(runs))))
            (section("sources", "Data", files_list(&DATA_FILES)))
        },
        plots,
        footer: &format!("gearwear {}", record.program_version),
    }
    .html()
}

/// Every figure with its error, and the difference of each variant to the first run.
fn differences(record: &VariantsRecord, names: &[&str]) -> Markup {
    let mut columns = vec![String::new(), names[0].to_owned()];
    columns.extend(
        names[1..]
            .iter()
            .flat_map(|name| [(*name).to_owned(), "difference".to_owned(), "more than the errors".to_owned()]),
    );
    let rows = record.figures().map(|of_runs| {
        let mut cells = vec![with_error(&of_runs[0])];
        for run in &of_runs[1..] {
            let difference = match (of_runs[0].value, run.value) {
                (Some(first), Some(value)) => change(first, value),
                _ => NONE.to_owned(),
            };
            let judged = match run.significant {
                Some(true) => "yes",
                Some(false) => "no",
                None => NONE,
            };
            cells.extend([with_error(run), Cell::from(difference), Cell::from(judged)]);
        }
        line([Cell::from(of_runs[0].named())].into_iter().chain(cells))
    });
    html! {
        (list("Each run with the error it states of itself, and its difference to the first", columns, rows))
        (note("A difference is more than the errors where it exceeds those of both runs together, each against the same \
               operation on finite elements; errors that are not stated are –."))
    }
}

fn with_error(row: &VariantRow) -> Cell {
    let Some(value) = row.value else { return Cell::from(NONE) };
    Cell::from(match row.error {
        Some(error) => format!("{} ± {}", figure(value), percent(error)),
        None => figure(value),
    })
}

fn keys(record: &VariantsRecord, names: &[&str]) -> Markup {
    if record.keys.is_empty() {
        return html! { p { "Their scenes are the same." } };
    }
    let columns = ["key"].into_iter().chain(names.iter().copied());
    let rows = record.keys.iter().map(|key| {
        let values = key.values.iter().map(|text| if text.is_empty() { NONE } else { text.as_str() });
        line([key.key.as_str()].into_iter().chain(values))
    });
    list("Keys", columns, rows)
}
