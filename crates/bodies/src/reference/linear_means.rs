//! Values and means of piecewise linear functions, constant beyond their ends:
//!
//! ```text
//! 1/(b − a) ∫ h ds over [a, b] = Σ_k m_k h_k          m_k = 1/(b − a) ∫ N_k ds over [a, b]
//! ```
//!
//! with the values h_k at given places and their hat functions N_k.

use std::ops::Range;

/// Value at a place of the function with `values` at `places` (rising, at least two).
pub fn value_at(places: &[f64], values: &[f64], at: f64) -> f64 {
    let after = places.partition_point(|&place| place <= at).clamp(1, places.len() - 1);
    let length = places[after] - places[after - 1];
    let weight = if length > 0.0 { ((at - places[after - 1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    // This form is monotonic in spite of rounding.
    (1.0 - weight) * values[after - 1] + weight * values[after]
}

/// Adds `weight` times the m_k of the stretch from `from` to `to` (≥ `from`) to `sums`, with an entry for each of the `places` (rising, at least
/// two); returns the range of places with weight. A stretch may be a point.
pub fn add_means(places: &[f64], [from, to]: [f64; 2], weight: f64, sums: &mut [f64]) -> Range<usize> {
    let last = places.len() - 1;
    let (low, high) = (places[0], places[last]);
    let length = to - from;
    if length <= 1e-12 * (high - low) {
        let at = from.clamp(low, high);
        let k = interval(places, at);
        let t = (at - places[k]) / (places[k + 1] - places[k]);
        sums[k] += weight * (1.0 - t);
        sums[k + 1] += weight * t;
        return k..k + 2;
    }
    let per_length = weight / length;
    let (inner_from, inner_to) = (from.clamp(low, high), to.clamp(low, high));
    sums[0] += per_length * (low.min(to) - from.min(low));
    sums[last] += per_length * (to.max(high) - high.max(from));
    let first = interval(places, inner_from);
    let mut k = first;
    while k < last && (places[k] < inner_to || k == first) {
        let (a, b) = (places[k], places[k + 1]);
        let (x0, x1) = (inner_from.max(a), inner_to.min(b));
        if x1 > x0 {
            let right = (0.5 * (x0 + x1) - a) / (b - a);
            sums[k] += per_length * (x1 - x0) * (1.0 - right);
            sums[k + 1] += per_length * (x1 - x0) * right;
        }
        k += 1;
    }
    let begin = if from < low { 0 } else { first };
    let end = if to > high { last } else { k.min(last) };
    begin..end + 1
}

/// Number of the interval between places that contains `at`.
fn interval(places: &[f64], at: f64) -> usize {
    places.partition_point(|&x| x <= at).clamp(1, places.len() - 1) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of a linear function over a stretch is its value in the middle, weights add up to one, and only places in the returned
    /// range have one.
    #[test]
    fn ver_means_of_linear_courses() {
        let places = [0.0, 0.3, 0.4, 0.9, 1.0, 1.7];
        for (from, to) in [(0.0, 1.7), (0.05, 0.1), (0.2, 0.95), (0.4, 0.4), (1.6999, 1.7), (0.3, 0.9)] {
            let mut sums = vec![0.0; places.len()];
            let reached = add_means(&places, [from, to], 2.0, &mut sums);
            let total: f64 = sums.iter().sum();
            let mean: f64 = sums.iter().zip(places).map(|(m, at)| m * at).sum();
            assert!((total - 2.0).abs() < 1e-14 && (mean - (from + to)).abs() < 1e-14, "{from} {to} {sums:?}");
            assert!(sums.iter().enumerate().all(|(k, m)| *m == 0.0 || reached.contains(&k)), "{reached:?} {sums:?}");
        }
    }

    /// Weights beyond an end are added to the outermost place.
    #[test]
    fn ver_ends_keep_what_falls_beyond() {
        for stretch in [[-0.4, 0.2], [0.9, 1.3], [-2.0, -1.0], [1.5, 2.0], [-1.0, 2.0]] {
            let mut sums = vec![0.0; 3];
            add_means(&[0.0, 0.5, 1.0], stretch, 1.0, &mut sums);
            assert!((sums.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{stretch:?} {sums:?}");
            assert!(sums.iter().all(|m| *m >= 0.0));
        }
    }
}
