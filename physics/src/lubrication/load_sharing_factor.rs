//! Part of the load at a place of the path of contact by the standards, without a contact analysis.
//!
//! Unmodified spur gears of accuracy 7 or better: a third at A, two thirds up to B, the whole from B to D, and the same backwards to E.
//! Teeth of helical gears in contact along oblique lines: 1/ε_α everywhere, times a buttressing factor at the ends,
//!
//! ```text
//! X_but = 1.3 (ε_β ≥ 1),  1 + 0.3 ε_β (ε_β < 1)   at A and E, linear to 1 over |Γ − Γ_A| = 0.2 sin β_b
//! ```
//!
//! Γ is the place on the line of action from C in units of T₁C. ISO/TS 6336-22 takes the factor of spur gears times X_but up to
//! ε_β = 0.8, that of helical gears from 1.2 on, and what lies between in proportion.
//!
//! Above ε_α = 2 the standards have no factor; all pairs in mesh then share the load evenly here, for means over the path alone
//! ([`SharingGeometry::is_of_standard`]).
//!
//! Sources: ISO/TS 6336-22 (first ISO/TR 15144-1:2014), clause 8; ISO/TS 6336-20 (first ISO/TR 13989-1:2000), clause 8. Method B.

use super::loss::pairs_in_mesh;

/// Geometry that the factor depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharingGeometry {
    /// A, B, C, D, E by the pinion's radius of curvature, mm.
    pub points_mm: [f64; 5],
    /// ε_β.
    pub overlap_ratio: f64,
    /// β_b, rad.
    pub base_helix_angle_rad: f64,
}

impl SharingGeometry {
    /// ε_α.
    pub fn contact_ratio(&self) -> f64 {
        let [a, b, _, _, e] = self.points_mm;
        (e - a) / (e - b)
    }

    /// Whether the standards have a factor for this contact ratio: below 2.
    pub fn is_of_standard(&self) -> bool {
        self.contact_ratio() < 2.0
    }

    fn spur(&self, position_mm: f64) -> f64 {
        let [a, b, c, d, e] = self.points_mm;
        if !self.is_of_standard() {
            let [after, before, from_pitch_point] = [e - c, c - a, position_mm - c].map(|mm| mm / (e - b));
            return 1.0 / pairs_in_mesh([after, before], from_pitch_point);
        }
        // Below ε_α = 2 two pairs share the load before B and after D.
        if position_mm < b {
            (1.0 + (position_mm - a) / (b - a)) / 3.0
        } else if position_mm > d {
            (1.0 + (e - position_mm) / (e - d)) / 3.0
        } else {
            1.0
        }
    }

    fn buttressing(&self, position_mm: f64) -> f64 {
        if self.overlap_ratio == 0.0 {
            return 1.0;
        }
        let [a, _, c, _, e] = self.points_mm;
        let greatest = 1.0 + 0.3 * self.overlap_ratio.min(1.0);
        let reach_mm = 0.2 * self.base_helix_angle_rad.sin().abs() * c;
        let inside_mm = (position_mm - a).min(e - position_mm).max(0.0);
        (greatest - (greatest - 1.0) * inside_mm / reach_mm).max(1.0)
    }

    /// X_Y of Method B.
    pub fn factor(&self, position_mm: f64) -> f64 {
        let oblique = ((self.overlap_ratio - 0.8) / 0.4).clamp(0.0, 1.0);
        let of_lines = 1.0 / self.contact_ratio();
        self.buttressing(position_mm) * ((1.0 - oblique) * self.spur(position_mm) + oblique * of_lines)
    }
}
