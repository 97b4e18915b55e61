//! Points of one flank that may touch the other: places, motion and sliding while they face the mate.

use super::flank_motion::{PressureMet, PressureMotion, on_tangent, shift_to_ends_mm};
use super::strip::ContactWindow;
use super::{Flanks, PositionCell};
use gearwear_bodies::gear::{Gear, conjugate::ConjugateFlanks, involute::TangentFramePoint};

/// Consecutive points of one flank that may touch the other, with one more at either end.
#[derive(Debug, Clone)]
pub(crate) struct ObservedPoints {
    /// Index of the first point that may touch; the samples begin one before it.
    pub first_point: usize,
    /// Places of the samples in the tangent frame.
    pub at: Vec<TangentFramePoint>,
    /// Sliding of each point (without the ends) while the contact moves through the cell, counted only while the mate
    /// faces it, mm.
    pub sliding_mm: Vec<f64>,
    /// Distances that each point moves along the tangent from the cell's position to its lower and to its upper end, mm; near a base circle neighbours
    /// differ much.
    shifts_to_ends_mm: Vec<[f64; 2]>,
    /// Ends along the tangent, mm, of a flank that stands under the pressure; its points feel the pressure on their part of it.
    standing_within_mm: Option<[f64; 2]>,
    /// Points that an end of the mate's flank passes within the cell, or that face nothing.
    partly_exposed: Vec<PartlyExposed>,
}

/// Parts of the time of a course for which a stretched pressure is averaged each by itself.
const PARTS_OF_COURSE: usize = 4;

/// Course of a flank point through the pressure at the cell's position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Course {
    /// Places on the tangent where it begins and ends, mm.
    pub ends_mm: [f64; 2],
    /// Equal parts of its time; none where the pressure is not stretched.
    pub parts: Option<[PartOfCourse; PARTS_OF_COURSE]>,
}

/// Part of a course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PartOfCourse {
    /// Places on the tangent where it begins and ends, mm.
    pub ends_mm: [f64; 2],
    /// Weight of the mean pressure between them.
    pub weight: f64,
}

impl Course {
    /// Course through a pressure that is not stretched.
    fn even(ends_mm: [f64; 2]) -> Self {
        Self { ends_mm, parts: None }
    }

    /// Course over the part `from` to `to` of the cell; `met` tells the pressure that is met at a part of it.
    fn stretched([from, to]: [f64; 2], met: impl Fn(f64) -> PressureMet) -> Self {
        let at = |k: f64| from + (to - from) * k / PARTS_OF_COURSE as f64;
        let parts = std::array::from_fn(|k| {
            let k = k as f64;
            PartOfCourse {
                ends_mm: [k, k + 1.0].map(|end| met(at(end)).along_mm),
                weight: met(at(k + 0.5)).density / PARTS_OF_COURSE as f64,
            }
        });
        Self { ends_mm: [from, to].map(|end| met(end).along_mm), parts: Some(parts) }
    }
}

/// A point that faces the mate during part of the cell only.
#[derive(Debug, Clone, Copy)]
struct PartlyExposed {
    /// Index, counted from the first point.
    sample: usize,
    /// Part of the cell at which the point begins to face the mate, 0 to 1.
    from: f64,
    /// Part of the cell at which it ends to face the mate.
    to: f64,
}

impl ObservedPoints {
    /// The points of `gear` facing `window` anywhere in `cell`.
    pub(crate) fn new(flanks: Flanks<'_>, gear: Gear, window: ContactWindow, cell: PositionCell) -> Self {
        let (geometry, grid) = (flanks.geometry, flanks.grid[gear]);
        let (lower, upper) = match gear {
            Gear::Pinion => (window.lower_mm, window.upper_mm),
            Gear::Wheel => (-window.upper_mm, -window.lower_mm),
        };
        // Length of flank that the contact passes within the cell.
        let passed = geometry.rolling_ratio(gear, cell.position_mm) * (cell.upper_mm - cell.lower_mm);
        let [from, to] = [lower - passed, upper + passed]
            .map(|along| grid.place(geometry.at_along(gear, along, cell.position_mm).0).index);
        let tip = grid.len() - 1;
        let first_point = from.max(1);
        let last = (to + 1).min(tip).max(first_point);

        let samples = first_point - 1..=(last + 1).min(tip);
        let mut at: Vec<TangentFramePoint> =
            samples.map(|i| geometry.in_tangent_frame(gear, grid.coordinate_mm[i], cell.position_mm)).collect();
        if last == tip {
            let [.., before, end] = at[..] else { unreachable!("two points at least") };
            let along = 2.0 * end.along_mm - before.along_mm;
            at.push(TangentFramePoint { along_mm: along, drop_mm: geometry.at_along(gear, along, cell.position_mm).1 });
        }
        let sliding = geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
        let exposure = Exposure::new(flanks, gear, cell);
        let (mut sliding_mm, mut partly_exposed) = (Vec::with_capacity(at.len()), Vec::new());
        for (sample, (i, point)) in (first_point..=last).zip(&at[1..]).enumerate() {
            let (from, to) = exposure.of(&geometry, grid.coordinate_mm[i], point.along_mm);
            sliding_mm.push(sliding * (to - from));
            if from > 0.0 || to < 1.0 {
                partly_exposed.push(PartlyExposed { sample, from, to });
            }
        }
        let coordinates_mm = &grid.coordinate_mm[first_point..=last];
        let shifts = coordinates_mm.iter().map(|&at| shift_to_ends_mm(&geometry, gear, at, cell));
        let shifts_to_ends_mm = shifts.collect();
        Self { first_point, sliding_mm, partly_exposed, standing_within_mm: None, at, shifts_to_ends_mm }
    }

