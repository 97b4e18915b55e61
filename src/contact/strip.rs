//! The stretch of both flanks around the theoretical contact point where they may touch.
//!
//! A strip carries samples of the geometric gap in the tangent frame and, for each, where it lies between the points of
//! both flanks, so that the real gap (geometry plus removed material) is one pass over plain arrays.
//!
//! There are two kinds of samples: evenly spaced ones across the contact, from which the load follows, and the points
//! of one flank themselves, on which pressure and sliding are observed. Real ends of a strip, where a flank ends in
//! its tip edge (or its involute ends at the form circle), are kept exactly: no pressure acts beyond them.

use std::ops::Range;

use super::{Flanks, PositionCell};
use crate::gear::{Gear, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid, involute::TangentFramePoint};
use crate::reference::linear_means::add_means;

/// Removed material of one flank at samples between its points.
#[derive(Debug, Clone, Default)]
struct Interpolation {
    index: Vec<u32>,
    weight: Vec<f64>,
}

impl Interpolation {
    fn push(&mut self, grid: &FlankGrid, coordinate_mm: f64) {
        // Samples follow each other along the flank.
        let place = match self.index.last() {
            Some(&before) => grid.place_near(before as usize, coordinate_mm),
            None => grid.place(coordinate_mm),
        };
        self.index.push(place.index as u32);
        self.weight.push(place.weight);
    }

    /// The values at samples from `first` on.
    fn of<'a>(&'a self, values: &'a [f64], first: usize) -> impl Iterator<Item = f64> + 'a {
        self.index[first..].iter().zip(&self.weight[first..]).map(|(&i, &weight)| {
            let ends = &values[i as usize..i as usize + 2];
            ends[0] + weight * (ends[1] - ends[0])
        })
    }
}

/// Removed material of one flank at samples: its mean over the stretch that passes each while the contact stands for its position.
#[derive(Debug, Clone, Default)]
struct PassingMean {
    first: Vec<u32>,
    ends: Vec<u32>,
    weights: Vec<f64>,
}

impl PassingMean {
    /// `sums` is a row for all points, empty again afterwards.
    fn push(&mut self, grid: &FlankGrid, stretch_mm: [f64; 2], sums: &mut [f64]) {
        let reached = add_means(&grid.coordinate_mm, stretch_mm, 1.0, sums);
        self.first.push(reached.start as u32);
        self.weights.extend_from_slice(&sums[reached.clone()]);
        self.ends.push(self.weights.len() as u32);
        sums[reached].fill(0.0);
    }

    fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let mut begin = 0;
        self.first.iter().zip(&self.ends).map(move |(&first, &end)| {
            let weights = &self.weights[begin as usize..end as usize];
            begin = end;
            weights.iter().zip(&values[first as usize..]).map(|(weight, value)| weight * value).sum()
        })
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
    /// Whether it ends there in a sharp tip edge that may carry load: the wheel's below, the pinion's above.
    pub ends_are_sharp: [bool; 2],
}

impl Window {
    /// `half_length_mm` to either side of the theoretical contact point, or of the tip edge next to it where the one flank
    /// ends before it, cut where a flank ends.
    pub fn new(flanks: Flanks<'_>, position_mm: f64, half_length_mm: f64) -> Self {
        let ((lower, upper), at_tips) = common_extent_mm(flanks.geometry, position_mm);
        let centre = 0.0_f64.min(upper).max(lower);
        let (from, to) = (centre - half_length_mm, centre + half_length_mm);
        let ends_are_real = [lower >= from, upper <= to];
        let sharp = [flanks.sharp_edges.wheel, flanks.sharp_edges.pinion];
        Self {
            lower_mm: lower.max(from),
            upper_mm: upper.min(to),
            ends_are_real,
            ends_are_sharp: [0, 1].map(|end| ends_are_real[end] && at_tips[end] && sharp[end]),
        }
    }

    /// Its length.
    pub fn length_mm(&self) -> f64 {
        self.upper_mm - self.lower_mm
    }

