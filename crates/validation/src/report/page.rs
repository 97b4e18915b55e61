//! `report.html` of the validation suite: what holds, by what margin, what it cost, what rests on estimates.
//!
//! The page goes from the answer to its grounds: tiles, what is not as it should be, the statements of the thesis, all cases
//! in one table, the stability map, error against run time, and then each case in full behind its title. Plots behind
//! closed titles are drawn when they are opened.

use maud::{Markup, html};

use super::markup::{badge, items, link, scrolling};
use super::totals::{self, Totals};
use super::verdict::Verdict;
use super::words::{self, time};
use super::{
    JUNIT, LAST, SUMMARY, WORK_PRECISION, case_section, overview, stability_map, targets_table, work_precision_figures,
};
use crate::record::{Change, Changes, ValidationRecord};
use gearwear::report::html::page::{Page, Plots, files_list, note, section};
use gearwear::report::html::table::{cells, line};

/// The data files named in the page, which lie beside it.
const DATA_FILES: &[(&str, &str)] = &[
    (LAST, "the whole record but the plots: what a later run is compared with"),
    (WORK_PRECISION, "error against cost of every setting"),
    (JUNIT, "a test for each quantity, for services that collect test results"),
    (SUMMARY, "the summary for a comment"),
];

pub(super) fn page(record: &ValidationRecord, changes: Option<&Changes>) -> String {
    let plots = Plots::default();
    let parts = [
        ("wrong", "Not as expected", not_as_expected(record)),
        ("changes", "What changed", changes.map_or_else(Markup::default, changed)),
        ("targets", "Statements of the thesis", targets_table::html(record)),
        ("cases", "All cases", overview::html(record)),
        ("stability", "Stability map", stability(record)),
        ("cost", "Error against run time", work_precision(record, &plots)),
        ("details", "Case by case", cases(record, &plots)),
        ("sources", "Data", files_list(DATA_FILES)),
    ];
    let tier = record.tier.map_or_else(String::new, |tier| format!(" · {} tier", tier.name()));
    Page {
        kind: "Validation suite",
        title: "Validation report",
        byline: "",
        answer: &totals::sentence(record),
        interruption: (!record.not_run.is_empty())
            .then_some("The suite was interrupted; the cases shown are those that were finished."),
        warnings: &[],
        main: html! {
            (tiles(record))
            @for (id, heading, content) in parts { @if !content.0.is_empty() { (section(id, heading, content)) } }
        },
        plots,
        footer: &format!("gearwear {}{tier}", record.program_version),
    }
    .html_with(include_str!("validation.css"), include_str!("validation.js"))
}

/// `class` where there is something to look at.
fn alarm(number: usize, class: &'static str) -> &'static str {
    if number > 0 { class } else { "quiet" }
}

/// Class, number and words of a count.
fn tile<'a>(class: &'a str, number: usize, one: &'a str, many: &'a str) -> (&'a str, String, &'a str) {
    (class, number.to_string(), if number == 1 { one } else { many })
}

fn tiles(record: &ValidationRecord) -> Markup {
    let t = Totals::of(record);
    let wrong = t.missed + t.could_not_run;
    let (known_not, open) = (t.known_not, t.cannot_be_compared);
    let threads = format!("on {}", words::counted(record.threads, "thread", "threads"));
    let all_well = if wrong == 0 { "holds" } else { "" };
    let tiles = [
        (all_well, format!("{} / {}", t.passed, t.cases), "cases as expected"),
        (alarm(wrong, "missed"), wrong.to_string(), "missed or could not run"),
        ("", format!("{} / {}", t.hold, t.quantities), "quantities hold"),
        tile(alarm(known_not, "known-not"), known_not, "statement known not to hold", "statements known not to hold"),
        tile(alarm(open, "not-comparable"), open, "quantity cannot be compared", "quantities cannot be compared"),
        tile("", t.on_estimates, "case rests on an estimate", "cases rest on estimates"),
        ("", time(record.wall_s), &threads),
    ];
    html! {
        div.tiles { @for (class, number, words) in tiles { div class={ "tile " (class) } { b { (number) } " " span { (words) } } } }
    }
}

fn not_as_expected(record: &ValidationRecord) -> Markup {
    let cases = record.cases.iter().filter(|case| !case.passed()).map(|case| {
        let failure = case.failure.iter().map(|failure| html! { (failure) });
        let missed = case.quantities.iter().filter(|quantity| !quantity.as_expected());
        let missed = missed.map(|quantity| html! { (quantity.name) ": " (words::deviation(quantity)) });
        html! {
            (badge(Verdict::of_case(case))) " " (link(case, &case.title))
            ul { @for found in failure.chain(missed) { li { (found) } } }
        }
    });
    items(Some("wrong"), cases)
}

fn change_row(word: &'static str, change: &Change) -> Markup {
    let (before, now) = (words::state(&change.before), words::state(&change.now));
    line(cells![word, &*change.case, &*change.what, before, now])
}

fn changed(changes: &Changes) -> Markup {
    let worse = changes.worse.iter().map(|change| change_row("↓ worse", change));
    let rows: Vec<Markup> = worse.chain(changes.better.iter().map(|change| change_row("↑ better", change))).collect();
    html! {
        p { "Against a run of version " (changes.against_version) "." }
        @if rows.is_empty() {
            p { "No verdict changed, and no error or work by more than the noise." }
        } @else {
            (scrolling("changes", &["", "case", "what", "before", "now"], rows))
        }
        @for (what, names) in [("New cases", &changes.added), ("Cases that are gone", &changes.gone)] {
            @if !names.is_empty() { p { (what) ": " (names.join(", ")) "." } }
        }
    }
}

fn stability(record: &ValidationRecord) -> Markup {
    let map = stability_map::all(record);
    html! {
        @if !map.0.is_empty() {
            (note(
                "Each row is a parameter over its range, each mark a run with that value. A run is sound where it is complete, every \
                 number is finite, no wear is negative and every position is in equilibrium. A refusal with a message can be the \
                 right answer. Point at a mark to read what was said."
            ))
            (map)
        }
    }
}

fn work_precision(record: &ValidationRecord, plots: &Plots) -> Markup {
    let charts = work_precision_figures::all(record);
    html! {
        @if !charts.is_empty() {
            (note("Errors and work counts are judged; wall times depend on the machine and are only reported."))
            (plots.show(&charts))
        }
    }
}

fn cases(record: &ValidationRecord, plots: &Plots) -> Markup {
    html! {
        @for group in overview::groups(record) {
            h3.group { (group) }
            @for case in record.cases.iter().filter(|case| case.group == group) { (case_section::html(case, plots)) }
        }
    }
}
