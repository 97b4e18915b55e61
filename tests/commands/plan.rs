//! `gearwear plan`: what it prints.

use assert_cmd::Command;
use predicates::prelude::*;

use crate::program::preset;

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
    gearwear("text").stdout(predicate::str::contains("Left out").and(predicate::str::contains("simulation")));
}

/// A plan of what `run` refuses is refused; output that cannot be written is no success.
#[test]
fn a_plan_promises_nothing_that_cannot_run() {
    let scene =
        preset("fzg-c").replace("surface = \"half-space\"", "surface = \"winkler\"\ncalibration = \"nowhere.json\"");
    let mut command = Command::cargo_bin("gearwear").unwrap();
    let assert = command.args(["plan", "-"]).write_stdin(scene).assert().code(2).stdout("");
    assert.stderr(predicate::str::contains("contact.calibration").and(predicate::str::contains("nowhere.json")));
    #[cfg(target_os = "linux")]
    {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("gearwear"));
        let output = command.args(["init", "fzg-c"]).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains("standard output cannot be written"));
    }
}
