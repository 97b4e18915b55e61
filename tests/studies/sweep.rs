//! `gearwear sweep` from the outside: the whole path, restarts, shards, bad combinations, bad input, and what is kept when
//! something goes wrong on the way.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::program::{exchanged, gearwear, json};

const TABLES: &[&str] = &[
    "rows.jsonl",
    "sweep.csv",
    #[cfg(feature = "parquet")]
    "sweep.parquet",
    "sweep.json",
    "scene.toml",
    "report.html",
];

/// The thesis-spur scene with a surface and a resolution at which a run takes about a millisecond.
fn coarse_scene() -> String {
    exchanged(
        "thesis-spur",
        &[
            ("surface = \"winkler\"", "surface = \"hertz-mean\""),
            ("match = \"half-width\"", "# match"),
            ("flank_points = 750 ", "flank_points = 60 "),
            ("positions = 400 ", "positions = 40 "),
            ("step = { revolutions = 7665.0 }", "step = { revolutions = 200000.0 }"),
        ],
    )
}

/// A folder with a scene in it.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        Self::of(&coarse_scene())
    }

    fn of(scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), scene).unwrap();
        Self { folder }
    }

    fn out(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, out: &str, vary: &[&str], more: &[&str]) -> Command {
        let mut command = gearwear();
        command.arg("sweep").arg(self.out("scene.toml")).arg("--out").arg(self.out(out)).args(more);
        for vary in vary {
            command.args(["--vary", vary]);
        }
        command
    }

    fn sweep(&self, out: &str, vary: &[&str], more: &[&str]) -> Output {
        self.command(out, vary, more).output().unwrap()
    }

    fn merge(&self, folders: &[&str], out: &str) -> Output {
        let mut command = gearwear();
        command.args(["sweep", "merge"]).args(folders.iter().map(|folder| self.out(folder)));
        command.arg("--out").arg(self.out(out)).output().unwrap()
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", said(output));
}

