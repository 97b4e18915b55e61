//! Gmsh element types of kinds of cells, and the order of their nodes.

use crate::CellKind;

/// Kinds of cells and their Gmsh element types.
const TYPES: [(CellKind, u8); 17] = [
    (CellKind::Line, 1),
    (CellKind::Triangle, 2),
    (CellKind::Quad, 3),
    (CellKind::Tetra, 4),
    (CellKind::Hexahedron, 5),
    (CellKind::Wedge, 6),
    (CellKind::Pyramid, 7),
    (CellKind::Line3, 8),
    (CellKind::Triangle6, 9),
    (CellKind::Quad9, 10),
    (CellKind::Tetra10, 11),
    (CellKind::Hexahedron27, 12),
    (CellKind::Vertex, 15),
    (CellKind::Quad8, 16),
    (CellKind::Hexahedron20, 17),
    (CellKind::Wedge15, 18),
    (CellKind::Pyramid13, 19),
];

/// Allowed element types, for messages.
pub(super) const ALLOWED: &str = "points, lines, triangles, quadrilaterals, tetrahedra, hexahedra, wedges and pyramids, linear or \
                           quadratic (Gmsh's types 1 to 12 and 15 to 19)";

/// Kind of cell of element type `number`.
pub(super) fn kind(number: i64) -> Option<CellKind> {
    TYPES.iter().find(|&&(_, own)| i64::from(own) == number).map(|&(kind, _)| kind)
}

/// Element type of a kind of cell.
pub(super) fn number(kind: CellKind) -> u8 {
    TYPES.iter().find(|&&(own, _)| own == kind).map_or(0, |&(_, number)| number)
}

/// Place of node `i` in the order of Gmsh, for kinds whose order differs.
///
/// Gmsh orders the edges of solids by their lowest nodes, VTK (and meshio and this library) around the bottom, around
/// the top, then upwards.
pub(super) fn order(kind: CellKind) -> Option<&'static [usize]> {
    match kind {
        CellKind::Tetra10 => Some(&[0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
        CellKind::Hexahedron20 => Some(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]),
        CellKind::Hexahedron27 => {
            Some(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26])
        }
        CellKind::Wedge15 => Some(&[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
        CellKind::Pyramid13 => Some(&[0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
        _ => None,
    }
}

/// Our order of the nodes of a cell from Gmsh's.
pub(super) fn from_gmsh<T: Copy>(kind: CellKind, nodes: &mut [T], scratch: &mut Vec<T>) {
    if let Some(order) = order(kind) {
        scratch.clear();
        scratch.extend_from_slice(nodes);
        for (node, &place) in nodes.iter_mut().zip(order) {
            *node = scratch[place];
        }
    }
}

/// Gmsh's order from ours.
pub(super) fn to_gmsh<T: Copy>(kind: CellKind, nodes: &mut [T], scratch: &mut Vec<T>) {
    if let Some(order) = order(kind) {
        scratch.clear();
        scratch.extend_from_slice(nodes);
        for (&node, &place) in scratch.iter().zip(order) {
            nodes[place] = node;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_number_of_its_own_and_back() {
        for kind in CellKind::ALL {
            assert_eq!(super::kind(i64::from(number(kind))), Some(kind));
        }
    }

    #[test]
    fn ver_orders_are_permutations_and_to_gmsh_is_the_inverse_of_from_gmsh() {
        for kind in CellKind::ALL {
            let mut nodes: Vec<usize> = (0..kind.node_count()).collect();
            let mut scratch = Vec::new();
            from_gmsh(kind, &mut nodes, &mut scratch);
            if let Some(order) = order(kind) {
                assert_eq!(nodes, order);
            }
            to_gmsh(kind, &mut nodes, &mut scratch);
            assert!(nodes.iter().enumerate().all(|(i, &node)| i == node), "{kind:?}");
        }
    }

    /// Edges of the hexahedron and their nodes in VTK (vtkQuadraticHexahedron) and in Gmsh ("Node ordering"): the middle
    /// node of an edge must be the middle of the same two corners in both.
    #[test]
    fn ver_middle_nodes_of_a_hexahedron_stay_on_their_edges() {
        const VTK: [[usize; 2]; 12] =
            [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
        const GMSH: [[usize; 2]; 12] =
            [[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]];
        let order = order(CellKind::Hexahedron20).expect("Gmsh's order differs");
        for (edge, &place) in VTK.iter().zip(&order[8..]) {
            let (mut vtk, mut gmsh) = (*edge, GMSH[place - 8]);
            vtk.sort_unstable();
            gmsh.sort_unstable();
            assert_eq!(vtk, gmsh);
        }
    }
}
