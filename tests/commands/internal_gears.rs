//! Pairs with an internal wheel, from the outside: two spellings of one pair, finite elements, default tips, and what is refused.

use std::fs;
use std::path::Path;

use assert_cmd::Command;

/// A planet in its ring with positive numbers.
const SCENE: &str = r#"
[pair]
normal_module_mm = 3.0
pressure_angle_deg = 20.0
centre_distance_mm = 60.0
face_width_mm = 20.0
[pair.pinion]
teeth = 20
profile_shift = 0.3
[pair.wheel]
teeth = 60
internal = true
profile_shift = -0.3
tip_diameter_mm = 176.2
cutter = { teeth = 25 }
[operation]
pinion_torque_Nm = 150.0
pinion_revolutions = 1e4
[contact]
surface = "hertz"
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
[numerics]
error_estimate = false
verify = false
"#;

/// The scene with lines exchanged: from and to, one after the other.
fn with(lines: &[(&str, &str)]) -> String {
    lines.iter().fold(SCENE.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "no {from}");
        text.replace(from, to)
    })
}

/// DIN 3960: everything negative but the shift, which has its sign.
const NEGATIVE: [(&str, &str); 4] = [
    ("centre_distance_mm = 60.0", "centre_distance_mm = -60.0"),
    ("teeth = 60", "teeth = -60"),
    ("internal = true\n", ""),
    ("tip_diameter_mm = 176.2", "tip_diameter_mm = -176.2"),
];

fn run(text: &str, folder: &Path) -> std::process::Output {
    fs::create_dir_all(folder).unwrap();
    let scene = folder.join("scene.toml");
    fs::write(&scene, text).unwrap();
    let mut command = Command::cargo_bin("gearwear").unwrap();
    command.args(["run", "--quiet", "--out"]).arg(folder.join("out")).arg(&scene).output().unwrap()
}

/// Positive numbers with `internal`, negative ones (DIN 3960), and a negative number of teeth alone (ISO 21771) give the same bytes.
#[test]
fn all_spellings_give_the_same_files() {
    let folder = tempfile::tempdir().unwrap();
    let spellings = [SCENE.to_owned(), with(&NEGATIVE), with(&NEGATIVE[1..3])];
    let folders: Vec<_> = (0..).map(|k| folder.path().join(format!("{k}"))).take(spellings.len()).collect();
    for (text, folder) in spellings.iter().zip(&folders) {
        let output = run(text, folder);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    }
    for name in ["scene.toml", "pinion.csv", "wheel.csv", "mesh_cycle.csv", "history.csv", "profiles.csv", "flank.vtu"]
    {
        let [first, others @ ..] = &folders[..] else { panic!("three folders") };
        let first = fs::read(first.join("out").join(name)).unwrap();
        for other in others {
            assert!(first == fs::read(other.join("out").join(name)).unwrap(), "{name}");
        }
    }
    // Diameters in results are those of a drawing.
    let summary = fs::read_to_string(folders[1].join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["geometry"]["gears"]["wheel"]["tip_diameter_mm"], 176.2);
    assert!(summary["error"]["total"]["peak_wear"]["pinion"].is_null());
}

/// Lines exchanged, and parts of the message.
type Refused<'a> = (&'a [(&'a str, &'a str)], &'a [&'a str]);

