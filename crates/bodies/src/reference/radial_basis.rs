//! Interpolation of scattered values by cubic radial basis functions with a linear tail, of several quantities at once.
//!
//! Through the values y_i at the points x_i of ℝᵈ, of which at least d + 1 are not in one plane,
//!
//! ```text
//! s(x) = Σ λ_i |x − x_i|³ + c_0 + c · x          Σ λ_i = 0,  Σ λ_i x_i = 0
//! ```
//!
//! is the interpolant that bends least among those of its kind. With Φ_ij = |x_i − x_j|³ and P_i = (1, x_i) the weights solve
//!
//! ```text
//! ⎡ Φ + ρ I   P ⎤ ⎡ λ ⎤   ⎡ y ⎤
//! ⎣ Pᵀ        0 ⎦ ⎣ c ⎦ = ⎣ 0 ⎦
//! ```
//!
//! where a small ρ smooths the noise of values that are computed. Between the points s may pass the values; it is no bound.
//!
//! Source: M. J. D. Powell, *The theory of radial basis function approximation in 1990*, in Advances in Numerical Analysis II (1992)
//! 105–210; H.-M. Gutmann, *A radial basis function method for global optimization*, Journal of Global Optimization 19 (2001) 201–227.

use nalgebra::DMatrix;

/// Interpolant of several quantities with the same points.
#[derive(Debug, Clone, PartialEq)]
pub struct RadialBasis {
    points: Vec<Vec<f64>>,
    /// Weights λ of each point, one for each quantity; then c_0 and the c of each direction.
    weights: Vec<Vec<f64>>,
}

impl RadialBasis {
    /// Interpolant of `values`, which has one row of quantities for each of `points`, smoothed by ρ; `None` where the points do not determine it.
    pub fn through(points: &[Vec<f64>], values: &[Vec<f64>], smoothing: f64) -> Option<Self> {
        let (count, quantities) = (points.len(), values.first()?.len());
        let directions = points.first()?.len();
        let size = count + directions + 1;
        let mut matrix = DMatrix::zeros(size, size);
        let mut right = DMatrix::zeros(size, quantities);
        for i in 0..count {
            for j in 0..i {
                let cube = cubed_distance(&points[i], &points[j]);
                matrix[(i, j)] = cube;
                matrix[(j, i)] = cube;
            }
            matrix[(i, i)] = smoothing;
            let tail = [1.0].into_iter().chain(points[i].iter().copied());
            for (k, value) in tail.enumerate() {
                matrix[(i, count + k)] = value;
                matrix[(count + k, i)] = value;
            }
            for (quantity, value) in values[i].iter().enumerate() {
                right[(i, quantity)] = *value;
            }
        }
        let solved = matrix.lu().solve(&right)?;
        let weights: Vec<Vec<f64>> = solved.row_iter().map(|row| row.iter().copied().collect()).collect();
        let are_finite = weights.iter().flatten().all(|weight| weight.is_finite());
        are_finite.then(|| Self { points: points.to_vec(), weights })
    }

    /// The quantities at `x`.
    pub fn at(&self, x: &[f64]) -> Vec<f64> {
        let mut sums = self.weights[self.points.len()].clone();
        let (of_points, of_tail) = self.weights.split_at(self.points.len());
        for (weight, value) in of_tail[1..].iter().zip(x) {
            add(&mut sums, weight, *value);
        }
        for (weight, point) in of_points.iter().zip(&self.points) {
            add(&mut sums, weight, cubed_distance(point, x));
        }
        sums
    }
}

fn add(sums: &mut [f64], weights: &[f64], times: f64) {
    sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * times);
}

/// |a − b|³.
fn cubed_distance(a: &[f64], b: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    square * square.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a low-discrepancy sequence, which are in no plane.
    fn points(count: usize) -> Vec<Vec<f64>> {
        let steps = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];
        (1..=count).map(|i| steps.iter().map(|step| (0.5 + i as f64 * step).fract()).collect()).collect()
    }

    /// Linear functions are met everywhere, others at the points.
    #[test]
    fn ver_linear_functions_are_reproduced() {
        let points = points(12);
        let of = |x: &[f64]| vec![2.0 - x[0] + 3.0 * x[1], (5.0 * x[0]).sin() * x[1]];
        let values: Vec<Vec<f64>> = points.iter().map(|x| of(x)).collect();
        let found = RadialBasis::through(&points, &values, 0.0).unwrap();
        for x in [[0.1, 0.9], [0.7, 0.2]] {
            assert!((found.at(&x)[0] - of(&x)[0]).abs() < 1e-12);
        }
        for (x, y) in points.iter().zip(&values) {
            assert!((found.at(x)[1] - y[1]).abs() < 1e-12);
        }
    }

    /// Between the points the error falls faster than with the square of their distance: 16 times the points, a quarter of the distance.
    #[test]
    fn ver_a_smooth_function_is_approached() {
        let of = |x: &[f64]| vec![(3.0 * x[0]).sin() + x[0] * x[1] * x[1]];
        let error = |count: usize| {
            let points = points(count);
            let values: Vec<Vec<f64>> = points.iter().map(|x| of(x)).collect();
            let found = RadialBasis::through(&points, &values, 0.0).unwrap();
            let places = (1..10).flat_map(|i| (1..10).map(move |j| [0.1 * f64::from(i), 0.1 * f64::from(j)]));
            places.map(|x| (found.at(&x)[0] - of(&x)[0]).abs()).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(16), error(256));
        assert!(fine < coarse / 16.0, "{coarse} {fine}");
    }

    #[test]
    fn too_few_points_determine_nothing() {
        let points = vec![vec![0.0, 0.0], vec![1.0, 1.0], vec![0.5, 0.5]];
        assert_eq!(RadialBasis::through(&points, &[vec![1.0], vec![2.0], vec![3.0]], 0.0), None);
        assert_eq!(RadialBasis::through(&[], &[], 0.0), None);
    }
}
