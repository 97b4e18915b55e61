//! The kinds of cells, under meshio's names.

use serde::{Deserialize, Serialize};

/// A kind of cell. Nodes: corners first, anticlockwise in the plane, then the middles of the sides in the same order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CellKind {
    /// A point.
    Vertex,
    /// Line of two nodes.
    Line,
    /// Line of three nodes: ends, middle.
    Line3,
    /// Triangle of three nodes.
    Triangle,
    /// Triangle of six nodes.
    Triangle6,
    /// Quadrilateral of four nodes.
    Quad,
    /// Quadrilateral of eight nodes.
    Quad8,
    /// Quadrilateral of nine nodes, the last in the middle.
    Quad9,
    /// Tetrahedron of four nodes.
    Tetra,
    /// Tetrahedron of ten nodes.
    Tetra10,
    /// Hexahedron of eight nodes.
    Hexahedron,
    /// Hexahedron of twenty nodes.
    Hexahedron20,
    /// Hexahedron of twenty-seven nodes.
    Hexahedron27,
    /// Wedge of six nodes.
    Wedge,
    /// Wedge of fifteen nodes.
    Wedge15,
    /// Pyramid of five nodes.
    Pyramid,
    /// Pyramid of thirteen nodes.
    Pyramid13,
}

impl CellKind {
    /// All kinds.
    pub const ALL: [CellKind; 17] = [
        CellKind::Vertex,
        CellKind::Line,
        CellKind::Line3,
        CellKind::Triangle,
        CellKind::Triangle6,
        CellKind::Quad,
        CellKind::Quad8,
        CellKind::Quad9,
        CellKind::Tetra,
        CellKind::Tetra10,
        CellKind::Hexahedron,
        CellKind::Hexahedron20,
        CellKind::Hexahedron27,
        CellKind::Wedge,
        CellKind::Wedge15,
        CellKind::Pyramid,
        CellKind::Pyramid13,
    ];

    /// Nodes of a cell.
    pub fn node_count(self) -> usize {
        match self {
            CellKind::Vertex => 1,
            CellKind::Line => 2,
            CellKind::Line3 | CellKind::Triangle => 3,
            CellKind::Quad | CellKind::Tetra => 4,
            CellKind::Pyramid => 5,
            CellKind::Triangle6 | CellKind::Wedge => 6,
            CellKind::Quad8 | CellKind::Hexahedron => 8,
            CellKind::Quad9 => 9,
            CellKind::Tetra10 => 10,
            CellKind::Pyramid13 => 13,
            CellKind::Wedge15 => 15,
            CellKind::Hexahedron20 => 20,
            CellKind::Hexahedron27 => 27,
        }
    }

    /// 0 for a point to 3 for a solid.
    pub fn dimension(self) -> u8 {
        match self {
            CellKind::Vertex => 0,
            CellKind::Line | CellKind::Line3 => 1,
            CellKind::Triangle | CellKind::Triangle6 | CellKind::Quad | CellKind::Quad8 | CellKind::Quad9 => 2,
            _ => 3,
        }
    }
}
