//! Finite elements in space: the hexahedron of twenty nodes, and the stiffness of a solid of them.

pub(crate) mod hexahedron;

use nalgebra::Vector3;

use super::elastic::Elastic;
use super::node_matrix::NodeMatrix;
use hexahedron::{ElementMatrix, NODES, stiffness_n_per_mm};

/// Degrees of freedom of a node.
const PER_NODE: usize = 3;

/// An element that has no volume somewhere.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("hexahedron {element} is folded: Jacobian determinant {determinant_mm3:.3e} mm³")]
pub struct FoldedHexahedron {
    /// Its number, from 0.
    pub element: usize,
    /// Determinant of ∂x/∂ξ, mm³.
    pub determinant_mm3: f64,
}

/// The stiffness of hexahedra of one material, N/mm.
pub(crate) fn stiffness(
    points_mm: &[Vector3<f64>],
    hexahedra: &[[u32; NODES]],
    material: &Elastic,
) -> Result<NodeMatrix, FoldedHexahedron> {
    let mut matrix = NodeMatrix::new(PER_NODE, points_mm.len(), || hexahedra.iter().map(|nodes| &nodes[..]));
    let mut entries = Box::new(ElementMatrix::zeros());
    for (element, nodes) in hexahedra.iter().enumerate() {
        let nodes_mm = nodes.map(|node| points_mm[node as usize]);
        stiffness_n_per_mm(&nodes_mm, material, &mut entries)
            .map_err(|determinant_mm3| FoldedHexahedron { element, determinant_mm3 })?;
        for (a, i) in nodes.iter().enumerate() {
            for (b, j) in nodes.iter().enumerate() {
                if i >= j {
                    // Symmetric but for rounding: of two halves the same one is taken.
                    let entry = |r: usize, c: usize| entries[((3 * a + r).max(3 * b + c), (3 * a + r).min(3 * b + c))];
                    matrix.add(*i, *j, [0, 1, 2].map(|r| [0, 1, 2].map(|c| entry(r, c))));
                }
            }
        }
    }
    Ok(matrix)
}
