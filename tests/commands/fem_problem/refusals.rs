//! Wrong problems: exit status 2, and a message with file, line, key, what was found and what is allowed.

use gearwear::mesh::{CellKind, Mesh};

use super::cylinder_on_block::{TEXT, add_block};
use super::{Case, mesh};

fn case() -> Case {
    Case::new(TEXT, &mesh())
}

/// The problem on a mesh that `change` spoiled.
fn spoiled(change: impl FnOnce(&mut Mesh)) -> Case {
    let mut mesh = mesh();
    change(&mut mesh);
    Case::new(TEXT, &mesh)
}

/// The elements of the mesh, those of the block last.
fn quads(mesh: &Mesh) -> impl DoubleEndedIterator<Item = &[usize]> {
    let blocks = mesh.cells.iter().filter(|block| block.kind == CellKind::Quad8);
    blocks.flat_map(|block| block.nodes.chunks_exact(CellKind::Quad8.node_count()))
}

#[test]
fn keys_and_values_that_no_problem_has() {
    for (old, new, line, part) in [
        ("friction = 0.0", "frictoin = 0.0", "frictoin", "unknown key contact[0].frictoin"),
        ("friction = 0.0", "friction = 0.3", "friction", "friction (0.3) is not available in this version"),
        ("components = [\"x\"]", "components = [\"z\"]", "components = [\"z\"]", "fixed[0].components[0]: found \"z\""),
        ("components = [\"x\"]", "components = []", "components = []", "fixed[0].components: found an empty list"),
        ("[0.0, -17500.0]", "[0.0]", "force_N_per_mm", "load[0].force_N_per_mm: found a list of 1"),
        ("poisson_ratio = 0.3", "poisson_ratio = 0.5", "poisson_ratio = 0.5", "body[0].poisson_ratio: found 0.5"),
        ("master = \"block-top\"", "master = \"cylinder-surface\"", "master", "which is the slave too"),
        ("title", "analysis = \"antiplane\"\ntitle", "analysis", "\"plane-strain\", \"plane-stress\""),
        (
            "group = \"top\"",
            "group = \"top\"\ndisplacement_mm = [0.0, -0.1]",
            "displacement_mm",
            "a displacement beside force_N_per_mm",
        ),
        ("group = \"top\"", "group = \"top\"\ncomponents = [ \"y\" ]", "components = [ ", "components of a force"),
    ] {
        let case = case().with(old, new);
        // The line may stand in the file before, in another table; the one exchanged is meant.
        let line = case.text.lines().filter(|l| l.starts_with(line)).map(str::to_owned).next().unwrap();
        case.refused(&line, &[part]);
    }
}

#[test]
fn what_is_missing_is_named() {
    case().with("young_modulus_GPa = 70.0\n", "").says(&["body[1].young_modulus_GPa is missing", "greater than 0"]);
    case()
        .with("force_N_per_mm = [0.0, -17500.0]\n", "")
        .says(&["load[0].force_N_per_mm is missing", "displacement_mm"]);
    case().with("[mesh]\nfile = \"mesh.json\"", "").says(&["mesh is missing"]);
    case().with("[mesh]", "[pair]\nface_width_mm = 14.0\n[mesh]").says(&["both [mesh] and [pair]"]);
    case().with("[[body]]\ngroup = \"cylinder\"", "[body]\ngroup = \"cylinder\"").says(&["problem.toml:"]);
}

#[test]
fn mesh_files_that_cannot_be_read() {
    case().with("mesh.json", "elsewhere.msh").refused("file", &["mesh.file", "elsewhere.msh", "No such file"]);
    case().with("mesh.json", "problem.toml").refused("file", &["mesh.file", "problem.toml", ".msh"]);
}

#[test]
fn groups_that_are_not_there_or_of_the_wrong_dimension() {
    case().with("\"block\"", "\"blok\"").refused(
        "group = \"blok\"",
        &["body[1].group", "which the mesh does not have", "block (", "did you mean \"block\"?"],
    );
    case()
        .with("group = \"block\"", "group = \"block-top\"")
        .refused("group = \"block-top\"", &["body[1].group", "lines"]);
    case().with("group = \"top\"", "group = \"block\"").says(&["load[0].group", "surfaces", "lines or points"]);
    case()
        .with("slave = \"cylinder-surface\"", "slave = \"block\"")
        .refused("slave", &["contact[0].slave", "surfaces"]);
}

