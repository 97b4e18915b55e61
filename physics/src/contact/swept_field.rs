//! A pressure that stands still in the tangent frame of its position, or on the tip edge that carries it, while flank points move through
//! it.
//!
//! Within the cell of a loading position, a flank point moves along the tangent and feels the mean of the field ([`PressureField`]) over the part of
//! its course on which it faces the mate. The points together feel the load of the field, however narrow it is and however far the positions are apart.

use std::ops::Range;

use super::flank_motion::{edge_under_load, on_tangent};
use super::observed_points::ObservedPoints;
use super::strip::ContactWindow;
use super::{Flanks, PointContact, PositionCell, Sweep, pressure_field::PressureField};
use gearwear_bodies::gear::{Gear, PerGear};

/// A pressure field, and the points of both flanks that may feel it.
pub(crate) struct SweptField {
    /// Pressure along the tangent.
    pub field: PressureField,
    width_mm: f64,
    /// Points of both flanks with their courses; none where nothing is collected.
    observed: Option<PerGear<(ObservedPoints, Courses)>>,
}

/// Distances of each point from the cell's position to both ends of its course, mm; none for points that face nothing.
type Courses = Vec<Option<[f64; 2]>>;

impl SweptField {
    /// A field of cells of `width_mm` over `window`, without pressure so far; with a `cell`, points are collected.
    pub(crate) fn new(flanks: Flanks<'_>, window: ContactWindow, width_mm: f64, cell: Option<PositionCell>) -> Self {
        // An edge moves to both sides of its place unless the cell lies to one side of its position, or the field goes with the edge.
        let mirrored = cell
            .is_some_and(|cell| cell.goes_both_ways() && edge_under_load(&flanks.geometry, cell.position_mm).is_none());
        let observed = cell.map(|cell| {
            PerGear::from_fn(|gear| {
                let points = ObservedPoints::under_standing_pressure(flanks, gear, window, cell);
                let courses = points.courses_mm();
                (points, courses)
            })
        });
        let field = PressureField::new(window.lower_mm, width_mm, mirrored);
        Self { field, width_mm, observed }
    }

    /// Fills in pressure and sliding of the points of a flank.
    pub(crate) fn sweep(&self, gear: Gear, sweep: &mut Sweep) {
        let Some(observed) = &self.observed else { return sweep.begin(0, &[]) };
        let (points, courses) = &observed[gear];
        let near = self.touching(gear, points);
        sweep.begin(points.first_point + near.start, &points.sliding_mm[near.clone()]);
        let near = points.at[1..][near.clone()].iter().zip(&courses[near]);
        for (pressure, (point, course)) in sweep.pressure_mpa.iter_mut().zip(near) {
            *pressure =
                course.map_or(0.0, |ends| self.field.mean_mpa(ends.map(|by| on_tangent(gear, point.along_mm + by))));
        }
    }

    /// Contact of each point of that [`Sweep`].
    pub(crate) fn contact_of_points(&self, gear: Gear) -> Vec<PointContact> {
        let Some(observed) = &self.observed else { return Vec::new() };
        let (points, courses) = &observed[gear];
        let near = self.touching(gear, points);
        let (lower, upper) = self.field.extent_mm();
        let near = points.at[1..][near.clone()].iter().zip(&courses[near]);
        near.map(|(point, course)| {
            let Some([begin, end]) = course.map(|course| course.map(|by| on_tangent(gear, point.along_mm + by))) else {
                return PointContact::default();
            };
            let (low, high) = (begin.min(end), begin.max(end));
            let inside = high.min(upper) - low.max(lower);
            PointContact {
                pressure_mpa: self.field.greatest_mpa([low, high]),
                // A point that stands still is in contact all the time or not at all.
                contact_fraction: if high > low { inside.max(0.0) / (high - low) } else { f64::from(inside >= 0.0) },
            }
        })
        .collect()
    }

    /// Range of the points of a flank that may touch: pressure goes half a cell beyond the cells in contact.
    fn touching(&self, gear: Gear, points: &ObservedPoints) -> Range<usize> {
        let (lower, upper) = self.field.extent_mm();
        let more = 2.0 * self.width_mm;
        match gear {
            Gear::Pinion => points.between(lower - more, upper + more),
            Gear::Wheel => points.between(-upper - more, more - lower),
        }
    }
}
