//! Three-dimensional problems through file and mesh, against closed forms and a benchmark.

#[path = "../../program/hexahedra.rs"]
mod hexahedra;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::fs;

use gearwear::scene::fem_problem::FemProblem;
use gearwear_mesh::{CellKind, Format, Mesh, to_bytes};
use gearwear_physics::results::fem_problem::{FemRecord, FemSolution, SpaceSolution};
use hexahedra::{BAR, add, mesh_of_box};

use crate::Unwatched;
use crate::inside::common::assert_close;

const KINDS: [CellKind; 2] = [CellKind::Hexahedron, CellKind::Hexahedron20];

/// Solves `text` with the mesh in the file that it names.
fn solved(text: &str, mesh: &Mesh, file: &str) -> (FemRecord, SpaceSolution) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    fs::write(&path, to_bytes(mesh, Format::of_path(&path).unwrap()).unwrap()).unwrap();
    let record = gearwear::fem_problem(&text.replace("mesh.json", file), folder.path(), &Unwatched).unwrap();
    let FemSolution::InSpace(solution) = record.solution.clone() else { panic!("a plane solution") };
    (record, solution)
}

/// The node at a point of the reference box.
fn node_at(solution: &SpaceSolution, at: [f64; 3]) -> usize {
    let points = &solution.problem.solid.points_mm;
    points.iter().position(|point| (point - nalgebra::Vector3::from(at)).norm() < 1e-6).unwrap()
}

/// σ = F/A and u = σ x/E, −ν σ y/E, −ν σ z/E everywhere, in every format of mesh file that is written.
#[test]
fn ver_bar_in_tension() {
    for kind in KINDS {
        let uneven = |[x, y, z]: [f64; 3]| [4.0 * x + 0.3 * x * x, 2.0 * y, 1.5 * z];
        let mesh = mesh_of_box(kind, [3, 2, 2], uneven);
        let (sigma, e) = (100.0 / (4.0 * 3.0), 206e3);
        for file in ["mesh.msh", "mesh.vtu", "mesh.inp", "mesh.json"] {
            let (record, found) = solved(BAR, &mesh, file);
            let points = &found.problem.solid.points_mm;
            assert_eq!((points.len(), record.summary.dofs), (mesh.points.len(), 3 * mesh.points.len()));
            for ((point, u), stress) in points.iter().zip(&found.displacement_mm).zip(&found.stress_MPa) {
                for (stress, exact) in stress.iter().zip([sigma, 0.0, 0.0, 0.0, 0.0, 0.0]) {
                    assert!((stress - exact).abs() < 1e-10 * sigma, "{kind:?} {file}: {stress} instead of {exact}");
                }
                for (u, exact) in u.iter().zip([point.x, -0.3 * point.y, -0.3 * point.z]) {
                    assert!((u - sigma / e * exact).abs() < 1e-10 * sigma / e * 14.7, "{kind:?} {file}: {u}");
                }
            }
            let summary = record.summary;
            assert_close("von Mises", summary.peak_von_mises_MPa, sigma, 1e-10);
            assert!(summary.residual < 1e-12 && summary.force_balance < 1e-12, "{summary:?}");
            assert_eq!((summary.work.factorisations, summary.warnings.len()), (1, 0), "{:?}", summary.warnings);
        }
    }
}

/// Bodies of two materials that share nodes, one behind the other, without transverse contraction: u = F/A (L₁/E₁ + L₂/E₂).
#[test]
fn ver_bonded_bodies_of_two_materials() {
    for kind in KINDS {
        let mut mesh = mesh_of_box(kind, [4, 1, 1], |x| x);
        let whole = mesh.cell_sets.remove("box").unwrap();
        for (name, cells) in [("steel", vec![0]), ("aluminium", vec![1, 2, 3])] {
            let mut set = whole.clone();
            set[0] = cells;
            mesh.cell_sets.insert(name.to_owned(), set);
        }
        let body = |group: &str, e: f64| {
            format!("[[body]]\ngroup = \"{group}\"\nyoung_modulus_GPa = {e:?}\npoisson_ratio = 0.0\n\n")
        };
        let (head, rest) = BAR.split_once("[[body]]").unwrap();
        let (_, rest) = rest.split_once("[[fixed]]").unwrap();
        let text = format!("{head}{}{}[[fixed]]{rest}", body("steel", 200.0), body("aluminium", 50.0));
        let (record, _) = solved(&text, &mesh, "mesh.msh");
        let greatest = record.summary.in_space.unwrap();
        assert_close("elongation", greatest.greatest_displacement_mm, 100.0 * (1.0 / 200e3 + 3.0 / 50e3), 1e-10);
        assert_eq!(greatest.greatest_displacement_at_mm[0], 4.0);
    }
}

