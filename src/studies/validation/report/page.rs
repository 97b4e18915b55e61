//! `report.html` of the validation suite: what holds, by what margin, what it cost, what rests on estimates.
//!
//! The page goes from the answer to its grounds: tiles, what is not as it should be, the statements of the thesis, all cases
//! in one table, the stability map, error against run time, and then each case in full behind its title. Plots behind
//! closed titles are drawn when they are opened.

use super::markup::{badge, link, row, scrolling};
use super::totals::{self, Totals};
use super::verdict::Verdict;
use super::words::{self, time};
use super::{case_section, overview, stability_map, targets_table, work_precision_figures};
use crate::report::html::page::{Page, escape, plots, section};
use crate::studies::validation::record::{Change, Changes, ValidationRecord};

/// The data files named in the page, which lie beside it.
const DATA_FILES: &[(&str, &str)] = &[
    ("validation.json", "the whole record but the plots: what a later run is compared with"),
    ("work_precision.json", "error against cost of every setting"),
    #[cfg(feature = "program")]
    ("junit.xml", "a test for each quantity, for services that collect test results"),
    ("summary.md", "the summary for a comment"),
];

/// The whole page.
pub(super) fn page(record: &ValidationRecord, changes: Option<&Changes>) -> String {
    let parts = [
        ("wrong", "Not as it should be", not_as_expected(record)),
        ("changes", "What changed", changes.map_or_else(String::new, changed)),
        ("targets", "What the thesis says", targets(record)),
        ("cases", "All cases", overview::html(record)),
        ("stability", "Stability map", stability(record)),
        ("cost", "Error against run time", work_precision(record)),
        ("details", "Case by case", cases(record)),
        ("sources", "Data", files()),
    ];
    let sections: String = parts
        .iter()
        .filter(|(.., html)| !html.is_empty())
        .map(|(id, heading, html)| section(id, heading, html))
        .collect();
    let tier = record.tier.map_or_else(String::new, |tier| format!(" · {} tier", tier.name()));
    Page {
        kind: "Validation suite",
        title: "What gearwear’s results can be held to",
        answer: &totals::sentence(record),
        interruption: (!record.not_run.is_empty())
            .then_some("The suite was interrupted; the cases shown are those that were finished."),
        warnings: &[],
        main: &format!("{}{sections}", tiles(record)),
        footer: &format!("gearwear {}{tier}", record.program_version),
    }
    .html_with(include_str!("validation.css"), include_str!("validation.js"))
}

fn tiles(record: &ValidationRecord) -> String {
    let t = Totals::of(record);
    let tile = |class: &str, number: String, words: &str| {
        format!("<div class=\"tile {class}\"><b>{number}</b> <span>{words}</span></div>\n")
    };
    let alarm = |number: usize, class: &'static str| if number > 0 { class } else { "quiet" };
    let wrong = t.missed + t.could_not_run;
    let unit = |one: &'static str, many: &'static str, number: usize| if number == 1 { one } else { many };
    [
        "<div class=\"tiles\">\n".to_owned(),
        tile(
            if wrong == 0 { "holds" } else { "" },
            format!("{} / {}", t.passed, t.cases),
            "cases stand as they should",
        ),
        tile(alarm(wrong, "missed"), wrong.to_string(), "missed or could not run"),
        tile("", format!("{} / {}", t.hold, t.quantities), "quantities hold"),
        tile(
            alarm(t.known_not, "known-not"),
            t.known_not.to_string(),
            unit("statement known not to hold", "statements known not to hold", t.known_not),
        ),
        tile(
            alarm(t.cannot_be_compared, "not-comparable"),
            t.cannot_be_compared.to_string(),
            unit("quantity cannot be compared", "quantities cannot be compared", t.cannot_be_compared),
        ),
        tile(
            "",
            t.on_estimates.to_string(),
            unit("case rests on an estimate", "cases rest on estimates", t.on_estimates),
        ),
        tile("", time(record.wall_s), &format!("on {}", words::counted(record.threads, "thread", "threads"))),
        "</div>\n".to_owned(),
    ]
    .concat()
}

