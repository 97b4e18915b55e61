//! `gearwear init`, `gearwear schema` and `gearwear completions`: what they print.

use assert_cmd::Command;
use gearwear::{PRESETS, scene_schema};

#[test]
fn init_prints_the_presets() {
    for preset in PRESETS {
        Command::cargo_bin("gearwear").unwrap().args(["init", preset.name]).assert().success().stdout(preset.text);
    }
    Command::cargo_bin("gearwear").unwrap().arg("init").assert().success().stdout(PRESETS[0].text);
}

#[test]
fn schema_and_completions_are_printed() {
    let output = Command::cargo_bin("gearwear").unwrap().arg("schema").output().unwrap();
    let printed: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(&printed, scene_schema());
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        Command::cargo_bin("gearwear").unwrap().args(["completions", shell]).assert().success();
    }
}
