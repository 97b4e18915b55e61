//! A key that is varied, as the user writes it: `KEY=FROM:TO:COUNT`, `KEY=FROM:TO:COUNT:log` or `KEY=VALUE,VALUE,…`, whose values are
//! numbers or words.

use std::str::FromStr;

use crate::scene::decimal_comma;
use crate::scene::draft::Draft;
use crate::scene::key::{self, KeyError, NumberKey, linked_keys};
use crate::scene::problem::number;
use crate::scene::table::other_ways_to_say;
use crate::sweep::record::{AxisSpacing, SweepAxis};
use crate::varied_scene::missing_phase;

/// Greatest number of values of one key.
pub const MOST_VALUES: usize = 100_000;
/// Greatest number of combinations of a sweep.
pub const MOST_COMBINATIONS: usize = 1_000_000;

const FORM: &str =
    "KEY=FROM:TO:COUNT, such as pair.face_width_mm=10:30:21, with :log for equal ratios, or KEY=VALUE,VALUE,…";

/// Errors of a varied key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AxisError {
    /// None of the forms.
    #[error("found {given:?}; allowed: {FORM}")]
    Form { given: String },
    #[error(transparent)]
    Key(#[from] KeyError),
    #[error("{key}: found {found:?} as {end}; allowed: a finite number, in {FORM}")]
    NotANumber { key: String, end: &'static str, found: String },
    #[error("{key}: found {found:?} as COUNT; allowed: a whole number from 1 to {MOST_VALUES}")]
    Count { key: String, found: String },
    #[error("{key}: found the range {from}:{to}, which is reversed; allowed: FROM below TO", from = number(*.from), to = number(*.to))]
    Reversed { key: String, from: f64, to: f64 },
    /// One value for two ends.
    #[error("{key}: found 1 value for the range {from}:{to}; allowed: a COUNT of at least 2, or {from}:{from}:1", from = number(*.from), to = number(*.to))]
    OneValue { key: String, from: f64, to: f64 },
    /// Several values for equal ends.
    #[error("{key}: found {count} values for the range {from}:{from}; allowed: {from}:{from}:1, or FROM below TO", from = number(*.from))]
    SameEnds { key: String, from: f64, count: usize },
    /// Equal ratios between numbers that are not both positive.
    #[error("{key}: found the range {from}:{to} by equal ratios; allowed: FROM above 0", from = number(*.from), to = number(*.to))]
    NoRatio { key: String, from: f64, to: f64 },
    /// A list that is not rising.
    #[error("{key}: found {value} after {before}; allowed: rising values", value = number(*.value), before = number(*.before))]
    NotRising { key: String, before: f64, value: f64 },
    /// None of the words that the key takes.
    #[error("{key}: found {found:?}; allowed: a list of {allowed}")]
    NotAWord { key: String, found: String, allowed: String },
    #[error("{key}: found {word:?} twice; allowed: each word once")]
    WordTwice { key: String, word: String },
    /// A phase that the scene does not have.
    #[error("found {key}; allowed: a phase that the scene has, numbered from 1")]
    NoPhase { key: String },
    /// Unclosed braces.
    #[error("found {key:?}; allowed: alternatives in braces, such as pair.{{pinion,wheel}}.tip_rounding_mm")]
    Braces { key: String },
    /// A fractional value of a key that takes whole numbers.
    #[error("{key}: found the value {value}; allowed: whole numbers, so choose a COUNT that steps over whole numbers")]
    NotWhole {
        key: String,
        /// The first such value.
        value: f64,
    },
    /// No value is allowed for the key.
    #[error("{key}: found {from} to {to}; allowed: {allowed}", from = number(*.from), to = number(*.to))]
    NotAllowed { key: String, from: f64, to: f64, allowed: String },
    #[error("found {key} twice; allowed: each key once")]
    Twice { key: String },
    #[error("found {key} and {other}, which say the same thing; allowed: one of the two")]
    SaidTwice { key: String, other: String },
    /// More combinations than can be kept.
    #[error("found {count} combinations; allowed: at most {MOST_COMBINATIONS}")]
    TooMany {
        /// Their number, in words where it overflows.
        count: String,
    },
}

impl AxisError {
    /// Remedy, where the message does not give it.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Key(KeyError::Unknown { nearest: Some(nearest), .. }) => Some(format!("did you mean {nearest}?")),
            Self::Key(_) => Some("gearwear schema prints all keys with their ranges".to_owned()),
            Self::NotANumber { found, .. } | Self::Count { found, .. } => decimal_comma::help(found),
            Self::NotRising { before, value, .. } if before.fract() == 0.0 && value.fract() == 0.0 => {
                let (before, value) = (number(*before), number(*value));
                Some(format!("commas separate values; decimal point, not comma: {before}.{value}"))
            }
            _ => None,
        }
    }
}

