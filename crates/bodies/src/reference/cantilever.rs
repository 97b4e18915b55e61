//! Deep cantilever under a transverse force at its end, in closed form.
//!
//! The beam lies along x from its support at 0 to its end at L, y from −h/2 to h/2; a force P per mm of thickness acts along
//! +y on the end. In plane stress, with I = h³/12,
//!
//! ```text
//! u = −P y/(6 E I) · [(6 L − 3 x) x + (2 + ν)(y² − h²/4)]
//! v =  P/(6 E I) · [3 ν y² (L − x) + (4 + 5 ν) h² x/4 + (3 L − x) x²]
//! σ_x = −P (L − x) y/I       σ_y = 0       τ_xy = P/(2 I) · (h²/4 − y²)
//! ```
//!
//! and in plane strain with E/(1 − ν²) and ν/(1 − ν) instead of E and ν. It is exact where the ends have these
//! stresses or displacements: the section at the support warps.
//!
//! Source: S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity* (1970), section 21; in this form C. E. Augarde and
//! A. J. Deeks, *Finite Elements in Analysis and Design* 44 (2008) 595–601, equations 1 to 5 (their P acts along −y).

/// Cantilever in plane strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cantilever {
    /// Length L, mm.
    pub length_mm: f64,
    /// Height h, mm.
    pub height_mm: f64,
    /// Force P along +y at the end, per mm of thickness, N/mm.
    pub force_n_per_mm: f64,
    /// Young's modulus E, MPa.
    pub young_modulus_mpa: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
}

impl Cantilever {
    /// Second moment of area I per mm of thickness, mm³.
    fn second_moment_mm3(&self) -> f64 {
        self.height_mm.powi(3) / 12.0
    }

    /// Displacement (u, v) at (x, y), mm.
    pub fn displacement_mm(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (l, h) = (self.length_mm, self.height_mm);
        let nu = self.poisson_ratio / (1.0 - self.poisson_ratio);
        let e = self.young_modulus_mpa / (1.0 - self.poisson_ratio.powi(2));
        let scale = self.force_n_per_mm / (6.0 * e * self.second_moment_mm3());
        [
            -scale * y * ((6.0 * l - 3.0 * x) * x + (2.0 + nu) * (y * y - 0.25 * h * h)),
            scale * (3.0 * nu * y * y * (l - x) + 0.25 * (4.0 + 5.0 * nu) * h * h * x + (3.0 * l - x) * x * x),
        ]
    }

    /// Stress (σ_x, σ_y, τ_xy) at (x, y), MPa.
    pub fn stress_mpa(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let i = self.second_moment_mm3();
        let (p, l, h) = (self.force_n_per_mm, self.length_mm, self.height_mm);
        [-p * (l - x) * y / i, 0.0, 0.5 * p / i * (0.25 * h * h - y * y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hooke's law of plane strain on difference quotients, which are exact for cubics up to h² times the third derivative.
    #[test]
    fn ver_displacement_and_stress_obey_hookes_law() {
        let beam = Cantilever {
            length_mm: 10.0,
            height_mm: 3.0,
            force_n_per_mm: -50.0,
            young_modulus_mpa: 206e3,
            poisson_ratio: 0.3,
        };
        const H: f64 = 1e-4;
        let (x, y) = (3.7, 0.9);
        let [[ex, dv_dx], [du_dy, ey]] = [[H, 0.0], [0.0, H]].map(|[dx, dy]| {
            let (ahead, behind) = (beam.displacement_mm([x + dx, y + dy]), beam.displacement_mm([x - dx, y - dy]));
            [0, 1].map(|i| (ahead[i] - behind[i]) / (2.0 * H))
        });
        let shear = du_dy + dv_dx;
        let (e, nu) = (beam.young_modulus_mpa, beam.poisson_ratio);
        let scale = e / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let hooke =
            [scale * ((1.0 - nu) * ex + nu * ey), scale * (nu * ex + (1.0 - nu) * ey), 0.5 * e / (1.0 + nu) * shear];
        for (own, exact) in hooke.iter().zip(beam.stress_mpa([x, y])) {
            assert!((own - exact).abs() < 1e-5, "{own} {exact}");
        }
    }
}
