//! A case in full: what must be so, what was found, what it rests on, what it cost, and its plots.

use super::case_figures;
use super::markup::{anchor, badge, margin_bar, table};
use super::stability_map;
use super::verdict::Verdict;
use super::words::{self, NONE, time};
use crate::report::html::number::count;
use crate::report::html::page::{escape, plots};
use crate::studies::validation::record::{CaseRecord, CaseRun, QuantityRecord, RunOutcome};

/// The section, open from the start where something is not as expected.
pub(super) fn html(case: &CaseRecord) -> String {
    let verdict = Verdict::of_case(case);
    let open = if verdict.is_failure() { " open" } else { "" };
    let figures = case_figures::all(case);
    let figures = if figures.is_empty() { String::new() } else { plots(&figures) };
    let stability = match stability_map::of_case(case) {
        map if map.is_empty() => map,
        map => format!("<h4>Outcomes over the range</h4>\n{map}"),
    };
    format!(
        "<details class=\"case\" id=\"{}\" data-verdict=\"{}\" data-group=\"{}\"{open}>\n\
         <summary><span class=\"case-title\">{}</span> {} <span class=\"muted\">{}</span></summary>\n{}\n{}{}{}{}{}</details>\n",
        anchor(case),
        verdict.class(),
        escape(&case.group),
        escape(&case.title),
        badge(verdict),
        escape(&case.name),
        facts(case),
        failure(case),
        quantities(case),
        stability,
        runs(case),
        figures,
    )
}

fn facts(case: &CaseRecord) -> String {
    let mut facts = format!("<p class=\"requirement\">{}</p>\n<dl class=\"facts\">\n", escape(&case.requirement));
    let mut fact = |name: &str, text: &str| {
        facts.push_str(&format!("<dt>{name}</dt><dd>{}</dd>\n", escape(text)));
    };
    if let Some(says) = &case.says {
        fact("What the source says", says);
    }
    if !case.rests_on.is_empty() {
        fact("Rests on estimates", &case.rests_on.join("; "));
    }
    if !case.targets.is_empty() {
        fact("Speaks to", &case.targets.join(", "));
    }
    fact("Kind", &format!("{}; {} tier; group {}", case.kind.title(), case.tier.name(), case.group));
    facts.push_str("</dl>\n");
    facts
}

fn failure(case: &CaseRecord) -> String {
    case.failure.as_ref().map_or_else(String::new, |failure| {
        format!(
            "<div class=\"notice\" role=\"alert\"><strong>Could not run.</strong>\n<pre>{}</pre></div>\n",
            escape(failure)
        )
    })
}

fn quantities(case: &CaseRecord) -> String {
    if case.quantities.is_empty() {
        return String::new();
    }
    let columns = ["quantity", "verdict", "value", "held against", "error", "of tolerance used"];
    let rows = case.quantities.iter().map(|quantity| {
        vec![
            escape(&quantity.name),
            badge(Verdict::of_quantity(quantity)),
            escape(&words::value(quantity)),
            escape(&words::criterion(quantity)),
            escape(&words::error(quantity)),
            margin_bar(words::used(quantity)),
        ]
    });
    let reasons: String = case.quantities.iter().map(reasons).collect();
    format!(
        "{}<details>\n<summary>Sources, uncertainties and reasons</summary>\n<dl class=\"reasons\">\n{reasons}</dl>\n</details>\n{}",
        table("quantities", &columns, rows),
        remarks(case)
    )
}

/// Where the reference comes from, how sure it is and why the tolerance is what it is.
fn reasons(quantity: &QuantityRecord) -> String {
    let with_unit = |value: f64| format!("{} {}", words::rough(value), quantity.unit).trim_end().to_owned();
    let mut said = vec![quantity.source.clone()];
    said.extend(quantity.uncertainty.map(|value| format!("uncertainty of the reference {}", with_unit(value))));
    said.extend(quantity.discretisation.map(|value| format!("the computation’s own resolution {}", with_unit(value))));
    said.extend(quantity.because.clone());
    let said: Vec<&str> =
        said.iter().map(|text| text.trim().trim_end_matches('.')).filter(|text| !text.is_empty()).collect();
    if said.is_empty() {
        return String::new();
    }
    format!("<dt>{}</dt><dd>{}.</dd>\n", escape(&quantity.name), escape(&said.join("; ")))
}

/// Why something is not expected to hold, or what is missing: not hidden, it is what readers must know.
fn remarks(case: &CaseRecord) -> String {
    let items: String = case
        .quantities
        .iter()
        .filter_map(|quantity| Some((quantity, quantity.remark.as_ref()?)))
        .map(|(quantity, remark)| {
            let verdict = badge(Verdict::of_quantity(quantity));
            format!("<li>{verdict} {}: {}</li>\n", escape(&quantity.name), escape(remark))
        })
        .collect();
    if items.is_empty() { items } else { format!("<ul class=\"remarks\">\n{items}</ul>\n") }
}

fn runs(case: &CaseRecord) -> String {
    if case.runs.is_empty() {
        return String::new();
    }
    let rows = case.runs.iter().map(|run| {
        vec![
            escape(&run.name),
            format!("<code>{}</code>", escape(&run.command)),
            outcomes(run),
            escape(&work(run)),
            time(run.wall_s),
        ]
    });
    format!("<h4>What it cost</h4>\n{}", table("runs", &["run", "as command", "outcome", "work", "time"], rows))
}

fn outcomes(run: &CaseRun) -> String {
    let of_one = |(outcome, number): (&RunOutcome, &usize)| {
        if run.members == 1 { outcome.title().to_owned() } else { format!("{number} {}", outcome.title()) }
    };
    let outcomes: Vec<String> = run.outcomes.iter().map(of_one).collect();
    if outcomes.is_empty() { NONE.to_owned() } else { escape(&outcomes.join(", ")) }
}

fn work(run: &CaseRun) -> String {
    let counts: Vec<String> = run
        .work
        .iter()
        .filter(|(_, counted)| **counted > 0)
        .map(|(name, &counted)| format!("{} {}", count(counted), words::counted_thing(name)))
        .collect();
    if counts.is_empty() { NONE.to_owned() } else { counts.join(", ") }
}
