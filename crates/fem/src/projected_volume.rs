//! Quadratic elements with projected volume strain, which do not lock in plane strain.
//!
//! Fully integrated, quadrilaterals and elements with curved sides have more volume constraints than their displacements
//! can satisfy: at ν = 0.4999 coarse meshes are an order too stiff. The volume strain θ = tr B u is
//! therefore replaced, inside the element, by its least-squares approximation linear in x and y,
//!
//! ```text
//! θ̄ = pᵀ M⁻¹ Q u        p = (1, x, y)        M = ∫ p pᵀ dA        Q = ∫ p tr B dA
//! K = ∫ Bᵀ D_dev B dA + κ Qᵀ M⁻¹ Q
//! ```
//!
//! with κ = λ + 2μ/3, which is the mixed element with a discontinuous linear pressure (Q2/P1), pressure eliminated. Functions linear in
//! x and y, not in ξ and η, keep the order on distorted quadrilaterals. The θ of a straight triangle is linear and does not change.
//!
//! Source: J. C. Nagtegaal, D. M. Parks and J. R. Rice, *Computer Methods in Applied Mechanics and Engineering* 4 (1974)
//! 153–177 (the cause); T. J. R. Hughes, *International Journal for Numerical Methods in Engineering* 15 (1980) 1413–1418
//! (B-bar); D. N. Arnold, D. Boffi and R. S. Falk, *Mathematics of Computation* 71 (2002) 909–922 (why x and y).

use nalgebra::{Matrix3, SMatrix, SVector, Vector2, Vector3};

use super::element::{ElementMatrix, Fold, MOST_DOFS, least_determinant_mm2};
use super::quadrature::rule;
use super::solid::ElementKind;

/// Projected volume strain θ̄ of one element as a function of the displacements of its nodes.
#[derive(Debug, Clone)]
pub(super) struct ProjectedVolume {
    /// Origin and unit of the coordinates in p.
    centre_mm: Vector2<f64>,
    size_mm: f64,
    /// Moments Q, 1/mm times mm².
    moments: SMatrix<f64, 3, MOST_DOFS>,
    /// Projection M⁻¹ Q.
    projected: SMatrix<f64, 3, MOST_DOFS>,
}

impl ProjectedVolume {
    /// Whether a kind of element has a projected volume strain in plane strain.
    pub(super) fn serves(kind: ElementKind) -> bool {
        matches!(kind, ElementKind::Triangle6 | ElementKind::Quad8 | ElementKind::Quad9)
    }

    /// Projects the volume strain of the element on `nodes_mm`.
    pub(super) fn new(kind: ElementKind, nodes_mm: &[Vector2<f64>]) -> Result<Self, Fold> {
        let least_mm2 = least_determinant_mm2(nodes_mm);
        let centre_mm = nodes_mm.iter().sum::<Vector2<f64>>() / nodes_mm.len() as f64;
        let size_mm = (nodes_mm[0] - centre_mm).norm();
        let mut volume = Self { centre_mm, size_mm, moments: SMatrix::zeros(), projected: SMatrix::zeros() };
        let mut mass = Matrix3::zeros();
        for point in &rule(kind).points {
            let (gradients, determinant_mm2) = point.shape.gradients(nodes_mm);
            let at_mm = point.shape.point(nodes_mm);
            if determinant_mm2.is_nan() || determinant_mm2 <= least_mm2 {
                return Err(Fold { at_mm, determinant_mm2 });
            }
            let area = point.weight * determinant_mm2;
            let p = volume.basis(at_mm);
            mass += p * p.transpose() * area;
            for (a, [gx, gy]) in gradients.iter().enumerate() {
                for i in 0..3 {
                    volume.moments[(i, 2 * a)] += p[i] * gx * area;
                    volume.moments[(i, 2 * a + 1)] += p[i] * gy * area;
                }
            }
        }
        // M is positive definite: where J > 0 at all points they are not collinear.
        let factor = mass.cholesky().ok_or(Fold { at_mm: centre_mm, determinant_mm2: 0.0 })?;
        volume.projected = factor.solve(&volume.moments);
        Ok(volume)
    }

    /// Adds κ Qᵀ M⁻¹ Q to the stiffness of the element.
    pub(super) fn add_stiffness(&self, bulk_modulus_mpa: f64, dofs: usize, out: &mut ElementMatrix) {
        // Qᵀ M⁻¹ Q is symmetric but for rounding: the lower half is used.
        for (i, row) in out.iter_mut().enumerate().take(dofs) {
            for (k, value) in row.iter_mut().enumerate().take(dofs) {
                let (low, high) = (i.min(k), i.max(k));
                *value += bulk_modulus_mpa * self.moments.column(high).dot(&self.projected.column(low));
            }
        }
    }

    /// Row of θ̄ at a point of the element over the displacements of its nodes, 1/mm.
    pub(super) fn row(&self, at_mm: Vector2<f64>) -> SVector<f64, MOST_DOFS> {
        self.projected.transpose() * self.basis(at_mm)
    }

    fn basis(&self, at_mm: Vector2<f64>) -> Vector3<f64> {
        let arm = (at_mm - self.centre_mm) / self.size_mm;
        Vector3::new(1.0, arm.x, arm.y)
    }
}
