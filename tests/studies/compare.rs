//! `gearwear compare`: what it writes, what it says, and what it refuses: exit status 2, one message with file, line, what was
//! found and what is allowed, and nothing written.

use std::fs;
use std::ops::Range;
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
    RUN.get_or_init(|| finished_run(&scene("31.75"))).path().join("run")
}

/// Columns of a CSV file by name.
fn column(path: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let index = lines.next().unwrap().split(',').position(|n| n == name).unwrap_or_else(|| panic!("{name}"));
    lines.map(|line| line.split(',').nth(index).unwrap().parse().unwrap()).collect()
}

/// A measured file of the run's own wear times `factor`, every point of the active flank of the pinion.
fn measured(run: &Path, header: &str, factor: f64) -> String {
    // Radii of the start of active profile and of the tip: 34.1233 and 41.23 mm.
    of_flank(&run.join("pinion.csv"), 34.2..41.1, header, factor)
}

/// The same of the wheel.
fn measured_wheel(run: &Path, header: &str, factor: f64) -> String {
    // Between the wheel's start of active profile, 51.69 mm, and its tip, 59.18 mm.
    of_flank(&run.join("wheel.csv"), 52.0..59.0, header, factor)
}

fn of_flank(flank: &Path, radii: Range<f64>, header: &str, factor: f64) -> String {
    let rows = column(flank, "radius_mm").into_iter().zip(column(flank, "wear_um"));
    let rows: String =
        rows.filter(|(r, _)| radii.contains(r)).map(|(r, wear)| format!("{r},{}\n", -factor * wear)).collect();
    format!("{header}radius_mm,height_um\n{rows}")
}

/// A folder with a measured file.
struct Trace {
    folder: tempfile::TempDir,
}

impl Trace {
    fn new(text: impl AsRef<[u8]>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("trace.csv"), text).unwrap();
        Self { folder }
    }

    fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// Beside it another one, `other.csv`.
    fn and(self, text: impl AsRef<[u8]>) -> Self {
        fs::write(self.other(), text).unwrap();
        self
    }

    fn other(&self) -> PathBuf {
        self.folder.path().join("other.csv")
    }

    fn compare(&self, run: &Path, options: &[&str]) -> Command {
        let mut command = gearwear();
        command.arg("compare").arg(run).arg(self.folder.path().join("trace.csv"));
        command.args(self.other().exists().then(|| self.other())).arg("--out").arg(self.out());
        command.args(options);
        command
    }

    /// The comparison must be refused with all of `words`, and leave nothing behind.
    fn refused(&self, run: &Path, options: &[&str], words: &[&str]) {
        let output = self.compare(run, options).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(output.stdout.is_empty() && !self.out().exists(), "something was left behind");
        for word in words.iter().chain(&["allowed: "]) {
            assert!(message.contains(word), "no {word:?} in {message}");
        }
        assert_eq!(message.matches("allowed: ").count(), 1, "{message}");
    }
}

/// Half as much wear again as the run has is half as great a coefficient again, up to what wear does to the pressure.
#[test]
fn it_fits_and_writes_everything() {
    let run = shared_run();
    let trace = Trace::new(measured(&run, "# gear = pinion\n# uncertainty_um = 0.05\n", 1.5));
    let output = trace.compare(&run, &[]).output().unwrap();
    let (said, stderr) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(0), "{said}{stderr}");
    assert!(said.contains("wear coefficient k") && said.contains("95 %") && said.contains("report.html"), "{said}");
    let record = json(&trace.out().join("compare.json"));
    let k = record["fit"]["coefficient_m2_per_N"]["value"].as_f64().unwrap();
    assert!((1.4e-17..1.8e-17).contains(&k), "{k}");
    assert_eq!((record["gear"].as_str(), record["form"].as_str()), (Some("pinion"), Some("cubic")));
    assert_eq!(record["fit"]["stopped"], "converged");
    assert_eq!(record["hours"].as_f64(), Some(127.75));
    let rows = column(&trace.out().join("compare.csv"), "difference_um").len();
    assert_eq!(record["fit"]["points"].as_u64(), Some(rows as u64));
    let page = fs::read_to_string(trace.out().join("report.html")).unwrap();
    assert!(page.contains("Measured and simulated profile") && page.contains("95 % interval"));
}

