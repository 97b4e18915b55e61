//! Involute of a base circle.
//!
//! The end of a taut string unwound from the base circle (radius r_b) describes the involute; its free length ρ is the radius of
//! curvature of the flank, and the coordinate along it:
//!
//! ```text
//! r² = r_b² + ρ²          radius of the flank point
//! φ  = ρ / r_b            roll angle
//! α  = atan(ρ / r_b)      transverse pressure angle at the point
//! s  = ρ² / (2 r_b)       arc length from the base circle
//! ```
//!
//! On an internal gear r_b, r, ρ and s are negative, with the number of teeth (sign convention of DIN 3960): the same formulas hold, and ρ, r and s
//! increase towards the tip on both.
//!
//! Source: ISO 21771, section 4.

/// Involute function inv α = tan α − α, the polar angle of the involute.
pub fn inv(alpha_rad: f64) -> f64 {
    alpha_rad.tan() - alpha_rad
}

/// Inverse involute function of `value` (≥ 0), by Newton's method from a series; exact to round-off.
pub fn inverse_inv(value: f64) -> f64 {
    if value <= 0.0 {
        return 0.0;
    }
    // inv α ≈ α³/3 for small α; for large ones α → π/2 and tan α = value + α.
    let mut alpha = if value < 0.5 { (3.0 * value).cbrt() / (1.0 + 0.5 * value) } else { (value + 1.2).atan() };
    for _ in 0..60 {
        // d(inv α)/dα = tan² α
        let step = (inv(alpha) - value) / alpha.tan().powi(2);
        alpha = (alpha - step).clamp(0.5 * alpha, 0.5 * (alpha + std::f64::consts::FRAC_PI_2));
        if step.abs() <= 1e-16 + 4.0 * f64::EPSILON * alpha {
            break;
        }
    }
    alpha
}

/// Involute of a base circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Involute {
    /// Base radius r_b in mm; negative on an internal gear, as all radii.
    pub base_radius_mm: f64,
}

impl Involute {
    /// Radius of the point with radius of curvature `rho_mm`.
    pub fn radius_mm(&self, rho_mm: f64) -> f64 {
        self.signed(self.base_radius_mm.hypot(rho_mm))
    }

    /// Length with the sign of the radii of the gear.
    pub fn signed(&self, length_mm: f64) -> f64 {
        length_mm.copysign(self.base_radius_mm)
    }

    /// Radius of curvature `rho_mm`, or 0 where it is beyond the base circle.
    pub fn on_flank_mm(&self, rho_mm: f64) -> f64 {
        self.signed((self.signed(1.0) * rho_mm).max(0.0))
    }

    /// Radius of curvature at `radius_mm`, of either sign; 0 on the base circle and inside it.
    pub fn curvature_radius_mm(&self, radius_mm: f64) -> f64 {
        let (radius, base) = (radius_mm.abs(), self.base_radius_mm.abs());
        self.signed(((radius - base).max(0.0) * (radius + base)).sqrt())
    }

    /// Transverse pressure angle at the point with radius of curvature `rho_mm`.
    pub fn pressure_angle_rad(&self, rho_mm: f64) -> f64 {
        (rho_mm / self.base_radius_mm).atan()
    }

    /// Roll angle of the point with radius of curvature `rho_mm`.
    pub fn roll_angle_rad(&self, rho_mm: f64) -> f64 {
        rho_mm / self.base_radius_mm
    }

    /// Arc length from the base circle.
    pub fn arc_mm(&self, rho_mm: f64) -> f64 {
        rho_mm * rho_mm / (2.0 * self.base_radius_mm)
    }

    /// Radius of curvature at the arc length `arc_mm` from the base circle; 0 inside it.
    pub fn rho_at_arc_mm(&self, arc_mm: f64) -> f64 {
        self.signed((2.0 * self.base_radius_mm * arc_mm).max(0.0).sqrt())
    }

