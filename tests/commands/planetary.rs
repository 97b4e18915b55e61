//! Planetary stages, from the outside: what is written, and what is refused.

use std::fs;

use serde_json::Value;

use crate::program::{gearwear, json};

const STAGE: &str = r#"
[planetary]
planets = 4
normal_module_mm = 3.0
pressure_angle_deg = 20.0
centre_distance_mm = 60.0
face_width_mm = 20.0
sun = { teeth = 20, profile_shift = -0.3 }
planet = { teeth = 20, profile_shift = 0.3 }
ring = { teeth = -60, profile_shift = -0.3, tip_diameter_mm = -176.2, cutter = { teeth = 25 } }
[operation]
torque_Nm = 600.0
speed_rpm = 1000.0
hours = 1.0
[contact]
surface = "hertz"
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
[numerics]
error_estimate = false
verify = false
flank_points = 120
positions = 40
"#;

#[test]
fn a_stage_leaves_a_folder_of_each_mesh_and_a_summary() {
    let dir = tempfile::tempdir().unwrap();
    let (scene, out) = (dir.path().join("stage.toml"), dir.path().join("out"));
    fs::write(&scene, STAGE).unwrap();
    let run = gearwear().args(["run", "--quiet", "--out"]).arg(&out).arg(&scene).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let summary = json(&out.join("summary.json"));
    for (mesh, folder, gears) in
        [("sun_planet", "sun-planet", ["sun", "planet"]), ("planet_ring", "planet-ring", ["planet", "ring"])]
    {
        let of_mesh = json(&out.join(folder).join("summary.json"));
        assert_eq!(summary[mesh], of_mesh);
        let of_stage = |gear: &str| match gear {
            "planet" => summary["planet"][if mesh == "sun_planet" { "sun_flank" } else { "ring_flank" }].clone(),
            gear => summary[gear].clone(),
        };
        assert_eq!(gears.map(of_stage), [of_mesh["pinion"].clone(), of_mesh["wheel"].clone()]);
        assert!(out.join(folder).join("report.html").exists());
    }
    assert_eq!(summary["planetary"]["meshes_per_revolution"]["sun"], 3.0);
    assert_eq!(summary["planetary"]["speed_rpm"]["carrier"], 250.0);
    assert_eq!(summary["stopped"], "completed");
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(
        page.contains("The stage in mesh, to scale") && !page.contains("pinion’s flank"),
        "of sun, planet and ring alone"
    );
    assert_eq!(fs::read_to_string(out.join("scene.toml")).unwrap(), STAGE);
    // The folder has what a run needs to go on, and the complete one is read.
    let again = gearwear().args(["run", "--quiet", "--resume"]).arg(&out).output().unwrap();
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
    assert_eq!(json(&out.join("summary.json")), summary);

    let plan = gearwear().args(["plan", "--format", "json"]).arg(&scene).output().unwrap();
    let plan: Value = serde_json::from_slice(&plan.stdout).unwrap();
    assert!(plan["planet_ring"]["cost"]["seconds"].as_f64().is_some());
}

/// Each impossible stage is refused at its line, with the figure; nothing is written.
#[test]
fn impossible_stages_are_refused() {
    let cases: [(&str, &str, &[&str]); 10] = [
        (
            "planets = 4",
            "planets = 3",
            &["planetary.planets", "(20 + 60) × 120.0000°/360° = 26.6667 is no whole number"],
        ),
        (
            "planets = 4",
            "planets = 8",
            &["planetary.planets", "planets 1 and 2 touch: their axes are 45.9220 mm apart"],
        ),
        ("planets = 4", "planets = 4\nplanet_angles_deg = [0, 90, 180]", &["planetary.planet_angles_deg", "4 angles"]),
        ("planets = 4", "planets = 4\nload_sharing_factor = 5", &["planetary.load_sharing_factor", "1 to 4"]),
        ("torque_Nm = 600.0", "member = \"ring\"\ntorque_Nm = 600.0", &["operation.member", "which is held"]),
        ("hours = 1.0", "pinion_revolutions = 1.0", &["unknown key operation.pinion_revolutions"]),
        (
            "planet = { teeth = 20, profile_shift = 0.3 }",
            "planet = { teeth = 20 }",
            &["planetary.planet.profile_shift is missing"],
        ),
        ("ring = { teeth = -60", "ring = { teeth = -61", &["planetary.planets", "is no whole number"]),
        ("centre_distance_mm = 60.0", "centre_distance_mm = 59.0", &["planetary.centre_distance_mm", "backlash"]),
        ("[contact]", "[sun_planet.operation]\nhours = 2.0\n[contact]", &["unknown key sun_planet.operation"]),
    ];
    let dir = tempfile::tempdir().unwrap();
    let (scene, out) = (dir.path().join("stage.toml"), dir.path().join("out"));
    for (from, to, said) in cases {
        assert!(STAGE.contains(from));
        fs::write(&scene, STAGE.replace(from, to)).unwrap();
        let run = gearwear().args(["run", "--out"]).arg(&out).arg(&scene).output().unwrap();
        let error = String::from_utf8_lossy(&run.stderr).into_owned();
        assert_eq!(run.status.code(), Some(2), "{to}: {error}");
        assert!(said.iter().all(|said| error.contains(said)), "{to}: {error}");
        assert!(!error.contains("pinion tooth") && !out.exists(), "{to}: {error}");
    }
    fs::write(&scene, format!("{STAGE}[pair]\npreset = \"fzg-c\"\n")).unwrap();
    let both = gearwear().args(["run", "--out"]).arg(&out).arg(&scene).output().unwrap();
    assert!(String::from_utf8_lossy(&both.stderr).contains("one of the two"));
    fs::write(&scene, STAGE).unwrap();
    let pair = gearwear().arg("fem").arg(&scene).arg("--out").arg(&out).output().unwrap();
    let error = String::from_utf8_lossy(&pair.stderr).into_owned();
    assert!(pair.status.code() == Some(2) && error.contains("planetary.mesh is missing"), "{error}");
}
