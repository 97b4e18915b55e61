//! Trilinear hexahedron with enhanced assumed strain: twelve additional strain modes inside the element, so that it neither locks as
//! ν → ½ nor is too stiff in bending.
//!
//! As in two dimensions (`fem::enhanced_quad`), the strain is that of the displacements plus modes that are incompatible between elements,
//!
//! ```text
//! ε = B u + M̃ α        M̃ = (J₀/J) T₀ M(ξ)        M: ε_ξξ = ξ,  γ_ξη = ξ,  γ_ξη = η,  and likewise around;  θ = ξη, ηζ, ζξ
//! ```
//!
//! the last three an equal strain in all directions, which balances the bilinear part of the displacements' volume strain in incompressible
//! deformation. The modes have zero mean, so that the patch test is satisfied on any hexahedron, and are eliminated inside the element.
//!
//! Source: J. C. Simo and M. S. Rifai, *International Journal for Numerical Methods in Engineering* 29 (1990) 1595–1638 (nine modes);
//! J. C. Simo, F. Armero and R. L. Taylor, *Computer Methods in Applied Mechanics and Engineering* 110 (1993) 359–386 (the last three).

use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use super::Folded;
use super::hexahedron::{HexahedronKind, HexahedronShape};
use crate::elastic::Elastic;

/// Number of enhanced modes.
const MODES: usize = 12;
/// Degrees of freedom of the nodes.
const DOFS: usize = 24;

/// Element with its enhanced modes as functions of the displacements of its nodes.
#[derive(Debug, Clone)]
pub(super) struct EnhancedHexahedron<'a> {
    nodes_mm: &'a [Vector3<f64>],
    /// Inverse and determinant of J₀ at the centre.
    centre: (Matrix3<f64>, f64),
    /// Modes per displacement, −K_αα⁻¹ K_αu.
    modes: SMatrix<f64, MODES, DOFS>,
    /// Condensed stiffness K, N/mm.
    pub stiffness: SMatrix<f64, DOFS, DOFS>,
}

impl<'a> EnhancedHexahedron<'a> {
    /// Element on eight nodes.
    pub(super) fn new(nodes_mm: &'a [Vector3<f64>], material: &Elastic) -> Result<Self, Folded> {
        let jacobian = HexahedronShape::at(HexahedronKind::Eight, [0.0; 3]).jacobian(nodes_mm);
        let determinant = jacobian.determinant();
        let inverse = jacobian.try_inverse().filter(|_| determinant > 0.0).ok_or(Folded(determinant))?;
        let mut element =
            Self { nodes_mm, centre: (inverse, determinant), modes: SMatrix::zeros(), stiffness: SMatrix::zeros() };
        let d_mpa = material.stiffness_in_space_mpa();
        let mut coupling = SMatrix::<f64, MODES, DOFS>::zeros();
        let mut inside = SMatrix::<f64, MODES, MODES>::zeros();
        for point in HexahedronKind::Eight.rule() {
            let (b, determinant) = element.displacement_part(&point.shape);
            if determinant.is_nan() || determinant <= 0.0 {
                return Err(Folded(determinant));
            }
            let m = element.enhanced_part(point.at, determinant);
            let weighted = d_mpa * (point.weight * determinant);
            let d_b = weighted * b;
            element.stiffness += b.transpose() * d_b;
            coupling += m.transpose() * d_b;
            inside += m.transpose() * (weighted * m);
        }
        // K_αα is positive definite wherever J > 0: the modes are independent and D is positive definite.
        let factor = inside.cholesky().ok_or(Folded(determinant))?;
        element.modes = -factor.solve(&coupling);
        element.stiffness += coupling.transpose() * element.modes;
        Ok(element)
    }

    /// Stress (x, y, z, xy, yz, zx) at (ξ, η, ζ) under displacements of the nodes, MPa.
    pub(super) fn stress_mpa(
        &self,
        at: [f64; 3],
        material: &Elastic,
        displacement_mm: &SMatrix<f64, DOFS, 1>,
    ) -> Vector6<f64> {
        let (b, determinant) = self.displacement_part(&HexahedronShape::at(HexahedronKind::Eight, at));
        let strain = b + self.enhanced_part(at, determinant) * self.modes;
        material.stiffness_in_space_mpa() * (strain * displacement_mm)
    }

    /// Matrix B and determinant J.
    fn displacement_part(&self, shape: &HexahedronShape) -> (SMatrix<f64, 6, DOFS>, f64) {
        let (gradients, determinant) = shape.gradients(self.nodes_mm);
        let mut b = SMatrix::<f64, 6, DOFS>::zeros();
        for (a, gradient) in gradients.iter().take(8).enumerate() {
            b.fixed_view_mut::<6, 3>(0, 3 * a).copy_from(&super::strain_block(gradient));
        }
        (b, determinant)
    }

    /// Matrix M̃, one column for each mode.
    fn enhanced_part(&self, at: [f64; 3], determinant: f64) -> SMatrix<f64, 6, MODES> {
        let (inverse, centre_determinant) = &self.centre;
        let scale = centre_determinant / determinant;
        let modes = [0, 1, 2].map(|k| {
            let next = (k + 1) % 3;
            let [normal, first, second] = [(k, at[k]), (next, at[k]), (next, at[next])].map(|(j, value)| {
                let mut e = Matrix3::zeros();
                e[(k, j)] += 0.5 * value;
                e[(j, k)] += 0.5 * value;
                inverse.transpose() * e * inverse
            });
            [normal, first, second, Matrix3::identity() * (at[k] * at[next])]
        });
        let columns: Vec<Vector6<f64>> =
            modes.as_flattened().iter().map(|strain| engineering_strain(strain) * scale).collect();
        SMatrix::from_columns(&columns)
    }
}

/// Components (x, y, z, xy, yz, zx) of a strain tensor with engineering shear strains.
fn engineering_strain(e: &Matrix3<f64>) -> Vector6<f64> {
    Vector6::new(e.m11, e.m22, e.m33, e.m12 + e.m21, e.m23 + e.m32, e.m31 + e.m13)
}

impl Elastic {
    /// Elasticity matrix D for (x, y, z, xy, yz, zx) with engineering shear strains, MPa.
    fn stiffness_in_space_mpa(&self) -> Matrix6<f64> {
        let mu = self.shear_modulus_mpa();
        let lambda = self.bulk_modulus_mpa() - 2.0 / 3.0 * mu;
        Matrix6::from_fn(|i, j| match (i, j) {
            _ if i < 3 && j < 3 => lambda + if i == j { 2.0 * mu } else { 0.0 },
            _ if i == j => mu,
            _ => 0.0,
        })
    }
}