/// The program refused with status 2 and says all of this.
fn refused(output: &Output, parts: &[&str]) {
    let message = said(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    for part in parts {
        assert!(message.contains(part), "no {part:?} in:\n{message}");
    }
}

/// Header and rows of `sweep.csv`, the columns of times left out.
fn table(out: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(out.join("sweep.csv")).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let timeless: Vec<usize> =
        (0..names.len()).filter(|&at| !["simulation_s", "wall_s"].contains(&&*names[at])).collect();
    let rows = reader.records().map(|row| {
        let row = row.unwrap();
        timeless.iter().map(|&at| row[at].to_owned()).collect()
    });
    (timeless.iter().map(|&at| names[at].clone()).collect(), rows.collect())
}

fn column(out: &Path, name: &str) -> Vec<String> {
    let (names, rows) = table(out);
    let at = names.iter().position(|other| other == name).unwrap_or_else(|| panic!("{name}"));
    rows.into_iter().map(|row| row[at].clone()).collect()
}

fn numbers(out: &Path, name: &str) -> Vec<f64> {
    column(out, name).iter().map(|text| text.parse().unwrap()).collect()
}

/// Number of finished rows in the journal.
fn journaled(out: &Path) -> usize {
    fs::read_to_string(out.join("rows.jsonl")).map_or(0, |text| text.lines().count().saturating_sub(1))
}

/// Waits until the journal has so many rows.
fn wait_for_rows(out: &Path, count: usize) {
    let start = Instant::now();
    while journaled(out) < count {
        assert!(start.elapsed() < Duration::from_secs(60), "no {count} rows in {}", out.display());
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The coarse scene, which asks by name for the verification, on few elements.
fn verified_scene() -> String {
    let (text, numerics) = (coarse_scene(), "[numerics]\n");
    assert!(text.contains(numerics));
    text.replace(numerics, "[fem]\nelements_per_half_width = 2\n[numerics]\nverify = true\n")
}

/// Names of the columns of claims, which are the paths of the same in the summary of a run.
fn claims(out: &Path) -> Vec<String> {
    let (names, _) = table(out);
    let claims: Vec<String> =
        names.into_iter().filter(|name| name.starts_with("error.total.") && name != "error.total.how").collect();
    assert_eq!(claims.len(), 12);
    claims
}

const WIDTHS: &str = "pair.face_width_mm=10:30:5";
const TORQUES: &str = "operation.pinion_torque_Nm=100:300:3";

#[test]
fn all_combinations_have_a_row_in_every_output() {
    let bench = Bench::new();
    let output = bench.sweep("out", &[WIDTHS, TORQUES], &[]);
    done(&output);
    let out = bench.out("out");
    for file in TABLES {
        assert!(out.join(file).metadata().unwrap().len() > 0, "{file}");
    }
    // The first key changes slowest.
    assert_eq!(numbers(&out, "pair.face_width_mm")[..4], [10.0, 10.0, 10.0, 15.0]);
    assert_eq!(numbers(&out, "operation.pinion_torque_Nm")[..4], [100.0, 200.0, 300.0, 100.0]);
    assert!(column(&out, "status").iter().all(|status| status == "ok"));
    // The same torque over twice the width is half the line load: base radius of the fzg-c pinion, 33.8289 mm.
    let loads = numbers(&out, "contact.line_load_N_per_mm");
    assert!((loads[0] - 100e3 / 33.8289 / 10.0).abs() < 1e-3, "{}", loads[0]);
    assert!((loads[0] / loads[6] - 2.0).abs() < 1e-12);

    let summary = json(&out.join("sweep.json"));
    assert_eq!((&summary["combinations"], &summary["ok"], &summary["failed"]), (&15.into(), &15.into(), &0.into()));
    let peaks = numbers(&out, "pinion.peak_wear_um");
    let least = peaks.iter().copied().fold(f64::INFINITY, f64::min);
    let best = summary["best"].as_array().unwrap().iter().find(|best| best["figure"] == "pinion.peak_wear_um").unwrap();
    assert_eq!(best["value"], least);
    assert_eq!(peaks[best["index"].as_u64().unwrap() as usize], least);
    // The scene is the user's, word for word.
    assert_eq!(fs::read_to_string(out.join("scene.toml")).unwrap(), coarse_scene());
    assert!(said(&output).contains("errors are not estimated"), "{}", said(&output));
}

/// A row holds what `gearwear run` says of the same scene.
#[test]
fn a_combination_is_the_run_of_its_scene() {
    let bench = Bench::new();
    done(&bench.sweep("out", &[WIDTHS, TORQUES], &["--quiet"]));
    // One snapshot, as a sweep has: wear steps are shortened to hit snapshots.
    let scene = coarse_scene()
        .replace("face_width_mm = 14.0", "face_width_mm = 15.0")
        .replace("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 200.0")
        .replace("snapshots_h = [0.25, 0.75, 1.75, 3.75, 7.75, 15.75, 31.75, 63.75, 127.75]", "snapshots_h = [127.75]");
    fs::write(bench.out("one.toml"), scene).unwrap();
    let run = gearwear().arg("run").arg(bench.out("one.toml")).arg("--out").arg(bench.out("one")).output().unwrap();
    done(&run);
    let summary = json(&bench.out("one").join("summary.json"));
    for (name, path) in [
        ("pinion.peak_wear_um", "/pinion/peak_wear_um"),
        ("wheel.worn_volume_mm3", "/wheel/worn_volume_mm3"),
        ("worn.peak_pressure_MPa", "/worn/peak_pressure_MPa"),
        ("new.transmission_error_um.peak_to_peak", "/new/transmission_error_um/peak_to_peak"),
        ("geometry.transverse_contact_ratio", "/geometry/transverse_contact_ratio"),
    ] {
        assert_eq!(numbers(&bench.out("out"), name)[4], summary.pointer(path).unwrap().as_f64().unwrap(), "{name}");
    }
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_reads_back_what_csv_says() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    let bench = Bench::new();
    // A pinion of 8 teeth cannot be made here: some rows have an error.
    done(&bench.sweep("out", &["pair.pinion.teeth=8:16:2", TORQUES], &[]));
    let out = bench.out("out");
    let (names, rows) = table(&out);
    let reader = SerializedFileReader::new(fs::File::open(out.join("sweep.parquet")).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata();
    let about = metadata.key_value_metadata().unwrap();
    let value = |key: &str| about.iter().find(|pair| pair.key == key).unwrap().value.clone().unwrap();
    assert_eq!(value("gearwear_version"), env!("CARGO_PKG_VERSION"));
    assert_eq!(value("scene_hash"), json(&out.join("sweep.json"))["scene_hash"]);
    assert!(value("column:pinion.peak_wear_um").contains("wear depth"));
    assert_eq!(metadata.num_rows(), 6);
    let mut errors = 0;
    for (row, expected) in reader.get_row_iter(None).unwrap().zip(rows) {
        let row = row.unwrap();
        let fields: Vec<(String, Field)> = row.get_column_iter().map(|(n, f)| (n.clone(), f.clone())).collect();
        for (name, expected) in names.iter().zip(expected) {
            let (_, field) = fields.iter().find(|(other, _)| other == name).unwrap();
            match field {
                Field::Null => assert_eq!(expected, "", "{name}"),
                Field::Long(value) => assert_eq!(expected, value.to_string(), "{name}"),
                Field::Double(value) => assert_eq!(expected.parse::<f64>().unwrap(), *value, "{name}"),
                Field::Str(text) => assert_eq!(&expected, text, "{name}"),
                other => panic!("{name}: {other:?}"),
            }
            errors += usize::from(name == "error" && *field != Field::Null);
        }
    }
    assert_eq!(errors, 3);
}

#[test]
fn one_bad_combination_is_a_row_with_its_error() {
    let bench = Bench::new();
    // A tip diameter of 92 mm gives a pointed tooth, and of 80 to 84 mm a sound one.
    let output = bench.sweep("out", &["pair.pinion.tip_diameter_mm=80:92:4"], &[]);
    done(&output);
    let out = bench.out("out");
    let status = column(&out, "status");
    assert_eq!(status[0], "ok");
    assert_eq!(status[3], "failed");
    let errors = column(&out, "error");
    assert!(errors[0].is_empty() && errors[3].contains("pair.pinion.tip_diameter_mm"), "{errors:?}");
    assert_eq!(column(&out, "pinion.peak_wear_um")[3], "");
    assert!(json(&out.join("sweep.json"))["failed"].as_u64().unwrap() >= 1);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("without a result"));
}

/// A range that the key takes only in part: the rest are rows with errors, and it is said before.
#[test]
fn values_outside_a_keys_range_are_rows() {
    let bench = Bench::new();
    let output = bench.sweep("out", &["pair.face_width_mm=-10:10:3"], &[]);
    done(&output);
    assert!(said(&output).contains("2 of 3 values are not allowed"), "{}", said(&output));
    assert_eq!(column(&bench.out("out"), "status"), ["failed", "failed", "ok"]);
    assert!(column(&bench.out("out"), "error")[0].contains("greater than 0"));
}

#[test]
fn a_sweep_without_any_scene_is_refused() {
    let bench = Bench::new();
    let output = bench.sweep("out", &["pair.centre_distance_mm=80:82:3"], &[]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("none of the combinations makes a scene"), "{}", said(&output));
    assert!(said(&output).contains("pair.centre_distance_mm"), "{}", said(&output));
    assert!(!bench.out("out").exists());
}

#[test]
fn a_cut_journal_goes_on_where_it_was() {
    let bench = Bench::new();
    done(&bench.sweep("whole", &[WIDTHS, TORQUES], &["--quiet"]));
    let whole = fs::read_to_string(bench.out("whole").join("rows.jsonl")).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    // Killed after 6 rows, in the middle of the seventh; and in the middle of the first line.
    for (name, kept) in
        [("torn", format!("{}\n{}", lines[..7].join("\n"), &lines[7][..40])), ("head", lines[0][..30].to_owned())]
    {
        fs::create_dir(bench.out(name)).unwrap();
        fs::write(bench.out(name).join("rows.jsonl"), kept).unwrap();
        let output = bench.sweep(name, &[WIDTHS, TORQUES], &[]);
        done(&output);
        assert_eq!(said(&output).contains("6 of them finished before"), name == "torn", "{}", said(&output));
        assert_eq!(table(&bench.out(name)), table(&bench.out("whole")));
        assert_eq!(journaled(&bench.out(name)), 15);
    }
    // Rows that were finished are not run again: their lines stand as they were.
    let again = fs::read_to_string(bench.out("torn").join("rows.jsonl")).unwrap();
    assert_eq!(again.lines().take(7).collect::<Vec<_>>(), lines[..7]);
    // A finished sweep runs nothing, and writes its tables again.
    fs::remove_file(bench.out("torn").join("sweep.json")).unwrap();
    let before = fs::read(bench.out("torn").join("rows.jsonl")).unwrap();
    done(&bench.sweep("torn", &[WIDTHS, TORQUES], &[]));
    assert_eq!(fs::read(bench.out("torn").join("rows.jsonl")).unwrap(), before);
    assert!(bench.out("torn").join("sweep.json").exists());
}

#[test]
fn the_journal_of_another_sweep_is_refused() {
    let bench = Bench::new();
    done(&bench.sweep("out", &[WIDTHS], &["--quiet"]));
    let before = fs::read(bench.out("out").join("rows.jsonl")).unwrap();
    let refused_with = |output: &Output, what: &str| refused(output, &["--out:", "the rows of another sweep", what]);
    refused_with(&bench.sweep("out", &[TORQUES], &[]), "what is varied: pair.face_width_mm=10:30:5 and");
    refused_with(&bench.sweep("out", &[WIDTHS], &["--shard", "1/2"]), "all of it and shard 1/2");
    refused_with(&bench.sweep("out", &[WIDTHS], &["--error-estimate"]), "errors estimated: no and yes");
    fs::write(bench.out("scene.toml"), coarse_scene().replace("302.0", "303.0")).unwrap();
    refused_with(&bench.sweep("out", &[WIDTHS], &[]), "scene:");
    // A comment is no other scene.
    fs::write(bench.out("scene.toml"), format!("# mine\n{}", coarse_scene())).unwrap();
    done(&bench.sweep("out", &[WIDTHS], &["--quiet"]));
    assert_eq!(fs::read(bench.out("out").join("rows.jsonl")).unwrap(), before);
    // A line in the middle that no sweep wrote.
    let text = String::from_utf8(before).unwrap();
    let damaged: String = text
        .lines()
        .enumerate()
        .map(|(i, line)| if i == 2 { "nonsense\n".to_owned() } else { format!("{line}\n") })
        .collect();
    fs::write(bench.out("out").join("rows.jsonl"), damaged).unwrap();
    refused(&bench.sweep("out", &[WIDTHS], &[]), &["rows.jsonl, line 3"]);
}

#[test]
fn threads_never_change_a_row() {
    let bench = Bench::new();
    done(&bench.sweep("one", &[WIDTHS, TORQUES], &["--threads", "1", "--quiet"]));
    done(&bench.sweep("two", &[WIDTHS, TORQUES], &["--threads", "2", "--quiet"]));
    assert_eq!(table(&bench.out("one")), table(&bench.out("two")));
}

#[test]
fn shards_merge_into_the_whole() {
    let bench = Bench::new();
    // Some combinations fail, in the shards as in the whole.
    let vary = ["pair.pinion.tip_diameter_mm=80:92:4", TORQUES];
    done(&bench.sweep("whole", &vary, &["--quiet"]));
    for (name, shard) in [("s1", "1/3"), ("s2", "2/3"), ("s3", "3/3")] {
        done(&bench.sweep(name, &vary, &["--quiet", "--shard", shard]));
        assert!(bench.out(name).join("sweep.csv").exists() && !bench.out(name).join("report.html").exists());
    }
    assert_eq!(column(&bench.out("s2"), "index"), ["1", "4", "7", "10"]);
    // One shard is missing: which combinations, and nothing is written.
    let output = bench.merge(&["s1", "s3"], "all");
    refused(
        &output,
        &["4 of 12 combinations are missing", "pair.pinion.tip_diameter_mm = 80, operation.pinion_torque_Nm = 200"],
    );
    assert!(!bench.out("all").exists());
    done(&bench.merge(&["s3", "s1", "s2"], "all"));
    for file in TABLES {
        assert!(bench.out("all").join(file).exists(), "{file}");
    }
    assert_eq!(table(&bench.out("all")), table(&bench.out("whole")));
    let timeless = |folder: &str| {
        let mut summary = json(&bench.out(folder).join("sweep.json"));
        for key in ["wall_s", "combinations_wall_s", "threads"] {
            summary.as_object_mut().unwrap().remove(key);
        }
        summary
    };
    assert_eq!(timeless("all"), timeless("whole"));
    let scene = |folder: &str| fs::read_to_string(bench.out(folder).join("scene.toml")).unwrap();
    assert_eq!(scene("all"), scene("whole"));
    // What was merged is a sweep like any other.
    done(&bench.sweep("all", &vary, &["--quiet"]));
    done(&bench.merge(&["all"], "again"));

    // A shard that was stopped is named.
    let journal = bench.out("s2").join("rows.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    fs::write(&journal, text.lines().take(3).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    refused(&bench.merge(&["s1", "s2", "s3"], "never"), &["2 of 12", "s2 (2 of 4)"]);

    // One whose first line is cut short or damaged, or that has a byte of no text, is named with its line.
    let head = text.lines().next().unwrap();
    for (bytes, words) in [
        (head.as_bytes()[..40].to_vec(), "line 1: a line without an end"),
        ([b"{\xff".as_slice(), text.as_bytes()].concat(), "line 1: invalid utf-8"),
        ([text.as_bytes(), b"\xfe\n".as_slice()].concat(), "line 6: invalid utf-8"),
    ] {
        fs::write(&journal, bytes).unwrap();
        let merged = bench.merge(&["s1", "s2", "s3"], "never");
        refused(&merged, &["rows.jsonl", words]);
        assert!(!bench.out("never").exists());
    }
}

#[test]
fn what_is_no_part_of_the_sweep_is_not_merged() {
    let bench = Bench::new();
    done(&bench.sweep("one", &[WIDTHS], &["--quiet", "--shard", "1/2"]));
    done(&bench.sweep("two", &["pair.face_width_mm=10:30:6"], &["--quiet", "--shard", "2/2"]));
    refused(&bench.merge(&["one", "two"], "all"), &["are not parts of one sweep", "10:30:5 and", "10:30:6"]);
    refused(&bench.merge(&["one", "nowhere"], "all"), &["nowhere holds no sweep"]);
    refused(&bench.merge(&["one"], "one"), &["one of the folders to merge"]);
    done(&bench.sweep("all", &[WIDTHS], &["--quiet"]));
    refused(&bench.merge(&["all"], "two"), &["two", "the rows of another sweep"]);
    // The same combination with another result.
    done(&bench.sweep("same", &[WIDTHS], &["--quiet", "--shard", "1/2"]));
    let journal = bench.out("same").join("rows.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    fs::write(&journal, text.replacen("\"warnings\":", "\"warnings\":9", 1)).unwrap();
    refused(&bench.merge(&["one", "same"], "all"), &["another result", "pair.face_width_mm = "]);
}

/// Every way to ask for a sweep that cannot be: status 2, what was found and what is allowed, and nothing left behind.
#[test]
fn bad_input_is_refused_before_any_work() {
    let bench = Bench::new();
    for (vary, more, parts) in [
        (
            &["pair.face_widht_mm=10:30:5"][..],
            &[][..],
            &["--vary: unknown key pair.face_widht_mm", "did you mean pair.face_width_mm?"][..],
        ),
        (&["pair.face_width_mm=30:10:5"], &[], &["--vary: pair.face_width_mm", "reversed", "allowed"]),
        (&["pair.face_width_mm=10:30:0"], &[], &["found \"0\" as COUNT", "allowed: a whole number"]),
        (&["pair.face_width_mm=10:30"], &[], &["KEY=FROM:TO:COUNT"]),
        (&["pair.face_width_mm=a:30:5"], &[], &["found \"a\" as FROM"]),
        (&["pair.face_width_mm=-30:-10:5"], &[], &["found -30 to -10", "greater than 0"]),
        (&["contact.surface=1:2:2"], &[], &["contact.surface: found", "hertz-mean"]),
        (&["pair.pinion.teeth=16:17:3"], &[], &["pair.pinion.teeth: found the value 16.5", "whole numbers"]),
        (&[WIDTHS, WIDTHS], &[], &["pair.face_width_mm twice"]),
        (&["pair.normal_module_mm=4:5:2", "pair.transverse_module_mm=4:5:2"], &[], &["say the same thing"]),
        (&[WIDTHS], &["--shard", "0/3"], &["I/N with I from 1 to N"]),
        (&[WIDTHS], &["--shard", "4/3"], &["I/N with I from 1 to N"]),
        (&[WIDTHS], &["--shard", "1"], &["I/N with I from 1 to N"]),
        (&[WIDTHS], &["--threads", "0"], &["--threads"]),
        (&[], &[], &["--vary"]),
    ] {
        let output = bench.sweep("out", vary, more);
        refused(&output, parts);
        assert!(!bench.out("out").exists(), "{vary:?} left something behind");
    }
    // A folder that cannot be one.
    fs::write(bench.out("file"), "").unwrap();
    refused(&bench.sweep("file", &[WIDTHS], &[]), &["--out:", "not a folder"]);
    // A scene that is wrong by itself.
    let wrong = Bench::of(&coarse_scene().replace("teeth = 16", "teeth = 1"));
    refused(&wrong.sweep("out", &[WIDTHS], &[]), &["scene.toml:", "pair.pinion.teeth"]);
    refused(&gearwear().args(["sweep", "merge", "--out", "x"]).output().unwrap(), &["<DIR>"]);
}

/// A sweep whose combinations take some hundredths of a second each, so that something can happen on the way.
fn slow_bench() -> Bench {
    let scene = coarse_scene()
        .replace("flank_points = 60 ", "flank_points = 750 ")
        .replace("positions = 40 ", "positions = 400 ")
        .replace("revolutions = 200000.0", "revolutions = 20000.0");
    Bench::of(&scene)
}

const MANY: &str = "pair.face_width_mm=10:30:2000";

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_the_rows_that_are_finished() {
    let bench = slow_bench();
    let out = bench.out("out");
    let mut child = bench.command("out", &[MANY], &[]).stderr(Stdio::piped()).spawn().unwrap();
    wait_for_rows(&out, 5);
    // A second sweep in the same folder is refused while the first runs.
    refused(&bench.sweep("out", &[MANY], &[]), &["is being written by another gearwear sweep"]);
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let lines: Vec<String> = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap).collect();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{lines:?}");
    assert!(lines.iter().any(|line| line.contains("of 2000 combinations are finished and kept")), "{lines:?}");
    let kept = journaled(&out);
    assert!((5..2000).contains(&kept), "{kept}");
    assert!(!out.join("sweep.json").exists());
    // Every line is whole.
    let text = fs::read_to_string(out.join("rows.jsonl")).unwrap();
    assert!(text.ends_with('\n') && text.lines().all(|line| serde_json::from_str::<Value>(line).is_ok()));
}

#[test]
fn a_folder_removed_on_the_way_is_an_error_and_its_rows_are_kept() {
    let bench = slow_bench();
    let out = bench.out("out");
    let child = bench.command("out", &[MANY], &["--quiet"]).stderr(Stdio::piped()).spawn().unwrap();
    wait_for_rows(&out, 5);
    // In one step, as a folder is moved or removed by other programs.
    fs::rename(&out, bench.out("elsewhere")).unwrap();
    let output = child.wait_with_output().unwrap();
    refused(
        &output,
        &["rows.jsonl was removed while the study ran", "written there anew", "the same command continues"],
    );
    let kept = journaled(&out);
    assert!((5..2000).contains(&kept), "{kept}");
}

/// A file size limit stands for a full disk: the system refuses to write on.
#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error_and_what_was_written_is_kept() {
    let bench = Bench::new();
    let command = bench.command("out", &["pair.face_width_mm=10:30:101"], &["--quiet"]);
    let words: Vec<String> = command.get_args().map(|word| format!("'{}'", word.to_string_lossy())).collect();
    let program = command.get_program().to_string_lossy().into_owned();
    let limited = format!("trap '' XFSZ; ulimit -f 16; exec '{program}' {}", words.join(" "));
    let output = Command::new("bash").args(["-c", &limited]).output().unwrap();
    refused(&output, &["--out: cannot write", "rows.jsonl", "finished rows are kept"]);
    let kept = journaled(&bench.out("out"));
    assert!((5..101).contains(&kept), "{kept}");
    // With room again, it goes on.
    done(&bench.sweep("out", &["pair.face_width_mm=10:30:101"], &["--quiet"]));
    done(&bench.sweep("whole", &["pair.face_width_mm=10:30:101"], &["--quiet"]));
    assert_eq!(table(&bench.out("out")), table(&bench.out("whole")));
}

/// Figures of slices are there for every combination with a helix, and empty for the spur pair that a range from 0° begins with.
#[test]
fn a_helical_sweep_keeps_the_figures_of_slices() {
    let scene = gearwear::PRESETS.iter().find(|preset| preset.name == "thesis-helical").unwrap().text;
    let mut coarse = scene.to_owned();
    for (from, to) in [
        ("surface = \"hertz\" ", "surface = \"hertz-mean\" "),
        ("slices = 20 ", "slices = 6 "),
        ("flank_points = 750 ", "flank_points = 60 "),
        ("positions = 400 ", "positions = 40 "),
        ("step = { revolutions = 10000.0 }", "step = { revolutions = 200000.0 }"),
    ] {
        assert!(coarse.contains(from), "{from}");
        coarse = coarse.replace(from, to);
    }
    let bench = Bench::of(&coarse);
    let vary = ["pair.helix_angle_deg=0:30:3", "pair.face_width_mm=10:30:3"];
    done(&bench.sweep("out", &vary, &["--quiet"]));
    let out = bench.out("out");
    assert!(column(&out, "status").iter().all(|status| status == "ok"), "{:?}", column(&out, "error"));
    for name in [
        "helical.wear.pinion.root_variation",
        "helical.wear.wheel.tip_variation",
        "helical.K_Hbeta_worn",
        "helical.mesh_orders_new_um.1",
    ] {
        let cells = column(&out, name);
        assert!(cells[..3].iter().all(String::is_empty), "{name}: {cells:?}");
        assert!(cells[3..].iter().all(|cell| cell.parse::<f64>().is_ok_and(|value| value >= 0.0)), "{name}: {cells:?}");
    }
    // ε_β = b tan β / (π m_t) of the preset, m_t = 4.5 mm, at 15° and 20 mm (ISO 21771).
    let expected = 20.0 * 15f64.to_radians().tan() / (std::f64::consts::PI * 4.5);
    assert!((numbers(&out, "geometry.overlap_ratio")[4] / expected - 1.0).abs() < 1e-12);
    // A helix that no scene may have, in part of the range and in all of it.
    done(&bench.sweep("part", &["pair.helix_angle_deg=30:60:2"], &["--quiet"]));
    assert_eq!(column(&bench.out("part"), "status"), ["ok", "failed"]);
    let refusal = bench.sweep("none", &["pair.helix_angle_deg=50:60:3"], &["--quiet"]);
    refused(&refusal, &["pair.helix_angle_deg: found 50 to 60", "at most 45"]);
}

/// Three keys: every plot is drawn over the first two, and says where the third stays.
#[test]
fn a_third_key_stays_at_its_best() {
    let bench = Bench::new();
    done(&bench.sweep("out", &[WIDTHS, TORQUES, "operation.hours=10:100:2"], &["--quiet"]));
    let page = fs::read_to_string(bench.out("out").join("report.html")).unwrap();
    assert!(page.contains("id=\"contour-pinion-peak-wear-um\""));
    assert!(page.contains("Shown with operation.hours = 10, where the minimum of all is."));
    let peaks = numbers(&bench.out("out"), "pinion.peak_wear_um");
    // Ten times the duration wears more in every combination.
    assert!(peaks.chunks(2).all(|pair| pair[0] < pair[1]), "{peaks:?}");
}

/// A data file of the scene belongs to its pair: combinations of another pair are rows with an error, other widths are not.
#[test]
fn a_curve_of_the_scene_belongs_to_its_pair() {
    let scene = coarse_scene()
        .replace("model = \"constant\"", "model = \"simon\"\ncurve = \"curve.csv\" #")
        .replace("pair_N_per_mm_um = 20.0", "# no value");
    let bench = Bench::of(&scene);
    // From A to E of the pair, 4.3 to 23.6 mm.
    let curve = "# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n1,18\n10,20\n20,19\n30,17\n";
    fs::write(bench.out("curve.csv"), curve).unwrap();
    done(&bench.sweep("out", &[WIDTHS, "pair.centre_distance_mm=91.5:91.7:2"], &["--quiet"]));
    let status = column(&bench.out("out"), "status");
    assert!(status.chunks(2).all(|pair| pair == ["ok", "failed"]), "{status:?}");
    assert!(column(&bench.out("out"), "error")[1].contains("stiffness.curve belongs to the pair"));
    // Another curve is another sweep.
    fs::write(bench.out("curve.csv"), curve.replace("1,18", "1,17")).unwrap();
    let again = bench.sweep("out", &[WIDTHS, "pair.centre_distance_mm=91.5:91.7:2"], &["--quiet"]);
    refused(&again, &["another sweep", "files that the scene names"]);
}

/// The best three and both ends are verified and no other; they say what `gearwear run` says of the same scenes.
#[test]
fn the_best_rows_and_the_corners_are_verified() {
    let bench = Bench::of(&verified_scene());
    let output = bench.sweep("out", &[WIDTHS], &["--threads", "1"]);
    done(&output);
    assert!(said(&output).contains("the best (3, by peak_wear_um) and the corners (2) of what is varied, at most 5"));
    let out = bench.out("out");
    // The wider the gears, the less they wear.
    let wear = numbers(&out, "peak_wear_um");
    assert!(wear.windows(2).all(|pair| pair[1] < pair[0]), "{wear:?}");
    assert_eq!(column(&out, "verified"), ["corner", "", "best", "best", "best and corner"]);

    let scene = verified_scene()
        .replace("face_width_mm = 14.0", "face_width_mm = 20.0")
        .replace("snapshots_h = [0.25, 0.75, 1.75, 3.75, 7.75, 15.75, 31.75, 63.75, 127.75]", "snapshots_h = [127.75]");
    fs::write(bench.out("one.toml"), scene).unwrap();
    done(&gearwear().arg("run").arg(bench.out("one.toml")).arg("--out").arg(bench.out("one")).output().unwrap());
    let run = json(&bench.out("one").join("summary.json"));
    let summary = json(&out.join("sweep.json"));
    let verification = &summary["verification"];
    for claim in claims(&out) {
        let of_run = run.pointer(&format!("/{}", claim.replace('.', "/"))).unwrap().as_f64().unwrap();
        let cells = column(&out, &claim);
        assert_eq!(cells[2].parse::<f64>().unwrap(), of_run, "{claim}");
        assert_eq!(cells[1], "");
        let worst = cells.iter().filter_map(|cell| cell.parse().ok()).fold(0.0, f64::max);
        let stated = verification["worst"].as_array().unwrap().iter().find(|worst| worst["claim"] == *claim).unwrap();
        assert_eq!(stated["value"], worst, "{claim}");
    }
    assert_eq!(column(&out, "error.total.how")[2], run["error"]["total"]["how"]);
    assert_eq!((&verification["chosen"], &verification["verified"]), (&4.into(), &4.into()));
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("Finite elements verified 4 of them: the maximum wear of each is within"));

    // Two threads, and a start that was stopped between two verifications: the same bits.
    let journal = fs::read_to_string(out.join("rows.jsonl")).unwrap();
    assert_eq!(journaled(&out), 5 + 4);
    fs::create_dir(bench.out("torn")).unwrap();
    let kept: String = journal.lines().take(1 + 5 + 1).map(|line| format!("{line}\n")).collect();
    fs::write(bench.out("torn").join("rows.jsonl"), kept).unwrap();
    done(&bench.sweep("torn", &[WIDTHS], &["--threads", "2", "--quiet"]));
    assert_eq!(table(&bench.out("torn")), table(&out));
    assert_eq!(journaled(&bench.out("torn")), 5 + 4);
}