/// Reads a key with its values and checks that the key allows them.
///
/// A range that the key allows only partly is kept: the other combinations become rows with an error.
pub fn parse(given: &str) -> Result<SweepAxis, AxisError> {
    let Some((key, values)) = given.split_once('=') else { return Err(AxisError::Form { given: given.to_owned() }) };
    let key = key.trim().to_owned();
    let keys = linked_keys(&key);
    if keys.iter().any(|key| key.contains(['{', '}'])) {
        return Err(AxisError::Braces { key });
    }
    let choices: Vec<Vec<&str>> = keys.iter().filter_map(|key| key::words(key)).collect();
    if choices.len() == keys.len() {
        return words(key, values, &choices);
    }
    let takes = keys.iter().map(|key| NumberKey::find(key)).collect::<Result<Vec<_>, _>>()?;
    let whole = takes.iter().any(NumberKey::whole);
    let parts: Vec<&str> = values.split(':').map(str::trim).collect();
    let axis = match parts[..] {
        [list] if !list.is_empty() => listed(key, list, whole)?,
        [from, to, count] => range(key, [from, to], count, AxisSpacing::Even, whole)?,
        [from, to, count, "log"] => range(key, [from, to], count, AxisSpacing::Logarithmic, whole)?,
        _ => return Err(AxisError::Form { given: given.to_owned() }),
    };
    let values = axis.values();
    if let Some(&value) = values.iter().find(|value| axis.whole && value.fract() != 0.0) {
        return Err(AxisError::NotWhole { key: axis.key, value });
    }
    match takes.iter().find(|takes| !values.iter().any(|&value| takes.holds(value))) {
        Some(takes) => {
            let SweepAxis { key, from, to, .. } = axis;
            Err(AxisError::NotAllowed { key, from, to, allowed: takes.allowed() })
        }
        None => Ok(axis),
    }
}

fn parsed(key: &str, end: &'static str, text: &str) -> Result<f64, AxisError> {
    let value = f64::from_str(text).ok().filter(|value| value.is_finite());
    value.ok_or_else(|| AxisError::NotANumber { key: key.to_owned(), end, found: text.to_owned() })
}

/// Values one by one.
fn listed(key: String, list: &str, whole: bool) -> Result<SweepAxis, AxisError> {
    let values = list.split(',').map(|value| parsed(&key, "a value", value.trim())).collect::<Result<Vec<f64>, _>>()?;
    if let Some(two) = values.windows(2).find(|two| two[1] <= two[0]) {
        return Err(AxisError::NotRising { key, before: two[0], value: two[1] });
    }
    let (from, to) = (values[0], values[values.len() - 1]);
    Ok(SweepAxis { key, from, to, count: values.len(), whole, spacing: AxisSpacing::Listed(values) })
}

/// Words one by one, of which every linked key takes each.
fn words(key: String, list: &str, choices: &[Vec<&str>]) -> Result<SweepAxis, AxisError> {
    let mut words: Vec<String> = Vec::new();
    for word in list.split(',').map(|word| word.trim().trim_matches('"')) {
        if choices.iter().any(|choices| !choices.contains(&word)) {
            let allowed = choices.first().map_or_else(String::new, |choices| choices.join(", "));
            return Err(AxisError::NotAWord { key, found: word.to_owned(), allowed });
        }
        if words.iter().any(|before| before == word) {
            return Err(AxisError::WordTwice { key, word: word.to_owned() });
        }
        words.push(word.to_owned());
    }
    let count = words.len();
    Ok(SweepAxis { key, from: 0.0, to: (count - 1) as f64, count, whole: false, spacing: AxisSpacing::Words(words) })
}

/// Values between two ends.
fn range(
    key: String,
    [from, to]: [&str; 2],
    count: &str,
    spacing: AxisSpacing,
    whole: bool,
) -> Result<SweepAxis, AxisError> {
    let (from, to) = (parsed(&key, "FROM", from)?, parsed(&key, "TO", to)?);
    let counted = count.parse::<usize>().ok().filter(|count| (1..=MOST_VALUES).contains(count));
    let Some(count) = counted else { return Err(AxisError::Count { key, found: count.to_owned() }) };
    match (count, from == to) {
        _ if from > to => Err(AxisError::Reversed { key, from, to }),
        _ if spacing == AxisSpacing::Logarithmic && from <= 0.0 => Err(AxisError::NoRatio { key, from, to }),
        (1, false) => Err(AxisError::OneValue { key, from, to }),
        (2.., true) => Err(AxisError::SameEnds { key, from, count }),
        _ => Ok(SweepAxis { key, from, to, count, whole, spacing }),
    }
}