/// A slope in roll length of the profile of a run with f_Hα 0: told on the terminal, in the record and on the page, with the key it belongs to.
#[test]
fn it_tells_the_slope_before_wear() {
    let run = shared_run();
    let radii =
        column(&run.join("pinion.csv"), "radius_mm").into_iter().zip(column(&run.join("pinion.csv"), "wear_um"));
    // Base radius of 16 teeth of module 4.5 mm at 20°; roll lengths of the start of active profile, 34.1233 mm, and of the tip, 41.23 mm.
    let base_mm = 36.0 * 20f64.to_radians().cos();
    let roll = |radius: f64| (radius * radius - base_mm * base_mm).max(0.0).sqrt();
    let (mut sign, f_h_um) = (1.0, 4.0);
    let slope = f_h_um / (roll(41.23) - roll(34.1233));
    let rows: String = radii
        .filter(|(r, _)| (34.2..41.1).contains(r))
        .map(|(r, wear)| {
            sign = -sign;
            format!("{r},{}\n", slope * roll(r) - 1.2 * wear + 0.1 * sign)
        })
        .collect();
    let trace = Trace::new(format!("# gear = pinion\nradius_mm,height_um\n{rows}"));
    let output = trace.compare(&run, &["--form", "involute"]).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    let key = "pair.pinion.profile_slope_deviation_um";
    for words in [
        "as measured, total deviation F_α",
        "slope deviation f_Hα",
        "before wear, beside the scene’s flank",
        "the form (involute) takes it away",
        "This interval is of the fit",
        key,
        "With it k is",
    ] {
        assert!(said.contains(words), "no {words:?} in {said}");
    }
    let record = json(&trace.out().join("compare.json"));
    let told = &record["profiles"][0]["profile_slope"];
    let found = told["before_wear_um"]["value"].as_f64().unwrap();
    assert!((found - f_h_um).abs() < 0.4, "{told}");
    assert_eq!((&told["key"], &told["differs"], &told["removed_with_form"]), (&key.into(), &true.into(), &true.into()));
    assert!(record["with_profile_slopes"]["profile_slopes_um"][key].as_f64().unwrap() > 2.0, "{record}");
    let page = fs::read_to_string(trace.out().join("report.html")).unwrap();
    assert!(page.contains("Profile slope f_Hα before wear") && page.contains(key), "not on the page");
}

/// The same bits again, on any number of threads, and no run of the scene where nothing is fitted.
#[test]
fn the_same_again_and_nothing_run_where_nothing_is_fitted() {
    let run = shared_run();
    let trace = Trace::new(measured(&run, "# gear = pinion\n", 1.2));
    let mut written = Vec::new();
    for threads in ["1", "2"] {
        trace.compare(&run, &["--quiet", "--threads", threads]).assert().success();
        written
            .push(["compare.json", "compare.csv", "report.html"].map(|name| fs::read(trace.out().join(name)).unwrap()));
    }
    assert_eq!(written[0], written[1]);
    trace.compare(&run, &["--fit", "none", "--form", "none", "--shift-within", "0"]).assert().success();
    let record = json(&trace.out().join("compare.json"));
    assert_eq!(record["fit"]["runs"].as_u64(), Some(0));
    // Measured less simulated is −0.2 of the wear, at every point.
    let (wear, difference) = (trace.out().join("compare.csv"), trace.out().join("compare.csv"));
    for (wear, difference) in column(&wear, "wear_um").into_iter().zip(column(&difference, "difference_um")) {
        assert!((difference + 0.2 * wear).abs() < 1e-9, "{wear} {difference}");
    }
}