/// A cantilever of length 10 and height 1 under an even shear of its end: F L³/(3 E I) + F L/(κ G A) with κ = 5/6, without transverse
/// contraction (S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity*, 1970, section 21, with the shear of the section). The clamped
/// end warps in the theory and not here, which is what the tolerance is for.
#[test]
fn val_cantilever_against_timoshenko() {
    let (length, force, e): (f64, f64, f64) = (10.0, -5.0, 206e3);
    let exact = force * length.powi(3) / (3.0 * e / 12.0) + force * length / (5.0 / 6.0 * 0.5 * e);
    for (kind, cells) in [(CellKind::Hexahedron, [20, 4, 1]), (CellKind::Hexahedron20, [10, 2, 1])] {
        let scale = cells.map(|count| count as f64);
        let mesh = mesh_of_box(kind, cells, |[x, y, z]| [length * x / scale[0], y / scale[1], z / scale[2]]);
        let (head, _) = BAR.split_once("[[fixed]]").unwrap();
        let text =
            format!("{head}[[fixed]]\ngroup = \"x0\"\n\n[[load]]\ngroup = \"x1\"\nforce_N = [0.0, {force:?}, 0.0]\n")
                .replace("poisson_ratio = 0.3", "poisson_ratio = 0.0");
        let (record, found) = solved(&text, &mesh, "mesh.inp");
        let tip = found.displacement_mm[node_at(&found, [length, 0.0, 0.0])][1];
        assert_close(&format!("{kind:?}"), tip, exact, 2e-3);
        assert!(record.summary.force_balance < 1e-9, "moments balance too: {:e}", record.summary.force_balance);
    }
}

/// The thick elliptic plate under even pressure, benchmark LE10 (NAFEMS, *The Standard NAFEMS Benchmarks*, 1990): σ_y = −5.38 MPa at the
/// inner end D of the long axis, on the loaded face.
#[test]
fn val_nafems_thick_plate() {
    let text = r#"analysis = "three-dimensional"
mesh = { file = "mesh.json" }
body = [{ group = "box", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }]
fixed = [
    { group = "y0", components = ["y"] },
    { group = "y1", components = ["x"] },
    { group = "x1", components = ["x", "y"] },
    { group = "middle", components = ["z"] },
]
load = [{ group = "z1", force_N = [0.0, 0.0, FORCE] }]
"#;
    let force = -1e6 * FRAC_PI_4 * (3.25 * 2.75 - 2.0);
    for (kind, cells, allowed) in [(CellKind::Hexahedron, [12, 16, 8], 0.02), (CellKind::Hexahedron20, [6, 8, 2], 0.02)]
    {
        let [nr, nt, nz] = cells.map(|count| count as f64);
        let place = |[r, t, z]: [f64; 3]| {
            let (s, angle) = (r / nr, FRAC_PI_2 * t / nt);
            let [x, y] = [[2.0, 3.25], [1.0, 2.75]].map(|[inner, outer]| 1e3 * (inner + s * (outer - inner)));
            [x * angle.cos(), y * angle.sin(), 600.0 * z / nz]
        };
        let mut mesh = mesh_of_box(kind, cells, place);
        let on_edge = |x: &[f64; 3]| {
            ((x[0] / 3250.0).powi(2) + (x[1] / 2750.0).powi(2) - 1.0).abs() < 1e-9 && (x[2] - 300.0).abs() < 1e-9
        };
        let edge = (0..mesh.points.len()).filter(|&node| on_edge(&mesh.points[node])).collect();
        mesh.point_sets.insert("middle".to_owned(), edge);
        let (_, found) = solved(&text.replace("FORCE", &format!("{force:?}")), &mesh, "mesh.vtu");
        let sigma = found.stress_MPa[node_at(&found, [2000.0, 0.0, 600.0])][1];
        assert_close(&format!("{kind:?}"), sigma, -5.38, allowed);
    }
}

