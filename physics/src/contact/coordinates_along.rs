//! Coordinates of a flank at places between samples of it.
//!
//! The coordinate ρ at the place x along the tangent is the inverse of an involute, which is an iteration; with r_b the base radius and ρ_c the
//! coordinate at the theoretical contact point it is close to
//!
//! ```text
//! ρ = √(ρ_c² + 2 r_b x)
//! ```
//!
//! so that away from the base circle a cubic through four samples a hundredth of a millimetre apart is as good as exact.

/// Samples of a cubic that interpolates a coordinate.
const CUBIC: usize = 4;
/// Greatest change of a coordinate over the samples of a cubic, in parts of itself: the cubic is then exact to some 1e-9 of it.
const SMOOTH: f64 = 0.02;

/// Coordinates of a flank along the tangent, by cubics through samples of them.
pub(super) struct CoordinatesAlong<'a> {
    along_mm: &'a [f64],
    /// The cubic through each sample and the three after it, by Newton's divided differences; none next to the base circle, where the coordinate is no
    /// polynomial.
    cubics: Vec<Option<[f64; CUBIC]>>,
}

impl<'a> CoordinatesAlong<'a> {
    /// Cubics through samples at rising places.
    pub(super) fn new(along_mm: &'a [f64], coordinates_mm: &[f64]) -> Self {
        let cubics = along_mm.windows(CUBIC).zip(coordinates_mm.windows(CUBIC)).map(|(x, y)| {
            let least = y[0].abs().min(y[CUBIC - 1].abs());
            ((y[CUBIC - 1] - y[0]).abs() <= SMOOTH * least).then(|| divided_differences(x, y))
        });
        Self { along_mm, cubics: cubics.collect() }
    }

    /// Coordinate at a place; `None` beyond the samples, or without a cubic.
    pub(super) fn at(&self, at_mm: f64) -> Option<f64> {
        let (along_mm, last) = (self.along_mm, self.along_mm.len() - 1);
        if !(along_mm[0]..=along_mm[last]).contains(&at_mm) {
            return None;
        }
        // Samples are evenly spaced but for a few.
        let even = (at_mm - along_mm[0]) / (along_mm[last] - along_mm[0]) * last as f64;
        let mut before = (even as usize).min(last);
        while along_mm[before] > at_mm {
            before -= 1;
        }
        while before < last && along_mm[before + 1] < at_mm {
            before += 1;
        }
        let first = before.saturating_sub(1).min(self.cubics.len().checked_sub(1)?);
        let [value, slope, second, third] = self.cubics[first]?;
        let from = |k: usize| at_mm - along_mm[first + k];
        Some(value + from(0) * (slope + from(1) * (second + from(2) * third)))
    }
}

/// Newton's divided differences of values `y` at the places `x`.
fn divided_differences(x: &[f64], y: &[f64]) -> [f64; CUBIC] {
    let mut differences: [f64; CUBIC] = std::array::from_fn(|k| y[k]);
    for order in 1..CUBIC {
        for k in (order..CUBIC).rev() {
            differences[k] = (differences[k] - differences[k - 1]) / (x[k] - x[k - order]);
        }
    }
    differences
}

#[cfg(test)]
mod tests {
    use super::super::flank_motion::on_tangent;
    use super::super::strip::{common_extent_mm, tests::pair_of};
    use super::*;
    use gearwear_bodies::gear::{Gear, conjugate::ConjugateFlanks};

    /// Coordinates between samples are those of the involute; next to the base circle of an undercut wheel there is no cubic.
    #[test]
    fn ver_coordinates_between_samples_are_those_of_the_involute() {
        let pair = pair_of(5.407, 127.4, [(37, 0.02266), (10, 0.0)]);
        let (mut greatest, mut without) = (0.0_f64, 0);
        for k in 0..=20 {
            let position_mm = pair.path.start_mm + (pair.path.end_mm - pair.path.start_mm) * f64::from(k) / 20.0;
            let ((lowest_mm, highest_mm), _) = common_extent_mm(&pair, position_mm);
            let [from_mm, to_mm] = [lowest_mm.max(-0.3), highest_mm.min(0.3)];
            let along_mm: Vec<f64> = (0..=60).map(|i| from_mm + (to_mm - from_mm) * f64::from(i) / 60.0).collect();
            for gear in Gear::BOTH {
                let exact_mm = |along_mm: f64| pair.at_along(gear, on_tangent(gear, along_mm), position_mm).0;
                let coordinates_mm: Vec<f64> = along_mm.iter().map(|along_mm| exact_mm(*along_mm)).collect();
                let between = CoordinatesAlong::new(&along_mm, &coordinates_mm);
                for i in 0..=333 {
                    let at_mm = from_mm + (to_mm - from_mm) * f64::from(i) / 333.0;
                    match between.at(at_mm) {
                        Some(found_mm) => greatest = greatest.max((found_mm - exact_mm(at_mm)).abs()),
                        None => without += 1,
                    }
                }
                assert_eq!([between.at(from_mm - 1e-9), between.at(to_mm + 1e-9)], [None; 2]);
            }
        }
        assert!(greatest < 1e-8, "{greatest}");
        // None of the pinion's, and not all of the wheel's.
        assert!((1..21 * 334).contains(&without), "{without}");
    }
}
