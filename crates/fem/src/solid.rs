//! Plane elastic bodies: nodes and elements with their materials.
//!
//! Degrees of freedom are numbered `2 · node + component`, component 0 along x and 1 along y.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use gearwear_mesh::{CellBlock, CellKind, DataArray, Mesh, Values};

/// Kind of plane element; nodes are the corners anticlockwise, then the middles of the sides in the same order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum ElementKind {
    /// Linear triangle.
    Triangle3,
    /// Quadratic triangle.
    Triangle6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Serendipity quadrilateral.
    Quad8,
    /// Biquadratic quadrilateral, the last node in the middle.
    Quad9,
}

/// Plane element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Element {
    /// Kind of the element.
    pub kind: ElementKind,
    /// Nodes, of which the first [`ElementKind::node_count`] are used.
    nodes: [u32; 9],
    /// Number of the material.
    pub material: u16,
}

/// Plane elastic bodies; those that share no node move independently.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solid {
    /// Nodes, mm.
    pub points_mm: Vec<Vector2<f64>>,
    /// Elements.
    pub elements: Vec<Element>,
}

impl ElementKind {
    /// Kind of cell in a mesh.
    pub fn cell_kind(self) -> CellKind {
        match self {
            ElementKind::Triangle3 => CellKind::Triangle,
            ElementKind::Triangle6 => CellKind::Triangle6,
            ElementKind::Quad4 => CellKind::Quad,
            ElementKind::Quad8 => CellKind::Quad8,
            ElementKind::Quad9 => CellKind::Quad9,
        }
    }

    /// Number of nodes.
    pub fn node_count(self) -> usize {
        match self {
            ElementKind::Triangle3 => 3,
            ElementKind::Quad4 => 4,
            ElementKind::Triangle6 => 6,
            ElementKind::Quad8 => 8,
            ElementKind::Quad9 => 9,
        }
    }
}

impl Element {
    /// Element of `kind` on its [`ElementKind::node_count`] nodes.
    pub fn new(kind: ElementKind, nodes: &[u32], material: u16) -> Self {
        let mut own = [0; 9];
        own[..kind.node_count()].copy_from_slice(nodes);
        Self { kind, nodes: own, material }
    }

    /// Nodes, corners first.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.kind.node_count()]
    }
}

/// Adds a block of cells to a mesh, with the number of their body as cell data `body`.
pub(super) fn add_body(mesh: &mut Mesh, block: CellBlock, body: u16) {
    let values = Values::Integers(vec![i64::from(body); block.len()]);
    mesh.cell_data.entry("body".to_owned()).or_default().push(DataArray { components: 1, values });
    mesh.cells.push(block);
}

impl Solid {
    /// Bodies as a mesh: blocks of one kind of element and one material each, in the order of the elements, with the
    /// material as cell data `body`.
    pub fn to_mesh(&self) -> Mesh {
        let mut mesh = Mesh { points: self.points_mm.iter().map(|p| [p.x, p.y, 0.0]).collect(), ..Mesh::default() };
        for block in self.elements.chunk_by(|a, b| (a.kind, a.material) == (b.kind, b.material)) {
            let nodes = block.iter().flat_map(Element::nodes).map(|&node| node as usize).collect();
            add_body(&mut mesh, CellBlock::new(block[0].kind.cell_kind(), nodes), block[0].material);
        }
        mesh
    }

    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        2 * self.points_mm.len()
    }
}
