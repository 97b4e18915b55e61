//! What is known at the contacts of every slice, brought onto the points of the flanks.
//!
//! Along each slice contacts follow each other from A to E, each in the middle of its stretch of the path, for which its values are the
//! mean. Over the stretch a quantity runs straight through that mean, with the gentler of the slopes towards both neighbours, and none
//! where they disagree or one is missing,
//!
//! ```text
//! v(ξ) = v_j + minmod((v_j − v_{j−1})/(ξ_j − ξ_{j−1}), (v_{j+1} − v_j)/(ξ_{j+1} − ξ_j)) (ξ − ξ_j)
//! ```
//!
//! so that what all stretches have worn is kept, jumps where other slices come or go stay sharp, and nothing rises above its
//! neighbours. A point whose share of the flank reaches beyond A or E counts for the part of it that does not.
//!
//! Source: B. van Leer, *J. Comput. Phys.* 32 (1979) 101–136, for slopes that keep means and monotony.

use crate::gear::{Gear, GearPair, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid};

/// A contact of a slice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knot {
    /// Where its theoretical contact point is.
    pub position_mm: f64,
    /// Where its stretch of the path ends.
    pub upper_mm: f64,
    /// Where its values are kept: batch and lane.
    pub at: (usize, usize),
}

/// A point of a flank that wears.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    /// Its number.
    index: usize,
    /// Its position on the path, within A–E.
    position_mm: f64,
    /// Part of its share of the flank that lies within A–E.
    part: f64,
}

/// The slope of each value at each knot.
fn slopes<const N: usize>(knots: &[Knot], values: &[[f64; N]]) -> Vec<[f64; N]> {
    let minmod = |a: f64, b: f64| if a * b <= 0.0 { 0.0 } else { a.signum() * a.abs().min(b.abs()) };
    let mut slopes = vec![[0.0; N]; knots.len()];
    // Towards the knot before.
    let mut before = [0.0; N];
    for (j, (two, values)) in knots.windows(2).zip(values.windows(2)).enumerate() {
        let distance = two[1].position_mm - two[0].position_mm;
        let per_distance = if distance > 0.0 { 1.0 / distance } else { 0.0 };
        let after: [f64; N] = std::array::from_fn(|k| (values[1][k] - values[0][k]) * per_distance);
        slopes[j] = std::array::from_fn(|k| minmod(before[k], after[k]));
        before = after;
    }
    slopes
}

/// The points of both flanks, in the order of the path.
pub(crate) struct FlankPoints {
    points: PerGear<Vec<Point>>,
}

impl FlankPoints {
    /// The points of `grid` that touch between A and E.
    pub(crate) fn new(pair: &GearPair, grid: PerGear<&FlankGrid>) -> Self {
        let path = &pair.path;
        let points = PerGear::from_fn(|gear| {
            let rho = &grid[gear].coordinate_mm;
            let last = rho.len() - 1;
            let at = |rho: f64| pair.position_at_mm(gear, rho);
            let of_point = |index: usize| {
                let ends = [
                    at(rho[index].midpoint(rho[index.saturating_sub(1)])),
                    at(rho[index].midpoint(rho[(index + 1).min(last)])),
                ];
                let (begin, end) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                let within = end.min(path.end_mm) - begin.max(path.start_mm);
                let position_mm = at(rho[index]).clamp(path.start_mm, path.end_mm);
                (within > 0.0).then(|| Point { index, position_mm, part: within / (end - begin) })
            };
            let mut points: Vec<Point> = (0..=last).filter_map(of_point).collect();
            if gear == Gear::Wheel {
                points.reverse();
            }
            points
        });
        Self { points }
    }

    /// Brings `values` at the `knots` of a slice, in their order, onto the points of `gear`'s flank: `put` is given the number of a
    /// point, its part within A–E, and the values there.
    pub(crate) fn bring<const N: usize>(
        &self,
        gear: Gear,
        knots: &[Knot],
        values: &[[f64; N]],
        mut put: impl FnMut(usize, f64, [f64; N]),
    ) {
        let Some(last) = knots.len().checked_sub(1) else { return };
        let slopes = slopes(knots, values);
        let mut own = 0;
        for point in &self.points[gear] {
            while own < last && knots[own].upper_mm <= point.position_mm {
                own += 1;
            }
            let beyond = point.position_mm - knots[own].position_mm;
            put(point.index, point.part, std::array::from_fn(|k| values[own][k] + beyond * slopes[own][k]));
        }
    }
}
