//! The figures an engineer asks of a worn flank.

use super::wear_run::{Outcome, Snapshot};
use crate::gear::{Gear, GearPair, flank::FlankGrid};

/// Height in radius of what is called the root: from the start of active profile (SAP) upward, mm.
pub const ROOT_ZONE_MM: f64 = 2.0;
/// Height in radius of what is called the tip: from the tip circle downward, mm.
pub const TIP_ZONE_MM: f64 = 2.0;

/// Wear of one flank in figures.
#[derive(Debug, Clone, PartialEq)]
pub struct WearFigures {
    /// Greatest depth anywhere.
    pub peak_mm: f64,
    /// Radius where it is.
    pub peak_radius_mm: f64,
    /// Greatest depth in the root zone.
    pub root_mm: f64,
    /// Depth at the working pitch circle, on average over the face width.
    pub pitch_mm: f64,
    /// Depth at the start of active profile, on average over the face width.
    pub active_start_mm: f64,
    /// ∫ h ds over the flank, on average over the face width, mm²: worn volume per mm of face width.
    pub area_mm2: f64,
    /// The same of each slice by itself.
    pub slices: Vec<SliceFigures>,
}

/// Wear of one slice of a flank in figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceFigures {
    /// Greatest depth anywhere.
    pub peak_mm: f64,
    /// Radius where it is.
    pub peak_radius_mm: f64,
    /// Greatest depth in the root zone.
    pub root_mm: f64,
    /// Greatest depth in the tip zone.
    pub tip_mm: f64,
    /// Depth at the working pitch circle.
    pub pitch_mm: f64,
    /// Depth at the start of active profile.
    pub active_start_mm: f64,
    /// ∫ h ds, mm².
    pub area_mm2: f64,
}

impl SliceFigures {
    /// Of `wear_mm` at the points of one slice of `gear`'s flank, which are at `radius_mm`.
    fn new(pair: &GearPair, gear: Gear, grid: &FlankGrid, radius_mm: &[f64], wear_mm: &[f64]) -> Self {
        let start_radius = pair.active_start_radius_mm(gear);
        let tip_radius = pair.teeth[gear].tip_radius_mm;
        let radius = |i: usize| radius_mm[i];
        let greatest = |points: &mut dyn Iterator<Item = usize>| {
            points.fold((0.0, 0), |best: (f64, usize), i| if wear_mm[i] > best.0 { (wear_mm[i], i) } else { best })
        };
        let (peak_mm, peak_point) = greatest(&mut (0..grid.len()));
        let in_root = |&i: &usize| (start_radius..=start_radius + ROOT_ZONE_MM).contains(&radius(i));
        let in_tip = |&i: &usize| radius(i) >= tip_radius - TIP_ZONE_MM;
        let (root_mm, _) = greatest(&mut (0..grid.len()).filter(in_root));
        let (tip_mm, _) = greatest(&mut (0..grid.len()).filter(in_tip));
        Self {
            peak_mm,
            peak_radius_mm: radius(peak_point),
            root_mm,
            tip_mm,
            pitch_mm: grid.value_at(wear_mm, pair.path.rho_mm(gear, pair.path.pitch_point_mm)),
            active_start_mm: grid.value_at(wear_mm, pair.active_start_rho_mm(gear)),
            area_mm2: grid.integral(wear_mm),
        }
    }
}

impl WearFigures {
    /// Of `wear_mm` at the points of `gear`'s flank, slice after slice (at least one).
    pub fn new(pair: &GearPair, gear: Gear, grid: &FlankGrid, wear_mm: &[f64]) -> Self {
        let involute = pair.teeth[gear].involute;
        let radius_mm: Vec<f64> = grid.coordinate_mm.iter().map(|&rho| involute.radius_mm(rho)).collect();
        let of_slice = |slice| SliceFigures::new(pair, gear, grid, &radius_mm, slice);
        let slices: Vec<_> = wear_mm.chunks_exact(grid.len()).map(of_slice).collect();
        let mean = |of: fn(&SliceFigures) -> f64| slices.iter().map(of).sum::<f64>() / slices.len() as f64;
        // The first of equals, as the slices follow each other.
        let worst =
            slices.iter().fold(&slices[0], |best, slice| if slice.peak_mm > best.peak_mm { slice } else { best });
        Self {
            peak_mm: worst.peak_mm,
            peak_radius_mm: worst.peak_radius_mm,
            root_mm: slices.iter().map(|slice| slice.root_mm).fold(0.0, f64::max),
            pitch_mm: mean(|slice| slice.pitch_mm),
            active_start_mm: mean(|slice| slice.active_start_mm),
            area_mm2: mean(|slice| slice.area_mm2),
            slices,
        }
    }

    /// Of a gear's flank at a snapshot of a run.
    pub fn at(pair: &GearPair, gear: Gear, outcome: &Outcome, snapshot: &Snapshot) -> Self {
        Self::new(pair, gear, &outcome.grid[gear], &snapshot.wear_mm[gear])
    }
}

/// How uneven values over the face width are: greatest less least, over the mean; 0 where all are 0.
pub fn variation(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let (low, high) = values.clone().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let count = values.clone().count() as f64;
    let mean = values.sum::<f64>() / count;
    if mean > 0.0 { (high - low) / mean } else { 0.0 }
}
