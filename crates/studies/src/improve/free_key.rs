//! A key that may be changed: `KEY = FROM:TO ± TOLERANCE`, or `KEY = WORD, WORD`.

use std::str::FromStr;

use gearwear::scene::key::{self, KeyError, NumberKey, linked_keys};
use gearwear::scene::problem::number;

/// Steps of a range, at least: values are rounded to as many decimals as that takes.
const LEAST_STEPS: f64 = 400.0;

/// Values that a free key takes.
#[derive(Debug, Clone, PartialEq)]
pub enum FreeRange {
    /// Numbers between two ends, both included.
    Between { from: f64, to: f64, is_whole: bool },
    /// Words, as places in the list.
    Words(Vec<String>),
}

/// A key that may be changed.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeKey {
    /// Path in the scene, with alternatives for several that have the same value.
    pub key: String,
    pub range: FreeRange,
    /// Tolerance of manufacture ±, in the unit of the key.
    pub tolerance: Option<f64>,
}

/// Faults of a free key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FreeKeyError {
    #[error("found {given:?}; allowed: KEY = FROM:TO, KEY = FROM:TO ± TOLERANCE or KEY = WORD, WORD")]
    Form { given: String },
    #[error(transparent)]
    Key(#[from] KeyError),
    #[error("{key}: found {found:?}; allowed: a finite number, in FROM:TO ± TOLERANCE")]
    NotANumber { key: String, found: String },
    #[error("{key}: found the range {from}:{to}; allowed: FROM below TO", from = number(*.from), to = number(*.to))]
    Reversed { key: String, from: f64, to: f64 },
    #[error("{key}: found the end {found} of the range; allowed: {allowed}", found = number(*.found))]
    NotAllowed { key: String, found: f64, allowed: String },
    #[error("{key}: found the tolerance {found}; allowed: above 0", found = number(*.found))]
    Tolerance { key: String, found: f64 },
    #[error("{key}: found {found:?}; allowed: two or more of {allowed}")]
    Words { key: String, found: String, allowed: String },
}

impl FreeKeyError {
    /// Key that was probably meant.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Key(KeyError::Unknown { nearest: Some(nearest), .. }) => Some(format!("did you mean {nearest}?")),
            _ => None,
        }
    }
}

impl FromStr for FreeKey {
    type Err = FreeKeyError;

    fn from_str(given: &str) -> Result<Self, FreeKeyError> {
        let form = || FreeKeyError::Form { given: given.to_owned() };
        let (key, values) = given.split_once('=').ok_or_else(form)?;
        let (key, values) = (key.trim().to_owned(), values.trim());
        let keys = linked_keys(&key);
        if values.is_empty() || keys.iter().any(|key| key.contains(['{', '}'])) {
            return Err(form());
        }
        let choices: Vec<Vec<&str>> = keys.iter().filter_map(|key| key::words(key)).collect();
        if choices.len() == keys.len() {
            return words(key, values, &choices);
        }
        let takes = keys.iter().map(|key| NumberKey::find(key)).collect::<Result<Vec<_>, _>>()?;
        let (range, tolerance) = match values.split_once('±').or_else(|| values.split_once("+-")) {
            Some((range, tolerance)) => (range, Some(number_in(&key, tolerance)?)),
            None => (values, None),
        };
        let (from, to) = range.split_once(':').ok_or_else(form)?;
        let (from, to) = (number_in(&key, from)?, number_in(&key, to)?);
        if from >= to {
            return Err(FreeKeyError::Reversed { key, from, to });
        }
        if let Some(found) = tolerance.filter(|tolerance| *tolerance <= 0.0) {
            return Err(FreeKeyError::Tolerance { key, found });
        }
        for takes in &takes {
            if let Some(found) = [from, to].into_iter().find(|end| !takes.holds(*end)) {
                return Err(FreeKeyError::NotAllowed { key, found, allowed: takes.allowed() });
            }
        }
        let is_whole = takes.iter().any(NumberKey::whole);
        Ok(Self { key, range: FreeRange::Between { from, to, is_whole }, tolerance })
    }
}

fn number_in(key: &str, text: &str) -> Result<f64, FreeKeyError> {
    let value = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| FreeKeyError::NotANumber { key: key.to_owned(), found: text.trim().to_owned() })
}

/// Words that every linked key takes.
fn words(key: String, list: &str, choices: &[Vec<&str>]) -> Result<FreeKey, FreeKeyError> {
    let mut words: Vec<String> = list.split(',').map(|word| word.trim().trim_matches('"').to_owned()).collect();
    words.dedup();
    let is_known = |word: &String| choices.iter().all(|choices| choices.contains(&word.as_str()));
    if words.len() < 2 || !words.iter().all(is_known) {
        let allowed = choices.first().map_or_else(String::new, |choices| choices.join(", "));
        return Err(FreeKeyError::Words { key, found: list.to_owned(), allowed });
    }
    Ok(FreeKey { key, range: FreeRange::Words(words), tolerance: None })
}

impl FreeKey {
    /// Key as the user may write it.
    pub fn as_given(&self) -> String {
        let values = match &self.range {
            FreeRange::Between { from, to, .. } => format!("{}:{}", number(*from), number(*to)),
            FreeRange::Words(words) => words.join(", "),
        };
        let tolerance = self.tolerance.map_or_else(String::new, |tolerance| format!(" ± {}", number(tolerance)));
        format!("{} = {values}{tolerance}", self.key)
    }

    /// Number of values, where they can be counted.
    pub fn levels(&self) -> Option<usize> {
        match &self.range {
            FreeRange::Between { from, to, is_whole: true } => Some((to - from).round() as usize + 1),
            FreeRange::Between { .. } => None,
            FreeRange::Words(words) => Some(words.len()),
        }
    }

