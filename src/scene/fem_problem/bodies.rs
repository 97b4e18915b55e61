//! From the cells of the `[[body]]` groups to elements: all anticlockwise, none tangled, each in one body.

use nalgebra::Vector2;

use super::file::FemProblemFile;
use super::groups::{CellRef, Groups};
use super::sides::corners;
use crate::fem::elastic::Elastic;
use crate::fem::element;
use crate::fem::solid::{Element, ElementKind, Solid};
use crate::mesh::{CellKind, Mesh};
use crate::scene::findings::Findings;
use crate::scene::problem::number;

const MPA_PER_GPA: f64 = 1e3;
/// A node may lie this far from the plane z = 0, relative to the mesh's extent: what writing decimals leaves.
const FLAT: f64 = 1e-9;

/// The bodies with the way back to the mesh.
#[derive(Debug)]
pub(super) struct Meshed {
    /// Nodes and elements.
    pub solid: Solid,
    /// For each node of the mesh its number in the solid.
    solid_node: Vec<Option<u32>>,
}

impl Meshed {
    /// The number that a node of the mesh has in the solid, if it belongs to a body.
    pub(super) fn node(&self, mesh_node: usize) -> Option<u32> {
        self.solid_node.get(mesh_node).copied().flatten()
    }
}

/// Materials, numbered as the bodies.
pub(super) fn materials(file: &FemProblemFile) -> Vec<Elastic> {
    let material = |body: &super::BodyFile| Elastic {
        young_modulus_mpa: body.young_modulus_GPa * MPA_PER_GPA,
        poisson_ratio: body.poisson_ratio,
    };
    file.body.iter().map(material).collect()
}

/// The elements of all bodies; `None` where there are none or some cannot be used.
pub(super) fn mesh_bodies(
    file: &FemProblemFile,
    mesh: &Mesh,
    groups: &Groups<'_>,
    findings: &mut Findings,
) -> Option<Meshed> {
    let before = findings.problems.len();
    check_cells(mesh, findings);
    let owned = owners(file, mesh, groups, findings);
    if findings.problems.len() > before {
        return None;
    }
    warn_of_leftovers(mesh, &owned, findings);
    let meshed = number_nodes(mesh, groups, owned);
    check_plane(mesh, &meshed, findings);
    let meshed = turned(file, meshed, findings);
    (findings.problems.len() == before).then_some(meshed)
}

/// Refuses cells the solver has no element for, and nodes that are not there.
fn check_cells(mesh: &Mesh, findings: &mut Findings) {
    let plane = "lines, triangles (3 or 6 nodes) and quadrilaterals (4, 8 or 9 nodes) in the plane";
    let mut solids: Vec<String> = Vec::new();
    for kind in CellKind::ALL.into_iter().filter(|kind| kind.dimension() == 3) {
        let count: usize = mesh.cells.iter().filter(|block| block.kind == kind).map(|block| block.len()).sum();
        if count > 0 {
            solids.push(format!("{count} of type {}", name_of(kind)));
        }
    }
    if !solids.is_empty() {
        findings.not_allowed("mesh.file", format!("solid cells: {}", solids.join(", ")), plane);
    }
    if let Err(inconsistency) = mesh.check() {
        findings.not_allowed("mesh.file", inconsistency.to_string(), "a mesh without contradictions");
    }
    if u32::try_from(mesh.points.len()).is_err() {
        let found = format!("{} nodes", mesh.points.len());
        findings.not_allowed("mesh.file", found, format!("at most {} nodes", u32::MAX));
    }
}

/// A kind of cell under meshio's name.
fn name_of(kind: CellKind) -> String {
    serde_json::to_value(kind).ok().and_then(|name| name.as_str().map(str::to_owned)).unwrap_or_default()
}

