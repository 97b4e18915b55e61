//! Section of a case: requirement, results, estimates, cost and plots.

use maud::{Markup, html};

use super::case_figures;
use super::markup::{anchor, badge, items, margin_bar, scrolling};
use super::stability_map;
use super::verdict::Verdict;
use super::words::{self, NONE, time};
use crate::record::{CaseRecord, CaseRun, QuantityRecord};
use gearwear::report::html::number::count;
use gearwear::report::html::page::Plots;
use gearwear::report::html::table::{cells, line};

/// The section, open from the start where something is not as expected.
pub(super) fn html(case: &CaseRecord, plots: &Plots) -> Markup {
    let verdict = Verdict::of_case(case);
    let charts = case_figures::all(case);
    let stability = stability_map::of_case(case);
    html! {
        details.case id=(anchor(case)) data-verdict=(verdict.class()) data-group=(case.group) open[verdict.is_failure()] {
            summary { span.case-title { (case.title) } " " (badge(verdict)) " " span.muted { (case.name) } }
            (facts(case))
            @if let Some(failure) = &case.failure {
                div.notice role="alert" { strong { "Could not run." } pre { (failure) } }
            }
            @if !case.quantities.is_empty() { (quantities(case)) }
            @if !stability.0.is_empty() { h4 { "Outcomes over the range" } (stability) }
            @if !case.runs.is_empty() { h4 { "What it cost" } (runs(case)) }
            @if !charts.is_empty() { (plots.show(&charts)) }
        }
    }
}

fn facts(case: &CaseRecord) -> Markup {
    let facts = [
        ("What the source says", case.says.clone().unwrap_or_default()),
        ("Rests on estimates", case.rests_on.join("; ")),
        ("Speaks to", case.targets.join(", ")),
        ("Kind", format!("{}; {} tier; group {}", case.kind.title(), case.tier.name(), case.group)),
    ];
    html! {
        p.requirement { (case.requirement) }
        dl.facts { @for (name, text) in facts { @if !text.is_empty() { dt { (name) } dd { (text) } } } }
    }
}

fn quantities(case: &CaseRecord) -> Markup {
    let columns = ["quantity", "verdict", "value", "compared with", "error", "of tolerance used"];
    let rows = case.quantities.iter().map(|quantity| {
        line(cells![
            &*quantity.name,
            badge(Verdict::of_quantity(quantity)),
            words::value(quantity),
            words::criterion(quantity),
            words::error(quantity),
            margin_bar(words::used(quantity)),
        ])
    });
    // Reasons of expected failures and missing references are always visible.
    let remarks = case.quantities.iter().filter_map(|quantity| {
        let remark = quantity.remark.as_ref()?;
        Some(html! { (badge(Verdict::of_quantity(quantity))) " " (quantity.name) ": " (remark) })
    });
    html! {
        (scrolling("quantities", &columns, rows))
        details {
            summary { "Sources, uncertainties and reasons" }
            dl.reasons {
                @for quantity in &case.quantities {
                    @if let Some(reasons) = reasons(quantity) { dt { (quantity.name) } dd { (reasons) "." } }
                }
            }
        }
        (items(Some("remarks"), remarks))
    }
}

/// Source and uncertainty of the reference and the reason for the tolerance.
fn reasons(quantity: &QuantityRecord) -> Option<String> {
    let mut said = vec![quantity.source.clone()];
    for (what, value) in [
        ("uncertainty of the reference", quantity.uncertainty),
        ("the computation’s own resolution", quantity.discretisation),
    ] {
        said.extend(value.map(|value| format!("{what} {} {}", words::rough(value), quantity.unit)));
    }
    said.extend(quantity.because.clone());
    let said: Vec<&str> =
        said.iter().map(|text| text.trim().trim_end_matches('.')).filter(|text| !text.is_empty()).collect();
    (!said.is_empty()).then(|| said.join("; "))
}

fn runs(case: &CaseRecord) -> Markup {
    let rows = case.runs.iter().map(|run| {
        line(cells![&*run.name, html! { code { (run.command) } }, outcomes(run), work(run), time(run.wall_s)])
    });
    scrolling("runs", &["run", "as command", "outcome", "work", "time"], rows)
}

fn outcomes(run: &CaseRun) -> String {
    joined(run.outcomes.iter().map(|(outcome, number)| {
        if run.members == 1 { outcome.title().to_owned() } else { format!("{number} {}", outcome.title()) }
    }))
}

fn work(run: &CaseRun) -> String {
    let counted = run.work.iter().filter(|(_, counted)| **counted > 0);
    joined(counted.map(|(name, &counted)| format!("{} {}", count(counted), words::counted_thing(name))))
}

fn joined(texts: impl Iterator<Item = String>) -> String {
    let texts: Vec<String> = texts.collect();
    if texts.is_empty() { NONE.to_owned() } else { texts.join(", ") }
}
