//! Motion of the flanks under a contact within the cell of a loading position.

use super::PositionCell;
use gearwear_bodies::gear::{Gear, conjugate::ConjugateFlanks};

/// Part of the flank's length by which a limit may miss the theoretical contact point at A or E, by rounding errors.
pub(super) const ROUND_OFF: f64 = 1e-9;

/// Distances that the flank point at `coordinate_mm` moves along the tangent from the cell's position to its ends: the contact
/// moves up the pinion and down the wheel.
pub(super) fn shift_to_ends_mm(
    geometry: &dyn ConjugateFlanks,
    gear: Gear,
    coordinate_mm: f64,
    cell: PositionCell,
) -> [f64; 2] {
    let rolling = geometry.rolling_ratio(gear, geometry.position_at_mm(gear, coordinate_mm));
    [cell.lower_mm, cell.upper_mm].map(|end| match gear {
        Gear::Pinion => rolling * (cell.position_mm - end),
        Gear::Wheel => rolling * (end - cell.position_mm),
    })
}

/// The edge in which a flank ends, where it carries the load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EdgeUnderLoad {
    /// Gear of the edge.
    pub gear: Gear,
    /// Coordinate on its flank, mm.
    pub coordinate_mm: f64,
    /// Whether before A and not after E.
    pub is_before: bool,
}

/// The edge that carries the load with the theoretical contact point at `position_mm`: before A the wheel's tip edge or the corner in which the
/// pinion's flank begins, after E the pinion's tip edge or the wheel's corner.
pub(super) fn edge_under_load(geometry: &dyn ConjugateFlanks, position_mm: f64) -> Option<EdgeUnderLoad> {
    let [pinion, wheel] = Gear::BOTH.map(|gear| geometry.flank_limits_mm(gear));
    // The contact moves up the pinion and down the wheel.
    let [of_start, of_end] = [(true, [pinion.0, wheel.1]), (false, [pinion.1, wheel.0])].map(|(is_before, ends_mm)| {
        Gear::BOTH.map(|gear| {
            let coordinate_mm = ends_mm[gear as usize];
            (geometry.position_at_mm(gear, coordinate_mm), EdgeUnderLoad { gear, coordinate_mm, is_before })
        })
    });
    let (first_mm, first) = if of_start[0].0 > of_start[1].0 { of_start[0] } else { of_start[1] };
    let (last_mm, last) = if of_end[1].0 < of_end[0].0 { of_end[1] } else { of_end[0] };
    let round_off = ROUND_OFF * last_mm;
    match position_mm {
        before if before < first_mm - round_off => Some(first),
        after if after > last_mm + round_off => Some(last),
        _ => None,
    }
}

/// How far a flank passes its contact within the cell of a loading position. On the line of action the contact stands still in the tangent frame;
/// before A and after E it stands on an edge, which the mate passes as far as it slides. The points of the edge's flank then each feel the pressure
/// on their part of the edge.
pub(super) struct Passes<'a> {
    geometry: &'a dyn ConjugateFlanks,
    gear: Gear,
    cell: PositionCell,
    /// Gear of the edge under load, and distances that the edge itself moves.
    edge: Option<(Gear, [f64; 2])>,
}

impl<'a> Passes<'a> {
    /// Passes of the flank of `gear`.
    pub(super) fn new(geometry: &'a dyn ConjugateFlanks, gear: Gear, cell: PositionCell) -> Self {
        let edge = edge_under_load(geometry, cell.position_mm)
            .map(|edge| (edge.gear, shift_to_ends_mm(geometry, edge.gear, edge.coordinate_mm, cell)));
        Self { geometry, gear, cell, edge }
    }

    /// Distances that the flank around `coordinate_mm` passes from the cell's position to its ends, with points `spacing_mm` apart there.
    pub(super) fn to_ends_mm(&self, coordinate_mm: f64, spacing_mm: impl FnOnce() -> f64) -> [f64; 2] {
        let own = || shift_to_ends_mm(self.geometry, self.gear, coordinate_mm, self.cell);
        match self.edge {
            None => own(),
            Some((gear, _)) if gear == self.gear => {
                let half_mm = 0.5 * spacing_mm();
                [-half_mm, half_mm]
            }
            Some((_, edges)) => {
                let own = own();
                [own[0] + edges[0], own[1] + edges[1]]
            }
        }
    }
}

/// Place on the common tangent, towards the pinion's tip, of a place in a gear's own direction, and the other way round.
pub(super) fn on_tangent(gear: Gear, along_mm: f64) -> f64 {
    match gear {
        Gear::Pinion => along_mm,
        Gear::Wheel => -along_mm,
    }
}
