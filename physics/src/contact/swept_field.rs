//! A pressure that stands still in the tangent frame of its position, or goes with the tip edge that carries it, while flank points move through
//! it.
//!
//! Within the cell of a loading position, a flank point moves along the tangent and feels the mean of the field ([`PressureField`]) over the part of
//! its course on which it faces the mate. The points together feel the load of the field, however narrow it is and however far the positions are apart.

use std::ops::Range;

use super::flank_motion::PressureMotion;
use super::observed_points::{Course, ObservedPoints};
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
    means: WeightedRows<f32>,
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
        let courses = points.courses(gear, &motion);
        let (mut means, mut beyond) = (RowsOfAnyLength::of_about(courses.len()), Vec::new());
        let mut of_courses = CourseMeans { field, cells, weights: Vec::new(), sums: vec![0.0; cells] };
        for (k, course) in (0..).zip(&courses) {
            let (first, weights) = course.as_ref().map_or((0, &[][..]), |course| of_courses.of(course));
            means.push(first, weights);
            if course.is_some_and(|course| field.may_be_mirrored(cells, course.ends_mm)) {
                beyond.push(k);
            }
        }
        let courses_mm = courses.iter().map(|course| course.map(|course| course.ends_mm)).collect();
        Self {
            first_point: points.first_point,
            sliding_mm: points.sliding_mm,
            courses_mm,
            means: means.packed(cells),
            beyond,
        }
    }
}

/// Weights of the pressures of cells in mean pressures on courses.
struct CourseMeans<'f> {
    field: &'f PressureField,
    cells: usize,
    weights: Vec<f64>,
    /// All 0 again after every course.
    sums: Vec<f64>,
}

impl CourseMeans<'_> {
    /// First cell with a weight in the mean on a `course`, and the weights from it on.
    fn of(&mut self, course: &Course) -> (usize, &[f64]) {
        let Self { field, cells, weights, sums } = self;
        let Some(parts) = course.parts else {
            let first = field.mean_weights(*cells, course.ends_mm, weights);
            return (first, weights);
        };
        let (mut begin, mut end) = (sums.len(), 0);
        for part in parts {
            let first = field.mean_weights(*cells, part.ends_mm, weights);
            let sums = sums[first..].iter_mut().zip(&*weights);
            sums.for_each(|(sum, weight)| *sum += part.weight * weight);
            (begin, end) = (begin.min(first), end.max(first + weights.len()));
        }
        weights.clear();
        weights.extend_from_slice(&sums[begin..end]);
        sums[begin..end].fill(0.0);
        (begin, weights)
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

#[cfg(test)]
mod tests {
    use super::super::PositionCell;
    use super::super::strip::tests::pair_of;
    use super::*;
    use gearwear_bodies::gear::conjugate::ConjugateFlanks;
    use gearwear_bodies::gear::flank::{FlankGrid, PointSpacing};

    /// The points of both flanks together carry the load of an ellipse that a tip edge cuts off within 1 %, where positions are 1.4 half-widths apart.
    #[test]
    fn ver_points_carry_the_load_beside_a_tip_edge() {
        let pair = pair_of(4.5, 91.5, [(16, 0.1817), (24, 0.1715)]);
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 3000, PointSpacing::Graded));
        let flanks = Flanks::of_gears(&pair, grid.as_ref());
        let half_width_mm = 0.13;
        let [start_mm, end_mm] = [pair.path.start_mm, pair.path.end_mm];
        let mut off = Vec::new();
        for position_mm in [start_mm + 0.1, start_mm + 0.25, end_mm - 0.25, end_mm - 0.1] {
            let cell = PositionCell { position_mm, lower_mm: position_mm - 0.09, upper_mm: position_mm + 0.09 };
            let window = ContactWindow::new(flanks, position_mm, 1.2 * half_width_mm);
            let cells = 100;
            let width_mm = window.length_mm() / f64::from(cells);
            let motion = PressureMotion::new(flanks, cell, half_width_mm);
            assert!(motion.is_stretched(), "{position_mm}");
            let mut swept = SweptField::new(flanks, window, width_mm, Some(motion));
            let middles_mm = (0..cells).map(|k| window.lower_mm + (f64::from(k) + 0.5) * width_mm);
            let ellipse = middles_mm.map(|x_mm| (1.0 - (x_mm / half_width_mm).powi(2)).max(0.0).sqrt());
            let pressure: Vec<f64> = ellipse.collect();
            let load = width_mm * pressure.iter().sum::<f64>();
            swept.field.fill(|cells| cells.extend_from_slice(&pressure));
            for gear in Gear::BOTH {
                let mut sweep = Sweep::default();
                swept.sweep(gear, &mut sweep);
                let points = sweep.pressure_mpa.iter().zip(&sweep.sliding_mm).zip(sweep.first_point..);
                let worn: f64 = points.map(|((p, slid), i)| p * slid * grid[gear].share_mm(i)).sum();
                let sliding_mm = flanks.geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
                off.push(worn / (load * sliding_mm) - 1.0);
            }
        }
        assert!(off.iter().all(|off| off.abs() < 1e-2), "{off:?}");
    }
}
