//! All cases in one table, by group: verdict, margin, cost and marks, with the controls that choose among them.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::markup::{badge, link, margin_bar, scrolling};
use super::verdict::Verdict;
use super::words::{self, counted, time};
use crate::record::{CaseRecord, ValidationRecord};
use gearwear::report::html::table::{cells, inner};

pub(super) fn html(record: &ValidationRecord) -> Markup {
    let rows = groups(record).into_iter().map(|group| {
        html! {
            tr.group data-group=(group) { th scope="rowgroup" colspan="6" { (group) } }
            @for case in record.cases.iter().filter(|case| case.group == group) { (case_row(case)) }
        }
    });
    let columns = ["case", "verdict", "of tolerance used", "work", "time", "marks"];
    html! { (controls(record)) (scrolling("overview", &columns, rows)) }
}

/// The groups in the order in which they first occur.
pub(super) fn groups(record: &ValidationRecord) -> Vec<&str> {
    let mut seen = BTreeSet::new();
    record.cases.iter().map(|case| case.group.as_str()).filter(|group| seen.insert(*group)).collect()
}

fn case_row(case: &CaseRecord) -> Markup {
    let verdict = Verdict::of_case(case);
    let tightest = words::tightest(case.quantities.iter());
    let cells = cells![
        html! { (link(case, &case.title)) br; span.muted { (case.name) } },
        badge(verdict),
        html! {
            (margin_bar(tightest.map(|(_, share)| share)))
            @if let Some((quantity, _)) = tightest { br; span.muted { (quantity.name) } }
        },
        words::main_work(case),
        time(case.wall_s),
        marks(case),
    ];
    html! { tr data-verdict=(verdict.class()) data-group=(case.group) { (inner(cells)) } }
}

/// Marks beside the verdict: targets, estimates, quantities that do not hold or cannot be compared.
fn marks(case: &CaseRecord) -> Markup {
    let mut marks: Vec<Markup> = case.targets.iter().map(|target| html! { b { (target) } }).collect();
    if !case.rests_on.is_empty() {
        marks.push(html! { "estimate" });
    }
    for (wanted, one, many) in [
        (Verdict::KnownNot, "does not hold", "do not hold"),
        (Verdict::CannotBeCompared, "not comparable", "not comparable"),
    ] {
        match case.quantities.iter().filter(|quantity| Verdict::of_quantity(quantity) == wanted).count() {
            0 => {}
            number => marks.push(html! { (counted(number, one, many)) }),
        }
    }
    html! { @for (i, mark) in marks.iter().enumerate() { @if i > 0 { ", " } (mark) } }
}

/// Choices by verdict and group; shown by the script that serves them.
fn controls(record: &ValidationRecord) -> Markup {
    let verdicts: Vec<Verdict> = record.cases.iter().map(Verdict::of_case).collect();
    let counts = Verdict::ALL.map(|wanted| (wanted, verdicts.iter().filter(|verdict| **verdict == wanted).count()));
    html! {
        form.filter #filter hidden {
            fieldset {
                legend { "Show" }
                @for (verdict, cases) in counts.into_iter().filter(|(_, cases)| *cases > 0) {
                    label {
                        input type="checkbox" value=(verdict.class()) checked;
                        " " (badge(verdict)) " (" (cases) ")"
                    }
                    " "
                }
            }
            label {
                "Group "
                select {
                    option value="" { "all" }
                    @for group in groups(record) { option { (group) } }
                }
            }
        }
    }
}