/// What an internal pair cannot be, or the model does not have of it, each with key, figure and remedy.
#[test]
fn what_is_refused() {
    let tip = "tip_diameter_mm = 176.2";
    // By hand: cos α_a2 = 169.1447/174, α_a2 = 13.566°, 1 − tan α_a2/tan 20° = 0.3370.
    let cases: &[Refused<'_>] = &[
        (
            &[("teeth = 60", "teeth = -60"), (tip, "tip_diameter_mm = -176.2")],
            &["pair.wheel.tip_diameter_mm", "a positive number"],
        ),
        (&[("teeth = 60\ninternal = true", "teeth = -60\ninternal = false")], &["pair.wheel.internal", "true"]),
        (&[("teeth = 60\ninternal = true", "teeth = 60")], &["pair.wheel.cutter", "external teeth"]),
        (&[("teeth = 20", "teeth = -20")], &["pair.pinion.teeth", "found -20", "which is the wheel of a pair"]),
        (&[("teeth = 20\n", "teeth = 20\ninternal = true\n")], &["pair.pinion.internal", "is the wheel"]),
        (&[("cutter = {", "root_diameter_mm = 189.0\ncutter = {")], &["pair.wheel.cutter", "one of the two"]),
        (
            &[
                ("centre_distance_mm = 60.0", "centre_distance_mm = 72.0"),
                ("teeth = 20\nprofile_shift = 0.3", "teeth = 12\nprofile_shift = 0.0"),
                (
                    "profile_shift = -0.3\ntip_diameter_mm = 176.2\ncutter = { teeth = 25 }",
                    "profile_shift = 0.0\ntip_diameter_mm = 174.0",
                ),
            ],
            &["involute interference", "z1/z2 = 0.2000 is less than 1 − tan α_a2/tan α_wt = 0.3370", "at least"],
        ),
        (&[(tip, "tip_diameter_mm = 169.0")], &["base circle", "at least 169.14"]),
        (&[("centre_distance_mm = 60.0", "centre_distance_mm = 61.0")], &["the teeth interfere", "at most 60"]),
        (&[("teeth = 25", "teeth = 60")], &["pair.wheel.cutter.teeth", "at most 59"]),
        (
            &[("[wear]", "[fem]\nclamp_radius_mm = { wheel = 100.0 }\n[wear]")],
            &["fem.clamp_radius_mm.wheel", "pair.wheel.rim_thickness_mm says"],
        ),
        (
            &[("[wear]", "[fem]\nweb.wheel = { thickness_mm = 5.0, rim_thickness_mm = 6.0 }\n[wear]")],
            &["fem.web.wheel", "pair.wheel.rim_thickness_mm says"],
        ),
        (
            &[("internal = true", "internal = true\nrim_thickness_mm = 0.2")],
            &["pair.wheel.rim_thickness_mm: found 0.2", "at least 0.3000 mm, a tenth of a module"],
        ),
        (
            &[("teeth = 20\n", "teeth = 20\nrim_thickness_mm = 6.0\n")],
            &["pair.pinion.rim_thickness_mm: found given for external teeth", "fem.clamp_radius_mm"],
        ),
        (
            &[("internal = true", "internal = true\nrim_pins = { count = 1 }")],
            &["pair.wheel.rim_pins.count", "found 1"],
        ),
        (
            &[("internal = true", "internal = true\nrim_pins = { count = 31 }")],
            &["pair.wheel.rim_pins.count: found 31", "2 to 30, half the number of teeth"],
        ),
        (
            &[
                ("internal = true", "internal = true\nrim_pins = { count = 6 }"),
                ("[wear]", "[fem]\nbody = \"sector\"\n[wear]"),
            ],
            &["fem.body", "pins hold a whole ring"],
        ),
        (
            &[
                ("internal = true", "internal = true\nrim_pins = { count = 6 }"),
                ("pressure_angle_deg", "helix_angle_deg = 5.0\npressure_angle_deg"),
            ],
            &[
                "pair.wheel.rim_pins: found given for a pair whose sections differ",
                "pins hold the plane ring of spur pairs",
            ],
        ),
        (
            &[("teeth = 20\n", "teeth = 20\nrim_pins = { count = 6 }\n")],
            &["pair.pinion.rim_pins: found given for external teeth"],
        ),
        (
            &[("[wear]", "[stiffness]\nmodel = \"simon\"\ncurve = \"a.csv\"\n[wear]")],
            &["stiffness.model", "the other models hold for external teeth"],
        ),
    ];
    for (lines, parts) in cases {
        let folder = tempfile::tempdir().unwrap();
        let output = run(&with(lines), folder.path());
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{lines:?}: {message}");
        assert!(!folder.path().join("out").exists());
        for part in *parts {
            assert!(message.contains(part), "no {part:?} in:\n{message}");
        }
    }
}

/// Finite elements of internal gears are made by every command that makes them, and their calibration is read.
#[test]
fn commands_on_finite_elements_know_rings() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, with(&[("profile_shift = 0.3", "profile_shift = 0.3\ntip_rounding_mm = 0.1")])).unwrap();
    let command = |arguments: &[&str], target: &str| {
        let target = folder.path().join(target);
        let mut command = Command::cargo_bin("gearwear").unwrap();
        let output = command.args(arguments).arg(&scene).arg("--out").arg(&target).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap(), target)
    };
    for (arguments, target) in [
        (&["mesh"][..], "pair.msh"),
        (&["mesh", "--three-dimensional"], "space.vtu"),
        (&["fem", "--position", "11.5", "--full"], "fem"),
        (&["calibrate"], "calibration.json"),
    ] {
        let (status, message, target) = command(arguments, target);
        assert_eq!(status, Some(0), "{arguments:?}: {message}");
        assert!(target.exists());
    }

    let calibrated = [
        ("profile_shift = 0.3", "profile_shift = 0.3\ntip_rounding_mm = 0.1"),
        ("surface = \"hertz\"", "calibration = \"calibration.json\""),
    ];
    let output = run(&with(&calibrated), folder.path());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    // Another rim is another body.
    let other = [&calibrated[..], &[("internal = true", "internal = true\nrim_thickness_mm = 6.0")]].concat();
    let message = String::from_utf8(run(&with(&other), folder.path()).stderr).unwrap();
    assert!(message.contains("pair.wheel.rim_thickness_mm: calibration 10.5, scene 6"), "{message}");
}

