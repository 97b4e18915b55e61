//! `gearwear compare RUN --history TABLE`: what it writes, what it says, and what it refuses: exit status 2, one message with file, line, what was
//! found and what is allowed, and nothing written.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use assert_cmd::Command;

use crate::coarse_run::{finished_run, scene};
use crate::program::json;

fn gearwear() -> Command {
    Command::cargo_bin("gearwear").unwrap()
}

/// A finished run that all tests share and none changes.
fn shared_run() -> PathBuf {
    static RUN: OnceLock<tempfile::TempDir> = OnceLock::new();
    RUN.get_or_init(|| finished_run(&scene("42.0, 84.0"))).path().join("run")
}

/// A folder with a table.
struct Measured {
    folder: tempfile::TempDir,
}

impl Measured {
    fn new(table: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("weighed.csv"), table).unwrap();
        Self { folder }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    fn compare(&self, run: &Path, options: &[&str]) -> Command {
        let mut command = gearwear();
        command.arg("compare").arg(run).arg("--history").arg(self.folder.path().join("weighed.csv"));
        command.arg("--out").arg(self.out()).args(options);
        command
    }

    /// It must be refused with all of `words`, and leave nothing behind.
    fn refused(&self, run: &Path, options: &[&str], words: &[&str]) {
        let output = self.compare(run, options).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(output.stdout.is_empty() && !self.out().exists(), "something was left behind");
        for word in words.iter().chain(&["allowed: "]) {
            assert!(message.contains(word), "no {word:?} in {message}");
        }
    }
}

fn figure(run: &Path, path: &str) -> f64 {
    let mut value = &json(&run.join("summary.json"));
    for key in path.split('.') {
        value = &value[key];
    }
    value.as_f64().unwrap()
}

/// Depths of the pinion after 42 and 84 hours, measured after 30 and 60 on two teeth: 1.4 times the coefficient of the run, and what is left to the
/// wear of the whole run 127.75/1.4 − 60 hours. Masses of the wheel as the run has them.
#[test]
fn it_finds_coefficient_and_life_of_both_gears_and_writes_everything() {
    let run = shared_run();
    let history = fs::read_to_string(run.join("history.csv")).unwrap();
    let names: Vec<&str> = history.lines().next().unwrap().split(',').collect();
    let at = names.iter().position(|name| *name == "pinion_peak_wear_um").unwrap();
    let depths: Vec<f64> =
        history.lines().skip(1).map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect();
    let mass = figure(&run, "wheel.worn_mass_mg");
    let rows: String = [(30.0, depths[0]), (60.0, depths[1])]
        .map(|(hours, depth)| {
            let teeth = format!("{hours};pinion;{};;1\n{hours};pinion;{};;2\n", 0.98 * depth, 1.02 * depth);
            format!("{teeth}{hours};wheel;;{};\n", mass * hours / 127.75)
        })
        .concat();
    let table = Measured::new(&format!("hours;gear;depth_um;mass_loss_mg;tooth\n{rows}"));
    let limits = [format!("pinion.peak_wear_um={}", depths[2]), "wheel.worn_volume_mm3=20".to_owned()];
    let options = ["--limit", &limits[0], "--limit", &limits[1]];
    let output = table.compare(&run, &options).output().unwrap();
    let (said, stderr) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(0), "{said}{stderr}");
    for words in [
        "pinion: k of the run",
        "hours left until pinion.peak_wear_um",
        "wheel: k of",
        "hours, 95 % ",
        "life in all: ",
        "The interval of k is of the forecast",
        "report.html",
        "2 runs of the scene",
    ] {
        assert!(said.contains(words), "no {words:?} in {said}");
    }
    let record = json(&table.out().join("remaining_life.json"));
    let [pinion, wheel] = [0, 1].map(|index| &record["gears"][index]);
    assert_eq!((pinion["gear"].as_str(), wheel["gear"].as_str()), (Some("pinion"), Some("wheel")));
    assert_eq!(pinion["measurements"][0]["count"], 2);
    assert_eq!(pinion["measurements"][0]["lines"], serde_json::json!([2, 3]));
    let last = &pinion["updates"][2];
    let within = |interval: &serde_json::Value, truth: f64, near: f64| {
        let [low, median, high] = ["low", "median", "high"].map(|key| interval[key].as_f64().unwrap());
        assert!(low < truth && truth < high && (median / truth - 1.0).abs() < near, "{interval} {truth}");
    };
    within(&last["coefficient_m2_per_N"], 1.4e-17, 0.05);
    within(&last["life"]["remaining_hours"], 127.75 / 1.4 - 60.0, 0.15);
    within(&last["life"]["total_hours"], 127.75 / 1.4, 0.06);
    for (left, total, at) in
        [("remaining_hours", "total_hours", 60.0), ("remaining_revolutions", "total_revolutions", 5.4e5)]
    {
        for end in ["low", "median", "high"] {
            let [left, total] = [left, total].map(|key| last["life"][key][end].as_f64().unwrap());
            assert!((total - left - at).abs() < 1e-9 * total, "{total} {left}");
        }
    }
    assert!(record["other_gear"].is_null(), "both were measured");
    within(&wheel["updates"][2]["coefficient_m2_per_N"], 1e-17, 0.05);
    assert_eq!(last["later"].as_array().map(Vec::len), Some(0));
    assert_eq!(pinion["updates"][0]["later"].as_array().map(Vec::len), Some(2));
    for (file, rows) in [("remaining_life.csv", 6), ("predictions.csv", 6)] {
        let text = fs::read_to_string(table.out().join(file)).unwrap();
        assert_eq!(text.lines().count(), 1 + rows, "{file}: {text}");
    }
    let columns = json(&table.out().join("columns.json"));
    assert!(columns["files"]["predictions.csv"]["below_found"].as_str().unwrap().contains("probability"));
    let page = fs::read_to_string(table.out().join("report.html")).unwrap();
    for words in [
        "Wear of the pinion, measured and to come",
        "Remaining life of the wheel",
        "limit passed",
        "is its life in all",
    ] {
        assert!(page.contains(words), "no {words:?} on the page");
    }
}