/// The best of all rows are known when the shards are merged: then the sweep's own command verifies them.
#[test]
fn shards_are_verified_when_they_are_merged() {
    let bench = Bench::of(&verified_scene());
    // Of loads so small that the contact is too narrow to be meshed, finite elements say why they have no answer.
    let vary = ["operation.pinion_torque_Nm=1:2:2"];
    for (name, shard) in [("s1", "1/2"), ("s2", "2/2")] {
        let output = bench.sweep(name, &vary, &["--shard", shard]);
        done(&output);
        assert!(said(&output).contains("verify none of a shard"), "{}", said(&output));
        assert_eq!(json(&bench.out(name).join("sweep.json"))["verification"], Value::Null);
    }
    let merged = bench.merge(&["s1", "s2"], "all");
    done(&merged);
    assert!(String::from_utf8_lossy(&merged.stdout).contains("2 are not verified yet"));
    let open = |folder: &str| json(&bench.out(folder).join("sweep.json"))["verification"]["open"].clone();
    assert_eq!((open("all"), column(&bench.out("all"), "verified")), (2.into(), vec![String::new(); 2]));
    done(&bench.sweep("all", &vary, &["--quiet"]));
    done(&bench.sweep("whole", &vary, &["--quiet"]));
    assert_eq!(table(&bench.out("all")), table(&bench.out("whole")));
    let out = bench.out("whole");
    assert_eq!((open("whole"), column(&out, "verified")), (0.into(), vec!["best and corner".to_owned(); 2]));
    assert!(column(&out, "error.total.how").iter().all(|how| how.contains("too narrow to be meshed")));
    assert!(claims(&out).iter().all(|claim| column(&out, claim) == ["", ""]));
    assert_eq!(json(&out.join("sweep.json"))["verification"]["unanswered"], 2);
    // A shard that stands beside the verified whole takes nothing away from it.
    done(&bench.merge(&["all", "s1"], "again"));
    assert_eq!(table(&bench.out("again")), table(&out));
}

