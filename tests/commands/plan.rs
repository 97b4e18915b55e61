//! `gearwear plan`: what it prints.

use std::fs;

use assert_cmd::Command;
use predicates::prelude::*;

use crate::program::{gearwear, preset};

#[test]
fn json_for_scripts_and_text_for_people() {
    let scene = preset("thesis-spur");
    let gearwear = |format: &str| {
        let mut command = Command::cargo_bin("gearwear").unwrap();
        command.args(["plan", "-", "--format", format]).write_stdin(scene.clone());
        command.assert().success().stderr("")
    };
    let json: serde_json::Value = serde_json::from_slice(&gearwear("json").get_output().stdout).unwrap();
    assert_eq!(json["stages"][0]["name"], "geometry");
    assert_eq!(json["left_out"][1]["name"], "tooth-stiffness");
    assert!(json["left_out"][1]["reason"].as_str().unwrap().contains("20 N/(mm·µm)"));
    assert!(json["cost"]["seconds"].as_f64().unwrap() > 0.0 && json["cost"]["memory_GB"].as_f64().unwrap() > 0.0);
    gearwear("text").stdout(predicate::str::contains("Left out").and(predicate::str::contains(" s on one thread")));
}

/// A plan of what `run` refuses is refused; output that cannot be written is no success.
#[test]
fn a_plan_promises_nothing_that_cannot_run() {
    let scene = preset("fzg-c").replace("# surface = \"fem\"", "surface = \"winkler\"\ncalibration = \"nowhere.json\"");
    let mut command = Command::cargo_bin("gearwear").unwrap();
    let assert = command.args(["plan", "-"]).write_stdin(scene).assert().code(2).stdout("");
    assert.stderr(predicate::str::contains("contact.calibration").and(predicate::str::contains("nowhere.json")));
    // Nor is one of what `improve` refuses.
    let scene = preset("fzg-c") + "\n[improve]\ngoals = [\"pinion.peak_ware_um\"]\n";
    let mut command = Command::cargo_bin("gearwear").unwrap();
    let assert = command.args(["plan", "-"]).write_stdin(scene).assert().code(2).stdout("");
    assert.stderr(predicate::str::contains("improve.goals[0]").and(predicate::str::contains("pinion.peak_wear_um")));
    #[cfg(target_os = "linux")]
    {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("gearwear"));
        let output = command.args(["init", "fzg-c"]).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains("standard output cannot be written"));
    }
}

/// What a run would refuse before its first step is refused by the plan too, and a run that is refused leaves nothing behind: a foundation that yields
/// more than the stiffness model allows the whole pair.
#[test]
fn plan_and_run_refuse_the_same_springs_and_nothing_stays() {
    let dir = tempfile::tempdir().unwrap();
    let scene = dir.path().join("soft.toml");
    let text = "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\npinion_revolutions = 10.0\n[wear]\nlaw = \"archard\"\n\
                coefficient_m2_per_N = 1e-17\n[contact]\nsurface = \"winkler\"\nfoundation_MPa_per_mm = 20.0\n[stiffness]\nmodel = \"iso6336\"\n\
                [numerics]\npositions = 40\nflank_points = 100\nerror_estimate = false\nverify = false\n";
    fs::write(&scene, text).unwrap();
    let out = dir.path().join("out");
    let plan = gearwear().arg("plan").arg(&scene).output().unwrap();
    let run = gearwear().arg("run").arg(&scene).arg("--out").arg(&out).output().unwrap();
    for output in [&plan, &run] {
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("contact.foundation_MPa_per_mm") && said.contains("soft.toml:11"), "{said}");
    }
    assert!(!out.exists());
}

/// Finite elements are not asked by the plan: a run that they refuse the scene leaves nothing behind either, nor takes away what else is there.
#[test]
fn a_run_that_its_elements_refuse_leaves_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let scene = dir.path().join("soft.toml");
    let text = "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\npinion_revolutions = 10.0\n[wear]\nlaw = \"archard\"\n\
                coefficient_m2_per_N = 1e-17\n[contact]\nsurface = \"winkler\"\nfoundation_MPa_per_mm = 20.0\n\
                [fem]\nelements_per_half_width = 3\n[numerics]\npositions = 40\nflank_points = 100\nerror_estimate = false\nverify = false\n";
    fs::write(&scene, text).unwrap();
    let out = dir.path().join("out");
    fs::create_dir(&out).unwrap();
    fs::write(out.join("notes.txt"), "mine").unwrap();
    let run = gearwear().arg("run").arg(&scene).arg("--out").arg(&out).output().unwrap();
    assert_eq!(run.status.code(), Some(2), "{}", String::from_utf8_lossy(&run.stderr));
    let left: Vec<_> = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["notes.txt"]);
}
