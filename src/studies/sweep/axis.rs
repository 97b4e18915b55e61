//! A key that is varied, as the user writes it: `KEY=FROM:TO:COUNT`.

use std::str::FromStr;

use crate::scene::draft::other_way_to_say;
use crate::scene::key::{KeyError, NumberKey};
use crate::studies::sweep::record::{SweepAxis, plain};

/// Values of one key.
pub(crate) const MOST_VALUES: usize = 100_000;
/// Combinations of a sweep.
pub(crate) const MOST_COMBINATIONS: usize = 1_000_000;

const FORM: &str = "KEY=FROM:TO:COUNT, such as pair.face_width_mm=10:30:21";

/// What is wrong with what is to be varied.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum AxisError {
    /// Not of the form `KEY=FROM:TO:COUNT`.
    #[error("found {given:?}; allowed: {FORM}")]
    Form { given: String },
    #[error(transparent)]
    Key(#[from] KeyError),
    #[error("{key}: found {found:?} as {end}; allowed: a finite number, in {FORM}")]
    NotANumber { key: String, end: &'static str, found: String },
    #[error("{key}: found {found:?} as COUNT; allowed: a whole number from 1 to {MOST_VALUES}")]
    Count { key: String, found: String },
    #[error("{key}: found the range {from}:{to}, which is reversed; allowed: FROM below TO", from = plain(*.from), to = plain(*.to))]
    Reversed { key: String, from: f64, to: f64 },
    /// One value, but two ends.
    #[error("{key}: found 1 value for the range {from}:{to}; allowed: a COUNT of at least 2, or {from}:{from}:1", from = plain(*.from), to = plain(*.to))]
    OneValue { key: String, from: f64, to: f64 },
    /// Several values, but one end.
    #[error("{key}: found {count} values for the range {from}:{from}; allowed: {from}:{from}:1, or FROM below TO", from = plain(*.from))]
    SameEnds { key: String, from: f64, count: usize },
    /// A value between whole numbers for a key that takes only those.
    #[error("{key}: found the value {value}; allowed: whole numbers, so choose a COUNT that steps over whole numbers")]
    NotWhole {
        key: String,
        /// The first such value.
        value: f64,
    },
    /// No value is one that the key takes.
    #[error("{key}: found {from} to {to}; allowed: {allowed}", from = plain(*.from), to = plain(*.to))]
    NotAllowed { key: String, from: f64, to: f64, allowed: String },
    #[error("found {key} twice; allowed: each key once")]
    Twice { key: String },
    #[error("found {key} and {other}, which say the same thing; allowed: one of the two")]
    SaidTwice { key: String, other: String },
    /// More combinations than can be kept.
    #[error("found {count} combinations; allowed: at most {MOST_COMBINATIONS}")]
    TooMany {
        /// How many, in words where they cannot be counted.
        count: String,
    },
}

impl AxisError {
    /// What to do about it, where the message does not say it.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Key(KeyError::Unknown { nearest: Some(nearest), .. }) => Some(format!("did you mean {nearest}?")),
            Self::Key(_) => Some("gearwear schema prints all keys with their ranges".to_owned()),
            _ => None,
        }
    }
}

/// Reads `KEY=FROM:TO:COUNT` and checks it against what the key takes.
///
/// A range that lies partly outside what the key takes is kept: those combinations become rows with their error.
pub(crate) fn parse(given: &str) -> Result<SweepAxis, AxisError> {
    let form = || AxisError::Form { given: given.to_owned() };
    let (key, range) = given.split_once('=').ok_or_else(form)?;
    let key = key.trim();
    let parts: Vec<&str> = range.split(':').map(str::trim).collect();
    let [from, to, count] = parts[..] else { return Err(form()) };
    let takes = NumberKey::find(key)?;
    let owned = || key.to_owned();
    let end = |end: &'static str, text: &str| {
        let value = f64::from_str(text).ok().filter(|value| value.is_finite());
        value.ok_or_else(|| AxisError::NotANumber { key: owned(), end, found: text.to_owned() })
    };
    let (from, to) = (end("FROM", from)?, end("TO", to)?);
    let counted = count.parse::<usize>().ok().filter(|count| (1..=MOST_VALUES).contains(count));
    let count = counted.ok_or_else(|| AxisError::Count { key: owned(), found: count.to_owned() })?;
    if from > to {
        return Err(AxisError::Reversed { key: owned(), from, to });
    }
    match (count, from == to) {
        (1, false) => return Err(AxisError::OneValue { key: owned(), from, to }),
        (2.., true) => return Err(AxisError::SameEnds { key: owned(), from, count }),
        _ => {}
    }
    let axis = SweepAxis { key: owned(), from, to, count, whole: takes.whole() };
    let values = axis.values();
    if let Some(&value) = values.iter().find(|value| axis.whole && value.fract() != 0.0) {
        return Err(AxisError::NotWhole { key: owned(), value });
    }
    if !values.iter().any(|&value| takes.holds(value)) {
        return Err(AxisError::NotAllowed { key: owned(), from, to, allowed: takes.allowed() });
    }
    Ok(axis)
}

