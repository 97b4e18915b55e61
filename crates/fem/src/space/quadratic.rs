//! Hexahedron of twenty nodes, the three-dimensional form of the plane quadratic elements (`fem::element`), with the same projected volume strain
//! against locking (`fem::projected_volume`): its least-squares approximation linear in x, y and z.

use nalgebra::{Matrix3, Matrix4, SMatrix, SVector, Vector3, Vector4, Vector6};

use super::Folded;
use super::hexahedron::{HexahedronKind, HexahedronShape, MOST_NODES};
use crate::elastic::Elastic;

/// Degrees of freedom of the nodes.
const DOFS: usize = 3 * MOST_NODES;

/// Projection of the volume strain of an element onto the local basis 1, x, y, z.
struct VolumeStrain {
    centre_mm: Vector3<f64>,
    size_mm: f64,
    mass: Matrix4<f64>,
    moments: SMatrix<f64, 4, DOFS>,
}

impl VolumeStrain {
    fn new(nodes_mm: &[Vector3<f64>]) -> Self {
        let centre_mm = nodes_mm.iter().sum::<Vector3<f64>>() / MOST_NODES as f64;
        let size_mm = (nodes_mm[0] - centre_mm).norm();
        Self { centre_mm, size_mm, mass: Matrix4::zeros(), moments: SMatrix::zeros() }
    }

    fn basis(&self, at_mm: Vector3<f64>) -> Vector4<f64> {
        let arm = (at_mm - self.centre_mm) / self.size_mm;
        Vector4::new(1.0, arm.x, arm.y, arm.z)
    }

    /// Adds an integration point with weight `volume_mm3`.
    fn add(&mut self, at_mm: Vector3<f64>, gradients: &[Vector3<f64>; MOST_NODES], volume_mm3: f64) {
        let basis = self.basis(at_mm);
        self.mass += basis * basis.transpose() * volume_mm3;
        for (a, gradient) in gradients.iter().enumerate() {
            let weighted = gradient * volume_mm3;
            for k in 0..3 {
                for (i, p) in basis.iter().enumerate() {
                    self.moments[(i, 3 * a + k)] += p * weighted[k];
                }
            }
        }
    }

    /// Coefficients of the projection per displacement.
    fn projected(&self) -> Result<SMatrix<f64, 4, DOFS>, Folded> {
        // The mass matrix is positive definite: where J > 0 at all points they are not coplanar.
        Ok(self.mass.cholesky().ok_or(Folded(0.0))?.solve(&self.moments))
    }
}

/// Gradients ∇Nₐ and determinant J at a point.
fn gradients(shape: &HexahedronShape, nodes_mm: &[Vector3<f64>]) -> Result<([Vector3<f64>; MOST_NODES], f64), Folded> {
    let (gradients, determinant) = shape.gradients(nodes_mm);
    if determinant.is_nan() || determinant <= 0.0 { Err(Folded(determinant)) } else { Ok((gradients, determinant)) }
}

/// Stiffness of an element, N/mm, into `out`.
pub(super) fn stiffness_n_per_mm(
    nodes_mm: &[Vector3<f64>],
    material: &Elastic,
    out: &mut SMatrix<f64, DOFS, DOFS>,
) -> Result<(), Folded> {
    let mu = material.shear_modulus_mpa();
    let mut volume_strain = VolumeStrain::new(nodes_mm);
    let mut products = [[Matrix3::<f64>::zeros(); MOST_NODES]; MOST_NODES];
    for point in HexahedronKind::Twenty.rule() {
        let (gradients, determinant) = gradients(&point.shape, nodes_mm)?;
        let volume_mm3 = point.weight * determinant;
        volume_strain.add(point.shape.point(nodes_mm), &gradients, volume_mm3);
        for (a, of_a) in gradients.iter().enumerate() {
            let weighted = of_a * volume_mm3;
            for (b, of_b) in gradients.iter().enumerate().skip(a) {
                products[a][b] += weighted * of_b.transpose();
            }
        }
    }
    // ∫ ∇Nₐ ⊗ ∇N_b gives the deviatoric part, with λ' = −2μ/3.
    for (a, of_a) in products.iter().enumerate() {
        for (b, g) in of_a.iter().enumerate().skip(a) {
            let block = g * (-2.0 / 3.0 * mu) + g.transpose() * mu + Matrix3::identity() * (mu * g.trace());
            out.fixed_view_mut::<3, 3>(3 * a, 3 * b).copy_from(&block);
            out.fixed_view_mut::<3, 3>(3 * b, 3 * a).copy_from(&block.transpose());
        }
    }
    *out += volume_strain.moments.transpose() * volume_strain.projected()? * material.bulk_modulus_mpa();
    Ok(())
}

/// Stresses (x, y, z, xy, yz, zx) at points of the reference cell under displacements of the nodes, MPa.
pub(super) fn stresses_mpa(
    nodes_mm: &[Vector3<f64>],
    points: &[[f64; 3]],
    material: &Elastic,
    displacement_mm: &SVector<f64, DOFS>,
) -> Result<Vec<Vector6<f64>>, Folded> {
    let mut volume_strain = VolumeStrain::new(nodes_mm);
    for point in HexahedronKind::Twenty.rule() {
        let (gradients, determinant) = gradients(&point.shape, nodes_mm)?;
        volume_strain.add(point.shape.point(nodes_mm), &gradients, point.weight * determinant);
    }
    let theta = volume_strain.projected()? * displacement_mm;
    let stresses = points.iter().map(|at| {
        let shape = HexahedronShape::at(HexahedronKind::Twenty, *at);
        let (gradients, _) = gradients(&shape, nodes_mm)?;
        let strain: Vector6<f64> = gradients
            .iter()
            .enumerate()
            .map(|(a, gradient)| super::strain_block(gradient) * displacement_mm.fixed_rows::<3>(3 * a))
            .sum();
        let mean = (strain[0] + strain[1] + strain[2]) / 3.0;
        let (mu, pressure) = (
            material.shear_modulus_mpa(),
            material.bulk_modulus_mpa() * volume_strain.basis(shape.point(nodes_mm)).dot(&theta),
        );
        Ok(Vector6::from_fn(|k, _| if k < 3 { 2.0 * mu * (strain[k] - mean) + pressure } else { mu * strain[k] }))
    });
    stresses.collect()
}
