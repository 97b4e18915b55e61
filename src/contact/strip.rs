//! The stretch of both flanks around the theoretical contact point where they may touch.
//!
//! A strip carries samples of the geometric gap in the tangent frame and, for each, where it lies between the points of
//! both flanks, so that the real gap (geometry plus removed material) is one pass over plain arrays.
//!
//! There are two kinds of samples: evenly spaced ones across the contact, from which the load follows, and the points
//! of one flank themselves, on which pressure and sliding are observed. Real ends of a strip, where a flank ends in
//! its tip edge (or its involute ends at the form circle), are kept exactly: no pressure acts beyond them.

use super::{Flanks, PositionCell};
use crate::gear::{Gear, PerGear, flank::FlankGrid};

/// Removed material of one flank at samples between its points.
#[derive(Debug, Clone, Default)]
struct Interpolation {
    index: Vec<u32>,
    weight: Vec<f64>,
}

impl Interpolation {
    fn push(&mut self, grid: &FlankGrid, coordinate_mm: f64) {
        let place = grid.place(coordinate_mm);
        self.index.push(place.index as u32);
        self.weight.push(place.weight);
    }

    fn add_to(&self, values: &[f64], out: &mut [f64]) {
        for ((out, &i), &weight) in out.iter_mut().zip(&self.index).zip(&self.weight) {
            let i = i as usize;
            let (low, high) = (values[i], values[i + 1]);
            *out += low + weight * (high - low);
        }
    }
}

/// Extent of the tangent at one position over which both flanks exist, and of the part looked at; mm, positive towards
/// the pinion's tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Lower end of what is looked at.
    pub lower_mm: f64,
    /// Upper end.
    pub upper_mm: f64,
    /// Whether each end is where a flank really ends.
    pub ends_are_real: [bool; 2],
}

impl Window {
    /// `half_length_mm` to either side of the theoretical contact point, cut where a flank ends.
    pub fn new(flanks: Flanks<'_>, position_mm: f64, half_length_mm: f64) -> Self {
        let (lower, upper) = common_extent_mm(flanks, position_mm);
        Self {
            lower_mm: lower.max(-half_length_mm),
            upper_mm: upper.min(half_length_mm),
            ends_are_real: [lower >= -half_length_mm, upper <= half_length_mm],
        }
    }
}

/// Where along the tangent both flanks exist.
fn common_extent_mm(flanks: Flanks<'_>, position_mm: f64) -> (f64, f64) {
    let along = |gear: Gear, coordinate| flanks.geometry.in_tangent_frame(gear, coordinate, position_mm).along_mm;
    let (p, w) = (flanks.geometry.flank_limits_mm(Gear::Pinion), flanks.geometry.flank_limits_mm(Gear::Wheel));
    // The wheel's tangent coordinate runs the other way. At A and E, where one limit is the contact point itself,
    // round-off must not leave an empty window.
    let lower = along(Gear::Pinion, p.0).max(-along(Gear::Wheel, w.1)).min(0.0);
    let upper = along(Gear::Pinion, p.1).min(-along(Gear::Wheel, w.0)).max(0.0);
    (lower, upper)
}

/// Evenly spaced samples across the candidate contact.
#[derive(Debug, Clone)]
pub struct Strip {
    /// What the samples cover.
    pub window: Window,
    /// Distance of the samples, mm.
    pub spacing_mm: f64,
    /// Geometric gap at each sample, mm.
    pub geometric_gap_mm: Vec<f64>,
    interpolation: PerGear<Interpolation>,
}