fn not_as_expected(record: &ValidationRecord) -> String {
    let mut items = String::new();
    for case in record.cases.iter().filter(|case| !case.passed()) {
        let found: String = case
            .failure
            .iter()
            .map(|failure| format!("<li>{}</li>\n", escape(failure)))
            .chain(case.quantities.iter().filter(|quantity| !quantity.as_expected()).map(|quantity| {
                format!("<li>{}: {}</li>\n", escape(&quantity.name), escape(&words::deviation(quantity)))
            }))
            .collect();
        items.push_str(&format!(
            "<li>{} {}\n<ul>\n{found}</ul></li>\n",
            badge(Verdict::of_case(case)),
            link(case, &case.title)
        ));
    }
    if items.is_empty() { items } else { format!("<ul class=\"wrong\">\n{items}</ul>\n") }
}

fn changed(changes: &Changes) -> String {
    let version = format!("<p>Against a run of version {}.</p>\n", escape(&changes.against_version));
    let rows = |word: &str, changes: &[Change]| -> String {
        let cells = |change: &Change| {
            let (before, now) = (words::state(&change.before), words::state(&change.now));
            [&change.case, &change.what, &before, &now].map(|text| escape(text)).to_vec()
        };
        changes
            .iter()
            .map(|change| [vec![word.to_owned()], cells(change)].concat())
            .map(|cells| row("", &cells))
            .collect()
    };
    let all = [rows("↓ worse", &changes.worse), rows("↑ better", &changes.better)].concat();
    let table = if all.is_empty() {
        "<p>No verdict changed, and no error or work by more than the noise.</p>\n".to_owned()
    } else {
        scrolling("changes", &["", "case", "what", "before", "now"], &all)
    };
    let names: String = [("New cases", &changes.added), ("Cases that are gone", &changes.gone)]
        .into_iter()
        .filter(|(_, names)| !names.is_empty())
        .map(|(what, names)| format!("<p>{what}: {}.</p>\n", escape(&names.join(", "))))
        .collect();
    [version, table, names].concat()
}

fn targets(record: &ValidationRecord) -> String {
    let table = targets_table::html(record);
    if table.is_empty() {
        return table;
    }
    format!(
        "<p class=\"legend-note\">The statements of the thesis that can be computed, in our own words. The measured curves exist \
         only as pictures, so that what rests on them is compared with their axes and with what the text says.</p>\n{table}"
    )
}

fn stability(record: &ValidationRecord) -> String {
    let map = stability_map::all(record);
    if map.is_empty() {
        return map;
    }
    format!(
        "<p class=\"legend-note\">Each row is a parameter over its range, each mark a run with that value. A run is sound where it \
         is complete, every number is finite, no wear is negative and every position is in equilibrium. A refusal with a \
         message can be the right answer. Point at a mark to read what was said.</p>\n{map}"
    )
}

fn work_precision(record: &ValidationRecord) -> String {
    let figures = work_precision_figures::all(record);
    if figures.is_empty() {
        return String::new();
    }
    format!(
        "<p class=\"legend-note\">Errors and work counts are judged; wall times depend on the machine and are only reported.</p>\n{}",
        plots(&figures)
    )
}

fn cases(record: &ValidationRecord) -> String {
    overview::groups(record)
        .into_iter()
        .map(|group| {
            let of_group: String =
                record.cases.iter().filter(|case| case.group == group).map(case_section::html).collect();
            format!("<h3 class=\"group\">{}</h3>\n{of_group}", escape(group))
        })
        .collect()
}

fn files() -> String {
    let items: String =
        DATA_FILES.iter().map(|(name, what)| format!("<li><a href=\"{name}\">{name}</a> {what}</li>\n")).collect();
    format!("<ul class=\"files\">\n{items}</ul>\n")
}
