//! Texts of a quantity: its value, its criterion, its error and the reasons.

use super::verdict::Verdict;
use crate::record::{CaseRecord, ComparedState, Criterion, QuantityRecord, Standing};
use gearwear::report::html::number::{count, figure, given, percent, significant, to_digits};

/// Placeholder of a missing number.
pub(super) const NONE: &str = "–";

/// The value with its unit; a statement's in words.
pub(super) fn value(quantity: &QuantityRecord) -> String {
    match (quantity.value, quantity.criterion) {
        (None, _) => NONE.to_owned(),
        (Some(value), Criterion::True) => if value == 0.0 { "no" } else { "yes" }.to_owned(),
        (Some(value), Criterion::Near { tolerance, .. }) => with_unit(&resolved(value, tolerance), &quantity.unit),
        (Some(value), _) => with_unit(&digits(value), &quantity.unit),
    }
}

/// Number with three or four digits; whole numbers with all.
fn digits(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e6 { given(value) } else { figure(value) }
}

/// Number with digits down to a tenth of the tolerance.
fn resolved(value: f64, tolerance: f64) -> String {
    let needed = (10.0 * value / tolerance).abs().log10().ceil();
    if needed > 4.0 && needed < 12.0 { significant(value, needed as usize) } else { digits(value) }
}

/// Uncertainty with two digits.
pub(super) fn rough(value: f64) -> String {
    as_written(to_digits(value, 2))
}

/// Bound or setting in its shortest form, with powers of ten.
pub(super) fn as_written(value: f64) -> String {
    let text = given(value);
    match text.split_once('\u{2009}') {
        Some((mantissa, power)) if power.starts_with('×') => {
            let power = power.trim_start_matches(['×', '\u{2009}']);
            match mantissa.trim_start_matches('−') {
                "1" => format!("{}{power}", if value < 0.0 { "−" } else { "" }),
                short => format!("{}{short}\u{2009}×\u{2009}{power}", if value < 0.0 { "−" } else { "" }),
            }
        }
        _ => text,
    }
}

fn with_unit(text: &str, unit: &str) -> String {
    if unit.is_empty() { text.to_owned() } else { format!("{text} {unit}") }
}

/// Criterion with its unit.
pub(super) fn criterion(quantity: &QuantityRecord) -> String {
    match quantity.criterion {
        Criterion::True | Criterion::Reported => limit(quantity.criterion),
        other => with_unit(&limit(other), &quantity.unit),
    }
}

/// A criterion without its unit.
fn limit(criterion: Criterion) -> String {
    match criterion {
        Criterion::Near { reference, tolerance: 0.0 } => format!("exactly {}", as_written(reference)),
        Criterion::Near { reference, tolerance } => {
            format!("{} ± {}", resolved(reference, tolerance), rough(tolerance))
        }
        Criterion::AtLeast { bound } => format!("≥ {}", as_written(bound)),
        Criterion::AtMost { bound } => format!("≤ {}", as_written(bound)),
        Criterion::Between { low, high } => format!("{} to {}", as_written(low), as_written(high)),
        Criterion::True => "must be so".to_owned(),
        Criterion::Reported => NONE.to_owned(),
    }
}

/// One side of a change.
pub(super) fn state(state: &ComparedState) -> String {
    match state {
        ComparedState::Ran(true) => "ran".to_owned(),
        ComparedState::Ran(false) => "could not run".to_owned(),
        ComparedState::Absent => "not there".to_owned(),
        ComparedState::Stands(standing) => standing.title(),
        ComparedState::Ended(outcome) => outcome.title().to_owned(),
        ComparedState::Uses(used) => format!("{} of the tolerance", share(Some(*used))),
        ComparedState::Is(value, unit) => {
            value.map_or_else(|| NONE.to_owned(), |value| with_unit(&digits(value), unit))
        }
        ComparedState::Errs(error, unit) => format!("an error of {}", with_unit(&significant(*error, 2), unit)),
        ComparedState::Against(criterion) => limit(*criterion),
        ComparedState::Counted(number) => count(*number),
    }
}

/// Error of a quantity: relative where that makes sense.
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

/// Line about a quantity that is not as expected.
pub(super) fn deviation(quantity: &QuantityRecord) -> String {
    let mut text = match (quantity.value, quantity.criterion) {
        (None, _) => "could not be computed".to_owned(),
        (Some(_), Criterion::Reported) => value(quantity),
        (Some(_), _) => format!("{}, compared with {}", value(quantity), criterion(quantity)),
    };
    if quantity.share.is_some_and(|share| share > 1.0) && matches!(quantity.criterion, Criterion::Near { .. }) {
        text.push_str(&format!(" ({} of the tolerance)", share(quantity.share)));
    }
    if quantity.expected != Standing::Holds && Verdict::of_quantity(quantity).is_failure() {
        text.push_str(&format!("; expected: {}", quantity.expected.title()));
    }
    for remark in [&quantity.remark, &quantity.because].into_iter().flatten() {
        text.push_str(&format!("; {}", remark.trim_end_matches('.')));
    }
    text
}

/// Share of the tolerance or bound that a quantity uses; above 1 it does not hold.
///
/// Beside the record's own shares, of references and of upper bounds: of a lower bound as bound ÷ value, of a range by the way
/// from its middle.
pub(super) fn used(quantity: &QuantityRecord) -> Option<f64> {
    // Counts have no margin.
    if let Criterion::AtLeast { bound } | Criterion::AtMost { bound } = quantity.criterion
        && quantity.unit.is_empty()
        && bound.fract() == 0.0
        && quantity.value.is_some_and(|value| value.fract() == 0.0)
        && !quantity.counts_work
    {
        return None;
    }
    let share = match (quantity.share, quantity.value, quantity.criterion) {
        (None, Some(value), Criterion::AtLeast { bound }) if bound > 0.0 && value > 0.0 => Some(bound / value),
        (None, Some(value), Criterion::Between { low, high }) if low < high => {
            Some((2.0 * value - low - high).abs() / (high - low))
        }
        (share, ..) => share,
    };
    share.filter(|share| share.is_finite())
}

/// Quantity that uses most of its tolerance, and the share: of those that are missed, if any. Work counts are named only where one is missed, since
/// their bounds are close to their values.
pub(super) fn tightest<'a>(
    quantities: impl Iterator<Item = &'a QuantityRecord> + Clone,
) -> Option<(&'a QuantityRecord, f64)> {
    [Verdict::Missed, Verdict::Holds].into_iter().find_map(|wanted| {
        quantities
            .clone()
            .filter(|quantity| Verdict::of_quantity(quantity) == wanted)
            .filter(|quantity| wanted == Verdict::Missed || !quantity.counts_work)
            .filter_map(|quantity| Some((quantity, used(quantity)?)))
            .reduce(|most, next| if next.1 > most.1 { next } else { most })
    })
}

/// Greatest of the work counts.
pub(super) fn main_work(case: &CaseRecord) -> String {
    let most = case.work.iter().reduce(|most, next| if next.1 > most.1 { next } else { most });
    most.map_or_else(|| NONE.to_owned(), |(name, &counted)| format!("{} {}", count(counted), counted_thing(name)))
}

/// Name of a work count as words.
pub(super) fn counted_thing(name: &str) -> String {
    name.replace('_', " ")
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
