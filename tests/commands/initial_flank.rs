//! Runs that begin with measured flanks.

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{exchanged, gearwear};

const GEARS: [&str; 2] = ["pinion", "wheel"];
/// Hours of the first part of a life, and of the whole.
const HOURS: [f64; 2] = [40.0, 127.75];

/// The preset on a surface, for so many hours, and a table before that of the material.
fn scene(surface: &str, hours: f64, tables: &str) -> String {
    let of_surface = format!("surface = \"{surface}\"\n# surface = ");
    let hours = format!("hours = {hours} #");
    exchanged(
        "fzg-c",
        &[
            ("# surface = ", &of_surface),
            ("hours = 127.75", &hours),
            ("snapshots_h = ", "# snapshots_h = "),
            ("verify = true", "verify = false"),
            ("error_estimate = true", "error_estimate = false"),
            ("tolerance_um = 0.05", "tolerance_um = 0.01"),
            ("[material]", &format!("{tables}\n[material]")),
        ],
    )
}

fn initial_flank(gear: &str, file: &str, more: &str) -> String {
    format!("[pair.{gear}.initial_flank]\nfile = \"{file}\"\n{more}\n")
}

/// Status and messages of a command in a folder.
fn command(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = gearwear().args(arguments).current_dir(folder).output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

fn run(folder: &Path, name: &str, scene: &str) -> PathBuf {
    let file = format!("{name}.toml");
    fs::write(folder.join(&file), scene).unwrap();
    let (status, message) = command(folder, &["run", &file, "--out", name, "--quiet", "--no-report"]);
    assert_eq!(status, Some(0), "{message}");
    folder.join(name)
}

fn wear_um(run: &Path, gear: &str) -> Vec<f64> {
    let mut rows = csv::Reader::from_path(run.join(format!("{gear}.csv"))).unwrap();
    let column = rows.headers().unwrap().iter().position(|name| name == "wear_um").unwrap();
    rows.records().map(|row| row.unwrap()[column].parse().unwrap()).collect()
}

/// A life in two parts, the second on the flanks that the first has left, as exported, is that life: at every flank point within 1 % of the maximum
/// wear on finite elements, and within 3 % on half-planes, where a point more or less of a tip edge counts.
#[test]
fn ver_a_run_on_exported_flanks_goes_on_with_the_life() {
    let folder = tempfile::tempdir().unwrap();
    for (surface, tolerance) in [("fem", 0.01), ("half-space", 0.03)] {
        let [first, whole] =
            HOURS.map(|hours| run(folder.path(), &format!("{surface}-{hours}"), &scene(surface, hours, "")));
        let first_name = first.file_name().unwrap().to_str().unwrap();
        for gear in GEARS {
            let out = format!("{gear}.csv");
            let (status, message) = command(folder.path(), &["export", first_name, "--gear", gear, "--out", &out]);
            assert_eq!(status, Some(0), "{message}");
        }
        let tables: String = GEARS.map(|gear| initial_flank(gear, &format!("{gear}.csv"), "cutoff_mm = 0")).concat();
        let second = scene(surface, HOURS[1] - HOURS[0], &tables);
        let second = run(folder.path(), &format!("{surface}-second"), &second);
        for gear in GEARS {
            let [first, second, whole] = [&first, &second, &whole].map(|run| wear_um(run, gear));
            let greatest = whole.iter().copied().fold(0.0, f64::max);
            let parts = first.iter().zip(&second).map(|(first, second)| first + second);
            let apart = parts.zip(&whole).map(|(parts, whole)| (parts - whole).abs()).fold(0.0, f64::max);
            assert!(apart < tolerance * greatest, "{surface}, {gear}: {apart} of {greatest}");
        }
        for gear in GEARS {
            fs::remove_file(folder.path().join(format!("{gear}.csv"))).unwrap();
        }
    }
}

/// Files that are no flank of the gear are refused, with the key and the line of the file; nothing stays.
#[test]
fn files_of_no_initial_flank_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "roll_length_mm,height_um\n12,0\n14,-1\n20,-2\n23,-1\n";
    let two = "tooth,flank,roll_length_mm,height_um\n1,left,12,0\n1,left,20,-2\n1,right,12,0\n1,right,20,-1\n";
    let relief =
        "tip_relief = { amount_um = 5.0, length_mm = 2.0 }\n[pair.pinion.initial_flank]\nfile = \"flank.csv\"\n";
    let plain = initial_flank("pinion", "flank.csv", "");
    for (content, tables, words) in [
        (None, plain.as_str(), "which cannot be read"),
        (Some("roll_length_mm,height_um\n12,0\n14,x\n".to_owned()), &plain, "line 3: height_um: found x"),
        (
            Some(format!("# gear = wheel\n{rows}")),
            &plain,
            "found wheel; allowed: pinion, for which the scene names the file",
        ),
        (Some(format!("# height_from = line\n{rows}")), &plain, "height_from: found line"),
        (Some("roll_length_mm,height_um\n12,0\n140,0\n".to_owned()), &plain, "line 3: roll_length_mm: found 140"),
        (Some(two.to_owned()), &plain, "allowed: one of them: flank = \"left\" or flank = \"right\""),
        (
            Some("roll_length_mm,wear_um\n12,0\n20,2000\n".to_owned()),
            &plain,
            "the pinion measured flank removes 2.0000 mm",
        ),
        (Some(rows.to_owned()), relief, "tip_relief, root_relief, profile_crowning_um and profile_slope_deviation_um"),
    ] {
        let path = folder.path().join("flank.csv");
        match content {
            Some(content) => fs::write(&path, content).unwrap(),
            None => assert!(!path.exists()),
        }
        let mut text = scene("half-space", 1.0, tables);
        if tables == relief {
            text = text.replace(relief, "").replace("[pair.wheel]", &format!("{relief}\n[pair.wheel]"));
        }
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        for arguments in [&["plan", "scene.toml"][..], &["run", "scene.toml", "--out", "out", "--quiet"]] {
            let (status, message) = command(folder.path(), arguments);
            assert_eq!(status, Some(2), "{words}: {message}");
            assert!(
                message.contains("pair.pinion.initial_flank.file") && message.contains(words),
                "{words}: {message}"
            );
            assert!(!folder.path().join("out").exists());
        }
    }
}

