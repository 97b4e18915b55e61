//! Stiffness K/H of a Winkler foundation, matched to Hertz in one respect.
//!
//! On a foundation of independent springs a parabolic gap x²/2R under line load w gives a parabolic pressure:
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
use gearwear_bodies::gear::normal_section::Obliquity;
use gearwear_bodies::reference::flattening::Flattening;

/// K/H in MPa/mm that makes the foundation agree with `hertz` under `line_load_n_per_mm`.
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

/// Half-width and greatest pressure of the foundation's parabola over those of Hertz's ellipse under `line_load_n_per_mm`: a/a_H and
/// (3π/8) a_H/a.
pub fn over_hertz(foundation_mpa_per_mm: f64, hertz: &Flattening, line_load_n_per_mm: f64) -> [f64; 2] {
    let contact = &hertz.contact;
    let own_mm = half_width_mm(foundation_mpa_per_mm, contact.relative_radius_mm(), line_load_n_per_mm);
    let wider = own_mm / contact.loaded(line_load_n_per_mm).half_width_mm;
    [wider, 3.0 * PI / 8.0 / wider]
}

/// Springs at one position, all with K/H = K (w/w_ref)^(−m): softer under more load where m > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundationStiffness {
    /// K, MPa/mm.
    mpa_per_mm: f64,
    /// m.
    load_exponent: f64,
    /// w_ref, N/mm.
    reference: f64,
}

impl FoundationStiffness {
    /// K = `mpa_per_mm` at w_ref = `reference`, and m.
    pub(super) fn new(mpa_per_mm: f64, load_exponent: f64, reference: f64) -> Self {
        Self { mpa_per_mm, load_exponent, reference }
    }

    /// K/H under a line load (> 0 where it depends on it), MPa/mm.
    pub fn mpa_per_mm(&self, line_load_n_per_mm: f64) -> f64 {
        if self.load_exponent == 0.0 {
            return self.mpa_per_mm;
        }
        self.mpa_per_mm * (line_load_n_per_mm / self.reference).powf(-self.load_exponent)
    }

    /// The line load w and its derivative by depth, from the integral U of the penetration over the contact and its
    /// derivative U' (the length in contact). From w = K (w/w_ref)^(−m) U follows without iteration
    ///
    /// ```text
    /// w = w_ref (K U/w_ref)^{1/(1+m)}        w' = w/(1+m) · U'/U
    /// ```
    pub(crate) fn load_and_stiffness(&self, penetration_mm2: f64, contact_mm: f64) -> (f64, f64) {
        if self.load_exponent == 0.0 {
            return (self.mpa_per_mm * penetration_mm2, self.mpa_per_mm * contact_mm);
        }
        if penetration_mm2 <= 0.0 {
            return (0.0, 0.0);
        }
        let power = 1.0 / (1.0 + self.load_exponent);
        let load = self.reference * (self.mpa_per_mm * penetration_mm2 / self.reference).powf(power);
        (load, power * load * contact_mm / penetration_mm2)
    }

    /// Approach δ = a²/2R against a parabolic gap of radius R = `radius_mm`, and its derivative by the load, of which it is the
    /// power 2 (1 + m)/3.
    pub(crate) fn approach_and_compliance(&self, radius_mm: f64, line_load_n_per_mm: f64) -> (f64, f64) {
        if line_load_n_per_mm <= 0.0 {
            return (0.0, 0.0);
        }
        let approach = self.half_width_mm(radius_mm, line_load_n_per_mm).powi(2) / (2.0 * radius_mm);
        (approach, 2.0 / 3.0 * (1.0 + self.load_exponent) * approach / line_load_n_per_mm)
    }

    /// Half-width against a parabolic gap of radius `radius_mm`.
    pub fn half_width_mm(&self, radius_mm: f64, line_load_n_per_mm: f64) -> f64 {
        half_width_mm(self.mpa_per_mm(line_load_n_per_mm), radius_mm, line_load_n_per_mm)
    }
}

/// Half-width of a foundation of stiffness `foundation_mpa_per_mm` against a parabolic gap of radius `radius_mm`.
pub fn half_width_mm(foundation_mpa_per_mm: f64, radius_mm: f64, line_load_n_per_mm: f64) -> f64 {
    (1.5 * line_load_n_per_mm * radius_mm / foundation_mpa_per_mm).cbrt()
}