/// Without a word the wheel wears with the k of the pinion, since one law is both gears'; with --other-k by a number, or as a comparison with the run fitted it.
#[test]
fn the_gear_that_was_not_measured_has_a_coefficient() {
    let table = Measured::new("# gear = pinion\nhours,depth_um\n20,2.6\n60,7.0\n");
    // A copy of the run, for its comparison.
    let run = table.folder.path().join("run");
    fs::create_dir(&run).unwrap();
    for file in ["summary.json", "scene.toml", "profiles.csv", "pinion.csv", "wheel.csv"] {
        fs::copy(shared_run().join(file), run.join(file)).unwrap();
    }
    let found = |options: &[&str]| {
        let output = table.compare(&run, options).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let record = json(&table.out().join("remaining_life.json"));
        (String::from_utf8(output.stdout).unwrap(), record)
    };
    let (said, record) = found(&[]);
    assert!(
        said.contains("The wheel, not measured, wears with the k of the pinion") && said.contains("--other-k"),
        "{said}"
    );
    let k = &record["gears"][0]["updates"][2]["coefficient_m2_per_N"]["median"];
    assert_eq!(
        (&record["other_gear"]["source"], &record["other_gear"]["coefficient_m2_per_N"]),
        (&"measured-gear".into(), k)
    );

    let text = fs::read_to_string(run.join("wheel.csv")).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let [radius, wear] = ["radius_mm", "wear_um"].map(|name| names.iter().position(|n| *n == name).unwrap());
    let rows = |gear: &str, radii: std::ops::Range<f64>, factor: f64| {
        let text = fs::read_to_string(run.join(format!("{gear}.csv"))).unwrap();
        let rows = text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let inside = rows.filter(|row| radii.contains(&row[radius].parse().unwrap()));
        let points: String =
            inside.map(|row| format!("{},{}\n", row[radius], factor * row[wear].parse::<f64>().unwrap())).collect();
        let file = table.folder.path().join(format!("{gear}.csv"));
        fs::write(&file, format!("# gear = {gear}\nradius_mm,wear_um\n{points}")).unwrap();
        file
    };
    let [pinion, wheel] = [rows("pinion", 34.2..41.1, 1.2), rows("wheel", 52.0..59.0, 0.6)];
    gearwear().arg("compare").arg(&run).args([&pinion, &wheel]).assert().success();
    let fitted = run.join("compare/pinion-wheel");
    let (said, _) = found(&[]);
    assert!(said.contains(&format!("Fitted k of the wheel: --other-k {}", fitted.display())), "{said}");
    let of_wheel = json(&fitted.join("compare.json"))["fit"]["coefficients"][1].clone();
    assert_eq!(of_wheel["gear"], "wheel");
    let k = of_wheel["coefficient_m2_per_N"]["value"].as_f64().unwrap();
    assert!(k < 0.8e-17, "{k}");
    let (said, by_folder) = found(&["--other-k", fitted.to_str().unwrap()]);
    let (_, by_number) = found(&["--other-k", &format!("{k:e}")]);
    assert!(said.contains("as --other-k says"), "{said}");
    assert_eq!(by_folder["other_gear"]["source"], "given");
    let of = |record: &serde_json::Value| record["other_gear"]["coefficient_m2_per_N"].as_f64().unwrap();
    assert!((of(&by_folder) / k - 1.0).abs() < 1e-12 && (of(&by_number) / k - 1.0).abs() < 1e-12);
    // Less wear of the wheel leaves the pinion another pressure, and so another coefficient.
    let median = |record: &serde_json::Value| {
        record["gears"][0]["updates"][2]["coefficient_m2_per_N"]["median"].as_f64().unwrap()
    };
    let moved = median(&by_folder) / median(&record) - 1.0;
    assert!(moved.abs() > 1e-3 && moved.abs() < 0.2, "{moved}");

    let both = "# uncertain\nhours,gear,depth_um\n20,pinion,2.6\n20,wheel,2.0\n";
    Measured::new(both).refused(&run, &["--other-k", "1e-17"], &["--other-k", "both gears"]);
    let one = || Measured::new("# gear = pinion\nhours,depth_um\n20,2.6\n");
    one().refused(&run, &["--other-k", "0"], &["--other-k", "found 0"]);
    one().refused(&run, &["--other-k", "/nowhere"], &["--other-k", "/nowhere/compare.json"]);
}

