//! Three-dimensional finite elements: hexahedra of eight and of twenty nodes, assembled stiffness and nodal stresses; `problem`: bodies with
//! supports and loads, and their equilibrium.

mod enhanced;
pub mod hexahedron;
pub mod loads;
pub mod problem;
mod quadratic;

use nalgebra::{SMatrix, SVector, Vector3, Vector6};

use super::elastic::Elastic;
use super::node_matrix::NodeMatrix;
use super::quadrature::GAUSS_2;
use enhanced::EnhancedHexahedron;
use hexahedron::{HexahedronKind, HexahedronShape, MOST_NODES};

/// Degrees of freedom of a node.
pub(crate) const PER_NODE: usize = 3;
/// Greatest number of degrees of freedom of an element.
const MOST_DOFS: usize = PER_NODE * MOST_NODES;
/// Gauss abscissa 1/√3.
const GAUSS: f64 = GAUSS_2[1].0;

/// Error for an element whose Jacobian determinant is not positive everywhere.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("hexahedron {element} is inverted or degenerate: Jacobian determinant {determinant_mm3:.3e} mm³")]
pub struct FoldedHexahedron {
    /// Number of the element, from 0.
    pub element: usize,
    /// Determinant of ∂x/∂ξ, mm³.
    pub determinant_mm3: f64,
}

/// Jacobian determinant that is not positive, mm³.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Folded(f64);

impl Folded {
    fn of(self, element: usize) -> FoldedHexahedron {
        FoldedHexahedron { element, determinant_mm3: self.0 }
    }
}

/// Hexahedron of eight or twenty nodes with its material.
#[derive(Debug, Clone, Copy)]
pub struct Hexahedron<'a> {
    /// Nodes in the order of VTK.
    pub nodes: &'a [u32],
    /// Material.
    pub material: &'a Elastic,
}

impl Hexahedron<'_> {
    fn kind(&self) -> HexahedronKind {
        HexahedronKind::with_nodes(self.nodes.len())
    }

    fn nodes_mm<'b>(&self, points_mm: &[Vector3<f64>], room: &'b mut [Vector3<f64>; MOST_NODES]) -> &'b [Vector3<f64>] {
        for (x, node) in room.iter_mut().zip(self.nodes) {
            *x = points_mm[*node as usize];
        }
        &room[..self.nodes.len()]
    }
}

/// Node whose displacement another one has, but for the signs of the components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Representative {
    /// Node.
    pub node: u32,
    /// 1 or −1 for each component; 0 for one that vanishes.
    pub signs: [f64; PER_NODE],
}

impl Representative {
    /// A node that stands for itself.
    pub fn itself(node: u32) -> Self {
        Self { node, signs: [1.0; PER_NODE] }
    }
}

/// Assembled stiffness of `elements`, N/mm.
pub fn stiffness<'a, E: Iterator<Item = Hexahedron<'a>>>(
    points_mm: &[Vector3<f64>],
    elements: impl Fn() -> E,
) -> Result<NodeMatrix, FoldedHexahedron> {
    stiffness_of(points_mm, elements, Representative::itself)
}

