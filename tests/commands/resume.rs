//! Runs that are killed and go on: the same bits as without a break, and refusals of what would not be.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::program::gearwear;

const TABLES: [&str; 5] = ["pinion.csv", "wheel.csv", "history.csv", "profiles.csv", "mesh_cycle.csv"];

/// Slow mild wear of the preset pair on a coarse grid, with some lines more in `[contact]`, `[numerics]` and at the end.
fn scene(contact: &str, numerics: &str, more: &str) -> String {
    format!(
        "[pair]\npreset = \"thesis-spur\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\nhours = 128.0\n\
         [contact]\n{contact}\n[stiffness]\nmodel = \"weber-banaschek\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 2e-17\n\
         [numerics]\nerror_estimate = false\nverify = false\n{numerics}\n{more}\n"
    )
}

/// `[numerics]` of a run that is over at once.
const QUICK: &str = "flank_points = 100\npositions = 40\nstep = { revolutions = 7680.0 }";

/// So long that it is killed many times: a clean start every 300 evaluations on half-planes.
fn half_space(step: &str) -> String {
    scene("surface = \"half-space\"\ntip_contact = false", &format!("flank_points = 120\npositions = 24\n{step}"), "")
}

/// A clean start every 75 evaluations on finite elements.
fn finite_elements(step: &str) -> String {
    scene(
        "surface = \"fem\"",
        &format!("flank_points = 120\npositions = 24\n{step}"),
        "[fem]\nbody = \"sector\"\nsector_teeth = 5\nelements_per_half_width = 3",
    )
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, text).unwrap();
        path
    }
}