/// K/H along the path of contact and against load: at each position a power of the line load,
///
/// ```text
/// K/H (ξ, w) = K(ξ) (w/w_ref)^(−m(ξ))
/// ```
///
/// with ln K and m linear between positions, and constant beyond the ends. Hertz's contact has m = ½.
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
    /// Curve for oblique lines of contact, from this one of the transverse section: K/H depends on the half-width alone, and
    /// under w a contact in the normal section is as wide as one in the transverse section under w/cos β_b.
    pub fn in_normal_section(&self, obliquity: Obliquity) -> Self {
        let reference = self.reference_line_load_n_per_mm;
        let of_section = reference / obliquity.as_wide_under_n_per_mm(1.0);
        Self { reference_line_load_n_per_mm: of_section, ..self.clone() }
    }

    /// K/H at a position under a line load (> 0), MPa/mm.
    pub fn at_mpa_per_mm(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        self.springs_at(position_mm).mpa_per_mm(line_load_n_per_mm)
    }

    /// Springs at one position.
    pub(super) fn springs_at(&self, position_mm: f64) -> FoundationStiffness {
        let count = self.position_mm.len();
        let after = self.position_mm.partition_point(|&p| p <= position_mm).min(count - 1);
        let before = after.saturating_sub(1);
        let (low, high) = (self.position_mm[before], self.position_mm[after]);
        let weight = if high > low { ((position_mm - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        let [ln_low, ln_high] = [before, after].map(|k| self.mpa_per_mm[k].ln());
        let [m_low, m_high] = [before, after].map(|k| self.load_exponent[k]);
        FoundationStiffness {
            mpa_per_mm: (ln_low + weight * (ln_high - ln_low)).exp(),
            load_exponent: m_low + weight * (m_high - m_low),
            reference: self.reference_line_load_n_per_mm,
        }
    }
}

/// Mean of the positive part of a linear course from u₀ to u₁, and the fraction of the way on which it is positive.
pub(super) fn mean_positive([u0, u1]: [f64; 2]) -> (f64, f64) {
    if u0 >= 0.0 && u1 >= 0.0 {
        (0.5 * (u0 + u1), 1.0)
    } else if u0 > 0.0 || u1 > 0.0 {
        let deepest = u0.max(u1);
        let fraction = deepest / (u0 - u1).abs();
        (0.5 * deepest * fraction, fraction)
    } else {
        (0.0, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::reference::{flattening::HalfPlane, hertz_line::HertzLine};
    use gearwear_fem::elastic::Elastic;

    /// Each criterion holds, checked through the foundation's own closed form.
    #[test]
    fn ver_each_match_meets_hertz_in_its_respect() {
        let elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
        let body = HalfPlane { elastic, depth_mm: 3.9 };
        let modulus = 206e3 / 0.91 / 2.0;
        let hertz = Flattening { contact: HertzLine::new([13.97, 20.96], modulus).unwrap(), bodies: [body; 2] };
        let (w, radius) = (637.66, hertz.contact.relative_radius_mm());
        let strip = hertz.contact.loaded(w);
        let [(k, a, p, _), (softer_k, _, softer_p, _), (_, _, _, approach)] =
            [MatchCriterion::HalfWidth, MatchCriterion::PeakPressure, MatchCriterion::Approach].map(|criterion| {
                let k = matched_mpa_per_mm(criterion, &hertz, w);
                let a = half_width_mm(k, radius, w);
                (k, a, k * a * a / (2.0 * radius), a * a / (2.0 * radius))
            });
        assert!((a / strip.half_width_mm - 1.0).abs() < 1e-12);
        assert!((k * a / modulus - 3.0 * PI / 8.0).abs() < 1e-12);
        // The price of the match on half-width: peak pressure 3π/8 = 1.178 times Hertz's.
        assert!((p / strip.peak_pressure_mpa - 3.0 * PI / 8.0).abs() < 1e-12);
        assert!((softer_p / strip.peak_pressure_mpa - 1.0).abs() < 1e-12);
        assert!((softer_k * strip.half_width_mm / modulus - 0.7205).abs() < 1e-4);
        assert!((approach / hertz.approach_mm(w) - 1.0).abs() < 1e-12);
    }

    /// A curve that has Hertz's half-width in the transverse section, √(8 w R_t/(π E′)), has it in the normal section, where radii are R_t/cos β_b.
    #[test]
    fn ver_a_curve_has_hertz_half_width_in_the_normal_section() {
        let (transverse_mm, modulus_mpa, reference) = (7.3, 113e3, 600.0);
        fn hertz_mm(line_load: f64, radius_mm: f64, modulus_mpa: f64) -> f64 {
            let body = HertzLine::new([radius_mm, f64::INFINITY], modulus_mpa).unwrap();
            body.loaded(line_load).half_width_mm
        }
        let curve = FoundationCurve {
            position_mm: vec![10.0],
            mpa_per_mm: vec![1.5 * reference * transverse_mm / hertz_mm(reference, transverse_mm, modulus_mpa).powi(3)],
            load_exponent: vec![0.5],
            reference_line_load_n_per_mm: reference,
        };
        let base_helix_rad = 0.6_f64;
        let normal_mm = transverse_mm / base_helix_rad.cos();
        let oblique = curve.in_normal_section(Obliquity::new(base_helix_rad));
        for line_load in [100.0, 600.0, 900.0] {
            for (of, radius_mm) in [(&curve, transverse_mm), (&oblique, normal_mm)] {
                let found_mm = half_width_mm(of.at_mpa_per_mm(10.0, line_load), radius_mm, line_load);
                assert!(
                    (found_mm / hertz_mm(line_load, radius_mm, modulus_mpa) - 1.0).abs() < 1e-12,
                    "{line_load} N/mm"
                );
            }
        }
    }

    fn curve() -> FoundationCurve {
        FoundationCurve {
            position_mm: vec![4.0, 14.0, 24.0],
            mpa_per_mm: vec![9e5, 5e5, 6e5],
            load_exponent: vec![0.5, 0.4, 0.0],
            reference_line_load_n_per_mm: 600.0,
        }
    }

    /// K/H between the points of a curve and beyond its ends; at its points and reference load the values themselves.
    #[test]
    fn ver_a_curve_passes_through_its_points() {
        let curve = curve();
        for (position, k) in [(4.0, 9e5), (14.0, 5e5), (24.0, 6e5), (1.0, 9e5), (30.0, 6e5)] {
            assert!((curve.at_mpa_per_mm(position, 600.0) / k - 1.0).abs() < 1e-12, "{position}");
        }
        assert!((curve.at_mpa_per_mm(9.0, 600.0) / (9e5 * 5e5_f64).sqrt() - 1.0).abs() < 1e-12);
        // m = 0.45 halfway: a quarter of the load, stiffer by 4^0.45.
        assert!((curve.at_mpa_per_mm(9.0, 150.0) / (9e5 * 5e5_f64).sqrt() / 4f64.powf(0.45) - 1.0).abs() < 1e-12);
        assert!((curve.at_mpa_per_mm(24.0, 1.0) / 6e5 - 1.0).abs() < 1e-12);
    }

    /// The closed form of the load is what K/H at that load gives, and its stiffness the derivative.
    #[test]
    fn ver_the_load_of_softening_springs_needs_no_iteration() {
        for position in [4.0, 9.0, 20.0, 24.0] {
            let stiffness = curve().springs_at(position);
            // A parabola of radius R penetrated by δ: U = (4/3) δ √(2Rδ), U' = 2 √(2Rδ).
            let [((load, rise), half_width), ((more, _), _), ((less, _), _)] =
                [4e-3, 4e-3 + 1e-8, 4e-3 - 1e-8].map(|depth: f64| {
                    let half_width: f64 = (2.0 * 8.4 * depth).sqrt();
                    (stiffness.load_and_stiffness(4.0 / 3.0 * depth * half_width, 2.0 * half_width), half_width)
                });
            let k = stiffness.mpa_per_mm(load);
            assert!((load / (k * 4.0 / 3.0 * 4e-3 * half_width) - 1.0).abs() < 1e-12);
            assert!((stiffness.half_width_mm(8.4, load) / half_width - 1.0).abs() < 1e-12);
            let slope = (more - less) / 2e-8;
            assert!((rise / slope - 1.0).abs() < 1e-6);
        }
    }
}
