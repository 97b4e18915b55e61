//! Hertzian line contact of two parallel cylinders, in closed form.
//!
//! With w the load per length, R the relative radius of curvature and E* the contact modulus,
//!
//! ```text
//! 1/R  = 1/ρ₁ + 1/ρ₂              1/E* = (1−ν₁²)/E₁ + (1−ν₂²)/E₂
//! a²   = 4 w R / (π E*)           p(x) = p₀ √(1 − x²/a²),   p₀ = 2 w / (π a)
//! ```
//!
//! Limits: elastic half-planes, smooth and frictionless, a ≪ R; on a gear tooth that fails within about a
//! half-width of the tip edge, where the `fem` surface is the reference.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), section 4.2(c).

use std::f64::consts::PI;

/// Error of a line contact.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HertzError {
    /// The surfaces do not touch along a line: flat on flat, or a hollow tighter than its partner.
    #[error("relative curvature must be positive, got {0} 1/mm")]
    RelativeCurvature(f64),
}

/// Ratio of greatest to mean pressure of the elliptic distribution.
pub const PEAK_OVER_MEAN: f64 = 4.0 / std::f64::consts::PI;

/// Line contact without load: geometry and contact modulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzLine {
    relative_radius_mm: f64,
    contact_modulus_mpa: f64,
}

/// Line contact under a load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineContact {
    /// Half-width a of the contact strip, mm.
    pub half_width_mm: f64,
    /// Greatest pressure p₀, at the centre, MPa.
    pub peak_pressure_mpa: f64,
}

impl HertzLine {
    /// Contact of two cylinders with radii `radius_mm` (negative: hollow) and contact modulus E* in MPa.
    pub fn new(radius_mm: [f64; 2], contact_modulus_mpa: f64) -> Result<Self, HertzError> {
        let curvature = 1.0 / radius_mm[0] + 1.0 / radius_mm[1];
        if curvature > 0.0 {
            Ok(Self { relative_radius_mm: 1.0 / curvature, contact_modulus_mpa })
        } else {
            Err(HertzError::RelativeCurvature(curvature))
        }
    }

    /// Contact of surfaces of relative radius of curvature R (> 0), mm, and contact modulus E*, MPa.
    pub fn of_relative_radius(relative_radius_mm: f64, contact_modulus_mpa: f64) -> Self {
        Self { relative_radius_mm, contact_modulus_mpa }
    }

    /// Relative radius of curvature R, mm.
    pub fn relative_radius_mm(&self) -> f64 {
        self.relative_radius_mm
    }

    /// Half-width and peak pressure under `line_load_n_per_mm` (w ≥ 0; zero load gives zeros).
    pub fn loaded(&self, line_load_n_per_mm: f64) -> LineContact {
        let half_width_mm =
            (4.0 * line_load_n_per_mm * self.relative_radius_mm / (PI * self.contact_modulus_mpa)).sqrt();
        // E* a / (2 R) is p₀ too, and finite where 2 w / (π a) is 0/0.
        let peak_pressure_mpa = self.contact_modulus_mpa * half_width_mm / (2.0 * self.relative_radius_mm);
        LineContact { half_width_mm, peak_pressure_mpa }
    }
}

impl LineContact {
    /// Pressure in MPa at `x_mm` from the centre; zero outside the strip.
    pub fn pressure_mpa(&self, x_mm: f64) -> f64 {
        let rest = 1.0 - (x_mm / self.half_width_mm).powi(2);
        if rest > 0.0 { self.peak_pressure_mpa * rest.sqrt() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel on steel, E = 206 GPa, ν = 0.3.
    const STEEL_MPA: f64 = 206e3 / (1.0 - 0.3 * 0.3) / 2.0;

    /// FZG type C at the pitch point, load stage 9: 302 N·m over 33.8289 mm and 14 mm; independent calculation: 1656 MPa.
    #[test]
    fn val_fzg_type_c_load_stage_9() {
        let contact = HertzLine::new([13.9701, 20.9551], STEEL_MPA).unwrap().loaded(302e3 / 33.8289 / 14.0);
        assert!((contact.peak_pressure_mpa / 1656.0 - 1.0).abs() < 5e-4, "{contact:?}");
    }

    /// The pressure carries the load: ∫ p dx = w, by the midpoint rule.
    #[test]
    fn ver_pressure_integrates_to_the_load() {
        let contact = HertzLine::new([10.0, -30.0], STEEL_MPA).unwrap().loaded(250.0);
        let (n, a) = (100_000, contact.half_width_mm);
        let dx = 2.0 * a / n as f64;
        let load: f64 = (0..n).map(|i| contact.pressure_mpa(-a + (i as f64 + 0.5) * dx) * dx).sum();
        assert!((load / 250.0 - 1.0).abs() < 1e-6, "{load}");
    }

    #[test]
    fn ver_no_load_no_pressure() {
        let contact = HertzLine::new([10.0, 10.0], STEEL_MPA).unwrap().loaded(0.0);
        assert_eq!((contact.half_width_mm, contact.pressure_mpa(0.0)), (0.0, 0.0));
    }

    #[test]
    fn hollow_tighter_than_its_partner_is_refused() {
        assert!(matches!(HertzLine::new([10.0, -9.0], STEEL_MPA), Err(HertzError::RelativeCurvature(c)) if c < 0.0));
    }
}
