//! Materials of gears: linear elastic and isotropic.

use crate::fem::elastic::Analysis;
pub use crate::fem::elastic::Elastic;

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

/// Metals are stiffer, plastics softer, those filled with glass too, MPa.
const STIFFEST_PLASTIC_MPA: f64 = 25e3;

impl Material {
    /// Whether it is so soft that it must be a plastic.
    pub fn is_plastic(self) -> bool {
        self.young_modulus_mpa < STIFFEST_PLASTIC_MPA
    }

    /// The elastic constants alone.
    pub fn elastic(self) -> Elastic {
        Elastic { young_modulus_mpa: self.young_modulus_mpa, poisson_ratio: self.poisson_ratio }
    }
}

/// Contact modulus E* of two bodies in plane strain, MPa: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂.
///
/// Source: K. L. Johnson, *Contact Mechanics* (1985), equation 4.4.
pub fn contact_modulus_mpa(bodies: impl Into<[Elastic; 2]>) -> f64 {
    let [one, two] = bodies.into().map(|body| body.surface_compliance_per_mpa(Analysis::PlaneStrain));
    1.0 / (one + two)
}