    /// Whether a sharp tip edge cuts off a contact that presses on these of the ends.
    pub fn is_sharp_where(&self, pressed: [bool; 2]) -> bool {
        self.ends_are_sharp.iter().zip(pressed).any(|(sharp, pressed)| *sharp && pressed)
    }
}

/// Parts of the flank's length by which a limit may miss the theoretical contact point at A or E.
const ROUND_OFF: f64 = 1e-9;

/// Where along the tangent both flanks exist, before A and after E beside the theoretical contact point; and whether it is a tip edge that
/// ends it there, the wheel's below and the pinion's above.
pub(super) fn common_extent_mm(geometry: &dyn ConjugateFlanks, position_mm: f64) -> ((f64, f64), [bool; 2]) {
    let along = |gear: Gear, coordinate| geometry.in_tangent_frame(gear, coordinate, position_mm).along_mm;
    let (p, w) = (geometry.flank_limits_mm(Gear::Pinion), geometry.flank_limits_mm(Gear::Wheel));
    // The wheel's tangent coordinate runs the other way. At A and E, where one limit is the contact point itself,
    // round-off must not put it outside.
    let round_off = ROUND_OFF * p.1.max(w.1);
    let [lowers, uppers] =
        [[along(Gear::Pinion, p.0), -along(Gear::Wheel, w.1)], [along(Gear::Pinion, p.1), -along(Gear::Wheel, w.0)]];
    let (lower, upper) = (lowers[0].max(lowers[1]), uppers[0].min(uppers[1]));
    let extent = (
        if lower < round_off { lower.min(0.0) } else { lower },
        if upper > -round_off { upper.max(0.0) } else { upper },
    );
    (extent, [lowers[1] >= lowers[0], uppers[0] <= uppers[1]])
}

/// Distance of the pinion's points at the theoretical contact point.
pub fn point_distance_mm(flanks: Flanks<'_>, position_mm: f64) -> f64 {
    let grid = flanks.grid.pinion;
    let here = grid.place(flanks.geometry.contact_coordinate_mm(Gear::Pinion, position_mm)).index;
    grid.arc_mm[here + 1] - grid.arc_mm[here]
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
    removed: Removed,
}

/// How the removed material is read at the samples.
#[derive(Debug, Clone)]
enum Removed {
    /// At the place of each.
    Here(PerGear<Interpolation>),
    /// As it passes each.
    Passing(PerGear<PassingMean>),
}

impl Strip {
    /// Samples at both ends of `window` and between `intervals` even parts of it.
    pub fn new(flanks: Flanks<'_>, position_mm: f64, window: Window, intervals: usize) -> Self {
        let spacing_mm = window.length_mm() / intervals as f64;
        let mut strip = Self {
            window,
            spacing_mm,
            geometric_gap_mm: Vec::with_capacity(intervals + 1),
            removed: Removed::Here(PerGear::default()),
        };
        let mut here: PerGear<Interpolation> = PerGear::default();
        for k in 0..=intervals {
            let along = window.lower_mm + k as f64 * spacing_mm;
            let mut gap = 0.0;
            for (gear, along) in [(Gear::Pinion, along), (Gear::Wheel, -along)] {
                let (coordinate, drop) = flanks.geometry.at_along(gear, along, position_mm);
                gap += drop;
                here[gear].push(flanks.grid[gear], coordinate);
            }
            strip.geometric_gap_mm.push(gap);
        }
        strip.removed = Removed::Here(here);
        strip
    }