#[test]
fn cells_that_are_in_two_bodies_or_in_none() {
    case()
        .with("group = \"block\"", "group = \"cylinder\"")
        .says(&["body[1].group", "belong to the body \"cylinder\" too"]);
    let case = spoiled(|mesh| {
        let from = mesh.points.len();
        mesh.points.extend([[500.0, 0.0, 0.0], [501.0, 0.0, 0.0], [500.0, 1.0, 0.0]]);
        add_block(mesh, CellKind::Triangle, vec![from, from + 1, from + 2], "lost");
    });
    let (_, message) = case.solved();
    assert!(message.contains("1 element belongs to no [[body]]: left out"), "{message}");
}

#[test]
fn meshes_that_are_not_plane() {
    spoiled(|mesh| mesh.points[5][2] = 0.1).refused("file", &["node 6", "z = 0.1", "the plane z = 0"]);
    spoiled(|mesh| add_block(mesh, CellKind::Tetra, vec![0, 1, 2, 3], "solid"))
        .refused("file", &["1 of type tetra", "triangles"]);
}

/// A node of the block moved across its element.
#[test]
fn tangled_elements() {
    let corner = quads(&mesh()).last().unwrap()[0];
    spoiled(|mesh| mesh.points[corner][0] += 300.0)
        .refused("group = \"block\"", &["body[1].group", "tangled", "convex elements"]);
}

#[test]
fn contact_lines_off_the_surface() {
    // A side inside the block: of its second element, towards the third.
    let inner = quads(&mesh()).rev().nth(1).unwrap().to_vec();
    let set = |mesh: &mut Mesh, nodes: [usize; 3]| {
        mesh.cell_sets.remove("block-top");
        add_block(mesh, CellKind::Line3, nodes.to_vec(), "block-top");
    };
    let lines: Vec<[usize; 3]> = (0..4).map(|i| [inner[i], inner[(i + 1) % 4], inner[4 + i]]).collect();
    let messages: Vec<String> = lines
        .into_iter()
        .map(|line| spoiled(|mesh| set(mesh, line)).run().2)
        .filter(|message| message.contains("contact[0].master") && message.contains("inside a body"))
        .collect();
    assert!(!messages.is_empty(), "no side of an inner element was refused");
    spoiled(|mesh| set(mesh, [inner[0], inner[2], inner[4]])).refused("master", &["the side of no element of a body"]);
}

#[test]
fn supports_and_loads_that_contradict() {
    case().with("[[contact]]", "[[load]]\ngroup = \"base\"\ndisplacement_mm = [0.0, -0.1]\n\n[[contact]]").says(&[
        "load[1]: found the displacement -0.1 mm along y",
        "to which fixed[1] gives 0 mm",
        "one displacement",
    ]);
    case().with("group = \"top\"", "group = \"base\"").says(&["load[0]"]);
    case()
        .with("[[contact]]", "[[fixed]]\ngroup = \"top\"\n\n[[contact]]")
        .refused("force_N_per_mm", &["a force along y on \"top\", every node of which is held along y"]);
}

/// Each body that nothing can hold: without its line of symmetry the block slides, and the cylinder rolls as well.
#[test]
fn bodies_that_nothing_holds() {
    case().with("group = \"symmetry\"\ncomponents = [\"x\"]", "group = \"base\"\ncomponents = [\"y\"]").says(&[
        "a body that can move in",
        "ways that nothing resists",
        "hold it in one more direction",
    ]);
    let without_contact = TEXT.split("[[contact]]").next().unwrap();
    Case::new(without_contact, &mesh())
        .refused("[[body]]", &["body[0]: found a body that can move along y", "supports"]);
}

impl Case {
    /// Runs it, which must be refused saying all of `parts`.
    pub(super) fn says(&self, parts: &[&str]) {
        let (status, _, message) = self.run();
        assert_eq!(status, Some(2), "{message}");
        for part in parts {
            assert!(message.contains(part), "no {part:?} in:\n{message}");
        }
    }
}

/// The cylinder is 50 mm in radius, the block 200 mm wide: a strain of 100 is far from anything meant.
#[test]
fn loads_that_cannot_be_meant() {
    let case = || Case::new(TEXT, &mesh());
    case()
        .with("-17500.0", "-1e70")
        .refused("force_N_per_mm", &["load[0].force_N_per_mm", "1.000e70", "check the units"]);
    case()
        .with("young_modulus_GPa = 70.0", "young_modulus_GPa = 1e-265")
        .refused("young_modulus_GPa = 1e-265", &["body[1].young_modulus_GPa: found 1e-265", "at least"]);
    case()
        .with("force_N_per_mm = [0.0, -17500.0]", "displacement_mm = [0.0, -1e9]")
        .refused("displacement_mm", &["load[0].displacement_mm", "a hundred times their extent"]);
}
