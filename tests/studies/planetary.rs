//! Sweeps and uncertainty of a planetary stage from the outside: its rows and runs, restarts, verification, bad input.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};

use crate::program::{gearwear, json};

/// A stage on a surface, with a stiffness and at a resolution with which a run takes some milliseconds.
const STAGE: &str = r#"
[planetary]
planets = 4
load_sharing_factor = 1.2
normal_module_mm = 3.0
pressure_angle_deg = 20.0
centre_distance_mm = 60.0
face_width_mm = 20.0
sun = { teeth = 20, profile_shift = -0.3 }
planet = { teeth = 20, profile_shift = 0.3 }
ring = { teeth = 60, profile_shift = -0.3, tip_diameter_mm = 176.2, cutter = { teeth = 25 } }
[operation]
torque_Nm = 600.0
speed_rpm = 1000.0
hours = 1.0
[contact]
surface = "hertz-mean"
[stiffness]
model = "constant"
pair_N_per_mm_um = 20.0
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
[numerics]
verify = false
flank_points = 120
positions = 40
"#;

const K_GAMMA: &str = "planetary.load_sharing_factor=1:1.2:2";

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        Self::of(STAGE)
    }

    fn of(scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("stage.toml"), scene).unwrap();
        Self { folder }
    }

    fn out(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, command: &str, out: &str, option: &str, values: &[&str], more: &[&str]) -> Command {
        let mut program = gearwear();
        program.arg(command).arg(self.out("stage.toml")).arg("--out").arg(self.out(out)).args(more);
        for value in values {
            program.args([option, value]);
        }
        program
    }

    fn sweep(&self, out: &str, vary: &[&str], more: &[&str]) -> Output {
        self.command("sweep", out, "--vary", vary, more).output().unwrap()
    }

    fn study(&self, out: &str, uncertain: &[&str], more: &[&str]) -> Output {
        self.command("uncertainty", out, "--uncertain", uncertain, more).output().unwrap()
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", said(output));
}

