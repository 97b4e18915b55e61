//! `gearwear improve` from the outside: the whole path, the same bits on any number of threads and after a break, bad input.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::program::{exchanged, gearwear, json};

/// The thesis-spur scene at a resolution at which a run takes about a millisecond; wear and pressure fall with the face width.
fn coarse_scene(improve: &str) -> String {
    let scene = exchanged(
        "thesis-spur",
        &[
            ("surface = \"winkler\"", "surface = \"hertz-mean\""),
            ("match = \"half-width\"", "# match"),
            ("flank_points = 750 ", "flank_points = 60 "),
            ("positions = 400 ", "positions = 40 "),
            ("step = { revolutions = 7665.0 }", "verify = false\nstep = { revolutions = 200000.0 }"),
        ],
    );
    format!("{scene}\n[improve]\n{improve}")
}

/// Wide gears wear little, and more torque wears more; a limit on the pressure from below keeps the search off the corner.
const WIDTH_AND_TORQUE: &str = "free = [\"pair.face_width_mm = 10:20 ± 0.1\", \"operation.pinion_torque_Nm = 200:300\"]\n\
     goals = [\"pinion.peak_wear_um\", \"new.transmission_error_um.peak_to_peak\"]\nevaluations = 48\n";

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new(scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), scene).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn improve(&self, out: &str, threads: &str) -> Output {
        self.command("scene.toml", out, threads).output().unwrap()
    }

    fn command(&self, scene: &str, out: &str, threads: &str) -> Command {
        let mut command = gearwear();
        command.current_dir(self.folder.path()).args(["improve", scene, "--out", out, "--threads", threads]);
        command
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", said(output));
}

/// The record without what may differ between two starts.
fn timeless(out: &Path) -> Value {
    let mut record = json(&out.join("summary.json"));
    record["wall_s"] = Value::Null;
    record["threads"] = Value::Null;
    record
}

fn rows(table: &Path) -> Vec<csv::StringRecord> {
    csv::Reader::from_path(table).unwrap().records().map(Result::unwrap).collect()
}

/// The widest pair under the least torque has the least wear: a corner of the ranges, and told to be one. What the study says of it is what the
/// program makes of its scene.
#[test]
fn a_proposal_is_a_scene_with_the_figures_that_are_claimed() {
    let bench = Bench::new(&coarse_scene(WIDTH_AND_TORQUE));
    let output = bench.improve("out", "2");
    done(&output);
    let record = json(&bench.path("out/summary.json"));
    assert_eq!(record["status"], "complete");
    let proposal = &record["proposals"][0];
    assert!(proposal["name"].as_str().unwrap().starts_with("least wear"), "{proposal}");
    assert_eq!(proposal["values"][0]["value"], "20");
    assert_eq!(proposal["values"][0]["edge"], "upper");
    assert_eq!(proposal["values"][1]["value"], "200");
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.contains("end of the range") && told.contains("least wear"), "{told}");
    let file = bench.path("out").join(proposal["file"].as_str().unwrap());
    let ran = gearwear()
        .args(["run", file.to_str().unwrap(), "--quiet", "--no-report", "--out"])
        .arg(bench.path("run"))
        .output();
    done(&ran.unwrap());
    let summary = json(&bench.path("run/summary.json"));
    let wear = &proposal["figures"][0];
    assert_eq!((&wear["figure"], &wear["value"]), (&"pinion.peak_wear_um".into(), &summary["pinion"]["peak_wear_um"]));
    // A tenth of a millimetre more or less on 20 mm: half a per cent of the load per width.
    let worse = proposal["sensitivity"][0]["changes"][0].as_f64().unwrap();
    assert!((0.002..0.01).contains(&worse), "{worse}");
    for page in ["report.html", "columns.json", "scene.toml"] {
        assert!(bench.path("out").join(page).exists(), "{page}");
    }
    let designs = rows(&bench.path("out/improve.csv"));
    let searched = designs.iter().filter(|row| &row[1] == "search").count();
    assert_eq!(searched as u64, record["searched"].as_u64().unwrap());
    assert!(searched <= 48);
    let verified = rows(&bench.path("out/front.csv"));
    assert_eq!(verified.len(), designs.iter().filter(|row| &row[1] == "verify").count());
}

