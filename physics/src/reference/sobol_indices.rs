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
pub struct Index {
    /// Of all the points.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// One index a factor.
#[derive(Debug, Clone, PartialEq)]
pub struct Indices {
    /// First order.
    pub first: Vec<Index>,
    /// Total.
    pub total: Vec<Index>,
}

/// The indices of the values `a` and `b` of both samples and `mixed` of each factor; none where the values do not vary.
pub fn indices(a: &[f64], b: &[f64], mixed: &[Vec<f64>], seed: u64) -> Option<Indices> {
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
