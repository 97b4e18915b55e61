//! A pressure that stands still in the tangent frame of its position, or on the tip edge that carries it, while flank points move through
//! it.
//!
//! Within the cell of a loading position, a flank point moves along the tangent and feels the mean of the field ([`PressureField`]) over the part of
//! its course on which it faces the mate. The points together feel the load of the field, however narrow it is and however far the positions are apart.

use std::ops::Range;

use super::flank_motion::{edge_under_load, on_tangent};
use super::observed_points::ObservedPoints;
use super::strip::ContactWindow;
use super::weighted_rows::WeightedRows;
use super::{Flanks, PointContact, PositionCell, Sweep, pressure_field::PressureField};
use gearwear_bodies::gear::{Gear, PerGear};

/// A pressure field, and the points of both flanks that may feel it.
pub(crate) struct SweptField {
    /// Pressure along the tangent.
    pub field: PressureField,
    width_mm: f64,
    /// Points of both flanks; none where nothing is collected.
    observed: Option<PerGear<SweptPoints>>,
}

/// Consecutive points of a flank.
struct SweptPoints {
    first_point: usize,
    /// Places, in the gear's own direction of the tangent.
    along_mm: Vec<f64>,
    /// Distances that points move along the tangent from their places: the least of them (at most 0) and the greatest (at least 0).
    least_and_most_mm: [f64; 2],
    /// Sliding of each point while it faces the mate, mm.
    sliding_mm: Vec<f64>,
    /// Places along the tangent of both ends of the course of each point, mm; none for points that face nothing.
    courses_mm: Vec<Option<[f64; 2]>>,
    /// Weights of the cells in the mean pressure on each course, where the field is not mirrored.
    means: WeightedRows,
    /// Points whose course goes beyond an end of the field, where it may be mirrored, in rising order.
    beyond: Vec<u32>,
}

impl SweptPoints {
    /// Points under a `field` of so many cells.
    fn new(
        flanks: Flanks<'_>,
        gear: Gear,
        window: ContactWindow,
        cell: PositionCell,
        (field, cells): (&PressureField, usize),
    ) -> Self {
        let points = ObservedPoints::under_standing_pressure(flanks, gear, window, cell);
        let along_mm: Vec<f64> = points.at[1..=points.sliding_mm.len()].iter().map(|point| point.along_mm).collect();
        let courses = points.courses_mm();
        let courses = along_mm.iter().zip(courses);
        let courses_mm: Vec<Option<[f64; 2]>> =
            courses.map(|(at, course)| course.map(|ends| ends.map(|by| on_tangent(gear, at + by)))).collect();
        let (mut means, mut beyond) = (WeightedRows::default(), Vec::new());
        for (k, course) in (0..).zip(&courses_mm) {
            let (first, weights) = course.map_or((0, Vec::new()), |ends_mm| field.mean_weights(cells, ends_mm));
            means.push(first, weights);
            if course.is_some_and(|ends_mm| field.may_be_mirrored(cells, ends_mm)) {
                beyond.push(k);
            }
        }
        means.shrink();
        Self {
            first_point: points.first_point,
            least_and_most_mm: points.least_and_most_mm(),
            sliding_mm: points.sliding_mm,
            along_mm,
            courses_mm,
            means,
            beyond,
        }
    }
}

impl SweptField {
    /// A field of cells of `width_mm` over `window`, without pressure so far; with a `cell`, points are collected.
    pub(crate) fn new(flanks: Flanks<'_>, window: ContactWindow, width_mm: f64, cell: Option<PositionCell>) -> Self {
        // An edge moves to both sides of its place unless the cell lies to one side of its position, or the field goes with the edge.
        let mirrored = cell
            .is_some_and(|cell| cell.goes_both_ways() && edge_under_load(&flanks.geometry, cell.position_mm).is_none());
        let field = PressureField::new(window.lower_mm, width_mm, mirrored);
        let cells = (window.length_mm() / width_mm).round() as usize;
        let observed =
            cell.map(|cell| PerGear::from_fn(|gear| SweptPoints::new(flanks, gear, window, cell, (&field, cells))));
        Self { field, width_mm, observed }
    }

    /// Fills in pressure and sliding of the points of a flank.
    pub(crate) fn sweep(&self, gear: Gear, sweep: &mut Sweep) {
        let Some(observed) = &self.observed else { return sweep.begin(0, &[]) };
        let points = &observed[gear];
        let near = self.touching(gear, points);
        sweep.begin(points.first_point + near.start, &points.sliding_mm[near.clone()]);
        let means_mpa = points.means.times_from(near.start, self.field.cells_mpa());
        sweep.pressure_mpa.iter_mut().zip(means_mpa).for_each(|(pressure, mean_mpa)| *pressure = mean_mpa);
        for k in points.beyond.iter().map(|k| *k as usize).filter(|k| near.contains(k)) {
            let mean_mpa = points.courses_mm[k].map_or(0.0, |ends_mm| self.field.mean_mpa(ends_mm));
            sweep.pressure_mpa[k - near.start] = mean_mpa;
        }
    }

    /// Contact of each point of that [`Sweep`].
    pub(crate) fn contact_of_points(&self, gear: Gear) -> Vec<PointContact> {
        let Some(observed) = &self.observed else { return Vec::new() };
        let points = &observed[gear];
        let near = self.touching(gear, points);
        let (lower, upper) = self.field.extent_mm();
        let courses_mm = points.courses_mm[near].iter();
        let contacts = courses_mm.map(|course| {
            let Some([begin, end]) = *course else { return PointContact::default() };
            let (low, high) = (begin.min(end), begin.max(end));
            let inside = high.min(upper) - low.max(lower);
            PointContact {
                pressure_mpa: self.field.greatest_mpa([low, high]),
                // A point that stands still is in contact all the time or not at all.
                contact_fraction: if high > low { inside.max(0.0) / (high - low) } else { f64::from(inside >= 0.0) },
            }
        });
        contacts.collect()
    }

    /// Range of the points of a flank that may touch, and one more at either end: pressure goes half a cell beyond the cells in contact.
    fn touching(&self, gear: Gear, points: &SweptPoints) -> Range<usize> {
        let (lower, upper) = self.field.extent_mm();
        let more = 2.0 * self.width_mm;
        let (lower, upper) = match gear {
            Gear::Pinion => (lower - more, upper + more),
            Gear::Wheel => (-upper - more, more - lower),
        };
        let [least, most] = points.least_and_most_mm;
        let [below, within] =
            [lower - most, upper - least].map(|end_mm| points.along_mm.partition_point(|&along_mm| along_mm < end_mm));
        let first = below.saturating_sub(1);
        let end = (within + 1).min(points.along_mm.len());
        first.min(end)..end
    }
}
