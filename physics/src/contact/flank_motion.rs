//! How far flanks move under a contact while it stands for one loading position.

use super::PositionCell;
use crate::gear::{Gear, conjugate::ConjugateFlanks};

/// Parts of the flank's length by which a limit may miss the theoretical contact point at A or E.
pub(super) const ROUND_OFF: f64 = 1e-9;

/// How far the flank point at `coordinate_mm` moves along the tangent from the cell's position to its ends: the contact
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

/// The gear whose tip edge carries the load with the theoretical contact point at `position_mm`: before A and after E.
pub(super) fn edge_under_load(geometry: &dyn ConjugateFlanks, position_mm: f64) -> Option<Gear> {
    let at_tip = |gear: Gear| geometry.position_at_mm(gear, geometry.flank_limits_mm(gear).1);
    let round_off = ROUND_OFF * at_tip(Gear::Pinion);
    match position_mm {
        before if before < at_tip(Gear::Wheel) - round_off => Some(Gear::Wheel),
        after if after > at_tip(Gear::Pinion) + round_off => Some(Gear::Pinion),
        _ => None,
    }
}

/// How far the flank of `gear` around `coordinate_mm` passes its contact from the cell's position to its ends. On the line of action the
/// contact stands still in the tangent frame; before A and after E it stands on the tip edge, which the mate passes as far as it slides. Its
/// points, `spacing_mm` apart, then each feel what presses on their part of the edge.
pub(super) fn passes_to_ends_mm(
    geometry: &dyn ConjugateFlanks,
    gear: Gear,
    coordinate_mm: f64,
    cell: PositionCell,
    spacing_mm: f64,
) -> [f64; 2] {
    let own = shift_to_ends_mm(geometry, gear, coordinate_mm, cell);
    match edge_under_load(geometry, cell.position_mm) {
        None => own,
        Some(edge) if edge == gear => [-0.5 * spacing_mm, 0.5 * spacing_mm],
        Some(edge) => {
            let at = geometry.contact_coordinate_mm(edge, cell.position_mm);
            let edges = shift_to_ends_mm(geometry, edge, at, cell);
            [own[0] + edges[0], own[1] + edges[1]]
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