/// Results lie beside the run where no other place is named; a moment between snapshots is run for.
#[test]
fn results_lie_beside_the_run_and_any_moment_will_do() {
    let folder = finished_run(&scene("31.75"));
    let run = folder.path().join("run");
    let trace = Trace::new(measured(&run, "# gear = pinion\n# hours = 64\n", 0.5));
    gearwear()
        .args(["compare", "--quiet", "--fit", "none", "--shift-within", "0"])
        .arg(&run)
        .arg(trace.folder.path().join("trace.csv"))
        .assert()
        .success();
    let record = json(&run.join("compare/trace/compare.json"));
    assert_eq!((record["hours"].as_f64(), record["fit"]["runs"].as_u64()), (Some(64.0), Some(1)));
    // Load and sliding take as much off the flank in every hour, wherever it is: half of the time, half of the area.
    let area = |path: &Path, x: &str| {
        let (x, wear) = (column(path, x), column(path, "wear_um"));
        let inside = |r: f64| (34.2..41.1).contains(&r);
        let pairs = x.windows(2).zip(wear.windows(2)).filter(|(x, _)| inside(x[0]) && inside(x[1]));
        pairs.map(|(x, wear)| 0.5 * (wear[0] + wear[1]) * (x[1] - x[0])).sum::<f64>()
    };
    let ratio = area(&run.join("compare/trace/compare.csv"), "radius_mm") / area(&run.join("pinion.csv"), "radius_mm");
    assert!((ratio / (64.0 / 127.75) - 1.0).abs() < 0.05, "{ratio}");
}

#[test]
fn wrong_measured_files_are_refused() {
    let run = shared_run();
    let rows: String = (0..40).map(|i| format!("{},{}\n", 34.3 + 0.1 * f64::from(i), -0.1 * f64::from(i))).collect();
    let with = |header: &str| Trace::new(format!("{header}radius_mm,height_um\n{rows}"));
    let refused = |trace: Trace, words: &[&str]| trace.refused(&run, &[], &[&["trace.csv"], words].concat());

    let nan = format!("# gear = pinion\nradius_mm,height_um\n34.2,1.0\n34.25,NaN\n{rows}");
    refused(Trace::new(nan), &["line 4", "height_um", "found NaN", "a finite number"]);
    refused(
        Trace::new(format!("# gear = pinion\nradius,height\n{rows}")),
        &["line 2", "found radius,height", "with units"],
    );
    refused(Trace::new(format!("# gear = pinion\nradius_inch,height_um\n{rows}")), &["line 2", "found radius_inch"]);
    let few = "# gear = pinion\nradius_mm,height_um\n35,0\n36,-1\n37,0\n38,0\n39,0\n40,0\n41,0\n";
    refused(Trace::new(few), &["found 7 points", "at least 8", "4 of a form (cubic)"]);
    refused(
        Trace::new(format!("# gear = pinion\nradius_mm,height_um\n{rows}36,1\n")),
        &["line 43", "found 36", "increase"],
    );
    refused(
        Trace::new(format!("# gear = pinion\nradius_mm,height_um\n{rows}52,1\n")),
        &["line 43", "found 52", "41.2300"],
    );
    refused(
        Trace::new(format!("# gear = pinion\nradius_mm,height_um\n20,1\n{rows}")),
        &["line 3", "found 20", "pinion's flank"],
    );
    refused(with(""), &["gear is missing", "--gear"]);
    refused(with("# gear = planet\n"), &["line 1", "found planet", "pinion or wheel"]);
    refused(with("# gear = pinion\n# hours = 200\n"), &["line 2", "hours", "found 200", "at most 127.75"]);
    refused(with("# gear = pinion\n# revolutions = 2e6\n"), &["line 2", "revolutions", "found 2000000", "1149750"]);
    refused(with("# gear = pinion\n# width_mm = 15\n"), &["line 2", "width_mm", "found 15", "0 to 14"]);
    refused(Trace::new(""), &["column names is missing"]);
    with("# gear = pinion\n").refused(&run, &["--gear", "wheel"], &["found pinion in the file and --gear wheel"]);
    with("# gear = pinion\n").refused(&run, &["--fit", "both"], &["--fit", "found both", "wear.severe"]);
    let line = with("# gear = pinion\n# height_from = line\n");
    line.refused(&run, &["--form", "none"], &["--form", "cubic or involute"]);
}

