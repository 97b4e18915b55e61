//! `gearwear uncertainty` from the outside: the whole path, the same bits on any number of threads, failed samples, bad input.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};

use crate::program::{exchanged, gearwear, json};

const K: &str = "wear.coefficient_m2_per_N=lognormal:1.3";
const TORQUE: &str = "operation.pinion_torque_Nm=±10%";

/// The thesis-spur scene with a surface and a resolution at which a run takes about a millisecond, without the verification of the scene as given.
fn coarse_scene() -> String {
    exchanged(
        "thesis-spur",
        &[
            ("surface = \"winkler\"", "surface = \"hertz-mean\""),
            ("match = \"half-width\"", "# match"),
            ("flank_points = 750 ", "flank_points = 60 "),
            ("positions = 400 ", "positions = 40 "),
            ("step = { revolutions = 7665.0 }", "verify = false\nstep = { revolutions = 200000.0 }"),
        ],
    )
}

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), coarse_scene()).unwrap();
        Self { folder }
    }

    fn out(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, out: &str, uncertain: &[&str], more: &[&str]) -> Command {
        let mut command = gearwear();
        command.arg("uncertainty").arg(self.out("scene.toml")).arg("--out").arg(self.out(out)).args(more);
        for uncertain in uncertain {
            command.args(["--uncertain", uncertain]);
        }
        command
    }

    fn study(&self, out: &str, uncertain: &[&str], more: &[&str]) -> Output {
        self.command(out, uncertain, more).output().unwrap()
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", said(output));
}

fn refused(output: &Output, parts: &[&str]) {
    let message = said(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    for part in parts {
        assert!(message.contains(part), "no {part:?} in:\n{message}");
    }
}

/// Words stand for usual keys: of FZG gears type C (m 4.5 mm, d 72 and 108 mm) in class 7, f_HαT = 2 (0.4 m + 0.001 d + 4) µm rounded to whole ones,
/// 12 µm for both, lies at three standard deviations.
#[test]
fn words_stand_for_usual_keys() {
    let bench = Bench::new();
    done(&bench.study("out", &["coefficient", "torque", "class:7"], &["--samples", "2"]));
    let record = json(&bench.out("out").join("uncertainty.json"));
    let found = record["uncertain"].as_array().unwrap();
    let keys: Vec<&str> = found.iter().map(|one| one["key"].as_str().unwrap()).collect();
    let slopes = ["pinion", "wheel"].map(|gear| format!("pair.{gear}.profile_slope_deviation_um"));
    assert_eq!(keys, ["wear.coefficient_m2_per_N", "operation.pinion_torque_Nm", &slopes[0], &slopes[1]]);
    assert_eq!(found[0]["factor"], 1.5);
    assert_eq!((&found[2]["mean"], &found[2]["standard_deviation"]), (&json!(0.0), &json!(4.0)));
    refused(&bench.study("wrong", &["class:12"], &[]), &["class:12", "class:1 to class:11"]);
    // Mild wear, 3e-18 to 6e-17 m²/N on 95 %: its middle is √(3·6)·10⁻¹⁷·⁵, and 1.96 standard deviations of the logarithm are ½ ln 20.
    done(&bench.study("mild", &["coefficient:mild"], &["--samples", "2"]));
    let mild = &json(&bench.out("mild").join("uncertainty.json"))["uncertain"][0];
    let [median, factor] = ["median", "factor"].map(|key| mild[key].as_f64().unwrap());
    assert!(
        (median / 1.8e-34_f64.sqrt() - 1.0).abs() < 1e-12 && (factor.ln() - 0.5 * 20f64.ln() / 1.96).abs() < 1e-4,
        "{mild}"
    );
    refused(&bench.study("wrong", &["coefficient:soft"], &[]), &["coefficient:soft", "regime-2"]);
}

/// A study says what it knows while it goes on, of eight points and then of twice as many each time.
#[test]
fn figures_come_while_a_study_goes_on() {
    let bench = Bench::new();
    let output = bench.study("out", &[K, TORQUE], &["--samples", "20"]);
    done(&output);
    let said = said(&output);
    for points in ["of 8 of 20 points", "of 16 of 20 points", "of 20 of 20 points"] {
        assert_eq!(said.matches(points).count(), 1, "{points}: {said}");
    }
    let record = json(&bench.out("out").join("uncertainty.json"));
    assert_eq!((&record["runs"], &record["runs_asked"]), (&json!(80), &json!(80)));
}

/// The record without what may differ between two starts.
fn timeless(out: &Path) -> Value {
    let mut record = json(&out.join("uncertainty.json"));
    record["wall_s"] = Value::Null;
    record["threads"] = Value::Null;
    record
}

fn output<'a>(record: &'a Value, name: &str) -> &'a Value {
    record["outputs"].as_array().unwrap().iter().find(|one| one["output"] == name).unwrap()
}

