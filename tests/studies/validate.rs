//! `gearwear validate`: verdicts, exit statuses, what is written, and what is said of cases that are wrong.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

/// A case of one short run; `rest` is what it judges.
fn case_text(rest: &str) -> String {
    format!(
        r#"title = "a case"
group = "mine"
kind = "code-verification"
tier = "smoke"
requirement = "The pair has the base pitch of its module."

[[run]]
name = "short"
scene = "thesis-spur"
unset = ["operation.hours", "operation.snapshots_h"]
set = {{ "operation.pinion_revolutions" = 1.0, "numerics.step" = {{ revolutions = 1.0 }}, "numerics.error_estimate" = false, "numerics.positions" = 40, "numerics.flank_points" = 100 }}

{rest}"#
    )
}

/// p_bt = π m cos α.
const BASE_PITCH: &str = r#"[[quantity]]
name = "base pitch"
unit = "mm"
value = "short.summary.geometry.base_pitch_mm"
near = "PI() * 4.5 * cos(PI() / 9)"
within = { relative = 1e-12 }
source = "ISO 21771"
discretisation = { relative = 1e-12 }
"#;

/// A folder with the case `mine`.
fn folder(text: &str) -> TempDir {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("mine")).unwrap();
    fs::write(folder.path().join("mine/case.toml"), text).unwrap();
    folder
}

fn validate(folder: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("gearwear").unwrap().current_dir(folder).arg("validate").args(arguments).assert()
}

fn record(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("out/validation.json")).unwrap()).unwrap()
}

#[test]
fn a_case_that_holds_passes_and_leaves_its_reports() {
    let folder = folder(&case_text(BASE_PITCH));
    validate(folder.path(), &["mine", "--out", "out", "--threads", "1"]).success().stdout(contains("mine"));
    for name in ["report.html", "junit.xml", "summary.md", "work_precision.json", "validation.json"] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
    let record = record(folder.path());
    let case = &record["cases"][0];
    assert_eq!((case["name"].as_str(), case["failure"].is_null()), (Some("mine"), true));
    // Error, run time and work of every case.
    assert!(case["wall_s"].as_f64().unwrap() > 0.0);
    assert!(case["work"]["equilibria"].as_u64().unwrap() >= 40, "{}", case["work"]);
    let quantities = case["quantities"].as_array().unwrap();
    assert_eq!(quantities.len(), 2, "its own and how the run ended");
    assert!(quantities[1]["relative_error"].as_f64().unwrap() < 1e-12);
}

#[test]
fn a_missed_bound_is_exit_status_1_and_what_is_known_to_fail_is_not() {
    let wrong = BASE_PITCH.replace("PI() / 9", "PI() / 8");
    let missed = folder(&case_text(&wrong));
    validate(missed.path(), &["mine", "--out", "out"]).code(1).stderr(contains("missed: mine"));

    let known =
        wrong.replace("name = \"base pitch\"", "name = \"base pitch\"\nstands = \"fails\"\nremark = \"another angle\"");
    let known_to_fail = folder(&case_text(&known));
    validate(known_to_fail.path(), &["mine", "--out", "out"]).success();
    // A statement that suddenly holds is news too.
    let surprise = known.replace("PI() / 8", "PI() / 9");
    let holds_after_all = folder(&case_text(&surprise));
    validate(holds_after_all.path(), &["mine", "--out", "out"]).code(1);
}

#[test]
fn a_case_that_cannot_run_is_a_failure() {
    for (from, to) in [
        ("scene = \"thesis-spur\"", "scene = \"nowhere.toml\""),
        ("\"numerics.positions\" = 40", "\"numerics.positions\" = 0"),
        ("short.summary.geometry.base_pitch_mm", "short.summary.geometry.nothing"),
        // What is no number holds nothing, and is no known failure either.
        ("short.summary.geometry.base_pitch_mm", "1.0 / 0.0"),
        // A place on the stability map is a number.
        (
            "discretisation = { relative = 1e-12 }\n",
            "discretisation = { relative = 1e-12 }\n[[run]]\nname = \"f\"\nscene = \"fzg-c\"\nexpect = \"refused\"\n\
             set = { \"numerics.positions\" = 0 }\n[[run.each]]\n[[stability]]\nfamily = \"f\"\nparameter = \"p\"\n\
             value = \"value\"\n",
        ),
        // The tolerance is wider than what it allows for, and nothing says why.
        ("within = { relative = 1e-12 }", "within = { relative = 1e-3 }"),
    ] {
        let text = case_text(BASE_PITCH);
        assert!(text.contains(from));
        let folder = folder(&text.replace(from, to));
        validate(folder.path(), &["mine", "--out", "out"]).code(1);
        let record = record(folder.path());
        let case = &record["cases"][0];
        let ended_wrong = case["quantities"].as_array().unwrap().iter().any(|q| q["standing"] != q["expected"]);
        assert!(case["failure"].is_string() || ended_wrong, "{to}: {case}");
    }
}

