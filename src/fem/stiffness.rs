//! The assembled stiffness of a solid.
//!
//! K is symmetric; its **lower triangle** is kept, diagonal included, column by column (CSC, rows rising, 32-bit indices).
//! The pattern comes from the graph of the nodes: node i couples with node j where they share an element (or, for linear
//! triangles in plane strain, a patch of `nodal_triangle`), and each coupling is a block of 2 × 2. The columns
//! `2j` and `2j + 1` of a node therefore have the same nodes below them, and the place of a block follows from the place of
//! node i in the list of node j; no triplets are sorted.
//!
//! Elements are added in their order, so the bits of K depend on nothing else.

use nalgebra::Vector2;
use sprs::CsMatI;

use super::elastic::{Analysis, Elastic};
use super::element::{ElementError, ElementMatrix, Fold, MOST_DOFS, check_nodes, stiffness_n_per_mm2};
use super::enhanced_quad::EnhancedQuad;
use super::nodal_triangle::{Patch, patches};
use super::projected_volume::ProjectedVolume;
use super::shape::MOST_NODES;
use super::solid::{ElementKind, Solid};
use super::support::RigidParts;

/// The stiffness matrix of a solid, N/mm per mm of thickness.
#[derive(Debug, Clone)]
pub(crate) struct Stiffness {
    matrix: CsMatI<f64, u32>,
    graph: NodeGraph,
    analysis: Analysis,
    parts: RigidParts,
}

/// For each node the nodes with a higher number that it couples with, in rising order.
#[derive(Debug, Clone)]
struct NodeGraph {
    start: Vec<usize>,
    above: Vec<u32>,
}

impl Stiffness {
    /// Assembles the stiffness of `solid`, whose elements name `materials` by their place.
    pub(crate) fn new(solid: &Solid, materials: &[Elastic], analysis: Analysis) -> Result<Self, ElementError> {
        check_references(solid, materials)?;
        let patches = averaged_patches(solid, analysis);
        let graph = NodeGraph::new(solid, &patches);
        let mut stiffness = Self { matrix: graph.empty_matrix(), graph, analysis, parts: RigidParts::new(solid) };
        stiffness.assemble(solid, materials, &patches)?;
        Ok(stiffness)
    }

    /// The lower triangle, CSC.
    pub(crate) fn lower(&self) -> &CsMatI<f64, u32> {
        &self.matrix
    }

    /// Number of degrees of freedom, supports included.
    pub(crate) fn dofs(&self) -> usize {
        self.matrix.cols()
    }

    /// What can move as a rigid body.
    pub(super) fn parts(&self) -> &RigidParts {
        &self.parts
    }

    /// K u, N/mm: the nodal forces that hold the displacements `displacement_mm`.
    ///
    /// # Panics
    /// Where there is not one displacement for each degree of freedom.
    pub(crate) fn multiply(&self, displacement_mm: &[f64]) -> Vec<f64> {
        assert_eq!(displacement_mm.len(), self.dofs(), "one displacement for each degree of freedom");
        let mut force = vec![0.0; self.dofs()];
        let (columns, rows, values) = (self.matrix.indptr(), self.matrix.indices(), self.matrix.data());
        for (j, ends) in columns.raw_storage().windows(2).enumerate() {
            let (start, end) = (ends[0] as usize, ends[1] as usize);
            let u = displacement_mm[j];
            let mut own = 0.0;
            for (row, value) in rows[start..end].iter().zip(&values[start..end]) {
                let i = *row as usize;
                if i == j {
                    own += value * u;
                } else {
                    own += value * displacement_mm[i];
                    force[i] += value * u;
                }
            }
            force[j] += own;
        }
        force
    }

    /// The columns of `dofs`, which are also the rows: their entries as (degree of freedom, N/mm per mm).
    pub(crate) fn columns(&self, dofs: &[u32]) -> Vec<Vec<(u32, f64)>> {
        let mut place = vec![u32::MAX; self.dofs()];
        (0..).zip(dofs).for_each(|(k, dof)| place[*dof as usize] = k);
        let mut found = vec![Vec::new(); dofs.len()];
        let mut note = |dof: u32, other: u32, value: f64| {
            if let Some(column) = found.get_mut(place[dof as usize] as usize) {
                column.push((other, value));
            }
        };
        for (j, column) in (0..).zip(self.matrix.outer_iterator()) {
            for (i, value) in column.iter() {
                note(j, i as u32, *value);
                if i as u32 != j {
                    note(i as u32, j, *value);
                }
            }
        }
        found
    }