    /// Value at the share `u` of the range, from 0 to 1, rounded as one would write it; of words their place.
    pub fn value(&self, u: f64) -> f64 {
        match &self.range {
            FreeRange::Between { from, to, is_whole: true } => (from + u * (to - from)).round().clamp(*from, *to),
            FreeRange::Between { from, to, .. } => self.rounded((1.0 - u) * from + u * to).clamp(*from, *to),
            FreeRange::Words(words) => (u * (words.len() - 1) as f64).round(),
        }
    }

    /// Value with no more decimals than [`LEAST_STEPS`] of the range need.
    fn rounded(&self, value: f64) -> f64 {
        let FreeRange::Between { from, to, .. } = &self.range else { return value };
        let decimals = (-((to - from) / LEAST_STEPS).log10().floor()).max(0.0) as usize;
        // Adding zero takes the sign of a negative zero away.
        format!("{value:.decimals$}").parse().unwrap_or(value) + 0.0
    }

    /// Share of the range at which `value` lies.
    pub fn share(&self, value: f64) -> f64 {
        match &self.range {
            FreeRange::Between { from, to, .. } => (value - from) / (to - from),
            FreeRange::Words(words) => value / (words.len() - 1) as f64,
        }
    }

    /// Value in a scene file.
    pub fn in_scene(&self, value: f64) -> toml::Value {
        match &self.range {
            FreeRange::Between { is_whole: true, .. } => toml::Value::Integer(value as i64),
            FreeRange::Between { .. } => toml::Value::Float(value),
            FreeRange::Words(words) => {
                let word = words[(value as usize).min(words.len() - 1)].as_str();
                match word {
                    "true" | "false" => toml::Value::Boolean(word == "true"),
                    _ => toml::Value::String(word.to_owned()),
                }
            }
        }
    }

    /// Value as text.
    pub fn said(&self, value: f64) -> String {
        match &self.range {
            FreeRange::Between { .. } => number(value),
            FreeRange::Words(words) => words[(value as usize).min(words.len() - 1)].clone(),
        }
    }

    /// Whether the key allows values beyond the `end` of the range, 0 or 1.
    pub fn goes_beyond(&self, end: f64) -> bool {
        let FreeRange::Between { from, to, is_whole } = &self.range else { return false };
        let step = if *is_whole { 1.0 } else { (to - from) / LEAST_STEPS };
        let beyond = if end > 0.5 { to + step } else { from - step };
        let keys = linked_keys(&self.key);
        keys.iter().all(|key| NumberKey::find(key).is_ok_and(|takes| takes.holds(beyond)))
    }

    /// Values at the tolerance below and above `value`, within what the key allows.
    pub fn within_tolerance(&self, value: f64) -> Vec<f64> {
        let Some(tolerance) = self.tolerance else { return Vec::new() };
        let takes: Vec<NumberKey> = linked_keys(&self.key).iter().filter_map(|key| NumberKey::find(key).ok()).collect();
        let allowed = |value: &f64| takes.iter().all(|takes| takes.holds(*value));
        [value - tolerance, value + tolerance].into_iter().filter(allowed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_read_as_they_are_written() {
        for given in [
            "pair.{pinion,wheel}.tip_relief.amount_um = 0:60 ± 3",
            "pair.helix_angle_deg = -20:20",
            "pair.pinion.tip_relief.shape = linear, parabolic",
            "pair.pinion.teeth = 17:23",
        ] {
            assert_eq!(given.parse::<FreeKey>().unwrap().as_given(), given);
        }
        let relief: FreeKey = "pair.pinion.tip_relief.amount_um=0:40+-3".parse().unwrap();
        assert_eq!((relief.tolerance, relief.value(0.123_456), relief.value(1.0)), (Some(3.0), 4.9, 40.0));
        // A relief is no less than none.
        assert_eq!((relief.within_tolerance(2.0), relief.within_tolerance(10.0)), (vec![5.0], vec![7.0, 13.0]));
        assert!(relief.goes_beyond(1.0) && !relief.goes_beyond(0.0));
        let shape: FreeKey = "pair.pinion.tip_relief.shape = linear, parabolic".parse().unwrap();
        assert_eq!((shape.levels(), shape.value(0.7), shape.in_scene(1.0)), (Some(2), 1.0, "parabolic".into()));
        let teeth: FreeKey = "pair.pinion.teeth = 17:23".parse().unwrap();
        assert_eq!((teeth.levels(), teeth.in_scene(teeth.value(0.4))), (Some(7), toml::Value::Integer(19)));
    }

    #[test]
    fn what_is_wrong_with_a_key_is_said() {
        for (given, said) in [
            ("pair.face_width_mm", "allowed: KEY = FROM:TO"),
            ("pair.face_width_mm = 10", "allowed: KEY = FROM:TO"),
            ("pair.face_widht_mm = 10:20", "unknown key pair.face_widht_mm"),
            ("pair.face_width_mm = ten:20", "found \"ten\""),
            ("pair.face_width_mm = 20:10", "FROM below TO"),
            ("pair.face_width_mm = -1:10", "found the end -1"),
            ("pair.face_width_mm = 1:10 ± 0", "above 0"),
            ("pair.pinion.tip_relief.shape = linear", "two or more of linear, parabolic"),
            ("contact.calibration = 1:2", "takes"),
        ] {
            let error = given.parse::<FreeKey>().unwrap_err().to_string();
            assert!(error.contains(said), "{given}: {error}");
        }
    }
}
