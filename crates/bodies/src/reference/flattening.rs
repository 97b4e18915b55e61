//! Approach of two bodies in Hertzian line contact by the flattening of their surfaces.
//!
//! In plane strain the approach of two half-planes is unbounded, so it is measured between points at depths t1, t2
//! below the surface. Under a Hertz pressure of half-width a and line load w each body contributes
//!
//! ```text
//! δ = (2 w / π) (1 − ν²)/E · [ asinh(t/a) − ν/(1 − ν) · t / (√(t² + a²) + t) ]
//! ```
//!
//! exactly; for t ≫ a it is the usual logarithm.
//!
//! Source: C. Weber and K. Banaschek (1953), section on flattening; K. L. Johnson, *Contact Mechanics* (1985),
//! section 5.6, for the integrated stresses on the axis.

use super::hertz_line::HertzLine;
use gearwear_fem::elastic::Elastic;

/// Half-plane in plane strain with a reference point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfPlane {
    /// Elastic constants E and ν.
    pub elastic: Elastic,
    /// Depth t of the reference point, mm.
    pub depth_mm: f64,
}

/// Flattening of both bodies of a Hertzian line contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flattening {
    /// Contact.
    pub contact: HertzLine,
    /// Both bodies.
    pub bodies: [HalfPlane; 2],
}

impl Flattening {
    /// Approach in mm under `line_load_n_per_mm` (≥ 0).
    pub fn approach_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.approach_and_compliance(line_load_n_per_mm).0
    }

    /// Approach in mm and its derivative with respect to the line load, mm²/N.
    ///
    /// As a ∝ √w, each body's share of dδ/dw is (2/π) (1 − ν²)/E · (β + ½ a dβ/da), with β the bracket of δ.
    pub fn approach_and_compliance(&self, line_load_n_per_mm: f64) -> (f64, f64) {
        let w = line_load_n_per_mm;
        if w <= 0.0 {
            return (0.0, f64::INFINITY);
        }
        let a = self.contact.loaded(w).half_width_mm;
        let (mut approach, mut compliance) = (0.0, 0.0);
        for body in &self.bodies {
            let (t, nu) = (body.depth_mm, body.elastic.poisson_ratio);
            let root = t.hypot(a);
            let factor = body.elastic.half_plane_mm2_per_n();
            let bracket = (t / a).asinh() - nu / (1.0 - nu) * t / (root + t);
            // a · d(bracket)/da = −t/√(t²+a²) + ν/(1−ν) · t a² / (√(t²+a²) (√(t²+a²)+t)²)
            let a_slope = -t / root + nu / (1.0 - nu) * t * a * a / (root * (root + t).powi(2));
            approach += w * factor * bracket;
            compliance += factor * (bracket + 0.5 * a_slope);
        }
        (approach, compliance)
    }

    /// Line load for the approach `approach_mm`, by Newton's method; 0 without approach.
    pub fn line_load_n_per_mm(&self, approach_mm: f64) -> f64 {
        if approach_mm <= 0.0 {
            return 0.0;
        }
        // δ(w) is concave and δ/w falls slowly: a secant at a low load is the start, and loads stay positive.
        let mut w = self.start_load(approach_mm);
        for _ in 0..60 {
            let (approach, compliance) = self.approach_and_compliance(w);
            let step = (approach_mm - approach) / compliance;
            w = (w + step).max(0.2 * w);
            if step.abs() <= 1e-14 * w {
                break;
            }
        }
        w
    }

    /// Estimated load for `approach_mm`, with the bracket of δ at t/a = 30.
    fn start_load(&self, approach_mm: f64) -> f64 {
        let compliance: f64 = self.bodies.iter().map(|body| body.elastic.half_plane_mm2_per_n()).sum();
        approach_mm / (compliance * 30f64.asinh())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fzg_c_at_the_pitch_point() -> Flattening {
        // Depths of the FZG type C teeth at C along the line of action: about half the tooth thickness.
        let elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
        let body = HalfPlane { elastic, depth_mm: 3.9 };
        let modulus = 206e3 / (1.0 - 0.09) / 2.0;
        Flattening { contact: HertzLine::new([13.9701, 20.9551], modulus).unwrap(), bodies: [body; 2] }
    }

    #[test]
    fn ver_compliance_is_the_derivative() {
        let f = fzg_c_at_the_pitch_point();
        for w in [1.0, 50.0, 637.66, 5000.0] {
            let h = 1e-4 * w;
            let slope = (f.approach_mm(w + h) - f.approach_mm(w - h)) / (2.0 * h);
            assert!((f.approach_and_compliance(w).1 / slope - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn ver_load_is_the_inverse_of_approach() {
        let f = fzg_c_at_the_pitch_point();
        for w in [1e-6, 1.0, 637.66, 2e4] {
            assert!((f.line_load_n_per_mm(f.approach_mm(w)) / w - 1.0).abs() < 1e-12);
        }
        assert_eq!(f.line_load_n_per_mm(-1.0), 0.0);
    }

    /// For t ≫ a the formula becomes the logarithm ln(2t/a) − ν/(2(1−ν)).
    #[test]
    fn ver_deep_reference_point_gives_the_logarithm() {
        let mut f = fzg_c_at_the_pitch_point();
        f.bodies.iter_mut().for_each(|b| b.depth_mm = 1e4);
        let a = f.contact.loaded(100.0).half_width_mm;
        let each = 2.0 * 100.0 / std::f64::consts::PI * 0.91 / 206e3 * ((2e4 / a).ln() - 0.3 / 1.4);
        assert!((f.approach_mm(100.0) / (2.0 * each) - 1.0).abs() < 1e-9);
    }
}
