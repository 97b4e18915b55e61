//! The tables of the page: the best combination by each figure, what finite elements say of those they verified, and the
//! combinations without a result.

use maud::{Markup, PreEscaped, html};

use super::section_plane::range;
use crate::evaluate::figure;
use crate::report::html::number::{count, given, significant};
use crate::report::html::reading::capitalised;
use crate::report::html::table::{Cell, NONE, cells, line, list};
use crate::scene::opened::SceneKind;
use crate::sweep::goal::Optimum;
use crate::sweep::record::{SweepAxis, SweepRecord, SweepRow};
use crate::sweep::verification::{SweepVerification, objective};

/// Greatest number of combinations without a result on the page; all are in the table.
const MOST_LISTED: usize = 20;
/// The varied keys as columns. A long one may go on in another line after each of its dots.
fn keys(record: &SweepRecord) -> impl Iterator<Item = Cell> + '_ {
    record.identity.axes.iter().map(|axis| {
        let parts = axis.key.split('.').enumerate();
        html! { @for (i, part) in parts { @if i > 0 { "." (PreEscaped("<wbr>")) } (part) } }.into()
    })
}

fn values<'a>(record: &'a SweepRecord, values: &'a [f64]) -> impl Iterator<Item = Cell> + 'a {
    record.identity.axes.iter().zip(values).map(|(axis, &value)| shown_value(axis, value).into())
}

/// A value of a varied key, with its digits in groups.
pub(super) fn shown_value(axis: &SweepAxis, value: f64) -> String {
    axis.word(value).map_or_else(|| given(value), str::to_owned)
}

/// For each figure the range over all combinations, and where it is least.
pub(super) fn best(record: &SweepRecord) -> Markup {
    let columns = cells!["figure", "minimum", "maximum", "unit"].into_iter().chain(keys(record));
    let columns = columns.chain([Cell::sentence("remark")]);
    let rows = figure::in_sweeps(record.identity.kind).iter().filter_map(|figure| {
        let (least, greatest) = range(record, figure)?;
        let cells = cells![capitalised(&figure.heading), least, greatest, figure.unit()].into_iter();
        let best = record.minimum(figure).filter(|_| figure.less_is_better() && least < greatest);
        Some(match best {
            Some(best) => line(cells.chain(values(record, &best.row.values)).chain([Cell::sentence(best.remark())])),
            None => line(cells.chain(record.identity.axes.iter().map(|_| NONE.into())).chain(["".into()])),
        })
    });
    list("Each figure over all combinations, and where its minimum is", columns, rows)
}

/// Optimum, and the combinations that equal it within the error.
pub(super) fn optimum(kind: SceneKind, optimum: &Optimum) -> Markup {
    let figure = optimum.goal.figure(kind);
    html! {
        p {
            "Objective: the lowest " (optimum.goal.in_words()) ". It is " b { (significant(optimum.value, 4)) " " (figure.unit()) }
            " in combination " (optimum.index) "; "
            (count(optimum.within_limits as u64)) " combinations satisfy the constraints. "
            @match (&optimum.error, &optimum.plateau, &optimum.plateau_keys) {
                (Some(error), Some(plateau), Some(keys)) => {
                    "The error of this figure is " (within(*error)) ", the largest that a verified combination states: "
                    @if plateau.len() == 1 {
                        "every other combination is worse by more than that."
                    } @else {
                        (count(plateau.len() as u64)) " combinations cannot be told from it within that error, with " (keys.join("; ")) "."
                    }
                }
                _ => { "The number of equivalent combinations is not known: " (optimum.why_no_error.as_deref().unwrap_or_default()) "." }
            }
        }
    }
}

/// An error as a percentage with two digits.
pub(super) fn within(claim: f64) -> String {
    significant(100.0 * claim, 2) + "\u{202f}%"
}

/// Errors of each verified combination, the greatest of all below them, and the reasons of those without a result.
pub(super) fn verified(record: &SweepRecord, verification: &SweepVerification<'_>) -> Markup {
    let claims = figure::claims(record.identity.kind).iter().map(|claim| claim.title.as_str().into());
    let columns = cells!["combination", "chosen as"].into_iter().chain(keys(record));
    let columns = columns.chain([objective(&record.identity).with_unit().into()]).chain(claims);
    let rows = verification.rows.iter().map(|row| {
        let claims = figure::claims(record.identity.kind)
            .iter()
            .map(|claim| Cell::from(claim.of(&row.verification.total).map(within)));
        let name = cells![row.index.to_string(), row.verification.chosen.name()].into_iter();
        line(name.chain(values(record, row.values)).chain([row.objective.into()]).chain(claims))
    });
    let worst = figure::claims(record.identity.kind).iter().map(|claim| {
        let worst = verification.worst.iter().find(|worst| worst.claim == claim.name);
        Cell::from(worst.map(|worst| within(worst.value)))
    });
    let blank = (0..record.identity.axes.len() + 2).map(|_| "".into());
    let last = line(["worst".into()].into_iter().chain(blank).chain(worst));
    let caption =
        "Relative difference of each to the same wear simulation with finite elements, their own uncertainty added";
    let unanswered = verification.rows.iter().filter(|row| !row.verification.has_answer());
    let reasons = unanswered.map(|row| (row.index, row.values, row.verification.how()));
    html! {
        div.phases { (list(caption, columns, rows.chain([last]))) }
        @if verification.unanswered > 0 {
            (without(record, format!("{} chosen combinations without an answer of finite elements", verification.unanswered), reasons))
        }
    }
}

/// Table of combinations, number and values, with the reason of what is missing.
fn without<'a>(
    record: &SweepRecord,
    caption: String,
    rows: impl Iterator<Item = (usize, &'a [f64], String)>,
) -> Markup {
    let columns = ["combination".into()].into_iter().chain(keys(record)).chain([Cell::sentence("error")]);
    let rows = rows.map(|(index, at, reason)| {
        line([index.to_string().into()].into_iter().chain(values(record, at)).chain([Cell::sentence(reason)]))
    });
    html! { div.errors { (list(caption, columns, rows)) } }
}

/// The combinations without a result; empty where all have one.
pub(super) fn failed(record: &SweepRecord) -> Markup {
    let failed: Vec<&SweepRow> = record.rows.iter().filter(|row| row.error.is_some()).collect();
    if failed.is_empty() {
        return Markup::default();
    }
    let more = if failed.len() > MOST_LISTED { format!(", the first {MOST_LISTED}") } else { String::new() };
    let caption = format!("{} combinations without a result{more}", count(failed.len() as u64));
    let listed = failed.iter().take(MOST_LISTED);
    without(record, caption, listed.map(|row| (row.index, &*row.values, row.error.clone().unwrap_or_default())))
}