    /// Flank point with radius of curvature `rho_mm` in the tangent frame of the theoretical contact point at radius of curvature
    /// `contact_rho_mm`, with the common tangent (towards the tip) as first and the inward normal as second axis.
    ///
    /// The string of the point ρ is turned by Δφ = (ρ − ξ)/r_b from the line of action:
    ///
    /// ```text
    /// along = r_b (cos Δφ − 1) + ρ sin Δφ
    /// drop  = ξ + r_b sin Δφ − ρ cos Δφ          ≈ along² / (2 ξ)
    /// ```
    pub fn in_tangent_frame(&self, rho_mm: f64, contact_rho_mm: f64) -> TangentFramePoint {
        let r_b = self.base_radius_mm;
        let (sin, cos) = ((rho_mm - contact_rho_mm) / r_b).sin_cos();
        TangentFramePoint {
            along_mm: r_b * (cos - 1.0) + rho_mm * sin,
            drop_mm: contact_rho_mm + r_b * sin - rho_mm * cos,
        }
    }

    /// Flank point at `along_mm` from the contact point, the inverse of [`Self::in_tangent_frame`] in `along`, by
    /// Newton's method; beyond the base circle, the point on it.
    pub fn at_along(&self, along_mm: f64, contact_rho_mm: f64) -> FlankPoint {
        let (r_b, sign) = (self.base_radius_mm, self.signed(1.0));
        let square = contact_rho_mm * contact_rho_mm + 2.0 * r_b * along_mm;
        let mut rho = self.signed(square.max(0.0).sqrt());
        if rho == 0.0 {
            return FlankPoint { rho_mm: 0.0, drop_mm: self.in_tangent_frame(0.0, contact_rho_mm).drop_mm };
        }
        let mut drop_mm = 0.0;
        for _ in 0..8 {
            let (sin, cos) = ((rho - contact_rho_mm) / r_b).sin_cos();
            // d along / dρ = (ρ / r_b) cos Δφ and d drop / dρ = (ρ / r_b) sin Δφ
            let step = (along_mm - r_b * (cos - 1.0) - rho * sin) * r_b / (rho * cos);
            drop_mm = contact_rho_mm + r_b * sin - rho * cos + step * rho / r_b * sin;
            rho = sign * (sign * (rho + step)).max(0.5 * sign * rho);
            // The remaining error is of the order of the square of the step.
            if step.abs() <= 1e-7 * rho.abs() {
                break;
            }
        }
        FlankPoint { rho_mm: rho, drop_mm }
    }
}

/// Flank point at a given distance along the common tangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankPoint {
    /// Radius of curvature, mm.
    pub rho_mm: f64,
    /// Distance behind the tangent, into the gear, mm.
    pub drop_mm: f64,
}

/// Flank point relative to the theoretical contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentFramePoint {
    /// Distance along the common tangent, positive towards the gear's tip, mm.
    pub along_mm: f64,
    /// Distance behind the tangent, into the gear, mm.
    pub drop_mm: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ver_inverse_inv_is_the_inverse_of_inv() {
        for k in 1..300 {
            let alpha = 0.005 * k as f64;
            let back = inverse_inv(inv(alpha));
            assert!((back - alpha).abs() < 1e-11, "{alpha} {back}");
        }
    }

    /// ISO 21771 and any table of involutes: inv 20° = 0.014904384.
    #[test]
    fn val_inv_of_20_degrees() {
        assert!((inv(20f64.to_radians()) - 0.014904383867).abs() < 1e-12);
    }

    #[test]
    fn ver_tangent_frame_and_back() {
        let flank = Involute { base_radius_mm: 33.8289 };
        for along in [-0.2, -0.05, 0.0, 0.1, 0.4] {
            let found = flank.at_along(along, 4.4723);
            let point = flank.in_tangent_frame(found.rho_mm, 4.4723);
            assert!((point.along_mm - along).abs() < 1e-13, "{along}: {point:?}");
            assert!((point.drop_mm - found.drop_mm).abs() < 1e-14, "{along}: {point:?}");
        }
        // Curvature at the contact point is 1/ξ: drop → along²/(2 ξ).
        let point = flank.in_tangent_frame(flank.at_along(1e-3, 13.97).rho_mm, 13.97);
        assert!((point.drop_mm / (1e-6 / (2.0 * 13.97)) - 1.0).abs() < 1e-3);
    }
}