#[test]
fn folders_that_are_no_finished_run_are_refused() {
    let trace = Trace::new(measured(&shared_run(), "# gear = pinion\n", 1.0));
    trace.refused(Path::new("/nowhere"), &[], &["RUN", "summary.json", "the folder of a finished gearwear run"]);
    let folder = finished_run(&scene("31.75"));
    let run = folder.path().join("run");
    let change = |name: &str, from: &str, to: &str| {
        let text = fs::read_to_string(run.join(name)).unwrap();
        assert!(text.contains(from), "{name}: no {from}");
        fs::write(run.join(name), text.replacen(from, to, 1)).unwrap();
    };
    change("summary.json", "\"completed\"", "\"interrupted\"");
    trace.refused(&run, &[], &["summary.json", "found interrupted", "allowed: completed"]);
    change("summary.json", "\"interrupted\"", "\"completed\"");
    change("scene.toml", "302.0", "301.0");
    trace.refused(&run, &[], &["scene.toml", "found a scene with hash"]);
    change("scene.toml", "301.0", "302.0");
    change("profiles.csv", "5,pinion,", "5,sun,");
    let text = fs::read_to_string(run.join("profiles.csv")).unwrap();
    let line = 1 + text.lines().position(|line| line.contains("5,sun,")).unwrap();
    trace.refused(&run, &[], &["profiles.csv", &format!("line {line}"), "sun"]);
    fs::remove_file(run.join("profiles.csv")).unwrap();
    trace.refused(&run, &[], &["profiles.csv", "cannot be read"]);
}

/// A profile that shows no wear gives no coefficient: the comparison is written, and the exit status says so.
#[test]
fn a_profile_without_wear_gives_no_coefficient() {
    let run = shared_run();
    let trace = Trace::new(measured(&run, "# gear = pinion\n", 0.0));
    let output = trace.compare(&run, &["--quiet"]).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("the fit failed") && message.contains("the wear coefficient"), "{message}");
    assert_eq!(json(&trace.out().join("compare.json"))["fit"]["stopped"], "at-bound");
}

