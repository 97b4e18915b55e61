//! The figures an engineer asks of a worn flank.

use super::wear_run::{Outcome, Snapshot};
use crate::gear::{Gear, GearPair, flank::FlankGrid};

/// Height in radius of what is called the root: from the start of active profile (SAP) upward, mm.
pub const ROOT_ZONE_MM: f64 = 2.0;

/// Wear of one flank in figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearFigures {
    /// Greatest depth anywhere.
    pub peak_mm: f64,
    /// Radius where it is.
    pub peak_radius_mm: f64,
    /// Greatest depth in the root zone.
    pub root_mm: f64,
    /// Depth at the working pitch circle.
    pub pitch_mm: f64,
    /// Depth at the start of active profile.
    pub active_start_mm: f64,
    /// ∫ h ds over the flank, mm²: worn volume per mm of face width.
    pub area_mm2: f64,
}

impl WearFigures {
    /// Of `wear_mm` at the points of `gear`'s flank.
    pub fn new(pair: &GearPair, gear: Gear, grid: &FlankGrid, wear_mm: &[f64]) -> Self {
        let involute = pair.teeth[gear].involute;
        let start_rho = pair.active_start_rho_mm(gear);
        let start_radius = pair.active_start_radius_mm(gear);
        let radius = |i: usize| involute.radius_mm(grid.coordinate_mm[i]);
        let greatest = |points: &mut dyn Iterator<Item = usize>| {
            points.fold((0.0, 0), |best: (f64, usize), i| if wear_mm[i] > best.0 { (wear_mm[i], i) } else { best })
        };
        let (peak_mm, peak_point) = greatest(&mut (0..grid.len()));
        let in_root = |&i: &usize| (start_radius..=start_radius + ROOT_ZONE_MM).contains(&radius(i));
        let (root_mm, _) = greatest(&mut (0..grid.len()).filter(in_root));
        Self {
            peak_mm,
            peak_radius_mm: radius(peak_point),
            root_mm,
            pitch_mm: grid.value_at(wear_mm, pair.path.rho_mm(gear, pair.path.pitch_point_mm)),
            active_start_mm: grid.value_at(wear_mm, start_rho),
            area_mm2: grid.integral(wear_mm),
        }
    }

    /// Of a gear's flank at a snapshot of a run.
    pub fn at(pair: &GearPair, gear: Gear, outcome: &Outcome, snapshot: &Snapshot) -> Self {
        Self::new(pair, gear, &outcome.grid[gear], &snapshot.wear_mm[gear])
    }
}
