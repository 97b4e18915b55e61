//! Displacements of a tooth in space by their parity under half a turn.
//!
//! A tooth with equal flanks, extruded along a helix, goes over into itself by half a turn about its centre line in the middle of the face width,
//! R: x → −x, z → −z from there. The working flank becomes the other one, and one cut the other. Every displacement is the sum of an even and an odd
//! one,
//!
//! ```text
//! u = u⁺ + u⁻          u^±(R x) = ± R u^±(x)
//! ```
//!
//! which do no work on each other. Each is known from one half of the elements, whose nodes in the middle have their images there; with K^± the
//! stiffness of that half, and f^± the forces of a load on it and, turned back, on the other one,
//!
//! ```text
//! f_aᵀ K⁻¹ f_b = ½ Σ f_a^±ᵀ (K^±)⁻¹ f_b^±
//! ```
//!
//! Of two units of the cuts that are images of each other one is enough. A factor of one half has about 0.4 of the entries of the whole. A web beside
//! the middle leaves no such symmetry: there is one part then, the whole.
//!
//! Source: K.-J. Bathe, *Finite Element Procedures* (1996), section 4.2, for loads on a structure with a symmetry.

use std::cmp::Ordering;

use crate::gear_mesh::tooth_section::ExtrudedTooth;
use gearwear_fem::space::Representative;

/// Signs of the components of a displacement that is turned by half a turn about the y axis.
const TURNED: [f64; 3] = [-1.0, 1.0, -1.0];
/// The same for its radial, circumferential and axial components at the image of a node.
const TURNED_AT_IMAGE: [f64; 3] = [1.0, -1.0, -1.0];

/// Displacements of one parity, or all where there is no symmetry.
pub(super) struct Part {
    /// Node that represents each, by number.
    representatives: Vec<Representative>,
    /// Numbers of the elements that represent all.
    pub elements: Vec<usize>,
    /// 1 for even displacements, −1 for odd ones; none without symmetry.
    parity: Option<f64>,
}

impl Part {
    /// Parts of the displacements of a tooth.
    pub(super) fn of(mesh: &ExtrudedTooth) -> Vec<Self> {
        let symmetric = mesh.half_turned().and_then(|turned| {
            let least = |nodes: &[u32; 20], of: &dyn Fn(u32) -> u32| nodes.iter().map(|node| of(*node)).min();
            let elements = (0..mesh.hexahedra.len()).filter(|element| {
                let nodes = &mesh.hexahedra[*element];
                least(nodes, &|node| node) < least(nodes, &|node| turned[node as usize])
            });
            let elements: Vec<usize> = elements.collect();
            (2 * elements.len() == mesh.hexahedra.len()).then_some((turned, elements))
        });
        match symmetric {
            Some((turned, elements)) => {
                [1.0, -1.0].map(|parity| Self::with_parity(&turned, elements.clone(), parity)).into()
            }
            None => vec![Self {
                representatives: (0..mesh.points_mm.len() as u32).map(Representative::itself).collect(),
                elements: (0..mesh.hexahedra.len()).collect(),
                parity: None,
            }],
        }
    }

    fn with_parity(turned: &[u32], elements: Vec<usize>, parity: f64) -> Self {
        let representatives = (0..).zip(turned).map(|(node, image)| match image.cmp(&node) {
            Ordering::Less => Representative { node: *image, signs: TURNED.map(|sign| parity * sign) },
            // On the centre line.
            Ordering::Equal => Representative { node, signs: TURNED.map(|sign| 0.5 + 0.5 * parity * sign) },
            Ordering::Greater => Representative::itself(node),
        });
        Self { representatives: representatives.collect(), elements, parity: Some(parity) }
    }

    /// Part of a load's work that is done on the representatives.
    pub(super) fn share(&self) -> f64 {
        if self.parity.is_some() { 0.5 } else { 1.0 }
    }

    /// Node that represents another one.
    pub(super) fn representative(&self, node: u32) -> Representative {
        self.representatives[node as usize]
    }

    /// Whether a node represents itself.
    pub(super) fn represents_itself(&self, node: u32) -> bool {
        self.representative(node).node == node
    }

    /// Whether a degree of freedom is one of those by which all are known.
    pub(super) fn is_independent(&self, dof: usize) -> bool {
        let node = dof / 3;
        self.represents_itself(node as u32) && self.representatives[node].signs[dof % 3] != 0.0
    }

    /// Sign of the radial, circumferential or axial displacement of a node over that of its representative.
    pub(super) fn sign_on_cut(&self, node: u32, component: usize) -> f64 {
        match self.parity {
            Some(parity) if !self.represents_itself(node) => parity * TURNED_AT_IMAGE[component],
            _ => 1.0,
        }
    }

    /// Forces by degree of freedom, on the representatives.
    pub(super) fn folded(&self, forces: &[(u32, f64)]) -> Vec<(u32, f64)> {
        let folded = forces.iter().map(|(dof, force)| {
            let Representative { node, signs } = self.representative(dof / 3);
            (3 * node + dof % 3, signs[*dof as usize % 3] * force)
        });
        folded.collect()
    }

    /// Adds the displacement of the representatives to that of all nodes.
    pub(super) fn add_unfolded(&self, of_representatives: &[f64], displacement_mm: &mut [f64]) {
        for (own, Representative { node, signs }) in displacement_mm.chunks_exact_mut(3).zip(&self.representatives) {
            let of_node = &of_representatives[3 * *node as usize..][..3];
            own.iter_mut().zip(of_node.iter().zip(signs)).for_each(|(own, (of, sign))| *own += sign * of);
        }
    }
}
