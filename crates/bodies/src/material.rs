//! Linear elastic, isotropic materials of gears.

use gearwear_fem::elastic::Analysis;
pub use gearwear_fem::elastic::Elastic;

/// Linear elastic, isotropic material of one gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus E, MPa.
    pub young_modulus_mpa: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
    /// Density, kg/m³; used for the worn mass.
    pub density_kg_per_m3: f64,
}

/// Young's modulus above that of all plastics, glass-filled ones included, and below that of metals, MPa.
const STIFFEST_PLASTIC_MPA: f64 = 25e3;

impl Material {
    /// Whether the material is a plastic, by its Young's modulus.
    pub fn is_plastic(self) -> bool {
        self.young_modulus_mpa < STIFFEST_PLASTIC_MPA
    }

    /// Elastic constants.
    pub fn elastic(self) -> Elastic {
        Elastic { young_modulus_mpa: self.young_modulus_mpa, poisson_ratio: self.poisson_ratio }
    }
}

/// Contact modulus E* of two gears in plane strain, MPa.
pub fn contact_modulus_mpa(bodies: impl Into<[Elastic; 2]>) -> f64 {
    Analysis::PlaneStrain.contact_modulus_mpa(bodies.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel on aluminium, 1/E* = (1 − 0.3²)/206 + (1 − 0.33²)/70 per GPa, by hand; in plane stress 1/206 + 1/70.
    #[test]
    fn ver_contact_modulus_of_unlike_bodies() {
        let bodies = [(206e3, 0.3), (70e3, 0.33)]
            .map(|(young_modulus_mpa, poisson_ratio)| Elastic { young_modulus_mpa, poisson_ratio });
        let per_gpa = 0.004_417_476 + 0.012_73;
        assert!((contact_modulus_mpa(bodies) * per_gpa / 1e3 - 1.0).abs() < 1e-6);
        let in_plane_stress = Analysis::PlaneStress.contact_modulus_mpa(bodies);
        assert!((in_plane_stress - 206e3 * 70e3 / 276e3).abs() < 1e-6);
    }
}
