//! `gearwear rexs`: a run's results in the REXS file that its scene came from, and what is refused.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::program::{gearwear, json};

const UNIT: &str = include_str!("../../src/exchange/rexs/two_stages.rexs");
/// Added to the scene of a stage: a run that is over at once.
const QUICK: &str = "[contact]\nsurface = \"winkler\"\n[stiffness]\nmodel = \"weber-banaschek\"\n[numerics]\nerror_estimate = false\n\
                     verify = false\nflank_points = 100\npositions = 60\nstep = { revolutions = 4e6 }\n";

struct Folder(tempfile::TempDir);

impl Folder {
    /// With the file, and the folder of a run of its first stage.
    fn with_run() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        fs::write(folder.path("unit.rexs"), UNIT).unwrap();
        fs::write(folder.path("scene.toml"), format!("{}{QUICK}", folder.scene("unit.rexs"))).unwrap();
        let made = folder.gearwear(&["run", "scene.toml", "--out", "run", "--quiet", "--no-report"]);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn gearwear(&self, arguments: &[&str]) -> Output {
        gearwear().current_dir(self.0.path()).args(arguments).output().unwrap()
    }

    /// The scene of the first stage of a file.
    fn scene(&self, file: &str) -> String {
        let made = self.gearwear(&["init", "--from", file, "--stage", "1"]);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        String::from_utf8(made.stdout).unwrap()
    }

    fn rexs(&self, run: &str, file: &str, stage: &str) -> Output {
        self.gearwear(&["rexs", run, "--into", file, "--stage", stage, "--out", "new.rexs"])
    }

    /// That these are refused with one message that has these parts, and that nothing is written.
    fn refuses(&self, run: &str, file: &str, stage: &str, parts: &[&str]) {
        let output = self.rexs(run, file, stage);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(output.stdout.is_empty() && !self.path("new.rexs").exists());
        assert!(parts.iter().all(|part| said.contains(part)), "{parts:?} in:\n{said}");
        assert_eq!(said.matches('×').count(), 1, "{said}");
    }
}

/// The number of an attribute, wherever it stands first.
fn number(file: &Path, id: &str) -> f64 {
    let text = fs::read_to_string(file).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let found = document.descendants().find(|node| node.attribute("id") == Some(id));
    found.unwrap_or_else(|| panic!("no {id}")).text().unwrap().parse().unwrap()
}

/// What the summary says stands in the new file, which is still the same gear unit; the old one is as it was, and may be the new one.
#[test]
fn results_are_written_into_a_copy_of_the_file() {
    let folder = Folder::with_run();
    let output = folder.rexs("run", "unit.rexs", "1");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.starts_with("FZG & type C (id 10): ") && said.ends_with("file: new.rexs\n"), "{said}");
    assert_eq!(fs::read_to_string(folder.path("unit.rexs")).unwrap(), UNIT);
    assert_eq!(folder.scene("new.rexs"), folder.scene("unit.rexs"));
    let (new, summary) = (folder.path("new.rexs"), json(&folder.path("run/summary.json")));
    for (id, value) in [
        ("custom_gearwear_running_time", &summary["hours"]),
        ("custom_gearwear_hertzian_pressure_at_pitch_point", &summary["phases"][0]["hertz_peak_pressure_MPa"]),
        ("custom_gearwear_greatest_load_mesh_efficiency_new", &summary["lubrication"]["losses"]["efficiency_new"]),
        ("degree_of_tooth_loss_vdi_2736_2014", &summary["lubrication"]["losses"]["loss_factor_ohlendorf"]),
        ("form_factor_vdi_2736_2014", &summary["root_stress"]["pinion"]["vdi_2736"]["form_factor"]),
    ] {
        // Twelve digits are written.
        assert!((number(&new, id) / value.as_f64().unwrap() - 1.0).abs() < 1e-11, "{id}");
    }
    let written = fs::read(&new).unwrap();
    assert!(folder.rexs("run", "new.rexs", "1").status.success());
    assert_eq!(fs::read(&new).unwrap(), written);
}

