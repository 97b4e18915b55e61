//! Three-dimensional static problem of elastic bodies, and its equilibrium.
//!
//! ```text
//! K u = F        u given where a node is held
//! ```
//!
//! Bodies are of hexahedra; those that share nodes are joined. Forces are in N. Reactions at held degrees of freedom are
//! r = K u − F; with them all forces and their moments about the middle of the solid add up to zero.

use nalgebra::{Vector3, Vector6};

use super::hexahedron::HexahedronKind;
use super::{FoldedHexahedron, Hexahedron, PER_NODE, nodal_stresses_mpa, stiffness};
use crate::SolveError;
use crate::elastic::Elastic;
use crate::equilibrium::{relative, round_off_n};
use crate::factor::SymbolicFactor;
use crate::node_matrix::NodeMatrix;
use crate::problem::{Held, Work};
use crate::solid::add_body;
use gearwear_mesh::{CellBlock, Mesh};

/// Hexahedron of a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceElement {
    /// Eight or twenty nodes in the order of VTK.
    pub nodes: Vec<u32>,
    /// Number of the body, and of its material.
    pub body: u16,
}

/// Three-dimensional elastic bodies.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpaceSolid {
    /// Nodes, mm.
    pub points_mm: Vec<Vector3<f64>>,
    /// Elements.
    pub elements: Vec<SpaceElement>,
}

/// Bodies, supports and loads.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpaceProblem {
    /// Elastic bodies.
    pub solid: SpaceSolid,
    /// Materials, in the order of the bodies.
    pub materials: Vec<Elastic>,
    /// Supports and given displacements; no degree of freedom twice.
    pub held: Vec<Held>,
    /// Nodal forces, one for each degree of freedom, N.
    pub forces_n: Vec<f64>,
}

/// Solution of a problem.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceEquilibrium {
    /// Displacement of every degree of freedom, mm.
    pub displacement_mm: Vec<f64>,
    /// Work done.
    pub work: Work,
    /// Largest unbalanced nodal force over the largest nodal force.
    pub residual: f64,
    /// Unbalance of all external forces, reactions included, over their sum, or of their moments over that times the size of the
    /// solid, whichever is greater.
    pub force_balance: f64,
}

impl SpaceSolid {
    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        PER_NODE * self.points_mm.len()
    }

    /// Bodies as a mesh: blocks of one kind of element and one body each, in the order of the elements, with the body as cell data.
    pub fn to_mesh(&self) -> Mesh {
        let mut mesh = Mesh { points: self.points_mm.iter().map(|&point| point.into()).collect(), ..Mesh::default() };
        for block in self.elements.chunk_by(|a, b| (a.nodes.len(), a.body) == (b.nodes.len(), b.body)) {
            let kind = HexahedronKind::with_nodes(block[0].nodes.len()).cell_kind();
            let nodes = block.iter().flat_map(|element| &element.nodes).map(|&node| node as usize).collect();
            add_body(&mut mesh, CellBlock::new(kind, nodes), block[0].body);
        }
        mesh
    }
}

impl SpaceProblem {
    fn hexahedra(&self) -> impl Iterator<Item = Hexahedron<'_>> {
        self.solid
            .elements
            .iter()
            .map(|element| Hexahedron { nodes: &element.nodes, material: &self.materials[usize::from(element.body)] })
    }

    /// Stress (x, y, z, xy, yz, zx) of every node, MPa: the mean over the elements of a body, and over bodies that are joined there.
    ///
    /// # Errors
    /// Inverted or degenerate elements, which the solver has refused before.
    pub fn nodal_stresses_mpa(&self, displacement_mm: &[f64]) -> Result<Vec<Vector6<f64>>, FoldedHexahedron> {
        let nodes = self.solid.points_mm.len();
        let mut sums = vec![(Vector6::zeros(), 0_u32); nodes];
        for body in 0..self.materials.len() {
            let bodies = self.solid.elements.iter().map(|element| usize::from(element.body));
            let own: Vec<Hexahedron<'_>> =
                self.hexahedra().zip(bodies).filter(|(_, of)| *of == body).map(|(element, _)| element).collect();
            let mut is_own = vec![false; nodes];
            own.iter().flat_map(|element| element.nodes).for_each(|&node| is_own[node as usize] = true);
            let stresses = nodal_stresses_mpa(&self.solid.points_mm, own.into_iter(), displacement_mm)?;
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

/// Finds the equilibrium of `problem`, whose supports hold every body; `announce` is given the memory of the factor, GB, before the factorisation.
pub fn solve(problem: &SpaceProblem, announce: &dyn Fn(f64)) -> Result<SpaceEquilibrium, SolveError> {
    let matrix = stiffness(&problem.solid.points_mm, || problem.hexahedra())?;
    let mut is_held = vec![false; problem.solid.dofs()];
    problem.held.iter().for_each(|held| is_held[held.dof as usize] = true);
    let symbolic = SymbolicFactor::new(&matrix, |dof| is_held[dof])?;
    announce(symbolic.factor_gb());
    let factor = symbolic.factorised()?;
    let given: Vec<(u32, f64)> = problem.held.iter().map(|held| (held.dof, held.displacement_mm)).collect();
    let mut displacement_mm = problem.forces_n.clone();
    factor.subtract_held(&matrix, &given, &mut displacement_mm);
    factor.solve(1, &mut displacement_mm);
    given.iter().for_each(|(dof, value)| displacement_mm[*dof as usize] = *value);
    let [residual, force_balance] = balance(problem, &matrix, &displacement_mm, &is_held);
    let work = Work { iterations: 1, factorisations: 1, right_hand_sides: 1, ..Work::default() };
    Ok(SpaceEquilibrium { displacement_mm, work, residual, force_balance })
}

/// Relative residual and relative unbalance of external forces.
fn balance(problem: &SpaceProblem, matrix: &NodeMatrix, displacement_mm: &[f64], is_held: &[bool]) -> [f64; 2] {
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
    if greatest <= round_off_n(matrix, displacement_mm) {
        return [0.0; 2];
    }
    let unbalance = f64::max(force.norm(), moment.norm() / size_mm);
    [relative(unbalanced, greatest), relative(unbalance, sum_of_sizes)]
}