fn refused(output: &Output, parts: &[&str]) {
    let message = said(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    for part in parts {
        assert!(message.contains(part), "no {part:?} in:\n{message}");
    }
}

/// Columns of a table by name.
fn column(file: &Path, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_path(file).unwrap();
    let at = reader.headers().unwrap().iter().position(|other| other == name).unwrap_or_else(|| panic!("{name}"));
    reader.records().map(|row| row.unwrap()[at].to_owned()).collect()
}

/// A row of a stage holds what `gearwear run` says of the stage, to the bit: of both meshes, of all flanks, and of the stage.
#[test]
fn a_row_is_the_run_of_its_stage() {
    let bench = Bench::new();
    let vary = ["planetary.planets=4:5:2", K_GAMMA, "planetary.{sun,planet}.tip_rounding_mm=0.05,0.1"];
    done(&bench.sweep("out", &vary, &["--quiet"]));
    let table = bench.out("out").join("sweep.csv");
    assert_eq!(column(&table, "index").len(), 8);
    assert!(column(&table, "status").iter().all(|status| status == "ok"));
    // One snapshot, as a sweep has: wear steps are shortened to hit snapshots.
    let own = STAGE
        .replace("planets = 4", "planets = 5")
        .replace("profile_shift = -0.3 }", "profile_shift = -0.3, tip_rounding_mm = 0.05 }")
        .replace("profile_shift = 0.3 }", "profile_shift = 0.3, tip_rounding_mm = 0.05 }")
        .replace("hours = 1.0", "hours = 1.0\nsnapshots_h = [1.0]");
    fs::write(bench.out("own.toml"), own).unwrap();
    let run = gearwear().args(["run", "--quiet", "--out"]).arg(bench.out("run")).arg(bench.out("own.toml")).output();
    done(&run.unwrap());
    let summary = json(&bench.out("run").join("summary.json"));
    for name in [
        "transmission_error.new.peak_to_peak",
        "transmission_error.worn.peak_to_peak",
        "sun.peak_wear_um",
        "planet.sun_flank.tip_edge_wear_um",
        "planet.ring_flank.peak_wear_um",
        "ring.worn_volume_mm3",
        "planet.worn_mass_mg",
        "sun_planet.worn.flank_pressure_MPa",
        "planet_ring.new.transmission_error_um.peak_to_peak",
        "planet_ring.geometry.transverse_contact_ratio",
    ] {
        let value: f64 = column(&table, name)[6].parse().unwrap();
        let expected = summary.pointer(&format!("/{}", name.replace('.', "/"))).unwrap();
        assert_eq!(value, expected.as_f64().unwrap(), "{name}");
    }
    // A planet more has less load, and its mate the sun more meshes.
    let force = |row: usize| column(&table, "sun_planet.contact.line_load_N_per_mm")[row].parse::<f64>().unwrap();
    assert!((force(0) / force(4) - 5.0 / 4.0).abs() < 1e-12 && (force(2) / force(0) - 1.2).abs() < 1e-12);
    let record = json(&bench.out("out").join("sweep.json"));
    assert_eq!((&record["kind"], &record["ok"]), (&json!("stage"), &json!(8)));
    let page = fs::read_to_string(bench.out("out").join("report.html")).unwrap();
    assert!(page.contains("planet towards the ring") && !page.contains("pinion’s"));
}

/// The law of one mesh alone, said in the other unit than in the file, changes the flanks of that mesh alone.
#[test]
fn ver_the_law_of_a_mesh_wears_its_flanks_alone() {
    let bench = Bench::of(&format!("{STAGE}[sun_planet.wear]\ncoefficient_mm3_per_Nm = 1e-8\n"));
    let output = bench.sweep("out", &["sun_planet.wear.coefficient_m2_per_N=1e-22,2e-22"], &["--threads", "1"]);
    done(&output);
    let of = |name: &str| {
        let values = column(&bench.out("out").join("sweep.csv"), name);
        let [one, other] = [0, 1].map(|row| values[row].parse::<f64>().unwrap());
        other / one
    };
    // Wear of nanometres changes no pressure: it grows with k.
    for (flank, expected) in [("sun", 2.0), ("planet.sun_flank", 2.0), ("planet.ring_flank", 1.0), ("ring", 1.0)] {
        let ratio = of(&format!("{flank}.worn_volume_mm3"));
        assert!((ratio / expected - 1.0).abs() < 1e-3, "{flank}: {ratio}");
    }
}

/// A sweep that was stopped goes on with the rows that are missing, in shards or whole, to the same rows; stages that cannot be assembled are rows.
#[test]
fn a_cut_journal_goes_on_and_impossible_stages_are_rows() {
    let bench = Bench::new();
    let vary = ["planetary.planets=3:5:3", K_GAMMA];
    done(&bench.sweep("whole", &vary, &[]));
    let journal = fs::read_to_string(bench.out("whole").join("rows.jsonl")).unwrap();
    assert_eq!(journal.lines().count(), 1 + 6);
    let half: Vec<&str> = journal.lines().take(1 + 3).collect();
    fs::create_dir(bench.out("cut")).unwrap();
    fs::write(bench.out("cut").join("rows.jsonl"), half.join("\n") + "\n").unwrap();
    let output = bench.sweep("cut", &vary, &[]);
    done(&output);
    assert!(said(&output).contains("3 of them finished before"), "{}", said(&output));
    for part in ["1/2", "2/2"] {
        done(&bench.sweep(&format!("part-{}", &part[..1]), &vary, &["--shard", part, "--threads", "1"]));
    }
    let merged = gearwear()
        .args(["sweep", "merge"])
        .args([bench.out("part-1"), bench.out("part-2")])
        .arg("--out")
        .arg(bench.out("merged"))
        .output();
    done(&merged.unwrap());
    for name in ["sun.peak_wear_um", "ring.peak_wear_um", "transmission_error.worn.peak_to_peak", "error"] {
        let whole = column(&bench.out("whole").join("sweep.csv"), name);
        for other in ["cut", "merged"] {
            assert_eq!(column(&bench.out(other).join("sweep.csv"), name), whole, "{other}, {name}");
        }
    }
    let errors = column(&bench.out("whole").join("sweep.csv"), "error");
    assert!(errors[..2].iter().all(|error| error.contains("planets that cannot be assembled")), "{errors:?}");
    let other = STAGE.replace("torque_Nm = 600.0", "torque_Nm = 500.0");
    fs::write(bench.out("stage.toml"), other).unwrap();
    refused(&bench.sweep("cut", &vary, &[]), &["rows of another sweep", "scene"]);
}

/// The best stage is verified in both meshes, each with its errors.
#[test]
fn the_best_stage_is_verified() {
    let scene = STAGE.replace("verify = false\n", "") + "[fem]\nelements_per_half_width = 2\n";
    let bench = Bench::of(&scene);
    let limit = ["--best", "planet.ring_flank.peak_wear_um", "--subject-to", "sun.peak_wear_um<=9"];
    done(&bench.sweep("out", &["planetary.planet.tip_rounding_mm=0.05,0.1"], &limit));
    let record = json(&bench.out("out").join("sweep.json"));
    assert_eq!((&record["verification"]["verified"], &record["optimum"]["within_limits"]), (&json!(2), &json!(2)));
    assert!(record["optimum"]["error"].as_f64().is_some_and(|error| error > 0.0));
    let table = bench.out("out").join("sweep.csv");
    for name in ["sun_planet.error.total.peak_wear.pinion", "planet_ring.error.total.peak_wear.wheel"] {
        assert!(column(&table, name).iter().all(|error| error.parse::<f64>().is_ok()), "{name}");
    }
}

fn output<'a>(record: &'a Value, name: &str) -> &'a Value {
    let outputs = record["outputs"].as_array().unwrap();
    outputs.iter().find(|output| output["output"] == name).unwrap_or_else(|| panic!("{name}"))
}

