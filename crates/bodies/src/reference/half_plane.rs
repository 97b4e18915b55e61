//! Displacement of two elastic half-planes under pressure, in plane strain.
//!
//! The displacement of a half-plane under a line load is unbounded, so it is measured relative to the point
//! at depth t below the surface point, as in [`super::flattening`]. A unit line load at distance x then lowers the surface by
//!
//! ```text
//! G(x) = 2 (1 − ν²)/(π E) · [ ln(√(x² + t²)/|x|) − t²/(2 (1 − ν)(x² + t²)) ]
//! ```
//!
//! and the integral has the closed form
//!
//! ```text
//! ∫ G dx = 2 (1 − ν²)/(π E) · [ x ln(√(x² + t²)/|x|) + t (1 − 2ν)/(2 (1 − ν)) · atan(x/t) ]
//! ```
//!
//! so that a cell of uniform pressure needs two evaluations. The integral of G over Hertz's ellipse is, at its middle, the flattening
//! of Weber and Banaschek. The Fourier transform of G, (1 − e^{−kt} (1 + kt/(2(1−ν))))/k but for the factor, is positive for
//! every ν < ½: the work of a pressure is positive.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), sections 2.3 and 2.5.

use super::flattening::HalfPlane;

/// Sum of the displacements of two half-planes at distance `k` · `width_mm` from the centre of a cell of that width under
/// unit pressure, mm/MPa, for k = 0 … `count` − 1.
pub fn cell_compliance_mm_per_mpa(bodies: &[HalfPlane; 2], width_mm: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| cell_compliance_at_mm_per_mpa(bodies, width_mm, k as f64 * width_mm)).collect()
}

/// Sum of the displacements of two half-planes at a distance from the centre of a cell under unit pressure, mm/MPa.
pub fn cell_compliance_at_mm_per_mpa(bodies: &[HalfPlane; 2], width_mm: f64, distance_mm: f64) -> f64 {
    let [to, from] =
        [distance_mm + 0.5 * width_mm, distance_mm - 0.5 * width_mm].map(|x_mm| line_loads_primitive(bodies, x_mm));
    to - from
}

/// Sum of the integrals ∫ G from 0 to `x_mm` for two bodies, mm² per N/mm.
pub fn line_loads_primitive(bodies: &[HalfPlane; 2], x_mm: f64) -> f64 {
    bodies.iter().map(|body| line_load_primitive(body, x_mm)).sum()
}

/// Integral ∫ G from 0 to `x_mm` for one body, mm² per N/mm.
fn line_load_primitive(body: &HalfPlane, x_mm: f64) -> f64 {
    let (t, nu) = (body.depth_mm, body.elastic.poisson_ratio);
    let logarithm = if x_mm == 0.0 { 0.0 } else { 0.5 * x_mm * (1.0 + (t / x_mm).powi(2)).ln() };
    body.elastic.half_plane_mm2_per_n() * (logarithm + t * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)) * (x_mm / t).atan())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{flattening::Flattening, hertz_line::HertzLine};
    use gearwear_fem::elastic::{Analysis, Elastic};

    const BODIES: [HalfPlane; 2] = [
        HalfPlane { elastic: Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 }, depth_mm: 3.9 },
        HalfPlane { elastic: Elastic { young_modulus_mpa: 70e3, poisson_ratio: 0.33 }, depth_mm: 2.1 },
    ];

    /// The displacement of the middle under Hertz's ellipse is the closed-form flattening, with 4000 cells of the ellipse's pressure.
    #[test]
    fn ver_hertzs_ellipse_yields_the_closed_form_flattening() {
        let modulus = Analysis::PlaneStrain.contact_modulus_mpa(BODIES.map(|body| body.elastic));
        let hertz = Flattening { contact: HertzLine::new([13.97, 20.96], modulus).unwrap(), bodies: BODIES };
        let strip = hertz.contact.loaded(637.66);
        let half_cells = 2000;
        let width = 2.0 * strip.half_width_mm / (2 * half_cells + 1) as f64;
        let row = cell_compliance_mm_per_mpa(&BODIES, width, half_cells + 1);
        let parts = row.iter().enumerate().map(|(k, compliance)| compliance * strip.pressure_mpa(k as f64 * width));
        let yielded = 2.0 * parts.sum::<f64>() - row[0] * strip.pressure_mpa(0.0);
        let error = yielded / hertz.approach_mm(637.66) - 1.0;
        assert!(error.abs() < 1e-6, "{error:e}");
    }

    /// A line load far away or a cell of it: the kernel itself, by the midpoint rule.
    #[test]
    fn ver_a_distant_cell_is_a_line_load() {
        let (width, k) = (1e-3, 700);
        let cell = cell_compliance_mm_per_mpa(&BODIES, width, k + 1)[k];
        let kernel: f64 = BODIES
            .iter()
            .map(|b| {
                let (x, t, nu) = (k as f64 * width, b.depth_mm, b.elastic.poisson_ratio);
                let bracket = (x.hypot(t) / x).ln() - t * t / (2.0 * (1.0 - nu) * (x * x + t * t));
                2.0 * (1.0 - nu * nu) / (std::f64::consts::PI * b.elastic.young_modulus_mpa) * bracket
            })
            .sum();
        assert!((cell / (kernel * width) - 1.0).abs() < 1e-6);
    }
}
