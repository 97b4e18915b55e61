//! The commands and figures of the documents for a first hour, run as they are printed.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::program::{exchanged, gearwear};

fn document(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join("docs").join(name)).unwrap()
}

/// The blocks of a document in this language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    page.split(fence.as_str()).skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

/// Runs commands of a shell with the program in its path.
#[cfg(unix)]
fn shell(dir: &Path, commands: &str) -> String {
    let program = Path::new(gearwear().get_program()).parent().unwrap().to_owned();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let output = Command::new("sh").current_dir(dir).env("PATH", path).args(["-euc", commands]).output().unwrap();
    said(&output)
}

fn said(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Every line of a block is among what was printed, blanks at line ends aside.
fn assert_printed(block: &str, printed: &str) {
    for line in block.lines() {
        assert!(printed.lines().any(|other| other.trim_end() == line.trim_end()), "{line:?} not in:\n{printed}");
    }
}

/// The tutorial of docs/compare.md, but for its second fit, which would take as long again.
#[cfg(unix)]
#[test]
fn the_tutorial_on_measured_profiles_says_what_comes_out() {
    let page = document("compare.md");
    let dir = tempfile::tempdir().unwrap();
    let commands = blocks(&page, "sh");
    let printed = shell(dir.path(), &commands[..3].concat());
    let answers = blocks(&page, "text");
    assert_printed(answers[0], &printed);
    assert_printed(answers[1], &printed);
}

/// The tutorial of docs/fem-problems.md on the mesh that Gmsh made of its geometry.
#[test]
fn the_tutorial_on_own_problems_says_what_comes_out() {
    let page = document("fem-problems.md");
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join("meshes");
    let answers = blocks(&page, "text");
    assert_eq!(answers[0], fs::read_to_string(meshes.join("roller.geo")).unwrap(), "the geometry is the committed one");
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    fs::write(dir.join("roller.toml"), blocks(&page, "toml")[0]).unwrap();
    fs::copy(meshes.join("roller.msh"), dir.join("roller.msh")).unwrap();
    let printed = said(&gearwear().current_dir(dir).args(["fem", "roller.toml", "--out", "roller"]).output().unwrap());
    assert_printed(answers[1], &printed);
    assert!(dir.join("roller/solution.vtu").exists(), "what view.py reads");
}

/// A column of a table at a value of its first one, linear between rows.
fn at(file: &Path, first: f64, column: &str) -> f64 {
    let mut table = csv::Reader::from_path(file).unwrap();
    let index = table.headers().unwrap().iter().position(|name| name == column).unwrap();
    let number = |row: &csv::StringRecord, i: usize| row[i].parse::<f64>().unwrap();
    let rows: Vec<[f64; 2]> =
        table.records().map(Result::unwrap).map(|row| [number(&row, 0), number(&row, index)]).collect();
    let pair = rows.windows(2).find(|pair| pair[0][0] <= first && first < pair[1][0]).unwrap();
    let t = (first - pair[0][0]) / (pair[1][0] - pair[0][0]);
    pair[0][1] + t * (pair[1][1] - pair[0][1])
}

/// FZG type C, new, at 12 mm radius of curvature of the pinion, where one pair is in mesh: the program differs from the formulas of docs/theory.md,
/// (5) to (28) by hand, by its discretisation alone.
#[test]
fn ver_a_position_by_hand_is_what_the_program_has() {
    let (r_b1, a_w) = (8.0 * 4.5 * 20f64.to_radians().cos(), 91.5f64);
    let r_b2 = 1.5 * r_b1;
    let rho_1 = 12.0;
    let rho_2 = (a_w.powi(2) - (r_b1 + r_b2).powi(2)).sqrt() - rho_1;
    let w = 302_000.0 / (r_b1 * 14.0);
    let relative_radius = rho_1 * rho_2 / (rho_1 + rho_2);
    let a = (4.0 * w * relative_radius / (std::f64::consts::PI * 206e3 / 1.82)).sqrt();
    let [zeta_1, zeta_2] = [1.0 - rho_2 / 1.5 / rho_1, 1.0 - 1.5 * rho_1 / rho_2];
    let (radius_1, radius_2) = (r_b1.hypot(rho_1), r_b2.hypot(rho_2));
    let dir = tempfile::tempdir().unwrap();
    let scene = exchanged(
        "fzg-c",
        &[
            ("error_estimate = true", "error_estimate = false"),
            ("verify = true", "verify = false"),
            ("hours = 127.75 ", "pinion_revolutions = 1.0 "),
            ("snapshots_h", "# snapshots_h"),
            ("# surface = \"fem\" ", "surface = \"half-space\" "),
        ],
    );
    fs::write(dir.path().join("one.toml"), scene).unwrap();
    let run = gearwear().current_dir(dir.path()).args(["run", "one.toml", "--out", "one", "--quiet"]).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let file = |name: &str| dir.path().join("one").join(name);
    for (name, hand, program) in [
        ("half-width", a, at(&file("mesh_cycle.csv"), rho_1, "half_width_mm")),
        ("pressure", 2.0 * w / (std::f64::consts::PI * a), at(&file("mesh_cycle.csv"), rho_1, "peak_pressure_new_MPa")),
        ("sliding, pinion", 2.0 * a * zeta_1.abs(), at(&file("pinion.csv"), radius_1, "sliding_mm_per_mesh")),
        ("sliding, wheel", 2.0 * a * zeta_2.abs(), at(&file("wheel.csv"), radius_2, "sliding_mm_per_mesh")),
        ("wear, pinion", 1e-2 * w * zeta_1.abs(), 1e6 * at(&file("pinion.csv"), radius_1, "wear_um")),
        ("wear, wheel", 1e-2 * w * zeta_2.abs() * 16.0 / 24.0, 1e6 * at(&file("wheel.csv"), radius_2, "wear_um")),
    ] {
        assert!((program / hand - 1.0).abs() < 0.01, "{name}: {program}, by hand {hand}");
    }
}
