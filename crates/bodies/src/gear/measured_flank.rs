//! Profile of a flank as it was measured before a run.

use super::flank::FlankGrid;
use super::involute::Involute;

/// Deviation of a measured flank from its design profile: material that is missing, along the transverse line of action.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredFlank {
    grid: FlankGrid,
    removed_mm: Vec<f64>,
}

impl MeasuredFlank {
    /// Of the material missing at increasing radii of curvature ρ of a flank, mm, at least two of them and all finite; `None` for others.
    pub fn new(involute: &Involute, rho_mm: Vec<f64>, removed_mm: Vec<f64>) -> Option<Self> {
        let is_valid = rho_mm.len() == removed_mm.len()
            && rho_mm.len() > 1
            && rho_mm.windows(2).all(|two| two[0] < two[1])
            && rho_mm.iter().chain(&removed_mm).all(|value| value.is_finite());
        let arc_mm = rho_mm.iter().map(|&rho| involute.arc_mm(rho)).collect();
        is_valid.then_some(Self { grid: FlankGrid { coordinate_mm: rho_mm, arc_mm }, removed_mm })
    }

    /// Material missing at a radius of curvature, mm: linear between the points; beyond the ends, that of the end.
    pub fn removed_mm(&self, rho_mm: f64) -> f64 {
        self.grid.value_at(&self.removed_mm, rho_mm)
    }

    /// Greatest amount of material missing, mm.
    pub fn greatest_mm(&self) -> f64 {
        self.removed_mm.iter().copied().fold(0.0, f64::max)
    }
}
