//! `gearwear fem` of a gear pair from the outside: what it writes, what it refuses, and that it repeats itself to the bit.

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::program::{gearwear, preset};

/// A scene that is quickly solved: FZG type C, four elements along Hertz's half-width, twenty positions.
fn coarse() -> String {
    let text = exchanged(&preset("thesis-spur"), "positions = 400 ", "positions = 20 ");
    text + "\n[fem]\nelements_per_half_width = 4\n"
}

fn exchanged(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

fn fem(dir: &Path, text: &str, out: &str, more: &[&str]) -> Output {
    let file = dir.join("scene.toml");
    fs::write(&file, text).unwrap();
    gearwear().arg("fem").arg(&file).arg("--out").arg(dir.join(out)).args(more).output().unwrap()
}

fn solved(dir: &Path, text: &str, out: &str, more: &[&str]) -> Value {
    let output = fem(dir, text, out, more);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&fs::read(dir.join(out).join("summary.json")).unwrap()).unwrap()
}

/// The rows of a CSV file by the names of their columns.
fn rows(path: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let header = reader.headers().unwrap().iter().map(str::to_owned).collect();
    (header, reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_mesh_cycle_leaves_what_the_contract_names() {
    let dir = tempfile::tempdir().unwrap();
    let summary = solved(dir.path(), &coarse(), "out", &["--threads", "2"]);
    let out = dir.path().join("out");
    for name in ["summary.json", "mesh_cycle.csv", "pressure.csv", "solution.vtu", "scene.toml", "report.html"] {
        assert!(out.join(name).is_file(), "{name}");
    }

    let (header, rows) = rows(&out.join("mesh_cycle.csv"));
    // The names and their order are those of the contract; ours come after them.
    assert_eq!(
        header[..6],
        ["position_mm", "pair", "line_load_N_per_mm", "peak_pressure_MPa", "half_width_mm", "transmission_error_um"]
    );
    let value = |row: &[String], name: &str| -> f64 {
        row[header.iter().position(|column| column == name).unwrap()].parse().unwrap()
    };
    let whole = number(&summary["contact"]["line_load_N_per_mm"]);
    let mut positions: Vec<f64> = rows.iter().map(|row| value(row, "position_mm")).collect();
    positions.dedup();
    assert_eq!(positions.len(), 20);
    let points = &summary["geometry"]["curvature_radius_mm"];
    assert_eq!([positions[0], positions[19]], [number(&points["A"]), number(&points["E"])]);
    for position in positions {
        let here: Vec<&Vec<String>> = rows.iter().filter(|row| value(row, "position_mm") == position).collect();
        let carried: f64 = here.iter().map(|row| value(row, "line_load_N_per_mm")).sum();
        assert!((carried / whole - 1.0).abs() < 1e-9, "{carried} of {whole} at {position}");
        assert!(here.iter().any(|row| value(row, "pair") == 0.0), "the reference pair touches from A to E");
    }

    let stages: Vec<&str> =
        summary["stages"].as_array().unwrap().iter().map(|stage| stage["name"].as_str().unwrap()).collect();
    assert_eq!(stages, ["geometry", "meshing", "condensation", "cycle", "path-points", "stresses", "report"]);
    assert_eq!(summary["stopped"], "completed");
    assert_eq!(summary["positions"], 20);
    let share = &summary["points"]["load_share"];
    // Alone at C, together with a neighbour at A and E.
    assert!((number(&share["C"]) - 1.0).abs() < 1e-9);
    assert!(number(&share["A"]) < 0.7 && number(&share["E"]) < 0.7, "{share}");
    // Sharp tip edges of the FZG gears are told apart.
    assert!(number(&summary["new"]["sharp_edge_pressure_MPa"]) > number(&summary["new"]["peak_pressure_MPa"]));
    assert!(summary["warnings"].as_array().unwrap().iter().any(|w| w.as_str().unwrap().contains("at_sharp_edge")));
    for check in ["torque_ratio_error_on_line", "load_imbalance"] {
        assert!(number(&summary["checks"][check]) < 1e-3, "{check} {}", summary["checks"]);
    }

    let page = fs::read_to_string(out.join("report.html")).unwrap();
    for id in ["mesh", "load-sharing", "cycle-pressure", "transmission-error", "root-stress", "pressure-c", "stress"] {
        assert!(page.contains(&format!("id=\"{id}\"")), "{id}");
    }
    // Pictures are base64, which spells any word but has none of these signs.
    assert!(!["NaN ", "NaN,", "NaN<"].iter().any(|number| page.contains(number)), "a number that is none");
}

/// Transmission error at C of whole rings held at 19.943 and 37.897 mm: 37.52 µm by quadratic finite elements with the load
/// as a Hertz ellipse, converged to 0.02 % (FZG C, 302 N·m). Four elements along the half-width are within 0.2 % of it, the
/// pressure within 3 % of Hertz's.
#[test]
fn val_transmission_error_and_pressure_at_the_pitch_point() {
    let dir = tempfile::tempdir().unwrap();
    let at_c = "13.9701";
    let summary = solved(dir.path(), &coarse(), "out", &["--position", at_c, "--quiet"]);
    let te = number(&summary["new"]["transmission_error_um"]["max"]);
    assert!((te / 37.52 - 1.0).abs() < 2e-3, "{te}");
    let (header, rows) = rows(&dir.path().join("out/mesh_cycle.csv"));
    assert_eq!(rows.len(), 1, "one pair alone at C");
    let column = |name: &str| header.iter().position(|column| column == name).unwrap();
    let [found, hertz] =
        ["peak_pressure_MPa", "hertz_pressure_MPa"].map(|name| rows[0][column(name)].parse::<f64>().unwrap());
    assert!((found / hertz - 1.0).abs() < 0.03, "{found} {hertz}");
}

#[test]
fn one_position_and_the_whole_model_agree() {
    let dir = tempfile::tempdir().unwrap();
    let summary = solved(dir.path(), &coarse(), "out", &["--position", "12", "--full"]);
    assert_eq!(summary["position_mm"], 12.0);
    assert_eq!(summary["positions"], 1);
    assert_eq!(summary["points"], Value::Null);
    let full = summary["full"].as_array().unwrap();
    assert_eq!(full.len(), 1);
    // Same elements, same contact: what is left is round-off of two different ways to solve.
    for difference in ["transmission_error_difference", "line_load_difference", "peak_pressure_difference"] {
        assert!(number(&full[0][difference]).abs() < 1e-6, "{difference}: {}", full[0]);
    }
    assert_eq!(full[0]["dofs"], summary["dofs"]);
}

#[test]
fn threads_change_no_bit() {
    let dir = tempfile::tempdir().unwrap();
    for threads in ["1", "2"] {
        solved(dir.path(), &coarse(), threads, &["--threads", threads, "--quiet"]);
    }
    for name in ["mesh_cycle.csv", "pressure.csv", "solution.vtu", "scene.toml"] {
        let [one, two] = ["1", "2"].map(|threads| fs::read(dir.path().join(threads).join(name)).unwrap());
        assert!(one == two, "{name}");
    }
}

/// What takes much memory says so before it begins, and what no computer holds is refused.
#[test]
fn much_memory_is_announced() {
    let dir = tempfile::tempdir().unwrap();
    let with = |elements: u32| {
        let text = format!("{}\n[fem]\nelements_per_half_width = {elements}\n", preset("thesis-spur"));
        let output = fem(dir.path(), &text, "out", &["--position", "12"]);
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, said) = with(36);
    assert!(code == Some(0) && said.contains("their condensation takes some 1."), "{code:?} {said}");
    let (code, said) = with(60);
    assert!(code == Some(2) && said.contains("scene.toml") && said.contains("nodes"), "{code:?} {said}");
}

/// Text that is no TOML is said to be that, whatever options stand beside it.
#[test]
fn text_that_is_no_toml_is_refused_with_its_place() {
    let dir = tempfile::tempdir().unwrap();
    let output = fem(dir.path(), "[pair]\nteeth = 1\nteeth = 2\n", "out", &["--position", "12"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && said.contains("scene.toml:3"), "{said}");
}

/// Every refusal names what was found and what is allowed, leaves status 2 and no files.
#[test]
fn refusals() {
    let dir = tempfile::tempdir().unwrap();
    let sector = exchanged(&coarse(), "\n[fem]\n", "\n[fem]\nbody = \"sector\"\nsector_teeth = 1\n");
    let cases: [(&str, String, &[&str], &[&str]); 5] = [
        ("position before A", coarse(), &["--position", "1"], &["--position: found 1", "allowed: ", "(A)"]),
        ("position after E", coarse(), &["--position", "99"], &["--position: found 99", "(E)"]),
        ("position that is none", coarse(), &["--position", "nan"], &["--position"]),
        ("too few teeth", sector, &[], &["fem.sector_teeth: found 1", "at least 3"]),
        ("an option of another command", coarse(), &["--hours", "3"], &["--hours"]),
    ];
    for (what, text, more, said) in cases {
        let output = fem(dir.path(), &text, "out", more);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{what}: {error}");
        for part in said {
            assert!(error.contains(part), "{what}: {part} is not in {error}");
        }
        assert!(!dir.path().join("out").exists(), "{what}");
    }
}

#[test]
fn options_of_a_pair_are_refused_for_a_mesh_of_ones_own() {
    let dir = tempfile::tempdir().unwrap();
    for more in [&["--position", "12"][..], &["--full"]] {
        let output = fem(dir.path(), "[mesh]\nfile = \"none.msh\"\n", "out", more);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(more[0]) && error.contains("[pair]"), "{error}");
    }
}
