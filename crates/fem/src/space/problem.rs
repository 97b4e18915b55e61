//! A static problem of elastic bodies in space, and its equilibrium.
//!
//! ```text
//! K u = F        u given where a node is held
//! ```
//!
//! Bodies are of hexahedra; those that share nodes are joined. Forces are in N. The forces that supports exert are what the held
//! degrees of freedom lack: r = K u − F. With them all forces and their moments about the middle of the solid add up to nothing.

use std::collections::BTreeMap;

use nalgebra::{Vector3, Vector6};

use super::hexahedron::HexahedronKind;
use super::{FoldedHexahedron, Hexahedron, PER_NODE, nodal_stresses_mpa, stiffness};
use crate::SolveError;
use crate::elastic::Elastic;
use crate::factor::Analysis;
use crate::node_matrix::NodeMatrix;
use crate::problem::{Held, Work};
use gearwear_mesh::{CellBlock, DataArray, Mesh, Values};

/// A hexahedron of a solid: eight or twenty nodes in the order of VTK.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// Its nodes.
    pub nodes: Vec<u32>,
    /// Number of its body, which is that of its material.
    pub body: u16,
}

/// Elastic bodies in space.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solid {
    /// Nodes, mm.
    pub points_mm: Vec<Vector3<f64>>,
    /// Elements.
    pub elements: Vec<Element>,
}

/// Bodies, supports and loads.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Problem {
    /// The bodies.
    pub solid: Solid,
    /// Their materials, in the order of the bodies.
    pub materials: Vec<Elastic>,
    /// Supports and given displacements; no degree of freedom twice.
    pub held: Vec<Held>,
    /// Nodal forces, one for each degree of freedom, N.
    pub forces_n: Vec<f64>,
}

/// The solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Displacement of every degree of freedom, mm.
    pub displacement_mm: Vec<f64>,
    /// Work done.
    pub work: Work,
    /// Largest unbalanced nodal force over the largest force that acts.
    pub residual: f64,
    /// Unbalance of all external forces, reactions included, over their sum, or of their moments over that times the size of the
    /// solid, whichever is greater.
    pub force_balance: f64,
}

impl Solid {
    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        PER_NODE * self.points_mm.len()
    }

    /// The bodies as a mesh: blocks of one kind of element and one body each, in the order of the elements, with the body as cell data.
    pub fn to_mesh(&self) -> Mesh {
        let blocks = || self.elements.chunk_by(|a, b| (a.nodes.len(), a.body) == (b.nodes.len(), b.body));
        let cells = |block: &[Element]| CellBlock {
            kind: HexahedronKind::with_nodes(block[0].nodes.len()).cell_kind(),
            nodes: block.iter().flat_map(|element| &element.nodes).map(|&node| node as usize).collect(),
        };
        let body = |block: &[Element]| DataArray {
            components: 1,
            values: Values::Integers(vec![i64::from(block[0].body); block.len()]),
        };
        Mesh {
            points: self.points_mm.iter().map(|&point| point.into()).collect(),
            cells: blocks().map(cells).collect(),
            cell_data: BTreeMap::from([("body".to_owned(), blocks().map(body).collect())]),
            ..Mesh::default()
        }
    }
}

impl Problem {
    fn hexahedra(&self) -> impl Iterator<Item = Hexahedron<'_>> {
        let of = |element: &Element| usize::from(element.body);
        self.solid
            .elements
            .iter()
            .map(move |element| Hexahedron { nodes: &element.nodes, material: &self.materials[of(element)] })
    }

    /// Stress (x, y, z, xy, yz, zx) of every node, MPa: the mean over the elements of its body, and over bodies that are joined there.
    ///
    /// # Errors
    /// An element that is none; the solver has found it before.
    pub fn nodal_stresses_mpa(&self, displacement_mm: &[f64]) -> Result<Vec<Vector6<f64>>, FoldedHexahedron> {
        let nodes = self.solid.points_mm.len();
        let mut sums = vec![(Vector6::zeros(), 0_u32); nodes];
        for body in 0..self.materials.len() {
            let own = || self.solid.elements.iter().zip(self.hexahedra()).filter(|(e, _)| usize::from(e.body) == body);
            let hexahedra = own().map(|(_, hexahedron)| hexahedron);
            let stresses = nodal_stresses_mpa(&self.solid.points_mm, hexahedra, displacement_mm)?;
            let mut is_own = vec![false; nodes];
            own().flat_map(|(element, _)| &element.nodes).for_each(|&node| is_own[node as usize] = true);
            for ((sum, count), (stress, _)) in
                sums.iter_mut().zip(stresses.into_iter().zip(is_own)).filter(|(_, (_, is_own))| *is_own)
            {
                *sum += stress;
                *count += 1;
            }
        }
        Ok(sums.into_iter().map(|(sum, bodies)| sum / f64::from(bodies.max(1))).collect())
    }
}

/// Finds the equilibrium of `problem`, whose supports hold every body; `announce` is told what the factor takes, GB, before it is made.
pub fn solve(problem: &Problem, announce: &dyn Fn(f64)) -> Result<Solution, SolveError> {
    let matrix = stiffness(&problem.solid.points_mm, || problem.hexahedra())?;
    let mut is_held = vec![false; problem.solid.dofs()];
    problem.held.iter().for_each(|held| is_held[held.dof as usize] = true);
    let analysis = Analysis::new(&matrix, |dof| is_held[dof])?;
    announce(analysis.factor_gb());
    let factor = analysis.factorised()?;
    let given: Vec<(u32, f64)> = problem.held.iter().map(|held| (held.dof, held.displacement_mm)).collect();
    let mut displacement_mm = problem.forces_n.clone();
    factor.subtract_held(&matrix, &given, &mut displacement_mm);
    factor.solve(1, &mut displacement_mm);
    given.iter().for_each(|(dof, value)| displacement_mm[*dof as usize] = *value);
    let [residual, force_balance] = balance(problem, &matrix, &displacement_mm, &is_held);
    let work = Work { iterations: 1, factorisations: 1, right_hand_sides: 1, ..Work::default() };
    Ok(Solution { displacement_mm, work, residual, force_balance })
}

/// Residual and unbalance of external forces, both relative.
fn balance(problem: &Problem, matrix: &NodeMatrix, displacement_mm: &[f64], is_held: &[bool]) -> [f64; 2] {
    let inner = matrix.multiply(displacement_mm);
    let points = &problem.solid.points_mm;
    let centre = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let size_mm = points.iter().map(|point| (point - centre).norm()).fold(0.0, f64::max);
    let (mut greatest, mut unbalanced) = (0.0_f64, 0.0_f64);
    let (mut force, mut moment, mut sum_of_sizes) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (node, point) in points.iter().enumerate() {
        let mut external = Vector3::zeros();
        for k in 0..PER_NODE {
            let dof = PER_NODE * node + k;
            let (inner, outer) = (inner[dof], problem.forces_n[dof]);
            greatest = greatest.max(inner.abs()).max(outer.abs());
            if !is_held[dof] {
                unbalanced = unbalanced.max((inner - outer).abs());
            }
            external[k] = if is_held[dof] { inner } else { outer };
        }
        force += external;
        moment += (point - centre).cross(&external);
        sum_of_sizes += external.norm();
    }
    let relative = |value: f64, scale: f64| if scale > 0.0 { value / scale } else { 0.0 };
    let unbalance = f64::max(force.norm(), moment.norm() / size_mm);
    [relative(unbalanced, greatest), relative(unbalance, sum_of_sizes)]
}
