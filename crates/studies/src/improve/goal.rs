//! Goals and limits: figures by their paths in `summary.json`, or weighted sums of them.

use std::fmt;
use std::str::FromStr;

use gearwear::evaluate::output::{OutputError, SummaryOutput};
use gearwear::scene::problem::number;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::figures;

/// Aspect of a pair that a goal speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Aspect {
    Wear,
    TransmissionError,
    Pressure,
    Life,
    Other,
}

impl Aspect {
    fn of(path: &str) -> Self {
        if path.starts_with("life.") {
            Self::Life
        } else if path.contains("transmission_error") || path.contains("mesh_orders") {
            Self::TransmissionError
        } else if path.contains("pressure") || path.contains("line_load") {
            Self::Pressure
        } else if path.contains("wear") || path.contains("worn_") {
            Self::Wear
        } else {
            Self::Other
        }
    }
}

/// A figure to lower, or a life to raise.
#[derive(Debug, Clone, PartialEq)]
pub struct ImproveGoal {
    /// Weights and figures of the sum, one at least.
    pub terms: Vec<(f64, SummaryOutput)>,
}

/// A limit of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct ImproveLimit {
    pub figure: SummaryOutput,
    /// Whether the value is an upper limit; else a lower one.
    pub at_most: bool,
    pub value: f64,
}

/// Faults of goals and limits.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ImproveGoalError {
    #[error("unknown figure {0}; allowed: the path of a number in summary.json, such as pinion.peak_wear_um")]
    Unknown(String, Option<String>),
    #[error("found the weight {found:?}; allowed: a number above 0, in WEIGHT * PATH + WEIGHT * PATH")]
    Weight { found: String },
    #[error("found {given:?}; allowed: PATH <= VALUE or PATH >= VALUE, such as \"worn.flank_pressure_MPa <= 1500\"")]
    Limit { given: String },
    #[error("found {given:?}, a sum with a life; allowed: a life by itself")]
    LifeInSum { given: String },
    #[error("found {path}, an error that runs state of themselves; allowed: a figure")]
    OfError { path: String },
}

impl ImproveGoalError {
    /// Figure that was probably meant.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unknown(_, Some(nearest)) => Some(format!("did you mean {nearest}?")),
            _ => None,
        }
    }
}

fn figure(path: &str) -> Result<SummaryOutput, ImproveGoalError> {
    let found = SummaryOutput::find(path.trim());
    let found = found.map_err(|OutputError { output, nearest }| ImproveGoalError::Unknown(output, nearest))?;
    if found.is_of_error() {
        return Err(ImproveGoalError::OfError { path: found.path });
    }
    Ok(found)
}

impl FromStr for ImproveGoal {
    type Err = ImproveGoalError;

    fn from_str(given: &str) -> Result<Self, ImproveGoalError> {
        let terms = given.split('+').map(|term| match term.split_once('*') {
            None => Ok((1.0, figure(term)?)),
            Some((weight, path)) => {
                let value = weight.trim().parse::<f64>().ok().filter(|value| value.is_finite() && *value > 0.0);
                let value = value.ok_or_else(|| ImproveGoalError::Weight { found: weight.trim().to_owned() })?;
                Ok((value, figure(path)?))
            }
        });
        let terms: Vec<(f64, SummaryOutput)> = terms.collect::<Result<_, ImproveGoalError>>()?;
        if terms.len() > 1 && terms.iter().any(|(_, figure)| Aspect::of(&figure.path) == Aspect::Life) {
            return Err(ImproveGoalError::LifeInSum { given: given.to_owned() });
        }
        Ok(Self { terms })
    }
}

impl fmt::Display for ImproveGoal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let terms: Vec<String> = self
            .terms
            .iter()
            .map(|(weight, figure)| match *weight {
                1.0 => figure.path.clone(),
                weight => format!("{} * {}", number(weight), figure.path),
            })
            .collect();
        f.write_str(&terms.join(" + "))
    }
}

impl ImproveGoal {
    pub fn aspect(&self) -> Aspect {
        self.terms.iter().map(|(_, figure)| Aspect::of(&figure.path)).min().unwrap_or(Aspect::Other)
    }

    /// Whether more is better.
    pub fn is_raised(&self) -> bool {
        self.aspect() == Aspect::Life
    }

    /// Value, from those of its figures by `of`; `None` where one is missing.
    pub fn value(&self, of: impl Fn(&str) -> Option<f64>) -> Option<f64> {
        self.terms.iter().map(|(weight, figure)| Some(weight * of(&figure.path)?)).sum()
    }