    /// The same where the pressure stands still while the flanks pass under it during `cell`: each sample then sees the mean wear of what
    /// passes it, as all that passes it feels its pressure. Seen at one place alone, a wave of wear as long as the positions are apart
    /// would meet each of them alike, and grow.
    pub fn passed_by(self, flanks: Flanks<'_>, cell: Option<PositionCell>) -> Self {
        let (Some(modification_mm), Some(cell)) = (flanks.modification_mm, cell) else { return self };
        let Removed::Here(here) = &self.removed else { return self };
        let mut passing: PerGear<PassingMean> = PerGear::default();
        let mut geometric_gap_mm = self.geometric_gap_mm.clone();
        for gear in Gear::BOTH {
            let grid = flanks.grid[gear];
            let mut sums = vec![0.0; grid.len()];
            let spacing_mm = grid.arc_mm[grid.len() - 1] - grid.arc_mm[grid.len() - 2];
            for k in 0..geometric_gap_mm.len() {
                let along = self.window.lower_mm + k as f64 * self.spacing_mm;
                let own = if gear == Gear::Pinion { along } else { -along };
                let at = |along: f64| flanks.geometry.at_along(gear, along, cell.position_mm).0;
                let passes = passes_to_ends_mm(flanks.geometry, gear, at(own), cell, spacing_mm);
                let ends = passes.map(|shift| at(own - shift));
                passing[gear].push(grid, [ends[0].min(ends[1]), ends[0].max(ends[1])], &mut sums);
            }
            // A modification stays what it is at the sample.
            let own = modification_mm[gear];
            let beside = here[gear].of(own, 0).zip(passing[gear].of(own));
            geometric_gap_mm.iter_mut().zip(beside).for_each(|(gap, (here, mean))| *gap += here - mean);
        }
        Self { removed: Removed::Passing(passing), geometric_gap_mm, ..self }
    }

    /// The gap with `removed_mm` of material gone, into `gap_mm`, and its least value.
    pub fn gap_mm(&self, removed_mm: PerGear<&[f64]>, gap_mm: &mut Vec<f64>) -> f64 {
        match &self.removed {
            Removed::Here(here) => self.opened_mm(Gear::BOTH.map(|gear| here[gear].of(removed_mm[gear], 0)), gap_mm),
            Removed::Passing(passing) => {
                self.opened_mm(Gear::BOTH.map(|gear| passing[gear].of(removed_mm[gear])), gap_mm)
            }
        }
    }

    fn opened_mm(&self, [pinion, wheel]: [impl Iterator<Item = f64>; 2], gap_mm: &mut Vec<f64>) -> f64 {
        gap_mm.resize(self.geometric_gap_mm.len(), 0.0);
        let mut least = f64::INFINITY;
        for (((gap, geometric), pinion), wheel) in gap_mm.iter_mut().zip(&self.geometric_gap_mm).zip(pinion).zip(wheel)
        {
            *gap = geometric + pinion + wheel;
            if *gap < least {
                least = *gap;
            }
        }
        least
    }

    /// Whether flanks pressed together by `approach_mm`, and that have lost at least `removed_mm` wherever they may touch, can touch
    /// beyond an end of the window that is not real: what else is removed only widens the gap, so the geometric gap decides.
    pub fn may_touch_beyond(&self, approach_mm: f64, removed_mm: f64) -> bool {
        let ends = [self.geometric_gap_mm[0], self.geometric_gap_mm[self.geometric_gap_mm.len() - 1]];
        ends.iter().zip(self.window.ends_are_real).any(|(&gap, real)| !real && approach_mm - removed_mm > gap)
    }
}

/// Flanks are searched this much farther than parabolas of their relative curvature would touch.
const AMPLE_REACH: f64 = 1.25;

/// The least that both flanks together have lost wherever they can touch when pressed together by `approach_mm`: where a parabola
/// of their relative curvature, and some way on, is nearer than that.
pub fn least_removed_mm(flanks: Flanks<'_>, position_mm: f64, approach_mm: f64, removed_mm: PerGear<&[f64]>) -> f64 {
    let reach = AMPLE_REACH * (2.0 * flanks.geometry.relative_radius_mm(position_mm) * approach_mm).sqrt();
    let least = |gear: Gear| {
        let grid = flanks.grid[gear];
        let here = grid.arc_mm[grid.place(flanks.geometry.contact_coordinate_mm(gear, position_mm)).index];
        // The next point on either side counts too: what is removed is linear in between.
        let first = grid.arc_mm.partition_point(|&arc| arc < here - reach).saturating_sub(1);
        let end = (grid.arc_mm.partition_point(|&arc| arc <= here + reach) + 2).min(grid.len());
        removed_mm[gear][first..end].iter().copied().fold(f64::INFINITY, f64::min)
    };
    least(Gear::Pinion) + least(Gear::Wheel)
}

