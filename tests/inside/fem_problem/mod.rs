//! Problems of one's own: the file, its checks on the mesh, and the problem they pose.

mod case;
#[path = "../../program/cylinder_on_block.rs"]
mod cylinder_on_block;
mod in_space;

use case::mesh_of;
use cylinder_on_block::TEXT;
use gearwear::scene::fem_problem::{FemProblem, Posed};
use gearwear_fem::problem::{Edge, Problem};
use gearwear_fem::solid::ElementKind;
use gearwear_mesh::Mesh;

use super::common::grid::CylinderOnBlock;

const KINDS: [ElementKind; 5] =
    [ElementKind::Triangle3, ElementKind::Triangle6, ElementKind::Quad4, ElementKind::Quad8, ElementKind::Quad9];

/// The half model with two elements along the half-width.
fn coarse(kind: ElementKind) -> Problem {
    CylinderOnBlock::nafems(kind, 2.0).problem()
}

fn posed(text: &str, mesh: &Mesh) -> Posed<Problem> {
    FemProblem::from_toml(text).unwrap().on(mesh).unwrap_or_else(|problems| panic!("{problems:?}"))
}

fn by_ends(edges: &[Edge]) -> Vec<([u32; 2], Option<u32>)> {
    let mut edges: Vec<_> = edges.iter().map(|edge| (edge.ends, edge.middle)).collect();
    edges.sort_unstable();
    edges
}

/// The file gives what the code builds: the same elements, supports, forces to round-off, and edges with their body on the
/// left although half of the lines run the other way.
#[test]
fn ver_file_and_mesh_give_the_problem_built_in_code() {
    for kind in KINDS {
        let built = coarse(kind);
        let posed = posed(TEXT, &mesh_of(&built));
        let read = &posed.problem;
        assert_eq!(read.solid, built.solid, "{kind:?}");
        assert_eq!((&read.materials, read.analysis), (&built.materials, built.analysis));
        let mut held = built.held.clone();
        held.sort_by_key(|held| held.dof);
        assert_eq!(read.held, held);
        let greatest = built.forces_n_per_mm.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
        for (read, built) in read.forces_n_per_mm.iter().zip(&built.forces_n_per_mm) {
            assert!((read - built).abs() <= 1e-14 * greatest, "{kind:?}: {read} instead of {built}");
        }
        assert_eq!(by_ends(&read.contacts[0].slave), by_ends(&built.contacts[0].slave));
        assert_eq!(by_ends(&read.contacts[0].master), by_ends(&built.contacts[0].master));
        assert_eq!((posed.bodies, posed.warnings), (vec!["cylinder".to_owned(), "block".to_owned()], Vec::new()));
    }
}

/// The mesh with the cells of its first block, the cylinder, the other way round.
fn clockwise(mesh: &Mesh) -> Mesh {
    let mut turned = mesh.clone();
    let block = &mut turned.cells[0];
    let n = block.kind.node_count();
    // Middles of a quadrilateral of eight nodes follow its corners in the same order.
    assert_eq!(n, 8);
    for cell in block.nodes.chunks_exact_mut(n) {
        cell[1..4].reverse();
        cell[4..8].reverse();
    }
    turned
}

#[test]
fn a_clockwise_mesh_is_turned_with_a_warning() {
    let built = coarse(ElementKind::Quad8);
    let mesh = mesh_of(&built);
    let posed = posed(TEXT, &clockwise(&mesh));
    assert_eq!(posed.problem.solid, built.solid);
    assert_eq!(posed.warnings, ["body \"cylinder\": all elements are given clockwise, and were turned"]);
}

/// Nodes of no body (here two, before and after all others) leave no trace but other numbers in the mesh.
#[test]
fn nodes_of_no_body_are_left_out() {
    let built = coarse(ElementKind::Triangle6);
    let mut mesh = mesh_of(&built);
    mesh.points.insert(0, [7.0, 8.0, 9.0]);
    mesh.points.push([1.0, 2.0, 3.0]);
    let shifted = mesh.cells.iter_mut().flat_map(|block| &mut block.nodes);
    shifted.chain(mesh.point_sets.values_mut().flatten()).for_each(|node| *node += 1);
    assert_eq!(posed(TEXT, &mesh).problem.solid, built.solid);
}

/// Contact surfaces named by sets of nodes, as Abaqus files often do, are the same edges.
#[test]
fn a_set_of_nodes_stands_for_the_edges_it_holds() {
    let built = coarse(ElementKind::Quad8);
    let mut mesh = mesh_of(&built);
    for (edges, name) in [(&built.contacts[0].slave, "cylinder-surface"), (&built.contacts[0].master, "block-top")] {
        mesh.cell_sets.remove(name);
        let mut nodes: Vec<usize> = edges.iter().flat_map(|edge| edge.nodes()).map(|node| node as usize).collect();
        nodes.sort_unstable();
        nodes.dedup();
        mesh.point_sets.insert(name.to_owned(), nodes);
    }
    let read = posed(TEXT, &mesh).problem;
    assert_eq!(by_ends(&read.contacts[0].slave), by_ends(&built.contacts[0].slave));
    assert_eq!(by_ends(&read.contacts[0].master), by_ends(&built.contacts[0].master));
}

/// A displacement on one component leaves the other free; a point group shares a force evenly.
#[test]
fn displacements_and_forces_on_points() {
    let built = coarse(ElementKind::Quad8);
    let mut mesh = mesh_of(&built);
    let text = TEXT.replace("force_N_per_mm = [0.0, -17500.0]", "displacement_mm = [0.5, -0.1]\ncomponents = [\"y\"]");
    let moved: Vec<_> = posed(&text, &mesh).problem.held.into_iter().filter(|h| h.displacement_mm != 0.0).collect();
    assert!(!moved.is_empty() && moved.iter().all(|held| held.dof % 2 == 1 && held.displacement_mm == -0.1));

    let nodes: Vec<usize> = built.contacts[0].slave[..2].iter().map(|edge| edge.ends[0] as usize).collect();
    mesh.point_sets.insert("points".to_owned(), nodes.clone());
    let forces = posed(&TEXT.replace("\"top\"", "\"points\""), &mesh).problem.forces_n_per_mm;
    for (dof, force) in forces.into_iter().enumerate() {
        assert_eq!(force, if dof % 2 == 1 && nodes.contains(&(dof / 2)) { -8750.0 } else { 0.0 });
    }
}

/// The resolved problem resolves to itself: every default is written out.
#[test]
fn ver_resolving_the_resolved_problem_changes_nothing() {
    let problem = FemProblem::from_toml(&TEXT.replace("title = \"cylinder on a block\"\n", "")).unwrap();
    let again = FemProblem::from_toml(&problem.to_toml()).unwrap();
    assert_eq!(again.file, problem.file);
    assert_eq!(again.to_toml(), problem.to_toml());
    assert_eq!(problem.file.title.as_deref(), Some("mesh.json"));
}

/// The schema that editors use accepts the example and refuses a misspelt key.
#[test]
fn the_schema_describes_the_file() {
    let schema = gearwear::scene::fem_problem::schema();
    let validator = jsonschema::validator_for(schema).unwrap();
    let json = |text: &str| serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap();
    assert!(validator.is_valid(&json(TEXT)));
    assert!(!validator.is_valid(&json(&TEXT.replace("friction", "frictoin"))));
    assert!(!validator.is_valid(&json(&TEXT.replace("[0.0, -17500.0]", "[0.0]"))));
}
