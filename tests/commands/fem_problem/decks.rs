//! Meshes as other programs write them: what their element types, surfaces, parts and groups mean to a problem.

use std::fs;
use std::path::PathBuf;

use crate::program::gearwear;

/// A problem file and a mesh file in a folder of their own.
struct Deck {
    folder: tempfile::TempDir,
}

impl Deck {
    fn new(problem: &str, mesh_name: &str, mesh: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(mesh_name), mesh).unwrap();
        fs::write(folder.path().join("problem.toml"), format!("mesh = {{ file = {mesh_name:?} }}\n{problem}")).unwrap();
        Self { folder }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Exit status and messages.
    fn run(&self, more: &[&str]) -> (Option<i32>, String) {
        let mut command = gearwear();
        command.arg("fem").arg(self.folder.path().join("problem.toml")).arg("--out").arg(self.out()).args(more);
        let output = command.output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    }

    /// Summary and messages of a problem that is solved.
    fn solved(&self, more: &[&str]) -> (serde_json::Value, String) {
        let (status, message) = self.run(more);
        assert_eq!(status, Some(0), "{message}");
        (serde_json::from_slice(&fs::read(self.out().join("summary.json")).unwrap()).unwrap(), message)
    }

    fn refused(&self, parts: &[&str]) {
        let (status, message) = self.run(&[]);
        assert_eq!(status, Some(2), "{message}");
        assert!(!self.out().exists(), "something was left behind");
        for part in parts {
            assert!(message.contains(part), "no {part:?} in:\n{message}");
        }
    }
}

fn close(value: &serde_json::Value, expected: f64, relative: f64) {
    let found = value.as_f64().unwrap();
    assert!((found / expected - 1.0).abs() < relative, "{found}, not {expected}");
}

/// A square of 1 mm, drawn to 1.001 mm; its element type in place of `TYPE`.
fn square(element_type: &str) -> String {
    format!(
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*ELEMENT, TYPE={element_type}, ELSET=PLATE\n1, 1, 2, 3, 4\n\
         *NSET, NSET=LEFT\n1, 4\n*NSET, NSET=BOTTOM\n1, 2\n*NSET, NSET=RIGHT\n2, 3\n"
    )
}

const DRAWN: &str = r#"
body = [{ group = "PLATE", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }]
fixed = [{ group = "LEFT", components = ["x"] }, { group = "BOTTOM", components = ["y"] }]
load = [{ group = "RIGHT", displacement_mm = [0.001, 0.0], components = ["x"] }]
"#;

fn drawn(analysis: &str, element_type: &str) -> Deck {
    let analysis = if analysis.is_empty() { String::new() } else { format!("analysis = {analysis:?}\n") };
    Deck::new(&format!("{analysis}{DRAWN}"), "plate.inp", &square(element_type))
}

/// E ε = 210 MPa in plane stress; in plane strain σ_x = E ε/(1 − ν²) and σ_z = ν σ_x, von Mises σ_x √(1 − ν + ν²) = 205.1 MPa.
#[test]
fn val_the_element_type_says_plane_stress_or_plane_strain() {
    let strain = 210.0 / 0.91 * 0.79_f64.sqrt();
    for (analysis, element_type, name, von_mises) in [
        ("", "CPS4R", "plane-stress", 210.0),
        ("", "CPE4", "plane-strain", strain),
        ("plane-stress", "CPS4", "plane-stress", 210.0),
        ("plane-stress", "S4", "plane-stress", 210.0),
    ] {
        let (summary, message) = drawn(analysis, element_type).solved(&["--threads", "1"]);
        close(&summary["peak_von_mises_MPa"], von_mises, 1e-9);
        assert_eq!(summary["analysis"], name);
        assert_eq!(message.contains("warning"), element_type == "S4", "{message}");
    }
}

#[test]
fn other_physics_is_refused_by_name() {
    drawn("plane-strain", "CPS4").refused(&[
        "analysis: found \"plane-strain\"",
        "CPS4 (plane stress)",
        "problem.toml:2:",
    ]);
    drawn("", "CAX4").refused(&["analysis is missing", "\"axisymmetric\"", "CAX4"]);
    drawn("", "M3D4").refused(&["analysis is missing", "M3D4 (membrane)"]);
    drawn("", "CPEG4").refused(&[
        "body[0].group",
        "CPEG4 (generalized plane strain)",
        "allowed: elements of plane strain",
    ]);
    drawn("", "DC2D4").refused(&["DC2D4 (heat conduction)"]);
    drawn("", "GAPUNI").refused(&["\"PLATE\", which holds 1 element of type GAPUNI (line 6 of the mesh)"]);
    let both = square("CPS4") + "*ELEMENT, TYPE=CPE3, ELSET=OTHER\n2, 1, 2, 3\n";
    let two = DRAWN
        .replace("ratio = 0.3 }", "ratio = 0.3 }, { group = \"OTHER\", young_modulus_GPa = 1.0, poisson_ratio = 0.3 }");
    Deck::new(&two, "both.inp", &both).refused(&["CPE3 (plane strain)", "\"PLATE\" are of \"plane-stress\""]);
    let no_mesh = Deck::new(DRAWN, "plate.inp", "*NODE\n1, 0, 0\n*ELEMENT, TYPE=CPS4\n1, 1, 2, 3, 4\n");
    no_mesh.refused(&["line 4: *ELEMENT: node 2 does not exist"]);
}

