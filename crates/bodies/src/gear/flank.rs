//! Row of points on a flank, for single-point observation.
//!
//! Points lie between the base circle (0) and the tip circle (`flank_points`) with a [`PointSpacing`]; on an internal gear, whose base circle is beyond
//! the tip, from the root form circle. Quantities over
//! the flank (removed material, pressure, sliding) have one value for each point and are linear between them.

use serde::{Deserialize, Serialize};

use super::{Gear, GearPair, graded_spacing};

/// Spacing of the points of a flank between base and tip circle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PointSpacing {
    /// Evenly in radius, as the thesis numbers them.
    Even,
    /// Closer on tip roundings, about the start of active profile and where a relief begins; few below the flank that touches.
    Graded,
}

/// Points of one flank.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankGrid {
    /// Increasing coordinate of each point, on a gear the radius of curvature ρ.
    pub coordinate_mm: Vec<f64>,
    /// Arc length of each point along the flank.
    pub arc_mm: Vec<f64>,
}

/// Place between two points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridPosition {
    /// Number of the point before.
    pub index: usize,
    /// Weight of the point after, 0 to 1.
    pub weight: f64,
}

impl FlankGrid {
    /// Grid of `flank_points + 1` points on a gear's flank.
    pub fn new(pair: &GearPair, gear: Gear, flank_points: usize, spacing: PointSpacing) -> Self {
        match spacing {
            PointSpacing::Even => Self::evenly_in_radius(pair, gear, flank_points),
            PointSpacing::Graded => {
                let involute = pair.teeth[gear].involute;
                let arc_mm = graded_spacing::arcs_mm(pair, gear, flank_points);
                let mut coordinate_mm: Vec<f64> = arc_mm.iter().map(|&arc| involute.rho_at_arc_mm(arc)).collect();
                coordinate_mm[flank_points] = pair.teeth[gear].tip_rho_mm();
                Self { coordinate_mm, arc_mm }
            }
        }
    }

    fn evenly_in_radius(pair: &GearPair, gear: Gear, flank_points: usize) -> Self {
        let (involute, tip) = (pair.teeth[gear].involute, pair.teeth[gear].tip_radius_mm);
        let first = involute.radius_mm(pair.teeth[gear].first_rho_mm());
        let coordinate_mm: Vec<f64> = (0..=flank_points)
            .map(|i| involute.curvature_radius_mm(first + (tip - first) * i as f64 / flank_points as f64))
            .collect();
        let arc_mm = coordinate_mm.iter().map(|&rho| involute.arc_mm(rho)).collect();
        Self { coordinate_mm, arc_mm }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.coordinate_mm.len()
    }

    /// Place of `coordinate_mm`; beyond the ends, the end.
    pub fn place(&self, coordinate_mm: f64) -> GridPosition {
        let after = self.coordinate_mm.partition_point(|&c| c <= coordinate_mm).clamp(1, self.len() - 1);
        self.place_between(after - 1, coordinate_mm)
    }

    /// [`Self::place`] of a coordinate near the point `index`.
    pub fn place_near(&self, mut index: usize, coordinate_mm: f64) -> GridPosition {
        while index + 2 < self.len() && self.coordinate_mm[index + 1] <= coordinate_mm {
            index += 1;
        }
        while index > 0 && self.coordinate_mm[index] > coordinate_mm {
            index -= 1;
        }
        self.place_between(index, coordinate_mm)
    }

    fn place_between(&self, index: usize, coordinate_mm: f64) -> GridPosition {
        let (low, high) = (self.coordinate_mm[index], self.coordinate_mm[index + 1]);
        GridPosition { index, weight: ((coordinate_mm - low) / (high - low)).clamp(0.0, 1.0) }
    }

    /// Value at `coordinate_mm`, interpolated between the points.
    pub fn value_at(&self, values: &[f64], coordinate_mm: f64) -> f64 {
        let GridPosition { index, weight } = self.place(coordinate_mm);
        values[index] + weight * (values[index + 1] - values[index])
    }

    /// Distance along the flank of the two points around `coordinate_mm`.
    pub fn distance_at_mm(&self, coordinate_mm: f64) -> f64 {
        let GridPosition { index, .. } = self.place(coordinate_mm);
        self.arc_mm[index + 1] - self.arc_mm[index]
    }

    /// Length of flank that point `i` represents, from halfway to the point before to halfway to the point after.
    pub fn share_mm(&self, i: usize) -> f64 {
        let last = self.len() - 1;
        0.5 * (self.arc_mm[(i + 1).min(last)] - self.arc_mm[i.saturating_sub(1)])
    }

    /// Integral ∫ values ds over the flank.
    pub fn integral(&self, values: &[f64]) -> f64 {
        values.iter().enumerate().map(|(i, value)| value * self.share_mm(i)).sum()
    }
}