fn run(args: &[&dyn AsRef<std::ffi::OsStr>]) -> Output {
    gearwear().arg("run").args(args.iter().map(|arg| arg.as_ref())).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What may differ between a run and the same run with breaks: wall times only.
fn without_times(out: &Path) -> Value {
    let mut summary: Value = serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap();
    summary["wall_s"] = Value::Null;
    for stage in summary["stages"].as_array_mut().unwrap() {
        stage["wall_s"] = Value::Null;
    }
    summary
}

fn assert_same_results(one: &Path, other: &Path) {
    for table in TABLES.into_iter().chain(["scene.toml"]) {
        assert!(fs::read(one.join(table)).unwrap() == fs::read(other.join(table)).unwrap(), "{table}");
    }
    assert_eq!(without_times(one), without_times(other));
}

/// Starts a run with `args` and kills it after `milliseconds`; says whether it had ended before.
fn killed_after(milliseconds: u64, args: &[&dyn AsRef<std::ffi::OsStr>]) -> bool {
    let mut command = gearwear();
    command.arg("run").args(args.iter().map(|arg| arg.as_ref())).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    std::thread::sleep(Duration::from_millis(milliseconds));
    let ended = child.try_wait().unwrap().is_some();
    // SIGKILL.
    child.kill().unwrap();
    child.wait().unwrap();
    ended
}

/// Runs `scene` without a break, and again with so many kills, or more, at pseudo-random moments, resumed on one and two threads by turns. Returns after
/// how many kills there was a checkpoint to go on from.
fn survives(kills: u64, scene: &str) -> u64 {
    let folder = Folder::new();
    let file = folder.write("scene.toml", scene);
    let (whole, broken) = (folder.path("whole"), folder.path("broken"));
    let begin = Instant::now();
    let output = run(&[&file, &"--out", &whole, &"--threads", &"2"]);
    assert!(output.status.success(), "{}", said(&output));
    let takes_ms = begin.elapsed().as_millis() as u64;

    let mut random = 12345_u64;
    let (mut found, mut ended) = (0, true);
    for kill in 0..MOST_TIMES * kills {
        if kill >= kills && found >= LEAST_FOUND {
            break;
        }
        // Knuth's MMIX generator; its high bits.
        random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let moment = (random >> 33) % takes_ms.max(1);
        ended = if ended {
            killed_after(moment, &[&file, &"--out", &broken, &"--quiet"])
        } else {
            let threads = if kill % 2 == 0 { "1" } else { "2" };
            killed_after(moment, &[&"--resume", &broken, &"--threads", &threads])
        };
        found += u64::from(broken.join("checkpoint.bin").exists());
    }
    // The scene may be given too.
    if !ended {
        let output = run(&[&file, &"--resume", &broken, &"--quiet"]);
        assert!(output.status.success(), "{}", said(&output));
    }
    assert_same_results(&whole, &broken);
    assert!(!broken.join("checkpoint.bin").exists());
    found
}

/// A loaded machine may need more kills, this many times as many at most.
const MOST_TIMES: u64 = 4;
/// Kills after which there must be a checkpoint: a fast machine ends some runs, and begins others, within the quarter of a second that
/// lies between two.
const LEAST_FOUND: u64 = 3;

#[test]
fn a_run_on_half_planes_that_is_killed_10_times_ends_with_the_same_bits() {
    let found = survives(10, &half_space("step = { revolutions = 200.0 }"));
    assert!(found >= LEAST_FOUND, "{found}");
}

#[test]
fn a_run_on_finite_elements_that_is_killed_5_times_ends_with_the_same_bits() {
    let found = survives(5, &finite_elements("step = { revolutions = 320.0 }"));
    assert!(found >= LEAST_FOUND, "{found}");
}

#[test]
fn an_adaptive_run_that_is_killed_5_times_ends_with_the_same_bits() {
    // A clean start every 100 evaluations on springs at 1000 positions; severe wear takes some 800 of them in 40 hours.
    let numerics = "flank_points = 120\npositions = 1000\nstep = \"adaptive\"\ntolerance_um = 1e-4";
    let severe = "[wear.severe]\nabove_MPa = 1300.0\nfactor = 20.0\nband_MPa = 50.0";
    let scene = scene("surface = \"winkler\"\ntip_contact = false", numerics, severe);
    let found = survives(5, &scene.replace("hours = 128.0", "hours = 40.0"));
    assert!(found >= LEAST_FOUND, "{found}");
}

/// A run that is killed once after it has a checkpoint: folder and scene file.
fn broken_run(folder: &Folder) -> (PathBuf, PathBuf) {
    let file = folder.write("scene.toml", &half_space("step = { revolutions = 100.0 }"));
    let out = folder.path("out");
    let mut child = gearwear().arg("run").arg(&file).arg("--out").arg(&out).arg("--quiet").spawn().unwrap();
    let begin = Instant::now();
    while !out.join("checkpoint.bin").exists() && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(out.join("checkpoint.bin").exists());
    (file, out)
}

fn refused(args: &[&dyn AsRef<std::ffi::OsStr>], parts: &[&str]) {
    let output = run(args);
    let said = said(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    for part in parts {
        assert!(said.contains(part), "no {part:?} in\n{said}");
    }
}

#[test]
fn checkpoints_of_another_run_or_damaged_are_refused() {
    let folder = Folder::new();
    let (file, out) = broken_run(&folder);
    let checkpoint = out.join("checkpoint.bin");
    let sound = fs::read(&checkpoint).unwrap();

    let text = fs::read_to_string(&file).unwrap();
    let other = folder.write("other.toml", &text.replace("hours = 128.0", "hours = 129.0"));
    refused(&[&other, &"--resume", &out], &["another scene", "operation.hours: 128.0 there, 129.0 here"]);

    fs::write(&checkpoint, &sound[..sound.len() - 10]).unwrap();
    refused(&[&"--resume", &out], &["checkpoint.bin", "incomplete", "remove the checkpoint"]);
    let mut edited = sound.clone();
    let last = edited.len() - 100;
    edited[last] ^= 1;
    fs::write(&checkpoint, &edited).unwrap();
    refused(&[&"--resume", &out], &["damaged", "SHA-256"]);
    fs::write(&checkpoint, b"not at all\n").unwrap();
    refused(&[&"--resume", &out], &["its first line is not that of a checkpoint"]);
    let end = sound.iter().position(|&byte| byte == b'\n').unwrap();
    let version = env!("CARGO_PKG_VERSION");
    let line = String::from_utf8_lossy(&sound[..end]).replace(version, "99.9.9");
    fs::write(&checkpoint, [line.as_bytes(), &sound[end..]].concat()).unwrap();
    refused(&[&"--resume", &out], &["written by gearwear 99.9.9", version]);

    // The scene in the folder was edited.
    fs::write(&checkpoint, &sound).unwrap();
    let own = fs::read_to_string(out.join("scene.toml")).unwrap();
    fs::write(out.join("scene.toml"), own.replace("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 303.0")).unwrap();
    refused(&[&"--resume", &out], &["operation.pinion_torque_Nm: 302.0 there, 303.0 here"]);
    // None of this has touched it.
    fs::write(out.join("scene.toml"), own).unwrap();
    assert!(fs::read(&checkpoint).unwrap() == sound);
    let output = run(&[&"--resume", &out]);
    assert!(output.status.success() && said(&output).contains("continues at"), "{}", said(&output));
    // And it is complete.
    let output = run(&[&"--resume", &out]);
    assert!(
        output.status.success() && said(&output).contains("is complete: nothing is left to do"),
        "{}",
        said(&output)
    );
}

#[test]
fn input_files_lie_in_the_folder_and_are_those_of_the_checkpoint() {
    let folder = Folder::new();
    fs::create_dir(folder.path("data")).unwrap();
    // From A to E of fzg-c: a stiffness curve of one's own.
    let curve = |stiffness: f64| {
        let row = |at: f64| format!("{at},{stiffness}\n");
        format!("# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n{}{}", row(4.4723), row(23.5694))
    };
    folder.write("data/curve.csv", &curve(15.0));
    let file = folder.write(
        "scene.toml",
        &scene("surface = \"hertz\"", QUICK, "")
            .replace("model = \"weber-banaschek\"", "model = \"simon\"\ncurve = \"data/curve.csv\""),
    );
    let out = folder.path("out");
    let output = run(&[&file, &"--out", &out]);
    if !output.status.success() {
        panic!("{}", said(&output));
    }
    assert_eq!(fs::read_to_string(out.join("inputs/curve.csv")).unwrap(), curve(15.0));
    // What lies there can be run by itself, to the same bits.
    fs::remove_file(folder.path("data/curve.csv")).unwrap();
    let again = folder.path("again");
    let output = run(&[&out.join("scene.toml"), &"--out", &again]);
    assert!(output.status.success(), "{}", said(&output));
    assert_same_results(&out, &again);
    // Before a checkpoint is written the run begins anew; the same scene with another file is another run.
    fs::remove_file(again.join("summary.json")).unwrap();
    let output = run(&[&"--resume", &again]);
    assert!(output.status.success(), "{}", said(&output));
    assert_same_results(&out, &again);
}

#[test]
fn folders_without_a_run() {
    let folder = Folder::new();
    let file = folder.write("scene.toml", &scene("surface = \"hertz\"", QUICK, ""));
    let out = folder.path("out");
    refused(&[&"--resume", &out], &["has no scene.toml", "gearwear run SCENE --resume"]);
    refused(&[&file, &"--resume", &out, &"--out", &out], &["--resume", "cannot be used with", "--out"]);
    refused(&[&file], &["--out"]);
    // With a scene it begins there.
    let output = run(&[&file, &"--resume", &out]);
    assert!(output.status.success(), "{}", said(&output));
    // Once it is complete, the same command has nothing to do.
    let output = run(&[&file, &"--resume", &out]);
    assert!(output.status.success() && said(&output).contains("is complete"), "{}", said(&output));
}

/// What a killed run was writing goes with the next run into its folder; files of others with such names stay.
#[test]
fn leftovers_of_a_killed_run_are_cleaned_by_the_next() {
    let folder = Folder::new();
    let (file, out) = broken_run(&folder);
    // As SIGKILL leaves it between making and renaming, which is too short a moment to hit on purpose.
    let (left, other) = (out.join(".gearwear-aB3dE9"), out.join(".gearwear-notes"));
    fs::write(&left, "half a table").unwrap();
    fs::write(&other, "of someone else").unwrap();
    let output = run(&[&file, &"--resume", &out, &"--quiet"]);
    assert!(output.status.success(), "{}", said(&output));
    let hidden = |path: &Path| {
        let names = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.starts_with('.')).collect::<Vec<_>>()
    };
    assert_eq!(hidden(&out), [".gearwear-notes"]);
}

/// The built-in cases lie in a folder for temporary files while they run.
#[test]
fn the_folder_of_a_killed_validation_goes_with_the_next() {
    let folder = Folder::new();
    let temporary = folder.path("temporary");
    fs::create_dir(&temporary).unwrap();
    let validate = |out: &str| {
        let mut command = gearwear();
        command
            .env("TMPDIR", &temporary)
            .args(["validate", "fzg-c-geometry", "--quiet", "--out"])
            .arg(folder.path(out));
        command
    };
    let count = || fs::read_dir(&temporary).unwrap().count();
    let mut child = validate("killed").stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    while count() == 0 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    // Until its files are there, so that it is locked.
    std::thread::sleep(Duration::from_millis(20));
    child.kill().unwrap();
    child.wait().unwrap();
    // On a fast machine it may have ended.
    assert!(count() <= 1);
    assert!(validate("next").output().unwrap().status.success());
    assert_eq!(count(), 0);
}
