//! The trilinear hexahedron with enhanced assumed strain: twelve further strain modes inside the element, so that it neither locks as
//! ν → ½ nor stiffens in bending.
//!
//! As in the plane (`fem::enhanced_quad`), the strain is that of the displacements plus modes that are incompatible between elements,
//!
//! ```text
//! ε = B u + M̃ α        M̃ = (J₀/J) T₀ M(ξ)        M: ε_ξξ = ξ,  γ_ξη = ξ,  γ_ξη = η,  and likewise around;  θ = ξη, ηζ, ζξ
//! ```
//!
//! the last three an equal strain in all directions, which the bilinear part of the displacements' volume strain needs where the volume
//! is to stay. The modes have no mean, so that the patch test holds on any hexahedron, and are eliminated inside the element.
//!
//! Source: J. C. Simo and M. S. Rifai, *International Journal for Numerical Methods in Engineering* 29 (1990) 1595–1638 (nine modes);
//! J. C. Simo, F. Armero and R. L. Taylor, *Computer Methods in Applied Mechanics and Engineering* 110 (1993) 359–386 (the last three).

use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use super::Folded;
use super::hexahedron::{HexahedronKind, Shape};
use crate::elastic::Elastic;

/// Enhanced modes.
const MODES: usize = 12;
/// Degrees of freedom of the nodes.
const DOFS: usize = 24;

/// An element with its enhanced modes expressed through the displacements of its nodes.
#[derive(Debug, Clone)]
pub(super) struct EnhancedHexahedron<'a> {
    nodes_mm: &'a [Vector3<f64>],
    /// J₀⁻¹ and J₀ at the centre.
    centre: (Matrix3<f64>, f64),
    /// −K_αα⁻¹ K_αu.
    modes: SMatrix<f64, MODES, DOFS>,
    /// K, N/mm.
    pub stiffness: SMatrix<f64, DOFS, DOFS>,
}

impl<'a> EnhancedHexahedron<'a> {
    /// The element on eight nodes.
    pub(super) fn new(nodes_mm: &'a [Vector3<f64>], material: &Elastic) -> Result<Self, Folded> {
        let jacobian = Shape::at(HexahedronKind::Eight, [0.0; 3]).jacobian(nodes_mm);
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
        let (b, determinant) = self.displacement_part(&Shape::at(HexahedronKind::Eight, at));
        let strain = b + self.enhanced_part(at, determinant) * self.modes;
        material.stiffness_in_space_mpa() * (strain * displacement_mm)
    }

    /// B and J.
    fn displacement_part(&self, shape: &Shape) -> (SMatrix<f64, 6, DOFS>, f64) {
        let (gradients, determinant) = shape.gradients(self.nodes_mm);
        let mut b = SMatrix::<f64, 6, DOFS>::zeros();
        for (a, gradient) in gradients.iter().take(8).enumerate() {
            b.fixed_view_mut::<6, 3>(0, 3 * a).copy_from(&super::strain_block(gradient));
        }
        (b, determinant)
    }

    /// M̃, one column for each mode.
    fn enhanced_part(&self, [xi, eta, zeta]: [f64; 3], determinant: f64) -> SMatrix<f64, 6, MODES> {
        let (inverse, centre_determinant) = &self.centre;
        let scale = centre_determinant / determinant;
        let mut m = SMatrix::<f64, 6, MODES>::zeros();
        let mut column = 0;
        let mut add = |strain: Matrix3<f64>| {
            let engineering = Vector6::new(
                strain.m11,
                strain.m22,
                strain.m33,
                strain.m12 + strain.m21,
                strain.m23 + strain.m32,
                strain.m31 + strain.m13,
            );
            m.set_column(column, &(engineering * scale));
            column += 1;
        };
        let at = [xi, eta, zeta];
        for k in 0..3 {
            let next = (k + 1) % 3;
            let covariant = |i: usize, j: usize, value: f64| {
                let mut e = Matrix3::zeros();
                e[(i, j)] += 0.5 * value;
                e[(j, i)] += 0.5 * value;
                inverse.transpose() * e * inverse
            };
            add(covariant(k, k, at[k]));
            add(covariant(k, next, at[k]));
            add(covariant(k, next, at[next]));
            add(Matrix3::identity() * (at[k] * at[next]));
        }
        m
    }
}

impl Elastic {
    /// D for (x, y, z, xy, yz, zx) with engineering shear strains, MPa.
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
