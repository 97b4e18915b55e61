//! An uncertain key, as the user writes it: `KEY=DISTRIBUTION`.
//!
//! | form | values |
//! |---|---|
//! | `normal:MEAN:SD` | normal, with mean and standard deviation |
//! | `lognormal:MEDIAN:FACTOR` | the logarithm is normal: half of the values lie below MEDIAN, and 68 % from MEDIAN/FACTOR to MEDIAN·FACTOR (σ of ln x is ln FACTOR) |
//! | `uniform:LOW:HIGH` | all values between both alike |
//! | `triangular:LOW:MODE:HIGH` | most likely MODE, never below LOW nor above HIGH |
//! | `±40%`, `+-40%` | uniform within this part of the scene's own value |
//! | `normal:10%` | normal about the scene's own value, with this part of it as standard deviation |
//! | `lognormal:FACTOR` | lognormal about the scene's own value |

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::scene::key::{KeyError, NumberKey, linked_keys};
use crate::scene::table::other_ways_to_say;
use gearwear_physics::wear::coefficient_range::RANGES;

pub const FORMS: &str = "normal:MEAN:SD, lognormal:MEDIAN:FACTOR, uniform:LOW:HIGH, triangular:LOW:MODE:HIGH, ±40%, normal:10%, \
     lognormal:FACTOR";

/// Greatest FACTOR: six powers of ten on each side hold 68 % of the values.
const MOST_FACTOR: f64 = 1e6;
/// Greatest magnitude of values but for [`RARE`].
const MOST_VALUE: f64 = 1e100;
/// Share of values, on each side, that a study does not draw.
const RARE: f64 = 1e-12;