#[test]
fn a_study_is_written_and_threads_change_nothing() {
    let bench = Bench::new();
    let more = |threads: &'static str| ["--samples", "32", "--limit", "pinion.peak_wear_um=5", "--threads", threads];
    done(&bench.study("one", &[K, TORQUE], &more("1")));
    done(&bench.study("two", &[K, TORQUE], &more("2")));
    assert_eq!(timeless(&bench.out("one")), timeless(&bench.out("two")));
    for file in ["samples.csv", "columns.json", "scene.toml"] {
        assert_eq!(fs::read(bench.out("one").join(file)).unwrap(), fs::read(bench.out("two").join(file)).unwrap());
    }
    let record = timeless(&bench.out("one"));
    assert_eq!((record["samples"].as_u64(), record["runs"].as_u64()), (Some(32), Some(32 * 4)));
    let peak = output(&record, "pinion.peak_wear_um");
    let quantile = |name: &str| peak["quantiles"][name].as_f64().unwrap();
    assert!(quantile("p05") < quantile("p50") && quantile("p50") < quantile("p95"));
    assert_eq!(peak["indices"].as_array().unwrap()[0]["factor"], "wear.coefficient_m2_per_N");
    assert_eq!(record["bands"]["pinion"]["quantiles_um"].as_array().unwrap().len(), 5);
    // 32 points of four runs each, and the names.
    let table = fs::read_to_string(bench.out("one").join("samples.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 32 * 4);
    let page = fs::read_to_string(bench.out("one").join("report.html")).unwrap();
    assert!(
        page.contains("Sobol indices")
            && page.contains("Quantiles")
            && page.contains("Wear over the flank of the pinion")
    );
    // Another seed is another sample.
    done(&bench.study("seed", &[K, TORQUE], &["--samples", "32", "--seed", "2"]));
    assert_ne!(output(&timeless(&bench.out("seed")), "pinion.peak_wear_um")["mean"], peak["mean"]);
}

/// Most samples are read off a response surface of the others, with the errors that are said, and are marked so; `--run-all` goes on with the same journal, and
/// runs them all.
#[test]
fn most_samples_are_read_off_a_response_surface() {
    let bench = Bench::new();
    let samples = ["--samples", "256"];
    done(&bench.study("out", &[K, TORQUE], &samples));
    let found = timeless(&bench.out("out"));
    let of = &found["response_surface"];
    let [run, read_off] = ["run", "read_off"].map(|key| of[key].as_u64().unwrap());
    assert!(run + read_off == 1024 && (64..512).contains(&run), "{of}");
    assert_eq!((&found["runs"], &found["no_response_surface_because"]), (&json!(1024), &Value::Null));
    let journal = fs::read_to_string(bench.out("out").join("rows.jsonl")).unwrap();
    assert_eq!(journal.lines().count() as u64, 1 + run);
    let values = |name: &str, column: &str| -> Vec<String> {
        let table = fs::read_to_string(bench.out(name).join("samples.csv")).unwrap();
        let at = table.lines().next().unwrap().split(',').position(|heading| heading == column).unwrap();
        table.lines().skip(1).map(|line| line.split(',').nth(at).unwrap().to_owned()).collect()
    };
    let source = values("out", "source");
    assert_eq!(source.iter().filter(|source| *source == "response surface").count() as u64, read_off);
    let peaks = values("out", "pinion.peak_wear_um");

    done(&bench.study("out", &[K, TORQUE], &[&samples[..], &["--run-all"]].concat()));
    done(&bench.study("all", &[K, TORQUE], &[&samples[..], &["--run-all"]].concat()));
    let all = timeless(&bench.out("all"));
    assert_eq!(timeless(&bench.out("out")), all);
    assert_eq!(all["response_surface"], Value::Null);
    assert!(all["no_response_surface_because"].as_str().unwrap().contains("asked to be run"));
    for name in ["pinion.peak_wear_um", "wheel.peak_wear_um", "worn.transmission_error_um.peak_to_peak"] {
        let [one, other] = [&found, &all].map(|record| output(record, name));
        let [deviation, error] =
            [&other["standard_deviation"], &one["response_surface_error"]].map(|of| of.as_f64().unwrap());
        assert!(error <= 0.05 && other["response_surface_error"].is_null(), "{name}: {error}");
        for quantile in ["p05", "p25", "p50", "p75", "p95"] {
            let [one, other] = [one, other].map(|of| of["quantiles"][quantile].as_f64().unwrap());
            assert!((one - other).abs() < 0.02 * deviation, "{name}, {quantile}: {one} and {other}");
        }
    }
    let of_all = values("all", "pinion.peak_wear_um");
    let both = peaks.iter().zip(&of_all).zip(&source).map(|((one, other), source)| {
        let [one, other]: [f64; 2] = [one, other].map(|value| value.parse().unwrap());
        (one - other, source == "run")
    });
    let both: Vec<(f64, bool)> = both.collect();
    assert!(both.iter().all(|(difference, is_run)| !is_run || *difference == 0.0));
    let squares: f64 = both.iter().map(|(difference, _)| difference * difference).sum();
    let missed = (squares / read_off as f64).sqrt();
    let of_peaks = output(&found, "pinion.peak_wear_um");
    let said = of_peaks["response_surface_error"].as_f64().unwrap() * of_peaks["standard_deviation"].as_f64().unwrap();
    assert!(missed < 1.5 * said, "{missed} for {said}");
}

/// A journal that ends within samples that share a run has them run again before a surface is fitted: the study ends with the same bytes. What takes few
/// runs says so.
#[test]
fn a_surface_is_the_same_after_a_break_within_a_run() {
    let bench = Bench::new();
    let scene = coarse_scene().replace("step = { revolutions = 200000.0 }", "step = \"adaptive\"");
    fs::write(bench.out("scene.toml"), scene).unwrap();
    let samples = ["--samples", "128", "--threads", "1"];
    done(&bench.study("whole", &[K, TORQUE], &samples));
    let journal = fs::read_to_string(bench.out("whole").join("rows.jsonl")).unwrap();
    // Of samples in pairs an odd number.
    let half: Vec<&str> = journal.lines().take(1 + 83).collect();
    fs::create_dir(bench.out("again")).unwrap();
    fs::write(bench.out("again").join("rows.jsonl"), half.join("\n") + "\n").unwrap();
    done(&bench.study("again", &[K, TORQUE], &samples));
    let [whole, again] = ["whole", "again"].map(|name| timeless(&bench.out(name)));
    assert!(whole["response_surface"]["run"].as_u64().unwrap() < 256, "{}", whole["response_surface"]);
    assert_eq!(again["response_surface"], whole["response_surface"]);
    assert_eq!(again, whole);
    let table = |name: &str| fs::read(bench.out(name).join("samples.csv")).unwrap();
    assert_eq!(table("again"), table("whole"));

    let correlation = "operation.pinion_torque_Nm:wear.coefficient_m2_per_N=0.8";
    done(&bench.study("few", &[K, TORQUE], &["--samples", "8", "--correlation", correlation]));
    let because = &timeless(&bench.out("few"))["no_response_surface_because"];
    assert!(because.as_str().unwrap().contains("fewer than 64 runs"), "{because}");
}

/// Wear within the first steps is proportional to k, so that its quantiles are those of k, and k alone explains all of it. The median of
/// a lognormal k is the scene's own value.
#[test]
fn ver_linear_wear_has_the_distribution_of_k() {
    let bench = Bench::new();
    let tiny = "wear.coefficient_m2_per_N=lognormal:1e-21:1.3";
    done(&bench.study("tiny", &[tiny], &["--samples", "256"]));
    let record = timeless(&bench.out("tiny"));
    let peak = output(&record, "pinion.peak_wear_um");
    let quantile = |name: &str| peak["quantiles"][name].as_f64().unwrap();
    // Φ⁻¹(0.95) = 1.6449
    let expected = 1.3_f64.powf(1.6449);
    assert!((quantile("p95") / quantile("p50") / expected - 1.0).abs() < 0.02, "{}", quantile("p95") / quantile("p50"));
    let index = &peak["indices"][0];
    assert!((index["first"]["value"].as_f64().unwrap() - 1.0).abs() < 0.02, "{index}");
    assert!((index["total"]["value"].as_f64().unwrap() - 1.0).abs() < 0.02, "{index}");
    // σ/μ of a lognormal is √(exp σ² − 1), σ = ln 1.3.
    let variation = peak["standard_deviation"].as_f64().unwrap() / peak["mean"].as_f64().unwrap();
    let closed_form = (1.3_f64.ln().powi(2).exp() - 1.0).sqrt();
    assert!((variation / closed_form - 1.0).abs() < 0.03, "{variation} for {closed_form}");
}

#[test]
fn failed_samples_censored_lives_and_correlations_are_said() {
    let bench = Bench::new();
    // A third of these torques is negative.
    let bad = "operation.pinion_torque_Nm=uniform:-100:200";
    done(&bench.study("bad", &[bad, K], &["--samples", "32", "--limit", "pinion.peak_wear_um=1e6"]));
    let record = timeless(&bench.out("bad"));
    assert!(record["failed"].as_u64().unwrap() > 0 && record["first_failure"].as_str().unwrap().contains("torque"));
    let life = output(&record, "life.pinion.peak_wear_um=1000000");
    assert_eq!((life["censored"].as_f64(), life["quantiles"]["p50"].as_f64()), (Some(1.0), None));
    assert!(life["no_indices_because"].as_str().unwrap().contains("longer"));

    let correlation = "operation.pinion_torque_Nm:wear.coefficient_m2_per_N=0.8";
    done(&bench.study("correlated", &[K, TORQUE], &["--samples", "32", "--correlation", correlation]));
    let record = timeless(&bench.out("correlated"));
    let peak = output(&record, "pinion.peak_wear_um");
    assert!(peak["indices"].is_null() && peak["quantiles"]["p50"].is_f64());
    assert!(peak["no_indices_because"].as_str().unwrap().contains("correlated"));
    assert_eq!(record["runs"].as_u64(), Some(64));
}

#[test]
fn bad_input_is_refused() {
    let bench = Bench::new();
    refused(&bench.study("out", &["pair.face_widht_mm=±1%"], &[]), &["face_widht_mm", "KEY=DISTRIBUTION"]);
    refused(&bench.study("out", &[K], &["--outputs", "pinion.peak_ware_um"]), &["did you mean pinion.peak_wear_um?"]);
    refused(&bench.study("out", &[K], &["--limit", "pinion.peak_wear=1"]), &["did you mean pinion.peak_wear_um?"]);
    refused(&bench.study("out", &[K], &["--correlation", "a:b=0.5"]), &["wear.coefficient_m2_per_N"]);
    refused(&bench.study("out", &["operation.phases.1.hours=uniform:1:2"], &[]), &["operation.phases.1.hours"]);
    assert!(!bench.out("out").exists());
}

/// A study that was stopped goes on to the same bytes with the runs that are missing, whatever the last line of its journal; another study is refused
/// with `--resume` and replaced without.
#[test]
fn a_study_goes_on_where_it_was_stopped() {
    let bench = Bench::new();
    let samples = ["--samples", "16"];
    done(&bench.study("whole", &[K, TORQUE], &samples));
    let journal = fs::read_to_string(bench.out("whole").join("rows.jsonl")).unwrap();
    assert_eq!(journal.lines().count(), 1 + 16 * 4);
    let half: Vec<&str> = journal.lines().take(1 + 30).collect();
    let stopped = |name: &str| {
        fs::create_dir(bench.out(name)).unwrap();
        fs::write(bench.out(name).join("rows.jsonl"), format!("{}\n{{\"number\":3", half.join("\n"))).unwrap();
    };
    stopped("resumed");
    let resume = |name: &str, uncertain: &[&str]| {
        let mut command = gearwear();
        command.arg("uncertainty").arg(bench.out("scene.toml")).arg("--resume").arg(bench.out(name)).args(samples);
        command.args(uncertain.iter().flat_map(|one| ["--uncertain", one]));
        command.output().unwrap()
    };
    let resumed = resume("resumed", &[K, TORQUE]);
    done(&resumed);
    assert!(said(&resumed).contains("30 runs were finished before"), "{}", said(&resumed));
    stopped("again");
    done(&bench.study("again", &[K, TORQUE], &samples));
    for name in ["resumed", "again"] {
        assert_eq!(timeless(&bench.out(name)), timeless(&bench.out("whole")));
        for file in ["samples.csv", "columns.json"] {
            assert_eq!(fs::read(bench.out(name).join(file)).unwrap(), fs::read(bench.out("whole").join(file)).unwrap());
        }
    }
    let other = ["another study of uncertainty", "what is uncertain"];
    refused(&resume("resumed", &[K]), &["--resume", other[0], other[1]]);
    refused(&bench.study("resumed", &[K], &samples), &["--out", other[0], other[1]]);
    refused(&resume("nowhere", &[K]), &["--resume", "holds no study of uncertainty"]);
    assert!(bench.out("resumed").join("uncertainty.json").exists() && !bench.out("nowhere").exists());
    assert_eq!(fs::read(bench.out("resumed").join("rows.jsonl")).unwrap().len(), journal.len());
    // More samples go on with the same sequence.
    done(&bench.study("again", &[K, TORQUE], &["--samples", "32"]));
    done(&bench.study("more", &[K, TORQUE], &["--samples", "32"]));
    assert_eq!(timeless(&bench.out("again")), timeless(&bench.out("more")));
}

/// What no study wrote is refused with its line and stays as it is; a last line that was cut short is dropped, even within a letter.
#[test]
fn a_damaged_journal_is_refused_and_kept() {
    let bench = Bench::new();
    // On one thread the runs are finished in their order.
    let samples = ["--samples", "8", "--threads", "1"];
    done(&bench.study("out", &[K, TORQUE], &samples));
    let path = bench.out("out").join("rows.jsonl");
    let whole = fs::read_to_string(&path).unwrap();
    let shorter = |line: &str| {
        let mut row: Value = serde_json::from_str(line).unwrap();
        row["ran"]["Ok"]["wear_um"]["pinion"].as_array_mut().unwrap().truncate(5);
        row.to_string()
    };
    let lines: Vec<&str> = whole.lines().collect();
    for (damaged, part) in [
        (whole.replacen(lines[2], "nothing", 1), "line 3"),
        (whole.replacen(lines[1], &shorter(lines[1]), 1), "run 0 of another study"),
    ] {
        fs::write(&path, &damaged).unwrap();
        refused(&bench.study("out", &[K, TORQUE], &samples), &[part, "gearwear uncertainty wrote"]);
        assert_eq!(fs::read_to_string(&path).unwrap(), damaged);
    }
    let cut = [whole.as_bytes(), b"{\"number\":400,\"ran\":{\"Err\":\"\xc2"].concat();
    fs::write(&path, cut).unwrap();
    done(&bench.study("out", &[K, TORQUE], &samples));
    assert_eq!(fs::read_to_string(&path).unwrap(), whole);
}

/// The coefficient of the one phase is the one that counts: runs that share it have the wear of runs of their own, and a coefficient that a phase
/// overrides changes nothing.
#[test]
fn shared_runs_follow_the_coefficient_of_the_phase() {
    let bench = Bench::new();
    let scene = coarse_scene()
        .replace("step = { revolutions = 200000.0 }", "step = \"adaptive\"")
        .replace("hours = 127.75 ", "# hours")
        .replace("[contact]", "[[operation.phases]]\nhours = 127.75\ncoefficient_m2_per_N = 2e-17\n[contact]");
    fs::write(bench.out("scene.toml"), scene).unwrap();
    let peaks = |name: &str, key: &str, more: &[&str]| -> Vec<f64> {
        let uncertain = format!("{key}=uniform:1e-17:3e-17");
        done(&bench.study(name, &[&uncertain], &[&["--samples", "4"], more].concat()));
        let table = fs::read_to_string(bench.out(name).join("samples.csv")).unwrap();
        let at = table.lines().next().unwrap().split(',').position(|name| name == "pinion.peak_wear_um").unwrap();
        table.lines().skip(1).map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
    };
    let alone = ["--limit", "pinion.peak_wear_um=1e6"];
    let of_phase = "operation.phases.1.coefficient_m2_per_N";
    let (shared, own) = (peaks("shared", of_phase, &[]), peaks("own", of_phase, &alone));
    assert!(shared.iter().zip(&own).all(|(a, b)| (a - b).abs() < 0.05), "{shared:?} and {own:?}");
    assert!(own.iter().copied().fold(0.0, f64::max) > 1.5 * own.iter().copied().fold(f64::INFINITY, f64::min));
    let overridden = peaks("overridden", "wear.coefficient_m2_per_N", &[]);
    assert!(overridden.iter().all(|peak| (peak - overridden[0]).abs() < 1e-9), "{overridden:?}");
}

/// Of the coefficient alone a group of points shares a run, whose figures do not depend on how many points are asked for.
#[test]
fn fewer_samples_are_the_first_of_more() {
    let bench = Bench::new();
    let scene = coarse_scene().replace("step = { revolutions = 200000.0 }", "step = \"adaptive\"");
    fs::write(bench.out("scene.toml"), scene).unwrap();
    done(&bench.study("many", &[K], &["--samples", "40"]));
    done(&bench.study("many", &[K], &["--samples", "10"]));
    done(&bench.study("few", &[K], &["--samples", "10"]));
    let table = |name: &str| fs::read(bench.out(name).join("samples.csv")).unwrap();
    assert_eq!(table("many"), table("few"));
}

/// Samples that differ in their coefficient alone share a run, and have the same figures as runs of their own: these have a limit, which is not shared.
/// A calibrated foundation stands for finite elements where, corrected as given, it changes the figures of the scene as given little, and says so.
#[test]
fn samples_share_runs_on_a_fast_model() {
    let bench = Bench::new();
    let scene = exchanged(
        "fzg-c",
        &[
            ("flank_points = 750 ", "flank_points = 250 "),
            ("positions = 400 ", "positions = 80 "),
            ("verify = true", "verify = false"),
        ],
    );
    fs::write(bench.out("scene.toml"), scene + "\n[fem]\nelements_per_half_width = 4\n").unwrap();
    let samples = ["--samples", "16"];
    done(&bench.study("shared", &[K, TORQUE], &samples));
    done(&bench.study("alone", &[K, TORQUE], &["--samples", "16", "--limit", "pinion.peak_wear_um=1e6"]));
    done(&bench.study("own", &[K, TORQUE], &["--samples", "2", "--own-surface"]));
    let [shared, alone, own] = ["shared", "alone", "own"].map(|name| timeless(&bench.out(name)));
    assert_eq!((&shared["surface"]["surface"], &own["surface"]["surface"]), (&"winkler".into(), &"fem".into()));
    for name in ["pinion.peak_wear_um", "wheel.peak_wear_um", "worn.transmission_error_um.peak_to_peak"] {
        let [one, other, on_own] = [&shared, &alone, &own].map(|record| output(record, name));
        for quantile in ["p05", "p50", "p95"] {
            // The step error of 0.05 µm.
            let [one, other] = [one, other].map(|of| of["quantiles"][quantile].as_f64().unwrap());
            assert!((one - other).abs() < 0.05, "{name}, {quantile}: {one} and {other}");
        }
        let difference = one["surface_difference"].as_f64().unwrap();
        assert!(
            difference > 0.0 && difference <= 0.05 && on_own["surface_difference"].is_null(),
            "{name}: {difference}"
        );
    }
    // Without verification the difference alone is the error that samples vary, evenly: y = c y_model (1 + d (2 u - 1)).
    let of_run = fs::read_to_string(bench.out("shared").join("rows.jsonl")).unwrap();
    let of_run = of_run.lines().find(|line| line.starts_with("{\"number\":0,")).unwrap();
    let of_run: Value = serde_json::from_str(of_run).unwrap();
    let table = fs::read_to_string(bench.out("shared").join("samples.csv")).unwrap();
    let column = |name: &str| -> f64 {
        let at = table.lines().next().unwrap().split(',').position(|heading| heading == name).unwrap();
        table.lines().nth(1).unwrap().split(',').nth(at).unwrap().parse().unwrap()
    };
    let of = |key: &str| output(&shared, "pinion.peak_wear_um")[key].as_f64().unwrap();
    let (correction, difference) = (of("surface_correction"), of("surface_difference"));
    assert!(correction != 1.0 && (correction - 1.0).abs() < 0.05, "{correction}");
    let on_foundation = of_run["ran"]["Ok"]["outputs"][0]["value"].as_f64().unwrap();
    let varied = correction * on_foundation * (1.0 + difference * column("model_error"));
    assert!((column("pinion.peak_wear_um") / varied - 1.0).abs() < 1e-12, "{varied}");
}
