//! Motion of the flanks under a contact within the cell of a loading position.

use super::{Flanks, PositionCell};
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};

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

impl EdgeUnderLoad {
    /// Place on the tangent, mm.
    fn on_tangent_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64) -> f64 {
        on_tangent(self.gear, geometry.in_tangent_frame(self.gear, self.coordinate_mm, position_mm).along_mm)
    }
}

/// The edges between which flanks touch on the line of action, each with the position at which it is the theoretical contact point: before A the
/// wheel's tip edge, which begins at this coordinate, or the corner in which the pinion's flank begins, after E the pinion's tip edge or the wheel's corner.
fn outermost_edges(geometry: &dyn ConjugateFlanks, tip_from_mm: PerGear<f64>) -> [(f64, EdgeUnderLoad); 2] {
    let [pinion, wheel] = Gear::BOTH.map(|gear| (geometry.flank_limits_mm(gear).0, tip_from_mm[gear]));
    // The contact moves up the pinion and down the wheel.
    let [of_start, of_end] = [(true, [pinion.0, wheel.1]), (false, [pinion.1, wheel.0])].map(|(is_before, ends_mm)| {
        Gear::BOTH.map(|gear| {
            let coordinate_mm = ends_mm[gear as usize];
            (geometry.position_at_mm(gear, coordinate_mm), EdgeUnderLoad { gear, coordinate_mm, is_before })
        })
    });
    [
        if of_start[0].0 > of_start[1].0 { of_start[0] } else { of_start[1] },
        if of_end[1].0 < of_end[0].0 { of_end[1] } else { of_end[0] },
    ]
}

/// The one of [`outermost_edges`] that carries the load with the theoretical contact point at `position_mm`.
pub(super) fn edge_under_load(
    geometry: &dyn ConjugateFlanks,
    tip_from_mm: PerGear<f64>,
    position_mm: f64,
) -> Option<EdgeUnderLoad> {
    let [(first_mm, first), (last_mm, last)] = outermost_edges(geometry, tip_from_mm);
    let round_off = ROUND_OFF * last_mm;
    match position_mm {
        before if before < first_mm - round_off => Some(first),
        after if after > last_mm + round_off => Some(last),
        _ => None,
    }
}

/// Coordinates at which the flanks end at their tips.
pub(super) fn tips_mm(geometry: &dyn ConjugateFlanks) -> PerGear<f64> {
    PerGear::from_fn(|gear| geometry.flank_limits_mm(gear).1)
}

/// Edges and beginnings of tip roundings within so many half-widths of the plain contact move its pressure between A and E.
const NEAR_HALF_WIDTHS: f64 = 2.0;

/// An edge, or the beginning of the rounding of a tip edge, that takes the pressure along.
#[derive(Debug, Clone, Copy)]
struct MovingEdge {
    gear: Gear,
    /// Place on the tangent, mm.
    at_mm: f64,
    /// Distances on the tangent that it moves from the cell's position to its ends.
    to_ends_mm: [f64; 2],
    /// Place on the tangent from which on the pressure stands still; none where all of it goes with the edge.
    still_from_mm: Option<f64>,
}

impl MovingEdge {
    /// Distance on the tangent that it moves from the cell's position to this part of the cell.
    fn moved_mm(&self, part_of_cell: f64) -> f64 {
        let [lower_mm, upper_mm] = self.to_ends_mm;
        lower_mm + part_of_cell * (upper_mm - lower_mm)
    }

    /// Part of its motion that the pressure at a place on the tangent takes.
    fn part_at(&self, along_mm: f64) -> f64 {
        let of_way = |still_mm: f64| (still_mm - along_mm) / (still_mm - self.at_mm);
        self.still_from_mm.map_or(1.0, of_way).clamp(0.0, 1.0)
    }
}

/// Greatest part by which the pressure between an edge and where it stands still is stretched or compressed. Where positions are so far apart that the
/// edge moves farther in a cell, the pressure stands still farther away.
const MOST_STRETCH: f64 = 0.5;

