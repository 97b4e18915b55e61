//! `gearwear calibrate` from the outside, and scenes that name its files.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

use crate::program::{gearwear, preset};

/// The preset with the lines of `contact` as its contact table, few points and a short run.
fn scene(contact: &str, fem: &str) -> String {
    let mut table: toml::Table = preset("fzg-c").parse().unwrap();
    for (name, lines) in [("contact", contact), ("fem", fem)] {
        table.insert(name.to_owned(), toml::Value::Table(lines.parse().unwrap()));
    }
    table.remove("stiffness");
    let numerics =
        "flank_points = 200\npositions = 60\nstep = { revolutions = 200000.0 }\nerror_estimate = false\nverify = false";
    table.insert("numerics".to_owned(), toml::Value::Table(numerics.parse().unwrap()));
    toml::to_string(&table).unwrap()
}

/// Coarse elements: the fewer, the faster.
const COARSE: &str = "elements_per_half_width = 2.0";

fn calibrate(dir: &Path, more: &[&str]) -> Output {
    fs::write(dir.join("scene.toml"), scene("surface = \"winkler\"", COARSE)).unwrap();
    gearwear().current_dir(dir).args(["calibrate", "scene.toml", "--out", "c.json"]).args(more).output().unwrap()
}

fn run(dir: &Path, text: &str) -> Output {
    fs::write(dir.join("run.toml"), text).unwrap();
    gearwear().current_dir(dir).args(["run", "run.toml", "--out", "out", "-q"]).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_calibration_is_written_read_and_refused_where_it_does_not_belong() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    let output = calibrate(dir, &[]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = fs::read_to_string(dir.join("c.json")).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["belongs_to"]["pair"]["pinion"]["teeth"], 16);
    assert_eq!(json["program_version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(json["hash"].as_str().unwrap().len(), 64);
    let page = fs::read_to_string(dir.join("c.html")).unwrap();
    assert!(page.contains("id=\"pair-stiffness\"") && page.contains("id=\"foundation-half-width\""));
    assert!(String::from_utf8_lossy(&output.stdout).contains("at C"));

    // Any number of threads, the same file.
    let other = gearwear()
        .current_dir(dir)
        .args(["calibrate", "scene.toml", "--out", "one.json", "--threads", "1", "-q"])
        .output()
        .unwrap();
    assert!(other.status.success() && other.stdout.is_empty(), "{}", stderr(&other));
    assert_eq!(fs::read_to_string(dir.join("one.json")).unwrap(), text);

    // A scene of the same pair runs with it, from another folder too: the name is relative to the scene.
    let calibrated = scene("surface = \"winkler\"\ncalibration = \"c.json\"", COARSE);
    let output = run(dir, &calibrated);
    assert!(output.status.success(), "{}", stderr(&output));
    let elsewhere = gearwear()
        .args(["run"])
        .arg(dir.join("run.toml"))
        .arg("--out")
        .arg(dir.join("elsewhere"))
        .arg("-q")
        .output()
        .unwrap();
    assert!(elsewhere.status.success(), "{}", stderr(&elsewhere));

    // A larger torque than it was fitted on is told.
    let heavy = calibrated.replace("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 700.0");
    let output = run(dir, &heavy);
    assert!(stderr(&output).contains("outside the loads"), "{}", stderr(&output));

    // Another pair, another material, another rim: every difference by its key.
    let other = calibrated
        .replace("profile_shift = 0.1817", "profile_shift = 0.18")
        .replace("young_modulus_GPa = 206.0", "young_modulus_GPa = 110.0")
        .replace("[fem]", "[fem]\nclamp_radius_mm = { pinion = 15.0 }");
    let refused = run(dir, &other);
    let said = stderr(&refused);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    for difference in [
        "pair.pinion.profile_shift: calibration 0.1817, scene 0.18",
        "material.wheel.young_modulus_GPa: calibration 206, scene 110",
        "fem.clamp_radius_mm.pinion: calibration 19.9",
        "contact.calibration",
        "run.toml",
    ] {
        assert!(said.contains(difference), "{difference} is not in {said}");
    }

    // One digit changed.
    let k = json["foundation"]["half-width"]["mpa_per_mm"][5].to_string();
    let tampered = text.replacen(&k, "540000.0", 1);
    assert_ne!(tampered, text);
    fs::write(dir.join("c.json"), tampered).unwrap();
    let refused = run(dir, &calibrated);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("hash"), "{}", stderr(&refused));

    // White space is no matter.
    fs::write(dir.join("c.json"), serde_json::to_string(&json).unwrap()).unwrap();
    assert!(run(dir, &calibrated).status.success());
}

#[test]
fn files_that_are_no_calibration_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    let calibrated = scene("surface = \"winkler\"\ncalibration = \"c.json\"", COARSE);
    let refused = |what: &str| {
        let output = run(dir, &calibrated);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(what) && said.contains("contact.calibration") && said.contains("run.toml"), "{said}");
        assert!(!dir.join("out").exists(), "nothing may be written");
    };
    refused("cannot be read");
    fs::create_dir(dir.join("c.json")).unwrap();
    refused("cannot be read");
    fs::remove_dir(dir.join("c.json")).unwrap();
    fs::write(dir.join("c.json"), "{\n\"program_version\": 1}").unwrap();
    refused("line 2");
    fs::write(dir.join("c.json"), b"{\n\xff}").unwrap();
    refused("UTF-8");
}

