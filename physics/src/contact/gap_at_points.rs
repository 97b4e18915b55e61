//! Gap at observed points, which changes while the contact passes them.

use super::Flanks;
use super::observed_points::ObservedPoints;
use super::strip::Interpolation;
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};

/// Part of its course by which the theoretical contact point may miss a point and still passes it: between two cells neither must lose it to
/// rounding errors.
const SLACK: f64 = 0.02;

/// Gap at observed points, and its change within the cell.
#[derive(Debug, Clone)]
pub(crate) struct GapAtPoints {
    geometric_gap_mm: Vec<f64>,
    mate: Interpolation,
    /// Change of the gap of each point within the cell.
    course: Vec<GapWhilePassing>,
    growth: Vec<Growth>,
}

/// Change of the gap of a point while the contact passes, by the geometry alone, as its wear moves with it: at `x` along the tangent from its place at
/// the cell's position, the gap has grown by slope · x + x²/(2R).
#[derive(Debug, Clone, Copy, PartialEq)]
struct GapWhilePassing {
    /// Lower end of the course on which the point faces the mate within the cell, mm.
    from_mm: f64,
    /// Upper end of that course, mm.
    to_mm: f64,
    slope: f64,
    /// 1/R, 1/mm.
    curvature: f64,
}

/// Figures of a [`GapWhilePassing`] for the usual cases: a point in contact over all of it, or nowhere.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Growth {
    /// Growth of the gap at both ends, mm.
    at_ends_mm: [f64; 2],
    /// Mean growth, mm.
    mean_mm: f64,
    /// Least growth, mm.
    least_mm: f64,
}

/// Gap of a point at the cell's position, and its course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FacedGap<'a> {
    /// Gap at the cell's position, mm.
    pub gap_mm: f64,
    growth: &'a Growth,
    course: &'a GapWhilePassing,
}

impl FacedGap<'_> {
    /// Greatest penetration on the course, for flanks that have approached each other by `approach_mm`; not positive
    /// where the point never touches.
    pub(crate) fn greatest_penetration_mm(&self, approach_mm: f64) -> f64 {
        if self.course.from_mm < self.course.to_mm { approach_mm - self.gap_mm - self.growth.least_mm } else { 0.0 }
    }

    /// Mean over the course of the positive part of the penetration, for flanks that have approached each other by
    /// `approach_mm`, and the fraction of the course on which it is positive.
    #[inline]
    pub(crate) fn mean_penetration(&self, approach_mm: f64) -> (f64, f64) {
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

impl GapWhilePassing {
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
    /// Gap at `points` at `position_mm`.
    pub(crate) fn new(flanks: Flanks<'_>, gear: Gear, points: &ObservedPoints, position_mm: f64) -> Self {
        let count = points.sliding_mm.len();
        let mut mate = Interpolation::new(flanks, gear.mate());
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
        let (course, growth): (Vec<GapWhilePassing>, Vec<Growth>) = shifts
            .iter()
            .enumerate()
            .map(|(k, [begin, end])| {
                let (from_mm, to_mm) = (begin.min(*end), begin.max(*end));
                let along = points.at[k + 1].along_mm;
                let slack = SLACK * (to_mm - from_mm);
                let passed = (from_mm - slack..=to_mm + slack).contains(&-along);
                // Slope of the parabola through the point and its neighbours.
                let [before, after] = [k, k + 1].map(|i| points.at[i + 1].along_mm - points.at[i].along_mm);
                let [below, above] = [(k, before), (k + 1, after)]
                    .map(|(i, length)| (geometric_gap_mm[i + 1] - geometric_gap_mm[i]) / length);
                let slope = (after * below + before * above) / (before + after);
                let by_differences = GapWhilePassing { from_mm, to_mm, slope, curvature };
                let growth = by_differences.growth();
                let dips = geometric_gap_mm[k + 1] + growth.least_mm < 0.0;
                if !(passed || dips) {
                    return (by_differences, growth);
                }
                // Conjugate flanks touch once the contact has come to the point, and never overlap: the bottom of the parabola is a gap of 0. Errors of
                // differences and of a constant curvature would be large against the narrow contact of a light load.
                let slope = (2.0 * geometric_gap_mm[k + 1].max(0.0) * curvature).sqrt().copysign(along);
                let course = GapWhilePassing { slope, ..by_differences };
                (course, course.growth())
            })
            .unzip();
        geometric_gap_mm.truncate(count + 1);
        geometric_gap_mm.remove(0);
        Self { geometric_gap_mm, mate, course, growth }
    }

    /// Gap at the points of flanks that have lost `removed_mm`.
    pub(crate) fn faced<'a>(
        &'a self,
        points: &ObservedPoints,
        gear: Gear,
        removed_mm: PerGear<&'a [f64]>,
    ) -> impl Iterator<Item = FacedGap<'a>> + 'a {
        let own = &removed_mm[gear][points.first_point..];
        let mate = self.mate.of(removed_mm[gear.mate()]);
        let gaps = self.geometric_gap_mm.iter().zip(own).zip(mate);
        let courses = self.growth.iter().zip(&self.course);
        gaps.zip(courses).map(|(((geometric, own), mate), (growth, course))| FacedGap {
            gap_mm: geometric + own + mate,
            growth,
            course,
        })
    }
}
