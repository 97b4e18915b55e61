//! `gearwear run` from the outside: what it writes, that it repeats itself to the bit, and how it stops.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::program::{exchanged, gearwear};

const FILES: [&str; 11] = [
    "summary.json",
    "columns.json",
    "pinion.csv",
    "wheel.csv",
    "history.csv",
    "profiles.csv",
    "mesh_cycle.csv",
    "flank.vtu",
    "record.bin",
    "scene.toml",
    "report.html",
];

fn run(dir: &Path, text: &str, out: &str, more: &[&str]) -> Value {
    let file = dir.join("scene.toml");
    fs::write(&file, text).unwrap();
    let output = gearwear().arg("run").arg(&file).arg("--out").arg(dir.join(out)).args(more).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    summary(&dir.join(out))
}

fn summary(out: &Path) -> Value {
    serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap()
}

/// A quick scene: fewer points, positions and steps, and no life on finite elements beside it.
fn quick() -> String {
    exchanged_text(&quick_and_verified(), "[numerics]\n", "[numerics]\nverify = false\n")
}

fn exchanged_text(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

/// The same, verified on few finite elements.
fn quick_and_verified() -> String {
    exchanged(
        "thesis-spur",
        &[
            ("flank_points = 750 ", "flank_points = 200 "),
            ("positions = 400 ", "positions = 100 "),
            ("step = { revolutions = 7665.0 }", "step = { revolutions = 50000.0 }"),
            ("[wear]", "[fem]\nbody = \"sector\"\nsector_teeth = 3\nelements_per_half_width = 3\n[wear]"),
        ],
    )
}

#[test]
fn a_run_without_report_leaves_the_data_alone() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), &quick(), "out", &[]);
    let page = dir.path().join("out/report.html");
    // The bound that the page of a spur run was made for: small enough to be sent by mail.
    let size = fs::metadata(&page).unwrap().len();
    assert!(size < 1_500_000, "report.html has {size} bytes");
    assert!(page.exists());
    // The same folder again: the page of the run before would pass for one of this.
    run(dir.path(), &quick(), "out", &["--no-report"]);
    assert!(!page.exists());
    for file in FILES.iter().filter(|file| **file != "report.html") {
        assert!(dir.path().join("out").join(file).metadata().unwrap().len() > 0, "{file}");
    }
}

