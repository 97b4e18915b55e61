//! Elements of bodies of revolution: the half section in the plane of radius x and axis y.
//!
//! Displacements (u, v) along radius and axis strain a ring of the radius r by
//!
//! ```text
//! ε = (ε_r, ε_z, γ_rz, ε_θ) = (∂u/∂r, ∂v/∂z, ∂u/∂z + ∂v/∂r, u/r)        dV = 2π r dA
//! K = ∫ B̄ᵀ D B̄ dV        D = λ m mᵀ + μ diag(2, 2, 1, 2),   m = (1, 1, 0, 1)
//! B̄ = B + ⅓ m (θ̄ − mᵀ B)        θ̄ = pᵀ M⁻¹ Q,   M = ∫ p pᵀ dV,   Q = ∫ p mᵀ B dV
//! ```
//!
//! The volume strain mᵀ B u is replaced by its projection θ̄ on p = (1) in linear elements and p = (1, r, z) in quadratic ones, so
//! that they do not lock as ν → ½ (linear triangles excepted, which are too many for their nodes then). Forces, stiffnesses and the
//! areas of contacts are those of the whole circumference ([`Analysis::thickness_mm`]): N and mm². Nodes on the axis do not move along
//! the radius.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005), section 2.6
//! (strains); T. J. R. Hughes, *International Journal for Numerical Methods in Engineering* 15 (1980) 1413–1418 (B̄).

use nalgebra::{Matrix3, Matrix4, SMatrix, SVector, Vector2, Vector3, Vector4};

use super::elastic::{Analysis, Elastic};
use super::element::{ElementMatrix, Fold, MOST_DOFS, least_determinant_mm2};
use super::quadrature::rule;
use super::shape::Shape;
use super::solid::ElementKind;

/// Components of the volume strain, m.
const VOLUME: Vector4<f64> = Vector4::new(1.0, 1.0, 0.0, 1.0);

/// Strain (ε_r, ε_z, γ_rz, ε_θ), or stress, per displacement of the nodes.
pub(super) type RingMatrix = SMatrix<f64, 4, MOST_DOFS>;

/// Element with its projected volume strain.
pub(super) struct RingElement<'a> {
    kind: ElementKind,
    nodes_mm: &'a [Vector2<f64>],
    /// Origin and unit of the coordinates in p.
    centre_mm: Vector2<f64>,
    size_mm: f64,
    /// Projection M⁻¹ Q.
    projected: SMatrix<f64, 3, MOST_DOFS>,
}

impl<'a> RingElement<'a> {
    /// Element on its nodes.
    pub(super) fn new(kind: ElementKind, nodes_mm: &'a [Vector2<f64>]) -> Result<Self, Fold> {
        let centre_mm = nodes_mm.iter().sum::<Vector2<f64>>() / nodes_mm.len() as f64;
        let size_mm = (nodes_mm[0] - centre_mm).norm();
        let mut element = Self { kind, nodes_mm, centre_mm, size_mm, projected: SMatrix::zeros() };
        let (mut mass, mut moments) = (Matrix3::zeros(), SMatrix::<f64, 3, MOST_DOFS>::zeros());
        for point in &rule(kind).points {
            let (strain, volume_mm3) = element.displacement_part(&point.shape)?;
            let p = element.basis(point.shape.point(nodes_mm));
            let volume_mm3 = point.weight * volume_mm3;
            mass += p * p.transpose() * volume_mm3;
            moments += p * (strain.transpose() * VOLUME).transpose() * volume_mm3;
        }
        // Unused terms of p have rows of zeros.
        (0..3).filter(|&i| mass[(i, i)] == 0.0).collect::<Vec<_>>().into_iter().for_each(|i| mass[(i, i)] = 1.0);
        let factor = mass.cholesky().ok_or(Fold { at_mm: centre_mm, determinant_mm2: 0.0 })?;
        element.projected = factor.solve(&moments);
        Ok(element)
    }

    /// Strain of the displacements alone, B, and the volume of the ring per weight of integration, mm³.
    fn displacement_part(&self, shape: &Shape) -> Result<(RingMatrix, f64), Fold> {
        let (gradients, determinant_mm2) = shape.gradients(self.nodes_mm);
        let at_mm = shape.point(self.nodes_mm);
        if !(determinant_mm2 > least_determinant_mm2(self.nodes_mm) && at_mm.x > 0.0) {
            return Err(Fold { at_mm, determinant_mm2 });
        }
        let mut strain = RingMatrix::zeros();
        for (a, ([gx, gy], value)) in gradients.iter().zip(shape.values).enumerate() {
            strain[(0, 2 * a)] = *gx;
            strain[(1, 2 * a + 1)] = *gy;
            strain[(2, 2 * a)] = *gy;
            strain[(2, 2 * a + 1)] = *gx;
            strain[(3, 2 * a)] = value / at_mm.x;
        }
        Ok((strain, determinant_mm2 * Analysis::Axisymmetric.thickness_mm(at_mm.x)))
    }

    /// Terms p of the projection at a point.
    fn basis(&self, at_mm: Vector2<f64>) -> Vector3<f64> {
        let arm = (at_mm - self.centre_mm) / self.size_mm;
        match self.kind {
            ElementKind::Triangle3 | ElementKind::Quad4 => Vector3::x(),
            ElementKind::Triangle6 | ElementKind::Quad8 | ElementKind::Quad9 => Vector3::new(1.0, arm.x, arm.y),
        }
    }

    /// Strain B̄ at a point, and the volume of the ring per weight of integration, mm³.
    fn strain(&self, shape: &Shape) -> Result<(RingMatrix, f64), Fold> {
        let (strain, volume_mm3) = self.displacement_part(shape)?;
        let projected: SVector<f64, MOST_DOFS> = self.projected.transpose() * self.basis(shape.point(self.nodes_mm));
        let change = (projected - strain.transpose() * VOLUME) / 3.0;
        Ok((strain + VOLUME * change.transpose(), volume_mm3))
    }

    /// Stiffness of the whole ring, N/mm; both halves are filled.
    pub(super) fn write_stiffness(&self, material: &Elastic, out: &mut ElementMatrix) -> Result<(), Fold> {
        let law = law_mpa(material);
        let mut sum = SMatrix::<f64, MOST_DOFS, MOST_DOFS>::zeros();
        for point in &rule(self.kind).points {
            let (strain, volume_mm3) = self.strain(&point.shape)?;
            sum += strain.transpose() * (law * strain) * (point.weight * volume_mm3);
        }
        for (i, row) in out.iter_mut().enumerate() {
            for (k, value) in row.iter_mut().enumerate() {
                // Symmetric but for rounding: the lower half is used.
                *value = sum[(i.max(k), i.min(k))];
            }
        }
        Ok(())
    }

    /// Stress (σ_r, σ_z, τ_rz, σ_θ) at a point per displacement of the nodes, MPa/mm.
    pub(super) fn stress(&self, material: &Elastic, shape: &Shape) -> Result<RingMatrix, Fold> {
        Ok(law_mpa(material) * self.strain(shape)?.0)
    }
}

/// Elasticity matrix D, MPa.
fn law_mpa(material: &Elastic) -> Matrix4<f64> {
    let mu = material.shear_modulus_mpa();
    let lambda = material.bulk_modulus_mpa() - 2.0 / 3.0 * mu;
    lambda * VOLUME * VOLUME.transpose() + mu * Matrix4::from_diagonal(&Vector4::new(2.0, 2.0, 1.0, 2.0))
}
