//! The bodies of a three-dimensional problem: hexahedra of eight and of twenty nodes, none folded, which share whole faces, edges and
//! corners.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::bodies::in_words;
use super::file::FemProblemFile;
use super::groups::Groups;
use super::meshed_groups::{MeshedBodies, place};
use super::owned_cells::{BodyNodes, owned_cells};
use crate::scene::findings::Findings;
use gearwear_fem::space::hexahedron::{HexahedronKind, edges, faces, is_sound};
use gearwear_fem::space::loads::spread_shares;
use gearwear_fem::space::problem::{SpaceElement, SpaceSolid};
use gearwear_mesh::Mesh;

/// Cells allowed in bodies in space.
const ALLOWED: &str = "hexahedra of 8 or 20 nodes";

/// The bodies of a problem in space.
pub(super) struct SpaceBodies {
    /// Nodes and elements.
    pub solid: SpaceSolid,
    /// The elements around each face, which is known by its corners.
    pub faces: BTreeMap<[u32; 4], Vec<u32>>,
    /// The middle of each edge, which is known by its ends; none where elements of eight nodes have it.
    middles: BTreeMap<[u32; 2], Option<u32>>,
    nodes: BodyNodes,
}

/// The elements of all bodies; `None` where there are none or some cannot be used.
pub(super) fn mesh_bodies(
    file: &FemProblemFile,
    mesh: &Mesh,
    groups: &Groups<'_>,
    findings: &mut Findings,
) -> Option<SpaceBodies> {
    let before = findings.problems.len();
    check_cells(file, groups, findings);
    let (cells, nodes) = owned_cells(file, mesh, groups, (3, ALLOWED), findings)?;
    if findings.problems.len() > before {
        return None;
    }
    let solid = SpaceSolid {
        points_mm: nodes.points_mm.iter().map(|&point| point.into()).collect(),
        elements: cells.into_iter().map(|cell| SpaceElement { nodes: cell.nodes, body: cell.body }).collect(),
    };
    check_elements(file, &solid, findings);
    let mut bodies = SpaceBodies { solid, faces: BTreeMap::new(), middles: BTreeMap::new(), nodes };
    bodies.connect(findings);
    (findings.problems.len() == before).then_some(bodies)
}

/// Refuses cells the solver has no element for.
fn check_cells(file: &FemProblemFile, groups: &Groups<'_>, findings: &mut Findings) {
    for (i, body) in file.body.iter().enumerate() {
        let key = format!("body[{i}].group");
        let Some(group) = groups.find(&body.group, &key, findings) else { continue };
        let kinds = group.cells[3].iter().map(|&cell| groups.cell(cell).0);
        let others = in_words(kinds.filter(|kind| HexahedronKind::of_cell(*kind).is_none()).map(|kind| (kind, 1)));
        if !others.is_empty() {
            let found = format!("{:?}, which holds other cells: {others}", body.group);
            findings.not_allowed(&key, found, format!("a group of {ALLOWED}"));
        }
    }
}

/// Refuses elements without volume somewhere.
fn check_elements(file: &FemProblemFile, solid: &SpaceSolid, findings: &mut Findings) {
    for (i, body) in file.body.iter().enumerate() {
        let folded: Vec<Vector3<f64>> = solid
            .elements
            .iter()
            .filter(|element| usize::from(element.body) == i)
            .map(|element| element.nodes.iter().map(|&node| solid.points_mm[node as usize]).collect::<Vec<_>>())
            .filter(|nodes_mm| !is_sound(nodes_mm))
            .map(|nodes_mm| nodes_mm[0])
            .collect();
        if let Some(at) = folded.first() {
            let (group, count) = (&body.group, folded.len());
            let found = format!(
                "{group:?}, of which {count} elements are folded or without volume, the first near {}",
                place(at.as_slice())
            );
            let allowed = "convex hexahedra with their nodes in the order of the mesh file's format";
            findings.not_allowed(&format!("body[{i}].group"), found, allowed);
        }
    }
}

impl SpaceBodies {
    /// Finds faces and edges; refuses edges that have a middle in one element and none, or another, in the next.
    fn connect(&mut self, findings: &mut Findings) {
        let mut hanging = None;
        for (number, element) in (0..).zip(&self.solid.elements) {
            for face in faces(&element.nodes) {
                self.faces.entry(sorted(face)).or_default().push(number);
            }
            for (ends, middle) in edges(&element.nodes) {
                let other = *self.middles.entry(sorted(ends)).or_insert(middle);
                if other != middle {
                    hanging.get_or_insert(ends[0]);
                }
            }
        }
        if let Some(node) = hanging {
            let at = place(self.solid.points_mm[node as usize].as_slice());
            let found = format!("elements that share the ends of an edge but not its middle, the first near {at}");
            findings.not_allowed("mesh.file", found, "elements of one kind wherever they are joined");
        }
    }

    /// The face of an element that a cell on these nodes of the mesh is, corners and middles.
    fn face(&self, cell: &[usize]) -> Option<Vec<u32>> {
        let nodes: Vec<u32> = cell.iter().map(|&node| self.nodes.node(node)).collect::<Option<_>>()?;
        let corners: [u32; 4] = nodes.get(..4)?.try_into().ok()?;
        let side = |k: usize| self.middles.get(&sorted([corners[k], corners[(k + 1) % 4]]));
        let is_face = self.faces.contains_key(&sorted(corners))
            && nodes.len() <= 8
            && (0..4).all(|k| side(k) == Some(&nodes.get(4 + k).copied()));
        is_face.then_some(nodes)
    }
}

fn sorted<const N: usize>(mut nodes: [u32; N]) -> [u32; N] {
    nodes.sort_unstable();
    nodes
}

impl MeshedBodies for SpaceBodies {
    const DIRECTIONS: usize = 3;
    const CARRIER: &'static str = "quadrilaterals";
    const PART: &'static str = "face";
    const PARTS: &'static str =
        "faces of elements of a body: quadrilaterals of 4 nodes on hexahedra of 8, of 8 nodes on hexahedra of 20";

    fn nodes(&self) -> &BodyNodes {
        &self.nodes
    }

    fn middles(&self, cell: &[usize]) -> Vec<u32> {
        // Lines and quadrilaterals: their corners in a ring.
        let corners: Vec<u32> = cell.iter().take(4).filter_map(|&node| self.nodes.node(node)).collect();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).filter_map(|(&a, &b)| *self.middles.get(&sorted([a, b]))?).collect()
    }

    fn spread<'m>(&self, mut cells: impl Iterator<Item = &'m [usize]>) -> Option<BTreeMap<u32, f64>> {
        let faces = cells.try_fold(BTreeMap::new(), |mut faces: BTreeMap<Vec<u32>, Vec<u32>>, cell| {
            let face = self.face(cell)?;
            let mut key = face.clone();
            key.sort_unstable();
            faces.insert(key, face);
            Some(faces)
        })?;
        Some(spread_shares(&self.solid.points_mm, faces.values().map(Vec::as_slice)))
    }
}
