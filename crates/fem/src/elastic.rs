//! Isotropic linear elasticity in the plane.
//!
//! ```text
//! plane strain   D = E/((1+ν)(1−2ν)) · [1−ν ν 0; ν 1−ν 0; 0 0 (1−2ν)/2]     σ_z = ν (σ_x + σ_y)
//! plane stress   D = E/(1−ν²)        · [1 ν 0; ν 1 0; 0 0 (1−ν)/2]          σ_z = 0
//! ```
//!
//! Source: S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity* (1970), sections 8 to 11.

use std::f64::consts::PI;

use nalgebra::Matrix3;

/// Assumption about the direction across the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Analysis {
    /// No strain across the plane: a long body, a wide gear.
    #[default]
    PlaneStrain,
    /// No stress across the plane: a thin sheet.
    PlaneStress,
    /// Half section of a body of revolution, x the radius and y the axis.
    Axisymmetric,
}

impl Analysis {
    /// Thickness of the modelled body at a place, by which lengths and areas of the plane become areas and volumes, mm: 1 in the plane, so
    /// that forces are per mm, and the circumference 2π x of a body of revolution, whose forces are those of the whole body.
    pub fn thickness_mm(self, x_mm: f64) -> f64 {
        match self {
            Analysis::PlaneStrain | Analysis::PlaneStress => 1.0,
            Analysis::Axisymmetric => 2.0 * PI * x_mm,
        }
    }

    /// Contact modulus E* of two bodies, MPa: 1/E* = Σ (1 − ν²)/E, in plane stress Σ 1/E.
    ///
    /// Source: K. L. Johnson, *Contact Mechanics* (1985), section 4.1.
    pub fn contact_modulus_mpa(self, bodies: [Elastic; 2]) -> f64 {
        let [one, two] = bodies.map(|body| body.surface_compliance_per_mpa(self));
        1.0 / (one + two)
    }
}

/// Isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Young's modulus E > 0, MPa.
    pub young_modulus_mpa: f64,
    /// Poisson's ratio ν, −1 < ν < 0.5.
    pub poisson_ratio: f64,
}

impl Elastic {
    /// Elasticity matrix D with σ = D ε for σ = (σ_x, σ_y, τ_xy) and ε = (ε_x, ε_y, γ_xy), MPa; of a body of revolution without its
    /// hoop strain.
    pub fn stiffness_mpa(&self, analysis: Analysis) -> Matrix3<f64> {
        let (e, nu) = (self.young_modulus_mpa, self.poisson_ratio);
        match analysis {
            Analysis::PlaneStrain | Analysis::Axisymmetric => {
                let scale = e / ((1.0 + nu) * (1.0 - 2.0 * nu));
                Matrix3::new(1.0 - nu, nu, 0.0, nu, 1.0 - nu, 0.0, 0.0, 0.0, 0.5 - nu) * scale
            }
            Analysis::PlaneStress => {
                Matrix3::new(1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu)) * (e / (1.0 - nu * nu))
            }
        }
    }

    /// Surface compliance, 1/MPa: (1 − ν²)/E, in plane stress 1/E.
    pub fn surface_compliance_per_mpa(&self, analysis: Analysis) -> f64 {
        match analysis {
            Analysis::PlaneStrain | Analysis::Axisymmetric => {
                (1.0 - self.poisson_ratio.powi(2)) / self.young_modulus_mpa
            }
            Analysis::PlaneStress => 1.0 / self.young_modulus_mpa,
        }
    }

    /// Factor 2 (1 − ν²)/(π E) of a half-plane's displacements under a line load in plane strain, mm²/N.
    pub fn half_plane_mm2_per_n(&self) -> f64 {
        2.0 / PI * self.surface_compliance_per_mpa(Analysis::PlaneStrain)
    }

    /// Bulk modulus κ = E/(3 (1 − 2ν)), MPa.
    pub fn bulk_modulus_mpa(&self) -> f64 {
        self.young_modulus_mpa / (3.0 * (1.0 - 2.0 * self.poisson_ratio))
    }

    /// Shear modulus μ = E/(2 (1 + ν)), MPa.
    pub fn shear_modulus_mpa(&self) -> f64 {
        0.5 * self.young_modulus_mpa / (1.0 + self.poisson_ratio)
    }

    /// Deviatoric part of D in plane strain, D − κ m mᵀ with m = (1, 1, 0), MPa.
    pub fn deviatoric_mpa(&self) -> Matrix3<f64> {
        let mu = self.shear_modulus_mpa();
        Matrix3::new(4.0, -2.0, 0.0, -2.0, 4.0, 0.0, 0.0, 0.0, 3.0) * (mu / 3.0)
    }

    /// Stress σ_z across the plane without strain or stress there, from the stresses in the plane, MPa.
    pub fn across_mpa(&self, analysis: Analysis, sigma_x_mpa: f64, sigma_y_mpa: f64) -> f64 {
        match analysis {
            Analysis::PlaneStrain | Analysis::Axisymmetric => self.poisson_ratio * (sigma_x_mpa + sigma_y_mpa),
            Analysis::PlaneStress => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// D = D_dev + κ m mᵀ in plane strain, and D_dev gives no mean stress: σ_x + σ_y + σ_z = 0 with σ_z = −2μ/3 (ε_x + ε_y).
    #[test]
    fn ver_deviatoric_and_volumetric_parts_make_the_whole() {
        let material = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
        let volume = Matrix3::new(1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0);
        let deviatoric = material.deviatoric_mpa();
        let whole = deviatoric + volume * material.bulk_modulus_mpa();
        let difference = whole - material.stiffness_mpa(Analysis::PlaneStrain);
        assert!(difference.amax() < 1e-15 * whole.amax() * 4.0, "{difference}");
        let across = -2.0 / 3.0 * material.shear_modulus_mpa();
        assert!((deviatoric.m11 + deviatoric.m21 + across).abs() < 1e-10, "{deviatoric}");
    }
}