/// Reads all of them and checks that they go together.
pub(crate) fn parse_all<'a>(given: impl IntoIterator<Item = &'a str>) -> Result<Vec<SweepAxis>, AxisError> {
    let mut axes: Vec<SweepAxis> = Vec::new();
    for given in given {
        let axis = parse(given)?;
        for before in &axes {
            if before.key == axis.key {
                return Err(AxisError::Twice { key: axis.key });
            }
            if other_way_to_say(&axis.key) == Some(before.key.as_str()) {
                return Err(AxisError::SaidTwice { key: before.key.clone(), other: axis.key });
            }
        }
        axes.push(axis);
    }
    let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.count));
    match count {
        Some(count) if count <= MOST_COMBINATIONS => Ok(axes),
        Some(count) => Err(AxisError::TooMany { count: count.to_string() }),
        None => Err(AxisError::TooMany { count: "more than can be counted as".to_owned() }),
    }
}

/// Values of `axis` that the key does not take, in words; `None` where it takes all.
pub(crate) fn partly_not_allowed(axis: &SweepAxis) -> Option<String> {
    let takes = NumberKey::find(&axis.key).ok()?;
    let refused = axis.values().into_iter().filter(|&value| !takes.holds(value)).count();
    let (key, allowed, all) = (&axis.key, takes.allowed(), axis.count);
    (refused > 0).then(|| format!("{key}: {refused} of {all} values are not allowed ({allowed}): rows with an error"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(given: &[&str]) -> String {
        parse_all(given.iter().copied()).unwrap_err().to_string()
    }

    #[test]
    fn a_range_is_read() {
        let axis = parse("pair.face_width_mm=10:30:21").unwrap();
        assert_eq!(axis.values()[..3], [10.0, 11.0, 12.0]);
        assert_eq!((axis.values().len(), axis.whole), (21, false));
        let teeth = parse(" pair.pinion.teeth = 16 : 20 : 3 ").unwrap();
        assert_eq!((teeth.values(), teeth.whole), (vec![16.0, 18.0, 20.0], true));
        assert_eq!(parse("wear.coefficient_m2_per_N=1e-18:1e-18:1").unwrap().values(), [1e-18]);
        // A range that is partly bad is a sweep with some bad rows.
        let widths = parse("pair.face_width_mm=-10:10:3").unwrap();
        assert!(partly_not_allowed(&widths).unwrap().contains("2 of 3"));
        assert_eq!(partly_not_allowed(&axis), None);
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (given, parts) in [
            (&["pair.face_width_mm"][..], &["found \"pair.face_width_mm\"", "KEY=FROM:TO:COUNT"][..]),
            (&["pair.face_width_mm=10:30"], &["KEY=FROM:TO:COUNT"]),
            (&["pair.face_width_mm=10:30:21:2"], &["KEY=FROM:TO:COUNT"]),
            (&["pair.face_widht_mm=10:30:21"], &["unknown key pair.face_widht_mm"]),
            (&["contact.surface=1:2:2"], &["contact.surface takes", "\"winkler\""]),
            (&["pair.face_width_mm=ten:30:21"], &["\"ten\" as FROM"]),
            (&["pair.face_width_mm=10:inf:21"], &["\"inf\" as TO"]),
            (&["pair.face_width_mm=10:30:0"], &["\"0\" as COUNT", "from 1 to 100000"]),
            (&["pair.face_width_mm=10:30:2.5"], &["\"2.5\" as COUNT"]),
            (&["pair.face_width_mm=10:30:-1"], &["\"-1\" as COUNT"]),
            (&["pair.face_width_mm=30:10:21"], &["30:10, which is reversed", "FROM below TO"]),
            (&["pair.face_width_mm=10:30:1"], &["found 1 value", "10:10:1"]),
            (&["pair.face_width_mm=10:10:5"], &["found 5 values"]),
            (&["pair.pinion.teeth=16:20:4"], &["pair.pinion.teeth: found the value 17.33"]),
            (&["pair.pinion.teeth=1:3:3"], &["found 1 to 3", "at least 5"]),
            (&["pair.face_width_mm=10:30:2", "pair.face_width_mm=10:30:2"], &["pair.face_width_mm twice"]),
            (&["operation.hours=1:2:2", "operation.pinion_revolutions=1:2:2"], &["say the same thing"]),
            (&["operation.hours=1:2:10000", "pair.face_width_mm=10:30:101"], &["found 1010000 combinations"]),
        ] {
            let message = message(given);
            for part in parts {
                assert!(message.contains(part), "{part:?} in {message}");
            }
        }
        assert_eq!(parse("pair.width_mm=1:2:2").unwrap_err().help().unwrap(), "did you mean pair.face_width_mm?");
    }
}
