//! Abaqus names of kinds of cells, and the sides of elements.
//!
//! Source of the numbers of sides: *Abaqus Analysis User's Guide*, "Two-dimensional solid element library" and "Three-dimensional solid
//! element library"; of shells, whose sides 1 and 2 are their faces, *CalculiX CrunchiX USER'S MANUAL*, `*SURFACE`.

use std::borrow::Cow;

use crate::{CellBlock, CellKind, Formulation};

/// Ends of names with the number of nodes, and the kinds of cells they stand for.
type Kinds = &'static [(&'static str, CellKind)];

const PLANE: Kinds = &[
    ("3", CellKind::Triangle),
    ("4", CellKind::Quad),
    ("6", CellKind::Triangle6),
    ("8", CellKind::Quad8),
    // Of plane strain not an element of Abaqus, but a continuation of its names.
    ("9", CellKind::Quad9),
];
const SOLID: Kinds = &[
    ("4", CellKind::Tetra),
    ("5", CellKind::Pyramid),
    ("6", CellKind::Wedge),
    ("8", CellKind::Hexahedron),
    ("10", CellKind::Tetra10),
    // Not an element of Abaqus, but a continuation of its names.
    ("13", CellKind::Pyramid13),
    ("15", CellKind::Wedge15),
    ("20", CellKind::Hexahedron20),
];
const LINE: Kinds = &[("2", CellKind::Line), ("3", CellKind::Line3)];
/// The digit after `B2` or `B3` is the order: 1 linear, 2 quadratic, 3 cubic on two nodes.
const BEAM: Kinds = &[("1", CellKind::Line), ("2", CellKind::Line3), ("3", CellKind::Line)];

/// Families of names; cells of a formulation are written with its first.
const FAMILIES: [(&str, Option<Formulation>, Kinds); 21] = [
    ("MASS", None, &[("", CellKind::Vertex)]),
    ("CPEG", Some(Formulation::GeneralizedPlaneStrain), PLANE),
    ("CPE", Some(Formulation::PlaneStrain), PLANE),
    ("CPS", Some(Formulation::PlaneStress), PLANE),
    ("CAX", Some(Formulation::Axisymmetric), PLANE),
    ("M3D", Some(Formulation::Membrane), PLANE),
    ("R3D", Some(Formulation::Rigid), PLANE),
    ("R2D", Some(Formulation::Rigid), LINE),
    ("RAX", Some(Formulation::Rigid), LINE),
    ("C3D", None, SOLID),
    ("F3D", Some(Formulation::Fluid), SOLID),
    ("AC3D", Some(Formulation::Fluid), SOLID),
    ("DC2D", Some(Formulation::Heat), PLANE),
    ("DCAX", Some(Formulation::Heat), PLANE),
    ("DC3D", Some(Formulation::Heat), SOLID),
    ("T2D", None, LINE),
    ("T3D", Some(Formulation::Truss), LINE),
    ("B3", Some(Formulation::Beam), BEAM),
    ("B2", Some(Formulation::Beam), BEAM),
    ("S", Some(Formulation::Shell), PLANE),
    ("US", Some(Formulation::Shell), PLANE),
];
/// Triangular shells, whose names have other digits.
const STRI: Kinds = &[("3", CellKind::Triangle), ("65", CellKind::Triangle6)];

/// Kinds of cells that can be written, for messages.
pub(super) const ALLOWED: &str = "points, lines, triangles, quadrilaterals, tetrahedra, hexahedra of 8 or 20 nodes, wedges and pyramids, in \
                                  a formulation that has such elements";

/// Kind of cell and formulation of an element type, in any case; letters after the number of nodes (reduced integration,
/// hybrid, …) are ignored.
pub(super) fn kind(name: &str) -> Option<(CellKind, Option<Formulation>)> {
    let name = name.trim().to_ascii_uppercase();
    let families = [("STRI", Some(Formulation::Shell), STRI)].into_iter().chain(FAMILIES);
    families
        .filter_map(|(family, formulation, kinds)| {
            let rest = name.strip_prefix(family)?;
            let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            let variant = &rest[digits..];
            // `R`, `RH`, `I`, `T`, `MT`, `R5` of `S8R5` …, not `PRINGA` of `SPRINGA`.
            let is_variant = variant.is_empty() || digits > 0 && variant.starts_with(|c: char| c.is_ascii_uppercase());
            let (_, kind) = kinds.iter().find(|(own, _)| is_variant && *own == &rest[..digits])?;
            Some((*kind, formulation))
        })
        .next()
}

