//! A pressure that stands still in the tangent frame of its position, or on the tip edge that carries it, while flank points move through
//! it.
//!
//! While the contact stands for one loading position, a flank point moves along the tangent from where it is at the beginning of the
//! cell to where it is at its end, and feels the mean of the field ([`PressureField`]) over the part of that way on which it faces
//! the mate. The points feel the load of the field, however narrow it is and however far the positions are apart.

use std::ops::Range;

use super::flank_motion::{edge_under_load, on_tangent};
use super::observed_points::ObservedPoints;
use super::strip::Window;
use super::{Flanks, PointContact, PositionCell, Sweep, pressure_field::PressureField};
use crate::gear::{Gear, PerGear};

/// The field, and the points of both flanks that may feel it.
pub(crate) struct SweptField {
    /// Pressure along the tangent.
    pub field: PressureField,
    width_mm: f64,
    /// With the course of each point; none where nothing is collected.
    observed: Option<PerGear<(ObservedPoints, Courses)>>,
}

/// How far each point moves from the cell's position to both ends of its course, mm; none of points that face nothing.
type Courses = Vec<Option<[f64; 2]>>;

impl SweptField {
    /// A field of cells of `width_mm` over `window`, without pressure so far; with a `cell`, points are collected.
    pub(crate) fn new(flanks: Flanks<'_>, window: Window, width_mm: f64, cell: Option<PositionCell>) -> Self {
        // An edge moves to both sides of where it is, but where the cell lies to one side of its position, or the field goes with the edge.
        let both_ways =
            |cell: PositionCell| cell.goes_both_ways() && edge_under_load(&flanks.geometry, cell.position_mm).is_none();
        let observed = cell.map(|cell| {
            PerGear::from_fn(|gear| {
                let points = ObservedPoints::under_standing_pressure(flanks, gear, window, cell);
                let courses = points.courses_mm();
                (points, courses)
            })
        });
        let field = PressureField::new(window.lower_mm, width_mm, cell.is_some_and(both_ways));
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
            let mean = |course: [f64; 2]| self.field.mean_mpa(course.map(|by| on_tangent(gear, point.along_mm + by)));
            *pressure = course.map_or(0.0, mean);
        }
    }

    /// The contact of each point of that [`Sweep`].
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
                // One that stands is in contact all the time or not at all.
                contact_fraction: if high > low { inside.max(0.0) / (high - low) } else { f64::from(inside >= 0.0) },
            }
        })
        .collect()
    }

    /// The points of a flank that may touch: pressure goes half a cell beyond the cells in contact.
    fn touching(&self, gear: Gear, points: &ObservedPoints) -> Range<usize> {
        let (lower, upper) = self.field.extent_mm();
        let more = 2.0 * self.width_mm;
        match gear {
            Gear::Pinion => points.between(lower - more, upper + more),
            Gear::Wheel => points.between(-upper - more, more - lower),
        }
    }
}
