//! `gearwear accuracy` for a pair whose sections differ over the face width: against slices coupled in space, slices coupled by plate theory
//! and uncoupled, the whole flank, and runs to a greater depth.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{exchanged, gearwear, json};

/// The helical preset with 4 slices, few points, positions and steps, its calibration on coarse elements.
fn coarse_scene() -> String {
    exchanged(
        "thesis-helical",
        &[
            ("flank_points = 750 ", "flank_points = 80 "),
            ("positions = 400 ", "positions = 30 "),
            ("revolutions = 10000.0", "revolutions = 60000.0"),
            ("snapshots_revolutions", "# snapshots_revolutions"),
            ("slices = 20 ", "slices = 4 "),
            ("[wear]", "[fem]\nelements_per_half_width = 3\n[wear]"),
        ],
    )
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {value}"))
}

fn rows(path: &Path) -> Vec<csv::StringRecord> {
    let text = fs::read_to_string(path).unwrap();
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(Result::unwrap).collect()
}

#[test]
fn slices_are_compared_coupled_and_uncoupled_over_the_whole_flank() {
    let dir = tempfile::tempdir().unwrap();
    let (scene, out) = (dir.path().join("given.toml"), dir.path().join("out"));
    fs::write(&scene, coarse_scene()).unwrap();
    let output =
        gearwear().arg("accuracy").arg(&scene).arg("--out").arg(&out).args(["--within", "60"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for file in
        ["accuracy.json", "accuracy.csv", "wear_profiles.csv", "over_width.csv", "report.html", "recommended.toml"]
    {
        assert!(out.join(file).metadata().unwrap().len() > 0, "{file}");
    }
    let record = json(&out.join("accuracy.json"));
    assert_eq!(record["stopped"], "completed");
    let variants = record["variants"].as_array().unwrap();
    assert!(variants.iter().all(|v| v["failure"].is_null()), "{}", record["variants"]);

    // Every surface but the plane finite elements, coupled by plate theory and uncoupled, on 2, 4 and 8 slices; coupled in space on the scene's,
    // and the reference on twice as many.
    let combinations: BTreeSet<(&str, &str, u64)> = variants
        .iter()
        .map(|v| {
            let s = &v["settings"];
            (s["surface"].as_str().unwrap(), s["coupling"].as_str().unwrap(), s["slices"].as_u64().unwrap())
        })
        .collect();
    let mut expected: BTreeSet<(&str, &str, u64)> = ["hertz-mean", "hertz", "winkler", "half-space"]
        .into_iter()
        .flat_map(|surface| ["none", "slicing"].map(move |coupling| (surface, coupling)))
        .flat_map(|(surface, coupling)| [2, 4, 8].map(|slices| (surface, coupling, slices)))
        .collect();
    expected.extend(["hertz-mean", "hertz", "winkler", "half-space"].map(|surface| (surface, "fem", 4)));
    expected.insert(("half-space", "fem", 8));
    assert_eq!(combinations, expected);
    assert_eq!(variants[0]["settings"]["coupling"], "fem");

    // What does not fit is left out, and said.
    let left_out: Vec<&str> =
        record["left_out"].as_array().unwrap().iter().map(|l| l["what"].as_str().unwrap()).collect();
    assert!(left_out.contains(&"surface fem") && left_out.contains(&"half-width"), "{left_out:?}");
    assert!(left_out.contains(&"a quarter of the scene's 4 slices"), "{left_out:?}");
    assert!(record["reference"]["does_not_tell"].as_str().unwrap().contains("plane in every slice"));

    // The reference has an uncertainty of its own in every quantity: the error of the finest run.
    let uncertainty = record["reference"]["uncertainty"].as_object().unwrap();
    for quantity in ["wear_profile", "root_wear", "K_Hbeta", "worn_K_Hbeta", "peak_pressure", "transmission_error"] {
        let value = uncertainty[quantity].as_f64().unwrap();
        assert!(value > 0.0 && value < 0.5, "{quantity}: {value}");
        assert_eq!(number(&variants[0], &format!("/errors/{quantity}/relative")), value);
        assert!(variants.iter().any(|v| v["errors"][quantity]["on_front"] == true), "{quantity}");
        let recommended = record["recommendations"].as_array().unwrap();
        assert!(recommended.iter().any(|r| r["quantity"] == quantity), "{quantity}");
    }
    assert!(!uncertainty.contains_key("half_width"));

    // Coupled against uncoupled on the same surface; the simplified model against the ellipse it stands for.
    let comparisons = record["comparisons"].as_array().unwrap();
    let table = |title: &str| comparisons.iter().find(|c| c["title"] == title).unwrap_or_else(|| panic!("{title}"));
    let names = |title: &str| -> Vec<&str> {
        table(title)["rows"].as_array().unwrap().iter().map(|row| row["name"].as_str().unwrap()).collect()
    };
    let coupling = names("Coupling of slices");
    for surface in [
        "Hertz, mean pressure",
        "Hertz",
        "Winkler, K/H from Hertz by half-width, tip contact",
        "elastic half-planes, tip contact",
    ] {
        for how in ["uncoupled", "coupled by plate theory"] {
            assert!(coupling.contains(&&*format!("{surface}, {how}")), "{coupling:?}");
        }
    }
    let simplified = [
        "mean pressure, coupled by three-dimensional finite elements",
        "mean pressure, coupled by plate theory",
        "mean pressure, uncoupled",
    ];
    assert_eq!(names("Simplified model"), simplified);
    assert!(names("Tooth stiffness").contains(&"teeth of 20 N/(mm·µm)"));
    for row in table("Coupling of slices")["rows"].as_array().unwrap() {
        let difference = number(row, "/wear_profile/pinion");
        assert!(difference > 1e-3 && difference < 1.0, "{row}");
    }

    // To a greater depth, the others against the first; what is called stable is.
    let deep = record["deep_runs"]["rows"].as_array().unwrap();
    assert_eq!(deep.len(), 5);
    assert!(deep[0]["wear_profile"].is_null() && record["deep_runs"]["baseline"] == deep[0]["name"]);
    assert!(deep[1..].iter().all(|row| number(row, "/wear_profile") > 1e-3));
    for row in deep {
        let (usual, fewer) = (number(row, "/usual/wear_steps"), number(row, "/fewer_steps/wear_steps"));
        assert_eq!((usual, fewer), (10.0, 1.0), "{row}");
        assert_eq!(row["stable"].as_bool().unwrap(), number(row, "/peak_wear_change") <= 0.1, "{row}");
    }

    // One row per run; reference and finest runs over the width of both gears on the reference's 8 slices.
    let runs = rows(&out.join("accuracy.csv"));
    assert_eq!(runs.len(), variants.len() + 1);
    let column = runs[0].iter().position(|name| name == "root_wear_error").unwrap();
    for (row, variant) in runs[1..].iter().zip(variants) {
        assert_eq!(row[column].parse::<f64>().unwrap(), number(variant, "/errors/root_wear/relative"));
    }
    let widths = rows(&out.join("over_width.csv"));
    assert_eq!(widths.iter().filter(|row| &row[0] == "reference" && &row[1] == "wheel").count(), 8);
    assert_eq!(&widths[1][2], "1.25");

    // The recommended scene is that run.
    let recommended = &record["recommendations"][0];
    assert_eq!(recommended["quantity"], "wear_profile");
    let variant = &variants[recommended["variant"].as_u64().unwrap() as usize];
    let again = dir.path().join("again");
    let run = gearwear().arg("run").arg(out.join("recommended.toml")).arg("--out").arg(&again).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let summary = json(&again.join("summary.json"));
    assert_eq!(number(&summary, "/pinion/peak_wear_um"), number(variant, "/peak_wear_um/pinion"));
}
