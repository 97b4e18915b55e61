//! Lamé's thick cylinder, a long tube under internal and external pressure, in closed form.
//!
//! With inner radius a and outer radius b, in plane strain,
//!
//! ```text
//! σ_r = A − B/r²       σ_θ = A + B/r²       A = (p_i a² − p_o b²)/(b² − a²)       B = (p_i − p_o) a² b²/(b² − a²)
//! u_r = (1 + ν)/E · [(1 − 2ν) A r + B/r]
//! ```
//!
//! As ν → ½ the first term of u_r vanishes and the displacement remains finite, which is a test for locking.
//!
//! Source: S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity* (1970), section 28.

/// Tube of one material under pressure in plane strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LameCylinder {
    /// Inner radius a, mm.
    pub inner_radius_mm: f64,
    /// Outer radius b > a, mm.
    pub outer_radius_mm: f64,
    /// Internal pressure p_i, MPa.
    pub inner_pressure_mpa: f64,
    /// External pressure p_o, MPa.
    pub outer_pressure_mpa: f64,
    /// Young's modulus E, MPa.
    pub young_modulus_mpa: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
}

impl LameCylinder {
    /// Constants A in MPa and B in N.
    fn constants(&self) -> (f64, f64) {
        let (a2, b2) = (self.inner_radius_mm.powi(2), self.outer_radius_mm.powi(2));
        let (p_i, p_o) = (self.inner_pressure_mpa, self.outer_pressure_mpa);
        ((p_i * a2 - p_o * b2) / (b2 - a2), (p_i - p_o) * a2 * b2 / (b2 - a2))
    }

    /// Radial displacement u_r at `radius_mm`, positive outwards, mm.
    pub fn radial_displacement_mm(&self, radius_mm: f64) -> f64 {
        let (a, b) = self.constants();
        let nu = self.poisson_ratio;
        (1.0 + nu) / self.young_modulus_mpa * ((1.0 - 2.0 * nu) * a * radius_mm + b / radius_mm)
    }

    /// Radial stress σ_r at `radius_mm`, MPa.
    pub fn radial_stress_mpa(&self, radius_mm: f64) -> f64 {
        let (a, b) = self.constants();
        a - b / radius_mm.powi(2)
    }

    /// Hoop stress σ_θ at `radius_mm`, MPa.
    pub fn hoop_stress_mpa(&self, radius_mm: f64) -> f64 {
        let (a, b) = self.constants();
        a + b / radius_mm.powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TUBE: LameCylinder = LameCylinder {
        inner_radius_mm: 2.0,
        outer_radius_mm: 5.0,
        inner_pressure_mpa: 90.0,
        outer_pressure_mpa: 20.0,
        young_modulus_mpa: 206e3,
        poisson_ratio: 0.3,
    };

    #[test]
    fn ver_pressures_are_met_at_both_surfaces() {
        assert!((TUBE.radial_stress_mpa(2.0) + 90.0).abs() < 1e-12);
        assert!((TUBE.radial_stress_mpa(5.0) + 20.0).abs() < 1e-12);
    }

    /// Hooke's law in plane strain: ε_θ = u/r and ε_r = du/dr from the stresses; the difference quotient is exact to 1e-9.
    #[test]
    fn ver_displacement_and_stress_obey_hookes_law() {
        let (e, nu, r, h) = (TUBE.young_modulus_mpa, TUBE.poisson_ratio, 3.1, 1e-4);
        let (radial, hoop) = (TUBE.radial_stress_mpa(r), TUBE.hoop_stress_mpa(r));
        let [hoop_strain, radial_strain] =
            [(hoop, radial), (radial, hoop)].map(|(along, across)| (1.0 + nu) / e * ((1.0 - nu) * along - nu * across));
        let slope = (TUBE.radial_displacement_mm(r + h) - TUBE.radial_displacement_mm(r - h)) / (2.0 * h);
        assert!((hoop_strain / (TUBE.radial_displacement_mm(r) / r) - 1.0).abs() < 1e-12);
        assert!((radial_strain / slope - 1.0).abs() < 1e-7);
    }
}