/// Pressure that a place meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PressureMet {
    /// Place of the pressure on the tangent at the cell's position, mm.
    pub along_mm: f64,
    /// Pressure there over that at the cell's position.
    pub density: f64,
}

/// Motion of the pressure along the tangent within the cell of a loading position.
///
/// On the line of action it stands still in the tangent frame, and the flanks pass through it. Before A and after E it stands on an edge, which the
/// mate passes as far as it slides. Where a tip edge has a rounding, that holds from the beginning of the rounding on. Between A and E a
/// contact that reaches the edge is pressed hardest there, and goes with it there; the motion falls in a straight line to nothing at the other end of
/// the plain contact. Were the pressure to stand still at the edge, its maximum would be smeared over the course of the edge in a cell: an error of
/// first order in the distance of the positions.
///
/// Points that the pressure passes by less than their own distance each feel it on their part of the flank.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PressureMotion {
    /// Cell of the loading position.
    pub cell: PositionCell,
    edge: Option<MovingEdge>,
}

impl PressureMotion {
    /// Motion within `cell`, where the plain contact has this half-width.
    pub(crate) fn new(flanks: Flanks<'_>, cell: PositionCell, half_width_mm: f64) -> Self {
        let geometry = &flanks.geometry;
        let moving = |edge: EdgeUnderLoad, still_from_mm: Option<f64>| MovingEdge {
            gear: edge.gear,
            at_mm: edge.on_tangent_mm(geometry, cell.position_mm),
            to_ends_mm: shift_to_ends_mm(geometry, edge.gear, edge.coordinate_mm, cell)
                .map(|by| on_tangent(edge.gear, by)),
            still_from_mm,
        };
        if let Some(edge) = edge_under_load(geometry, flanks.tip_from_mm, cell.position_mm) {
            return Self { cell, edge: Some(moving(edge, None)) };
        }
        let near = outermost_edges(geometry, flanks.tip_from_mm).into_iter().find_map(|(_, edge)| {
            let at_mm = edge.on_tangent_mm(geometry, cell.position_mm);
            let inwards = if edge.is_before { 1.0 } else { -1.0 };
            (at_mm.abs() < NEAR_HALF_WIDTHS * half_width_mm).then(|| {
                let moves_mm = moving(edge, None).to_ends_mm.map(f64::abs);
                let least_mm = moves_mm[0].max(moves_mm[1]) / MOST_STRETCH;
                let stretched_mm = (half_width_mm - inwards * at_mm).max(least_mm);
                moving(edge, Some(at_mm + inwards * stretched_mm))
            })
        });
        Self { cell, edge: near }
    }

    /// Whether all of the pressure stands on an edge.
    pub(super) fn is_on_edge(&self) -> bool {
        self.edge.is_some_and(|edge| edge.still_from_mm.is_none())
    }

    /// Whether only a part of the pressure goes with an edge.
    pub(super) fn is_stretched(&self) -> bool {
        self.edge.is_some_and(|edge| edge.still_from_mm.is_some())
    }

    /// The pressure that is at `along_mm` on the tangent when the contact has moved through this part of the cell. Between the edge, which has moved by e,
    /// and the place where it stands still, X at the cell's position is now at x:
    ///
    /// ```text
    /// (x_still − x)/(x_still − x_edge − e) = (x_still − X)/(x_still − x_edge)          p(x) = p(X) dX/dx
    /// ```
    ///
    /// Stretched pressure falls, so that it keeps its load. Means over straight courses, as if all of it went as far as at the place of the point, give the
    /// points up to 2 % too much where positions are a half-width apart: an error by the square of their distance, which gathers where edges wear.
    pub(super) fn met_at_mm(&self, along_mm: f64, part_of_cell: f64) -> PressureMet {
        let Some(edge) = self.edge else { return PressureMet { along_mm, density: 1.0 } };
        let moved_mm = edge.moved_mm(part_of_cell);
        let with_edge = PressureMet { along_mm: along_mm - moved_mm, density: 1.0 };
        let Some(still_mm) = edge.still_from_mm else { return with_edge };
        let stretched_mm = still_mm - edge.at_mm;
        let part = (still_mm - along_mm) / (stretched_mm - moved_mm);
        match part {
            still if still <= 0.0 => PressureMet { along_mm, density: 1.0 },
            beyond if beyond >= 1.0 => with_edge,
            _ => PressureMet {
                along_mm: still_mm - part * stretched_mm,
                density: stretched_mm / (stretched_mm - moved_mm),
            },
        }
    }

