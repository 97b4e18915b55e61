//! Nearly conforming contact of a disc in a hole of almost the same radius, in closed form.
//!
//! Disc and plate are of one material, in plane strain, without friction; the load Q acts at the disc's centre, and ΔR is the
//! radial clearance. With ε the half-angle of contact and b = tan(ε/2), y = tan(θ/2),
//!
//! ```text
//! E* ΔR/Q   = (2 − ln(b² + 1) − 2 b⁴)/(π b² (b² + 1))                      E* = E/(1 − ν²)
//! p(θ) R/Q  = 2 √(b² − y²)/(π √(b² + 1) (1 + y²))
//!             + ln((√(b² + 1) + √(b² − y²))/(√(b² + 1) − √(b² − y²)))/(2 π b² (b² + 1))
//! ```
//!
//! For small ε this is Hertz's solution; ΔR is zero at ε ≈ 85°. Limits: infinite plate, ΔR ≪ R.
//!
//! Source: A. Persson, *On the Stress Distribution of Cylindrical Elastic Bodies in Contact*, Chalmers (1964); in this form
//! M. Ciavarella and P. Decuzzi, *Int. J. Solids Struct.* 38 (2001) 4507–4523.

use std::f64::consts::PI;

/// Contact with a given half-angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Persson {
    b: f64,
}

impl Persson {
    /// Contact from −ε to ε, 0 < ε < π.
    pub fn of_half_angle(half_angle_rad: f64) -> Self {
        Self { b: (0.5 * half_angle_rad).tan() }
    }

    /// Dimensionless clearance E* ΔR/Q for the half-angle.
    pub fn stiffness_ratio(&self) -> f64 {
        let s = self.b * self.b;
        (2.0 - (s + 1.0).ln() - 2.0 * s * s) / (PI * s * (s + 1.0))
    }

    /// Dimensionless pressure p R/Q at the angle θ; zero beyond the contact.
    pub fn pressure_ratio(&self, angle_rad: f64) -> f64 {
        let (s, y) = (self.b * self.b, (0.5 * angle_rad).tan());
        if y * y >= s {
            return 0.0;
        }
        let (root, chord) = ((s + 1.0).sqrt(), (s - y * y).sqrt());
        2.0 * chord / (PI * root * (1.0 + y * y)) + ((root + chord) / (root - chord)).ln() / (2.0 * PI * s * (s + 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pressure carries the load: ∫ p cos θ R dθ = Q.
    #[test]
    fn ver_pressure_carries_the_load() {
        for half_angle in [0.1_f64, 0.4, 1.0] {
            let persson = Persson::of_half_angle(half_angle);
            const STEPS: usize = 20_000;
            let sum: f64 = (0..STEPS)
                .map(|k| {
                    // θ = ε sin t takes the root out of the ends.
                    let t = ((k as f64 + 0.5) / STEPS as f64 - 0.5) * PI;
                    let theta = half_angle * t.sin();
                    persson.pressure_ratio(theta) * theta.cos() * half_angle * t.cos() * PI / STEPS as f64
                })
                .sum();
            assert!((sum - 1.0).abs() < 1e-6, "{half_angle}: {sum}");
        }
    }

    /// Hertz for a small angle: a = ε R, a² = 8 Q R²/(π E* ΔR), p₀ = 2 Q/(π a).
    #[test]
    fn ver_small_angles_are_hertz() {
        let half_angle = 1e-3;
        let persson = Persson::of_half_angle(half_angle);
        assert!((persson.stiffness_ratio() * PI * half_angle.powi(2) / 8.0 - 1.0).abs() < 1e-5);
        assert!((persson.pressure_ratio(0.0) * PI * half_angle / 2.0 - 1.0).abs() < 1e-5);
    }
}
