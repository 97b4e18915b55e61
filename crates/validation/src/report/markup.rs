//! The pieces of HTML that the parts of the page share: tables that scroll by themselves, verdicts, margin bars, links.

use maud::{Markup, html};

use super::verdict::Verdict;
use super::words;
use crate::record::CaseRecord;
use gearwear::report::html::table::whole;

/// A table in a box of its own, in which it scrolls.
pub(super) fn scrolling(class: &str, columns: &[&str], rows: impl IntoIterator<Item = Markup>) -> Markup {
    html! {
        div.scrolls tabindex="0" role="region" aria-label="table, scrolls" {
            (whole(Some(class), None, columns.iter().copied(), rows))
        }
    }
}

/// A verdict as sign and word, in its colour.
pub(super) fn badge(verdict: Verdict) -> Markup {
    html! {
        span class={ "verdict " (verdict.class()) } { span aria-hidden="true" { (verdict.sign()) } " " (verdict.word()) }
    }
}

/// The share of a tolerance as a bar with its number; nothing drawn where there is none.
pub(super) fn margin_bar(share: Option<f64>) -> Markup {
    let Some(used) = share.filter(|share| share.is_finite()) else { return html! { (words::NONE) } };
    let width = format!("width:{:.1}%", 100.0 * used.clamp(0.0, 1.0));
    html! { span.bar.over[used > 1.0] aria-hidden="true" { i style=(width) {} } " " (words::share(share)) }
}

/// A list, where there is anything in it.
pub(super) fn items(class: Option<&str>, items: impl IntoIterator<Item = Markup>) -> Markup {
    let mut items = items.into_iter().peekable();
    html! { @if items.peek().is_some() { ul class=[class] { @for item in items { li { (item) } } } } }
}

pub(super) fn anchor(case: &CaseRecord) -> String {
    format!("case-{}", identifier(&case.name))
}

pub(super) fn link(case: &CaseRecord, text: &str) -> Markup {
    html! { a href={ "#" (anchor(case)) } { (text) } }
}

/// Letters, digits and hyphens of a name.
pub(super) fn identifier(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect()
}