/// Threads and breaks change nothing; finished designs are not run again.
#[test]
fn threads_and_breaks_change_nothing() {
    let bench = Bench::new(&coarse_scene(WIDTH_AND_TORQUE));
    done(&bench.improve("one", "1"));
    done(&bench.improve("three", "3"));
    let whole = timeless(&bench.path("one"));
    assert_eq!(whole, timeless(&bench.path("three")));
    let journal = fs::read_to_string(bench.path("one/rows.jsonl")).unwrap();
    let lines: Vec<&str> = journal.lines().collect();
    // Half of the designs, and a line that was cut short.
    let half = lines[..lines.len() / 2].join("\n") + "\n{\"number\":";
    fs::create_dir(bench.path("broken")).unwrap();
    fs::write(bench.path("broken/rows.jsonl"), half).unwrap();
    let output = bench.improve("broken", "2");
    done(&output);
    assert!(
        said(&output).contains(&format!("goes on: {} designs were finished before", lines.len() / 2 - 1)),
        "{}",
        said(&output)
    );
    assert_eq!(whole, timeless(&bench.path("broken")));
    let again = fs::read_to_string(bench.path("broken/rows.jsonl")).unwrap();
    assert_eq!(again.lines().count(), lines.len());
    // Another question is another study.
    fs::write(bench.path("scene.toml"), coarse_scene(&WIDTH_AND_TORQUE.replace("10:20", "10:21"))).unwrap();
    let output = bench.improve("one", "1");
    assert_eq!(output.status.code(), Some(2));
    assert!(said(&output).contains("free keys: pair.face_width_mm = 10:20"), "{}", said(&output));
    assert_eq!(whole, timeless(&bench.path("one")));
}

/// Limits that no design keeps are told with the nearest.
#[test]
fn limits_that_cannot_be_kept() {
    let limit = format!("{WIDTH_AND_TORQUE}limits = [\"pinion.peak_wear_um <= 1e-6\"]\n");
    let bench = Bench::new(&coarse_scene(&limit));
    let output = bench.improve("out", "1");
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    assert!(said(&output).contains("the nearest misses pinion.peak_wear_um <= 1e-6 by"), "{}", said(&output));
    assert!(!bench.path("out/summary.json").exists());
}

/// Each fault with its key and line, and nothing is written.
#[test]
fn bad_questions_are_refused_where_they_stand() {
    for (improve, parts) in [
        (
            "free = [\"pair.face_widht_mm = 1:2\"]",
            vec!["improve.free[0]", "unknown key", "did you mean pair.face_width_mm"],
        ),
        ("free = [\"pair.face_width_mm = 20:10\"]", vec!["improve.free[0]", "FROM below TO"]),
        (
            "free = [\"pair.face_width_mm = 10:20\", \"pair.face_width_mm = 10:12\"]",
            vec!["improve.free[1]", "each key once"],
        ),
        ("free = [\"operation.phases.2.hours = 1:2\"]", vec!["improve.free[0]", "a phase that the scene has"]),
        ("free = [\"pair.pinion.tip_relief.amount_um = 0:10\"]", vec!["improve.free", "make no scene", "length_mm"]),
        ("goals = [\"pinion.peak_ware_um\"]", vec!["improve.goals[0]", "did you mean pinion.peak_wear_um"]),
        ("goals = []", vec!["improve.goals", "1 to 3"]),
        (
            "goals = [\"life.hours\"]\nfree = [\"pair.face_width_mm = 10:20\"]",
            vec!["improve.goals[0]", "does not have"],
        ),
        ("limits = [\"pinion.peak_wear_um < 5\"]", vec!["improve.limits[0]", "PATH <= VALUE"]),
        ("evaluations = 5", vec!["improve.evaluations", "at least 20 and at most 2000"]),
        ("speed = 5", vec!["improve.speed", "unknown key"]),
    ] {
        let bench = Bench::new(&coarse_scene(improve));
        let output = bench.improve("out", "1");
        assert_eq!(output.status.code(), Some(2), "{improve}: {}", said(&output));
        for part in parts.into_iter().chain(["scene.toml"]) {
            assert!(said(&output).contains(part), "no {part:?} in:\n{}", said(&output));
        }
        assert!(!bench.path("out").exists(), "{improve}");
    }
}

/// The example on few designs and few finite elements: proposals with their errors, and every word of them in the page.
#[test]
fn the_example_proposes_reliefs() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/improve_tip_relief.toml"))
        .unwrap();
    let quick = format!("{text}evaluations = 20\n[numerics]\npositions = 40\nflank_points = 120\n");
    let bench = Bench::new(&quick);
    let output = bench.improve("out", "2");
    done(&output);
    let record = json(&bench.path("out/summary.json"));
    let proposals = record["proposals"].as_array().unwrap();
    assert!(!proposals.is_empty() && record["searched"] == 20);
    assert!(
        record["fast_model"]
            .as_str()
            .unwrap()
            .contains("half-space, the stiffness of its teeth by finite elements once")
    );
    assert!(record["verified_on"].as_str().unwrap().contains("contact surface fem"));
    let page = fs::read_to_string(bench.path("out/report.html")).unwrap();
    for proposal in proposals {
        assert!(page.contains(proposal["name"].as_str().unwrap()));
        let pressure = proposal["figures"]
            .as_array()
            .unwrap()
            .iter()
            .find(|of| of["figure"] == "worn.flank_pressure_MPa")
            .unwrap();
        assert!(pressure["value"].as_f64().unwrap() <= 1900.0 && pressure["error"].is_number(), "{pressure}");
    }
    assert!(!record["bounds"].as_array().unwrap().is_empty());
}