impl Strip {
    /// Samples about as far apart as the pinion's points, and at least 9 of them.
    pub fn new(flanks: Flanks<'_>, position_mm: f64, window: Window) -> Self {
        let grid = flanks.grid.pinion;
        let here = grid.place(flanks.geometry.contact_coordinate_mm(Gear::Pinion, position_mm)).index;
        let length = window.upper_mm - window.lower_mm;
        let intervals = ((length / (grid.arc_mm[here + 1] - grid.arc_mm[here])).ceil() as usize).max(8);
        let spacing_mm = length / intervals as f64;
        let mut strip = Self {
            window,
            spacing_mm,
            geometric_gap_mm: Vec::with_capacity(intervals + 1),
            interpolation: PerGear::default(),
        };
        for k in 0..=intervals {
            let along = window.lower_mm + k as f64 * spacing_mm;
            let mut gap = 0.0;
            for (gear, along) in [(Gear::Pinion, along), (Gear::Wheel, -along)] {
                let coordinate = flanks.geometry.coordinate_at_mm(gear, along, position_mm);
                gap += flanks.geometry.in_tangent_frame(gear, coordinate, position_mm).drop_mm;
                strip.interpolation[gear].push(flanks.grid[gear], coordinate);
            }
            strip.geometric_gap_mm.push(gap);
        }
        strip
    }

    /// The gap with `removed_mm` of material gone, into `gap_mm`.
    pub fn gap_mm(&self, removed_mm: PerGear<&[f64]>, gap_mm: &mut Vec<f64>) {
        gap_mm.clear();
        gap_mm.extend_from_slice(&self.geometric_gap_mm);
        for gear in Gear::BOTH {
            self.interpolation[gear].add_to(removed_mm[gear], gap_mm);
        }
    }

    /// Whether flanks pressed together by `approach_mm` can touch beyond an end of the window that is not real: removed
    /// material only widens the gap, so the geometric gap decides.
    pub fn may_touch_beyond(&self, approach_mm: f64) -> bool {
        let ends = [self.geometric_gap_mm[0], self.geometric_gap_mm[self.geometric_gap_mm.len() - 1]];
        ends.iter().zip(self.window.ends_are_real).any(|(&gap, real)| !real && approach_mm > gap)
    }
}

/// Consecutive points of one flank that may touch the other, with one more at either end.
#[derive(Debug, Clone)]
pub struct ObservedPoints {
    /// Index of the first point that may touch; the samples begin one before it.
    pub first_point: usize,
    /// Where the samples lie along the tangent, towards the gear's own tip, mm.
    pub along_mm: Vec<f64>,
    /// Distance of the samples, mm.
    pub spacing_mm: f64,
    /// Sliding of each point (without the ends) while the contact moves through the cell, counted only while the mate
    /// faces it, mm.
    pub sliding_mm: Vec<f64>,
    /// How far the points move along the tangent from the cell's position to its lower and to its upper end, mm.
    pub shift_to_ends_mm: [f64; 2],
}

impl ObservedPoints {
    /// The points of `gear` facing `window` anywhere in `cell`.
    pub fn new(flanks: Flanks<'_>, gear: Gear, window: Window, cell: PositionCell) -> Self {
        let (geometry, grid) = (flanks.geometry, flanks.grid[gear]);
        let along_at = |i: usize, position| geometry.in_tangent_frame(gear, grid.coordinate_mm[i], position).along_mm;
        let (lower, upper) = match gear {
            Gear::Pinion => (window.lower_mm, window.upper_mm),
            Gear::Wheel => (-window.upper_mm, -window.lower_mm),
        };
        // The contact moves over the flank within the cell: take in what it passes.
        let passed = geometry.rolling_ratio(gear, cell.position_mm) * (cell.upper_mm - cell.lower_mm);
        let place = |along| grid.place(geometry.coordinate_at_mm(gear, along, cell.position_mm)).index;
        let tip = grid.len() - 1;
        let first = place(lower - passed).max(1);
        let last = (place(upper + passed) + 1).min(tip).max(first);

        let mut along_mm: Vec<f64> = (first - 1..=(last + 1).min(tip)).map(|i| along_at(i, cell.position_mm)).collect();
        let spacing_mm = (along_mm[along_mm.len() - 1] - along_mm[0]) / (along_mm.len() - 1) as f64;
        if last == tip {
            along_mm.push(along_mm[along_mm.len() - 1] + spacing_mm);
        }
        let sliding = geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
        let middle = first.midpoint(last);
        Self {
            first_point: first,
            along_mm,
            spacing_mm,
            sliding_mm: (first..=last)
                .map(|i| sliding * exposure(flanks, gear, grid.coordinate_mm[i], cell))
                .collect(),
            shift_to_ends_mm: [cell.lower_mm, cell.upper_mm]
                .map(|end| along_at(middle, end) - along_at(middle, cell.position_mm)),
        }
    }
}