/// The record without what may differ between two starts.
fn timeless(out: &Path) -> Value {
    let mut record = json(&out.join("uncertainty.json"));
    record["wall_s"] = Value::Null;
    record["threads"] = Value::Null;
    record
}

/// K_γ and the wear coefficient as distributions: the journal has a line for each run, and a study that was stopped goes on to the same bytes.
#[test]
fn uncertainty_of_a_stage_goes_on_where_it_was_stopped() {
    let bench = Bench::new();
    let uncertain = ["planetary.load_sharing_factor=uniform:1:1.3", "coefficient", "torque"];
    let more = ["--samples", "16", "--limit", "sun.peak_wear_um=0.5", "--threads", "1"];
    done(&bench.study("whole", &uncertain, &more));
    let journal = fs::read_to_string(bench.out("whole").join("rows.jsonl")).unwrap();
    // A, B, and A with each key from B.
    assert_eq!(journal.lines().count(), 1 + 16 * 5);
    let record = timeless(&bench.out("whole"));
    let keys: Vec<&str> =
        record["uncertain"].as_array().unwrap().iter().map(|one| one["key"].as_str().unwrap()).collect();
    assert_eq!(keys, ["planetary.load_sharing_factor", "wear.coefficient_m2_per_N", "operation.torque_Nm"]);
    for name in
        ["sun.peak_wear_um", "planet.sun_flank.peak_wear_um", "planet.ring_flank.peak_wear_um", "ring.peak_wear_um"]
    {
        let of = output(&record, name);
        let [p05, p50, p95] = ["p05", "p50", "p95"].map(|quantile| of["quantiles"][quantile].as_f64().unwrap());
        assert!(0.0 < p05 && p05 < p50 && p50 < p95, "{name}");
        // lognormal:1.5 is most of the scatter of every depth.
        let total = |key: usize| of["indices"][key]["total"]["value"].as_f64().unwrap();
        assert!(total(1) > 0.7 && total(1) > total(0), "{name}: {of}");
        assert!(record["bands"][name.trim_end_matches(".peak_wear_um")]["radius_mm"].as_array().unwrap().len() > 10);
    }
    let life = output(&record, "life.sun.peak_wear_um=0.5");
    assert_eq!((&life["unit"], &life["samples"]), (&json!("h"), &json!(32)));

    let half: Vec<&str> = journal.lines().take(1 + 30).collect();
    fs::create_dir(bench.out("resumed")).unwrap();
    fs::write(bench.out("resumed").join("rows.jsonl"), format!("{}\n{{\"number\":3", half.join("\n"))).unwrap();
    let resumed = bench.study("resumed", &uncertain, &["--samples", "16", "--limit", "sun.peak_wear_um=0.5"]);
    done(&resumed);
    assert!(said(&resumed).contains("30 runs were finished before"), "{}", said(&resumed));
    assert_eq!(timeless(&bench.out("resumed")), record);
    for file in ["samples.csv", "columns.json"] {
        assert_eq!(
            fs::read(bench.out("resumed").join(file)).unwrap(),
            fs::read(bench.out("whole").join(file)).unwrap()
        );
    }
}

