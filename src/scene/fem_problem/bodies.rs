//! The bodies of a plane problem: elements all anticlockwise, none tangled.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::axis;
use super::file::FemProblemFile;
use super::groups::Groups;
use super::meshed_groups::MeshedBodies;
use super::owned_cells::{BodyNodes, owned_cells};
use super::sides::{BodySide, Sides, corners};
use crate::scene::findings::Findings;
use crate::scene::problem::number;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::element;
use gearwear_fem::loads::add_spread_force;
use gearwear_fem::problem::Edge;
use gearwear_fem::solid::{Element, ElementKind, Solid};
use gearwear_mesh::{CellKind, Mesh};

const MPA_PER_GPA: f64 = 1e3;
/// Tolerance of z = 0 relative to the mesh's extent, for the rounding of decimals.
const FLAT: f64 = 1e-9;

/// The bodies of a plane problem.
pub(super) struct PlaneBodies {
    /// Nodes and elements.
    pub solid: Solid,
    /// The sides of the elements.
    pub sides: Sides,
    analysis: Analysis,
    nodes: BodyNodes,
}

impl PlaneBodies {
    /// The side of an element along the line on these nodes of the mesh (ends, middle).
    pub(super) fn line_side(&self, line: &[usize]) -> Option<&BodySide> {
        let ends = [self.nodes.node(*line.first()?)?, self.nodes.node(*line.get(1)?)?];
        let side = self.sides.find(ends)?;
        match line.get(2) {
            Some(&middle) => side.edge.middle.is_some_and(|own| Some(own) == self.nodes.node(middle)).then_some(side),
            None => Some(side),
        }
    }
}

impl MeshedBodies for PlaneBodies {
    const DIRECTIONS: usize = 2;
    const CARRIER: &'static str = "lines";
    const PART: &'static str = "side";
    const PARTS: &'static str = "lines along the elements of a body";

    fn nodes(&self) -> &BodyNodes {
        &self.nodes
    }

    fn middles(&self, cell: &[usize]) -> Vec<u32> {
        self.line_side(cell).and_then(|side| side.edge.middle).into_iter().collect()
    }

    fn spread<'m>(&self, mut lines: impl Iterator<Item = &'m [usize]>) -> Option<BTreeMap<u32, f64>> {
        let sides = lines.try_fold(BTreeMap::new(), |mut sides: BTreeMap<[u32; 2], Edge>, line| {
            let edge = self.line_side(line)?.edge;
            sides.insert(edge.ends, edge);
            Some(sides)
        })?;
        let edges: Vec<Edge> = sides.into_values().collect();
        let mut unit = vec![0.0; self.solid.dofs()];
        add_spread_force(&self.solid, &edges, self.analysis, Vector2::x(), &mut unit);
        Some(edges.iter().flat_map(|edge| edge.nodes()).map(|node| (node, unit[2 * node as usize])).collect())
    }
}

/// Materials, numbered as the bodies.
pub(super) fn materials(file: &FemProblemFile) -> Vec<Elastic> {
    let materials = file.body.iter().map(|body| Elastic {
        young_modulus_mpa: body.young_modulus_GPa * MPA_PER_GPA,
        poisson_ratio: body.poisson_ratio,
    });
    materials.collect()
}

/// The elements of all bodies; `None` where there are none or some cannot be used.
pub(super) fn mesh_bodies(
    file: &FemProblemFile,
    mesh: &Mesh,
    groups: &Groups<'_>,
    findings: &mut Findings,
) -> Option<PlaneBodies> {
    let before = findings.problems.len();
    check_cells(mesh, findings);
    let (cells, nodes) = owned_cells(file, mesh, groups, (2, "triangles or quadrilaterals"), findings)?;
    if findings.problems.len() > before {
        return None;
    }
    let elements = cells.iter().filter_map(|cell| Some(Element::new(element_kind(cell.kind)?, &cell.nodes, cell.body)));
    let mut solid = Solid {
        points_mm: nodes.points_mm.iter().map(|&[x, y, _]| Vector2::new(x, y)).collect(),
        elements: elements.collect(),
    };
    let analysis = file.third_direction().in_plane().unwrap_or_default();
    if analysis == Analysis::Axisymmetric {
        axis::check(&mut solid.points_mm, FLAT * extent_mm(&nodes), findings);
    }
    check_plane(mesh, &nodes, findings);
    turn(file, &mut solid, findings);
    let sides = Sides::of(&solid);
    (findings.problems.len() == before).then_some(PlaneBodies { solid, sides, analysis, nodes })
}

/// Refuses cells the solver has no element for.
fn check_cells(mesh: &Mesh, findings: &mut Findings) {
    let plane = "lines, triangles (3 or 6 nodes) and quadrilaterals (4, 8 or 9 nodes) in the plane";
    let solids = in_words(mesh.cells.iter().filter(|block| block.kind.dimension() == 3).map(|b| (b.kind, b.len())));
    if !solids.is_empty() {
        findings.not_allowed("mesh.file", format!("solid cells: {solids}"), plane);
        findings.help("three-dimensional problems have analysis = \"three-dimensional\"");
    }
}

/// Cells counted by kind: `3 of type tetra, 1 of type wedge`.
pub(super) fn in_words(cells: impl Iterator<Item = (CellKind, usize)>) -> String {
    let mut counts: BTreeMap<CellKind, usize> = BTreeMap::new();
    cells.for_each(|(kind, count)| *counts.entry(kind).or_default() += count);
    let words = counts.iter().filter(|(_, count)| **count > 0);
    words.map(|(kind, count)| format!("{count} of type {}", name_of(*kind))).collect::<Vec<_>>().join(", ")
}

/// A kind of cell under meshio's name.
fn name_of(kind: CellKind) -> String {
    serde_json::to_value(kind).ok().and_then(|name| name.as_str().map(str::to_owned)).unwrap_or_default()
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

/// Greatest coordinate in the plane.
fn extent_mm(nodes: &BodyNodes) -> f64 {
    nodes.points_mm.iter().fold(0.0, |extent: f64, p| extent.max(p[0].abs()).max(p[1].abs()))
}

fn check_plane(mesh: &Mesh, nodes: &BodyNodes, findings: &mut Findings) {
    let extent = extent_mm(nodes);
    let mut points = mesh.points.iter().enumerate();
    let off = points.find(|(node, point)| nodes.node(*node).is_some() && point[2].abs() > FLAT * extent);
    if let Some((node, [x, y, z])) = off {
        let found = format!("node {} at x = {}, y = {}, z = {}", node + 1, number(*x), number(*y), number(*z));
        findings.not_allowed("mesh.file", found, "a mesh in the plane z = 0");
    }
}

/// Reverses clockwise elements; refuses those that are invalid in both directions.
fn turn(file: &FemProblemFile, solid: &mut Solid, findings: &mut Findings) {
    let bodies = file.body.len();
    let (mut clockwise, mut all) = (vec![0_usize; bodies], vec![0_usize; bodies]);
    let mut tangled: Vec<Vec<Vector2<f64>>> = vec![Vec::new(); bodies];
    let Solid { points_mm, elements } = solid;
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
}

/// Twice the signed area of the polygon of the corners.
fn doubled_area_mm2(points_mm: &[Vector2<f64>], element: &Element) -> f64 {
    let corners = element.nodes()[..corners(element.kind)].iter().map(|&node| points_mm[node as usize]);
    let corners: Vec<Vector2<f64>> = corners.collect();
    corners[1..].windows(2).map(|two| (two[0] - corners[0]).perp(&(two[1] - corners[0]))).sum()
}

/// Element the other way round, from the same first corner.
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