    /// Whether points of `gear` may go with the pressure.
    pub(super) fn goes_with(&self, gear: Gear) -> bool {
        self.edge.is_some_and(|edge| edge.gear == gear)
    }

    /// Distances, in a gear's own direction of the tangent, that its flank around `coordinate_mm`, at `along_mm` on the tangent, passes the pressure from
    /// the cell's position to its ends; of a flank that goes with the pressure, its points `spacing_mm` apart there.
    pub(super) fn passes_mm(
        &self,
        geometry: &dyn ConjugateFlanks,
        gear: Gear,
        (coordinate_mm, along_mm): (f64, f64),
        spacing_mm: impl FnOnce() -> f64,
    ) -> [f64; 2] {
        let own_mm = shift_to_ends_mm(geometry, gear, coordinate_mm, self.cell);
        let Some(edge) = self.edge else { return own_mm };
        let part = edge.part_at(along_mm);
        let [lower, upper] = [0, 1].map(|end| own_mm[end] - part * on_tangent(gear, edge.to_ends_mm[end]));
        if edge.gear == gear {
            let half_mm = 0.5 * spacing_mm();
            if (upper - lower).abs() < 2.0 * half_mm {
                return [-half_mm, half_mm];
            }
        }
        [lower, upper]
    }
}

/// Place on the common tangent, towards the pinion's tip, of a place in a gear's own direction, and the other way round.
pub(super) fn on_tangent(gear: Gear, along_mm: f64) -> f64 {
    match gear {
        Gear::Pinion => along_mm,
        Gear::Wheel => -along_mm,
    }
}

#[cfg(test)]
mod tests {
    use super::super::strip::tests::pair_of;
    use super::*;
    use gearwear_bodies::gear::flank::{FlankGrid, PointSpacing};

