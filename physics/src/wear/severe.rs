//! The transition from mild to severe wear, for any law.
//!
//! ```text
//! C(p) = 1 where p ≤ p_lim, C_severe above
//! ```
//!
//! or, over a band of width b around the limit, the cubic between both that is level at its ends:
//!
//! ```text
//! C(p) = 1 + (C_severe − 1) t² (3 − 2 t)        t = (p − p_lim)/b + ½, between 0 and 1
//! ```
//!
//! Source: the thesis, equation 26; the band is this program's.

use super::settings::SevereTransition;

impl SevereTransition {
    /// C(p).
    pub fn factor_at(&self, pressure_mpa: f64) -> f64 {
        let beyond = pressure_mpa - self.above_mpa;
        if self.band_mpa <= 0.0 {
            return if beyond > 0.0 { self.factor } else { 1.0 };
        }
        let t = (beyond / self.band_mpa + 0.5).clamp(0.0, 1.0);
        1.0 + (self.factor - 1.0) * t * t * (3.0 - 2.0 * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Thesis eq 26; and a band that begins and ends level, with half of the rise at the limit.
    #[test]
    fn ver_the_transition_is_hard_or_over_a_band() {
        let hard = SevereTransition { above_mpa: 2000.0, factor: 100.0, band_mpa: 0.0 };
        for (pressure, factor) in [(0.0, 1.0), (2000.0, 1.0), (2000.1, 100.0)] {
            assert_eq!(hard.factor_at(pressure), factor);
        }
        let band = SevereTransition { band_mpa: 100.0, ..hard };
        for (pressure, factor) in [(1950.0, 1.0), (2000.0, 50.5), (2050.0, 100.0), (2e4, 100.0)] {
            assert!((band.factor_at(pressure) - factor).abs() < 1e-12);
        }
        let [first, middle, last] =
            [1950.0, 2000.0, 2050.0].map(|p| (band.factor_at(p + 1e-3) - band.factor_at(p - 1e-3)) / 2e-3);
        assert!(first < 1e-3 && last < 1e-3 && (middle - 1.5 * 99.0 / 100.0).abs() < 1e-6);
    }
}
