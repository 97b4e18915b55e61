//! The stability map: a row for each parameter, a mark for each value that was tried, by how the run ended.
//!
//! A row has its own axis from the least to the greatest value, logarithmic where all are positive and span more than a
//! factor of ten. Marks differ by sign as well as by colour, and one that is not as expected stands in a ring; those are
//! also listed in words below, so that nothing depends on hovering.

use std::collections::BTreeMap;

use super::markup::link;
use super::words::as_written;
use crate::report::html::page::escape;
use crate::studies::validation::record::{CaseRecord, RunOutcome, StabilityPoint, ValidationRecord};

/// How many times the least value the greatest must be for a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 10.0;

const OUTCOMES: [RunOutcome; 5] =
    [RunOutcome::Sound, RunOutcome::Refused, RunOutcome::NotConverged, RunOutcome::Unsound, RunOutcome::Panicked];

fn sign(outcome: RunOutcome) -> &'static str {
    match outcome {
        RunOutcome::Sound => "●",
        RunOutcome::Refused => "■",
        RunOutcome::NotConverged => "▲",
        RunOutcome::Unsound => "✕",
        RunOutcome::Panicked => "✖",
    }
}

/// The map over all cases; empty where none has such points.
pub(super) fn all(record: &ValidationRecord) -> String {
    let rows: String = record
        .cases
        .iter()
        .flat_map(|case| by_parameter(case).into_iter().map(move |(parameter, points)| (case, parameter, points)))
        .map(|(case, parameter, points)| row(&link(case, parameter), &points))
        .collect();
    if rows.is_empty() { rows } else { map(&rows, &unexpected(record.cases.iter())) }
}

/// The rows of one case.
pub(super) fn of_case(case: &CaseRecord) -> String {
    let rows: String =
        by_parameter(case).into_iter().map(|(parameter, points)| row(&escape(parameter), &points)).collect();
    if rows.is_empty() { rows } else { map(&rows, &unexpected([case].into_iter())) }
}

fn map(rows: &str, unexpected: &str) -> String {
    let key: String = OUTCOMES
        .into_iter()
        .map(|outcome| {
            format!("<span><b class=\"{}\">{}</b> {}</span>\n", outcome.name(), sign(outcome), outcome.title())
        })
        .collect();
    format!(
        "<p class=\"key\">{key}<span><b class=\"ring\">○</b> not as expected</span></p>\n\
         <div class=\"stability\">\n{rows}</div>\n{unexpected}"
    )
}

/// The points of each parameter, by value; parameters by name.
fn by_parameter(case: &CaseRecord) -> BTreeMap<&str, Vec<&StabilityPoint>> {
    let mut rows: BTreeMap<&str, Vec<&StabilityPoint>> = BTreeMap::new();
    for point in case.stability.iter().filter(|point| point.value.is_finite()) {
        rows.entry(&point.parameter).or_default().push(point);
    }
    for points in rows.values_mut() {
        points.sort_by(|a, b| a.value.total_cmp(&b.value));
    }
    rows
}

fn row(name: &str, points: &[&StabilityPoint]) -> String {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return String::new() };
    let (low, high) = (first.value, last.value);
    let logarithmic = low > 0.0 && high / low > LOGARITHMIC_FROM;
    let place = |value: f64| {
        let share = if logarithmic { (value / low).ln() / (high / low).ln() } else { (value - low) / (high - low) };
        if share.is_finite() { 100.0 * share } else { 50.0 }
    };
    let marks: String = points
        .iter()
        .map(|point| {
            let ring = if point.outcome == point.expected { "" } else { " ring" };
            format!(
                "<span class=\"mark {}{ring}\" style=\"left:{:.2}%\">{}</span><span class=\"say\">{}</span>\n",
                point.outcome.name(),
                place(point.value),
                sign(point.outcome),
                escape(&said(point))
            )
        })
        .collect();
    let axis = if low == high {
        as_written(low)
    } else {
        format!("{} to {}{}", as_written(low), as_written(high), if logarithmic { ", logarithmic" } else { "" })
    };
    format!(
        "<div class=\"parameter\"><span>{name}</span> <span class=\"muted\">{axis}</span>\n\
         <div class=\"track\">{marks}</div></div>\n"
    )
}

/// The setting, how it ended and what the program said.
fn said(point: &StabilityPoint) -> String {
    let mut text = format!("{}: {}", point.setting, point.outcome.title());
    if point.outcome != point.expected {
        text.push_str(&format!(" (expected: {})", point.expected.title()));
    }
    if let Some(said) = &point.said {
        text.push_str(&format!(". {said}"));
    }
    text
}

fn unexpected<'a>(cases: impl Iterator<Item = &'a CaseRecord>) -> String {
    let items: String = cases
        .flat_map(|case| case.stability.iter())
        .filter(|point| point.outcome != point.expected)
        .map(|point| format!("<li>{}: {}</li>\n", escape(&point.parameter), escape(&said(point))))
        .collect();
    if items.is_empty() { items } else { format!("<p>Not as expected:</p>\n<ul>\n{items}</ul>\n") }
}