/// The plots of the page as drawings and pictures, and the tables as a workbook.
#[test]
fn figures_and_workbook_are_written_where_asked_for() {
    let dir = tempfile::tempdir().unwrap();
    let figures = dir.path().join("plots/new");
    run(dir.path(), &quick(), "out", &["--workbook", "--figures", figures.to_str().unwrap()]);
    let page = fs::read_to_string(dir.path().join("out/report.html")).unwrap();
    let plots: Vec<&str> =
        page.split("<div class=\"plot\" id=\"").skip(1).map(|at| at.split('"').next().unwrap()).collect();
    assert!(plots.contains(&"wear-pinion"), "{plots:?}");
    for plot in &plots {
        let svg = fs::read_to_string(figures.join(format!("{plot}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("var("), "{plot}");
        assert!(fs::read(figures.join(format!("{plot}.png"))).unwrap().starts_with(b"\x89PNG"), "{plot}");
    }
    assert_eq!(fs::read_dir(&figures).unwrap().count(), 2 * plots.len());
    let workbook = dir.path().join("out/results.xlsx");
    assert!(fs::read(&workbook).unwrap().starts_with(b"PK"));
    // The same folder again: the workbook of the run before would pass for one of this.
    run(dir.path(), &quick(), "out", &[]);
    assert!(!workbook.exists());
}

/// Both flanks in space at the beginning and at every snapshot, listed with their times.
#[test]
fn a_series_has_a_file_for_every_snapshot() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), &quick(), "out", &["--series"]);
    let out = dir.path().join("out");
    let list = fs::read_to_string(out.join("flank.pvd")).unwrap();
    let hours: Vec<f64> = csv::Reader::from_path(out.join("history.csv"))
        .unwrap()
        .deserialize()
        .map(|row: Result<std::collections::BTreeMap<String, String>, _>| row.unwrap()["hours"].parse().unwrap())
        .collect();
    assert_eq!(list.matches("<DataSet").count(), hours.len() + 1);
    for (moment, hours) in [0.0].into_iter().chain(hours).enumerate() {
        let file = format!("flank_{moment:03}.vtu");
        assert!(list.contains(&format!("timestep=\"{hours}\" group=\"\" part=\"0\" file=\"{file}\"")), "{list}");
        let vtk = vtkio::Vtk::parse_xml(fs::read(out.join(&file)).unwrap().as_slice()).expect("vtkio reads it");
        let vtkio::model::DataSet::UnstructuredGrid { pieces, .. } = vtk.data else {
            panic!("not an unstructured grid")
        };
        let piece = pieces[0].load_piece_data(None).unwrap();
        let wear = piece.data.point.iter().find_map(|attribute| match attribute {
            vtkio::model::Attribute::DataArray(array) if array.name == "wear_um" => {
                array.data.clone().cast_into::<f64>()
            }
            _ => None,
        });
        assert_eq!(wear.unwrap().iter().any(|&wear| wear > 0.0), moment > 0, "{file}");
    }
    // The same folder again: the series of the run before would pass for one of this.
    run(dir.path(), &quick(), "out", &[]);
    assert!(!out.join("flank.pvd").exists() && !out.join("flank_000.vtu").exists());
}

#[test]
fn figures_that_cannot_be_written_are_refused_before_the_run() {
    let dir = tempfile::tempdir().unwrap();
    let (scene, file) = (dir.path().join("scene.toml"), dir.path().join("file"));
    fs::write(&scene, quick()).unwrap();
    fs::write(&file, "").unwrap();
    let out = dir.path().join("out");
    let output = gearwear().arg("run").arg(&scene).arg("--out").arg(&out).arg("--figures").arg(&file).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stderr).contains("is not a folder") && !out.exists());
}

#[test]
fn the_preset_runs_and_writes_everything_the_contract_names() {
    let dir = tempfile::tempdir().unwrap();
    let summary = run(dir.path(), &exchanged("thesis-spur", &[]), "out", &[]);
    for file in FILES {
        assert!(dir.path().join("out").join(file).metadata().unwrap().len() > 0, "{file}");
    }
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}"));
    assert!((number("/geometry/transverse_contact_ratio") - 1.4375).abs() < 1e-4);
    assert!((number("/geometry/pitch_point_index") - 280.8).abs() < 0.05);
    assert!((number("/contact/hertz_peak_pressure_MPa") / 1656.0 - 1.0).abs() < 1e-3);
    assert!((number("/contact/line_load_N_per_mm") - 637.66).abs() < 0.01);
    assert!((number("/pinion/peak_wear_um") / 7.3 - 1.0).abs() < 0.05);
    assert!((number("/pinion/worn_mass_mg") / number("/wheel/worn_mass_mg") - 1.0).abs() < 1e-3);
    assert!(number("/error/discretisation") < 5e-3 && number("/error/wear_step") < 5e-3);
    // With contact from A to E alone the thesis's model misses what finite elements find at the tip edges' mates.
    assert!((0.1..0.4).contains(&number("/error/surface_model")), "{}", number("/error/surface_model"));
    assert!(number("/error/total/profile/pinion") > 0.1 && number("/error/companions_cost") <= 0.5);
    assert!(number("/wear_balance/new") < 3e-3 && number("/wear_balance/worn") < 3e-3);
    assert_eq!(summary["stopped"], "completed");
    let names = |list: &Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|stage| stage["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(
        names(&summary["stages"]),
        [
            "geometry",
            "finite-element-model",
            "contact-match",
            "step-bound",
            "simulation",
            "error-estimates",
            "verification",
            "report"
        ]
    );
    assert!(names(&summary["left_out"]).contains(&"helical-slices".to_owned()));

    // Rows: points 0 to 750, positions, snapshots.
    let rows = |file: &str| {
        let text = fs::read_to_string(dir.path().join("out").join(file)).unwrap();
        text.lines().count() - 1
    };
    assert_eq!(
        [rows("pinion.csv"), rows("wheel.csv"), rows("mesh_cycle.csv"), rows("history.csv")],
        [751, 751, 400, 9]
    );
    assert_eq!(rows("profiles.csv"), 9 * 2 * 751);
}

