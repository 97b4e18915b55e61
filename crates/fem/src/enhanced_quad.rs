//! Bilinear quadrilateral with enhanced assumed strain: four additional strain modes inside the element, so that it
//! neither locks as ν → ½ nor is too stiff in bending.
//!
//! The strain is that of the displacements plus modes that are incompatible between elements,
//!
//! ```text
//! ε = B u + M̃ α        M̃ = (J₀/J) T₀ M(ξ)        M: ε_ξξ = ξ,  ε_ηη = η,  γ_ξη = ξ,  γ_ξη = η
//! ```
//!
//! T₀ transforms covariant components on the reference cell to the plane with the Jacobian J₀ at the centre,
//! ε = J₀⁻ᵀ E J₀⁻¹. Then ∫ M̃ dA = 0, so that constant stresses do no work on the modes and the patch test is satisfied on any
//! quadrilateral. The modes are eliminated inside the element:
//!
//! ```text
//! K = K_uu − K_uα K_αα⁻¹ K_αu        α = −K_αα⁻¹ K_αu u
//! ```
//!
//! Source: J. C. Simo and M. S. Rifai, *International Journal for Numerical Methods in Engineering* 29 (1990) 1595–1638,
//! sections 3 and 4 (the element with four modes equals the modified incompatible modes of Taylor, Beresford and Wilson).

use nalgebra::{Matrix2, Matrix3, Matrix4, SMatrix, Vector2, Vector3};

use super::element::{ElementMatrix, Fold, least_determinant_mm2};
use super::quadrature::rule;
use super::shape::Shape;
use super::solid::ElementKind;

/// Element with its enhanced modes as functions of the displacements of its nodes.
#[derive(Debug, Clone)]
pub(super) struct EnhancedQuad {
    nodes_mm: [Vector2<f64>; 4],
    /// Inverse and determinant of J₀ at the centre.
    centre: (Matrix2<f64>, f64),
    /// Modes per displacement, −K_αα⁻¹ K_αu.
    modes: SMatrix<f64, 4, 8>,
    stiffness: SMatrix<f64, 8, 8>,
}

impl EnhancedQuad {
    /// Element on four nodes of a material with elasticity matrix D.
    pub(super) fn new(nodes_mm: &[Vector2<f64>], d_mpa: &Matrix3<f64>) -> Result<Self, Fold> {
        let least_mm2 = least_determinant_mm2(nodes_mm);
        let middle = Shape::at(ElementKind::Quad4, [0.0, 0.0]);
        let jacobian = middle.jacobian(nodes_mm);
        let determinant_mm2 = jacobian.determinant();
        let fold_at_centre = Fold { at_mm: middle.point(nodes_mm), determinant_mm2 };
        let inverse = jacobian.try_inverse().filter(|_| determinant_mm2 > least_mm2).ok_or(fold_at_centre)?;
        let mut element = Self {
            nodes_mm: [nodes_mm[0], nodes_mm[1], nodes_mm[2], nodes_mm[3]],
            centre: (inverse, determinant_mm2),
            modes: SMatrix::zeros(),
            stiffness: SMatrix::zeros(),
        };
        let mut coupling = SMatrix::<f64, 4, 8>::zeros();
        let mut inside = Matrix4::zeros();
        for point in &rule(ElementKind::Quad4).points {
            let (b, determinant) = element.displacement_part(&point.shape);
            if determinant.is_nan() || determinant <= least_mm2 {
                return Err(Fold { at_mm: point.shape.point(nodes_mm), determinant_mm2: determinant });
            }
            let m = element.enhanced_part(point.at, determinant);
            let weighted = d_mpa * (point.weight * determinant);
            let d_b = weighted * b;
            element.stiffness += b.transpose() * d_b;
            coupling += m.transpose() * d_b;
            inside += m.transpose() * (weighted * m);
        }
        // K_αα is positive definite wherever J > 0: the modes are independent and D is positive definite.
        let factor = inside.cholesky().ok_or(fold_at_centre)?;
        element.modes = -factor.solve(&coupling);
        element.stiffness += coupling.transpose() * element.modes;
        Ok(element)
    }

    /// Writes the condensed stiffness to `out`.
    pub(super) fn write_stiffness(&self, out: &mut ElementMatrix) {
        // The condensed stiffness is symmetric but for rounding: the lower half is used.
        for (i, row) in out.iter_mut().enumerate().take(8) {
            for (k, value) in row.iter_mut().enumerate().take(8) {
                *value = self.stiffness[(i.max(k), i.min(k))];
            }
        }
    }

    /// Strain (ε_x, ε_y, γ_xy) at (ξ, η) per displacement of the nodes, 1/mm.
    pub(super) fn strain_matrix(&self, at: [f64; 2]) -> SMatrix<f64, 3, 8> {
        let (b, determinant) = self.displacement_part(&Shape::at(ElementKind::Quad4, at));
        b + self.enhanced_part(at, determinant) * self.modes
    }

    /// Matrix B and determinant J.
    fn displacement_part(&self, shape: &Shape) -> (SMatrix<f64, 3, 8>, f64) {
        let (gradients, determinant) = shape.gradients(&self.nodes_mm);
        let mut b = SMatrix::<f64, 3, 8>::zeros();
        for (a, [gx, gy]) in gradients.iter().take(4).enumerate() {
            b[(0, 2 * a)] = *gx;
            b[(1, 2 * a + 1)] = *gy;
            b[(2, 2 * a)] = *gy;
            b[(2, 2 * a + 1)] = *gx;
        }
        (b, determinant)
    }

    /// Matrix M̃, one column for each mode.
    fn enhanced_part(&self, [xi, eta]: [f64; 2], determinant: f64) -> SMatrix<f64, 3, 4> {
        let (inverse, centre_determinant) = &self.centre;
        let scale = centre_determinant / determinant;
        let covariant = [
            Matrix2::new(xi, 0.0, 0.0, 0.0),
            Matrix2::new(0.0, 0.0, 0.0, eta),
            Matrix2::new(0.0, 0.5 * xi, 0.5 * xi, 0.0),
            Matrix2::new(0.0, 0.5 * eta, 0.5 * eta, 0.0),
        ];
        SMatrix::from_columns(&covariant.map(|covariant| {
            let strain = inverse.transpose() * covariant * inverse * scale;
            Vector3::new(strain.m11, strain.m22, strain.m12 + strain.m21)
        }))
    }
}
