//! Interpolation that never overshoots: a cubic on each interval whose slopes at the ends are a weighted harmonic mean of the
//! neighbouring differences where these agree in sign, and zero where they do not.
//!
//! ```text
//! d_k = (h₁ + h₂ + …)       1/d = (w₁/Δ₁ + w₂/Δ₂)/(w₁ + w₂)        w₁ = 2 h₂ + h₁,   w₂ = h₂ + 2 h₁
//! ```
//!
//! h₁, h₂: lengths of the intervals before and after a place, Δ₁, Δ₂: differences over them.
//!
//! Source: F. N. Fritsch and J. Butland, *SIAM J. Sci. Stat. Comput.* 5 (1984) 300.

/// The curve through given values at increasing places.
#[derive(Debug, Clone)]
pub(crate) struct MonotoneCubic<'a> {
    places: &'a [f64],
    values: &'a [f64],
    slopes: Vec<f64>,
}

impl<'a> MonotoneCubic<'a> {
    /// Through `values` at the increasing `places`, as many of both; of equal places the first counts.
    pub(crate) fn new(places: &'a [f64], values: &'a [f64]) -> Self {
        let last = places.len().saturating_sub(1);
        let length = |k: usize| places[k + 1] - places[k];
        let difference = |k: usize| if length(k) > 0.0 { (values[k + 1] - values[k]) / length(k) } else { 0.0 };
        let slope = |k: usize| {
            if last == 0 {
                return 0.0;
            }
            if k == 0 {
                return difference(0);
            }
            if k == last {
                return difference(last - 1);
            }
            let (before, after) = (difference(k - 1), difference(k));
            if before * after <= 0.0 {
                return 0.0;
            }
            let (w1, w2) = (2.0 * length(k) + length(k - 1), length(k) + 2.0 * length(k - 1));
            (w1 + w2) / (w1 / before + w2 / after)
        };
        Self { places, values, slopes: (0..places.len()).map(slope).collect() }
    }

    /// The value at `x`; beyond the ends, the value there; 0 without any place.
    pub(crate) fn at(&self, x: f64) -> f64 {
        let (Some(&first), Some(last)) = (self.places.first(), self.places.len().checked_sub(1)) else { return 0.0 };
        if last == 0 || x <= first {
            return self.values[0];
        }
        if x >= self.places[last] {
            return self.values[last];
        }
        let k = self.places.partition_point(|&place| place <= x).clamp(1, last) - 1;
        let h = self.places[k + 1] - self.places[k];
        let t = (x - self.places[k]) / h;
        let (a, b, d) = (self.slopes[k] * h, self.slopes[k + 1] * h, self.values[k + 1] - self.values[k]);
        self.values[k] + t * (a + t * ((3.0 * d - 2.0 * a - b) + t * (a + b - 2.0 * d)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight lines stay straight, places give their values, monotone values a monotone curve.
    #[test]
    fn ver_no_overshoot() {
        let places = [0.0, 0.1, 0.5, 0.6, 2.0];
        let line: Vec<f64> = places.iter().map(|x| 3.0 - 2.0 * x).collect();
        let curve = MonotoneCubic::new(&places, &line);
        let step = [0.0, 0.0, 1.0, 1.0, 1.5];
        let steps = MonotoneCubic::new(&places, &step);
        let mut before = 0.0;
        for k in 0..=400 {
            let x = 0.005 * f64::from(k);
            assert!((curve.at(x) - (3.0 - 2.0 * x)).abs() < 1e-14);
            let value = steps.at(x);
            assert!(value >= before && value <= 1.5, "{x} {value}");
            before = value;
        }
        assert_eq!(places.map(|x| steps.at(x)), step);
        assert_eq!((steps.at(-1.0), steps.at(3.0)), (0.0, 1.5));
    }
}
