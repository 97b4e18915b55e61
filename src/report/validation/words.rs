//! What the reports say of a quantity, in plain text: its value, what it is held against, how far off it is and why.

use super::verdict::Verdict;
use crate::report::html::number::{count, figure, given, percent, significant};
use crate::simulation::validation_record::{CaseRecord, Criterion, QuantityRecord};

/// Stands where there is no number.
pub(super) const NONE: &str = "–";

/// The value with its unit; a statement's in words.
pub(super) fn value(quantity: &QuantityRecord) -> String {
    match (quantity.value, quantity.criterion) {
        (None, _) => NONE.to_owned(),
        (Some(value), Criterion::True) => if value == 0.0 { "no" } else { "yes" }.to_owned(),
        (Some(value), _) => with_unit(&digits(value), &quantity.unit),
    }
}

/// Four digits or so; whole numbers keep all of theirs.
fn digits(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e9 { given(value) } else { figure(value) }
}

fn with_unit(text: &str, unit: &str) -> String {
    if unit.is_empty() { text.to_owned() } else { format!("{text} {unit}") }
}

/// What it is held against, with the unit.
pub(super) fn criterion(quantity: &QuantityRecord) -> String {
    let text = match quantity.criterion {
        Criterion::Near { reference, tolerance } => format!("{} ± {}", digits(reference), significant(tolerance, 2)),
        Criterion::AtLeast { bound } => format!("≥ {}", given(bound)),
        Criterion::AtMost { bound } => format!("≤ {}", given(bound)),
        Criterion::Between { low, high } => format!("{} to {}", given(low), given(high)),
        Criterion::True => return "must be so".to_owned(),
        Criterion::Reported => return NONE.to_owned(),
    };
    with_unit(&text, &quantity.unit)
}

/// How far it is from its reference: relative where that makes sense.
pub(super) fn error(quantity: &QuantityRecord) -> String {
    match (quantity.relative_error, quantity.error) {
        (Some(relative), _) if relative.is_finite() => percent(relative),
        (_, Some(error)) => with_unit(&significant(error, 2), &quantity.unit),
        (_, None) => NONE.to_owned(),
    }
}

/// The share of its tolerance that it uses.
pub(super) fn share(share: Option<f64>) -> String {
    let Some(share) = share.filter(|share| share.is_finite()) else { return NONE.to_owned() };
    if share >= 10.0 {
        format!("{} ×", significant(share, 2))
    } else {
        format!("{}\u{202f}%", given((100.0 * share).round()))
    }
}

/// Everything about a quantity that is not as it should be, in a line.
pub(super) fn deviation(quantity: &QuantityRecord) -> String {
    let verdict = Verdict::of_quantity(quantity);
    let mut text = match (quantity.value, quantity.criterion) {
        (None, _) => "could not be computed".to_owned(),
        (Some(_), Criterion::Reported) => value(quantity),
        (Some(_), _) => format!("{}, held against {}", value(quantity), criterion(quantity)),
    };
    if quantity.share.is_some_and(|share| share > 1.0) {
        text.push_str(&format!(" ({} of the tolerance)", share(quantity.share)));
    }
    if verdict.is_failure() {
        text.push_str(&format!("; expected: {}", quantity.expected.title()));
    }
    for remark in [&quantity.remark, &quantity.because].into_iter().flatten() {
        text.push_str(&format!("; {}", remark.trim_end_matches('.')));
    }
    text
}

/// The quantity that uses most of its tolerance, and how much: of those that fail unexpectedly first.
pub(super) fn tightest(case: &CaseRecord) -> Option<(&QuantityRecord, f64)> {
    let among = |wanted: fn(Verdict) -> bool| {
        case.quantities
            .iter()
            .filter(|quantity| wanted(Verdict::of_quantity(quantity)))
            .filter_map(|quantity| Some((quantity, quantity.share.filter(|share| share.is_finite())?)))
            .reduce(|most, next| if next.1 > most.1 { next } else { most })
    };
    among(|verdict| verdict == Verdict::Missed)
        .or_else(|| among(|verdict| !verdict.is_failure() && verdict != Verdict::KnownNot))
}

/// The greatest of the work counts: what the time went into.
pub(super) fn main_work(case: &CaseRecord) -> String {
    let most = case.work.iter().reduce(|most, next| if next.1 > most.1 { next } else { most });
    most.map_or_else(|| NONE.to_owned(), |(name, &counted)| format!("{} {name}", count(counted)))
}

/// A wall time, unit included.
pub(super) fn time(wall_s: f64) -> String {
    if wall_s < 0.001 {
        "< 1 ms".to_owned()
    } else if wall_s < 1.0 {
        format!("{} ms", significant(1000.0 * wall_s, 2))
    } else if wall_s < 120.0 {
        format!("{} s", significant(wall_s, 3))
    } else {
        let whole = wall_s.round() as u64;
        format!("{} min {:02} s", whole / 60, whole % 60)
    }
}

/// `1 case`, `2 cases`.
pub(super) fn counted(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}