/// `run` does exactly what `plan` says.
#[test]
fn the_stages_run_are_those_planned() {
    let dir = tempfile::tempdir().unwrap();
    let edits =
        [("surface = \"winkler\"", "surface = \"hertz\""), ("model = \"constant\"", "model = \"weber-banaschek\"")];
    let mut text = quick_and_verified();
    for (from, to) in edits {
        text = text.replace(from, to);
    }
    let text = text.replace("error_estimate = true", "error_estimate = false").replace("match = ", "# match = ");
    let text = text.replace("pair_N_per_mm_um = 20.0", "# pair_N_per_mm_um = 20.0");
    let summary = run(dir.path(), &text, "out", &[]);
    let output = gearwear().arg("plan").arg(dir.path().join("scene.toml")).args(["--format", "json"]).output().unwrap();
    let plan: Value = serde_json::from_slice(&output.stdout).unwrap();
    for list in ["stages", "left_out"] {
        let names = |value: &Value| -> Vec<Value> {
            value[list].as_array().unwrap().iter().map(|stage| stage["name"].clone()).collect()
        };
        assert_eq!(names(&summary), names(&plan), "{list}");
    }
    assert_eq!(summary["contact"]["foundation_MPa_per_mm"], Value::Null);
    assert_eq!(summary["error"]["discretisation"], Value::Null);
}

/// The resolved scene gives the same results to the bit, on any number of threads.
#[test]
fn the_resolved_scene_repeats_the_run_to_the_bit() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), &quick_and_verified(), "first", &["--threads", "1"]);
    let resolved = fs::read_to_string(dir.path().join("first/scene.toml")).unwrap();
    run(dir.path(), &resolved, "second", &["--threads", "2"]);
    for file in FILES.iter().filter(|file| file.ends_with(".csv") || **file == "scene.toml") {
        let read = |out: &str| fs::read(dir.path().join(out).join(file)).unwrap();
        assert!(read("first") == read("second"), "{file}");
    }
}

#[test]
fn a_step_too_long_for_euler_is_warned_of_with_the_longest_safe_one() {
    let dir = tempfile::tempdir().unwrap();
    let text = quick().replace("coefficient_m2_per_N = 1e-17", "coefficient_m2_per_N = 2e-16");
    let summary = run(dir.path(), &text, "out", &[]);
    let warnings = summary["warnings"].to_string();
    assert!(warnings.contains("longest stable step"), "{warnings}");
}

/// A foundation so soft that nothing of the pair's stiffness is left for the teeth is a mistake in the scene.
#[test]
fn a_surface_softer_than_the_pair_ends_with_status_2() {
    let dir = tempfile::tempdir().unwrap();
    let text = quick()
        .replace("match = \"half-width\"", "foundation_MPa_per_mm = 1000.0")
        .replace("model = \"constant\"", "model = \"iso6336\"")
        .replace("pair_N_per_mm_um = 20.0", "# pair_N_per_mm_um = 20.0");
    let file = dir.path().join("scene.toml");
    fs::write(&file, text).unwrap();
    let output = gearwear().arg("run").arg(&file).arg("--out").arg(dir.path().join("out")).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!dir.path().join("out/summary.json").exists());
}