/// Both flanks at once, in either order: a coefficient for each gear with the correlation of both, in every file; and by one factor.
#[test]
fn both_flanks_give_a_coefficient_for_each_gear() {
    let run = shared_run();
    let pinion = measured(&run, "# gear = pinion\n# uncertainty_um = 0.05\n", 1.5);
    let wheel = measured_wheel(&run, "# gear = wheel\n", 0.8);
    let traces = Trace::new(&wheel).and(&pinion);
    let output = traces.compare(&run, &[]).output().unwrap();
    let (said, stderr) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(0), "{said}{stderr}");
    for words in
        ["k of the pinion, m²/N", "k of the wheel, m²/N", "correlation of k.pinion and k.wheel", "other.csv, trace.csv"]
    {
        assert!(said.contains(words), "no {words:?} in {said}");
    }
    let record = json(&traces.out().join("compare.json"));
    let fit = &record["fit"];
    for (index, gear, within) in [(0, "pinion", 1.4e-17..1.8e-17), (1, "wheel", 0.7e-17..0.9e-17)] {
        assert_eq!(
            (fit["coefficients"][index]["gear"].as_str(), record["profiles"][index]["gear"].as_str()),
            (Some(gear), Some(gear))
        );
        let k = fit["coefficients"][index]["coefficient_m2_per_N"]["value"].as_f64().unwrap();
        assert!(within.contains(&k), "{gear}: {k}");
    }
    assert_eq!(
        fit["correlation"]["parameters"].as_array().unwrap(),
        &["k.pinion", "k.wheel", "shift.pinion", "shift.wheel"]
    );
    let matrix = fit["correlation"]["matrix"].as_array().unwrap();
    assert!(matrix.len() == 4 && matrix[0][0] == 1.0 && matrix[0][1] == matrix[1][0], "{matrix:?}");
    // What stands at the top is that of the pinion, as in a comparison with its profile alone.
    assert_eq!((record["gear"].as_str(), &record["figures"]), (Some("pinion"), &record["profiles"][0]["figures"]));
    assert_eq!(fit["coefficient_m2_per_N"], fit["coefficients"][0]["coefficient_m2_per_N"]);
    let rows = column(&traces.out().join("compare.csv"), "difference_um").len();
    assert_eq!(fit["points"].as_u64(), Some(rows as u64));
    let page = fs::read_to_string(traces.out().join("report.html")).unwrap();
    for words in [
        "Measured and simulated profile, form removed: wheel",
        "Correlation coefficients",
        "Wear coefficients of pinion and wheel",
    ] {
        assert!(page.contains(words), "no {words:?} on the page");
    }

    // The same bits in the other order of files.
    let other = Trace::new(&pinion).and(&wheel);
    other.compare(&run, &["--quiet"]).assert().success();
    let again = json(&other.out().join("compare.json"));
    assert_eq!(again["fit"], record["fit"]);

    // By one factor on both.
    traces.compare(&run, &["--quiet", "--fit", "k"]).assert().success();
    let one = json(&traces.out().join("compare.json"));
    assert_eq!(one["fit"]["coefficients"].as_array().map(Vec::len), Some(1));
    assert_eq!(one["fit"]["correlation"]["parameters"][0], "k");
    assert!(one["fit"]["coefficient_ratio"].is_null());
}

/// What does not go together is refused; nothing but two profiles of different gears is fitted together.
#[test]
fn profiles_that_do_not_go_together_are_refused() {
    let run = shared_run();
    let pinion = || Trace::new(measured(&run, "# gear = pinion\n", 1.0));
    let wheel = measured_wheel(&run, "# gear = wheel\n", 1.0);
    let twice = pinion().and(measured(&run, "# gear = pinion\n", 1.2));
    twice.refused(&run, &[], &["other.csv", "gear: found pinion, as in trace.csv", "different gears"]);
    pinion().and(&wheel).refused(&run, &["--gear", "wheel"], &["trace.csv", "--gear", "# gear = "]);
    pinion().and(measured_wheel(&run, "", 1.0)).refused(&run, &[], &["other.csv", "gear is missing"]);
    pinion().and("radius_mm,height_um\n52,0\n52,1\n").refused(&run, &[], &["other.csv", "line 3", "increase"]);
    pinion().refused(&run, &["--fit", "each"], &["found each with the profile of one gear", "of the wheel too"]);
    pinion().and(&wheel).refused(&run, &["--fit", "both"], &["--fit", "found both", "none, k or each"]);
    // A third one, and a run among profiles.
    let both = pinion().and(&wheel);
    let mut third = both.compare(&run, &[]);
    let output = third.arg(both.other()).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && message.contains("found 3 measured profiles"), "{message}");
    let output = both.compare(&run, &[]).arg(&run).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.code() == Some(2) && message.contains("trace.csv: found a measured profile beside runs"),
        "{message}"
    );
    assert!(!both.out().exists());
}

