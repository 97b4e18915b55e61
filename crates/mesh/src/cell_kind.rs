//! Kinds of cells, with the names of meshio.

use serde::{Deserialize, Serialize};

/// Kind of cell with its number in VTK (`vtkCellType.h`). Nodes as in VTK: corners, anticlockwise in the plane, then the
/// middles of the sides in the same order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[repr(u8)]
pub enum CellKind {
    /// Point.
    Vertex = 1,
    /// Line of two nodes.
    Line = 3,
    /// Line of three nodes: ends, middle.
    Line3 = 21,
    /// Triangle of three nodes.
    Triangle = 5,
    /// Triangle of six nodes.
    Triangle6 = 22,
    /// Quadrilateral of four nodes.
    Quad = 9,
    /// Quadrilateral of eight nodes.
    Quad8 = 23,
    /// Quadrilateral of nine nodes, the last in the middle.
    Quad9 = 28,
    /// Tetrahedron of four nodes.
    Tetra = 10,
    /// Tetrahedron of ten nodes.
    Tetra10 = 24,
    /// Hexahedron of eight nodes.
    Hexahedron = 12,
    /// Hexahedron of twenty nodes.
    Hexahedron20 = 25,
    /// Hexahedron of twenty-seven nodes.
    Hexahedron27 = 29,
    /// Wedge of six nodes.
    Wedge = 13,
    /// Wedge of fifteen nodes.
    Wedge15 = 26,
    /// Pyramid of five nodes.
    Pyramid = 14,
    /// Pyramid of thirteen nodes.
    Pyramid13 = 27,
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

    /// Number of nodes.
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

    /// Dimension, from 0 for a point to 3 for a solid.
    pub fn dimension(self) -> u8 {
        match self {
            CellKind::Vertex => 0,
            CellKind::Line | CellKind::Line3 => 1,
            CellKind::Triangle | CellKind::Triangle6 | CellKind::Quad | CellKind::Quad8 | CellKind::Quad9 => 2,
            _ => 3,
        }
    }
}
