//! Arithmetic mean deviation of a profile whose form is removed.
//!
//! ```text
//! Sa, Pa = 1/l ∫ |z| ds            of everything that is left: wear, waviness and roughness
//! Ra     = 1/l ∫ |z − m| ds        m: the mean line of the Gaussian filter with cutoff λc
//!
//! m(s) = ∫ z(t) w(s − t) dt / ∫ w(s − t) dt       w(u) = exp(−π (u/(α λc))²),  α = √(ln 2/π)
//! ```
//!
//! The thesis's Sa is that of an area; of one trace it is the profile's Pa, given here as `mean_deviation_um`. The thesis puts its
//! uncertainty at about 5 % for replicas. At the ends of a profile the filter's weights are those of the points there are.
//!
//! Source: ISO 21920-2 (parameters), ISO 16610-21 (Gaussian filter).

use std::f64::consts::{LN_2, PI};

/// Cutoff λc of the roughness, mm: that of ISO 21920-3 for Ra from 0.1 to 2 µm.
pub const CUTOFF_MM: f64 = 0.8;
/// Fewest points in a cutoff.
const POINTS_PER_CUTOFF: f64 = 10.0;
/// Reach of the filter in cutoffs: beyond it, weights are below 1e-6.
const REACH: f64 = 1.0;

/// Arithmetic mean deviation from their mean of `values` at points of these arc lengths.
pub fn mean_deviation(arc_mm: &[f64], values: &[f64]) -> f64 {
    let shares = shares_mm(arc_mm);
    let length: f64 = shares.iter().sum();
    let mean = values.iter().zip(&shares).map(|(value, share)| value * share).sum::<f64>() / length;
    values.iter().zip(&shares).map(|(value, share)| (value - mean).abs() * share).sum::<f64>() / length
}

/// Ra: arithmetic mean deviation from the mean line of the Gaussian filter; `None` where the points are too far apart, or the profile is
/// shorter than the cutoff.
pub fn roughness(arc_mm: &[f64], values: &[f64], cutoff_mm: f64) -> Option<f64> {
    let length = arc_mm.last()? - arc_mm.first()?;
    let widest = arc_mm.windows(2).map(|two| two[1] - two[0]).fold(0.0, f64::max);
    if length < cutoff_mm || POINTS_PER_CUTOFF * widest > cutoff_mm {
        return None;
    }
    let shares = shares_mm(arc_mm);
    let alpha_squared = LN_2 / PI;
    let rough: Vec<f64> = (0..arc_mm.len())
        .map(|i| {
            let first = arc_mm.partition_point(|&s| s < arc_mm[i] - REACH * cutoff_mm);
            let last = arc_mm.partition_point(|&s| s <= arc_mm[i] + REACH * cutoff_mm);
            let (mut sum, mut weights) = (0.0, 0.0);
            for j in first..last {
                let u = (arc_mm[i] - arc_mm[j]) / cutoff_mm;
                let weight = (-PI * u * u / alpha_squared).exp() * shares[j];
                sum += weight * values[j];
                weights += weight;
            }
            values[i] - sum / weights
        })
        .collect();
    Some(mean_deviation(arc_mm, &rough))
}

/// Length that each point stands for.
fn shares_mm(arc_mm: &[f64]) -> Vec<f64> {
    let last = arc_mm.len().saturating_sub(1);
    (0..arc_mm.len()).map(|i| 0.5 * (arc_mm[(i + 1).min(last)] - arc_mm[i.saturating_sub(1)])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Vec<f64> {
        (0..4001).map(|i| f64::from(i) * 0.002).collect()
    }

    /// Mean of |sin|: 2/π of the amplitude.
    #[test]
    fn ver_mean_deviation_of_a_sine() {
        let arc = places();
        let z: Vec<f64> = arc.iter().map(|s| 1.3 * (2.0 * PI * s / 0.4).sin()).collect();
        assert!((mean_deviation(&arc, &z) / (1.3 * 2.0 / PI) - 1.0).abs() < 1e-3);
    }

    /// ISO 16610-21: a wave as long as the cutoff passes by one half, long ones go into the mean line, short ones stay.
    #[test]
    fn val_gaussian_filter_halves_a_wave_of_the_cutoff() {
        let arc = places();
        for (wave_mm, passed) in [(0.8, 0.5), (8.0, 1.0 - (-LN_2 / 100.0).exp()), (0.08, 1.0)] {
            let z: Vec<f64> = arc.iter().map(|s| (2.0 * PI * s / wave_mm).sin()).collect();
            let ra = roughness(&arc, &z, CUTOFF_MM).unwrap();
            // The ends of the profile, a cutoff each of ten, see part of the weights only.
            assert!((ra / (2.0 / PI) - passed).abs() < 0.03, "{wave_mm}: {ra}");
        }
        assert_eq!(roughness(&arc[..100], &arc[..100], CUTOFF_MM), None);
        let coarse: Vec<f64> = (0..81).map(|i| 0.1 * f64::from(i)).collect();
        assert_eq!(roughness(&coarse, &coarse, CUTOFF_MM), None);
    }
}
