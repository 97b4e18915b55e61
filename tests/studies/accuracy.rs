//! `gearwear accuracy` from the outside: what it writes, that its fronts and recommendations are what it says, that a run
//! without result is a row, and what an interrupt keeps.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use serde_json::Value;
use tempfile::TempDir;

use crate::program::{exchanged, gearwear, json};

const FILES: [&str; 7] = [
    "accuracy.json",
    "accuracy.csv",
    "wear_profiles.csv",
    "report.html",
    "scene.toml",
    "recommended.toml",
    "calibration.json",
];

/// The thesis-spur scene at a resolution as coarse as it can be, on elements of a third of a half-width, tips rounded, K/H given.
fn coarse_scene() -> String {
    exchanged(
        "thesis-spur",
        &[
            ("flank_points = 750 ", "flank_points = 160 "),
            ("positions = 400 ", "positions = 80 "),
            ("step = { revolutions = 7665.0 }", "step = { revolutions = 100000.0 }"),
            ("[pair.pinion] ", "[pair.pinion]\ntip_rounding_mm = 0.2 "),
            ("[pair.wheel]", "[pair.wheel]\ntip_rounding_mm = 0.2"),
            ("[wear]", "[fem]\nelements_per_half_width = 3\n[wear]"),
        ],
    )
}

fn write(folder: &Path, text: &str) -> PathBuf {
    let file = folder.join("given.toml");
    fs::write(&file, text).unwrap();
    file
}

fn accuracy(scene: &Path, out: &Path, more: &[&str]) -> Output {
    gearwear().arg("accuracy").arg(scene).arg("--out").arg(out).args(more).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}"))
}

/// Time and error of every run that has both.
fn points(record: &Value, quantity: &str) -> Vec<(f64, f64, bool)> {
    let variants = record["variants"].as_array().unwrap();
    let errors = variants.iter().filter(|v| v["errors"][quantity]["relative"].is_number());
    errors
        .map(|v| {
            let error = &v["errors"][quantity];
            (number(v, "/simulation_s"), number(error, "/relative"), error["on_front"].as_bool().unwrap())
        })
        .collect()
}

/// The comparison that the tests share: a bed given by hand that is too soft for the tooth stiffness of ISO 6336, within 60 %.
static COMPARISON: LazyLock<TempDir> = LazyLock::new(|| {
    let dir = tempfile::tempdir().unwrap();
    let text = coarse_scene().replace("match = \"half-width\"", "foundation_MPa_per_mm = 1000.0");
    let output = accuracy(&write(dir.path(), &text), &dir.path().join("out"), &["--quick", "--within", "60"]);
    assert!(output.status.success(), "{}", said(&output));
    dir
});

#[test]
fn every_model_is_compared_with_finite_elements() {
    let out = COMPARISON.path().join("out");
    for file in FILES {
        assert!(out.join(file).metadata().unwrap().len() > 0, "{file}");
    }
    let record = json(&out.join("accuracy.json"));
    let variants = record["variants"].as_array().unwrap();
    assert_eq!(record["stopped"], "completed");
    let has_failed = |variant: &&Value| !variant["failure"].is_null();
    assert!(variants.iter().filter(has_failed).all(|v| v["settings"]["match"] == "given"), "{}", record["variants"]);

    // Every surface and every stiffness that needs no file of the user.
    let settings = |key: &str| variants.iter().filter_map(|v| v["settings"][key].as_str()).collect::<Vec<_>>();
    for surface in ["hertz-mean", "hertz", "winkler", "half-space", "fem"] {
        assert!(settings("surface").contains(&surface), "{surface}");
    }
    for stiffness in ["constant 20", "weber-banaschek", "iso6336", "fem"] {
        assert!(settings("stiffness").contains(&stiffness), "{stiffness}");
    }
    for criterion in ["half-width", "peak-pressure", "approach"] {
        let calibrated =
            variants.iter().any(|v| v["settings"]["match"] == criterion && v["settings"]["calibrated"] == true);
        assert!(calibrated, "{criterion}");
    }
    let left_out = record["left_out"].to_string();
    assert!(left_out.contains("simon") && left_out.contains("--quick"), "{left_out}");
    assert!(left_out.contains("fewer points, positions and steps with"), "{left_out}");
    // The finest mesh is run once, for the reference: the steps are refined on the next one.
    let finest = &variants[0]["settings"]["elements_per_half_width"];
    let on_finest = variants.iter().filter(|v| v["settings"]["elements_per_half_width"] == *finest);
    assert_eq!(on_finest.filter(|v| v["settings"]["surface"] == "fem").count(), 1);

    // The finest run is as far from the reference as the correction it got: that is what is stated as uncertain.
    let uncertainty = number(&record, "/reference/uncertainty/wear_profile");
    assert!((number(&variants[0], "/errors/wear_profile/relative") - uncertainty).abs() < 1e-12);
    assert_eq!(variants[0]["part_of_reference"], true);

    // A run is on the front where none is both faster and better, the uncertainty considered.
    for quantity in ["wear_profile", "peak_pressure", "worn_transmission_error"] {
        let uncertainty = number(&record, &format!("/reference/uncertainty/{quantity}"));
        let points = points(&record, quantity);
        assert_eq!(points.len(), variants.iter().filter(|v| !has_failed(v)).count());
        for &(wall_s, error, on_front) in &points {
            let beaten = points.iter().any(|other| {
                other.0 <= wall_s
                    && other.1.max(uncertainty) <= error.max(uncertainty)
                    && (other.0 < wall_s || other.1.max(uncertainty) < error.max(uncertainty))
            });
            assert_eq!(on_front, !beaten, "{quantity}: {wall_s} s, {error}");
        }
        let chosen = record["recommendations"].as_array().unwrap().iter().find(|r| r["quantity"] == quantity).unwrap();
        let cheapest = points.iter().filter(|point| point.1 <= 0.6).map(|point| point.0).fold(f64::INFINITY, f64::min);
        assert_eq!(chosen["is_within"], true, "{quantity}");
        let wall_s = number(&variants[chosen["variant"].as_u64().unwrap() as usize], "/simulation_s");
        assert_eq!(wall_s, cheapest, "{quantity}");
    }

    assert!(record["not_ranked"].as_array().unwrap().is_empty(), "{}", record["not_ranked"]);

    // One row per run; the columns of errors are those of the JSON.
    let csv = fs::read_to_string(out.join("accuracy.csv")).unwrap();
    let mut rows = csv::Reader::from_reader(csv.as_bytes());
    let column = rows.headers().unwrap().iter().position(|name| name == "wear_profile_error").unwrap();
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), variants.len());
    for (row, variant) in rows.iter().zip(variants) {
        assert_eq!(&row[0], variant["name"].as_str().unwrap());
        if has_failed(&variant) {
            assert_eq!(&row[column], "");
        } else {
            assert_eq!(row[column].parse::<f64>().unwrap(), number(variant, "/errors/wear_profile/relative"));
        }
    }

    // The recommended scene is that run.
    let recommended = &record["recommendations"][0];
    assert_eq!(recommended["quantity"], "wear_profile");
    let variant = &variants[recommended["variant"].as_u64().unwrap() as usize];
    let again = COMPARISON.path().join("again");
    let run = gearwear().arg("run").arg(out.join("recommended.toml")).arg("--out").arg(&again).output().unwrap();
    assert!(run.status.success(), "{}", said(&run));
    let summary = json(&again.join("summary.json"));
    assert_eq!(number(&summary, "/pinion/peak_wear_um"), number(variant, "/peak_wear_um/pinion"));
}

