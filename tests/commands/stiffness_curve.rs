//! A scene with a stiffness curve beside it.

use std::fs;

use crate::program::{gearwear, json, preset};

/// The program runs a scene with a curve beside it, and refuses one it cannot read: exit status 2, nothing left behind.
#[test]
fn the_program_reads_the_curve_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let preset = preset("thesis-spur");
    let scene: String = preset
        .lines()
        .map(|line| match line.split('=').next().unwrap().trim() {
            "pair_N_per_mm_um" => "curve = \"teeth.csv\"\n".to_owned(),
            "model" => "model = \"simon\"\n".to_owned(),
            "positions" => "positions = 40\n".to_owned(),
            "step" => "step = { revolutions = 200000 }\n".to_owned(),
            "error_estimate" => "error_estimate = false\nverify = false\n".to_owned(),
            _ => format!("{line}\n"),
        })
        .collect();
    assert!(scene.contains("teeth.csv") && scene.contains("simon"), "{scene}");
    let (path, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    fs::write(&path, scene).unwrap();
    let run = || {
        let output = gearwear().args(["run", "--quiet", "--out"]).arg(&out).arg(&path).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (status, message) = run();
    assert_eq!(status, Some(2), "{message}");
    assert!(message.contains("stiffness.curve") && message.contains("cannot be read"), "{message}");

    let curve = folder.path().join("teeth.csv");
    fs::write(&curve, "# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4,10\n14,x\n23.6,11\n").unwrap();
    let (status, message) = run();
    assert_eq!(status, Some(2), "{message}");
    assert!(message.contains("teeth.csv") && message.contains("line 4") && message.contains("found x"), "{message}");
    assert!(!out.exists());

    let pair_at_pitch = |stiffness: [f64; 3]| {
        let [a, b, c] = stiffness;
        let text = format!("# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4,{a}\n14,{b}\n23.6,{c}\n");
        fs::write(&curve, text).unwrap();
        let (status, message) = run();
        assert_eq!(status, Some(0), "{message}");
        let summary = json(&out.join("summary.json"));
        fs::remove_dir_all(&out).unwrap();
        assert_eq!(summary["stiffness"]["model"], "simon");
        summary["stiffness"]["pair_at_pitch_N_per_mm_um"].as_f64().unwrap()
    };
    // C at 13.9701, between 4.4 and 14: the compliance is a straight line from 1/10 to 1/20, to which the flattening adds whatever
    // the teeth do; half of it is the difference to teeth twice as stiff.
    let teeth = 0.1 + (13.9701 - 4.4) / 9.6 * (0.05 - 0.1);
    let half = 1.0 / pair_at_pitch([10.0, 20.0, 11.0]) - 1.0 / pair_at_pitch([20.0, 40.0, 22.0]);
    assert!((half / (0.5 * teeth) - 1.0).abs() < 1e-5, "{half} of {teeth}");
}