/// For each block of the mesh the body of each of its cells.
fn owners(file: &FemProblemFile, mesh: &Mesh, groups: &Groups<'_>, findings: &mut Findings) -> Vec<Vec<Option<u16>>> {
    let mut owner: Vec<Vec<Option<u16>>> = mesh.cells.iter().map(|block| vec![None; block.len()]).collect();
    for (i, body) in file.body.iter().enumerate() {
        let key = format!("body[{i}].group");
        let Some(group) = groups.find(&body.group, &key, findings) else { continue };
        let Ok(number) = u16::try_from(i) else {
            let found = format!("{} bodies", file.body.len());
            findings.not_allowed(&key, found, format!("at most {}", 1 + usize::from(u16::MAX)));
            break;
        };
        if group.cells[2].is_empty() {
            let found = format!("{:?}, which holds {}", body.group, group.in_words());
            findings.not_allowed(&key, found, "a group of triangles or quadrilaterals");
        }
        let mut taken: Option<(u16, usize)> = None;
        for &(block, cell) in &group.cells[2] {
            match &mut owner[block][cell] {
                Some(other) if *other == number => {}
                Some(other) => taken = Some((*other, taken.map_or(0, |(_, count)| count) + 1)),
                free => *free = Some(number),
            }
        }
        if let Some((other, count)) = taken {
            let other = &file.body[usize::from(other)].group;
            let found = format!("{:?}, of which {count} elements belong to the body {other:?} too", body.group);
            findings.not_allowed(&key, found, "every element in one body");
        }
    }
    owner
}

fn warn_of_leftovers(mesh: &Mesh, owner: &[Vec<Option<u16>>], findings: &mut Findings) {
    let surfaces = mesh.cells.iter().zip(owner).filter(|(block, _)| block.kind.dimension() == 2);
    let left = surfaces.flat_map(|(_, owner)| owner).filter(|owner| owner.is_none()).count();
    if left > 0 {
        let elements = if left == 1 { "element belongs" } else { "elements belong" };
        findings.warnings.push(format!("{left} {elements} to no [[body]]: left out"));
    }
}

/// Elements as they stand in the mesh, nodes numbered in the mesh's order without those of no body.
fn number_nodes(mesh: &Mesh, groups: &Groups<'_>, owner: Vec<Vec<Option<u16>>>) -> Meshed {
    let owned = || {
        owner.iter().enumerate().flat_map(|(block, cells)| {
            cells.iter().enumerate().filter_map(move |(cell, owner)| owner.map(|body| ((block, cell), body)))
        })
    };
    let mut used = vec![false; mesh.points.len()];
    for (cell, _) in owned() {
        for &node in groups.cell(cell).1 {
            used[node] = true;
        }
    }
    let mut points_mm = Vec::new();
    let solid_node: Vec<Option<u32>> = used
        .into_iter()
        .zip(&mesh.points)
        .map(|(used, &[x, y, _])| {
            used.then(|| {
                points_mm.push(Vector2::new(x, y));
                points_mm.len() as u32 - 1
            })
        })
        .collect();
    let element = |(cell, body): (CellRef, u16)| {
        let (kind, nodes) = groups.cell(cell);
        let nodes: Vec<u32> = nodes.iter().filter_map(|&node| solid_node[node]).collect();
        element_kind(kind).map(|kind| Element::new(kind, &nodes, body))
    };
    let elements = owned().filter_map(element).collect();
    Meshed { solid: Solid { points_mm, elements }, solid_node }
}

fn element_kind(kind: CellKind) -> Option<ElementKind> {
    match kind {
        CellKind::Triangle => Some(ElementKind::Triangle3),
        CellKind::Triangle6 => Some(ElementKind::Triangle6),
        CellKind::Quad => Some(ElementKind::Quad4),
        CellKind::Quad8 => Some(ElementKind::Quad8),
        CellKind::Quad9 => Some(ElementKind::Quad9),
        _ => None,
    }
}

fn check_plane(mesh: &Mesh, meshed: &Meshed, findings: &mut Findings) {
    let extent = meshed.solid.points_mm.iter().fold(0.0, |extent: f64, p| extent.max(p.amax()));
    let off = |(node, point): &(usize, &[f64; 3])| meshed.node(*node).is_some() && point[2].abs() > FLAT * extent;
    if let Some((node, [x, y, z])) = mesh.points.iter().enumerate().find(off) {
        let found = format!("node {} at x = {}, y = {}, z = {}", node + 1, number(*x), number(*y), number(*z));
        findings.not_allowed("mesh.file", found, "a mesh in the plane z = 0");
    }
}