/// Ctrl-C: stops within a second, keeps the snapshots reached, says so, and ends with status 130.
#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_finished() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("scene.toml");
    // A million steps: minutes of work, with an early snapshot.
    let text = exchanged(
        "thesis-spur",
        &[
            ("step = { revolutions = 7665.0 }", "step = { revolutions = 1.0 }"),
            (
                "snapshots_h = [0.25, 0.75, 1.75, 3.75, 7.75, 15.75, 31.75, 63.75, 127.75]",
                "snapshots_h = [0.001, 127.75]",
            ),
        ],
    );
    fs::write(&file, text).unwrap();
    let out = dir.path().join("out");
    let mut child = gearwear()
        .arg("run")
        .arg(&file)
        .arg("--out")
        .arg(&out)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(2500));
    let asked = Instant::now();
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let status = child.wait().unwrap();
    // A second is what the user is promised; a loaded test machine gets some more.
    assert!(asked.elapsed() < Duration::from_secs(3), "{:?}", asked.elapsed());
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    assert_eq!(status.code(), Some(130), "{said}");
    assert!(said.contains("interrupted at") && said.contains("1 of 2 snapshots"), "{said}");
    let summary = summary(&out);
    assert_eq!(summary["stopped"], "interrupted");
    let reached = summary["revolutions"].as_f64().unwrap();
    assert!(reached > 9.0 && reached < 1_149_750.0, "{reached}");
    // The header, the snapshot reached, and the state at the interrupt.
    let history = fs::read_to_string(out.join("history.csv")).unwrap();
    assert_eq!(history.lines().count(), 3);
}

/// A run whose wear grows beyond all numbers ends with status 3, says where, and keeps the snapshots before that; what
/// an earlier run left in the folder does not pass for its result.
#[test]
fn a_run_that_fails_keeps_what_is_finished() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), &quick(), "out", &[]);
    let text = quick()
        .replace("coefficient_m2_per_N = 1e-17", "coefficient_m2_per_N = 1e-10")
        .replace("step = { revolutions = 50000.0 }", "step = { revolutions = 1.1e9 }")
        .replace("hours = 127.75 ", "pinion_revolutions = 1e12 #")
        .replace("snapshots_h = ", "snapshots_revolutions = [1.0] # ");
    let file = dir.path().join("scene.toml");
    fs::write(&file, text).unwrap();
    let output = gearwear().arg("run").arg(&file).arg("--out").arg(dir.path().join("out")).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("worn through after") && said.contains("mm thick there"), "{said}");
    let summary = summary(&dir.path().join("out"));
    assert_eq!(summary["stopped"], "worn-through");
    assert!(summary["revolutions"].as_f64().unwrap() >= 1.0, "{said}");
}

/// Who reports, and when, is shown, and no figure depends on it.
#[test]
fn who_reports_is_shown() {
    let dir = tempfile::tempdir().unwrap();
    let plain = run(dir.path(), &quick(), "plain", &[]);
    let text =
        format!("{}\n[report]\nauthor = \"A. <b>Tester</b>\"\ncompany = \"Works\"\ndate = \"2026-11-24\"\n", quick());
    let named = run(dir.path(), &text, "named", &["--workbook"]);
    assert_eq!((&named["report"]["company"], &plain["report"]), (&Value::from("Works"), &Value::Null));
    assert_eq!(named["pinion"], plain["pinion"]);
    let page = fs::read_to_string(dir.path().join("named/report.html")).unwrap();
    assert!(page.contains("A. &lt;b&gt;Tester&lt;/b&gt; · Works · 2026-11-24"));
}

/// Nobody listening is no reason to panic.
#[cfg(unix)]
#[test]
fn a_closed_or_full_standard_error_is_no_panic() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("scene.toml");
    fs::write(&file, quick().replace("teeth = 16", "teeth = 3")).unwrap();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let status = gearwear().arg("run").arg(&file).arg("--out").arg(dir.path().join("out")).stderr(full).status();
    assert_eq!(status.unwrap().code(), Some(2));
}

/// A face of 0.01 mm under the whole torque bends so far that positions past the tips of both gears are asked, where flanks do not face each
/// other: the run ends with what is wrong, and not with a panic.
#[test]
fn loads_that_no_tooth_carries_end_with_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let text = "[pair]\npreset = \"h501\"\nface_width_mm = 0.01\n[operation]\npinion_torque_Nm = 302.0\npinion_revolutions = 6e5\n[contact]\n\
                surface = \"half-space\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-11\n[helical]\nslices = 20\n\
                [numerics]\nflank_points = 120\npositions = 40\nerror_estimate = false\nverify = false\n";
    fs::write(&scene, text).unwrap();
    let output =
        gearwear().args(["run", "--quiet"]).arg(&scene).arg("--out").arg(folder.path().join("out")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(3) && said.contains("worn through"), "{:?} {said}", output.status);
}
