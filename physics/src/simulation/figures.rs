//! The figures an engineer asks of a worn flank.

use super::wear_run::Outcome;
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::results::worn_pair::WearProfile;
use gearwear_bodies::gear::{
    Gear, GearPair,
    flank::FlankGrid,
    flank_zones::{FlankZone, FlankZones},
    slices::{greatest_over_width, readings_over_width},
};

/// The greatest depth of a part of a flank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deepest {
    /// The depth.
    pub depth_mm: f64,
    /// Radius where it is.
    pub radius_mm: f64,
}

impl Deepest {
    /// The deeper of both, the first of equals.
    fn or(self, other: Self) -> Self {
        if other.depth_mm > self.depth_mm { other } else { self }
    }
}

/// Wear of one flank in figures; what is greatest is so over the face width ([`greatest_over_width`]).
#[derive(Debug, Clone, PartialEq)]
pub struct WearFigures {
    /// Greatest depth on the active profile.
    pub peak_mm: f64,
    /// Radius where it is.
    pub peak_radius_mm: f64,
    /// Greatest depth at the tip edge.
    pub tip_edge: Deepest,
    /// Greatest depth below the start of active profile.
    pub below_active: Deepest,
    /// Greatest depth of the root.
    pub root_mm: f64,
    /// Depth at the working pitch circle, on average over the face width.
    pub pitch_mm: f64,
    /// Depth at the start of active profile, on average over the face width.
    pub active_start_mm: f64,
    /// ∫ h ds over the flank, on average over the face width, mm²: worn volume per mm of face width.
    pub area_mm2: f64,
    /// Figures of each slice by itself.
    pub slices: Vec<SliceFigures>,
}

/// Wear of one slice of a flank in figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceFigures {
    /// Greatest depth on the active profile.
    pub active: Deepest,
    /// Greatest depth at the tip edge.
    pub tip_edge: Deepest,
    /// Greatest depth below the start of active profile.
    pub below_active: Deepest,
    /// Greatest depth of the root.
    pub root_mm: f64,
    /// Greatest depth of the tip.
    pub tip_mm: f64,
    /// Depth at the working pitch circle.
    pub pitch_mm: f64,
    /// Depth at the start of active profile.
    pub active_start_mm: f64,
    /// ∫ h ds, mm².
    pub area_mm2: f64,
}

impl SliceFigures {
    /// Figures of `wear_mm` at the points of one slice of `gear`'s flank, which are at `radius_mm`.
    fn new(
        pair: &GearPair,
        gear: Gear,
        grid: &FlankGrid,
        zones: &FlankZones,
        radius_mm: &[f64],
        wear_mm: &[f64],
    ) -> Self {
        // Of a zone without wear or without points, where it begins.
        let deepest = |begins_mm: f64, belongs: &dyn Fn(f64) -> bool| {
            let points = radius_mm.iter().zip(wear_mm).filter(|(radius, _)| belongs(**radius));
            points.fold(Deepest { depth_mm: 0.0, radius_mm: begins_mm }, |best, (&radius_mm, &depth_mm)| {
                best.or(Deepest { depth_mm, radius_mm })
            })
        };
        let of_zone = |begins_mm: f64, zone: FlankZone| deepest(begins_mm, &|radius| zones.at(radius) == zone);
        Self {
            active: of_zone(zones.active_start_radius_mm, FlankZone::Active),
            tip_edge: of_zone(zones.tip_edge_radius_mm, FlankZone::TipEdge),
            below_active: of_zone(radius_mm[0], FlankZone::BelowActive),
            root_mm: deepest(zones.active_start_radius_mm, &|radius| zones.is_root(radius)).depth_mm,
            tip_mm: deepest(zones.tip_radius_mm, &|radius| zones.is_tip(radius)).depth_mm,
            pitch_mm: grid.value_at(wear_mm, pair.path.rho_mm(gear, pair.path.pitch_point_mm)),
            active_start_mm: grid.value_at(wear_mm, pair.active_start_rho_mm(gear)),
            area_mm2: grid.integral(wear_mm),
        }
    }
}

impl WearFigures {
    /// Figures of `wear_mm` at the points of `gear`'s flank, slice after slice (at least one).
    pub fn new(pair: &GearPair, gear: Gear, grid: &FlankGrid, zones: &FlankZones, wear_mm: &[f64]) -> Self {
        let involute = pair.teeth[gear].involute;
        let radius_mm: Vec<f64> = grid.coordinate_mm.iter().map(|&rho| involute.radius_mm(rho)).collect();
        let slices = wear_mm.chunks_exact(grid.len());
        let slices: Vec<_> =
            slices.map(|slice| SliceFigures::new(pair, gear, grid, zones, &radius_mm, slice)).collect();
        let mean = |of: fn(&SliceFigures) -> f64| slices.iter().map(of).sum::<f64>() / slices.len() as f64;
        let values = |of: &dyn Fn(&SliceFigures) -> f64| slices.iter().map(of).collect::<Vec<f64>>();
        let deepest = |of: fn(&SliceFigures) -> Deepest| {
            let none = Deepest { depth_mm: 0.0, ..of(&slices[0]) };
            readings_over_width(&values(&|slice| of(slice).depth_mm)).fold(none, |best, (slice, depth_mm)| {
                best.or(Deepest { depth_mm, radius_mm: of(&slices[slice]).radius_mm })
            })
        };
        let active = deepest(|slice| slice.active);
        Self {
            peak_mm: active.depth_mm,
            peak_radius_mm: active.radius_mm,
            tip_edge: deepest(|slice| slice.tip_edge),
            below_active: deepest(|slice| slice.below_active),
            root_mm: greatest_over_width(&values(&|slice| slice.root_mm)),
            pitch_mm: mean(|slice| slice.pitch_mm),
            active_start_mm: mean(|slice| slice.active_start_mm),
            area_mm2: mean(|slice| slice.area_mm2),
            slices,
        }
    }

    /// Figures of a gear's flank at a snapshot of a run.
    pub fn at(pair: &GearPair, gear: Gear, outcome: &Outcome, snapshot: &Snapshot) -> Self {
        let of_points = Self::new(pair, gear, &outcome.grid[gear], &outcome.zones[gear], &snapshot.wear_mm[gear]);
        match &snapshot.lost_at_nodes {
            Some(lost) => Self { area_mm2: lost[gear].wear_mm2, ..of_points },
            None => of_points,
        }
    }
}

/// Variation of values over the face width: greatest less least, over the mean; 0 where all are 0.
pub fn variation(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let (low, high) = values.clone().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let count = values.clone().count() as f64;
    let mean = values.sum::<f64>() / count;
    if mean > 0.0 { (high - low) / mean } else { 0.0 }
}

/// Wear over the flank of a gear at the end of a run.
pub fn wear_profile(pair: &GearPair, outcome: &Outcome, gear: Gear) -> WearProfile {
    let involute = pair.teeth[gear].involute;
    let rho = &outcome.grid[gear].coordinate_mm;
    let wear_mm = &outcome.worn.wear_mm[gear];
    let wear_um = (0..rho.len()).map(|point| {
        let over_width: Vec<f64> = wear_mm.iter().skip(point).step_by(rho.len()).copied().collect();
        greatest_over_width(&over_width) * 1e3
    });
    WearProfile {
        radius_mm: rho.iter().map(|&rho| involute.radius_mm(rho)).collect(),
        wear_um: wear_um.collect(),
        active_mm: [pair.active_start_radius_mm(gear), pair.teeth[gear].tip_radius_mm],
    }
}