    /// Relative error of the value, from those of its figures: the sum of the weighted errors; `None` where one is not known.
    pub fn error(&self, of: impl Fn(&str) -> Option<f64>, total: &TotalError) -> Option<f64> {
        let value = self.value(&of)?;
        let error = self.terms.iter().map(|(weight, figure)| {
            Some(weight * of(&figure.path)?.abs() * figures::find(&figure.path)?.error(total)?)
        });
        let error: f64 = error.sum::<Option<f64>>()?;
        (value != 0.0).then(|| error / value.abs())
    }

    /// Name for people, lower case, without unit.
    pub fn heading(&self) -> String {
        match self.terms.as_slice() {
            [(1.0, figure)] => heading(&figure.path),
            terms => {
                let terms = terms.iter().map(|(weight, figure)| match *weight {
                    1.0 => heading(&figure.path),
                    weight => format!("{} × {}", number(weight), heading(&figure.path)),
                });
                terms.collect::<Vec<_>>().join(" + ")
            }
        }
    }

    pub fn unit(&self) -> &'static str {
        self.terms.first().and_then(|(_, figure)| unit(&figure.path)).unwrap_or_default()
    }
}

/// Name of a figure for people, lower case, without unit; short, as the path stands beside it.
pub fn heading(path: &str) -> String {
    let heading = figures::find(path).map_or_else(|| path.to_owned(), |figure| figure.heading.clone());
    [", active profile", ", peak to peak", "maximum "].iter().fold(heading, |short, part| short.replace(part, ""))
}

/// Unit of a figure; `None` where none is known.
pub fn unit(path: &str) -> Option<&'static str> {
    figures::find(path).map(|figure| figure.unit()).or_else(|| gearwear::unit_of(path))
}

impl FromStr for ImproveLimit {
    type Err = ImproveGoalError;

    fn from_str(given: &str) -> Result<Self, ImproveGoalError> {
        let form = || ImproveGoalError::Limit { given: given.to_owned() };
        let (sign, (path, value)) =
            ["<=", ">="].into_iter().find_map(|sign| Some((sign, given.split_once(sign)?))).ok_or_else(form)?;
        let value = value.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(form)?;
        Ok(Self { figure: figure(path)?, at_most: sign == "<=", value })
    }
}

impl fmt::Display for ImproveLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.figure.path, if self.at_most { "<=" } else { ">=" }, number(self.value))
    }
}

impl ImproveLimit {
    /// How far `value` is beyond the limit, relative to it; not above 0 where it is kept.
    pub fn excess(&self, value: f64) -> f64 {
        let beyond = if self.at_most { value - self.value } else { self.value - value };
        beyond / self.value.abs().max(f64::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_sums_of_figures() {
        let goal: ImproveGoal =
            "0.7*new.transmission_error_um.peak_to_peak + 0.3 * worn.transmission_error_um.peak_to_peak"
                .parse()
                .unwrap();
        let of = |path: &str| Some(if path.starts_with("new") { 10.0 } else { 20.0 });
        assert_eq!((goal.value(of), goal.aspect()), (Some(13.0), Aspect::TransmissionError));
        assert_eq!(goal.to_string().parse(), Ok(goal.clone()));
        let mut total = TotalError::none("");
        assert_eq!(goal.error(of, &total), None);
        total.peak_wear.pinion = Some(0.02);
        let wear: ImproveGoal = "pinion.peak_wear_um".parse().unwrap();
        assert_eq!((wear.error(of, &total), wear.unit(), wear.is_raised()), (Some(0.02), "µm", false));
        assert!("life.hours".parse::<ImproveGoal>().unwrap().is_raised());
    }

    #[test]
    fn limits_and_faults() {
        let limit: ImproveLimit = "worn.flank_pressure_MPa <= 1500".parse().unwrap();
        assert_eq!((limit.excess(1650.0), limit.excess(750.0)), (0.1, -0.5));
        assert_eq!(limit.to_string(), "worn.flank_pressure_MPa <= 1500");
        for (given, said) in [
            ("pinion.peak_ware_um", "unknown figure"),
            ("-1 * pinion.peak_wear_um", "above 0"),
            ("life.hours + pinion.peak_wear_um", "by itself"),
            ("error.total.peak_wear.pinion", "allowed: a figure"),
        ] {
            let error = given.parse::<ImproveGoal>().unwrap_err().to_string();
            assert!(error.contains(said), "{given}: {error}");
        }
        for given in ["pinion.peak_wear_um < 8", "pinion.peak_wear_um <= x"] {
            assert!(given.parse::<ImproveLimit>().unwrap_err().to_string().contains("PATH <= VALUE"), "{given}");
        }
    }
}
