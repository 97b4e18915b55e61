//! Stiffness of one isoparametric element.
//!
//! For an isotropic material with σ = λ' tr ε I + 2 μ ε in the plane (λ' = λ for plane strain, 2λμ/(λ + 2μ) for plane
//! stress) the stiffness between nodes a and b is
//!
//! ```text
//! G_ab = ∫ ∇Nₐ ⊗ ∇N_b dA            K_ab = λ' G_ab + μ G_abᵀ + μ tr(G_ab) I
//! ```
//!
//! so that the loop over integration points sums four products per pair of nodes, and the material enters once, after it.
//! This is ∫ Bₐᵀ D B_b dA written out (Zienkiewicz, Taylor and Zhu 2005, section 2.3), at a third of the operations.
//!
//! An element must not be folded: J > 0 at every integration point, and J ≥ 0 at its nodes, where zero is allowed
//! (a side may run straight through a corner of a quadratic element).

use nalgebra::{Matrix3, Vector2};

use super::quadrature::{Rule, rule};
use super::shape::MOST_NODES;
use super::solid::ElementKind;

/// Greatest number of degrees of freedom of an element.
pub(crate) const MOST_DOFS: usize = 2 * MOST_NODES;

/// Least determinant J over the square of the element's size.
const LEAST_DETERMINANT: f64 = 1e-10;

/// Reason why a stiffness cannot be assembled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ElementError {
    /// The element is folded, turned inside out, or has no area.
    #[error(
        "element {element} ({kind:?}) is inverted or degenerate near ({:.6}, {:.6}) mm: Jacobian determinant {determinant_mm2:.3e} mm²",
        .at_mm.x, .at_mm.y
    )]
    Distorted {
        /// Number of the element, from 0.
        element: usize,
        /// Kind of the element.
        kind: ElementKind,
        /// Point in the plane, mm.
        at_mm: Vector2<f64>,
        /// Determinant of ∂x/∂ξ there, mm².
        determinant_mm2: f64,
    },
    /// The element refers to a node that does not exist.
    #[error("element {element} has node {node}, but there are only {nodes}")]
    NoSuchNode {
        /// Number of the element, from 0.
        element: usize,
        /// Number of the node.
        node: u32,
        /// Number of nodes.
        nodes: usize,
    },
    /// The element refers to a material that does not exist.
    #[error("element {element} is of material {material}, but there are only {materials}")]
    NoSuchMaterial {
        /// Number of the element, from 0.
        element: usize,
        /// Number of the material.
        material: u16,
        /// Number of materials.
        materials: usize,
    },
    /// The material is unstable or incompressible.
    #[error(
        "material {material}: Young's modulus {young_modulus_mpa} MPa must be positive and Poisson's ratio {poisson_ratio} \
         above -1 and below 0.5"
    )]
    Material {
        /// Number of the material, from 0.
        material: usize,
        /// Young's modulus E, MPa.
        young_modulus_mpa: f64,
        /// Poisson's ratio ν.
        poisson_ratio: f64,
    },
}

/// Point at which an element is folded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fold {
    /// Point, mm.
    pub at_mm: Vector2<f64>,
    /// Determinant J, mm².
    pub determinant_mm2: f64,
}

/// Symmetric element matrix over the degrees of freedom `2 · local node + component`; both halves are filled.
pub(super) type ElementMatrix = [[f64; MOST_DOFS]; MOST_DOFS];

/// Integrals ∫ ∇Nₐ ⊗ ∇N_b dA, rows and columns by node and component, a ≤ b.
fn gradient_products<const N: usize>(
    rule: &Rule,
    nodes_mm: &[Vector2<f64>],
    least_mm2: f64,
) -> Result<[[[f64; 4]; N]; N], Fold> {
    let mut products = [[[0.0; 4]; N]; N];
    for point in &rule.points {
        let (gradients, determinant) = point.shape.gradients(nodes_mm);
        if determinant.is_nan() || determinant <= least_mm2 {
            return Err(Fold { at_mm: point.shape.point(nodes_mm), determinant_mm2: determinant });
        }
        let weight = point.weight * determinant;
        for a in 0..N {
            let [gx, gy] = gradients[a].map(|g| g * weight);
            for b in a..N {
                let [hx, hy] = gradients[b];
                let sum = &mut products[a][b];
                sum[0] += gx * hx;
                sum[1] += gx * hy;
                sum[2] += gy * hx;
                sum[3] += gy * hy;
            }
        }
    }
    Ok(products)
}

