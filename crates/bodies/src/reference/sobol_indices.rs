//! Sobol indices with confidence intervals, from function values over Saltelli's samples.
//!
//! ```text
//! S_i  = Σ_j f(B_j) [f(AB_j^i) − f(A_j)] / (N V)          first order: fraction of the variance V due to factor i alone
//! ST_i = Σ_j [f(A_j) − f(AB_j^i)]² / (2 N V)              total: with all its interactions
//! V    = variance of f(A) and f(B) together
//! ```
//!
//! The mean is subtracted from f first, which changes no index and reduces most of the scatter of S_i. Intervals contain 95 % of the indices of
//! samples drawn with replacement from the N points (seeded bootstrap). As points of a Sobol sequence are more even than random ones,
//! the intervals are rather too wide.
//!
//! Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259–270, table 2 (b) and (f), the latter after M. J. W. Jansen.

use serde::Serialize;

use super::statistics::{mean, quantile};

/// Number of samples drawn with replacement.
const RESAMPLES: usize = 500;
/// Round-off over the greatest value.
const ROUND_OFF: f64 = 1e-12;

/// Sobol index with its confidence interval of 95 %.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Index {
    /// Index of all points.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Sobol indices of all factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Indices {
    /// First-order indices.
    pub first: Vec<Index>,
    /// Total indices.
    pub total: Vec<Index>,
}

/// Sobol indices from the values `a` and `b` of both samples and `mixed` of each factor; `None` where the values do not vary.
pub fn indices(a: &[f64], b: &[f64], mixed: &[Vec<f64>], seed: u64) -> Option<Indices> {
    let count = a.len();
    let all = a.iter().chain(b).copied();
    let middle = mean(all.clone());
    let greatest = all.clone().map(f64::abs).fold(0.0, f64::max);
    if count < 2 || !all.clone().any(|value| (value - middle).abs() > ROUND_OFF * greatest) {
        return None;
    }
    // Row j: f_A, f_B, then f_B (f_AB − f_A) and (f_A − f_AB)²/2 for each factor.
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
    let values = estimates(&rows, width, 0..count);
    let mut random = fastrand::Rng::with_seed(seed);
    let mut drawn: Vec<Vec<f64>> = vec![Vec::with_capacity(RESAMPLES); values.len()];
    for _ in 0..RESAMPLES {
        let resampled = estimates(&rows, width, (0..count).map(|_| random.usize(..count)));
        drawn.iter_mut().zip(resampled).filter(|(_, value)| value.is_finite()).for_each(|(all, value)| all.push(value));
    }
    let mut indices = Indices { first: Vec::new(), total: Vec::new() };
    for (at, (value, mut drawn)) in values.into_iter().zip(drawn).enumerate() {
        drawn.sort_by(f64::total_cmp);
        let [low, high] = [0.025, 0.975].map(|share| quantile(&drawn, share).unwrap_or(value));
        let of_order = if at.is_multiple_of(2) { &mut indices.first } else { &mut indices.total };
        of_order.push(Index { value, low, high });
    }
    Some(indices)
}

/// First-order and total index of each factor from the `chosen` rows, as many as there are.
fn estimates(rows: &[f64], width: usize, chosen: impl Iterator<Item = usize>) -> Vec<f64> {
    let mut sums = vec![0.0; width];
    let mut squares = 0.0;
    for j in chosen {
        let row = &rows[j * width..(j + 1) * width];
        sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += value);
        squares += row[0] * row[0] + row[1] * row[1];
    }
    let n = (rows.len() / width) as f64;
    let shift = (sums[0] + sums[1]) / (2.0 * n);
    let variance = squares / (2.0 * n) - shift * shift;
    sums[2..].iter().map(|sum| sum / (n * variance)).collect()
}