#[test]
fn output_files_that_cannot_be_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    fs::write(dir.join("scene.toml"), scene("surface = \"winkler\"", COARSE)).unwrap();
    fs::write(dir.join("file"), "").unwrap();
    for (out, what) in [(".", "folder"), ("c.html", "page"), ("file/c.json", "not a folder")] {
        let output = gearwear().current_dir(dir).args(["calibrate", "scene.toml", "--out", out]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{out}");
        assert!(stderr(&output).contains(what) && stderr(&output).contains("--out"), "{}", stderr(&output));
    }
    // A scene whose sector is too small for its teeth in contact.
    let small = scene("surface = \"winkler\"", "body = \"sector\"\nsector_teeth = 1");
    fs::write(dir.join("scene.toml"), small).unwrap();
    let output = gearwear().current_dir(dir).args(["calibrate", "scene.toml", "--out", "c.json"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("fem.sector_teeth"), "{}", stderr(&output));
    assert!(!dir.join("c.json").exists() && !dir.join("c.html").exists());
}

/// Between its stages a calibration hears Ctrl-C; then there is no file, for half a calibration is none.
#[cfg(unix)]
#[test]
fn an_interrupted_calibration_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    fs::write(dir.join("scene.toml"), scene("surface = \"winkler\"", COARSE)).unwrap();
    let mut child = gearwear()
        .current_dir(dir)
        .args(["calibrate", "scene.toml", "--out", "c.json"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The first line says that a stage is done: the signal is watched by then.
    let mut said = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.starts_with("geometry") {
        line.clear();
        assert!(said.read_line(&mut line).unwrap() > 0, "it ended before its first stage");
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let mut rest = String::new();
    said.read_to_string(&mut rest).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{rest}");
    assert!(rest.contains("nothing was written"), "{rest}");
    assert!(!dir.join("c.json").exists() && !dir.join("c.html").exists());
}

#[test]
fn stiffness_of_finite_elements_is_computed_where_no_file_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    let text = scene("surface = \"hertz\"", COARSE) + "\n[stiffness]\nmodel = \"fem\"\n";
    let output = run(dir, &text);
    assert!(output.status.success(), "{}", stderr(&output));
    let summary: Value = serde_json::from_slice(&fs::read(dir.join("out/summary.json")).unwrap()).unwrap();
    let stages: Vec<&str> =
        summary["stages"].as_array().unwrap().iter().map(|stage| stage["name"].as_str().unwrap()).collect();
    assert!(stages.contains(&"finite-element-calibration"), "{stages:?}");
}
