//! Wear coefficient before any measurement: a range by wear regime, or of one's own.
//!
//! Ranges are those of the table in `docs/materials.md`, three times as wide on either side, since repeated tests scatter by half and
//! no load or oil is that of the source; where the table has one end, two decades. A range is the 95 % interval of a lognormal
//! distribution.

use std::str::FromStr;

use serde::Serialize;

use super::wear_process::FactorPrior;

/// Standard deviations between the middle and an end of a 95 % interval of a normal distribution.
pub const HALF_WIDTH_95: f64 = 1.959_963_984_540_054;
/// Factor on either side of the run's own coefficient where no prior is given.
pub const ABOUT_RUN: f64 = 100.0;

/// Least and greatest end of a range of one's own.
const ENDS_M2_PER_N: [f64; 2] = [1e-25, 1e-5];

/// A row of the table of coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Regime {
    pub name: &'static str,
    /// 95 % interval before any measurement.
    pub range_m2_per_n: [f64; 2],
}

/// Regimes in the order of the table.
pub const REGIMES: [Regime; 6] = [
    Regime { name: "mild", range_m2_per_n: [3e-18, 6e-17] },
    Regime { name: "regime-1", range_m2_per_n: [1e-20, 1e-18] },
    Regime { name: "regime-2", range_m2_per_n: [3e-18, 3e-15] },
    Regime { name: "regime-3", range_m2_per_n: [1e-14, 1e-12] },
    Regime { name: "plastic", range_m2_per_n: [3e-16, 1.5e-14] },
    Regime { name: "dry", range_m2_per_n: [4e-13, 4e-11] },
];

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
#[error("found {given:?}; allowed: {}, or LOW:HIGH in m²/N, rising and within {:e} to {:e}, such as 1e-17:1e-15", REGIMES.map(|regime| regime.name).join(", "), ENDS_M2_PER_N[0], ENDS_M2_PER_N[1])]
pub struct PriorError {
    given: String,
}

impl FromStr for CoefficientPrior {
    type Err = PriorError;

    fn from_str(given: &str) -> Result<Self, PriorError> {
        if let Some(regime) = REGIMES.iter().find(|regime| regime.name == given.trim()) {
            let [low, high] = regime.range_m2_per_n;
            return Ok(Self { name: regime.name.to_owned(), low_m2_per_N: low, high_m2_per_N: high });
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

    /// The page names every regime in a row of its own, with the same ends.
    #[test]
    fn regimes_stand_in_the_table_of_coefficients() {
        let page = include_str!("../../../../docs/materials.md");
        for Regime { name, range_m2_per_n: [low, high] } in REGIMES {
            let row = page.lines().find(|line| line.contains(&format!("`{name}`")));
            let row = row.unwrap_or_else(|| panic!("docs/materials.md: no row of {name}"));
            assert!(row.contains(&format!("{low:e}–{high:e}")), "{name}: {low:e}–{high:e} is not in {row}");
        }
    }

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
