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

/// A stage of a gear unit becomes a scene that can be planned; what gives none is refused by file, line and attribute.
#[test]
fn init_makes_scenes_of_rexs() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("unit.rexs");
    let unit = include_str!("../../src/exchange/rexs/two_stages.rexs");
    let init = |text: &str, stage: &str| {
        std::fs::write(&file, text).unwrap();
        let mut command = Command::cargo_bin("gearwear").unwrap();
        command.arg("init").arg("--from").arg(&file).args(["--stage", stage]).assert()
    };
    let scene = init(unit, "1").success().get_output().stdout.clone();
    Command::cargo_bin("gearwear").unwrap().args(["plan", "-"]).write_stdin(scene).assert().success();
    let refused = init(&unit.replace(">91.5<", ">wide<"), "1").code(2).get_output().stderr.clone();
    let refused = String::from_utf8(refused).unwrap();
    assert!(refused.contains("unit.rexs: line 46: FZG & type C (id 10): center_distance: found \"wide\""), "{refused}");
    // What stands where is listed beside the scene.
    let listed = String::from_utf8(init(unit, "1").success().get_output().stderr.clone()).unwrap();
    for line in [
        "taken from the file: pair.normal_module_mm, ",
        "derived: which gear is pair.pinion (",
        "assumed: pair.pinion.tip_rounding_mm, ",
        "REQUIRED: nothing\n",
    ] {
        assert!(listed.contains(line), "{line}: {listed}");
    }
    let refused = init(unit, "9").code(2).get_output().stderr.clone();
    assert!(String::from_utf8(refused).unwrap().contains("--stage: found 9; allowed: 1 ("));
}

/// Inputs without an end are refused, as is what no parser of XML reads.
#[cfg(unix)]
#[test]
fn init_refuses_what_has_no_end() {
    let mut command = Command::cargo_bin("gearwear").unwrap();
    let refused = command.args(["init", "--from", "/dev/zero"]).assert().code(2).get_output().stderr.clone();
    let refused = String::from_utf8(refused).unwrap();
    assert!(
        refused.contains("/dev/zero: found more than 64 MB, or no end; allowed: a REXS model of up to 64 MB"),
        "{refused}"
    );
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
