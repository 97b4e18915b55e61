//! The hexahedron of twenty nodes: shape functions, and the stiffness of one element.
//!
//! On [−1, 1]³, with the nodes in the order of VTK,
//!
//! ```text
//! corners   (1 + ξξₐ)(1 + ηηₐ)(1 + ζζₐ)(ξξₐ + ηηₐ + ζζₐ − 2)/8
//! ξₐ = 0    (1 − ξ²)(1 + ηηₐ)(1 + ζζₐ)/4, and likewise for η and ζ
//! ```
//!
//! The stiffness is that of the plane elements (`fem::element`) with one direction more, 3 × 3 × 3 points of Gauss and Legendre, and the
//! same cure for locking (`fem::projected_volume`): the volume strain is replaced by the linear function of x, y and z nearest to it.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005), section 4.10.

use std::sync::LazyLock;

use nalgebra::{Matrix3, Matrix4, SMatrix, Vector3, Vector4};

use crate::fem::elastic::Elastic;
use crate::fem::quadrature::GAUSS_3;

/// Nodes of an element.
pub(crate) const NODES: usize = 20;

/// Where the nodes lie on the reference cell.
pub(crate) const REFERENCE_NODES: [[f64; 3]; NODES] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
];

/// Shape functions and their derivatives at a point of the reference cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shape {
    /// Nₐ.
    pub values: [f64; NODES],
    /// ∂Nₐ/∂ξ, ∂Nₐ/∂η, ∂Nₐ/∂ζ.
    pub slopes: [[f64; 3]; NODES],
}

impl Shape {
    /// At (ξ, η, ζ).
    pub(crate) fn at(at: [f64; 3]) -> Self {
        let mut shape = Self { values: [0.0; NODES], slopes: [[0.0; 3]; NODES] };
        for (a, node) in REFERENCE_NODES.iter().enumerate() {
            // Along each direction a factor and its slope: 1 + xxₐ, or 1 − x² where the node is in the middle.
            let factor = [0, 1, 2].map(|k| {
                let (x, n) = (at[k], node[k]);
                if n == 0.0 { (1.0 - x * x, -2.0 * x) } else { (1.0 + x * n, n) }
            });
            let [(f, df), (g, dg), (h, dh)] = factor;
            let product = f * g * h;
            let slopes = [df * g * h, f * dg * h, f * g * dh];
            if a < 8 {
                let sum = at.iter().zip(node).map(|(x, n)| x * n).sum::<f64>() - 2.0;
                shape.values[a] = 0.125 * product * sum;
                shape.slopes[a] = [0, 1, 2].map(|k| 0.125 * (slopes[k] * sum + product * node[k]));
            } else {
                shape.values[a] = 0.25 * product;
                shape.slopes[a] = slopes.map(|slope| 0.25 * slope);
            }
        }
        shape
    }

    /// x = Σ Nₐ xₐ.
    pub(crate) fn point(&self, nodes_mm: &[Vector3<f64>; NODES]) -> Vector3<f64> {
        nodes_mm.iter().zip(&self.values).map(|(x, n)| x * *n).sum()
    }

    /// ∇Nₐ, 1/mm, and the determinant of the Jacobian, mm³; gradients are of use only where that is positive.
    pub(crate) fn gradients(&self, nodes_mm: &[Vector3<f64>; NODES]) -> ([Vector3<f64>; NODES], f64) {
        let jacobian: Matrix3<f64> =
            nodes_mm.iter().zip(&self.slopes).map(|(x, slope)| x * Vector3::from(*slope).transpose()).sum();
        let determinant = jacobian.determinant();
        let inverse = jacobian.try_inverse().unwrap_or_default().transpose();
        (self.slopes.map(|slope| inverse * Vector3::from(slope)), determinant)
    }
}

/// A point of integration with its weight.
struct Point {
    shape: Shape,
    weight: f64,
}

fn rule() -> &'static [Point] {
    static RULE: LazyLock<Vec<Point>> = LazyLock::new(|| {
        let line = || GAUSS_3.iter();
        line()
            .flat_map(|z| line().flat_map(move |y| line().map(move |x| (x, y, z))))
            .map(|((x, f), (y, g), (z, h))| Point { shape: Shape::at([*x, *y, *z]), weight: f * g * h })
            .collect()
    });
    &RULE
}

/// A symmetric matrix over the degrees of freedom `3 · local node + component`.
pub(crate) type ElementMatrix = SMatrix<f64, { 3 * NODES }, { 3 * NODES }>;

/// Stiffness of an element, N/mm, into `out`.
///
/// # Errors
/// The determinant of the Jacobian at a point of integration where it is not positive.
pub(crate) fn stiffness_n_per_mm(
    nodes_mm: &[Vector3<f64>; NODES],
    material: &Elastic,
    out: &mut ElementMatrix,
) -> Result<(), f64> {
    let mu = material.shear_modulus_mpa();
    let centre = nodes_mm.iter().sum::<Vector3<f64>>() / NODES as f64;
    let size = (nodes_mm[0] - centre).norm();
    let mut products = [[Matrix3::<f64>::zeros(); NODES]; NODES];
    let mut mass = Matrix4::zeros();
    let mut moments = SMatrix::<f64, 4, { 3 * NODES }>::zeros();
    for Point { shape, weight } in rule() {
        let (gradients, determinant) = shape.gradients(nodes_mm);
        if determinant.is_nan() || determinant <= 0.0 {
            return Err(determinant);
        }
        let volume = weight * determinant;
        let arm = (shape.point(nodes_mm) - centre) / size;
        let basis = Vector4::new(1.0, arm.x, arm.y, arm.z);
        mass += basis * basis.transpose() * volume;
        for (a, of_a) in gradients.iter().enumerate() {
            let weighted = of_a * volume;
            for k in 0..3 {
                for (i, p) in basis.iter().enumerate() {
                    moments[(i, 3 * a + k)] += p * weighted[k];
                }
            }
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
    // The mass of 1, x, y and z is positive definite: the points do not lie in a plane where J > 0 at all of them.
    let factor = mass.cholesky().ok_or(0.0)?;
    let projected = factor.solve(&moments);
    *out += moments.transpose() * projected * material.bulk_modulus_mpa();
    Ok(())
}