    /// The points under a pressure of this motion; the mate passes an edge all the time.
    pub(crate) fn under_pressure(
        flanks: Flanks<'_>,
        gear: Gear,
        window: ContactWindow,
        motion: PressureMotion,
    ) -> Self {
        let (geometry, cell) = (&flanks.geometry, motion.cell);
        let mut points = Self::new(flanks, gear, window, cell);
        if motion.is_on_edge() {
            let sliding = geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
            points.partly_exposed.retain(|point| point.from == point.to);
            points.sliding_mm.fill(sliding);
            points.partly_exposed.iter().for_each(|point| points.sliding_mm[point.sample] = 0.0);
        }
        if motion.goes_with(gear) {
            let (from_mm, to_mm) = geometry.flank_limits_mm(gear);
            let ends_mm =
                [from_mm, to_mm].map(|end_mm| geometry.in_tangent_frame(gear, end_mm, cell.position_mm).along_mm);
            points.standing_within_mm = Some(ends_mm);
        }
        points
    }

    /// Courses of the points of `gear` through a pressure of this motion; none for points that never face the mate.
    pub(crate) fn courses(&self, gear: Gear, motion: &PressureMotion) -> Vec<Option<Course>> {
        let mut faced = vec![Some([0.0, 1.0]); self.sliding_mm.len()];
        for point in &self.partly_exposed {
            faced[point.sample] = (point.from < point.to).then_some([point.from, point.to]);
        }
        let points = self.at.windows(3).zip(&self.shifts_to_ends_mm).zip(faced);
        let courses = points.map(|((three, shifts_mm), faced)| {
            let [from, to] = faced?;
            let here_mm = three[1].along_mm;
            let met = |part: f64| {
                let moved_mm = shifts_mm[0] + part * (shifts_mm[1] - shifts_mm[0]);
                motion.met_at_mm(on_tangent(gear, here_mm + moved_mm), part)
            };
            let ends_mm = [from, to].map(|part| met(part).along_mm);
            let [before_mm, after_mm] = [three[0], three[2]].map(|point| point.along_mm);
            if let Some([first_mm, last_mm]) = self.standing_within_mm
                && (ends_mm[1] - ends_mm[0]).abs() <= 0.5 * (after_mm - before_mm) * (1.0 + 1e-9)
            {
                // Half of the way to either neighbour; the part of the outermost point ends with the edge.
                let ends_mm = [
                    here_mm + (0.5 * (before_mm - here_mm)).max((first_mm - here_mm).min(0.0)),
                    here_mm + (0.5 * (after_mm - here_mm)).min((last_mm - here_mm).max(0.0)),
                ];
                return Some(Course::even(ends_mm.map(|end_mm| on_tangent(gear, end_mm))));
            }
            if !motion.is_stretched() {
                return Some(Course::even(ends_mm));
            }
            Some(Course::stretched([from, to], met))
        });
        courses.collect()
    }

    /// Distances that each point moves along the tangent from the cell's position to the begin and to the end of the part of
    /// the cell in which it faces the mate.
    pub(crate) fn shifts_to_ends_mm(&self) -> Vec<[f64; 2]> {
        let mut shifts = self.shifts_to_ends_mm.clone();
        for point in &self.partly_exposed {
            let [lower, upper] = shifts[point.sample];
            shifts[point.sample] = [point.from, point.to].map(|t| lower + t * (upper - lower));
        }
        shifts
    }
}

