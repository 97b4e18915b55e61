//! The cylinder on a block of the other tests, as a mesh with named groups and a problem file.

use gearwear_fem::problem::{Edge, Problem};
use gearwear_fem::solid::{Element, ElementKind};
use gearwear_mesh::{CellKind, Mesh};

use super::cylinder_on_block::add_block;

fn corners(element: &Element) -> usize {
    if matches!(element.kind, ElementKind::Triangle3 | ElementKind::Triangle6) { 3 } else { 4 }
}

/// The sides of an element.
fn sides(element: &Element) -> impl Iterator<Item = Edge> + '_ {
    let (nodes, n) = (element.nodes(), corners(element));
    (0..n).map(move |i| Edge { ends: [nodes[i], nodes[(i + 1) % n]], middle: nodes.get(n + i).copied() })
}

/// The mesh of a problem with two bodies, its surfaces, supports and load named as the problem file names them.
pub fn mesh_of(problem: &Problem) -> Mesh {
    let mut mesh =
        Mesh { points: problem.solid.points_mm.iter().map(|p| [p.x, p.y, 0.0]).collect(), ..Mesh::default() };
    for (material, name) in [(0, "cylinder"), (1, "block")] {
        let own: Vec<&Element> = problem.solid.elements.iter().filter(|e| e.material == material).collect();
        let nodes = own.iter().flat_map(|e| e.nodes()).map(|&n| n as usize).collect();
        add_block(&mut mesh, own[0].kind.cell_kind(), nodes, name);
    }
    let loaded = |node: u32| {
        let dof = 2 * node as usize;
        problem.forces_n_per_mm[dof] != 0.0 || problem.forces_n_per_mm[dof + 1] != 0.0
    };
    let top: Vec<Edge> =
        problem.solid.elements.iter().flat_map(sides).filter(|side| side.nodes().all(&loaded)).collect();
    for (edges, name) in
        [(&problem.contacts[0].slave, "cylinder-surface"), (&problem.contacts[0].master, "block-top"), (&top, "top")]
    {
        // Every second line the other way round: a mesh does not say on which side its body lies.
        let nodes = edges.iter().enumerate().flat_map(|(i, edge)| {
            let [a, b] = edge.ends;
            let ends = if i % 2 == 0 { [a, b] } else { [b, a] };
            ends.into_iter().chain(edge.middle).map(|n| n as usize).collect::<Vec<_>>()
        });
        let kind = if edges[0].middle.is_some() { CellKind::Line3 } else { CellKind::Line };
        let nodes = nodes.collect();
        add_block(&mut mesh, kind, nodes, name);
    }
    for (component, name) in [(0, "symmetry"), (1, "base")] {
        let held = problem.held.iter().filter(|held| held.dof % 2 == component).map(|held| (held.dof / 2) as usize);
        let mut nodes: Vec<usize> = held.collect();
        nodes.sort_unstable();
        mesh.point_sets.insert(name.to_owned(), nodes);
    }
    mesh
}
