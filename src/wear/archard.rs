//! The generalised Archard law with a transition from mild to severe wear.
//!
//! ```text
//! dh = C k p ds        C = 1 where p ≤ p_lim, C = C_severe above
//! ```
//!
//! Source: J. F. Archard (1953); the thesis, equations 9–12 and 26.

use super::{
    WearLaw,
    settings::{SevereTransition, WearSettings},
};

/// dh = k p ds at every point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Archard {
    coefficient: f64,
    severe: Option<SevereTransition>,
}

impl Archard {
    /// The law of a scene.
    pub fn new(settings: &WearSettings) -> Self {
        Self { coefficient: settings.coefficient_mm2_per_n, severe: settings.severe }
    }
}

impl WearLaw for Archard {
    fn add_depth(&self, pressure_mpa: &[f64], sliding_mm: &[f64], depth_mm: &mut [f64]) {
        let (mild, limit, severe) = match self.severe {
            Some(severe) => (self.coefficient, severe.above_mpa, self.coefficient * severe.factor),
            None => (self.coefficient, f64::INFINITY, self.coefficient),
        };
        for ((depth, &pressure), &sliding) in depth_mm.iter_mut().zip(pressure_mpa).zip(sliding_mm) {
            let k = if pressure > limit { severe } else { mild };
            *depth += k * pressure * sliding;
        }
    }

    fn greatest_coefficient_mm2_per_n(&self) -> f64 {
        self.coefficient * self.severe.map_or(1.0, |severe| severe.factor.max(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Thesis eq 26 with k = 1e-17 m²/N, factor 100 above 2000 MPa, 0.7 mm of sliding.
    #[test]
    fn ver_mild_and_severe_rates() {
        let severe = Some(SevereTransition { above_mpa: 2000.0, factor: 100.0 });
        let law = Archard::new(&WearSettings { coefficient_mm2_per_n: 1e-11, severe });
        let mut depth = [0.0; 3];
        law.add_depth(&[1000.0, 2000.0, 2001.0], &[0.7; 3], &mut depth);
        let expected = [1e-11 * 1000.0 * 0.7, 1e-11 * 2000.0 * 0.7, 1e-9 * 2001.0 * 0.7];
        for (d, e) in depth.iter().zip(expected) {
            assert!((d / e - 1.0).abs() < 1e-14);
        }
    }
}
