//! Interpolation from the contacts of every slice to the points of the flanks.
//!
//! Along each slice contacts follow each other from A to E, each in the middle of its stretch of the path, for which its values are the
//! mean. From the middle of a stretch of length h_j a quantity is linear to the mean of both stretches at their common end,
//!
//! ```text
//! v(ξ) = (1 − t) v_j + t v_n        t = 2 |ξ − ξ_j|/h_j · h_n/(h_j + h_n)
//! ```
//!
//! unless slices come or go between both: there, and up to A and E, each stretch keeps its value, and the jump stays sharp. No weight is
//! negative and none depends on the values: wear of a contact adds to that of the points around it in any order, no point rises above its
//! neighbours, and the wear of all stretches together is kept. A point whose share of the flank reaches beyond
//! A or E counts with the part within.

use gearwear_bodies::gear::{Gear, GearPair, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid};

/// A contact of a slice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knot {
    /// Theoretical contact point.
    pub position_mm: f64,
    /// End of its stretch of the path.
    pub upper_mm: f64,
    /// Whether slices come or go at that end.
    pub jumps: bool,
    /// Batch and lane of its values.
    pub at: (usize, usize),
}

impl Knot {
    /// h: length of the stretch, with the contact in its middle.
    fn length_mm(&self) -> f64 {
        2.0 * (self.upper_mm - self.position_mm)
    }
}

/// A point of a flank that wears.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PointOnPath {
    /// Index on the flank.
    index: usize,
    /// Position on the path, within A–E.
    position_mm: f64,
    /// Part of the point's share of the flank that lies within A–E.
    part: f64,
}

/// The points of both flanks, in the order of the path.
pub(crate) struct FlankPoints {
    points: PerGear<Vec<PointOnPath>>,
}

impl FlankPoints {
    /// The points of `grid` that touch between A and E.
    pub(crate) fn new(pair: &GearPair, grid: PerGear<&FlankGrid>) -> Self {
        let path = &pair.path;
        let points = PerGear::from_fn(|gear| {
            let rho = &grid[gear].coordinate_mm;
            let last = rho.len() - 1;
            let of_points = (0..=last).filter_map(|index| {
                let [low, own, high] = [
                    rho[index].midpoint(rho[index.saturating_sub(1)]),
                    rho[index],
                    rho[index].midpoint(rho[(index + 1).min(last)]),
                ]
                .map(|rho| pair.position_at_mm(gear, rho));
                let (begin, end) = (low.min(high), low.max(high));
                let within = end.min(path.end_mm) - begin.max(path.start_mm);
                let position_mm = own.clamp(path.start_mm, path.end_mm);
                (within > 0.0).then(|| PointOnPath { index, position_mm, part: within / (end - begin) })
            });
            let mut points: Vec<PointOnPath> = of_points.collect();
            if gear == Gear::Wheel {
                points.reverse();
            }
            points
        });
        Self { points }
    }

    /// Interpolates `values` at the `knots` of a slice, in order, to the points of `gear`'s flank: `put` gets the index of a
    /// point, its part within A–E, and the values there.
    pub(crate) fn bring<const N: usize>(
        &self,
        gear: Gear,
        knots: &[Knot],
        values: &[[f64; N]],
        mut put: impl FnMut(usize, f64, [f64; N]),
    ) {
        let Some(last) = knots.len().checked_sub(1) else { return };
        let mut own = 0;
        for point in &self.points[gear] {
            while own < last && knots[own].upper_mm <= point.position_mm {
                own += 1;
            }
            let beyond = point.position_mm - knots[own].position_mm;
            let neighbour = if beyond > 0.0 { own + 1 } else { own.saturating_sub(1) };
            let neighbour = if neighbour > last || knots[own.min(neighbour)].jumps { own } else { neighbour };
            let [h_j, h_n] = [own, neighbour].map(|knot| knots[knot].length_mm());
            let t = if neighbour == own { 0.0 } else { 2.0 * beyond.abs() / h_j * h_n / (h_j + h_n) };
            // A sum of such products grows with its values also under rounding.
            let at_point = std::array::from_fn(|k| (1.0 - t) * values[own][k] + t * values[neighbour][k]);
            put(point.index, point.part, at_point);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values at points of the pinion's flank 0.25 mm apart, of stretches of 1, 1, 2 and 1 mm, the last of which begins with a jump.
    fn at_points(values: [f64; 4]) -> Vec<f64> {
        let stretches = [(0.5, 1.0), (1.5, 2.0), (3.0, 4.0), (4.5, 5.0)];
        let stretches = stretches.into_iter().enumerate();
        let knots: Vec<Knot> = stretches
            .map(|(k, (position_mm, upper_mm))| Knot { position_mm, upper_mm, jumps: k == 2, at: (0, k) })
            .collect();
        let pinion =
            (0..20).map(|index| PointOnPath { index, position_mm: 0.25 * index as f64 + 0.125, part: 1.0 }).collect();
        let points = FlankPoints { points: PerGear { pinion, wheel: Vec::new() } };
        let mut found = vec![0.0; 20];
        points.bring(Gear::Pinion, &knots, &values.map(|value| [value]), |index, part, [value]| {
            found[index] = part * value
        });
        found
    }

    /// Linear between the middles of stretches, constant at the ends of the path and at a jump; the sum over stretches is kept.
    #[test]
    fn ver_straight_between_contacts_and_sharp_at_jumps() {
        let found = at_points([1.0, 2.0, 4.0, 9.0]);
        assert_eq!(
            (&found[..3], &found[12..]),
            (&[1.0, 1.0, 1.125][..], &[4.0, 4.0, 4.0, 4.0, 9.0, 9.0, 9.0, 9.0][..])
        );
        assert!((0.25 * found.iter().sum::<f64>() - (1.0 + 2.0 + 2.0 * 4.0 + 9.0)).abs() < 1e-14);
    }

    /// Further wear makes no point less deep, whatever its course, and wear adds up.
    #[test]
    fn ver_wear_never_becomes_less_at_a_point() {
        let (early, more) = ([0.0, 1.0, 1.0, 4.0], [0.3, 0.0, 1.0, 0.0]);
        let late = std::array::from_fn(|k| early[k] + more[k]);
        let (early, more, late) = (at_points(early), at_points(more), at_points(late));
        assert!(early.iter().zip(&late).all(|(early, late)| early <= late));
        assert!(
            late.iter().zip(early.iter().zip(more)).all(|(late, (early, more))| (late - early - more).abs() < 1e-15)
        );
    }
}
