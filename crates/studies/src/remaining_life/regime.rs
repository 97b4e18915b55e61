//! Wear coefficient before any measurement: a range by wear regime, or of one's own.
//!
//! A range, those of regimes ([`gearwear_physics::wear::coefficient_range`]) too, is the 95 % interval of a lognormal distribution.

use std::str::FromStr;

use serde::Serialize;

use super::wear_process::FactorPrior;
use gearwear_bodies::reference::statistics::HALF_WIDTH_95;
use gearwear_physics::wear::coefficient_range::{CoefficientRange, RANGES};

/// Factor on either side of the run's own coefficient where no prior is given.
pub const ABOUT_RUN: f64 = 100.0;

/// Least and greatest end of a range of one's own.
const ENDS_M2_PER_N: [f64; 2] = [1e-25, 1e-5];

/// What is known of a wear coefficient before any measurement.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoefficientPrior {
    /// Regime, or `range` of one given by its ends.
    pub name: String,
    /// Lower end of the 95 % interval of the lognormal distribution.
    pub low_m2_per_N: f64,
    /// Upper end.
    pub high_m2_per_N: f64,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("found {given:?}; allowed: {}, or LOW:HIGH in m²/N, rising and within {:e} to {:e}, such as 1e-17:1e-15", RANGES.map(|range| range.name).join(", "), ENDS_M2_PER_N[0], ENDS_M2_PER_N[1])]
pub struct PriorError {
    given: String,
}

impl FromStr for CoefficientPrior {
    type Err = PriorError;

    fn from_str(given: &str) -> Result<Self, PriorError> {
        if let Some(CoefficientRange { name, range_m2_per_n: [low, high] }) = CoefficientRange::named(given) {
            return Ok(Self { name: name.to_owned(), low_m2_per_N: low, high_m2_per_N: high });
        }
        let number = |text: &str| {
            text.trim().parse().ok().filter(|end: &f64| (ENDS_M2_PER_N[0]..=ENDS_M2_PER_N[1]).contains(end))
        };
        let ends = given.split_once(':').and_then(|(low, high)| Some((number(low)?, number(high)?)));
        match ends {
            Some((low, high)) if low < high => {
                Ok(Self { name: "range".to_owned(), low_m2_per_N: low, high_m2_per_N: high })
            }
            _ => Err(PriorError { given: given.to_owned() }),
        }
    }
}

impl CoefficientPrior {
    /// Within [`ABOUT_RUN`] times the coefficient of the run, either way.
    pub fn about_run(coefficient_m2_per_n: f64) -> Self {
        Self {
            name: "run".to_owned(),
            low_m2_per_N: coefficient_m2_per_n / ABOUT_RUN,
            high_m2_per_N: coefficient_m2_per_n * ABOUT_RUN,
        }
    }

    /// Distribution of the factor on the coefficient of the run.
    pub fn of_factor(&self, coefficient_m2_per_n: f64) -> FactorPrior {
        let [low, high] = [self.low_m2_per_N, self.high_m2_per_N].map(|end| (end / coefficient_m2_per_n).ln());
        FactorPrior { mean: 0.5 * (low + high), deviation: 0.5 * (high - low) / HALF_WIDTH_95 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_the_interval_of_the_logarithm() {
        let prior: CoefficientPrior = "1e-18:1e-16".parse().unwrap();
        let factor = prior.of_factor(1e-17);
        assert!(factor.mean.abs() < 1e-12 && (factor.deviation - 10f64.ln() / HALF_WIDTH_95).abs() < 1e-12);
        assert_eq!(CoefficientPrior::about_run(1e-17).of_factor(1e-17).deviation, 100f64.ln() / HALF_WIDTH_95);
        for given in ["mld", "1e-15:1e-17", "0:1e-15", "1e-17"] {
            assert!(given.parse::<CoefficientPrior>().unwrap_err().to_string().contains("regime-2"), "{given}");
        }
    }
}