/// A run whose scene names a file that is not beside the case is refused: no other model stands in for it.
#[test]
fn a_run_without_the_file_it_names_is_refused() {
    for named in [
        r#""contact.calibration" = "nowhere.json""#,
        r#""stiffness.model" = "simon", "stiffness.curve" = "nowhere.csv""#,
    ] {
        let mut text = case_text(BASE_PITCH);
        if named.contains("curve") {
            text = text.replace("unset = [", "unset = [\"stiffness.pair_N_per_mm_um\", ");
        }
        let case = folder(&text.replace("set = { ", &format!("set = {{ {named}, ")));
        validate(case.path(), &["mine", "--out", "out"]).code(1);
        let outcome = record(case.path()).to_string();
        assert!(outcome.contains("refused") && outcome.contains("cannot be read"), "{named}: {outcome}");
    }
}

#[test]
fn wrong_cases_are_refused_with_their_line() {
    for (from, to, said) in [
        ("kind = \"code-verification\"", "kind = \"verification\"", &["line 3", "verification", "regression"][..]),
        ("tier = \"smoke\"", "tire = \"smoke\"", &["line 4", "tire"]),
        ("name = \"short\"", "name = \"true\"", &["line 8", "name \"true\"", "no word of the expression language"]),
        ("source = \"ISO 21771\"\n", "", &["quantity \"base pitch\"", "no source"]),
        ("near = ", "at_least = 1\nnear = ", &["line 14", "more than one of near, at_least"]),
        ("[[quantity]]", "[[quantities]]", &["quantities"]),
        ("requirement", "requirement = [", &["line 5"]),
    ] {
        let text = case_text(BASE_PITCH);
        assert!(text.contains(from), "{from}");
        let folder = folder(&text.replacen(from, to, 1));
        let asserted = validate(folder.path(), &["mine", "--out", "out"]).code(2).stdout("");
        let message = String::from_utf8_lossy(&asserted.get_output().stderr).into_owned();
        for part in said {
            assert!(message.contains(part), "{part:?} in {message}");
        }
        assert!(message.contains("case.toml"), "{message}");
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
fn what_is_asked_for_must_exist() {
    let folder = tempdir().unwrap();
    validate(folder.path(), &["fzg-c-geometri", "--out", "out"])
        .code(2)
        .stderr(contains("fzg-c-geometri").and(contains("did you mean \"fzg-c-geometry\"")));
    validate(folder.path(), &["fzg-search", "--tier", "smoke", "--out", "out"]).code(2).stderr(contains("tier smoke"));
    validate(folder.path(), &["fzg-c-geometry", "fzg-c-geometry", "--out", "out"])
        .code(2)
        .stderr(contains("two cases"));
    validate(folder.path(), &["--tier", "quick", "--out", "out"]).code(2).stderr(contains("smoke, full, long"));
    validate(folder.path(), &["fzg-c-geometry", "--out", "out", "--against", "nothing.json"]).code(2);
    fs::write(folder.path().join("old.json"), "{\n\"cases\": 1 }").unwrap();
    validate(folder.path(), &["fzg-c-geometry", "--out", "out", "--against", "old.json"])
        .code(2)
        .stderr(contains("old.json: line 2").and(contains("validation.json")));
    assert!(!folder.path().join("out").exists());
}

/// The built-in cases, written out, give what the built-in ones give; whatever a user changes there is judged anew.
#[test]
fn exported_cases_are_the_built_in_ones() {
    let folder = tempdir().unwrap();
    validate(folder.path(), &["--export", "cases"]).success();
    let quantities = |arguments: &[&str]| {
        validate(folder.path(), arguments).success();
        record(folder.path())["cases"][0]["quantities"].clone()
    };
    let built_in = quantities(&["fzg-c-geometry", "--out", "out", "-q"]);
    assert_eq!(quantities(&["cases/validation/fzg-c-geometry", "--out", "out", "-q", "--threads", "2"]), built_in);
    let path = folder.path().join("cases/validation/fzg-c-geometry/case.toml");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("near = 280", "near = 290")).unwrap();
    // What was changed is not written over.
    validate(folder.path(), &["--export", "cases"]).code(2).stderr(contains("there already"));
    validate(folder.path(), &["cases/validation/fzg-c-geometry", "--out", "out"]).code(1);
}

/// The second run of a case with another tolerance says so, a wider one being worse; work is compared too.
#[test]
fn an_earlier_record_shows_what_got_worse() {
    let loose = case_text(BASE_PITCH).replace("cos(PI() / 9)", "cos(PI() / 9) * (1 + 1e-7)").replace("1e-12", "1e-6");
    let folder = folder(&loose);
    validate(folder.path(), &["mine", "--out", "out"]).success();
    fs::rename(folder.path().join("out/validation.json"), folder.path().join("old.json")).unwrap();
    let again = |text: &str| {
        fs::write(folder.path().join("mine/case.toml"), text).unwrap();
        validate(folder.path(), &["mine", "--out", "out", "--against", "old.json"]).success()
    };
    again(&loose).stdout(contains("0 worse, 0 better"));
    again(&loose.replace("1e-6", "2e-7")).stdout(contains("0 worse, 1 better"));
    again(&loose.replace("1e-6", "2e-6")).stdout(contains("1 worse, 0 better").and(contains("compared with")));
    let finer = loose.replace("\"numerics.positions\" = 40", "\"numerics.positions\" = 80");
    again(&finer).stdout(contains("equilibria").and(contains("0 worse").not()));
}

#[test]
fn the_list_names_every_case_with_its_requirement() {
    let folder = tempdir().unwrap();
    validate(folder.path(), &["--list"]).success().stdout(contains("fzg-c-geometry").and(contains("smoke")));
}