/// Part of a cell in which a flank point faces the mate.
struct Exposure {
    gear: Gear,
    cell: PositionCell,
    own_limits_mm: (f64, f64),
    /// First and last place of the mate's flank, in the gear's own direction of the tangent, at both ends of the cell.
    mate_limits_mm: [[f64; 2]; 2],
}

impl Exposure {
    fn new(flanks: Flanks<'_>, gear: Gear, cell: PositionCell) -> Self {
        let mate = flanks.geometry.flank_limits_mm(gear.mate());
        Self {
            gear,
            cell,
            own_limits_mm: flanks.geometry.flank_limits_mm(gear),
            mate_limits_mm: [cell.lower_mm, cell.upper_mm].map(|end| {
                [mate.1, mate.0].map(|limit| -flanks.geometry.in_tangent_frame(gear.mate(), limit, end).along_mm)
            }),
        }
    }

    /// Part of the cell, from and to in 0..1, in which the point at `coordinate_mm`, at `along_mm` at the cell's position, faces the mate: it
    /// moves past the mate's ends in a straight line.
    fn of(&self, geometry: &dyn ConjugateFlanks, coordinate_mm: f64, along_mm: f64) -> (f64, f64) {
        let tolerance = 1e-9 * self.own_limits_mm.1;
        if !(self.own_limits_mm.0 - tolerance..=self.own_limits_mm.1 + tolerance).contains(&coordinate_mm) {
            return (0.0, 0.0);
        }
        let shifts = shift_to_ends_mm(geometry, self.gear, coordinate_mm, self.cell);
        let [before, after] = [0, 1].map(|end| {
            let here = along_mm + shifts[end];
            let [first, last] = self.mate_limits_mm[end];
            [here - first, last - here]
        });
        let (from, to) = before
            .iter()
            .zip(after)
            .map(|(&before, after)| positive_stretch(before, after))
            .fold((0.0, 1.0), |(from, to): (f64, f64), other| (from.max(other.0), to.min(other.1)));
        (from, to.max(from))
    }
}

/// Part of the way from `before` to `after` on which the straight line between them is not negative.
fn positive_stretch(before: f64, after: f64) -> (f64, f64) {
    match (before >= 0.0, after >= 0.0) {
        (true, true) => (0.0, 1.0),
        (false, true) => (before / (before - after), 1.0),
        (true, false) => (0.0, before / (before - after)),
        (false, false) => (0.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::super::strip::tests::pair_of;
    use super::*;
    use gearwear_bodies::gear::PerGear;
    use gearwear_bodies::gear::flank::{FlankGrid, PointSpacing};

    /// A window that has grown has more points; those that it had before move as they did, also near the base circle of an undercut wheel, where
    /// neighbours move by other distances.
    #[test]
    fn prop_points_move_alike_whatever_the_window() {
        let pair = pair_of(5.407, 127.4, [(37, 0.02266), (10, 0.0)]);
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 80, PointSpacing::Graded));
        let flanks = Flanks::of_gears(&pair, grid.as_ref());
        let spacing_mm = (pair.path.end_mm - pair.path.start_mm) / 20.0;
        let mut differing = 0;
        for k in -1..=21 {
            let position_mm = pair.path.start_mm + spacing_mm * f64::from(k);
            let (lower_mm, upper_mm) = (position_mm - 0.5 * spacing_mm, position_mm + 0.5 * spacing_mm);
            let cell = PositionCell { position_mm, lower_mm, upper_mm };
            let motion = PressureMotion::new(flanks, cell, 0.1);
            for gear in Gear::BOTH {
                let [first, grown] = [0.1, 0.4].map(|half_length_mm| {
                    let window = ContactWindow::new(flanks, position_mm, half_length_mm);
                    ObservedPoints::under_pressure(flanks, gear, window, motion)
                });
                let before = first.first_point - grown.first_point;
                let courses_mm = grown.shifts_to_ends_mm();
                let seen_before = &courses_mm[before..before + first.sliding_mm.len()];
                if !motion.goes_with(gear) {
                    assert_eq!(first.shifts_to_ends_mm(), seen_before, "{gear:?} at {position_mm} mm");
                }
                let [least, most] = [f64::min, f64::max]
                    .map(|of| seen_before.iter().map(|[from, to]| (to - from).abs()).reduce(of).unwrap_or_default());
                differing += usize::from(least < 0.8 * most);
            }
        }
        assert!(differing > 2, "{differing}");
    }
}
