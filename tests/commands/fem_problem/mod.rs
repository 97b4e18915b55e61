//! `gearwear fem` of a problem of one's own: what it writes, what it finds, what it refuses.

#[path = "../../program/cylinder_on_block.rs"]
pub(crate) mod cylinder_on_block;
mod decks;
mod in_space;
mod refusals;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use gearwear::mesh::{Format, Mesh, read, to_bytes};

use cylinder_on_block::TEXT;

use crate::program::gearwear;

/// Its mesh of elements of the second order with eight nodes.
fn mesh() -> Mesh {
    read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join("meshes/cylinder-on-block-quad8.msh")).unwrap()
}

/// A problem file with its mesh in a folder of its own.
struct Case {
    folder: tempfile::TempDir,
    /// The file's text.
    text: String,
}

impl Case {
    /// `text` beside `mesh`.
    fn new(text: &str, mesh: &Mesh) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("mesh.json"), to_bytes(mesh, Format::Json).unwrap()).unwrap();
        Self { folder, text: text.to_owned() }
    }

    /// With `old` in the text exchanged for `new`.
    fn with(mut self, old: &str, new: &str) -> Self {
        assert!(self.text.contains(old), "no {old:?} in the file");
        self.text = self.text.replacen(old, new, 1);
        self
    }

    /// Where the results go.
    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Runs the program on it: exit status, standard output, standard error.
    fn run(&self) -> (Option<i32>, String, String) {
        let path = self.folder.path().join("problem.toml");
        fs::write(&path, &self.text).unwrap();
        let output = gearwear().arg("fem").arg(&path).arg("--out").arg(self.out()).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    }

    /// Runs it, which must be refused without leaving anything behind, at the line that begins with `line`, saying `parts`.
    fn refused(&self, line: &str, parts: &[&str]) {
        let (status, out, message) = self.run();
        assert_eq!(status, Some(2), "{message}");
        assert!(out.is_empty() && !self.out().exists(), "something was left behind");
        let number = 1 + self.text.lines().position(|l| l.starts_with(line)).unwrap();
        let place = format!("problem.toml:{number}:");
        for part in parts.iter().copied().chain([place.as_str(), "allowed:"]) {
            assert!(message.contains(part), "no {part:?} in:\n{message}");
        }
    }

    /// Runs it, which must succeed, and gives the summary and standard error.
    fn solved(&self) -> (serde_json::Value, String) {
        let (status, _, message) = self.run();
        assert_eq!(status, Some(0), "{message}");
        (serde_json::from_slice(&fs::read(self.out().join("summary.json")).unwrap()).unwrap(), message)
    }
}

/// The rows of a CSV file by column.
fn columns(path: &Path) -> BTreeMap<String, Vec<String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(String::from).collect();
    let mut columns: BTreeMap<String, Vec<String>> = names.iter().map(|name| (name.clone(), Vec::new())).collect();
    for row in reader.records() {
        for (name, value) in names.iter().zip(row.unwrap().iter()) {
            columns.get_mut(name).unwrap().push(value.to_owned());
        }
    }
    columns
}

/// Everything the contract names is there, and the folder holds nothing else.
#[test]
fn results_are_complete() {
    // A hundredth of the load: about one element along the half-width.
    let case = Case::new(TEXT, &mesh()).with("-17500.0", "-175.0");
    let (summary, message) = case.solved();
    for key in ["dofs", "elements", "iterations", "stages", "wall_s", "contact", "residual", "force_balance", "work"] {
        assert!(!summary[key].is_null(), "no {key}");
    }
    assert_eq!(summary["title"], "cylinder on a block");
    assert_eq!(summary["stopped"], "converged");
    let contact = &summary["contact"][0];
    assert_eq!((&contact["slave"], &contact["master"]), (&"cylinder-surface".into(), &"block-top".into()));
    for key in
        ["peak_pressure_MPa", "half_width_mm", "contact_width_mm", "force_N_per_mm", "max_penetration_um", "centre_mm"]
    {
        assert!(!contact[key].is_null(), "no {key}");
    }
    let force = contact["force_N_per_mm"][1].as_f64().unwrap();
    assert!((force / 175.0 - 1.0).abs() < 1e-9, "the contact carries the load, {force}");
    assert_eq!(contact["half_width_mm"], contact["contact_width_mm"], "in a half model both are a");
    assert!(message.contains("elements along the half-width"), "one element is few:\n{message}");

    let mut names: Vec<String> =
        fs::read_dir(case.out()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["columns.json", "contact.csv", "problem.toml", "report.html", "solution.vtu", "summary.json"]);
    let header = fs::read_to_string(case.out().join("contact.csv")).unwrap();
    let header = header.lines().next().unwrap();
    assert!(header.starts_with("x_mm,y_mm,gap_mm,pressure_MPa,traction_MPa"), "{header}");
    let rows = columns(&case.out().join("contact.csv"));
    let peak = rows["pressure_MPa"].iter().map(|p| p.parse::<f64>().unwrap()).fold(0.0, f64::max);
    assert_eq!(peak, contact["peak_pressure_MPa"].as_f64().unwrap());
}
