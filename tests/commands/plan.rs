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