/// Stiffness of an element with `N` nodes and the Lamé constants (λ', μ).
fn fill<const N: usize>(
    rule: &Rule,
    nodes_mm: &[Vector2<f64>],
    least_mm2: f64,
    (lambda, mu): (f64, f64),
    out: &mut ElementMatrix,
) -> Result<(), Fold> {
    let products = gradient_products::<N>(rule, nodes_mm, least_mm2)?;
    for a in 0..N {
        for b in a..N {
            let [xx, xy, yx, yy] = products[a][b];
            let block = [
                [(lambda + 2.0 * mu) * xx + mu * yy, lambda * xy + mu * yx],
                [lambda * yx + mu * xy, (lambda + 2.0 * mu) * yy + mu * xx],
            ];
            for (i, row) in block.iter().enumerate() {
                for (k, value) in row.iter().enumerate() {
                    out[2 * a + i][2 * b + k] = *value;
                    out[2 * b + k][2 * a + i] = *value;
                }
            }
        }
    }
    Ok(())
}

/// Stiffness of an isoparametric element in displacements alone, N/mm per mm of thickness, with λ' = D₁₂ and μ = D₃₃.
pub(super) fn stiffness_n_per_mm2(
    kind: ElementKind,
    nodes_mm: &[Vector2<f64>],
    d_mpa: &Matrix3<f64>,
    out: &mut ElementMatrix,
) -> Result<(), Fold> {
    let least_mm2 = least_determinant_mm2(nodes_mm);
    let material = (d_mpa.m12, d_mpa.m33);
    match kind {
        ElementKind::Triangle3 => fill::<3>(rule(kind), nodes_mm, least_mm2, material, out),
        ElementKind::Triangle6 => fill::<6>(rule(kind), nodes_mm, least_mm2, material, out),
        ElementKind::Quad4 => fill::<4>(rule(kind), nodes_mm, least_mm2, material, out),
        ElementKind::Quad8 => fill::<8>(rule(kind), nodes_mm, least_mm2, material, out),
        ElementKind::Quad9 => fill::<9>(rule(kind), nodes_mm, least_mm2, material, out),
    }
}

/// Checks for folds at the nodes, which the integration points may miss.
pub(super) fn check_nodes(kind: ElementKind, nodes_mm: &[Vector2<f64>]) -> Result<(), Fold> {
    let least_mm2 = least_determinant_mm2(nodes_mm);
    for shape in &rule(kind).nodes {
        let j = shape.jacobian(nodes_mm);
        let determinant_mm2 = j.m11 * j.m22 - j.m12 * j.m21;
        if determinant_mm2.is_nan() || determinant_mm2 < -least_mm2 {
            return Err(Fold { at_mm: shape.point(nodes_mm), determinant_mm2 });
        }
    }
    Ok(())
}

/// Whether an element with these nodes has a stiffness: an area at every integration point, and no fold at its nodes.
pub fn is_sound(kind: ElementKind, nodes_mm: &[Vector2<f64>]) -> bool {
    let least_mm2 = least_determinant_mm2(nodes_mm);
    check_nodes(kind, nodes_mm).is_ok()
        && rule(kind).points.iter().all(|point| point.shape.jacobian(nodes_mm).determinant() > least_mm2)
}

/// Least determinant of an element of this size, mm².
pub(super) fn least_determinant_mm2(nodes_mm: &[Vector2<f64>]) -> f64 {
    let mut low = nodes_mm[0];
    let mut high = nodes_mm[0];
    for x in nodes_mm {
        low = low.inf(x);
        high = high.sup(x);
    }
    LEAST_DETERMINANT * (high - low).norm_squared()
}
