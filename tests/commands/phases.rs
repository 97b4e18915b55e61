//! A load spectrum: what commands show of its phases, and what is refused.

use std::fs;
use std::process::Output;

use crate::program::gearwear;

const OPERATION: &str = "pinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\n";

fn scene(operation: &str) -> String {
    format!(
        "[pair]\npreset = \"fzg-c\"\n[operation]\n{operation}\n[contact]\nsurface = \"winkler\"\ntip_contact = false\n\
         [stiffness]\nmodel = \"weber-banaschek\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n[numerics]\n\
         error_estimate = false\nverify = false\nflank_points = 120\npositions = 40\nstep = {{ revolutions = 10000.0 }}\n"
    )
}

/// `[[operation.phases]]` with these lines.
fn phases(of: &[&str]) -> String {
    of.iter().map(|lines| format!("[[operation.phases]]\n{lines}\n")).collect()
}

/// What a command says of this scene, and the folder it ran in.
fn program(command: &str, text: &str, more: &[&str]) -> (Output, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    fs::write(&file, text).unwrap();
    let output = gearwear().arg(command).arg(&file).args(more).current_dir(folder.path()).output().unwrap();
    (output, folder)
}

#[test]
fn tables_page_and_plan_show_the_phases() {
    let operation = format!(
        "{OPERATION}{}",
        phases(&["pinion_revolutions = 20000\npinion_torque_Nm = 100.0", "pinion_revolutions = 10000"])
    );
    let text = scene(&operation);
    let (output, folder) = program("run", &text, &["--out", "out"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    for table in ["history.csv", "profiles.csv"] {
        let text = read(table);
        let rows: Vec<&str> = text.lines().collect();
        let column = rows[0].split(',').position(|name| name == "phase").unwrap_or_else(|| panic!("{}", rows[0]));
        let phase_of = |row: &str| row.split(',').nth(column).unwrap().to_owned();
        assert_eq!([phase_of(rows[1]), phase_of(rows[rows.len() - 1])], ["1", "2"], "{table}");
    }
    let page = read("report.html");
    assert!(page.contains("Phases of the operation") && page.contains("where the numbered phases end"));
    let (output, _folder) = program("plan", &text, &[]);
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(plan.contains("2 phases: 20000 revolutions under 100 N·m, 10000 under 302 N·m"), "{plan}");
}

/// Commands that look at one load say so.
#[test]
fn commands_of_one_load_warn() {
    let operation = format!("{OPERATION}{}", phases(&["pinion_revolutions = 20000\npinion_torque_Nm = 100.0"]));
    let (output, _folder) = program("mesh", &scene(&operation), &["--out", "pair.msh"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("operation.pinion_torque_Nm, 302 N·m, alone") && said.contains("100"), "{said}");
}

#[test]
fn what_is_refused() {
    let hours = |n: f64| format!("hours = {n}");
    let refused = |operation: String, parts: &[&str]| {
        let (output, folder) = program("run", &scene(&operation), &["--out", "out"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{operation}\n{said}");
        for part in parts.iter().chain(&["scene.toml"]) {
            assert!(said.contains(part), "no {part:?} in\n{said}");
        }
        assert!(!folder.path().join("out").exists(), "{operation}");
    };
    let with = |more: &str, list: &[&str]| format!("{OPERATION}{more}\n{}", phases(list));
    // Phases that do not add up.
    let two = [&hours(1.0)[..], &hours(2.0)];
    refused(with("hours = 4.0", &two), &["operation.hours: found 4", "allowed: 3, the sum of operation.phases"]);
    let turns = ["pinion_revolutions = 1000.0", "pinion_revolutions = 500.0"];
    refused(with("pinion_revolutions = 2e3", &turns), &["operation.pinion_revolutions: found 2000", "allowed: 1500"]);
    // None at all.
    refused(
        format!("{OPERATION}phases = []"),
        &["operation.phases: found no phase", "at least one [[operation.phases]]"],
    );
    // Both units, or neither.
    refused(
        with("", &["hours = 1.0\npinion_revolutions = 2.0"]),
        &["operation.phases[0].hours and operation.phases[0].pinion_revolutions", "say the same"],
    );
    refused(with("", &["hours = 1.0", "pinion_torque_Nm = 3.0"]), &["operation.phases[1].hours", "is missing"]);
    let coefficients = "hours = 1.0\ncoefficient_m2_per_N = 1e-17\ncoefficient_mm3_per_Nm = 1e-8";
    refused(with("", &[coefficients]), &["operation.phases[0].coefficient_m2_per_N", "say the same"]);
    // Values no phase has.
    refused(with("", &["hours = -1.0"]), &["operation.phases[0].hours: found -1", "greater than 0"]);
    refused(with("", &["hours = nan"]), &["operation.phases[0].hours"]);
    refused(with("", &["hours = 1.0\ntorque = 3.0"]), &["unknown key operation.phases[0].torque"]);
    // Snapshots beyond the last phase.
    refused(with("snapshots_h = [1.0, 5.0]", &two), &["operation.snapshots_h[1]: found 5", "up to the duration, 3"]);
    // Hours without a speed.
    let slow = format!("pinion_torque_Nm = 302.0\n{}", phases(&["hours = 1.0"]));
    refused(slow, &["operation.pinion_speed_rpm is missing", "operation.phases[0].hours needs the speed"]);
}