    fn assemble(&mut self, solid: &Solid, materials: &[Elastic], patches: &[Patch]) -> Result<(), ElementError> {
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
                        self.add(*i, *j, block);
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
                    self.add(*i, *j, block);
                }
            }
        }
        Ok(())
    }

    /// Adds the block of rows of node i and columns of node j ≤ i, which couple.
    fn add(&mut self, i: u32, j: u32, block: [[f64; 2]; 2]) {
        let j = j as usize;
        let columns = self.matrix.indptr();
        let columns = columns.raw_storage();
        let starts = [columns[2 * j] as usize, columns[2 * j + 1] as usize];
        let data = self.matrix.data_mut();
        if i as usize == j {
            data[starts[0]] += block[0][0];
            data[starts[0] + 1] += block[1][0];
            data[starts[1]] += block[1][1];
        } else {
            let place = 2 * self.graph.place(j, i);
            data[starts[0] + 2 + place] += block[0][0];
            data[starts[0] + 3 + place] += block[1][0];
            data[starts[1] + 1 + place] += block[0][1];
            data[starts[1] + 2 + place] += block[1][1];
        }
    }
}

impl NodeGraph {
    fn new(solid: &Solid, patches: &[Patch]) -> Self {
        let nodes = solid.points_mm.len();
        // Groups of nodes that couple with each other, and for each node the groups it is in.
        let groups = || solid.elements.iter().map(|e| e.nodes()).chain(patches.iter().map(|p| p.nodes.as_slice()));
        let mut group_start = vec![0usize; nodes + 1];
        for node in groups().flatten() {
            group_start[*node as usize + 1] += 1;
        }
        for node in 0..nodes {
            group_start[node + 1] += group_start[node];
        }
        let mut members: Vec<&[u32]> = vec![&[]; group_start[nodes]];
        let mut next = group_start.clone();
        for group in groups() {
            for node in group {
                members[next[*node as usize]] = group;
                next[*node as usize] += 1;
            }
        }
        let mut seen = vec![u32::MAX; nodes];
        let mut start = Vec::with_capacity(nodes + 1);
        start.push(0);
        let mut above: Vec<u32> = Vec::new();
        for j in 0..nodes {
            let first = above.len();
            for group in &members[group_start[j]..group_start[j + 1]] {
                for i in *group {
                    if *i as usize > j && seen[*i as usize] != j as u32 {
                        seen[*i as usize] = j as u32;
                        above.push(*i);
                    }
                }
            }
            above[first..].sort_unstable();
            start.push(above.len());
        }
        Self { start, above }
    }

    /// Place of node i > j, which couples with it, in the list of node j.
    fn place(&self, j: usize, i: u32) -> usize {
        let above = &self.above[self.start[j]..self.start[j + 1]];
        let place = above.partition_point(|&other| other < i);
        debug_assert_eq!(above.get(place), Some(&i), "the pattern is of these elements");
        place
    }

    /// The pattern of the lower triangle with zeros in it.
    fn empty_matrix(&self) -> CsMatI<f64, u32> {
        let nodes = self.start.len() - 1;
        let entries = 3 * nodes + 4 * self.above.len();
        let mut columns: Vec<u32> = Vec::with_capacity(2 * nodes + 1);
        let mut rows: Vec<u32> = Vec::with_capacity(entries);
        columns.push(0);
        for j in 0..nodes {
            let above = &self.above[self.start[j]..self.start[j + 1]];
            let own = 2 * j as u32;
            rows.extend([own, own + 1]);
            rows.extend(above.iter().flat_map(|i| [2 * i, 2 * i + 1]));
            columns.push(rows.len() as u32);
            rows.push(own + 1);
            rows.extend(above.iter().flat_map(|i| [2 * i, 2 * i + 1]));
            columns.push(rows.len() as u32);
        }
        CsMatI::new_csc((2 * nodes, 2 * nodes), columns, rows, vec![0.0; entries])
    }
}

/// The patches of linear triangles where their volume strain is averaged.
fn averaged_patches(solid: &Solid, analysis: Analysis) -> Vec<Patch> {
    match analysis {
        Analysis::PlaneStrain => patches(solid),
        Analysis::PlaneStress => Vec::new(),
    }
}

/// Every node and material that an element names must be there, and every material be stable.
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
