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
//! A point of a contact stands for its cell of the flank, over which pressure may differ by more than the band. Its factor is the mean over the cell of
//! pressures that are linear from point to point: on both halves of the cell (Φ(p_b) − Φ(p_a))/(p_b − p_a) with Φ′ = C, so that a step of C counts by
//! the part of the cell that is beyond it, wherever points lie.
//!
//! Source: the thesis, equation 26; the band and the means are this program's.

use super::settings::SevereTransition;

/// Difference of two pressures over the limit up to which C at their mean stands for the mean of C.
const LEAST_APART: f64 = 1e-6;

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

    /// Mean of C over the cell of a point in a row of pressures along a contact, MPa. At an end of the row its own pressure reaches to the end of its cell.
    pub(super) fn mean_factor(&self, pressures_mpa: &[f64], point: usize) -> f64 {
        let here_mpa = pressures_mpa[point];
        let neighbours = [point.checked_sub(1), Some(point + 1)];
        let ends_mpa = neighbours.map(|beside| {
            let beside_mpa = beside.and_then(|beside| pressures_mpa.get(beside));
            beside_mpa.map_or(here_mpa, |beside_mpa| here_mpa.midpoint(*beside_mpa))
        });
        if here_mpa.max(ends_mpa[0]).max(ends_mpa[1]) <= self.begins_mpa() {
            return 1.0;
        }
        0.5 * (self.mean_between(ends_mpa[0], here_mpa) + self.mean_between(here_mpa, ends_mpa[1]))
    }

    /// Mean of C between two pressures, MPa.
    fn mean_between(&self, one_mpa: f64, other_mpa: f64) -> f64 {
        let apart_mpa = other_mpa - one_mpa;
        if apart_mpa.abs() <= LEAST_APART * self.above_mpa {
            return self.factor_at(one_mpa.midpoint(other_mpa));
        }
        1.0 + (self.factor - 1.0) * (self.beyond_mpa(other_mpa) - self.beyond_mpa(one_mpa)) / apart_mpa
    }

    /// ∫ (C − 1)/(C_severe − 1) dp up to a pressure, MPa.
    fn beyond_mpa(&self, pressure_mpa: f64) -> f64 {
        let beyond_mpa = pressure_mpa - self.above_mpa;
        if 2.0 * beyond_mpa >= self.band_mpa {
            return beyond_mpa;
        }
        let t = (beyond_mpa / self.band_mpa + 0.5).max(0.0);
        if t > 0.0 { self.band_mpa * t * t * t * (1.0 - 0.5 * t) } else { 0.0 }
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

    /// The factor of a cell is the mean over pressures that are linear from point to point, as a sum over ten thousand of them finds it; in a row of equal
    /// pressures it is that of the pressure itself.
    #[test]
    fn ver_the_factor_of_a_cell_is_its_mean() {
        let row = [1930.0, 1990.0, 2020.0, 2020.0, 2020.0, 0.0];
        let samples = 10_000;
        for band_mpa in [0.0, 40.0, 100.0] {
            let severe = SevereTransition { above_mpa: 2000.0, factor: 60.0, band_mpa };
            for (point, ends) in [
                (0, [1930.0, 1960.0]),
                (1, [1960.0, 2005.0]),
                (2, [2005.0, 2020.0]),
                (3, [2020.0; 2]),
                (4, [2020.0, 1010.0]),
            ] {
                let halves = [(ends[0], row[point]), (row[point], ends[1])].map(|(one, other)| {
                    let at = |k: i32| one + (other - one) * (f64::from(k) + 0.5) / f64::from(samples);
                    (0..samples).map(|k| severe.factor_at(at(k))).sum::<f64>() / f64::from(samples)
                });
                let (found, expected) = (severe.mean_factor(&row, point), 0.5 * (halves[0] + halves[1]));
                assert!((found - expected).abs() < 1e-4 * expected, "{band_mpa}, {point}: {found} for {expected}");
            }
        }
    }
}
