//! A pressure that stands still in the tangent frame of its position while flank points move through it.
//!
//! While the contact stands for one loading position, a flank point moves along the tangent from where it is at the beginning of the
//! cell to where it is at its end, and feels the mean of the field ([`PressureField`]) over the part of that way on which it faces
//! the mate. The points feel the load of the field, however narrow it is and however far the positions are apart.

use std::ops::Range;

use super::strip::{ObservedPoints, Window};
use super::{Felt, Flanks, PositionCell, Sweep, pressure_field::PressureField};
use crate::gear::{Gear, PerGear};

/// The field, and the points of both flanks that may feel it.
pub struct SweptField {
    /// Pressure along the tangent.
    pub field: PressureField,
    width_mm: f64,
    /// With how far each point moves to the ends of its course; none where nothing is collected.
    observed: Option<PerGear<(ObservedPoints, Vec<[f64; 2]>)>>,
}

impl SweptField {
    /// A field of cells of `width_mm` over `window`, without pressure so far; with a `cell`, points are collected.
    pub fn new(flanks: Flanks<'_>, window: Window, width_mm: f64, cell: Option<PositionCell>) -> Self {
        // A cell that an edge only moves away from during it lies to one side of its position.
        let two_sided = |cell: PositionCell| cell.lower_mm < cell.position_mm && cell.position_mm < cell.upper_mm;
        let observed = cell.map(|cell| {
            PerGear::from_fn(|gear| {
                let points = ObservedPoints::new(flanks, gear, window, cell);
                let shifts = points.shifts_to_ends_mm();
                (points, shifts)
            })
        });
        let field = PressureField::new(window.lower_mm, width_mm, cell.is_some_and(two_sided));
        Self { field, width_mm, observed }
    }

    /// Fills in what the points of a flank felt.
    pub fn sweep(&self, gear: Gear, sweep: &mut Sweep) {
        let Some(observed) = &self.observed else { return sweep.begin(0, &[]) };
        let (points, shifts) = &observed[gear];
        let near = self.touching(gear, points);
        sweep.begin(points.first_point + near.start, &points.sliding_mm[near.clone()]);
        let courses = points.at[1..][near.clone()].iter().zip(&shifts[near]);
        for (pressure, (point, shift)) in sweep.pressure_mpa.iter_mut().zip(courses) {
            // A point that faces nothing has no course.
            *pressure = if shift[0] == shift[1] {
                0.0
            } else {
                self.field.mean_mpa(shift.map(|shift| on_tangent(gear, point.along_mm + shift)))
            };
        }
    }

    /// What each point of that [`Sweep`] felt.
    pub fn felt(&self, gear: Gear) -> Vec<Felt> {
        let Some(observed) = &self.observed else { return Vec::new() };
        let (points, shifts) = &observed[gear];
        let near = self.touching(gear, points);
        let (lower, upper) = self.field.extent_mm();
        let courses = points.at[1..][near.clone()].iter().zip(&shifts[near]);
        courses
            .map(|(point, shift)| {
                let [low, high] = [shift[0].min(shift[1]), shift[0].max(shift[1])];
                if low == high {
                    return Felt::default();
                }
                let at = |shift: f64| on_tangent(gear, point.along_mm + shift);
                let inside = |shift: f64| at(shift).clamp(lower, upper);
                Felt {
                    pressure_mpa: self.field.greatest_mpa([at(low), at(high)]),
                    contact_fraction: (inside(high) - inside(low)).abs() / (high - low),
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

/// Place on the common tangent, towards the pinion's tip, of a place in a gear's own direction.
fn on_tangent(gear: Gear, along_mm: f64) -> f64 {
    match gear {
        Gear::Pinion => along_mm,
        Gear::Wheel => -along_mm,
    }
}