const CUBE: &str = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 2\n6, 1, 0, 2\n7, 1, 1, 2\n8, 0, 1, 2\n\
                    *ELEMENT, TYPE=C3D8, ELSET=BLOCK\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*NSET, NSET=BASE\n1, 2, 3, 4\n";
const BLOCK: &str = r#"analysis = "three-dimensional"
body = [{ group = "BLOCK", young_modulus_GPa = 210.0, poisson_ratio = 0.0 }]
fixed = [{ group = "BASE" }]
"#;

/// 100 N on a face of 1 mm² of a bar of 2 mm: 100 MPa, F l/(E A) = 9.524e-4 mm.
#[test]
fn val_a_force_on_a_surface_of_a_solid() {
    let load = "load = [{ group = \"TOP\", force_N = [0.0, 0.0, 100.0] }]\n";
    let mesh = format!("{CUBE}*SURFACE, NAME=TOP, TYPE=ELEMENT\n1, S2\n");
    let (summary, _) = Deck::new(&format!("{BLOCK}{load}"), "bar.inp", &mesh).solved(&[]);
    close(&summary["peak_von_mises_MPa"], 100.0, 1e-9);
    close(&summary["greatest_displacement_mm"], 100.0 * 2.0 / 210e3, 1e-9);
}

/// Springs that no body has are left out with a warning, and without loads nothing is out of balance.
#[test]
fn springs_are_left_out_and_nothing_balances_nothing() {
    let mesh = format!("{CUBE}*ELEMENT, TYPE=SPRINGA, ELSET=WEAK\n2, 1, 7\n*SPRING, ELSET=WEAK\n\n1.\n");
    let (summary, message) = Deck::new(BLOCK, "bar.inp", &mesh).solved(&[]);
    assert!(message.contains("1 element of type SPRINGA (line 14 of the mesh): left out"), "{message}");
    assert_eq!((summary["elements"].as_u64(), summary["force_balance"].as_f64()), (Some(1), Some(0.0)));
    // Moved as a whole, it is as free of forces.
    let moved = BLOCK
        .replace("fixed = [{ group = \"BASE\" }]", "load = [{ group = \"BASE\", displacement_mm = [0.1, 0.2, 0.3] }]");
    let (summary, message) = Deck::new(&moved, "bar.inp", &mesh).solved(&[]);
    assert!(!message.contains("out of balance"), "{message}");
    assert_eq!(summary["force_balance"].as_f64(), Some(0.0));
    let flat = DRAWN.replace("[0.001, 0.0], components = [\"x\"]", "[0.1, 0.0]").replace("fixed", "# fixed");
    let (summary, message) = Deck::new(&flat, "plate.inp", &square("CPE4")).solved(&[]);
    assert!(!message.contains("out of balance"), "{message}");
    assert_eq!(summary["force_balance"].as_f64(), Some(0.0));
}

/// Two parts, a punch of 1 mm and a block of 2 mm, each an instance: bodies by the names of the instances, in contact over 1 mm.
#[test]
fn val_two_parts_are_two_bodies() {
    let part = |name: &str, width: f64, y: [f64; 2], surface: &str| {
        let [low, high] = y;
        format!(
            "*PART, NAME={name}\n*NODE\n1, 0., {low}\n2, {width}, {low}\n3, {width}, {high}\n4, 0., {high}\n\
             *ELEMENT, TYPE=CPE4R, ELSET=BODY\n1, 1, 2, 3, 4\n*NSET, NSET=LOW\n1, 2\n*NSET, NSET=HIGH\n3, 4\n*NSET, NSET=AXIS\n1, 4\n\
             *SURFACE, NAME=FACE\nBODY, {surface}\n*END PART\n"
        )
    };
    let mesh = format!(
        "*HEADING\n{}{}*ASSEMBLY, NAME=A\n*INSTANCE, NAME=PUNCH-1, PART=PUNCH\n0., 1., 0.\n*END INSTANCE\n\
         *INSTANCE, NAME=BLOCK-1, PART=BLOCK\n*END INSTANCE\n*END ASSEMBLY\n",
        part("PUNCH", 1.0, [-1.0, 0.0], "S1"),
        part("BLOCK", 2.0, [-2.0, 0.0], "S3"),
    );
    let problem = r#"
body = [{ group = "PUNCH-1", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }, { group = "BLOCK-1", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }]
fixed = [{ group = "BLOCK-1.LOW", components = ["y"] }, { group = "AXIS", components = ["x"] }]
load = [{ group = "PUNCH-1.HIGH", displacement_mm = [0.0, -0.001], components = ["y"] }]
contact = [{ slave = "PUNCH-1.FACE", master = "BLOCK-1.FACE" }]
"#;
    let (summary, _) = Deck::new(problem, "two.inp", &mesh).solved(&[]);
    assert_eq!(summary["elements"].as_u64(), Some(2));
    close(&summary["contact"][0]["contact_width_mm"], 1.0, 1e-9);
    let one = problem.replace("\"PUNCH-1\"", "\"BODY\"");
    Deck::new(&one, "two.inp", &mesh).refused(&["body[1].group", "belong to the body \"BODY\" too"]);
}

