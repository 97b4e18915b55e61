//! `gearwear compare RUN RUN …`: runs and scenes side by side.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{exchanged, gearwear};

/// A quick scene with this greatest wear, verified on few finite elements or not.
fn scene(coefficient: &str, verify: bool) -> String {
    let text = exchanged(
        "thesis-spur",
        &[
            ("flank_points = 750 ", "flank_points = 200 "),
            ("positions = 400 ", "positions = 100 "),
            ("step = { revolutions = 7665.0 }", "step = { revolutions = 50000.0 }"),
            ("[numerics]\n", &format!("[numerics]\nverify = {verify}\n")),
            ("[wear]", "[fem]\nbody = \"sector\"\nsector_teeth = 3\nelements_per_half_width = 3\n[wear]"),
        ],
    );
    let key = "coefficient_m2_per_N = ";
    let at = text.find(key).unwrap() + key.len();
    let end = at + text[at..].find([' ', '\n']).unwrap();
    format!("{}{coefficient}{}", &text[..at], &text[end..])
}

fn compare(dir: &Path, what: &[&str]) -> std::process::Output {
    gearwear().current_dir(dir).arg("compare").args(what).output().unwrap()
}

fn read(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// A scene and a finished run of another one: wear is linear in its coefficient as long as the flanks hardly change, and a difference of
/// half is more than any error that is claimed.
#[test]
fn a_scene_and_a_run_are_shown_side_by_side() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    fs::write(dir.join("slow.toml"), scene("5e-20", true)).unwrap();
    fs::write(dir.join("fast.toml"), scene("1e-19", true)).unwrap();
    let made = gearwear().current_dir(dir).args(["run", "fast.toml", "--out", "fast", "--quiet"]).output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let output = compare(dir, &["fast", "slow.toml", "--out", "both"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let record = read(&dir.join("both/variants.json"));
    let answer = record["answer"].as_str().unwrap();
    assert!(answer.contains("less with slow than with fast, which is larger than the errors"), "{answer}");
    assert_eq!(record["keys"].as_array().unwrap().len(), 1, "{}", record["keys"]);
    assert_eq!(record["keys"][0]["key"], "wear.coefficient_m2_per_N");
    let mut rows = csv::Reader::from_path(dir.join("both/variants.csv")).unwrap();
    let of_wear = |row: &csv::StringRecord| &row[0] == "pinion.peak_wear_um" && &row[3] == "slow";
    let row = rows.records().map(Result::unwrap).find(of_wear).unwrap();
    let summaries = ["fast", "both/slow"].map(|run| read(&dir.join(run).join("summary.json")));
    let [fast, slow] = summaries.each_ref().map(|s| s["pinion"]["peak_wear_um"].as_f64().unwrap());
    let [e_fast, e_slow] = summaries.each_ref().map(|s| s["error"]["total"]["peak_wear"]["pinion"].as_f64().unwrap());
    assert_eq!(row[4].parse::<f64>().unwrap(), slow);
    assert!((row[6].parse::<f64>().unwrap() - (slow / fast - 1.0)).abs() < 1e-12);
    assert!((row[7].parse::<f64>().unwrap() - (e_fast + e_slow * slow / fast)).abs() < 1e-12);
    assert_eq!(&row[8], "true");
    let page = fs::read_to_string(dir.join("both/report.html")).unwrap();
    assert!(page.contains("Wear depth of the wheel") && page.contains("wear.coefficient_m2_per_N"));
}

/// The same scene twice cannot be ranked; without a verification nothing is known of the errors.
#[test]
fn runs_that_are_the_same_are_not_ranked() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    for (name, verify) in [("one", true), ("two", true), ("three", false)] {
        fs::write(dir.join(name).with_extension("toml"), scene("1e-19", verify)).unwrap();
    }
    let output = compare(dir, &["one.toml", "two.toml", "three.toml", "--out", "all"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let answer = read(&dir.join("all/variants.json"))["answer"].as_str().unwrap().to_owned();
    assert!(answer.contains("0.0 % more with two than with one, which is within the errors"), "{answer}");
    assert!(answer.contains("with three than with one, whose error is not known"), "{answer}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    fs::write(dir.join("a.toml"), scene("1e-19", false)).unwrap();
    fs::create_dir(dir.join("empty")).unwrap();
    for (what, parts) in [
        (vec!["a.toml", "a.toml"], ["--out", "missing"]),
        (vec!["empty", "empty"], ["summary.json", "the folder of a finished gearwear run"]),
        (vec!["empty", "a.toml", "--gear", "pinion"], ["--gear", "beside a measured profile"]),
    ] {
        let output = compare(dir, &what);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(parts.iter().all(|part| said.contains(part)), "{parts:?} in:\n{said}");
    }
    assert!(!dir.join("empty/compare").exists(), "nothing is left behind");
}

/// The scenes of docs/tutorial.md, by its commands, answer its question as it says.
#[test]
fn the_tutorial_says_what_comes_out() {
    let page =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join("docs/tutorial.md")).unwrap();
    let mut blocks = page.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let (plain, line) = (blocks.next().unwrap(), blocks.next().unwrap());
    let relief = plain.replace("tip_rounding_mm = 0.2\n", &format!("tip_rounding_mm = 0.2\n{line}"));
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    fs::write(dir.join("plain.toml"), plain).unwrap();
    fs::write(dir.join("relief.toml"), relief).unwrap();
    let output = compare(dir, &["plain.toml", "relief.toml", "--out", "relief-or-not"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8(output.stdout).unwrap();
    for gear in ["pinion", "wheel"] {
        let sentence = page.lines().find(|line| line.starts_with(&format!("The maximum wear of the {gear}"))).unwrap();
        assert!(said.contains(sentence), "{sentence}\n{said}");
    }
}
