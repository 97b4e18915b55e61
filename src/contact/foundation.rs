//! The stiffness K/H of an elastic (Winkler) foundation, matched to Hertz in one respect.
//!
//! On a bed of independent springs a parabolic gap x²/2R under line load w gives a parabolic pressure:
//!
//! ```text
//! a³ = 3 w R / (2 K/H)       p₀ = (K/H) a²/(2R)       δ = a²/(2R)
//! ```
//!
//! One constant can meet Hertz (a_H² = 4 w R/(π E*), p₀ = 2w/(π a_H)) in one respect, at one load and curvature:
//!
//! ```text
//! same half-width      K/H = (3π/8) E*/a_H           = 1.178 E*/a_H
//! same peak pressure   K/H = (3π/8)⁻² E*/a_H         = 0.7205 E*/a_H
//! same approach δ      K/H = 3 w R / (2 (2 R δ)^{3/2})
//! ```
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), section 4.3; the matches follow from equating the two.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::settings::MatchCriterion;
use crate::reference::flattening::Flattening;

/// K/H in MPa/mm that makes the bed agree with `hertz` under `line_load_n_per_mm`.
pub fn matched_mpa_per_mm(criterion: MatchCriterion, hertz: &Flattening, line_load_n_per_mm: f64) -> f64 {
    let (w, radius) = (line_load_n_per_mm, hertz.contact.relative_radius_mm());
    let a_hertz = hertz.contact.loaded(w).half_width_mm;
    let a_bed = match criterion {
        MatchCriterion::HalfWidth => a_hertz,
        MatchCriterion::PeakPressure => 3.0 * PI / 8.0 * a_hertz,
        MatchCriterion::Approach => (2.0 * radius * hertz.approach_mm(w)).sqrt(),
    };
    1.5 * w * radius / a_bed.powi(3)
}

/// Half-width of a bed of stiffness `foundation_mpa_per_mm` against a parabolic gap of radius `radius_mm`.
pub fn half_width_mm(foundation_mpa_per_mm: f64, radius_mm: f64, line_load_n_per_mm: f64) -> f64 {
    (1.5 * line_load_n_per_mm * radius_mm / foundation_mpa_per_mm).cbrt()
}

/// K/H along the path of contact and against load: at each position a power of the line load,
///
/// ```text
/// K/H (ξ, w) = K(ξ) (w/w_ref)^(−m(ξ))
/// ```
///
/// in straight lines of ln K and m between positions, and constant beyond the ends. Hertz's contact has m = ½.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundationCurve {
    /// Radius of curvature of the pinion at the theoretical contact point, increasing, mm.
    pub position_mm: Vec<f64>,
    /// K/H at the reference load, MPa/mm.
    pub mpa_per_mm: Vec<f64>,
    /// m at each position, 0 to below 1.
    pub load_exponent: Vec<f64>,
    /// w_ref, N/mm.
    pub reference_line_load_n_per_mm: f64,
}

impl FoundationCurve {
    /// K/H at a position and load, MPa/mm.
    pub fn at_mpa_per_mm(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let places = &self.position_mm;
        let after = places.partition_point(|&place| place <= position_mm).clamp(1, places.len() - 1);
        let (low, high) = (after - 1, after);
        let weight = ((position_mm - places[low]) / (places[high] - places[low])).clamp(0.0, 1.0);
        let between = |a: f64, b: f64| a + weight * (b - a);
        let reference = between(self.mpa_per_mm[low].ln(), self.mpa_per_mm[high].ln()).exp();
        let exponent = between(self.load_exponent[low], self.load_exponent[high]);
        reference * (line_load_n_per_mm / self.reference_line_load_n_per_mm).powf(-exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{flattening::Body, hertz_line::HertzLine};

    /// Each criterion holds, checked through the bed's own closed form.
    #[test]
    fn ver_each_match_meets_hertz_in_its_respect() {
        let body = Body { young_modulus_mpa: 206e3, poisson_ratio: 0.3, depth_mm: 3.9 };
        let modulus = 206e3 / 0.91 / 2.0;
        let hertz = Flattening { contact: HertzLine::new([13.97, 20.96], modulus).unwrap(), bodies: [body; 2] };
        let (w, radius) = (637.66, hertz.contact.relative_radius_mm());
        let strip = hertz.contact.loaded(w);
        let bed = |criterion| {
            let k = matched_mpa_per_mm(criterion, &hertz, w);
            let a = half_width_mm(k, radius, w);
            (k, a, k * a * a / (2.0 * radius), a * a / (2.0 * radius))
        };
        let (k, a, p, _) = bed(MatchCriterion::HalfWidth);
        assert!((a / strip.half_width_mm - 1.0).abs() < 1e-12);
        assert!((k * a / modulus - 3.0 * PI / 8.0).abs() < 1e-12);
        // The price of the match on half-width: peak pressure 3π/8 = 1.178 times Hertz's.
        assert!((p / strip.peak_pressure_mpa - 3.0 * PI / 8.0).abs() < 1e-12);
        let (k, _, p, _) = bed(MatchCriterion::PeakPressure);
        assert!((p / strip.peak_pressure_mpa - 1.0).abs() < 1e-12);
        assert!((k * strip.half_width_mm / modulus - 0.7205).abs() < 1e-4);
        let (_, _, _, approach) = bed(MatchCriterion::Approach);
        assert!((approach / hertz.approach_mm(w) - 1.0).abs() < 1e-12);
    }
}
