//! Three-dimensional problems: what the program writes and what it refuses.

#[path = "../../program/hexahedra.rs"]
mod hexahedra;

use std::fs;

use gearwear::mesh::{CellKind, Mesh, Values, read};
use hexahedra::{BAR, add, mesh_of_box};

use super::Case;
use super::cylinder_on_block::TEXT;

fn mesh() -> Mesh {
    mesh_of_box(CellKind::Hexahedron20, [2, 1, 1], |x| x)
}

fn case() -> Case {
    Case::new(BAR, &mesh())
}

/// The bar on a mesh that `change` spoiled.
fn spoiled(change: impl FnOnce(&mut Mesh)) -> Case {
    let mut mesh = mesh();
    change(&mut mesh);
    Case::new(BAR, &mesh)
}

/// Everything the contract names is there, and the folder holds nothing else; σ = 100 N/mm² in the bar of 1 mm².
#[test]
fn results_are_complete() {
    let case = case();
    let (summary, message) = case.solved();
    assert!(!message.contains("warning"), "{message}");
    assert_eq!((&summary["analysis"], &summary["stopped"]), (&"three-dimensional".into(), &"converged".into()));
    assert_eq!((&summary["elements"], &summary["dofs"], &summary["iterations"]), (&2.into(), &96.into(), &1.into()));
    assert_eq!((&summary["contact"], &summary["mesh"]["quality"]), (&serde_json::json!([]), &serde_json::Value::Null));
    for key in ["title", "program_version", "problem_hash", "stages", "wall_s", "work", "warnings"] {
        assert!(!summary[key].is_null(), "no {key}");
    }
    // σ/E (2, −0.3, −0.3) mm at the far corner.
    let corner = 100.0 / 206e3 * f64::sqrt(4.0 + 2.0 * 0.09);
    for (key, expected) in [("peak_von_mises_MPa", 100.0), ("greatest_displacement_mm", corner)] {
        let found = summary[key].as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-9, "{key} {found}");
    }
    for key in ["residual", "force_balance"] {
        assert!(summary[key].as_f64().unwrap() < 1e-12, "{key}");
    }
    assert_eq!(summary["greatest_displacement_at_mm"][0], 2.0);

    let mut names: Vec<String> =
        fs::read_dir(case.out()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["problem.toml", "report.html", "solution.vtu", "summary.json"]);
    let solution = read(case.out().join("solution.vtu")).unwrap();
    assert_eq!((solution.points.len(), solution.cells[0].kind), (32, CellKind::Hexahedron20));
    for (name, components, first) in
        [("displacement_mm", 3, 0.0), ("stress_MPa", 6, 100.0), ("von_mises_MPa", 1, 100.0)]
    {
        let data = &solution.point_data[name];
        let Values::Reals(values) = &data.values else { panic!("{name} are no reals") };
        assert_eq!((data.components, values.len()), (components, 32 * components));
        assert!((values[0] - first).abs() < 1e-6, "{name} {}", values[0]);
    }
    let page = fs::read_to_string(case.out().join("report.html")).unwrap();
    for part in ["three-dimensional", "ParaView", "Poisson’s ratio", "x1: force", "free"] {
        assert!(page.contains(part), "no {part:?} on the page");
    }
    let (_, out, _) = case.run();
    assert!(out.contains("maximum displacement, mm") && out.contains("at 2.000, 1.000, 1.000 mm"), "{out}");
}

#[test]
fn keys_of_the_other_kind_of_problem() {
    let force = "force_N = [100.0, 0.0, 0.0]";
    for (new, line, parts) in [
        ("force_N = [1.0, 2.0]", "force_N", ["load[0].force_N: found a list of 2", "three numbers, [x, y, z]"]),
        ("force_N_per_mm = [1.0, 2.0]", "force_N_per_mm", ["load[0].force_N_per_mm: found", "force_N, three numbers"]),
        (
            "displacement_mm = [1.0, 2.0]",
            "displacement_mm",
            ["load[0].displacement_mm: found a list of 2", "[x, y, z]"],
        ),
    ] {
        case().with(force, new).refused(line, &parts);
    }
    let contact = format!("{BAR}\n[[contact]]\nslave = \"x0\"\nmaster = \"x1\"\n");
    Case::new(&contact, &mesh()).refused("[[contact]]", &["three-dimensional problems have no contact"]);

    let plane = |old: &str, new: &str| Case::new(TEXT, &super::mesh()).with(old, new);
    let force = "force_N_per_mm = [0.0, -17500.0]";
    plane(force, "force_N = [0.0, 0.0, 1.0]")
        .refused("force_N", &["load[0].force_N: found", "force_N_per_mm, two numbers"]);
    plane(force, "displacement_mm = [0.0, 0.0, 1.0]")
        .refused("displacement_mm", &["load[0].displacement_mm: found a list of 3", "two numbers, [x, y]"]);
    plane(force, "force_N_per_mm = [0.0, 0.0, 1.0]").refused("force_N_per_mm", &["found a list of 3"]);
    plane("components = [\"x\"]", "components = [\"z\"]")
        .refused("components = [\"z\"]", &["fixed[0].components[0]: found \"z\"", "\"x\" or \"y\""]);
    Case::new(&TEXT.replace("title", "analysis = \"plane-strain\"\ntitle"), &mesh())
        .refused("file", &["solid cells: 2 of type hexahedron20", "analysis = \"three-dimensional\""]);
}