/// Element type of cells, if there is one; plane cells without a formulation are written for plane strain.
pub(crate) fn name(kind: CellKind, formulation: Option<Formulation>) -> Option<String> {
    let default = (kind.dimension() == 2).then_some(Formulation::PlaneStrain);
    let mut families = FAMILIES.iter().filter(|(_, own, _)| *own == formulation.or(default));
    families.find_map(|(family, _, kinds)| {
        let (digits, _) = kinds.iter().find(|(_, own)| *own == kind)?;
        Some(format!("{family}{digits}"))
    })
}

/// Nodes in the order of Abaqus from that of the mesh, or back: only a quadratic line differs, with its middle node second.
pub(super) fn reorder<T: Copy>(kind: CellKind, nodes: &[T]) -> Cow<'_, [T]> {
    match (kind, nodes) {
        (CellKind::Line3, &[a, b, c]) => Cow::Owned(vec![a, c, b]),
        _ => Cow::Borrowed(nodes),
    }
}

/// Corners of the sides of plane elements and solids in the order of their numbers: the element on the left of a line, faces with
/// their normal outwards.
pub(super) fn sides(kind: CellKind) -> &'static [&'static [usize]] {
    match kind {
        CellKind::Triangle | CellKind::Triangle6 => &[&[0, 1], &[1, 2], &[2, 0]],
        CellKind::Quad | CellKind::Quad8 | CellKind::Quad9 => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
        CellKind::Tetra | CellKind::Tetra10 => &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]],
        CellKind::Pyramid | CellKind::Pyramid13 => &[&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]],
        CellKind::Wedge | CellKind::Wedge15 => &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]],
        CellKind::Hexahedron | CellKind::Hexahedron20 => {
            &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]]
        }
        _ => &[],
    }
}

/// Edges with a middle node of quadratic elements, in the order of these nodes, which follow the corners.
fn edges(kind: CellKind) -> &'static [[usize; 2]] {
    match kind {
        CellKind::Triangle6 => &[[0, 1], [1, 2], [2, 0]],
        CellKind::Quad8 | CellKind::Quad9 => &[[0, 1], [1, 2], [2, 3], [3, 0]],
        CellKind::Tetra10 => &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]],
        CellKind::Pyramid13 => &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
        CellKind::Wedge15 => &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]],
        CellKind::Hexahedron20 => {
            &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
        }
        _ => &[],
    }
}

/// Kind and nodes of the line or face with these `corners` of an element with `nodes`.
pub(super) fn side(kind: CellKind, nodes: &[usize], corners: &[usize]) -> (CellKind, Vec<usize>) {
    let mut own: Vec<usize> = corners.iter().map(|&corner| nodes[corner]).collect();
    let first_middle = 1 + edges(kind).iter().flatten().max().copied().unwrap_or(0);
    let next = corners.iter().cycle().skip(1);
    // A line is one edge, not two.
    let pairs = corners.iter().zip(next).take(if corners.len() == 2 { 1 } else { corners.len() });
    for (&a, &b) in pairs {
        let middle = edges(kind).iter().position(|edge| *edge == [a, b] || *edge == [b, a]);
        own.extend(middle.map(|edge| nodes[first_middle + edge]));
    }
    let kind = match (corners.len(), own.len()) {
        (2, 2) => CellKind::Line,
        (2, _) => CellKind::Line3,
        (3, 3) => CellKind::Triangle,
        (3, _) => CellKind::Triangle6,
        (_, 4) => CellKind::Quad,
        _ => CellKind::Quad8,
    };
    (kind, own)
}

/// Whether the labels `S1` and `S2` of a plane element of `block` are its faces, as those of a shell are.
fn has_faces(block: &CellBlock) -> bool {
    matches!(block.formulation, Some(Formulation::Shell | Formulation::Membrane | Formulation::Rigid))
}

/// Label of a side, from 0, of the elements of `block`.
pub(super) fn label(block: &CellBlock, side: usize) -> String {
    format!("{}{}", if has_faces(block) { 'E' } else { 'S' }, side + 1)
}