/// A ring on pins yields more than one held all round; the resolved scene says where the tooth is.
#[test]
fn a_ring_on_pins_yields() {
    let rounded = ("profile_shift = 0.3", "profile_shift = 0.3\ntip_rounding_mm = 0.1");
    let default_surface = ("surface = \"hertz\"", "");
    let errors_um = ["", "\nrim_pins = { count = 6, tooth = \"at-pin\" }", "\nrim_pins = { count = 6 }"].map(|pins| {
        let folder = tempfile::tempdir().unwrap();
        let wheel = format!("internal = true\ntip_rounding_mm = 0.1{pins}");
        let output = run(&with(&[rounded, ("internal = true", &wheel), default_surface]), folder.path());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let scene = fs::read_to_string(folder.path().join("out/scene.toml")).unwrap();
        assert_eq!(scene.contains("tooth = \"between-pins\""), pins.ends_with("count = 6 }"), "{scene}");
        let summary = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        summary["new"]["transmission_error_um"]["max"].as_f64().unwrap()
    });
    let [all_round_um, on_pins_um @ ..] = errors_um;
    assert!(on_pins_um.into_iter().all(|on_pins_um| on_pins_um > 1.5 * all_round_um), "{errors_um:?}");
}

/// Runs on finite elements, the default, and on half-planes are verified.
#[test]
fn runs_are_verified() {
    let rounded = ("profile_shift = 0.3", "profile_shift = 0.3\ntip_rounding_mm = 0.1");
    let rounded_ring = ("internal = true", "internal = true\ntip_rounding_mm = 0.1");
    let verify = ("verify = false", "verify = true");
    let worn_in = ("pinion_revolutions = 1e4", "pinion_revolutions = 1e6");
    for surface in ["", "surface = \"half-space\""] {
        let folder = tempfile::tempdir().unwrap();
        let output =
            run(&with(&[rounded, rounded_ring, verify, worn_in, ("surface = \"hertz\"", surface)]), folder.path());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let summary = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        for gear in ["pinion", "wheel"] {
            let claimed = summary["error"]["total"]["profile"][gear].as_f64().expect("a run that is verified");
            assert!(claimed < 0.1, "{surface} {gear}: {claimed}");
        }
        // Of worn internal pairs more than the 1 % of external ones (case verified-internal-pairs).
        let total = &summary["error"]["total"];
        let how = total["how"].as_str().unwrap();
        assert!(how.contains("of the flank pressure 1 % new and 1.5 % worn"), "{how}");
        assert!(total["flank_pressure"]["worn"].as_f64().unwrap() >= 0.015, "{total}");
        let scene = fs::read_to_string(folder.path().join("out/scene.toml")).unwrap();
        assert!(scene.contains("rim_thickness_mm = 10.5"), "{scene}");
    }
}

/// A default tip of a ring that would interfere is shortened to the diameter that a given one is refused below, with a note; the scene says it.
#[test]
fn default_tips_are_shortened() {
    let folder = tempfile::tempdir().unwrap();
    let small = [
        ("centre_distance_mm = 60.0", "centre_distance_mm = 72.0"),
        ("teeth = 20\nprofile_shift = 0.3", "teeth = 12\nprofile_shift = 0.0"),
        ("profile_shift = -0.3\ntip_diameter_mm = 176.2\ncutter = { teeth = 25 }", "profile_shift = 0.0"),
    ];
    let output = run(&with(&small), folder.path());
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{message}");
    // By hand: d_b2 = 169.1447, 2 T1T2 = 144 sin 20° = 49.2509; √(169.1447² + 49.2509²) = 176.16916, to the last digit outwards.
    assert!(message.contains("176.1692 mm instead of the rack's 174.0000 mm"), "{message}");
    let scene = fs::read_to_string(folder.path().join("out/scene.toml")).unwrap();
    assert!(scene.contains("tip_diameter_mm = 176.1692"), "{scene}");
}
