//! The stability map: a row for each parameter, a mark for each value that was tried, by how the run ended.
//!
//! A row has its own axis from the least to the greatest value, logarithmic where all are positive and span more than a
//! factor of ten. Marks differ by sign as well as by colour, and one that is not as expected stands in a ring; those are
//! also listed in words below, so that nothing depends on hovering.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::markup::{items, link};
use super::words::as_written;
use crate::record::{CaseRecord, RunOutcome, StabilityPoint, ValidationRecord};

/// Least ratio of the greatest to the least value for a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 10.0;

/// The sign of each outcome.
const SIGNS: [(RunOutcome, &str); 6] = [
    (RunOutcome::Sound, "●"),
    (RunOutcome::Refused, "■"),
    (RunOutcome::NotConverged, "▲"),
    (RunOutcome::WornThrough, "▼"),
    (RunOutcome::Unsound, "✕"),
    (RunOutcome::Panicked, "✖"),
];

/// The map over all cases; empty where none has such points.
pub(super) fn all(record: &ValidationRecord) -> Markup {
    map(record.cases.iter(), link)
}

/// The rows of one case.
pub(super) fn of_case(case: &CaseRecord) -> Markup {
    map([case].into_iter(), |_, parameter| html! { (parameter) })
}

/// A row for each parameter of the cases, named by `name`.
fn map<'a>(cases: impl Iterator<Item = &'a CaseRecord> + Clone, name: impl Fn(&CaseRecord, &str) -> Markup) -> Markup {
    let rows = cases.clone().flat_map(|case| by_parameter(case).into_iter().map(move |row| (case, row)));
    let mut rows = rows.peekable();
    if rows.peek().is_none() {
        return Markup::default();
    }
    let points = cases.flat_map(|case| &case.stability);
    let mut unexpected = points.filter(|point| point.outcome != point.expected).peekable();
    html! {
        p.key {
            @for (outcome, sign) in SIGNS { span { b class=(outcome.name()) { (sign) } " " (outcome.title()) } " " }
            span { b.ring { "○" } " not as expected" }
        }
        div.stability { @for (case, (parameter, points)) in rows { (row(name(case, parameter), &points)) } }
        @if unexpected.peek().is_some() {
            p { "Not as expected:" }
            (items(None, unexpected.map(|point| html! { (point.parameter) ": " (said(point)) })))
        }
    }
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

fn row(name: Markup, points: &[&StabilityPoint]) -> Markup {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Markup::default() };
    let (low, high) = (first.value, last.value);
    let logarithmic = low > 0.0 && high / low > LOGARITHMIC_FROM;
    let axis = if low == high {
        as_written(low)
    } else {
        format!("{} to {}{}", as_written(low), as_written(high), if logarithmic { ", logarithmic" } else { "" })
    };
    let marks = points.iter().map(|point| {
        let value = point.value;
        let share = if logarithmic { (value / low).ln() / (high / low).ln() } else { (value - low) / (high - low) };
        let place = format!("left:{:.2}%", if share.is_finite() { 100.0 * share } else { 50.0 });
        html! {
            span class={ "mark " (point.outcome.name()) @if point.outcome != point.expected { " ring" } } style=(place) {
                @for (outcome, sign) in SIGNS { @if outcome == point.outcome { (sign) } }
            }
            span.say { (said(point)) }
        }
    });
    html! {
        div.parameter {
            span { (name) } " " span.muted { (axis) }
            div.track { @for mark in marks { (mark) } }
        }
    }
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