/// Consecutive points of one flank that may touch the other, with one more at either end.
#[derive(Debug, Clone)]
pub struct ObservedPoints {
    /// Index of the first point that may touch; the samples begin one before it.
    pub first_point: usize,
    /// Where the samples lie in the tangent frame.
    pub at: Vec<TangentFramePoint>,
    /// Distance of the samples, mm.
    pub spacing_mm: f64,
    /// Sliding of each point (without the ends) while the contact moves through the cell, counted only while the mate
    /// faces it, mm.
    pub sliding_mm: Vec<f64>,
    /// How far the points move along the tangent from the cell's position to its lower and to its upper end, mm.
    shift_to_ends_mm: [f64; 2],
    /// Where the flank ends that stands under the pressure, along the tangent, mm.
    standing_to_mm: Option<f64>,
    /// The points that an end of the mate's flank passes within the cell, or that face nothing.
    partly_exposed: Vec<PartlyExposed>,
}

/// A point that faces the mate during part of the cell only.
#[derive(Debug, Clone, Copy)]
struct PartlyExposed {
    /// Which one, counted from the first point.
    sample: usize,
    /// When it begins to face the mate, 0 to 1.
    from: f64,
    /// When it ends.
    to: f64,
}

impl ObservedPoints {
    /// The points of `gear` facing `window` anywhere in `cell`.
    pub fn new(flanks: Flanks<'_>, gear: Gear, window: Window, cell: PositionCell) -> Self {
        let (geometry, grid) = (flanks.geometry, flanks.grid[gear]);
        let (lower, upper) = match gear {
            Gear::Pinion => (window.lower_mm, window.upper_mm),
            Gear::Wheel => (-window.upper_mm, -window.lower_mm),
        };
        // The contact moves over the flank within the cell: take in what it passes.
        let passed = geometry.rolling_ratio(gear, cell.position_mm) * (cell.upper_mm - cell.lower_mm);
        let place = |along| grid.place(geometry.at_along(gear, along, cell.position_mm).0).index;
        let tip = grid.len() - 1;
        let first_point = place(lower - passed).max(1);
        let last = (place(upper + passed) + 1).min(tip).max(first_point);

        let samples = first_point - 1..=(last + 1).min(tip);
        let mut at: Vec<TangentFramePoint> =
            samples.map(|i| geometry.in_tangent_frame(gear, grid.coordinate_mm[i], cell.position_mm)).collect();
        let spacing_mm = (at[at.len() - 1].along_mm - at[0].along_mm) / (at.len() - 1) as f64;
        if last == tip {
            let along = at[at.len() - 1].along_mm + spacing_mm;
            at.push(TangentFramePoint { along_mm: along, drop_mm: geometry.at_along(gear, along, cell.position_mm).1 });
        }
        let sliding = geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
        let exposure = Exposure::new(flanks, gear, cell);
        let (mut sliding_mm, mut partly_exposed) = (Vec::with_capacity(at.len()), Vec::new());
        for (sample, (i, point)) in (first_point..=last).zip(&at[1..]).enumerate() {
            let (from, to) = exposure.of(geometry, grid.coordinate_mm[i], point.along_mm);
            sliding_mm.push(sliding * (to - from));
            if from > 0.0 || to < 1.0 {
                partly_exposed.push(PartlyExposed { sample, from, to });
            }
        }
        let middle = grid.coordinate_mm[first_point.midpoint(last)];
        Self {
            first_point,
            spacing_mm,
            sliding_mm,
            partly_exposed,
            standing_to_mm: None,
            at,
            shift_to_ends_mm: shift_to_ends_mm(geometry, gear, middle, cell),
        }
    }
}