#[test]
fn what_does_not_go_together_is_refused() {
    let folder = Folder::with_run();
    folder.refuses("run", "unit.rexs", "2", &["unit.rexs: RUN: teeth of the pinion: found 16; allowed: 22", "Second"]);
    folder.refuses("run", "unit.rexs", "3", &["unit.rexs: --stage: found 3; allowed: 1 (FZG & type C"]);
    folder.refuses("run", "none.rexs", "1", &["none.rexs cannot be read"]);
    for (text, parts) in [
        (UNIT.replace(">91.5<", ">92<").into_bytes(), "centre distance in mm: found 91.5; allowed: 92"),
        (UNIT.as_bytes()[..UNIT.len() / 2].to_vec(), "found XML that cannot be read"),
        (UNIT.replace("Wheel 57", "Wheel\u{1}57").into_bytes(), "line 67: found XML that cannot be read"),
        (
            UNIT.replace("name=\"Wheel 57\"", "name=\"a\" name=\"b\"").into_bytes(),
            "line 67: found XML that cannot be read",
        ),
        (
            UNIT.replace("version=\"1.4\"", "version=\"1.3\"").into_bytes(),
            "line 3: version: found \"1.3\"; allowed: 1.4",
        ),
        (b"{\"model\": {}}".to_vec(), "the JSON form of REXS"),
        ([UNIT.as_bytes(), b"\n\xff"].concat(), "found bytes that are not UTF-8"),
    ] {
        fs::write(folder.path("other.rexs"), text).unwrap();
        folder.refuses("run", "other.rexs", "1", &["other.rexs: ", parts]);
    }
    fs::create_dir(folder.path("empty")).unwrap();
    folder.refuses("empty", "unit.rexs", "1", &["RUN: ", "summary.json", "the folder of a finished gearwear run"]);
    let summary = fs::read_to_string(folder.path("run/summary.json")).unwrap();
    let interrupted = summary.replace("\"completed\"", "\"interrupted\"");
    fs::write(folder.path("run/summary.json"), interrupted).unwrap();
    folder.refuses("run", "unit.rexs", "1", &["stopped: found interrupted; allowed: completed or limit-reached"]);
    fs::write(folder.path("run/summary.json"), &summary).unwrap();
    let scene = fs::read_to_string(folder.path("run/scene.toml")).unwrap();
    fs::write(folder.path("run/scene.toml"), scene.replace("hours = 500.0", "hours = 501.0")).unwrap();
    folder.refuses("run", "unit.rexs", "1", &["found a scene with hash"]);
    fs::write(folder.path("run/scene.toml"), scene).unwrap();
    let output = folder.gearwear(&["rexs", "run", "--into", "unit.rexs", "--stage", "1", "--out", "no/new.rexs"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--out: cannot write no/new.rexs"));
}

/// A unit of a sun, a planet and a ring, 17/22/61 teeth: stages 4 and 5.
fn planetary_unit() -> String {
    let gear = |id: u32, kind: &str, teeth: u32, tip_mm: u32| {
        format!(
            "<component id=\"{id}\" type=\"{kind}\">\n<attribute id=\"normal_module\" unit=\"mm\">4</attribute>\n\
             <attribute id=\"face_width\" unit=\"mm\">50</attribute>\n<attribute id=\"number_of_teeth\" unit=\"none\">{teeth}</attribute>\n\
             <attribute id=\"tip_diameter\" unit=\"mm\">{tip_mm}</attribute>\n</component>\n"
        )
    };
    let gears =
        gear(1, "cylindrical_gear", 17, 76) + &gear(2, "cylindrical_gear", 22, 96) + &gear(3, "ring_gear", 61, 237);
    let stage = |id: u32, gears: [u32; 2]| {
        let [one, other] = gears;
        let relation = format!(
            "<relation id=\"{id}\" type=\"stage\"><ref id=\"{id}\" role=\"stage\"/><ref id=\"{one}\" role=\"gear_1\"/><ref id=\"{other}\" role=\"gear_2\"/></relation>\n"
        );
        let distance = "<attribute id=\"center_distance\" unit=\"mm\">78</attribute>";
        (relation, format!("<component id=\"{id}\" type=\"cylindrical_stage\">\n{distance}\n</component>\n"))
    };
    let [(one, with_sun), (other, with_ring)] = [stage(4, [1, 2]), stage(5, [2, 3])];
    format!(
        "<model applicationId=\"by hand\" applicationVersion=\"1\" date=\"2026-01-01T00:00:00+00:00\" version=\"1.4\">\n<relations>\n{one}{other}\
         <relation id=\"6\" type=\"flank\"><ref id=\"2\" role=\"gear\"/><ref id=\"6\" role=\"left\"/></relation>\n\
         <relation id=\"7\" type=\"stage_gear_data\"><ref id=\"4\" role=\"stage\"/><ref id=\"1\" role=\"gear\"/><ref id=\"7\" role=\"stage_gear_data\"/></relation>\n\
         </relations>\n<components>\n{gears}{with_sun}{with_ring}<component id=\"6\" type=\"cylindrical_gear_flank\">\n\
         <attribute id=\"normal_pressure_angle\" unit=\"deg\">20</attribute>\n<attribute id=\"addendum_modification_coefficient\" unit=\"none\">0</attribute>\n</component>\n\
         <component id=\"7\" type=\"stage_gear_data\">\n<attribute id=\"is_driving_gear\" unit=\"none\">true</attribute>\n\
         <attribute id=\"torque\" unit=\"Nm\">100</attribute>\n</component>\n</components>\n</model>\n"
    )
}

/// The folder of a planetary stage gives results at both of its meshes; that of one mesh is of a pair, and a pair's file takes none of a stage.
#[test]
fn the_results_of_a_planetary_stage_stand_at_both_meshes() {
    let folder = Folder(tempfile::tempdir().unwrap());
    fs::write(folder.path("unit.rexs"), planetary_unit()).unwrap();
    let quick = "[contact]\nsurface = \"hertz-mean\"\n[stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n[numerics]\n\
                 error_estimate = false\nverify = false\nflank_points = 60\npositions = 40\n";
    fs::write(folder.path("stage.toml"), format!("{}{quick}", folder.scene("unit.rexs"))).unwrap();
    let made = folder.gearwear(&["run", "stage.toml", "--out", "run", "--quiet", "--no-report"]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let output = folder.rexs("run", "unit.rexs", "1");
    assert!(output.status.success() && output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(folder.scene("new.rexs"), folder.scene("unit.rexs"));
    let text = fs::read_to_string(folder.path("new.rexs")).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let depths =
        document.descendants().filter(|node| node.attribute("id") == Some("custom_gearwear_maximum_wear_depth"));
    let mut depths: Vec<f64> = depths.map(|node| node.text().unwrap().parse().unwrap()).collect();
    let summary = json(&folder.path("run/summary.json"));
    let of = |path: &str| summary.pointer(path).and_then(|of| of["peak_wear_um"].as_f64()).unwrap();
    let mut expected = ["/sun", "/planet/sun_flank", "/planet/ring_flank", "/ring"].map(of);
    depths.sort_by(f64::total_cmp);
    expected.sort_by(f64::total_cmp);
    assert_eq!(depths.len(), 4);
    for (found, expected) in depths.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} and {expected}");
    }
    fs::remove_file(folder.path("new.rexs")).unwrap();
    fs::write(folder.path("pair.rexs"), UNIT).unwrap();
    folder.refuses("run", "pair.rexs", "1", &["found that of a planetary stage", "whose gears meet no ring"]);
    folder.refuses("run/planet-ring", "unit.rexs", "1", &["teeth of the pinion: found 22; allowed: 17"]);
}