/// One profile in the notations of measuring programs: the same fit as from the plain file.
#[test]
fn notations_of_measuring_programs_say_the_same() {
    let run = shared_run();
    let plain = measured(&run, "# gear = pinion\n", 1.5);
    let points: Vec<(f64, f64)> = plain
        .lines()
        .skip(2)
        .map(|line| {
            let (radius, height) = line.split_once(',').unwrap();
            (radius.parse().unwrap(), height.parse().unwrap())
        })
        .collect();
    let base_mm = 36.0 * 20f64.to_radians().cos();
    let roll_mm = |radius: f64| (radius * radius - base_mm * base_mm).sqrt();
    let table = |names: &str, between: &str, place: &dyn Fn(f64) -> f64, per_um: f64| {
        let rows = points.iter().map(|&(r, z)| format!("{}{between}{}\r\n", place(r), z * per_um));
        format!("# gear = pinion\r\n{names}\r\n{}", rows.collect::<String>())
    };
    let with_commas = |text: String| text.replace('.', ",");
    let latin_1 = |text: String| text.chars().map(|letter| letter as u8).collect::<Vec<u8>>();
    let files: [Vec<u8>; 5] = [
        latin_1(with_commas(table("Wälzlänge [mm];Höhe [µm]", ";", &roll_mm, 1.0))),
        with_commas(table("\"Durchmesser\"\t\"Abweichung\"\r\n\"[mm]\"\t\"[mm]\"", "\t", &|r| 2.0 * r, 1e-3)).into(),
        format!(
            "\u{feff}{}",
            table("\"roll_angle_deg\",\"height_um\"", ",", &|r| (roll_mm(r) / base_mm).to_degrees(), 1.0)
        )
        .into(),
        table("diameter_mm,wear_um", ",", &|r| 2.0 * r, -1.0).into(),
        export(&points, roll_mm).into(),
    ];
    let k = |text: &[u8]| {
        let trace = Trace::new(text);
        trace.compare(&run, &["--quiet", "--form", "involute"]).assert().success();
        json(&trace.out().join("compare.json"))["fit"]["coefficient_m2_per_N"]["value"].as_f64().unwrap()
    };
    let expected = k(plain.as_bytes());
    for (index, file) in files.iter().enumerate() {
        // The export of a machine has places of its own, and the profile, half as much wear again, is not just that of another coefficient.
        let within = if index == 4 { 2e-2 } else { 1e-4 };
        let found = k(file);
        assert!((found / expected - 1.0).abs() < within, "{index}: {found:e} {expected:e}");
    }
}

/// The export of a machine with two teeth and both flanks, the left ones of `points` by their radius; without a line that says the gear.
fn export(points: &[(f64, f64)], roll_mm: impl Fn(f64) -> f64) -> String {
    let (first, last) = (roll_mm(points[0].0), roll_mm(points[points.len() - 1].0));
    let values: String = (0..480)
        .map(|i| {
            let rho = first + (last - first) * f64::from(i) / 479.0;
            let after = points.partition_point(|(r, _)| roll_mm(*r) <= rho).clamp(1, points.len() - 1);
            let [(x, a), (y, b)] = [points[after - 1], points[after]].map(|(r, z)| (roll_mm(r), z));
            format!(" {:.4}", a + (rho - x) / (y - x) * (b - a))
        })
        .collect();
    let [from, to] = [points[0].0, points[points.len() - 1].0].map(|radius| 2.0 * radius);
    let zeros = " 0.0".repeat(480);
    format!(
        "HEADER KS.MK.FILE\r\nUNDEFINED -2147483.648\r\n  21 :Modul: 4.5\r\n  22 :Zähnezahl: 16\r\n  24 :Eingriffswinkel: 20.0\r\n  \
         26 :Zahnbreite: 14.0\r\n  41 :da: {from}\r\n  44 :de: {to}\r\nFlankenlinie:\r\nZahn-Nr.: 1 links / 480  Werte  x= 12.0\r\n{zeros}\r\n\
         Profil:\r\nZahn-Nr.: 1 links / 480  Werte  z= 7.0\r\n{values}\r\nZahn-Nr.: 9 links / 480  Werte  z= 7.0\r\n{values}\r\n"
    )
}