/// Kind and nodes of the side with this label (`S1`, `SPOS` …) of an element of `block`.
pub(super) fn labelled(block: &CellBlock, nodes: &[usize], label: &str) -> Option<(CellKind, Vec<usize>)> {
    let label = label.trim().to_ascii_uppercase();
    let numbered = |first: char| label.strip_prefix(first)?.parse::<usize>().ok();
    let edge = match (has_faces(block), label.as_str()) {
        (true, "SPOS" | "SNEG" | "S1" | "S2") => return Some((block.kind, nodes.to_vec())),
        (true, _) => numbered('E').or(numbered('S').and_then(|side| side.checked_sub(2)))?,
        (false, _) => numbered('S')?,
    };
    let corners = sides(block.kind).get(edge.checked_sub(1)?)?;
    Some(side(block.kind, nodes, corners))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_written_is_read_back() {
        for kind in CellKind::ALL {
            for formulation in std::iter::once(None).chain(Formulation::ALL.map(Some)) {
                let Some(name) = name(kind, formulation) else { continue };
                let default = (kind.dimension() == 2).then_some(Formulation::PlaneStrain);
                assert_eq!(super::kind(&name), Some((kind, formulation.or(default))), "{name}");
            }
        }
    }

    #[test]
    fn names_with_letters_after_the_number_and_names_of_other_elements() {
        let plane = |formulation| Some((CellKind::Quad, Some(formulation)));
        assert_eq!(kind("cpe4rh"), plane(Formulation::PlaneStrain));
        assert_eq!(kind("CPEG4I"), plane(Formulation::GeneralizedPlaneStrain));
        assert_eq!(kind("S8R5"), Some((CellKind::Quad8, Some(Formulation::Shell))));
        assert_eq!(kind("STRI65"), Some((CellKind::Triangle6, Some(Formulation::Shell))));
        assert_eq!(kind("B33H"), Some((CellKind::Line, Some(Formulation::Beam))));
        assert_eq!(kind("C3D10MT"), Some((CellKind::Tetra10, None)));
        for other in ["SPRINGA", "DCOUP3D", "GAPUNI", "DASHPOTA", "D", "U1", "S", "C3D", "C3D7", "MASSES", "SC8R", ""] {
            assert_eq!(kind(other), None, "{other}");
        }
    }

    /// Normals of faces point outwards: the sum of (centre of the face − centre of the element) · (normal times area) over a
    /// closed surface is three times the volume.
    #[test]
    fn ver_faces_have_their_normals_outwards_and_close_the_element() {
        let cube = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let top = cube.map(|[x, y, _]| [x, y, 1.0]);
        let apex = [0.5, 0.5, 1.0];
        for (kind, corners, volume) in [
            (CellKind::Hexahedron, [&cube[..], &top].concat(), 1.0),
            (CellKind::Wedge, [cube[0], cube[1], cube[2], top[0], top[1], top[2]].to_vec(), 0.5),
            (CellKind::Pyramid, [&cube[..], &[apex]].concat(), 1.0 / 3.0),
            (CellKind::Tetra, vec![cube[0], cube[1], cube[2], apex], 1.0 / 6.0),
        ] {
            let points: Vec<nalgebra::Vector3<f64>> = corners.into_iter().map(Into::into).collect();
            let mut sum = 0.0;
            for face in sides(kind) {
                for pair in face[1..].windows(2) {
                    let [a, b, c] = [face[0], pair[0], pair[1]].map(|corner| points[corner]);
                    let area = (b - a).cross(&(c - a)) / 2.0;
                    assert!(area.dot(&(a - points.iter().sum::<nalgebra::Vector3<f64>>() / points.len() as f64)) > 0.0);
                    sum += a.dot(&area);
                }
            }
            assert!((sum / 3.0 - volume).abs() < 1e-15, "{kind:?}: {sum}");
        }
    }

    /// Middles of the faces of a hexahedron of twenty nodes lie between its corners.
    #[test]
    fn ver_faces_of_quadratic_elements_have_their_middles() {
        for kind in [CellKind::Hexahedron20, CellKind::Wedge15, CellKind::Tetra10, CellKind::Pyramid13, CellKind::Quad8]
        {
            // Each corner stands for a bit, each middle for the two of its edge.
            let first = kind.node_count() - edges(kind).len();
            let mut nodes: Vec<usize> = (0..first).map(|corner| 1 << corner).collect();
            nodes.extend(edges(kind).iter().map(|[a, b]| 1 << a | 1 << b));
            for corners in sides(kind) {
                let (_, own) = side(kind, &nodes, corners);
                let n = corners.len();
                for (place, middle) in own[n..].iter().enumerate() {
                    assert_eq!(*middle, own[place] | own[(place + 1) % n], "{kind:?} {corners:?}");
                }
                assert_eq!(own.len(), if n == 2 { 3 } else { 2 * n });
            }
        }
    }
}