/// The life of a stage is the shorter one of its meshes; samples that come to no limit are censored in both.
#[test]
fn lives_of_a_stage_are_censored() {
    let bench = Bench::of(&STAGE.replace("hours = 1.0", "hours = 1.0\nstop = { wear_um = 1.5 }"));
    let more = ["--samples", "16", "--outputs", "life.hours,life.revolutions,sun_planet.life.revolutions"];
    done(&bench.study("out", &["coefficient"], &more));
    let record = timeless(&bench.out("out"));
    let [hours, revolutions, of_mesh] = ["life.hours", "life.revolutions", "sun_planet.life.revolutions"].map(|name| {
        (output(&record, name)["censored"].as_f64().unwrap(), output(&record, name)["nominal"].as_f64().unwrap())
    });
    assert!(hours.0 > 0.0 && hours.0 < 0.5 && hours.0 == revolutions.0 && hours.0 == of_mesh.0, "{hours:?}");
    // 1000 revolutions a minute of the sun, 3/4 of them on the carrier.
    assert!((revolutions.1 / (60e3 * hours.1) - 1.0).abs() < 1e-9 && (of_mesh.1 / revolutions.1 - 0.75).abs() < 1e-9);
}

/// Where wear grows with k alone, its distribution is that of k in every flank, and samples that differ in k alone share runs of both meshes to the same figures
/// as runs of their own.
#[test]
fn ver_samples_share_runs_of_both_meshes() {
    // Wear of nanometres changes no pressure.
    let bench = Bench::of(&STAGE.replace("coefficient_m2_per_N = 1e-17", "coefficient_m2_per_N = 1e-22"));
    let uncertain = ["wear.coefficient_m2_per_N=lognormal:1e-22:1.5"];
    done(&bench.study("shared", &uncertain, &["--samples", "64"]));
    // Lives are not shared.
    done(&bench.study("alone", &uncertain, &["--samples", "64", "--limit", "sun.peak_wear_um=1"]));
    let [shared, alone] = ["shared", "alone"].map(|name| timeless(&bench.out(name)));
    for name in
        ["sun.peak_wear_um", "planet.sun_flank.peak_wear_um", "planet.ring_flank.peak_wear_um", "ring.peak_wear_um"]
    {
        let [one, other] = [&shared, &alone].map(|record| output(record, name));
        let quantile = |of: &Value, name: &str| of["quantiles"][name].as_f64().unwrap();
        for share in ["p05", "p50", "p95"] {
            let off = quantile(one, share) / quantile(other, share) - 1.0;
            assert!(off.abs() < 1e-3, "{name}, {share}: {off}");
        }
        // Φ⁻¹(0.95) = 1.6449 standard deviations of the logarithm.
        let expected = (1.6449 * 1.5f64.ln()).exp();
        let ratio = quantile(one, "p95") / quantile(one, "p50");
        assert!((ratio / expected - 1.0).abs() < 0.05, "{name}: {ratio} and {expected}");
    }
}

/// What a stage does not have is refused before any work, in the words of the stage.
#[test]
fn bad_input_is_refused() {
    let bench = Bench::new();
    for (vary, parts) in [
        ("planetary.plnets=3:4:2", &["unknown key planetary.plnets", "did you mean planetary.planets?"][..]),
        ("operation.pinion_torque_Nm=1:2:2", &["unknown key operation.pinion_torque_Nm", "torque_Nm"]),
        ("pair.face_width_mm=1:2:2", &["[planetary], or a gear pair, [pair]: one of the two"]),
        ("planetary.load_sharing_factor=5:6:2", &["planetary.load_sharing_factor: found 5", "1 to 4"]),
    ] {
        refused(&bench.sweep("out", &[vary], &[]), parts);
    }
    let torque = ["operation.torque_Nm=500:600:2"];
    refused(&bench.sweep("out", &torque, &["--best", "pinion.peak_wear_um"]), &["such as sun.peak_wear_um"]);
    refused(&bench.sweep("out", &torque, &["--outputs", "wheel.peak_wear_um"]), &["unknown output wheel.peak_wear_um"]);
    for (uncertain, more, parts) in [
        ("planetary.planets=uniform:3:5", ["--samples", "8"], &["takes whole numbers"][..]),
        ("torque", ["--limit", "pinion.peak_wear_um=1"], &["unknown figure pinion.peak_wear_um", "sun.peak_wear_um"]),
        ("planetary.sun.tip_rounding_mm=±10%", ["--samples", "8"], &["which it does not have"]),
    ] {
        refused(&bench.study("out", &[uncertain], &more), parts);
    }
    assert!(!bench.out("out").exists());
}
