//! Compliance of a tooth pair along the path of contact, given at some positions.
//!
//! The curve is from finite elements (a calibration) or supplied by the user; it is linear between its points and constant beyond
//! its ends.

use serde::{Deserialize, Serialize};

/// Compliance of one tooth pair over the path of contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairCompliance {
    /// Radius of curvature of the pinion at the theoretical contact point, increasing, mm.
    pub position_mm: Vec<f64>,
    /// Approach along the line of action over line load at each position, mm²/N.
    pub mm2_per_n: Vec<f64>,
    /// Deflections that the values include.
    pub stands_for: StandsFor,
    /// Part of the compliance that all pairs in mesh share, mm²/N: the approach of a pair under the load of another, due to the deflection of the
    /// gear bodies.
    #[serde(default)]
    pub shared_mm2_per_n: f64,
}

/// Deflections that a compliance includes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StandsFor {
    /// Teeth and bodies, without the flattening of the flanks.
    Teeth,
    /// The whole pair, flattening included, at this line load, N/mm.
    WholePair {
        /// Line load of the values.
        line_load_n_per_mm: f64,
    },
}

impl PairCompliance {
    /// First and last position, mm.
    pub fn ends_mm(&self) -> (f64, f64) {
        (self.position_mm[0], self.position_mm[self.position_mm.len() - 1])
    }

    /// Compliance at `position_mm`, mm²/N.
    pub fn at(&self, position_mm: f64) -> f64 {
        let after = self.position_mm.partition_point(|&p| p <= position_mm).clamp(1, self.position_mm.len() - 1);
        let (low, high) = (self.position_mm[after - 1], self.position_mm[after]);
        let weight = ((position_mm - low) / (high - low)).clamp(0.0, 1.0);
        self.mm2_per_n[after - 1] + weight * (self.mm2_per_n[after] - self.mm2_per_n[after - 1])
    }
}