/// Teeth of a sector cannot be had in space; a scene that does not ask for the verification by name gets none.
#[test]
fn rows_that_cannot_be_verified_say_why() {
    let bench = Bench::of(&verified_scene().replace("[fem]\n", "[fem]\nbody = \"sector\"\n"));
    done(&bench.sweep("out", &["pair.pinion.lead_crowning_um=5:10:2"], &["--quiet"]));
    let how = column(&bench.out("out"), "error.total.how");
    let why = "not verified: fem.body is \"sector\": three-dimensional teeth need whole rings";
    assert!(how.iter().all(|how| how == why), "{how:?}");
    let unasked = Bench::new();
    let output = unasked.sweep("out", &[WIDTHS], &[]);
    done(&output);
    assert!(said(&output).contains("none is verified by finite elements"), "{}", said(&output));
    assert!(column(&unasked.out("out"), "verified").iter().all(String::is_empty));
    let summary = json(&unasked.out("out").join("sweep.json"));
    assert_eq!((&summary["verify"], &summary["verification"]), (&false.into(), &Value::Null));
}

/// Words are values like numbers, phases are numbered from 1, and an optimum is a plateau as wide as the error of its figure.
#[test]
fn words_phases_and_the_best_within_limits() {
    let bench = Bench::new();
    let surfaces = "contact.surface=hertz-mean,hertz";
    let output = bench.sweep("words", &[surfaces, "operation.pinion_torque_Nm=200,300"], &[]);
    done(&output);
    assert_eq!(column(&bench.out("words"), "contact.surface"), ["hertz-mean", "hertz-mean", "hertz", "hertz"]);
    let page = fs::read_to_string(bench.out("words/report.html")).unwrap();
    assert!(page.contains("pinion torque, N·m") && page.contains("hertz-mean or hertz"));

    let phased = coarse_scene().replace(
        "[contact]",
        "[[operation.phases]]\nhours = 27.75\n[[operation.phases]]\nhours = 100.0\npinion_torque_Nm = 100.0\n[contact]",
    );
    let phased = Bench::of(&phased.replace("snapshots_h", "# snapshots_h"));
    let goal = ["--best", "pinion.peak_wear_um", "--subject-to", "wheel.peak_wear_um<=1000"];
    let torques = "operation.phases.2.pinion_torque_Nm=100,200";
    let output = phased.sweep("phases", &[torques], &goal);
    done(&output);
    let summary = json(&phased.out("phases/sweep.json"));
    let optimum = &summary["optimum"];
    assert_eq!((&optimum["index"], &optimum["within_limits"]), (&Value::from(0), &Value::from(2)));
    assert!(optimum["error"].is_number() != optimum["why_no_error"].is_string(), "{optimum}");
    for (torque, more, message) in [
        ("operation.phases.3.pinion_torque_Nm=100,200", &[][..], "a phase that the scene has"),
        (torques, &["--best", "pinion_wear"], "unknown figure pinion_wear"),
        (torques, &["--best", "pinion.peak_wear_um", "--subject-to", "wheel.peak_wear_um=8"], "FIGURE<=VALUE"),
    ] {
        let output = phased.sweep("refused", &[torque], more);
        refused(&output, &[message]);
        assert!(!phased.out("refused").exists());
    }
}