impl ObservedPoints {
    /// The same under a pressure that stands still during the cell, or goes with a tip edge: where an edge stands, its
    /// mate passes it all the time.
    pub fn under_standing_pressure(flanks: Flanks<'_>, gear: Gear, window: Window, cell: PositionCell) -> Self {
        let mut points = Self::new(flanks, gear, window, cell);
        if let Some(edge) = edge_under_load(flanks.geometry, cell.position_mm) {
            let sliding = flanks.geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
            points.partly_exposed.retain(|point| point.from == point.to);
            points.sliding_mm.fill(sliding);
            points.partly_exposed.iter().for_each(|point| points.sliding_mm[point.sample] = 0.0);
            let middle = flanks.grid[gear].coordinate_mm[points.first_point + points.sliding_mm.len() / 2];
            if edge == gear {
                let tip = flanks.geometry.flank_limits_mm(gear).1;
                points.standing_to_mm = Some(flanks.geometry.in_tangent_frame(gear, tip, cell.position_mm).along_mm);
            }
            points.shift_to_ends_mm = passes_to_ends_mm(flanks.geometry, gear, middle, cell, points.spacing_mm);
        }
        points
    }

    /// How far each point moves along the tangent from the cell's position to both ends of the part of the cell in which it faces the
    /// mate; nothing of points that do not.
    pub fn courses_mm(&self) -> Vec<Option<[f64; 2]>> {
        let mut courses: Vec<_> = self.shifts_to_ends_mm().into_iter().map(Some).collect();
        if let Some(tip_mm) = self.standing_to_mm {
            // The part of the last point ends with the edge.
            for (point, course) in self.at[1..].iter().zip(&mut courses) {
                *course = course.map(|ends| ends.map(|by| by.min((tip_mm - point.along_mm).max(0.0))));
            }
        }
        let unexposed = self.partly_exposed.iter().filter(|point| point.from == point.to);
        unexposed.for_each(|point| courses[point.sample] = None);
        courses
    }

    /// How far each point moves along the tangent from the cell's position to the beginning and to the end of the part of
    /// the cell in which it faces the mate.
    pub fn shifts_to_ends_mm(&self) -> Vec<[f64; 2]> {
        let [lower, upper] = self.shift_to_ends_mm;
        let mut shifts = vec![self.shift_to_ends_mm; self.sliding_mm.len()];
        for point in &self.partly_exposed {
            shifts[point.sample] = [point.from, point.to].map(|t| lower + t * (upper - lower));
        }
        shifts
    }

    /// The points, counted from the first, that touch anywhere between `lower_mm` and `upper_mm` (gear's own direction)
    /// while the contact moves through the cell; a few more at either end do not.
    pub fn between(&self, lower_mm: f64, upper_mm: f64) -> Range<usize> {
        let [a, b] = self.shift_to_ends_mm;
        let sample = |along: f64| (along - self.at[1].along_mm) / self.spacing_mm;
        // Points are almost evenly spaced; two more make up for the difference.
        let first = (sample(lower_mm - a.max(b)) - 2.0).max(0.0) as usize;
        let end = (sample(upper_mm - a.min(b)) + 3.0).max(0.0) as usize;
        let end = end.min(self.sliding_mm.len());
        first.min(end)..end
    }
}

/// How far the flank point at `coordinate_mm` moves along the tangent from the cell's position to its ends: the contact
/// moves up the pinion and down the wheel.
fn shift_to_ends_mm(geometry: &dyn ConjugateFlanks, gear: Gear, coordinate_mm: f64, cell: PositionCell) -> [f64; 2] {
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
fn passes_to_ends_mm(
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

/// By this part of its course the theoretical contact point may miss a point and still passes it: where it passes between two
/// cells, neither must lose it to rounding.
const SLACK: f64 = 0.02;

/// The gap that observed points face, and how it changes under them.
#[derive(Debug, Clone)]
pub struct GapAtPoints {
    geometric_gap_mm: Vec<f64>,
    mate: Interpolation,
    /// How the gap of each point changes within the cell.
    course: Vec<Course>,
    growth: Vec<Growth>,
}

/// How the gap of a point changes while the contact passes: its own wear stays with it, so the geometry alone does.
///
/// At `x` along the tangent from where the point is at the cell's position, its gap has grown by slope · x + x²/(2R).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Course {
    /// Where the point begins to face the mate within the cell, or the cell begins; the lower of both ends, mm.
    from_mm: f64,
    /// Where that ends; the upper of both ends, mm.
    to_mm: f64,
    slope: f64,
    /// 1/R, 1/mm.
    curvature: f64,
}

/// What the usual cases, a point in contact over its whole [`Course`] or nowhere on it, need of it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Growth {
    /// Of the gap at both ends, mm.
    at_ends_mm: [f64; 2],
    /// Of the gap on average, mm.
    mean_mm: f64,
    /// The least growth anywhere, mm.
    least_mm: f64,
}

