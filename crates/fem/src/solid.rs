//! The plane elastic bodies of a mesh: nodes and elements with their materials.
//!
//! Degrees of freedom are numbered `2 · node + component`, component 0 along x and 1 along y.

use std::collections::BTreeMap;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use gearwear_mesh::{CellBlock, CellKind, DataArray, Mesh, Values};

/// A plane element; nodes are corners first, anticlockwise, then the middles of the sides in the same order.
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

/// One element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Element {
    /// What it is.
    pub kind: ElementKind,
    /// Its nodes; the first [`ElementKind::node_count`] count.
    nodes: [u32; 9],
    /// Which material of the analysis.
    pub material: u16,
}

/// Bodies in the plane; those that share no node move independently.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solid {
    /// Nodes, mm.
    pub points_mm: Vec<Vector2<f64>>,
    /// Elements.
    pub elements: Vec<Element>,
}

impl ElementKind {
    /// The kind of cell that such an element is in a mesh.
    pub fn cell_kind(self) -> CellKind {
        match self {
            ElementKind::Triangle3 => CellKind::Triangle,
            ElementKind::Triangle6 => CellKind::Triangle6,
            ElementKind::Quad4 => CellKind::Quad,
            ElementKind::Quad8 => CellKind::Quad8,
            ElementKind::Quad9 => CellKind::Quad9,
        }
    }

    /// Nodes of an element.
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
    /// An element of `kind` on `nodes` ([`ElementKind::node_count`] of them).
    pub fn new(kind: ElementKind, nodes: &[u32], material: u16) -> Self {
        let mut own = [0; 9];
        own[..kind.node_count()].copy_from_slice(nodes);
        Self { kind, nodes: own, material }
    }

    /// Its nodes.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.kind.node_count()]
    }
}

impl Solid {
    /// The bodies as a mesh: blocks of one kind of element and one material each, in the order of the elements, with the
    /// material as cell data `body`.
    pub fn to_mesh(&self) -> Mesh {
        let blocks = || self.elements.chunk_by(|a, b| (a.kind, a.material) == (b.kind, b.material));
        let nodes =
            |block: &[Element]| block.iter().flat_map(|e| e.nodes().iter().map(|&node| node as usize)).collect();
        let body = |block: &[Element]| Values::Integers(vec![i64::from(block[0].material); block.len()]);
        Mesh {
            points: self.points_mm.iter().map(|p| [p.x, p.y, 0.0]).collect(),
            cells: blocks().map(|block| CellBlock { kind: block[0].kind.cell_kind(), nodes: nodes(block) }).collect(),
            cell_data: BTreeMap::from([(
                "body".to_owned(),
                blocks().map(|block| DataArray { components: 1, values: body(block) }).collect(),
            )]),
            ..Mesh::default()
        }
    }

    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        2 * self.points_mm.len()
    }
}
