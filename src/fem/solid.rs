//! The plane elastic bodies of a mesh: nodes and elements with their materials.
//!
//! Degrees of freedom are numbered `2 · node + component`, component 0 along x and 1 along y.

use nalgebra::Vector2;

/// A plane element; nodes are corners first, anticlockwise, then the middles of the sides in the same order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        2 * self.points_mm.len()
    }
}
