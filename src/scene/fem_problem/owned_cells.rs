//! From the cells of the `[[body]]` groups to elements: each in one body, nodes numbered in the order of the mesh without those of no
//! body.

use super::file::FemProblemFile;
use super::groups::Groups;
use crate::scene::findings::Findings;
use gearwear_mesh::{CellKind, Mesh};

/// A cell of a body.
pub(super) struct OwnedCell {
    /// Kind of cell.
    pub kind: CellKind,
    /// Nodes, as the bodies number them.
    pub nodes: Vec<u32>,
    /// Body of the cell.
    pub body: u16,
}

/// Nodes of the bodies, and the way to them from the mesh.
pub(super) struct BodyNodes {
    /// For each node of the mesh its number in the bodies.
    number: Vec<Option<u32>>,
    /// Where the nodes lie, mm.
    pub points_mm: Vec<[f64; 3]>,
}

impl BodyNodes {
    /// The number that a node of the mesh has in the bodies, if it belongs to one.
    pub(super) fn node(&self, mesh_node: usize) -> Option<u32> {
        self.number.get(mesh_node).copied().flatten()
    }
}

/// Cells of `dimension` that belong to bodies, with their nodes; errors are reported. `allowed` names the cells that bodies may have.
pub(super) fn owned_cells(
    file: &FemProblemFile,
    mesh: &Mesh,
    groups: &Groups<'_>,
    (dimension, allowed): (u8, &str),
    findings: &mut Findings,
) -> Option<(Vec<OwnedCell>, BodyNodes)> {
    let before = findings.problems.len();
    check_mesh(mesh, findings);
    let owners = owners(file, mesh, groups, (dimension, allowed), findings);
    if findings.problems.len() > before {
        return None;
    }
    warn_of_leftovers(mesh, &owners, dimension, findings);
    Some(number_nodes(mesh, groups, &owners))
}

/// Refuses contradictions, and nodes beyond the solver's numbers.
fn check_mesh(mesh: &Mesh, findings: &mut Findings) {
    if let Err(inconsistency) = mesh.check() {
        findings.not_allowed("mesh.file", inconsistency.to_string(), "a mesh without contradictions");
    }
    if u32::try_from(mesh.points.len()).is_err() {
        let found = format!("{} nodes", mesh.points.len());
        findings.not_allowed("mesh.file", found, format!("at most {} nodes", u32::MAX));
    }
}

/// For each block of the mesh the body of each of its cells.
fn owners(
    file: &FemProblemFile,
    mesh: &Mesh,
    groups: &Groups<'_>,
    (dimension, allowed): (u8, &str),
    findings: &mut Findings,
) -> Vec<Vec<Option<u16>>> {
    let mut owner: Vec<Vec<Option<u16>>> = mesh.cells.iter().map(|block| vec![None; block.len()]).collect();
    for (i, body) in file.body.iter().enumerate() {
        let key = format!("body[{i}].group");
        let Some(group) = groups.find(&body.group, &key, findings) else { continue };
        let Ok(number) = u16::try_from(i) else {
            let found = format!("{} bodies", file.body.len());
            findings.not_allowed(&key, found, format!("at most {}", 1 + usize::from(u16::MAX)));
            break;
        };
        let cells = &group.cells[usize::from(dimension)];
        if cells.is_empty() {
            let found = format!("{:?}, which holds {}", body.group, group.in_words());
            findings.not_allowed(&key, found, format!("a group of {allowed}"));
        }
        let mut taken: Option<(u16, usize)> = None;
        for &(block, cell) in cells {
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

fn warn_of_leftovers(mesh: &Mesh, owners: &[Vec<Option<u16>>], dimension: u8, findings: &mut Findings) {
    let cells = mesh.cells.iter().zip(owners).filter(|(block, _)| block.kind.dimension() == dimension);
    let left = cells.flat_map(|(_, owner)| owner).filter(|owner| owner.is_none()).count();
    if left > 0 {
        let elements = if left == 1 { "element belongs" } else { "elements belong" };
        findings.warnings.push(format!("{left} {elements} to no [[body]]: left out"));
    }
}

fn number_nodes(mesh: &Mesh, groups: &Groups<'_>, owners: &[Vec<Option<u16>>]) -> (Vec<OwnedCell>, BodyNodes) {
    let owned = owners.iter().enumerate().flat_map(|(block, cells)| {
        cells.iter().enumerate().filter_map(move |(cell, owner)| owner.map(|body| ((block, cell), body)))
    });
    let mut used = vec![false; mesh.points.len()];
    for (cell, _) in owned.clone() {
        for &node in groups.cell(cell).1 {
            used[node] = true;
        }
    }
    let mut points_mm = Vec::new();
    let number: Vec<Option<u32>> = used
        .into_iter()
        .zip(&mesh.points)
        .map(|(used, point)| {
            used.then(|| {
                points_mm.push(*point);
                points_mm.len() as u32 - 1
            })
        })
        .collect();
    let cells = owned.map(|(cell, body)| {
        let (kind, nodes) = groups.cell(cell);
        OwnedCell { kind, nodes: nodes.iter().filter_map(|&node| number[node]).collect(), body }
    });
    (cells.collect(), BodyNodes { number, points_mm })
}