/// A point's gap at the cell's position, and its course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacedGap<'a> {
    /// Gap at the cell's position, mm.
    pub gap_mm: f64,
    growth: &'a Growth,
    course: &'a Course,
}

impl FacedGap<'_> {
    /// The greatest penetration on the course, for flanks that have approached each other by `approach_mm`; not positive
    /// where the point never touches.
    pub fn greatest_penetration_mm(&self, approach_mm: f64) -> f64 {
        if self.course.from_mm < self.course.to_mm { approach_mm - self.gap_mm - self.growth.least_mm } else { 0.0 }
    }

    /// Mean over the course of the positive part of the penetration, for flanks that have approached each other by
    /// `approach_mm`, and the fraction of the course on which it is positive.
    #[inline]
    pub fn mean_penetration(&self, approach_mm: f64) -> (f64, f64) {
        let penetration = approach_mm - self.gap_mm;
        let [at_from, at_to] = self.growth.at_ends_mm;
        if penetration > at_from && penetration > at_to {
            return (penetration - self.growth.mean_mm, 1.0);
        }
        if penetration <= self.growth.least_mm {
            return (0.0, 0.0);
        }
        self.course.mean_positive(penetration)
    }
}

impl Course {
    fn growth(&self) -> Growth {
        Growth {
            at_ends_mm: [self.growth_at(self.from_mm), self.growth_at(self.to_mm)],
            mean_mm: self.mean_growth(self.from_mm, self.to_mm),
            least_mm: self.growth_at((-self.slope / self.curvature).max(self.from_mm).min(self.to_mm)),
        }
    }

    /// Mean over the course of the positive part of the penetration that is `u_mm` at the cell's position, and the
    /// fraction of the course on which it is positive:
    ///
    /// ```text
    /// u(x) = u − slope x − x²/(2R)       positive between x± = R (−slope ± √(slope² + 2 u/R))
    /// ```
    fn mean_positive(&self, u_mm: f64) -> (f64, f64) {
        let square = self.slope * self.slope + 2.0 * u_mm * self.curvature;
        if square <= 0.0 {
            return (0.0, 0.0);
        }
        let (deepest_mm, reach_mm) = (-self.slope / self.curvature, square.sqrt() / self.curvature);
        let from = self.from_mm.max(deepest_mm - reach_mm);
        let to = self.to_mm.min(deepest_mm + reach_mm);
        if from >= to {
            return (0.0, 0.0);
        }
        let fraction = (to - from) / (self.to_mm - self.from_mm);
        (fraction * (u_mm - self.mean_growth(from, to)), fraction)
    }

    /// Growth of the gap at `x_mm`.
    fn growth_at(&self, x_mm: f64) -> f64 {
        x_mm * (self.slope + 0.5 * self.curvature * x_mm)
    }

    /// Mean growth of the gap between two places: that at the middle and a twelfth of the square of the width over 2R.
    fn mean_growth(&self, from_mm: f64, to_mm: f64) -> f64 {
        let width = to_mm - from_mm;
        self.growth_at(0.5 * (from_mm + to_mm)) + self.curvature * width * width / 24.0
    }
}

