//! Mesh orders of the transmission error: half of the peak-to-peak value that each harmonic of the tooth mesh contributes,
//!
//! ```text
//! A_k = 2/m |Σ δ_j exp(2πi k j/m)|
//! ```
//!
//! over m transmission errors δ_j evenly spaced over one base pitch.

use std::f64::consts::TAU;

use gearwear_bodies::reference::linear_means::value_at;

/// Samples of a base pitch where positions are not evenly spaced.
const SAMPLES: usize = 512;

/// Amplitudes of the first `count` orders from values evenly spaced over one base pitch; 0 of those that the values do not resolve.
pub fn of_even(values: &[f64], count: usize) -> Vec<f64> {
    let m = values.len();
    (1..=count)
        .map(|k| {
            let (cosine, sine) = values.iter().enumerate().fold((0.0, 0.0), |(c, s), (j, value)| {
                let (sin, cos) = (TAU * ((k * j) % m) as f64 / m as f64).sin_cos();
                (c + value * cos, s + value * sin)
            });
            // The last order that the positions resolve is its own mirror image.
            let share = if 2 * k == m { 1.0 } else { 2.0 };
            if 2 * k > m { 0.0 } else { share * f64::hypot(cosine, sine) / m as f64 }
        })
        .collect()
}

/// Amplitudes from values at rising positions, linear between them, that reach over at least one `period`; none where they do not.
pub fn of_positions(positions: &[f64], values: &[f64], period: f64, count: usize) -> Vec<f64> {
    let (Some(first), Some(last)) = (positions.first(), positions.last()) else { return Vec::new() };
    // The last of the samples lies one spacing before the end of the period.
    if last - first < (1.0 - 1.0 / SAMPLES as f64) * period {
        return Vec::new();
    }
    // In the middle of what is known, where a tooth pair carries.
    let start = 0.5 * (first + last - period);
    let samples = (0..SAMPLES).map(|j| value_at(positions, values, start + period * j as f64 / SAMPLES as f64));
    of_even(&samples.collect::<Vec<f64>>(), count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum of cosines has their amplitudes, wherever the period begins.
    #[test]
    fn ver_orders_of_cosines() {
        let of = |x: f64| 3.0 + 2.0 * (TAU * x + 0.3).cos() + 0.5 * (3.0 * TAU * x - 1.0).cos();
        let even: Vec<f64> = (0..64).map(|j| of(f64::from(j) / 64.0)).collect();
        let positions: Vec<f64> = (0..=900).map(|j| 0.37 + 1.4 * (f64::from(j) / 900.0).powf(1.1)).collect();
        let values: Vec<f64> = positions.iter().map(|&x| of(x)).collect();
        for (orders, allowed) in [(of_even(&even, 4), 1e-12), (of_positions(&positions, &values, 1.0, 4), 1e-4)] {
            for (order, amplitude) in orders.iter().zip([2.0, 0.0, 0.5, 0.0]) {
                assert!((order - amplitude).abs() < allowed, "{orders:?}");
            }
        }
        assert!(of_positions(&[0.0, 0.9], &[1.0, 2.0], 1.0, 4).is_empty());
        assert_eq!(of_even(&[1.0, -1.0], 2), [1.0, 0.0]);
    }
}