#[test]
fn bodies_of_other_cells() {
    spoiled(|mesh| add(mesh, CellKind::Tetra, vec![0, 1, 2, 4], "box"))
        .refused("group = \"box\"", &["body[0].group", "1 of type tetra", "hexahedra of 8 or 20 nodes"]);
    case().with("group = \"box\"", "group = \"x0\"").refused("group = \"x0\"", &["body[0].group", "1 surface"]);
    case().with("group = \"box\"", "group = \"bocks\"").refused("group = \"bocks\"", &["which the mesh does not have"]);
    let twice = BAR.replace(
        "[[fixed]]\ngroup = \"x0\"",
        "[[body]]\ngroup = \"box\"\nyoung_modulus_GPa = 1.0\npoisson_ratio = 0.0\n\n[[fixed]]\ngroup = \"x0\"",
    );
    Case::new(&twice, &mesh()).says(&["body[1].group", "belong to the body \"box\" too"]);
}

#[test]
fn folded_elements_and_hanging_nodes() {
    spoiled(|mesh| mesh.points[1][0] += 3.0)
        .refused("group = \"box\"", &["body[0].group", "2 elements are folded", "near x = 0, y = 0, z = 0"]);
    spoiled(|mesh| {
        let mut mixed = mesh_of_box(CellKind::Hexahedron, [1, 1, 1], |x| x);
        let corners: Vec<usize> = mixed.cells[0].nodes[..].to_vec();
        // An element of eight nodes on the end of the bar.
        let first = mesh.points.len();
        mixed.points.iter_mut().for_each(|point| point[0] += 2.0);
        let known = |point: &[f64; 3]| mesh.points.iter().position(|other| other == point);
        let numbers: Vec<usize> =
            mixed.points.iter().enumerate().map(|(i, point)| known(point).unwrap_or(first + i)).collect();
        mesh.points.extend(mixed.points);
        let nodes = corners.into_iter().map(|node| numbers[node]).collect();
        mesh.cell_sets.get_mut("box").unwrap().push(vec![0]);
        mesh.cells.push(gearwear::mesh::CellBlock::new(CellKind::Hexahedron, nodes));
        for (name, set) in &mut mesh.cell_sets {
            if name != "box" {
                set.push(Vec::new());
            }
        }
    })
    .refused("file", &["share the ends of an edge but not its middle", "near x = 2"]);
}

#[test]
fn loads_that_lie_on_no_face() {
    let linear = |mesh: &mut Mesh| {
        let face = mesh.cells.iter().find(|block| block.kind == CellKind::Quad8).unwrap().nodes[..4].to_vec();
        add(mesh, CellKind::Quad, face, "linear");
    };
    let load = |group: &str| BAR.replace("group = \"x1\"", &format!("group = \"{group}\""));
    let case = |group, change: &dyn Fn(&mut Mesh)| {
        let mut mesh = mesh();
        change(&mut mesh);
        Case::new(&load(group), &mesh)
    };
    case("linear", &linear)
        .refused("group = \"linear\"", &["load[0].group", "face of no element", "of 8 nodes on hexahedra of 20"]);
    let across = |mesh: &mut Mesh| add(mesh, CellKind::Quad, vec![0, 1, 6, 7], "across");
    case("across", &across).refused("group = \"across\"", &["load[0].group", "face of no element"]);
    case("box", &|_| {}).says(&["load[0].group", "2 volumes", "a group of quadrilaterals or points for a force"]);
    case("x0", &|_| {}).refused("force_N", &["a force along x on \"x0\", every node of which is held along x"]);
}

/// Each motion that is left: turning about x without the third support's second direction, everything without any.
#[test]
fn bodies_that_nothing_holds() {
    let (head, _) = BAR.split_once("[[fixed]]").unwrap();
    let load = "[[load]]\ngroup = \"x1\"\nforce_N = [100.0, 0.0, 0.0]\n";
    let held = |supports: &str| Case::new(&format!("{head}{supports}\n{load}"), &mesh());
    held("").refused("[[body]]", &["body[0]: found a body that nothing holds", "supports that hold every body"]);
    held("[[fixed]]\ngroup = \"y0\"\n").solved();
    case()
        .with("group = \"z0\"\ncomponents = [\"z\"]", "group = \"y0\"\ncomponents = [\"y\"]")
        .refused("[[body]]", &["a body that can move along z"]);
    let mut mesh = mesh();
    let on_axis = |point: &[f64; 3]| point[1] == 0.0 && point[2] == 0.0;
    mesh.point_sets.insert("axis".to_owned(), (0..mesh.points.len()).filter(|&n| on_axis(&mesh.points[n])).collect());
    Case::new(&format!("{head}[[fixed]]\ngroup = \"axis\"\n\n{load}"), &mesh)
        .refused("[[body]]", &["can turn about the axis along x through x = 1, y = 0, z = 0"]);
}

/// Two cubes that share one edge turn about it like a hinge.
#[test]
fn bodies_joined_like_a_hinge() {
    let mut mesh = mesh_of_box(CellKind::Hexahedron, [2, 2, 1], |x| x);
    let cells = &mut mesh.cells[0].nodes;
    let last = cells.split_off(24);
    cells.truncate(8);
    cells.extend(last);
    mesh.cell_sets.get_mut("box").unwrap()[0] = vec![0, 1];
    let text = BAR.split_once("[[fixed]]").unwrap().0;
    let text = format!("{text}[[fixed]]\ngroup = \"low\"\n\n[[load]]\ngroup = \"high\"\nforce_N = [1.0, 0.0, 0.0]\n");
    let at = |mesh: &Mesh, x: f64| (0..mesh.points.len()).filter(|&n| mesh.points[n][0] == x).collect::<Vec<_>>();
    let (low, high) = (at(&mesh, 0.0), at(&mesh, 2.0));
    mesh.point_sets.extend([("low".to_owned(), low), ("high".to_owned(), high)]);
    Case::new(&text, &mesh).refused("[[body]]", &["can turn about the axis along z through x = 1, y = 1"]);
}
