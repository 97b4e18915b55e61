//! VTK's numbers for kinds of cells; its order of nodes is ours.

use crate::mesh::CellKind;

/// Kinds of cells with VTK's number for them (`vtkCellType.h`).
const TYPES: [(CellKind, u8); 17] = [
    (CellKind::Vertex, 1),
    (CellKind::Line, 3),
    (CellKind::Triangle, 5),
    (CellKind::Quad, 9),
    (CellKind::Tetra, 10),
    (CellKind::Hexahedron, 12),
    (CellKind::Wedge, 13),
    (CellKind::Pyramid, 14),
    (CellKind::Line3, 21),
    (CellKind::Triangle6, 22),
    (CellKind::Quad8, 23),
    (CellKind::Tetra10, 24),
    (CellKind::Hexahedron20, 25),
    (CellKind::Wedge15, 26),
    (CellKind::Pyramid13, 27),
    (CellKind::Quad9, 28),
    (CellKind::Hexahedron27, 29),
];

/// What is allowed, for messages.
pub(super) const ALLOWED: &str = "points, lines, triangles, quadrilaterals, tetrahedra, hexahedra, wedges and pyramids, linear or \
                           quadratic (VTK's types 1, 3, 5, 9, 10, 12, 13, 14 and 21 to 29)";

/// The kind that VTK calls `number`.
pub(super) fn kind(number: i64) -> Option<CellKind> {
    TYPES.iter().find(|&&(_, own)| i64::from(own) == number).map(|&(kind, _)| kind)
}

/// VTK's number for a kind.
pub(super) fn number(kind: CellKind) -> u8 {
    TYPES.iter().find(|&&(own, _)| own == kind).map_or(0, |&(_, number)| number)
}