/// Reads all axes and checks that they go together.
pub fn parse_all<'a>(given: impl IntoIterator<Item = &'a str>) -> Result<Vec<SweepAxis>, AxisError> {
    let mut axes: Vec<SweepAxis> = Vec::new();
    for given in given {
        let axis = parse(given)?;
        let mut varied: Vec<String> = axes.iter().flat_map(|axis| linked_keys(&axis.key)).collect();
        for key in linked_keys(&axis.key) {
            if varied.contains(&key) {
                return Err(AxisError::Twice { key });
            }
            if let Some(before) = varied.iter().find(|before| other_ways_to_say(&key).contains(before)) {
                return Err(AxisError::SaidTwice { key: before.clone(), other: key });
            }
            varied.push(key);
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

/// Refuses keys of phases that `scene` does not have.
pub fn check_phases(axes: &[SweepAxis], scene: &Draft) -> Result<(), AxisError> {
    let missing = missing_phase(axes.iter().flat_map(|axis| linked_keys(&axis.key)), scene);
    missing.map_or(Ok(()), |key| Err(AxisError::NoPhase { key }))
}

/// Values of `axis` that the key does not allow, in words; `None` where it allows all.
pub fn partly_not_allowed(axis: &SweepAxis) -> Option<String> {
    if axis.words().is_some() {
        return None;
    }
    let takes = NumberKey::find(linked_keys(&axis.key).first()?).ok()?;
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
        let widths = parse("pair.face_width_mm=-10:10:3").unwrap();
        assert!(partly_not_allowed(&widths).unwrap().contains("2 of 3"));
        assert_eq!(partly_not_allowed(&axis), None);
    }

    #[test]
    fn lists_ratios_and_linked_keys_are_read() {
        let listed = parse("operation.pinion_torque_Nm=100, 250,400").unwrap();
        assert_eq!(listed.values(), [100.0, 250.0, 400.0]);
        assert_eq!(listed.as_given(), "operation.pinion_torque_Nm=100,250,400");
        let ratios = parse("wear.coefficient_m2_per_N=1e-19:1e-17:5:log").unwrap();
        let expected = [1e-19, 3.16227766017e-19, 1e-18, 3.16227766017e-18, 1e-17];
        assert!(ratios.values().iter().zip(expected).all(|(value, expected)| (value / expected - 1.0).abs() < 1e-11));
        assert_eq!(ratios.value(2), 1e-18, "rounded as one would write it");
        let linked = parse("pair.{pinion,wheel}.tip_relief.amount_um=0:20:3").unwrap();
        assert_eq!(linked.values(), [0.0, 10.0, 20.0]);
        assert_eq!(linked_keys(&linked.key), ["pair.pinion.tip_relief.amount_um", "pair.wheel.tip_relief.amount_um"]);
    }

    #[test]
    fn words_are_read() {
        let surfaces = parse("contact.surface=half-space, winkler").unwrap();
        assert_eq!(surfaces.values(), [0.0, 1.0]);
        assert_eq!((surfaces.said(1.0).as_str(), surfaces.word(0.0)), ("winkler", Some("half-space")));
        assert_eq!(surfaces.as_given(), "contact.surface=half-space,winkler");
        assert_eq!(parse("contact.tip_contact=true,false").unwrap().said(0.0), "true");
        assert!(parse("operation.phases.2.pinion_torque_Nm=100:300:3").is_ok());
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (given, parts) in [
            (&["pair.face_width_mm"][..], &["found \"pair.face_width_mm\"", "KEY=FROM:TO:COUNT"][..]),
            (&["pair.face_width_mm=10:30"], &["KEY=FROM:TO:COUNT"]),
            (&["pair.face_width_mm="], &["KEY=FROM:TO:COUNT"]),
            (&["pair.face_width_mm=10,30,20"], &["found 20 after 30", "rising"]),
            (&["pair.face_width_mm=10,,20"], &["\"\" as a value"]),
            (&["pair.profile_shift_sum=0:1:3:log"], &["unknown key"]),
            (&["wear.coefficient_m2_per_N=0:1e-17:3:log"], &["by equal ratios", "FROM above 0"]),
            (&["pair.{pinion,wheel.tip_rounding_mm=0,0.1"], &["alternatives in braces"]),
            (&["pair.{pinion,rack}.teeth=20,21"], &["unknown key pair.rack.teeth"]),
            (&["pair.{pinion,wheel}.teeth=20,21", "pair.wheel.teeth=30,31"], &["pair.wheel.teeth twice"]),
            (&["pair.face_width_mm=10:30:21:2"], &["KEY=FROM:TO:COUNT"]),
            (&["pair.face_widht_mm=10:30:21"], &["unknown key pair.face_widht_mm"]),
            (&["contact.surface=1:2:2"], &["contact.surface: found \"1:2:2\"", "winkler"]),
            (&["contact.surface=hertz,hertz"], &["\"hertz\" twice"]),
            (&["contact.tip_contact=yes"], &["found \"yes\"", "false, true"]),
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
        for (given, help) in [
            ("pair.face_width_mm=10,5:30:21", "decimal point, not comma: 10.5"),
            ("pair.face_width_mm=10:30,5:21", "decimal point, not comma: 30.5"),
            ("pair.face_width_mm=30,5", "decimal point, not comma: 30.5"),
        ] {
            assert!(parse(given).unwrap_err().help().unwrap().contains(help), "{given}");
        }
        assert_eq!(parse("pair.width_mm=1:2:2").unwrap_err().help().unwrap(), "did you mean pair.face_width_mm?");
    }
}
