//! A pressure that stands still in the tangent frame of its position, or goes with the tip edge that carries it, while flank points move through
//! it.
//!
//! Within the cell of a loading position, a flank point moves along the tangent and feels the mean of the field ([`PressureField`]) over the part of
//! its course on which it faces the mate. The points together feel the load of the field, however narrow it is and however far the positions are apart.

use std::ops::Range;

use super::flank_motion::{PressureMotion, on_tangent};
use super::observed_points::ObservedPoints;
use super::strip::ContactWindow;
use super::weighted_rows::{RowsOfAnyLength, WeightedRows};
use super::{Flanks, PointContact, Sweep, pressure_field::PressureField};
use gearwear_bodies::gear::{Gear, PerGear};

/// A pressure field, and the points of both flanks that may feel it.
pub(crate) struct SweptField {
    /// Pressure along the tangent.
    pub field: PressureField,
    /// Points of both flanks; none where nothing is collected.
    observed: Option<PerGear<SweptPoints>>,
}

/// Consecutive points of a flank.
struct SweptPoints {
    first_point: usize,
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
        motion: PressureMotion,
        (field, cells): (&PressureField, usize),
    ) -> Self {
        let points = ObservedPoints::under_pressure(flanks, gear, window, motion);
        let along_mm: Vec<f64> = points.at[1..=points.sliding_mm.len()].iter().map(|point| point.along_mm).collect();
        let courses = points.courses_mm();
        let courses = along_mm.iter().zip(courses);
        let courses_mm: Vec<Option<[f64; 2]>> =
            courses.map(|(at, course)| course.map(|ends| ends.map(|by| on_tangent(gear, at + by)))).collect();
        let (mut means, mut beyond) = (RowsOfAnyLength::of_about(courses_mm.len()), Vec::new());
        let mut weights = Vec::new();
        for (k, course) in (0..).zip(&courses_mm) {
            weights.clear();
            let first = course.map_or(0, |ends_mm| field.mean_weights(cells, ends_mm, &mut weights));
            means.push(first, &weights);
            if course.is_some_and(|ends_mm| field.may_be_mirrored(cells, ends_mm)) {
                beyond.push(k);
            }
        }
        Self {
            first_point: points.first_point,
            sliding_mm: points.sliding_mm,
            courses_mm,
            means: means.packed(cells),
            beyond,
        }
    }
}

impl SweptField {
    /// A field of cells of `width_mm` over `window`, without pressure so far; with a `motion`, points are collected.
    pub(crate) fn new(
        flanks: Flanks<'_>,
        window: ContactWindow,
        width_mm: f64,
        motion: Option<PressureMotion>,
    ) -> Self {
        // An edge moves to both sides of its place unless the cell lies to one side of its position, or the field goes with the edge.
        let mirrored = motion.is_some_and(|motion| motion.cell.goes_both_ways() && !motion.is_on_edge());
        let field = PressureField::new(window.lower_mm, width_mm, mirrored);
        let cells = (window.length_mm() / width_mm).round() as usize;
        let observed = motion
            .map(|motion| PerGear::from_fn(|gear| SweptPoints::new(flanks, gear, window, motion, (&field, cells))));
        Self { field, observed }
    }

    /// Fills in pressure and sliding of the points of a flank.
    pub(crate) fn sweep(&self, gear: Gear, sweep: &mut Sweep) {
        let Some(observed) = &self.observed else { return sweep.begin(0, &[]) };
        let points = &observed[gear];
        let near = self.touching(points);
        sweep.begin(points.first_point + near.start, &points.sliding_mm[near.clone()]);
        sweep.pressure_mpa.fill(0.0);
        points.means.add_products(near.start, self.field.cells_mpa(), &mut sweep.pressure_mpa);
        for k in points.beyond.iter().map(|k| *k as usize).filter(|k| near.contains(k)) {
            let mean_mpa = points.courses_mm[k].map_or(0.0, |ends_mm| self.field.mean_mpa(ends_mm));
            sweep.pressure_mpa[k - near.start] = mean_mpa;
        }
    }

    /// Contact of each point of that [`Sweep`].
    pub(crate) fn contact_of_points(&self, gear: Gear) -> Vec<PointContact> {
        let Some(observed) = &self.observed else { return Vec::new() };
        let points = &observed[gear];
        let near = self.touching(points);
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

    /// Range of the points of a flank from the first to the last whose course meets a cell under pressure, and one more at either end.
    fn touching(&self, points: &SweptPoints) -> Range<usize> {
        let Some((first_cell, last_cell)) = self.field.pressed() else { return 0..0 };
        let meets = |first: &u32| {
            let first = *first as usize;
            first <= last_cell && first_cell < first + points.means.width()
        };
        let of_points = points.means.first();
        let Some(first) = of_points.iter().position(meets) else { return 0..0 };
        let last = of_points.iter().rposition(meets).unwrap_or(first);
        first.saturating_sub(1)..(last + 2).min(of_points.len())
    }
}