    /// The edge does not pass the pressure that goes with it, and the mate passes it as far as the flanks slide on each other, before A and where the
    /// contact between A and E reaches the edge; half a half-width beyond the middle of the contact the pressure stands half as still.
    #[test]
    fn ver_the_pressure_goes_with_its_edge() {
        let pair = pair_of(3.0, 114.74, [(19, 0.35), (57, -0.1)]);
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 300, PointSpacing::Graded));
        let flanks = Flanks::of_gears(&pair, grid.as_ref());
        let half_width_mm = 0.2;
        let [start_mm, end_mm] = [pair.path.start_mm, pair.path.end_mm];
        for (position_mm, edge_gear, is_on_edge) in [
            (start_mm - 0.1, Gear::Wheel, true),
            (start_mm + 0.05, Gear::Wheel, false),
            (end_mm - 0.05, Gear::Pinion, false),
            (end_mm + 0.1, Gear::Pinion, true),
        ] {
            let cell = PositionCell { position_mm, lower_mm: position_mm - 0.01, upper_mm: position_mm + 0.01 };
            let motion = PressureMotion::new(flanks, cell, half_width_mm);
            assert!(
                motion.is_on_edge() == is_on_edge && motion.goes_with(edge_gear) && !motion.goes_with(edge_gear.mate())
            );
            let tip_mm = pair.flank_limits_mm(edge_gear).1;
            let edge_mm = on_tangent(edge_gear, pair.in_tangent_frame(edge_gear, tip_mm, position_mm).along_mm);
            let span = |[lower, upper]: [f64; 2]| (upper - lower).abs();
            // Points as close as these feel what the edge itself feels.
            let own = motion.passes_mm(&pair, edge_gear, (tip_mm, edge_mm), || 1e-12);
            assert!(span(own) < 1e-9, "{position_mm}: {own:?}");
            let mate = edge_gear.mate();
            let facing_mm = pair.at_along(mate, on_tangent(mate, edge_mm), position_mm).0;
            let passed_mm = span(motion.passes_mm(&pair, mate, (facing_mm, edge_mm), || 1e-12));
            let of_edge_mm = span(shift_to_ends_mm(&pair, edge_gear, tip_mm, cell));
            let of_mate_mm = span(shift_to_ends_mm(&pair, mate, facing_mm, cell));
            assert!(
                (passed_mm - (of_mate_mm - of_edge_mm).abs()).abs() < 1e-12,
                "{passed_mm} {of_mate_mm} {of_edge_mm}"
            );
            let sliding_mm = pair.sliding_mm(cell.lower_mm, cell.upper_mm).abs();
            assert!((passed_mm / sliding_mm - 1.0).abs() < 0.1, "{position_mm}: {passed_mm} {sliding_mm}");
            if !is_on_edge {
                let still_mm = if edge_mm < 0.0 { half_width_mm } else { -half_width_mm };
                let halfway_mm = edge_mm.midpoint(still_mm);
                let of_mate = shift_to_ends_mm(&pair, mate, facing_mm, cell);
                let half = motion.passes_mm(&pair, mate, (facing_mm, halfway_mm), || 1e-12);
                let still = motion.passes_mm(&pair, mate, (facing_mm, still_mm), || 1e-12);
                assert_eq!(still, of_mate);
                assert!((span(half) - (of_mate_mm - 0.5 * of_edge_mm).abs()).abs() < 1e-9, "{half:?}");
            }
        }
    }

    /// What a stretched pressure meets between its edge and where it stands still is all of it, once, and it keeps its load: the densities add up to
    /// the stretch at the cell's position. It goes with the edge at the edge, and stands still beyond, also where positions are far apart.
    #[test]
    fn ver_a_stretched_pressure_keeps_its_load() {
        let pair = pair_of(3.0, 114.74, [(19, 0.35), (57, -0.1)]);
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 300, PointSpacing::Graded));
        let flanks = Flanks::of_gears(&pair, grid.as_ref());
        let [start_mm, end_mm] = [pair.path.start_mm, pair.path.end_mm];
        for (position_mm, half_mm) in [(start_mm + 0.05, 0.05), (end_mm - 0.1, 0.05), (start_mm + 0.1, 0.6)] {
            let cell = PositionCell { position_mm, lower_mm: position_mm - half_mm, upper_mm: position_mm + half_mm };
            let motion = PressureMotion::new(flanks, cell, 0.2);
            assert!(motion.is_stretched());
            let edge = motion.edge.unwrap();
            let still_mm = edge.still_from_mm.unwrap();
            for part in [0.0, 0.3, 0.5, 1.0] {
                let edge_mm = edge.at_mm + edge.moved_mm(part);
                let parts = 1000;
                let step_mm = (still_mm - edge_mm) / f64::from(parts);
                let met = |k: f64| motion.met_at_mm(edge_mm + k * step_mm, part);
                let sum_mm: f64 = (0..parts).map(|k| step_mm * met(f64::from(k) + 0.5).density).sum();
                assert!((sum_mm - (still_mm - edge.at_mm)).abs() < 1e-9, "{position_mm}, {part}: {sum_mm}");
                assert!((met(0.0).along_mm - edge.at_mm).abs() < 1e-9);
                assert!((met(1200.0).along_mm - (edge_mm + 1200.0 * step_mm)).abs() < 1e-12);
            }
        }
    }
}