/// Assembled stiffness of `elements` by the displacements of the nodes that represent all, N/mm; zero at others.
pub fn stiffness_of<'a, E: Iterator<Item = Hexahedron<'a>>>(
    points_mm: &[Vector3<f64>],
    elements: impl Fn() -> E,
    representative: impl Fn(u32) -> Representative,
) -> Result<NodeMatrix, FoldedHexahedron> {
    let coupled: Vec<Vec<u32>> =
        elements().map(|element| element.nodes.iter().map(|node| representative(*node).node).collect()).collect();
    let mut matrix = NodeMatrix::new(PER_NODE, points_mm.len(), || coupled.iter().map(Vec::as_slice));
    drop(coupled);
    let mut entries = Box::new(SMatrix::<f64, MOST_DOFS, MOST_DOFS>::zeros());
    let mut room = [Vector3::zeros(); MOST_NODES];
    for (number, element) in elements().enumerate() {
        let nodes_mm = element.nodes_mm(points_mm, &mut room);
        match element.kind() {
            HexahedronKind::Eight => EnhancedHexahedron::new(nodes_mm, element.material)
                .map(|own| entries.fixed_view_mut::<24, 24>(0, 0).copy_from(&own.stiffness)),
            HexahedronKind::Twenty => quadratic::stiffness_n_per_mm(nodes_mm, element.material, &mut entries),
        }
        .map_err(|folded| folded.of(number))?;
        let (mut of, count) = ([Representative::itself(0); MOST_NODES], element.nodes.len());
        of.iter_mut().zip(element.nodes).for_each(|(of, node)| *of = representative(*node));
        for (a, row) in of[..count].iter().enumerate() {
            for (b, column) in of[..count].iter().enumerate() {
                if row.node >= column.node {
                    // Symmetric but for rounding: always the lower half is used.
                    let entry = |r: usize, c: usize| entries[((3 * a + r).max(3 * b + c), (3 * a + r).min(3 * b + c))];
                    let block = [0, 1, 2].map(|r| [0, 1, 2].map(|c| row.signs[r] * column.signs[c] * entry(r, c)));
                    matrix.add(row.node, column.node, block);
                }
            }
        }
    }
    Ok(matrix)
}

/// Stresses (x, y, z, xy, yz, zx) at all nodes under `displacement_mm`, MPa: sampled at the 2 × 2 × 2 optimal points of each element,
/// extrapolated to its nodes by the trilinear function through them, and averaged over the elements around a node (sources in
/// `fem::stress`).
///
/// # Errors
/// Inverted or degenerate elements, which the stiffness has refused before.
pub fn nodal_stresses_mpa<'a>(
    points_mm: &[Vector3<f64>],
    elements: impl Iterator<Item = Hexahedron<'a>>,
    displacement_mm: &[f64],
) -> Result<Vec<Vector6<f64>>, FoldedHexahedron> {
    let mut sums = vec![(Vector6::zeros(), 0u32); points_mm.len()];
    let mut room = [Vector3::zeros(); MOST_NODES];
    let samples: Vec<[f64; 3]> =
        HexahedronKind::Eight.reference_nodes().iter().map(|corner| corner.map(|x| GAUSS * x)).collect();
    for (number, element) in elements.enumerate() {
        let nodes_mm = element.nodes_mm(points_mm, &mut room);
        let mut u = SVector::<f64, MOST_DOFS>::zeros();
        for (a, node) in element.nodes.iter().enumerate() {
            (0..3).for_each(|k| u[3 * a + k] = displacement_mm[3 * *node as usize + k]);
        }
        let sampled = match element.kind() {
            HexahedronKind::Eight => EnhancedHexahedron::new(nodes_mm, element.material).map(|own| {
                let u = u.fixed_rows::<24>(0).into_owned();
                samples.iter().map(|at| own.stress_mpa(*at, element.material, &u)).collect()
            }),
            HexahedronKind::Twenty => quadratic::stresses_mpa(nodes_mm, &samples, element.material, &u),
        }
        .map_err(|folded| folded.of(number))?;
        for (node, at) in element.nodes.iter().zip(element.kind().reference_nodes()) {
            let weights = HexahedronShape::at(HexahedronKind::Eight, at.map(|x| x / GAUSS)).values;
            let (sum, count) = &mut sums[*node as usize];
            *sum += sampled.iter().zip(weights).map(|(stress, weight)| stress * weight).sum::<Vector6<f64>>();
            *count += 1;
        }
    }
    Ok(sums.into_iter().map(|(sum, count)| sum / f64::from(count.max(1))).collect())
}

/// Block Bₐ of the strain ε = Bₐ uₐ for (x, y, z, xy, yz, zx) with engineering shear strains.
fn strain_block(gradient: &Vector3<f64>) -> SMatrix<f64, 6, 3> {
    let (x, y, z) = (gradient.x, gradient.y, gradient.z);
    SMatrix::<f64, 6, 3>::from_row_slice(&[x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z, y, x, 0.0, 0.0, z, y, z, 0.0, x])
}