/// Groups of `gmsh:physical` and of other integers at cells, in a file whose name says nothing.
#[test]
fn val_numbers_of_groups_are_names() {
    let mesh = r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="6" NumberOfCells="4">
<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 4 3 1 2 5 4 0 3 2 5</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8 10 12</DataArray>
<DataArray type="Int64" Name="types" format="ascii">9 9 3 3</DataArray></Cells>
<CellData><DataArray type="Int64" Name="gmsh:physical" format="ascii">1 1 2 3</DataArray>
<DataArray type="Int64" Name="medit:ref" format="ascii">5 5 6 7</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>"#;
    let problem = r#"
body = [{ group = "1", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }]
fixed = [{ group = "2" }]
load = [{ group = "3", force_N_per_mm = [100.0, 0.0] }]
"#;
    for problem in [problem.to_owned(), problem.replace("\"1\"", "\"medit:ref=5\"").replace("\"3\"", "\"medit:ref=7\"")]
    {
        let (summary, _) = Deck::new(&problem, "mesh.data", mesh).solved(&[]);
        assert_eq!(summary["elements"].as_u64(), Some(2));
    }
}

/// Lamé's cylinder from the files: 10 to 20 mm, 100 MPa over the bore of 5 mm; at the bore von Mises 231.3 MPa (`val_thick_cylinder_of_lame`
/// has the formulas).
#[test]
fn val_a_body_of_revolution() {
    let (columns, rows) = (20, 2);
    let mut mesh = String::from("*NODE\n");
    for j in 0..=2 * rows {
        for i in 0..=2 * columns {
            if i % 2 == 0 || j % 2 == 0 {
                let place = 1 + i + j * (2 * columns + 1);
                let (r, z) = (10.0 + 5.0 * i as f64 / columns as f64, 2.5 * j as f64 / rows as f64);
                mesh.push_str(&format!("{place}, {r}, {z}\n"));
            }
        }
    }
    mesh.push_str("*ELEMENT, TYPE=CAX8R, ELSET=TUBE\n");
    let mut bore = String::from("*SURFACE, NAME=BORE\n");
    for row in 0..rows {
        for column in 0..columns {
            let at = |di: usize, dj: usize| 1 + 2 * column + di + (2 * row + dj) * (2 * columns + 1);
            let nodes =
                [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)].map(|(i, j)| at(i, j).to_string());
            let element = 1 + column + row * columns;
            mesh.push_str(&format!("{element}, {}\n", nodes.join(", ")));
            if column == 0 {
                bore.push_str(&format!("{element}, S4\n"));
            }
        }
    }
    let last = 2 * rows * (2 * columns + 1);
    mesh.push_str(&format!(
        "{bore}*NSET, NSET=ENDS, GENERATE\n1, {}\n{}, {}\n",
        2 * columns + 1,
        last + 1,
        last + 2 * columns + 1
    ));
    let force = 100.0 * 2.0 * std::f64::consts::PI * 10.0 * 5.0;
    let problem = format!(
        "analysis = \"axisymmetric\"\nbody = [{{ group = \"TUBE\", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }}]\n\
         fixed = [{{ group = \"ENDS\", components = [\"y\"] }}]\nload = [{{ group = \"BORE\", force_N = [{force:?}, 0.0] }}]\n"
    );
    let deck = Deck::new(&problem, "tube.inp", &mesh);
    let (summary, message) = deck.solved(&[]);
    assert!(!message.contains("warning"), "{message}");
    close(&summary["peak_von_mises_MPa"], 231.325, 2e-3);
    assert!(fs::read_to_string(deck.out().join("report.html")).unwrap().contains("axisymmetric"));
    Deck::new(&problem.replace("force_N", "force_N_per_mm"), "tube.inp", &mesh)
        .refused(&["load[0].force_N_per_mm: found", "force_N, two numbers, [radial, axial]"]);
    Deck::new(&problem, "tube.inp", &mesh.replace("\n1, 10, 0\n", "\n1, -10, 0\n")).refused(&["x ≥ 0"]);
}