/// The same with clockwise elements turned; refuses what is no element either way round.
fn turned(file: &FemProblemFile, mut meshed: Meshed, findings: &mut Findings) -> Meshed {
    let bodies = file.body.len();
    let (mut clockwise, mut all) = (vec![0_usize; bodies], vec![0_usize; bodies]);
    let mut tangled: Vec<Vec<Vector2<f64>>> = vec![Vec::new(); bodies];
    let Solid { points_mm, elements } = &mut meshed.solid;
    for element in elements {
        let body = usize::from(element.material);
        all[body] += 1;
        if doubled_area_mm2(points_mm, element) < 0.0 {
            *element = reversed(element);
            clockwise[body] += 1;
        }
        if !is_sound(points_mm, element) {
            tangled[body].push(points_mm[element.nodes()[0] as usize]);
        }
    }
    for (i, body) in file.body.iter().enumerate() {
        if clockwise[i] > 0 {
            let count = if clockwise[i] == all[i] { "all".to_owned() } else { clockwise[i].to_string() };
            findings
                .warnings
                .push(format!("body {:?}: {count} elements are given clockwise, and were turned", body.group));
        }
        if let Some(at) = tangled[i].first() {
            let found = format!(
                "{:?}, of which {} elements are tangled or without area, the first near x = {}, y = {}",
                body.group,
                tangled[i].len(),
                number(at.x),
                number(at.y)
            );
            let allowed = "convex elements, whose sides do not fold over";
            findings.not_allowed(&format!("body[{i}].group"), found, allowed);
        }
    }
    meshed
}

/// Twice the signed area of the polygon of the corners.
fn doubled_area_mm2(points_mm: &[Vector2<f64>], element: &Element) -> f64 {
    let corners = &element.nodes()[..corners(element.kind)];
    let at = |i: usize| points_mm[corners[i % corners.len()] as usize];
    (1..corners.len() - 1).map(|i| (at(i) - at(0)).perp(&(at(i + 1) - at(0)))).sum()
}

/// The same element the other way round, from the same first corner.
fn reversed(element: &Element) -> Element {
    let nodes = element.nodes();
    let n = corners(element.kind);
    let mut turned = vec![nodes[0]];
    turned.extend(nodes[1..n].iter().rev());
    // Side i from corner i to i + 1 becomes side n − 1 − i.
    if nodes.len() > n {
        turned.extend(nodes[n..2 * n].iter().rev());
        turned.extend(&nodes[2 * n..]);
    }
    Element::new(element.kind, &turned, element.material)
}

/// Whether the solver can integrate the element.
fn is_sound(points_mm: &[Vector2<f64>], element: &Element) -> bool {
    let nodes: Vec<Vector2<f64>> = element.nodes().iter().map(|&node| points_mm[node as usize]).collect();
    element::is_sound(element.kind, &nodes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(nodes: &[u32]) -> (Vec<Vector2<f64>>, Element) {
        let ring = [
            (0.0, 0.0),
            (2.0, 0.0),
            (2.0, 2.0),
            (0.0, 2.0),
            (1.0, 0.0),
            (2.0, 1.0),
            (1.0, 2.0),
            (0.0, 1.0),
            (1.0, 1.0),
        ];
        let points = ring.iter().map(|&(x, y)| Vector2::new(x, y)).collect();
        let kind = match nodes.len() {
            3 => ElementKind::Triangle3,
            4 => ElementKind::Quad4,
            6 => ElementKind::Triangle6,
            8 => ElementKind::Quad8,
            _ => ElementKind::Quad9,
        };
        (points, Element::new(kind, nodes, 0))
    }

    /// Each kind clockwise, and the same anticlockwise from the same corner, middles beside their sides.
    #[test]
    fn a_clockwise_element_is_turned_with_its_middles() {
        for (clockwise, turned) in [
            (vec![0, 3, 2], vec![0, 2, 3]),
            (vec![0, 3, 2, 1], vec![0, 1, 2, 3]),
            (vec![0, 2, 1, 8, 5, 4], vec![0, 1, 2, 4, 5, 8]),
            (vec![0, 3, 2, 1, 7, 6, 5, 4], vec![0, 1, 2, 3, 4, 5, 6, 7]),
            (vec![0, 3, 2, 1, 7, 6, 5, 4, 8], vec![0, 1, 2, 3, 4, 5, 6, 7, 8]),
        ] {
            let (points, element) = square(&clockwise);
            assert!(doubled_area_mm2(&points, &element) < 0.0);
            assert!(!is_sound(&points, &element));
            let element = reversed(&element);
            assert_eq!(element.nodes(), turned);
            assert!(is_sound(&points, &element));
        }
    }

    #[test]
    fn folded_elements_are_not_sound() {
        for nodes in [vec![0, 2, 1, 3], vec![0, 1, 4], vec![0, 1, 2, 3, 6, 5, 4, 7]] {
            let (points, element) = square(&nodes);
            assert!(!is_sound(&points, &element), "{nodes:?}");
        }
    }
}
