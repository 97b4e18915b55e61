//! Abaqus names of kinds of cells, and sides of plane elements.

use std::borrow::Cow;

use crate::CellKind;

/// Kinds of cells and the names written for them.
const WRITTEN: [(CellKind, &str); 16] = [
    (CellKind::Vertex, "MASS"),
    (CellKind::Line, "T2D2"),
    (CellKind::Line3, "T2D3"),
    (CellKind::Triangle, "CPE3"),
    (CellKind::Triangle6, "CPE6"),
    (CellKind::Quad, "CPE4"),
    (CellKind::Quad8, "CPE8"),
    (CellKind::Quad9, "M3D9"),
    (CellKind::Tetra, "C3D4"),
    (CellKind::Tetra10, "C3D10"),
    (CellKind::Hexahedron, "C3D8"),
    (CellKind::Hexahedron20, "C3D20"),
    (CellKind::Wedge, "C3D6"),
    (CellKind::Wedge15, "C3D15"),
    (CellKind::Pyramid, "C3D5"),
    // Not an element of Abaqus, but a continuation of its names.
    (CellKind::Pyramid13, "C3D13"),
];

/// Allowed element types, for messages.
pub(super) const ALLOWED: &str = "MASS, trusses and beams (T2D2, T3D3, B21 …), plane elements (CPE, CPS, CPEG, CAX, M3D, R3D, S \
                           with 3, 4, 6, 8 or 9 nodes) and solids (C3D4 to C3D20)";

/// Kind of cell of an element type, in any case; letters after the number of nodes (reduced integration, hybrid, …) are ignored.
pub(super) fn kind(name: &str) -> Option<CellKind> {
    let name = name.trim().to_ascii_uppercase();
    if name == "MASS" {
        return Some(CellKind::Vertex);
    }
    const LINES: [&str; 8] = ["R2D2", "RAX2", "T2D2", "T3D2", "B21", "B31", "B23", "B33"];
    const LINES_OF_THREE: [&str; 4] = ["T2D3", "T3D3", "B22", "B32"];
    for (lines, kind) in [(&LINES[..], CellKind::Line), (&LINES_OF_THREE, CellKind::Line3)] {
        if lines.iter().any(|line| name.strip_prefix(line).is_some_and(is_variant)) {
            return Some(kind);
        }
    }
    const FAMILIES: [&str; 9] = ["CPEG", "CPE", "CPS", "CAX", "M3D", "R3D", "C3D", "STRI", "S"];
    let family = FAMILIES.into_iter().find(|family| name.starts_with(family))?;
    let rest = &name[family.len()..];
    let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    if !is_variant(&rest[digits..]) {
        return None;
    }
    let solid = family == "C3D";
    match (solid, &rest[..digits]) {
        (false, "3") => Some(CellKind::Triangle),
        (false, "4") => Some(CellKind::Quad),
        (false, "6" | "65") => Some(CellKind::Triangle6),
        (false, "8") => Some(CellKind::Quad8),
        (false, "9") => Some(CellKind::Quad9),
        (true, "4") => Some(CellKind::Tetra),
        (true, "5") => Some(CellKind::Pyramid),
        (true, "6") => Some(CellKind::Wedge),
        (true, "8") => Some(CellKind::Hexahedron),
        (true, "10") => Some(CellKind::Tetra10),
        (true, "13") => Some(CellKind::Pyramid13),
        (true, "15") => Some(CellKind::Wedge15),
        (true, "20") => Some(CellKind::Hexahedron20),
        _ => None,
    }
}

/// Whether the text after the number of nodes is a variant of the element: `R`, `RH`, `I`, `T`, `MT`, `5` of `S9R5` …
fn is_variant(rest: &str) -> bool {
    rest.is_empty() || rest.starts_with(|c: char| c.is_ascii_uppercase())
}

/// Element type of a kind of cell, if there is one.
pub(super) fn name(kind: CellKind) -> Option<&'static str> {
    WRITTEN.iter().find(|&&(own, _)| own == kind).map(|&(_, name)| name)
}

/// Nodes in the order of Abaqus from that of the mesh, or back: only a quadratic line differs, with its middle node second.
pub(super) fn reorder<T: Copy>(kind: CellKind, nodes: &[T]) -> Cow<'_, [T]> {
    match (kind, nodes) {
        (CellKind::Line3, &[a, b, c]) => Cow::Owned(vec![a, c, b]),
        _ => Cow::Borrowed(nodes),
    }
}

/// Number of sides of a plane element, 0 for other cells.
pub(super) fn side_count(kind: CellKind) -> usize {
    match kind {
        CellKind::Triangle | CellKind::Triangle6 => 3,
        CellKind::Quad | CellKind::Quad8 | CellKind::Quad9 => 4,
        _ => 0,
    }
}

/// Kind and nodes of the line on a side (from 0, which is `S1`) of a plane element with `nodes`, the element on its left.
pub(super) fn side(kind: CellKind, nodes: &[usize], side: usize) -> (CellKind, Vec<usize>) {
    let corners = side_count(kind);
    let mut line = vec![nodes[side], nodes[(side + 1) % corners]];
    if nodes.len() == corners {
        return (CellKind::Line, line);
    }
    line.push(nodes[corners + side]);
    (CellKind::Line3, line)
}