/// The gap that observed points face.
#[derive(Debug, Clone)]
pub struct GapAtPoints {
    geometric_gap_mm: Vec<f64>,
    mate: Interpolation,
}

impl GapAtPoints {
    /// Of the samples of `points` at `position_mm`.
    pub fn new(flanks: Flanks<'_>, gear: Gear, points: &ObservedPoints, position_mm: f64) -> Self {
        let geometry = flanks.geometry;
        let mut gap = Self { geometric_gap_mm: Vec::new(), mate: Interpolation::default() };
        for &along in &points.along_mm {
            let own = geometry.coordinate_at_mm(gear, along, position_mm);
            let facing = geometry.coordinate_at_mm(gear.mate(), -along, position_mm);
            gap.geometric_gap_mm.push(
                geometry.in_tangent_frame(gear, own, position_mm).drop_mm
                    + geometry.in_tangent_frame(gear.mate(), facing, position_mm).drop_mm,
            );
            gap.mate.push(flanks.grid[gear.mate()], facing);
        }
        gap
    }

    /// The gap at each sample with `removed_mm` of material gone, into `gap_mm`; a sample beyond the tip lacks what the
    /// tip point has lost.
    pub fn gap_mm(&self, points: &ObservedPoints, gear: Gear, removed_mm: PerGear<&[f64]>, gap_mm: &mut Vec<f64>) {
        gap_mm.clear();
        gap_mm.extend_from_slice(&self.geometric_gap_mm);
        self.mate.add_to(removed_mm[gear.mate()], gap_mm);
        let own = &removed_mm[gear][points.first_point - 1..];
        let tip = own[own.len() - 1];
        for (gap, removed) in gap_mm.iter_mut().zip(own.iter().chain(std::iter::repeat(&tip))) {
            *gap += removed;
        }
    }
}

/// Part of the cell's stretch during which the flank point at `coordinate_mm` faces a place that exists on the mate.
fn exposure(flanks: Flanks<'_>, gear: Gear, coordinate_mm: f64, cell: PositionCell) -> f64 {
    let own = flanks.geometry.flank_limits_mm(gear);
    let tolerance = 1e-9 * own.1;
    if coordinate_mm < own.0 - tolerance || coordinate_mm > own.1 + tolerance {
        return 0.0;
    }
    let mate = flanks.geometry.flank_limits_mm(gear.mate());
    // Distance inside each end of the mate's flank, at both ends of the cell; it changes linearly in between.
    let inside = |at: f64| {
        let here = -flanks.geometry.in_tangent_frame(gear, coordinate_mm, at).along_mm;
        let end = |limit| flanks.geometry.in_tangent_frame(gear.mate(), limit, at).along_mm;
        [here - end(mate.0), end(mate.1) - here]
    };
    let (before, after) = (inside(cell.lower_mm), inside(cell.upper_mm));
    before.iter().zip(after).map(|(&b, a)| positive_part(b, a)).product()
}

/// Fraction of the way from `before` to `after` on which the linear course between them is positive.
fn positive_part(before: f64, after: f64) -> f64 {
    let sum = before.abs() + after.abs();
    if sum > 0.0 { (before.max(0.0) + after.max(0.0)) / sum } else { 1.0 }
}