impl GapAtPoints {
    /// Of `points` at `position_mm`.
    pub fn new(flanks: Flanks<'_>, gear: Gear, points: &ObservedPoints, position_mm: f64) -> Self {
        let count = points.sliding_mm.len();
        let mut mate = Interpolation::default();
        let mut geometric_gap_mm: Vec<f64> = Vec::with_capacity(count + 2);
        for (sample, own) in points.at.iter().enumerate() {
            let (facing, drop) = flanks.geometry.at_along(gear.mate(), -own.along_mm, position_mm);
            geometric_gap_mm.push(own.drop_mm + drop);
            if (1..=count).contains(&sample) {
                mate.push(flanks.grid[gear.mate()], facing);
            }
        }
        let curvature = 1.0 / flanks.geometry.relative_radius_mm(position_mm);
        let shifts = points.shifts_to_ends_mm();
        let slope = |k: usize| 0.5 * (geometric_gap_mm[k + 2] - geometric_gap_mm[k]) / points.spacing_mm;
        // Conjugate flanks touch once the contact has come to the point: there, the parabola's bottom is a gap of nought, which
        // what differences and a constant curvature miss would drown in the narrow contact of a light load. Nowhere do they dip
        // into each other.
        let bottoms_out = |k: usize| (2.0 * geometric_gap_mm[k + 1].max(0.0) * curvature).sqrt();
        let (course, growth): (Vec<Course>, Vec<Growth>) = shifts
            .iter()
            .enumerate()
            .map(|(k, [begin, end])| {
                let (from_mm, to_mm) = (begin.min(*end), begin.max(*end));
                let along = points.at[k + 1].along_mm;
                let slack = SLACK * (to_mm - from_mm);
                let passed = (from_mm - slack..=to_mm + slack).contains(&-along);
                let by_differences = Course { from_mm, to_mm, slope: slope(k), curvature };
                let growth = by_differences.growth();
                let dips = geometric_gap_mm[k + 1] + growth.least_mm < 0.0;
                if !(passed || dips) {
                    return (by_differences, growth);
                }
                let course = Course { slope: bottoms_out(k).copysign(along), ..by_differences };
                (course, course.growth())
            })
            .unzip();
        geometric_gap_mm.truncate(count + 1);
        geometric_gap_mm.remove(0);
        Self { geometric_gap_mm, mate, course, growth }
    }

    /// The gap at the points of `range` (counted from the first) with `removed_mm` of material gone.
    pub fn faced<'a>(
        &'a self,
        points: &ObservedPoints,
        gear: Gear,
        removed_mm: PerGear<&'a [f64]>,
        range: Range<usize>,
    ) -> impl Iterator<Item = FacedGap<'a>> + 'a {
        let own = &removed_mm[gear][points.first_point + range.start..];
        let mate = self.mate.of(removed_mm[gear.mate()], range.start);
        let gaps = self.geometric_gap_mm[range.clone()].iter().zip(own).zip(mate);
        let courses = self.growth[range.clone()].iter().zip(&self.course[range]);
        gaps.zip(courses).map(|(((geometric, own), mate), (growth, course))| FacedGap {
            gap_mm: geometric + own + mate,
            growth,
            course,
        })
    }
}

/// How long within a cell a flank point faces a place that exists on the mate.
struct Exposure {
    gear: Gear,
    cell: PositionCell,
    own_limits_mm: (f64, f64),
    /// First and last place of the mate's flank, along the gear's own tangent direction, at both ends of the cell.
    mate_limits_mm: [[f64; 2]; 2],
}

impl Exposure {
    fn new(flanks: Flanks<'_>, gear: Gear, cell: PositionCell) -> Self {
        let mate = flanks.geometry.flank_limits_mm(gear.mate());
        let along = |limit, end| -flanks.geometry.in_tangent_frame(gear.mate(), limit, end).along_mm;
        Self {
            gear,
            cell,
            own_limits_mm: flanks.geometry.flank_limits_mm(gear),
            mate_limits_mm: [cell.lower_mm, cell.upper_mm].map(|end| [along(mate.1, end), along(mate.0, end)]),
        }
    }

    /// The part of the cell, from and to in 0..1, during which the point at `coordinate_mm`, at `along_mm` from the cell's
    /// position, faces the mate: it moves past the mate's ends in a straight line.
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

/// The part of the way from `before` to `after` on which the straight course between them is not negative.
fn positive_stretch(before: f64, after: f64) -> (f64, f64) {
    match (before >= 0.0, after >= 0.0) {
        (true, true) => (0.0, 1.0),
        (false, true) => (before / (before - after), 1.0),
        (true, false) => (0.0, before / (before - after)),
        (false, false) => (0.0, 0.0),
    }
}
