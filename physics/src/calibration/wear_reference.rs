//! Wear of unworn flanks in one mesh by finite elements, per wear coefficient: a reference for any fast model without a wear
//! run.
//!
//! ```text
//! h / k = ∫ p |v_s| dt        N/mm
//! ```
//!
//! over one mesh, contact outside the line of action at the tip edges included. Plain data: `assessment::calibrate` fills it from the
//! finite-element mesh cycle.

use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::PerGear;

/// Loads in units of the scene's.
pub const LOADS: [f64; 3] = [0.5, 1.0, 1.25];
/// Intervals of the flank points.
pub const FLANK_POINTS: usize = 150;
/// Positions from A to E.
pub const POSITIONS: usize = 200;

/// Wear under one load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WearReference {
    /// w, N/mm.
    pub line_load_n_per_mm: f64,
    /// Wear of each gear's flank.
    pub flanks: PerGear<ReferenceDepth>,
}

/// Wear of one flank.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceDepth {
    /// Radii of the points, from base to tip circle, mm.
    pub radius_mm: Vec<f64>,
    /// h / k in one mesh at each of them, N/mm.
    pub depth_per_coefficient_n_per_mm: Vec<f64>,
}