/// Points a little beyond the tip, by the digits of a file, are at the tip.
#[test]
fn points_at_the_tip_are_one() {
    let folder = tempfile::tempdir().unwrap();
    // Roll length at the tip of the preset's pinion: √((82.46/2)² − (36 cos 20°)²) = 23.5694 mm.
    fs::write(folder.path().join("flank.csv"), "roll_length_mm,height_um\n12,0\n20,-2\n23.570,-2\n23.571,-2\n")
        .unwrap();
    fs::write(folder.path().join("scene.toml"), scene("half-space", 1.0, &initial_flank("pinion", "flank.csv", "")))
        .unwrap();
    let (status, message) = command(folder.path(), &["plan", "scene.toml"]);
    assert_eq!(status, Some(0), "{message}");
}

/// A profile that does not reach the ends of the active profile is told; one with both flanks is read with the one that the scene names.
#[test]
fn a_short_profile_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "flank,roll_length_mm,height_um\nleft,12,0\nleft,14,-1\nleft,20,-2\nright,12,5\nright,20,5\n";
    fs::write(folder.path().join("flank.csv"), rows).unwrap();
    let text = scene("half-space", 1.0, &initial_flank("pinion", "flank.csv", "flank = \"left\""));
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    let (status, message) = command(folder.path(), &["run", "scene.toml", "--out", "out", "--quiet", "--no-report"]);
    assert_eq!(status, Some(0), "{message}");
    for words in [
        "pair.pinion.initial_flank.file: the profile of flank.csv begins at",
        "the start of active profile (SAP)",
        "ends at",
    ] {
        assert!(message.contains(words), "{message}");
    }
    let resolved = fs::read_to_string(folder.path().join("out/scene.toml")).unwrap();
    assert!(resolved.contains("file = \"inputs/flank.csv\""), "{resolved}");
    // A thirtieth of the roll length from start of active profile to tip: T1T2 − √((118.36/2)² − r_b2²) to √((82.46/2)² − r_b1²).
    let [pinion_base, wheel_base] = [36.0, 54.0].map(|radius| radius * 20f64.to_radians().cos());
    let beside = |hypotenuse: f64, side: f64| (hypotenuse * hypotenuse - side * side).sqrt();
    let begins = beside(91.5, pinion_base + wheel_base) - beside(0.5 * 118.36, wheel_base);
    let cutoff_mm = (beside(0.5 * 82.46, pinion_base) - begins) / 30.0;
    let line = resolved.lines().find_map(|line| line.strip_prefix("cutoff_mm = ")).unwrap();
    assert!((line.parse::<f64>().unwrap() / cutoff_mm - 1.0).abs() < 1e-9, "{line} and {cutoff_mm}");
    // The folder is a scene of its own.
    let (status, message) = command(&folder.path().join("out"), &["plan", "scene.toml"]);
    assert_eq!(status, Some(0), "{message}");
}