/// The same runs are not known to a tenth of a per cent: nothing is ranked that the reference does not know, and the remedy is named.
#[test]
fn a_reference_that_is_not_converged_ranks_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let output = accuracy(&write(dir.path(), &coarse_scene()), &out, &["--quick", "--within", "0.1"]);
    assert!(output.status.success(), "{}", said(&output));
    let record = json(&out.join("accuracy.json"));
    let not_ranked = record["not_ranked"].as_array().unwrap();
    let is_not = |quantity: &str| not_ranked.iter().find(|one| one["quantity"] == quantity);
    let uncertainty = record["reference"]["uncertainty"].as_object().unwrap();
    for (quantity, value) in uncertainty {
        assert_eq!(is_not(quantity).is_some(), value.as_f64().unwrap() > 1e-3, "{quantity}: {value}");
        let recommended = record["recommendations"].as_array().unwrap().iter().any(|r| r["quantity"] == **quantity);
        assert_ne!(recommended, is_not(quantity).is_some(), "{quantity}");
    }
    let profile = is_not("wear_profile").expect("elements of a third of a half-width are not so good");
    assert!(
        profile["remedy"].as_str().unwrap().contains("numerics.")
            || profile["remedy"].as_str().unwrap().contains("fem.")
    );
    assert!(points(&record, "wear_profile").iter().all(|point| !point.2));
    assert!(!out.join("recommended.toml").exists());
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("No ranking by wear profile"));
    assert!(String::from_utf8_lossy(&output.stdout).contains("not ranked: the reference is more uncertain than 0.1"));
}

/// A bed too soft for the tooth stiffness of ISO 6336 cannot be run; the others can.
#[test]
fn a_run_without_result_is_a_row_with_its_reason() {
    let record = json(&COMPARISON.path().join("out/accuracy.json"));
    let variants = record["variants"].as_array().unwrap();
    let failed: Vec<&Value> = variants.iter().filter(|v| !v["failure"].is_null()).collect();
    assert!(!failed.is_empty() && failed.len() < variants.len() / 2);
    for variant in failed {
        assert_eq!(variant["settings"]["match"], "given", "{variant}");
        assert!(variant["failure"].as_str().unwrap().contains("approach of the contact surface alone"), "{variant}");
        assert!(variant["errors"].as_object().unwrap().is_empty());
    }
}

#[test]
fn wrong_input_ends_with_status_2_and_writes_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let good = write(dir.path(), &coarse_scene());
    for (scene, more, found) in [
        (good.clone(), ["--within", "0"], "allowed: a number above 0 and at most 100"),
        (good, ["--within", "five"], "allowed: a number above 0 and at most 100"),
        (dir.path().join("nowhere.toml"), ["--within", "5"], "cannot be read"),
    ] {
        let output = accuracy(&scene, &out, &more);
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        assert!(said(&output).contains(found), "{}", said(&output));
        assert!(!out.exists());
    }
}

/// Ctrl-C after the reference: what is finished is kept, and said to be not the whole.
#[cfg(unix)]
#[test]
fn an_interrupt_keeps_the_runs_that_are_finished() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let scene = write(dir.path(), &coarse_scene());
    let mut child = gearwear()
        .arg("accuracy")
        .arg(&scene)
        .args(["--quick", "--threads", "1"])
        .arg("--out")
        .arg(&out)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The log names a run once it is finished; the reference is made of the first few.
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    assert!(lines.any(|line| line.unwrap().contains("10 of ")));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let rest: Vec<String> = lines.map(Result::unwrap).collect();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{rest:?}");
    assert!(rest.iter().any(|line| line.contains("runs were finished")), "{rest:?}");
    let record = json(&out.join("accuracy.json"));
    assert_eq!(record["stopped"], "interrupted");
    let finished = record["variants"].as_array().unwrap().len();
    assert!((10..60).contains(&finished), "{finished}");
}
