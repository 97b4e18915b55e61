//! Sobol indices of any function's values over Saltelli's samples, with intervals.
//!
//! ```text
//! S_i  = Σ_j f(B_j) [f(AB_j^i) − f(A_j)] / (N V)          first order: the part of the variance V that factor i explains alone
//! ST_i = Σ_j [f(A_j) − f(AB_j^i)]² / (2 N V)              total: with all its interactions
//! V    = variance of f(A) and f(B) together
//! ```
//!
//! The mean is taken off f before: it changes no index and takes most of the scatter of S_i away. Intervals hold 95 % of the indices of
//! samples drawn with replacement from the N points (bootstrap, seeded). Points of a Sobol sequence are more even than random ones, so
//! the intervals are rather too wide.
//!
//! Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259–270, table 2 (b) and (f), the latter after M. J. W. Jansen.

use serde::Serialize;

use super::statistics::{mean, quantile};

/// Samples drawn with replacement.
const RESAMPLES: usize = 500;
/// A spread of this part of the greatest value is round-off.
const ROUND_OFF: f64 = 1e-12;

/// An index with the interval that holds it with 95 %.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Index {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// One index a factor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Indices {
    pub first: Vec<Index>,
    pub total: Vec<Index>,
}

/// The indices of the values `a` and `b` of both samples and `mixed` of each factor; none where the values do not vary.
pub(crate) fn indices(a: &[f64], b: &[f64], mixed: &[Vec<f64>], seed: u64) -> Option<Indices> {
    let count = a.len();
    let all = || a.iter().chain(b).copied();
    let middle = mean(all());
    let greatest = all().map(f64::abs).fold(0.0, f64::max);
    if count < 2 || !all().any(|value| (value - middle).abs() > ROUND_OFF * greatest) {
        return None;
    }
    // Row j: f_A, f_B, f_B (f_AB − f_A) and (f_A − f_AB)²/2 of each factor.
    let width = 2 + 2 * mixed.len();
    let mut rows = Vec::with_capacity(count * width);
    for j in 0..count {
        let (f_a, f_b) = (a[j] - middle, b[j] - middle);
        rows.extend([f_a, f_b]);
        for factor in mixed {
            let f_ab = factor[j] - middle;
            rows.extend([f_b * (f_ab - f_a), 0.5 * (f_a - f_ab) * (f_a - f_ab)]);
        }
    }
    let estimate = |chosen: &mut dyn Iterator<Item = usize>| -> Vec<f64> {
        let mut sums = vec![0.0; width];
        let mut squares = 0.0;
        for j in chosen {
            let row = &rows[j * width..(j + 1) * width];
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += value);
            squares += row[0] * row[0] + row[1] * row[1];
        }
        let n = count as f64;
        let shift = (sums[0] + sums[1]) / (2.0 * n);
        let variance = squares / (2.0 * n) - shift * shift;
        sums[2..].iter().map(|sum| sum / (n * variance)).collect()
    };
    let values = estimate(&mut (0..count));
    let mut random = fastrand::Rng::with_seed(seed);
    let mut drawn: Vec<Vec<f64>> = vec![Vec::with_capacity(RESAMPLES); values.len()];
    for _ in 0..RESAMPLES {
        let resampled = estimate(&mut (0..count).map(|_| random.usize(..count)));
        drawn.iter_mut().zip(resampled).filter(|(_, value)| value.is_finite()).for_each(|(all, value)| all.push(value));
    }
    let index = |at: usize| {
        let mut drawn = drawn[at].clone();
        drawn.sort_by(f64::total_cmp);
        let value = values[at];
        Index { value, low: quantile(&drawn, 0.025).unwrap_or(value), high: quantile(&drawn, 0.975).unwrap_or(value) }
    };
    Some(Indices {
        first: (0..mixed.len()).map(|factor| index(2 * factor)).collect(),
        total: (0..mixed.len()).map(|factor| index(2 * factor + 1)).collect(),
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::design::{Design, Matrix};
    use super::super::distribution::Distribution;
    use super::*;

    fn of(distributions: &[Distribution], samples: usize, f: impl Fn(&[f64]) -> f64) -> Indices {
        let factors = distributions.len();
        let design = Design { factors, seed: 1, correlation: None };
        let values = |matrix: Matrix| -> Vec<f64> {
            let value = |n: usize| {
                let u = design.sample(n, matrix);
                f(&u.iter().zip(distributions).map(|(&u, one)| one.quantile(u)).collect::<Vec<_>>())
            };
            (0..samples).map(value).collect()
        };
        let mixed: Vec<Vec<f64>> = (0..factors).map(|factor| values(Matrix::Mixed(factor))).collect();
        indices(&values(Matrix::A), &values(Matrix::B), &mixed, 1).unwrap()
    }

    fn hold(found: &[Index], expected: &[f64], within: f64) {
        for (index, expected) in found.iter().zip(expected) {
            assert!(index.low <= expected + 5e-4 && expected - 5e-4 <= index.high, "{index:?} for {expected}");
            assert!((index.value - expected).abs() < within, "{index:?} for {expected}");
        }
    }

    /// f = sin x₁ + a sin² x₂ + b x₃⁴ sin x₁ over ±π, a = 7, b = 0.1; T. Ishigami and T. Homma, *An importance quantification technique
    /// in uncertainty analysis for computer models* (ISUMA 1990). The indices, to three digits, follow from the variances in closed form:
    /// V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = 8 b²π⁸/225.
    #[test]
    fn ver_ishigami() {
        let x = Distribution::Uniform { low: -PI, high: PI };
        let f = |x: &[f64]| x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin();
        let found = of(&[x; 3], 4096, f);
        hold(&found.first, &[0.314, 0.442, 0.0], 0.02);
        hold(&found.total, &[0.558, 0.442, 0.244], 0.02);
    }

    /// Wear that is linear in k and in the number of meshes, both uncertain and independent: y = k n. With the variation coefficients
    /// c = σ/μ, V/(μ_k μ_n)² = c_k² + c_n² + c_k² c_n², of which the first two are the parts of one factor alone. A lognormal k has
    /// c² = exp(σ²) − 1, a uniform n within ±p has c² = p²/3.
    #[test]
    fn ver_a_product_in_closed_form() {
        let k = Distribution::Lognormal { median: 1e-17, factor: 1.5 };
        let n = Distribution::Uniform { low: 0.7e6, high: 1.3e6 };
        let (c_k, c_n) = ((1.5_f64.ln().powi(2)).exp() - 1.0, 0.09 / 3.0);
        let variance = c_k + c_n + c_k * c_n;
        let found = of(&[k, n], 4096, |x| x[0] * x[1]);
        hold(&found.first, &[c_k / variance, c_n / variance], 0.02);
        hold(&found.total, &[c_k * (1.0 + c_n) / variance, c_n * (1.0 + c_k) / variance], 0.02);
        // One factor alone explains all.
        let alone = of(&[k], 1024, |x| 3e11 * x[0]);
        hold(&alone.first, &[1.0], 0.02);
        hold(&alone.total, &[1.0], 0.02);
    }

    #[test]
    fn what_does_not_vary_has_no_indices() {
        assert_eq!(indices(&[3.0; 4], &[3.0; 4], &[vec![3.0; 4]], 1), None);
        assert_eq!(indices(&[0.0; 4], &[0.0; 4], &[vec![0.0; 4]], 1), None);
    }
}
