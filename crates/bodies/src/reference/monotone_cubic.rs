//! Monotone cubic interpolation, in which the slope at a place is a weighted harmonic mean of the
//! neighbouring differences where these have the same sign, and zero elsewhere.
//!
//! ```text
//! d_k = (h₁ + h₂ + …)       1/d = (w₁/Δ₁ + w₂/Δ₂)/(w₁ + w₂)        w₁ = 2 h₂ + h₁,   w₂ = h₂ + 2 h₁
//! ```
//!
//! h₁, h₂: lengths of the intervals before and after a place, Δ₁, Δ₂: differences over them.
//!
//! Source: F. N. Fritsch and J. Butland, *SIAM J. Sci. Stat. Comput.* 5 (1984) 300.

/// Monotone curve through values at increasing places.
#[derive(Debug, Clone)]
pub struct MonotoneCubic<'a> {
    places: &'a [f64],
    values: &'a [f64],
    slopes: Vec<f64>,
}

impl<'a> MonotoneCubic<'a> {
    /// Curve through as many `values` as increasing `places`; of equal places the first counts.
    pub fn new(places: &'a [f64], values: &'a [f64]) -> Self {
        let lengths: Vec<f64> = places.windows(2).map(|ends| ends[1] - ends[0]).collect();
        let differences: Vec<f64> = (values.windows(2).zip(&lengths))
            .map(|(ends, length)| if *length > 0.0 { (ends[1] - ends[0]) / length } else { 0.0 })
            .collect();
        let mut slopes = vec![0.0; places.len()];
        if let (Some(first), Some(last)) = (differences.first(), differences.last()) {
            slopes[0] = *first;
            slopes[differences.len()] = *last;
        }
        for k in 1..differences.len() {
            let ([before, after], [h1, h2]) = ([differences[k - 1], differences[k]], [lengths[k - 1], lengths[k]]);
            if before * after > 0.0 {
                let (w1, w2) = (2.0 * h2 + h1, h2 + 2.0 * h1);
                slopes[k] = (w1 + w2) / (w1 / before + w2 / after);
            }
        }
        Self { places, values, slopes }
    }

    /// Value at `x`; beyond the ends, the value at the end; 0 without places.
    pub fn at(&self, x: f64) -> f64 {
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

    /// Linear functions and values at the places are exact, and monotone values give a monotone curve.
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