/// What a file of another program must not have, and what a choice must name.
#[test]
fn files_of_other_programs_are_refused_by_line() {
    let run = shared_run();
    let rows: String = (0..40).map(|i| format!("{},{}\n", 34.3 + 0.1 * f64::from(i), -0.1 * f64::from(i))).collect();
    let refused = |text: String, words: &[&str]| Trace::new(text).refused(&run, &[], &[&["trace.csv"], words].concat());
    let sentinel = format!("# gear = pinion\nradius_mm,height_um\n34.2,-2147483.648\n{rows}");
    refused(sentinel, &["line 3", "height_um", "found -2147483.648"]);
    refused("<?xml version=\"1.0\"?><gde></gde>".to_owned(), &["line 1", "GDE", ".mka"]);
    refused("HEADER KS.MW.FILE\n".to_owned(), &["line 1", ".mew"]);
    refused(format!("# gear = pinion\nWälzlänge;Höhe\n{}", rows.replace(',', ";")), &["line 2", "with units"]);

    let points = [(34.3, 0.0), (41.0, -3.0)];
    let base_mm = 36.0 * 20f64.to_radians().cos();
    let of_machine = export(&points, |radius| (radius * radius - base_mm * base_mm).sqrt());
    let other_teeth = of_machine.replace("Zähnezahl: 16", "Zähnezahl: 17");
    refused(other_teeth, &["line 4", "number of teeth", "found 17", "16, of the pinion, or 24, of the wheel"]);
    refused(of_machine.replace("9 links", "9 rechts"), &["found left and right", "--flank"]);
    let trace = Trace::new(of_machine);
    trace.refused(&run, &["--tooth", "5"], &["--tooth: found 5", "1, 9"]);
    trace.refused(&run, &["--flank", "right"], &["--flank: found right", "--flank left"]);
    trace.refused(&run, &["--gear", "wheel"], &["number of teeth", "found 16", "24, of the wheel"]);
    trace.compare(&run, &["--quiet", "--fit", "none", "--shift-within", "0", "--tooth", "1"]).assert().success();
    let record = json(&trace.out().join("compare.json"));
    let lead = &record["profiles"][0]["leads"][0]["measured"];
    assert_eq!((lead["total_um"].as_f64(), lead["tolerance_class"].as_u64()), (Some(0.0), Some(1)), "{record}");
}

/// The worn flank as a file is the run's own wear again.
#[test]
fn an_exported_flank_is_read_back() {
    let run = shared_run();
    let folder = tempfile::tempdir().unwrap();
    for gear in ["pinion", "wheel"] {
        let file = folder.path().join(format!("{gear}.csv"));
        gearwear().arg("export").arg(&run).args(["--gear", gear, "--out"]).arg(&file).assert().success();
        let out = folder.path().join(gear);
        let fit = ["--fit", "none", "--form", "none", "--shift-within", "0", "--quiet", "--out"];
        gearwear().arg("compare").arg(&run).arg(&file).args(fit).arg(&out).assert().success();
        let difference = column(&out.join("compare.csv"), "difference_um");
        assert!(difference.len() > 100 && difference.iter().all(|d| d.abs() < 1e-3), "{gear}: {difference:?}");
    }
    // The export of a machine has places of its own, even in roll length: k within a thousandth.
    let machine = folder.path().join("pinion.mka");
    gearwear().arg("export").arg(&run).args(["--gear", "pinion", "--out"]).arg(&machine).assert().success();
    let out = folder.path().join("machine");
    let fit = ["--form", "none", "--shift-within", "0", "--quiet", "--out"];
    gearwear().arg("compare").arg(&run).arg(&machine).args(fit).arg(&out).assert().success();
    let factor = json(&out.join("compare.json"))["fit"]["coefficient_factor"]["value"].as_f64().unwrap();
    assert!((factor - 1.0).abs() < 1e-3, "{factor}");
    let nothing = folder.path().join("nothing.csv");
    let refused = gearwear().arg("export").arg(&run).args(["--width", "15", "--out"]).arg(&nothing).output().unwrap();
    let message = String::from_utf8(refused.stderr).unwrap();
    assert!(refused.status.code() == Some(2) && message.contains("found 15; allowed: 0 to 14"), "{message}");
    assert!(!nothing.exists());
}
