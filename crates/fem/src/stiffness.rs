//! Assembled stiffness of a solid.
//!
//! Nodes are coupled where they share an element (or, for linear triangles in plane strain, a patch of `nodal_triangle`), in blocks of
//! 2 × 2 ([`NodeMatrix`]). Elements are added in order, so that K is the same bit for bit.

use nalgebra::Vector2;

use super::axisymmetric::RingElement;
use super::elastic::{Analysis, Elastic};
use super::element::{ElementError, ElementMatrix, Fold, MOST_DOFS, check_nodes, stiffness_n_per_mm2};
use super::enhanced_quad::EnhancedQuad;
use super::nodal_triangle::{NodePatch, patches};
use super::node_matrix::NodeMatrix;
use super::projected_volume::ProjectedVolume;
use super::shape::MOST_NODES;
use super::solid::{ElementKind, Solid};
use super::support::RigidParts;

/// Degrees of freedom of a node.
const PER_NODE: usize = 2;

/// Stiffness matrix of a solid, N/mm per mm of thickness; of bodies of revolution N/mm.
#[derive(Debug, Clone)]
pub struct Stiffness {
    matrix: NodeMatrix,
    analysis: Analysis,
    parts: RigidParts,
}

impl Stiffness {
    /// Assembles the stiffness of `solid`, whose elements refer to `materials` by number.
    pub fn new(solid: &Solid, materials: &[Elastic], analysis: Analysis) -> Result<Self, ElementError> {
        check_references(solid, materials)?;
        let patches = averaged_patches(solid, analysis);
        let matrix = NodeMatrix::new(PER_NODE, solid.points_mm.len(), || {
            solid.elements.iter().map(|e| e.nodes()).chain(patches.iter().map(|p| p.nodes.as_slice()))
        });
        let mut stiffness = Self { matrix, analysis, parts: RigidParts::new(solid, analysis) };
        stiffness.assemble(solid, materials, &patches)?;
        Ok(stiffness)
    }

    /// Sparse matrix K.
    pub fn matrix(&self) -> &NodeMatrix {
        &self.matrix
    }

    /// Parts that can move as rigid bodies.
    pub(super) fn parts(&self) -> &RigidParts {
        &self.parts
    }

    fn assemble(&mut self, solid: &Solid, materials: &[Elastic], patches: &[NodePatch]) -> Result<(), ElementError> {
        let d_mpa: Vec<_> = materials.iter().map(|material| material.stiffness_mpa(self.analysis)).collect();
        let plane_strain = self.analysis == Analysis::PlaneStrain;
        let mut entries: ElementMatrix = [[0.0; MOST_DOFS]; MOST_DOFS];
        let mut nodes_mm = [Vector2::zeros(); MOST_NODES];
        for (number, element) in solid.elements.iter().enumerate() {
            let nodes = element.nodes();
            for (x, node) in nodes_mm.iter_mut().zip(nodes) {
                *x = solid.points_mm[*node as usize];
            }
            let nodes_mm = &nodes_mm[..nodes.len()];
            let d = &d_mpa[usize::from(element.material)];
            let material = &materials[usize::from(element.material)];
            let made = check_nodes(element.kind, nodes_mm).and_then(|()| match element.kind {
                kind if self.analysis == Analysis::Axisymmetric => {
                    RingElement::new(kind, nodes_mm)?.write_stiffness(material, &mut entries)
                }
                ElementKind::Quad4 => EnhancedQuad::new(nodes_mm, d).map(|quad| quad.write_stiffness(&mut entries)),
                kind if plane_strain => {
                    stiffness_n_per_mm2(kind, nodes_mm, &material.deviatoric_mpa(), &mut entries)?;
                    if ProjectedVolume::serves(kind) {
                        let volume = ProjectedVolume::new(kind, nodes_mm)?;
                        volume.add_stiffness(material.bulk_modulus_mpa(), 2 * nodes.len(), &mut entries);
                    }
                    Ok(())
                }
                kind => stiffness_n_per_mm2(kind, nodes_mm, d, &mut entries),
            });
            made.map_err(|Fold { at_mm, determinant_mm2 }| ElementError::Distorted {
                element: number,
                kind: element.kind,
                at_mm,
                determinant_mm2,
            })?;
            for (a, i) in nodes.iter().enumerate() {
                for (b, j) in nodes.iter().enumerate() {
                    if i >= j {
                        let block = [0, 1].map(|r| [0, 1].map(|c| entries[2 * a + r][2 * b + c]));
                        self.matrix.add(*i, *j, block);
                    }
                }
            }
        }
        for patch in patches {
            let (row, volume_mm2) = patch.mean_volume_strain(solid);
            let weight = volume_mm2 * materials[usize::from(patch.material)].bulk_modulus_mpa();
            for (i, [ix, iy]) in patch.nodes.iter().zip(&row) {
                for (j, [jx, jy]) in patch.nodes.iter().zip(&row).take_while(|(j, _)| *j <= i) {
                    let block = [[weight * ix * jx, weight * ix * jy], [weight * iy * jx, weight * iy * jy]];
                    self.matrix.add(*i, *j, block);
                }
            }
        }
        Ok(())
    }
}

/// Patches of linear triangles whose volume strain is averaged, which is in plane strain.
pub(super) fn averaged_patches(solid: &Solid, analysis: Analysis) -> Vec<NodePatch> {
    match analysis {
        Analysis::PlaneStrain => patches(solid),
        Analysis::PlaneStress | Analysis::Axisymmetric => Vec::new(),
    }
}

/// Checks that all nodes and materials of elements exist, and that materials are stable.
pub(super) fn check_references(solid: &Solid, materials: &[Elastic]) -> Result<(), ElementError> {
    for (number, material) in materials.iter().enumerate() {
        let Elastic { young_modulus_mpa, poisson_ratio } = *material;
        let stiff = young_modulus_mpa > 0.0 && young_modulus_mpa.is_finite();
        let compressible = poisson_ratio > -1.0 && poisson_ratio < 0.5;
        if !stiff || !compressible {
            return Err(ElementError::Material { material: number, young_modulus_mpa, poisson_ratio });
        }
    }
    for (number, element) in solid.elements.iter().enumerate() {
        if let Some(node) = element.nodes().iter().find(|node| **node as usize >= solid.points_mm.len()) {
            return Err(ElementError::NoSuchNode { element: number, node: *node, nodes: solid.points_mm.len() });
        }
        if usize::from(element.material) >= materials.len() {
            let (material, materials) = (element.material, materials.len());
            return Err(ElementError::NoSuchMaterial { element: number, material, materials });
        }
    }
    Ok(())
}
