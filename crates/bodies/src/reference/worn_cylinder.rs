//! Wear of a cylinder by a sliding flat that does not wear, in closed form.
//!
//! The cylinder (radius R) is pressed against the flat by a line load w and does not turn: a segment of half-width a is worn
//! off. By Archard's law with the coefficient k its area after a sliding distance s is k w s for any
//! pressure distribution, so that for rigid bodies
//!
//! ```text
//! k w s = ∫ (a² − x²)/(2R) dx = (2/3) a³/R           a³ = 1.5 R k w s
//! ```
//!
//! The contact of elastic bodies is wider. With the sum u(x) of the displacements of both surfaces, contact is x²/(2R) + h + u = δ, and at
//! the unworn edge δ = a²/(2R) + u(a). Integrated over the strip this is
//!
//! ```text
//! (2/3) a³/R = k w s + ∫ (u(x) − u(a)) dx
//! ```
//!
//! On a Winkler foundation u = p/K, which is zero at the edge, and ∫ u dx = w/K:
//!
//! ```text
//! a³ = a₀³ + 1.5 R k w s          a₀³ = 1.5 w R/K, unworn
//! ```
//!
//! On elastic half-planes the integral is c w a/(πE*), with c = 8/3 for Hertz's ellipse and c = 2 for the uniform pressure of the late
//! stage, in which the strip wears evenly. With a₀² = 4 w R/(πE*), unworn,
//!
//! ```text
//! a³ = 1.5 R k w s + (3c/8) a₀² a
//! ```
//!
//! Limits: a ≪ R, no friction.
//!
//! Source: J. F. Archard, *Contact and rubbing of flat surfaces*, J. Appl. Phys. 24 (1953) 981–988, for the law; the displacement under
//! uniform pressure: K. L. Johnson, *Contact Mechanics* (1985), section 2.5(a). The integrals are derived here.

/// Cylinder that wears under a line load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WornCylinder {
    /// Radius R, mm.
    pub radius_mm: f64,
    /// Line load w, N/mm.
    pub line_load_n_per_mm: f64,
    /// Wear coefficient k, mm²/N.
    pub coefficient_mm2_per_n: f64,
}

impl WornCylinder {
    /// Cube 1.5 R k w s of the half-width of rigid bodies, mm³.
    fn cube_mm3(&self, sliding_mm: f64) -> f64 {
        1.5 * self.radius_mm * self.worn_area_mm2(sliding_mm)
    }

    /// Worn area k w s of the section after a sliding distance.
    pub fn worn_area_mm2(&self, sliding_mm: f64) -> f64 {
        self.coefficient_mm2_per_n * self.line_load_n_per_mm * sliding_mm
    }

    /// Half-width a of rigid bodies.
    pub fn half_width_mm(&self, sliding_mm: f64) -> f64 {
        self.cube_mm3(sliding_mm).cbrt()
    }

    /// Half-width a on a Winkler foundation of stiffness K.
    pub fn half_width_on_foundation_mm(&self, sliding_mm: f64, bed_mpa_per_mm: f64) -> f64 {
        let unworn = 1.5 * self.line_load_n_per_mm * self.radius_mm / bed_mpa_per_mm;
        (unworn + self.cube_mm3(sliding_mm)).cbrt()
    }

    /// Half-width a on elastic half-planes in the late stage, with the half-width a₀ of the unworn contact: the greatest root of the cubic.
    pub fn late_half_width_mm(&self, sliding_mm: f64, unworn_half_width_mm: f64) -> f64 {
        /// Factor 3c/8 for uniform pressure.
        const UNIFORM: f64 = 0.75;
        let (cube, linear) = (self.cube_mm3(sliding_mm), UNIFORM * unworn_half_width_mm.powi(2));
        // Newton's method from above decreases to the root.
        let mut a = cube.cbrt() + linear.sqrt();
        for _ in 0..60 {
            let step = (a * a * a - linear * a - cube) / (3.0 * a * a - linear);
            a -= step;
            if step.abs() <= f64::EPSILON * a {
                break;
            }
        }
        a
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYLINDER: WornCylinder =
        WornCylinder { radius_mm: 20.0, line_load_n_per_mm: 100.0, coefficient_mm2_per_n: 1e-11 };

    /// The lost segment has the area k w s, by the midpoint rule.
    #[test]
    fn ver_the_segment_has_the_worn_area() {
        let sliding = 3e7;
        let a = CYLINDER.half_width_mm(sliding);
        const STEPS: usize = 10_000;
        let dx = 2.0 * a / STEPS as f64;
        let area: f64 = (0..STEPS)
            .map(|i| {
                let x = -a + (i as f64 + 0.5) * dx;
                (a * a - x * x) / (2.0 * CYLINDER.radius_mm) * dx
            })
            .sum();
        assert!((area / CYLINDER.worn_area_mm2(sliding) - 1.0).abs() < 1e-7);
    }

    /// c = 2 of uniform pressure: ∫ (u(x) − u(a)) dx with u of Johnson's equation 2.30a, by the midpoint rule.
    #[test]
    fn ver_displacement_under_uniform_pressure() {
        const STEPS: usize = 200_000;
        let (a, p) = (1.0_f64, 1.0);
        // −u πE*/(2p), up to a constant.
        let v = |x: f64| (a - x) * (a - x).max(f64::MIN_POSITIVE).ln() + (a + x) * (a + x).ln();
        let dx = 2.0 * a / STEPS as f64;
        let integral: f64 = (0..STEPS).map(|i| (v(a) - v(-a + (i as f64 + 0.5) * dx)) * dx).sum::<f64>() * 2.0 * p;
        // c w a with w = 2 a p.
        assert!((integral / (2.0 * (2.0 * a * p) * a) - 1.0).abs() < 1e-6, "{integral}");
    }

    /// Unworn, the foundation gives its own half-width; late, all three agree.
    #[test]
    fn ver_the_forms_agree_late() {
        let (foundation, unworn) = (5e5, 0.15);
        assert!(
            (CYLINDER.half_width_on_foundation_mm(0.0, foundation) - (1.5 * 100.0 * 20.0 / foundation).cbrt()).abs()
                < 1e-15
        );
        let sliding = 1e12;
        let rigid = CYLINDER.half_width_mm(sliding);
        for elastic in
            [CYLINDER.half_width_on_foundation_mm(sliding, foundation), CYLINDER.late_half_width_mm(sliding, unworn)]
        {
            assert!((elastic / rigid - 1.0).abs() < 1e-4 && elastic > rigid);
        }
        // The root: a³ = 1.5 R k w s + ¾ a₀² a.
        let a = CYLINDER.late_half_width_mm(1e8, unworn);
        let residual = a.powi(3) - 1.5 * 20.0 * CYLINDER.worn_area_mm2(1e8) - 0.75 * unworn.powi(2) * a;
        assert!(residual.abs() < 1e-13 * a.powi(3));
    }
}