/// Faults of an uncertain key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UncertainError {
    #[error("found {given:?}; allowed: KEY=DISTRIBUTION, with one of {FORMS}; or coefficient, torque, class:7")]
    Form { given: String },
    #[error("found class:{found}; allowed: a flank tolerance class of ISO 1328-1, class:1 to class:11")]
    Class { found: String },
    #[error("found coefficient:{found}; allowed: coefficient, or coefficient: and one of {}", RANGES.map(|range| range.name).join(", "))]
    Regime { found: String },
    #[error(transparent)]
    Key(#[from] KeyError),
    /// A key that takes whole numbers has no distribution.
    #[error("{key} takes whole numbers; allowed: a key that takes any number")]
    Whole { key: String },
    /// A distribution relative to a value that the scene does not have, or to two that differ.
    #[error("{key}: found {given}, a part of the scene's own value, {found}; allowed: one of {FORMS}")]
    NoValue { key: String, given: String, found: &'static str },
    #[error("{key}: found {given}; allowed: {allowed}")]
    Parameters { key: String, given: String, allowed: &'static str },
    #[error("found {key} and {other}, which say the same thing; allowed: one of the two")]
    SaidTwice { key: String, other: String },
    #[error("found {key}; allowed: a phase that the scene has, numbered from 1")]
    NoPhase { key: String },
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "distribution", rename_all = "kebab-case")]
pub enum Distribution {
    Normal { mean: f64, standard_deviation: f64 },
    Lognormal { median: f64, factor: f64 },
    Uniform { low: f64, high: f64 },
    Triangular { low: f64, mode: f64, high: f64 },
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Uncertain {
    /// Path of the key, or of several that have the same value: `pair.{pinion,wheel}.tip_rounding_mm`.
    pub key: String,
    /// Text as the user wrote it.
    pub given: String,
    #[serde(flatten)]
    pub distribution: Distribution,
}

/// Φ⁻¹
pub fn normal_quantile(u: f64) -> f64 {
    Normal::standard().inverse_cdf(u)
}

/// Φ
pub fn normal_share(z: f64) -> f64 {
    Normal::standard().cdf(z)
}

impl Distribution {
    /// Requirement that the parameters do not fulfil.
    fn missing(&self) -> Option<&'static str> {
        match *self {
            Self::Normal { standard_deviation, .. } if standard_deviation <= 0.0 => {
                Some("a standard deviation above 0")
            }
            Self::Lognormal { median, factor } if median <= 0.0 || factor <= 1.0 || factor > MOST_FACTOR => {
                Some("a median above 0, and a factor above 1 and at most 1e6")
            }
            Self::Uniform { low, high } if low >= high => Some("LOW below HIGH"),
            Self::Triangular { low, mode, high } if !(low <= mode && mode <= high && low < high) => {
                Some("LOW, MODE and HIGH that rise")
            }
            _ if [RARE, 1.0 - RARE].into_iter().any(|share| self.quantile(share).abs() > MOST_VALUE) => {
                Some("values of at most 1e100")
            }
            _ => None,
        }
    }

    /// The value below which a share 0 < `u` < 1 of all lies.
    pub fn quantile(&self, u: f64) -> f64 {
        match *self {
            Self::Normal { mean, standard_deviation } => mean + standard_deviation * normal_quantile(u),
            Self::Lognormal { median, factor } => median * (factor.ln() * normal_quantile(u)).exp(),
            Self::Uniform { low, high } => low + u * (high - low),
            Self::Triangular { low, mode, high } => {
                let rising = (mode - low) / (high - low);
                if u < rising {
                    low + (u * (high - low) * (mode - low)).sqrt()
                } else {
                    high - ((1.0 - u) * (high - low) * (high - mode)).sqrt()
                }
            }
        }
    }
}

/// A per cent as a share.
fn share(text: &str) -> Option<f64> {
    let value: f64 = text.trim().strip_suffix('%')?.trim().parse().ok()?;
    (value > 0.0 && value.is_finite()).then_some(value / 100.0)
}

/// Reads one uncertain key; `own` is the scene's own value of a key.
pub fn parse(given: &str, own: impl Fn(&str) -> Option<f64>) -> Result<Uncertain, UncertainError> {
    let Some((key, text)) = given.split_once('=') else {
        return Err(UncertainError::Form { given: given.to_owned() });
    };
    let (key, text) = (key.trim().to_owned(), text.trim());
    let keys = linked_keys(&key);
    for one in &keys {
        if NumberKey::find(one)?.whole() {
            return Err(UncertainError::Whole { key: one.clone() });
        }
    }
    let values: Vec<Option<f64>> = keys.iter().map(|key| own(key)).collect();
    let own = match values[0] {
        None => Err("which it does not have"),
        Some(_) if values.iter().any(|value| *value != values[0]) => Err("which is not the same for both"),
        Some(0.0) => Err("which is 0"),
        Some(value) => Ok(value),
    };
    let distribution = match read(text, own.ok()) {
        Some(Ok(distribution)) => distribution,
        Some(Err(NeedsOwnValue)) => {
            let found = own.err().unwrap_or_default();
            return Err(UncertainError::NoValue { key, given: text.to_owned(), found });
        }
        None => return Err(UncertainError::Form { given: given.to_owned() }),
    };
    match distribution.missing() {
        Some(allowed) => Err(UncertainError::Parameters { key, given: text.to_owned(), allowed }),
        None => Ok(Uncertain { key, given: text.to_owned(), distribution }),
    }
}

/// Error of a distribution about the scene's value where the scene has none.
struct NeedsOwnValue;

/// Distribution of one of the forms; `own` is the scene's own value. `None` where `text` has none of the forms.
fn read(text: &str, own: Option<f64>) -> Option<Result<Distribution, NeedsOwnValue>> {
    let within = text.strip_prefix('±').or_else(|| text.strip_prefix("+-"));
    let (name, rest) = text.split_once(':').unwrap_or((text, ""));
    let numbers: Option<Vec<f64>> =
        rest.split(':').map(|part| part.trim().parse().ok().filter(|value: &f64| value.is_finite())).collect();
    let about_own = match (within, name.trim(), numbers.as_deref()) {
        (Some(part), ..) => {
            let part = share(part)?;
            own.map(|value| {
                let (one, other) = (value * (1.0 - part), value * (1.0 + part));
                Distribution::Uniform { low: one.min(other), high: one.max(other) }
            })
        }
        (_, "normal", None) => {
            let part = share(rest)?;
            own.map(|value| Distribution::Normal { mean: value, standard_deviation: part * value.abs() })
        }
        (_, "lognormal", Some(&[factor])) => own.map(|median| Distribution::Lognormal { median, factor }),
        (_, "normal", Some(&[mean, standard_deviation])) => Some(Distribution::Normal { mean, standard_deviation }),
        (_, "lognormal", Some(&[median, factor])) => Some(Distribution::Lognormal { median, factor }),
        (_, "uniform", Some(&[low, high])) => Some(Distribution::Uniform { low, high }),
        (_, "triangular", Some(&[low, mode, high])) => Some(Distribution::Triangular { low, mode, high }),
        _ => return None,
    };
    Some(about_own.ok_or(NeedsOwnValue))
}

/// Reads all uncertain keys and checks that they go together.
pub fn parse_all<'a>(
    given: impl IntoIterator<Item = &'a str>,
    own: impl Fn(&str) -> Option<f64>,
) -> Result<Vec<Uncertain>, UncertainError> {
    let mut all: Vec<Uncertain> = Vec::new();
    let mut before: Vec<String> = Vec::new();
    for given in given {
        let uncertain = parse(given, &own)?;
        for key in linked_keys(&uncertain.key) {
            let alternatives = other_ways_to_say(&key);
            if let Some(other) = before.iter().find(|other| **other == key || alternatives.contains(other)) {
                return Err(UncertainError::SaidTwice { key: other.clone(), other: key });
            }
            before.push(key);
        }
        all.push(uncertain);
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_key(given: &str) -> Result<Distribution, String> {
        let uncertain = parse(given, |key| (key == "pair.face_width_mm").then_some(20.0));
        uncertain.map(|uncertain| uncertain.distribution).map_err(|error| error.to_string())
    }

    #[test]
    fn every_form_is_read() {
        for (given, expected) in [
            ("normal:20:0.5", Distribution::Normal { mean: 20.0, standard_deviation: 0.5 }),
            ("normal:10%", Distribution::Normal { mean: 20.0, standard_deviation: 2.0 }),
            ("lognormal:1.5", Distribution::Lognormal { median: 20.0, factor: 1.5 }),
            ("lognormal:19:1.5", Distribution::Lognormal { median: 19.0, factor: 1.5 }),
            ("uniform:19:21", Distribution::Uniform { low: 19.0, high: 21.0 }),
            ("±5%", Distribution::Uniform { low: 19.0, high: 21.0 }),
            ("+-5 %", Distribution::Uniform { low: 19.0, high: 21.0 }),
            ("triangular:19:20:22", Distribution::Triangular { low: 19.0, mode: 20.0, high: 22.0 }),
        ] {
            assert_eq!(read_key(&format!("pair.face_width_mm={given}")), Ok(expected), "{given}");
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (given, part) in [
            ("pair.face_width_mm", "KEY=DISTRIBUTION"),
            ("pair.face_widht_mm=uniform:1:2", "unknown key"),
            ("pair.pinion.teeth=uniform:15:17", "whole numbers"),
            ("pair.face_width_mm=uniform:2:1", "LOW below HIGH"),
            ("pair.face_width_mm=normal:1:-1", "above 0"),
            ("pair.face_width_mm=lognormal:0.5", "factor above 1"),
            ("pair.face_width_mm=lognormal:1e300", "at most 1e6"),
            ("pair.face_width_mm=uniform:-1e308:1e308", "at most 1e100"),
            ("pair.face_width_mm=gamma:1:2", "triangular:LOW:MODE:HIGH"),
            ("operation.pinion_torque_Nm=±10%", "which it does not have"),
        ] {
            assert!(read_key(given).unwrap_err().contains(part), "{given}: {:?}", read_key(given));
        }
        let twice = parse_all(["operation.hours=uniform:1:2", "operation.pinion_revolutions=uniform:1:2"], |_| None);
        assert!(matches!(twice, Err(UncertainError::SaidTwice { .. })));
    }

    /// Medians and 84.13 % points (Φ(1)), and the triangular distribution's closed form F(mode) = (mode − low)/(high − low).
    #[test]
    fn ver_quantiles_are_those_of_the_distributions() {
        let phi = normal_share(1.0);
        for (distribution, share, expected) in [
            (Distribution::Normal { mean: 3.0, standard_deviation: 2.0 }, phi, 5.0),
            (Distribution::Lognormal { median: 3.0, factor: 1.5 }, phi, 4.5),
            (Distribution::Lognormal { median: 3.0, factor: 1.5 }, 0.5, 3.0),
            (Distribution::Uniform { low: 3.0, high: 5.0 }, 0.25, 3.5),
            (Distribution::Triangular { low: 0.0, mode: 1.0, high: 4.0 }, 0.25, 1.0),
            // F(x) = 1 − (4 − x)²/12 = 0.75 at x = 4 − √3.
            (Distribution::Triangular { low: 0.0, mode: 1.0, high: 4.0 }, 0.75, 4.0 - 3.0_f64.sqrt()),
        ] {
            let found = distribution.quantile(share);
            assert!((found - expected).abs() < 1e-7, "{found} for {expected}");
        }
    }
}
