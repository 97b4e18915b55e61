//! Linear triangle with nodally averaged volumetric strain, which does not lock in plane strain.
//!
//! The deviatoric part of the stiffness is that of the triangle. The volumetric part is integrated once for each node a, with
//! the mean strain of the triangles around it, each weighted with a third of its area,
//!
//! ```text
//! Vₐ = Σ Aₑ/3        B̄ₐ = Σ (Aₑ/3) tr Bₑ / Vₐ        K = Σₑ ∫ Bₑᵀ D_dev Bₑ dA + Σₐ Vₐ κ B̄ₐᵀ B̄ₐ
//! ```
//!
//! with κ = λ + 2μ/3, that is D_dev with λ' = −2μ/3. One volume constraint for each node instead of one for each triangle
//! halves their number, so that incompressible fields exist. The mean is over the triangles of one material only, as across
//! an interface the volume strain may jump. In plane stress, without locking, the plain triangle is used.
//!
//! Source: J. Bonet and A. J. Burton, *Communications in Numerical Methods in Engineering* 14 (1998) 437–449, equations 13
//! to 20.

use super::solid::{ElementKind, Solid};

/// Triangles of one material around one node.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NodePatch {
    /// Node in the middle.
    pub node: u32,
    /// Material of the triangles.
    pub material: u16,
    /// Nodes of the triangles, in rising order.
    pub nodes: Vec<u32>,
    /// Numbers of the triangles, in rising order.
    pub triangles: Vec<u32>,
}

/// All patches, by node and then material.
pub(super) fn patches(solid: &Solid) -> Vec<NodePatch> {
    let mut around: Vec<(u32, u16, u32)> = Vec::new();
    for (number, element) in (0..).zip(&solid.elements) {
        if element.kind == ElementKind::Triangle3 {
            around.extend(element.nodes().iter().map(|node| (*node, element.material, number)));
        }
    }
    around.sort_unstable();
    around
        .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
        .map(|group| {
            let triangles: Vec<u32> = group.iter().map(|entry| entry.2).collect();
            let mut nodes: Vec<u32> =
                triangles.iter().flat_map(|triangle| solid.elements[*triangle as usize].nodes()).copied().collect();
            nodes.sort_unstable();
            nodes.dedup();
            NodePatch { node: group[0].0, material: group[0].1, nodes, triangles }
        })
        .collect()
}

impl NodePatch {
    /// Mean volume strain B̄ₐ as (∂θ/∂u_x, ∂θ/∂u_y) for each of [`Self::nodes`], 1/mm, and Vₐ, mm². Triangles must not be degenerate.
    pub(super) fn mean_volume_strain(&self, solid: &Solid) -> (Vec<[f64; 2]>, f64) {
        let mut row = vec![[0.0; 2]; self.nodes.len()];
        let mut volume_mm2 = 0.0;
        for triangle in &self.triangles {
            let nodes = solid.elements[*triangle as usize].nodes();
            let [p, q, r] = [0, 1, 2].map(|a| solid.points_mm[nodes[a] as usize]);
            volume_mm2 += ((q - p).perp(&(r - p))) / 6.0;
            // A ∇Nₐ = half the opposite side, turned outwards; a third of it belongs to this node's patch.
            for (a, side) in [r - q, p - r, q - p].into_iter().enumerate() {
                let place = self.nodes.partition_point(|node| *node < nodes[a]);
                row[place][0] -= side.y / 6.0;
                row[place][1] += side.x / 6.0;
            }
        }
        for entry in &mut row {
            *entry = entry.map(|value| value / volume_mm2);
        }
        (row, volume_mm2)
    }
}