/// The same bits again, on any number of threads.
#[test]
fn the_same_again_on_any_number_of_threads() {
    let run = shared_run();
    let table = Measured::new("# gear = pinion\nhours,mass_loss_mg\n20,60\n60,170\n");
    let written = ["1", "2"].map(|threads| {
        table.compare(&run, &["--quiet", "--threads", threads]).assert().success();
        ["remaining_life.json", "predictions.csv", "report.html"].map(|name| fs::read(table.out().join(name)).unwrap())
    });
    assert_eq!(written[0], written[1]);
}

/// A profile of the run's own wear times 1.4 is that of a coefficient 1.4 times as great; a limit that was passed leaves no life.
#[test]
fn profiles_give_coefficients_and_a_passed_limit_leaves_no_life() {
    let run = shared_run();
    let text = fs::read_to_string(run.join("pinion.csv")).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let [radius, wear] = ["radius_mm", "wear_um"].map(|name| names.iter().position(|n| *n == name).unwrap());
    let points = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>()).filter(|row| {
        let radius: f64 = row[radius].parse().unwrap();
        (34.2..41.1).contains(&radius)
    });
    let mut sign = 1.0;
    let rows: String = points
        .map(|row| {
            sign = -sign;
            format!("{},{}\n", row[radius], 1.4 * row[wear].parse::<f64>().unwrap() + 0.05 * sign)
        })
        .collect();
    let table = Measured::new("# gear = pinion\nhours,profile\n127.75,trace.csv\n");
    fs::write(table.folder.path().join("trace.csv"), format!("radius_mm,wear_um\n{rows}")).unwrap();
    table.compare(&run, &["--quiet", "--limit", "pinion.peak_wear_um=1"]).assert().success();
    let record = json(&table.out().join("remaining_life.json"));
    let pinion = &record["gears"][0];
    let mean = pinion["measurements"][0]["mean_coefficient_m2_per_N"].as_f64().unwrap();
    assert!((mean / 1.4e-17 - 1.0).abs() < 0.05, "{mean}");
    let life = &pinion["updates"][1]["life"];
    assert!(life["passed"].as_f64().unwrap() > 0.99 && life["remaining_revolutions"]["median"] == 0.0, "{life}");
    let shifted = Measured::new("# gear = pinion\nhours,profile\n\n127.8,trace.csv\n");
    shifted.refused(&run, &[], &["weighed.csv", "line 4", "profile", "the end of the run"]);
    let missing = Measured::new("# gear = pinion\nhours,profile\n100,nothing.csv\n");
    missing.refused(&run, &[], &["weighed.csv", "line 3", "nothing.csv"]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let run = shared_run();
    let weighed = || Measured::new("# gear = pinion\nhours,mass_loss_g\n20,0.06\n");
    Measured::new("hours,depth_um\n20,3\n").refused(
        &run,
        &[],
        &["weighed.csv", "line 2", "gear: found none", "--gear"],
    );
    weighed().refused(&run, &["--gear", "wheel"], &["line 3", "found pinion, and --gear wheel"]);
    Measured::new("# gear = pinion\nhours,depth_um\n20,-3\n").refused(
        &run,
        &[],
        &["weighed.csv", "line 3", "depth_um", "found -3"],
    );
    weighed().refused(
        &run,
        &["--limit", "wheel.peak_wear_um=3"],
        &["--limit", "found wheel.peak_wear_um", "pinion.peak_wear_um"],
    );
    // A gram for a milligram: a run of 50 times the revolutions does not come to it.
    Measured::new("# gear = pinion\nhours,mass_loss_g\n20,600\n").refused(
        &run,
        &[],
        &["pinion.worn_mass_mg", "found 600000", "up to 50 times the run"],
    );
    weighed().refused(Path::new("/nowhere"), &[], &["RUN", "summary.json"]);
    let refused = |options: &[&str], words: &[&str]| {
        let table = weighed();
        let output = table.compare(&run, options).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && !table.out().exists(), "{message}");
        assert!(words.iter().all(|word| message.contains(word)), "{words:?} in {message}");
    };
    refused(&["--limit", "pinion.root_wear_um=3"], &["--limit", "allowed: FIGURE=VALUE", "pinion.worn_mass_mg"]);
    refused(&["--prior", "wet"], &["--prior", "regime-2", "LOW:HIGH"]);
    refused(&["--fit", "k"], &["--fit", "--history"]);

    let phases = scene("42.0, 84.0").replace("hours = 127.75\nsnapshots_h = [42.0, 84.0]\n", "").replace(
        "[contact]",
        "[[operation.phases]]\nhours = 60.0\n[[operation.phases]]\nhours = 60.0\npinion_torque_Nm = 200.0\n[contact]",
    );
    let folder = finished_run(&phases);
    weighed().refused(&folder.path().join("run"), &[], &["operation.phases", "found 2", "allowed: one"]);
}

/// Where the scene has a limit, that one ends the life; without a speed times are revolutions.
#[test]
fn the_limit_of_the_scene_and_no_speed() {
    let stop = scene("42.0, 84.0").replace(
        "pinion_speed_rpm = 150.0\nhours = 127.75\nsnapshots_h = [42.0, 84.0]\n",
        "pinion_revolutions = 1.15e6\nstop = { wear_um = 100.0 }\n",
    );
    let folder = finished_run(&stop);
    let run = folder.path().join("run");
    let table = Measured::new("# gear = pinion\nrevolutions,depth_um\n3e5,3\n6e5,6.5\n");
    let output = table.compare(&run, &[]).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("revolutions left until pinion.peak_wear_um = 100"), "{said}");
    assert!(json(&table.out().join("remaining_life.json"))["gears"][0]["updates"][2]["hours"].is_null());
    let hours = Measured::new("# gear = pinion\nhours,depth_um\n20,3\n");
    hours.refused(&run, &[], &["line 3", "hours", "found 20", "revolutions"]);
}
