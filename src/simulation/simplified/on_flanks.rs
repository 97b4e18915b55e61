//! What is known at the contacts of every slice, brought onto the points of the flanks.
//!
//! Along each slice contacts follow each other from A to E, each in the middle of its stretch of the path. Between two of them a quantity
//! runs straight if their stretches are equally long. Otherwise another slice comes or goes where they meet, and the quantity
//! jumps there. Before the first and after the last it runs on as between the two next to them, but not below zero. A point whose share of the flank reaches beyond A or E counts for the part of it that does not.

use crate::gear::{Gear, GearPair, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid};

/// A contact of a slice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
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

/// Stretches are equally long if they are within this part of the distance of their contacts.
const ALIKE: f64 = 1e-6;

impl Knot {
    /// The contact is in the middle of its stretch.
    fn half_length_mm(&self) -> f64 {
        self.upper_mm - self.position_mm
    }
}

/// The points of both flanks, in the order of the path.
pub struct FlankPoints {
    points: PerGear<Vec<Point>>,
}

impl FlankPoints {
    /// The points of `grid` that touch between A and E.
    pub fn new(pair: &GearPair, grid: PerGear<&FlankGrid>) -> Self {
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
    pub fn bring<const N: usize>(
        &self,
        gear: Gear,
        knots: &[Knot],
        values: &[[f64; N]],
        mut put: impl FnMut(usize, f64, [f64; N]),
    ) {
        let Some(last) = knots.len().checked_sub(1) else { return };
        let mut before = 0;
        for point in &self.points[gear] {
            while before < last && knots[before + 1].position_mm <= point.position_mm {
                before += 1;
            }
            // After the last contact as between the last two.
            let before = before.min(last.saturating_sub(1));
            let after = (before + 1).min(last);
            let (low, high) = (&knots[before], &knots[after]);
            let distance = high.position_mm - low.position_mm;
            let alike = (low.half_length_mm() - high.half_length_mm()).abs() <= ALIKE * distance;
            let weight = if distance <= 0.0 {
                0.0
            } else if alike {
                (point.position_mm - low.position_mm) / distance
            } else if point.position_mm < low.upper_mm {
                0.0
            } else {
                1.0
            };
            let (low, high) = (&values[before], &values[after]);
            put(point.index, point.part, std::array::from_fn(|k| (low[k] + weight * (high[k] - low[k])).max(0.0)));
        }
    }
}