/// Heights of a helical flank are along the transverse line of action, depths of wear normal to the flank: a machine sees 1/cos β_b of the wear, with
/// tan β_b = tan β cos α_t (ISO 21771), a comparison takes it for the run's own, and a run begins with it.
#[test]
fn ver_heights_of_helical_flanks_are_transverse() {
    let folder = tempfile::tempdir().unwrap();
    let scene = |tables: &str| {
        let edits = [
            ("surface = \"half-space\"", "surface = \"hertz\""),
            ("# model = \"weber-banaschek\"", "model = \"weber-banaschek\" #"),
            ("# [stiffness]", "[stiffness] #"),
            ("# coupling = \"slicing\"", "coupling = \"none\" #"),
            ("slices = 20", "slices = 4"),
            ("flank_points = 750", "flank_points = 150"),
            ("positions = 185", "positions = 60"),
            ("verify = true", "verify = false"),
            ("error_estimate = true", "error_estimate = false"),
            ("snapshots_revolutions = ", "# snapshots_revolutions = "),
            ("tip_rounding_mm = 0.1", "tip_rounding_mm = 0.0"),
            ("[operation]", &format!("{tables}\n[operation]")),
        ];
        exchanged("helical", &edits)
    };
    run(folder.path(), "worn", &scene(""));
    let (status, message) = command(folder.path(), &["export", "worn", "--gear", "wheel", "--out", "wheel.csv"]);
    assert_eq!(status, Some(0), "{message}");
    let read_back =
        ["compare", "worn", "wheel.csv", "--fit", "none", "--form", "none", "--shift-within", "0", "--out", "read"];
    let (status, message) = command(folder.path(), &read_back);
    assert_eq!(status, Some(0), "{message}");
    let mut rows = csv::Reader::from_path(folder.path().join("read/compare.csv")).unwrap();
    let column = rows.headers().unwrap().iter().position(|name| name == "difference_um").unwrap();
    let greatest = rows.records().map(|row| row.unwrap()[column].parse::<f64>().unwrap().abs()).fold(0.0, f64::max);
    assert!(greatest < 1e-3, "{greatest}");
    run(folder.path(), "next", &scene(&initial_flank("wheel", "wheel.csv", "cutoff_mm = 0")));
    let base_helix = (15f64.to_radians().tan() * 20f64.to_radians().cos()).atan();
    let width_mm = 7.5;
    let pairs = [("worn", "wear_um"), ("next", "removed_um")].map(|(of, name)| {
        let mut rows = csv::Reader::from_path(folder.path().join(of).join("wheel.csv")).unwrap();
        let headers = rows.headers().unwrap().clone();
        let column = |name: &str| headers.iter().position(|own| own == name).unwrap();
        let rows = rows.records().map(|row| row.unwrap());
        let number = |row: &csv::StringRecord, name: &str| row[column(name)].parse::<f64>().unwrap();
        let of_slice = rows.filter(|row| number(row, "width_mm") == width_mm);
        of_slice.map(|row| (number(&row, "roll_angle_deg"), number(&row, name))).collect::<Vec<_>>()
    });
    let [wear, removed] = pairs;
    assert_eq!(wear.len(), 151);
    // The export begins at the root form circle; a constant is the gear's turning.
    let compared = wear.iter().zip(&removed).filter(|((_, wear), _)| *wear > 0.1).collect::<Vec<_>>();
    assert!(compared.len() > 80, "{wear:?}");
    let ((_, last_wear), (_, last_removed)) = compared[compared.len() - 1];
    let greatest = wear.iter().map(|(_, wear)| *wear).fold(0.0, f64::max);
    for ((_, wear), (_, removed)) in compared {
        let (lost, worn) = ((removed - last_removed) * base_helix.cos(), wear - last_wear);
        assert!((lost - worn).abs() < 1e-3 * greatest, "{lost} and {worn}");
    }
}
