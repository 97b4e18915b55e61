//! A wear profile for every wear coefficient, from profiles at some of them.
//!
//! The coefficients are given as factors on that of the scene. Between two of them each point follows the cubic that takes
//! their values, with slopes of the parabolas through neighbouring values (Hermite); at the factor 0 nothing is worn.

/// Wear profiles at increasing factors on the wear coefficient, the first of them 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WearByCoefficient {
    factors: Vec<f64>,
    wear_um: Vec<Vec<f64>>,
}

impl WearByCoefficient {
    /// From profiles at increasing factors above 0, two at least.
    pub(super) fn new(profiles: impl IntoIterator<Item = (f64, Vec<f64>)>) -> Self {
        let (mut factors, mut wear_um): (Vec<f64>, Vec<Vec<f64>>) = profiles.into_iter().unzip();
        let points = wear_um.first().map_or(0, Vec::len);
        factors.insert(0, 0.0);
        wear_um.insert(0, vec![0.0; points]);
        Self { factors, wear_um }
    }

    /// The profile at a factor, at most the greatest.
    pub(super) fn at(&self, factor: f64) -> Vec<f64> {
        let last = self.factors.len() - 1;
        let after = self.factors.partition_point(|&f| f <= factor).clamp(1, last);
        let before = after - 1;
        let width = self.factors[after] - self.factors[before];
        let t = ((factor - self.factors[before]) / width).clamp(0.0, 1.0);
        // Hermite's cubics on 0 ≤ t ≤ 1.
        let (s, u) = (1.0 - t, t * t);
        let weights = [s * s * (1.0 + 2.0 * t), u * (3.0 - 2.0 * t), t * s * s * width, -u * s * width];
        let [one, other] = [before, after].map(|index| self.slope_weights(index));
        (0..self.wear_um[before].len())
            .map(|point| {
                let [slope, other_slope] =
                    [&one, &other].map(|rows| rows.iter().map(|&(i, w)| w * self.wear_um[i][point]).sum::<f64>());
                weights[0] * self.wear_um[before][point]
                    + weights[1] * self.wear_um[after][point]
                    + weights[2] * slope
                    + weights[3] * other_slope
            })
            .collect()
    }

    /// The slope at a profile as weights of the profiles around it: of the parabola through three of them, at an end that of the
    /// last two.
    fn slope_weights(&self, index: usize) -> Vec<(usize, f64)> {
        let f = &self.factors;
        let last = f.len() - 1;
        if index == 0 || index == last {
            return self.secant(index.min(last - 1), 1.0).to_vec();
        }
        let (left, right) = (f[index] - f[index - 1], f[index + 1] - f[index]);
        let [a, b] = [right, left].map(|width| width / (left + right));
        [self.secant(index - 1, a), self.secant(index, b)].concat()
    }

    /// `weight` times the slope of the straight line from profile `i` to the next, as weights of both.
    fn secant(&self, i: usize, weight: f64) -> [(usize, f64); 2] {
        let width = self.factors[i + 1] - self.factors[i];
        [(i, -weight / width), (i + 1, weight / width)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parabolas inside are exact, and the given profiles are met.
    #[test]
    fn ver_it_meets_its_profiles_and_parabolas_between_them() {
        fn parabola(f: f64) -> Vec<f64> {
            vec![3.0 * f - 0.5 * f * f, f]
        }
        let course = WearByCoefficient::new([0.3, 0.5, 1.1, 2.0].map(|f| (f, parabola(f))));
        assert_eq!((course.at(0.0), course.at(1.1)), (vec![0.0, 0.0], parabola(1.1)));
        for factor in [0.31, 0.4, 0.7, 1.0] {
            let found = course.at(factor);
            assert!(found.iter().zip(parabola(factor)).all(|(a, b)| (a - b).abs() < 1e-14), "{factor}: {found:?}");
        }
    }
}