/// A body all of whose nodes are given their displacement, so that nothing is left to solve.
#[test]
fn bodies_may_be_held_everywhere() {
    let (head, _) = BAR.split_once("[[fixed]]").unwrap();
    let text = format!("{head}[[load]]\ngroup = \"box\"\ndisplacement_mm = [0.3, 0.0, 0.4]\n");
    let (record, _) = solved(&text, &mesh_of_box(CellKind::Hexahedron, [1, 1, 1], |x| x), "mesh.json");
    assert_close("shift", record.summary.in_space.unwrap().greatest_displacement_mm, 0.5, 1e-15);
    assert!(record.summary.peak_von_mises_MPa < 1e-9, "{}", record.summary.peak_von_mises_MPa);
}

fn posed(text: &str, mesh: &Mesh) -> gearwear_fem::space::problem::SpaceProblem {
    let posed =
        FemProblem::from_toml(text).unwrap().in_space_on(mesh).unwrap_or_else(|problems| panic!("{problems:?}"));
    posed.problem
}

/// An even traction on a face of eight nodes: −1/12 of the force at its corners, 1/3 in the middles of its sides (O. C. Zienkiewicz,
/// R. L. Taylor and J. Z. Zhu, *The Finite Element Method*, 2005); points share a force evenly.
#[test]
fn ver_shares_of_a_force() {
    let mut mesh = mesh_of_box(CellKind::Hexahedron20, [1, 1, 1], |[x, y, z]| [x, 3.0 * y, 2.0 * z + 0.5 * y]);
    let problem = posed(BAR, &mesh);
    let loaded = |forces: &[f64]| {
        let mut loaded: Vec<i64> = forces.iter().filter(|f| **f != 0.0).map(|f| (f * 12.0).round() as i64).collect();
        loaded.sort_unstable();
        loaded
    };
    assert_eq!(loaded(&problem.forces_n), [-100, -100, -100, -100, 400, 400, 400, 400]);
    mesh.point_sets.insert("points".to_owned(), vec![1, 2]);
    let problem = posed(&BAR.replace("\"x1\"", "\"points\""), &mesh);
    assert_eq!(loaded(&problem.forces_n), [600, 600]);
}

/// Linear surfaces and lines along quadratic elements hold the middles of their sides too.
#[test]
fn linear_groups_hold_the_middles_of_quadratic_elements() {
    let mut mesh = mesh_of_box(CellKind::Hexahedron20, [1, 1, 1], |x| x);
    let whole = posed(BAR, &mesh).held;
    let x0 = mesh.cells.iter().position(|block| block.kind == CellKind::Quad8).unwrap();
    let corners = mesh.cells[x0].nodes[..4].to_vec();
    mesh.cell_sets.remove("x0");
    add(&mut mesh, CellKind::Quad, corners.clone(), "x0");
    assert_eq!(posed(BAR, &mesh).held, whole);
    mesh.cell_sets.remove("x0");
    let lines = (0..4).flat_map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
    add(&mut mesh, CellKind::Line, lines, "x0");
    assert_eq!(posed(BAR, &mesh).held, whole);
}

/// The resolved problem resolves to itself, and the schema describes it.
#[test]
fn ver_resolving_the_resolved_problem_changes_nothing() {
    let text = format!("{BAR}\n[[load]]\ngroup = \"x1\"\ndisplacement_mm = [0.0, 0.1, 0.2]\ncomponents = [\"z\"]\n");
    let problem = FemProblem::from_toml(&text.replace("components = [\"x\"]\n", "")).unwrap();
    let resolved = problem.to_toml();
    assert_eq!(FemProblem::from_toml(&resolved).unwrap().to_toml(), resolved);
    assert!(resolved.contains("components = [\"x\", \"y\", \"z\"]"), "{resolved}");
    let validator = jsonschema::validator_for(gearwear::scene::fem_problem::schema()).unwrap();
    let json = |text: &str| serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap();
    assert!(validator.is_valid(&json(&resolved)));
    assert!(!validator.is_valid(&json(&resolved.replace("[0.0, 0.1, 0.2]", "[0.0, 0.1, 0.2, 0.3]"))));
}
