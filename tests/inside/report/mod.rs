//! The files of a run, written from a made-up record.

mod plausible;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use gearwear::report;
use gearwear::report::ReportError;
use gearwear::resume::result;
use gearwear_physics::results::run::RunRecord;

const FILES: [&str; 11] = [
    "columns.json",
    "flank.vtu",
    "history.csv",
    "mesh_cycle.csv",
    "pinion.csv",
    "profiles.csv",
    "record.bin",
    "report.html",
    "scene.toml",
    "summary.json",
    "wheel.csv",
];

fn written(record: &RunRecord) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    write_all(record, dir.path()).unwrap();
    dir
}

fn names_in(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Everything a run leaves behind.
fn write_all(record: &RunRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let mut paths = report::write_data(record, dir)?;
    paths.push(report::write_page(record, dir)?);
    paths.push(result::write(record, dir)?);
    paths.push(report::write_summary(&record.summary, dir)?);
    Ok(paths)
}
fn read_csv(dir: &Path, name: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(dir.join(name)).unwrap();
    let header = reader.headers().unwrap().iter().map(String::from).collect();
    let rows = reader.records().map(|row| row.unwrap().iter().map(String::from).collect()).collect();
    (header, rows)
}

fn column(dir: &Path, name: &str, wanted: &str) -> Vec<f64> {
    let (header, rows) = read_csv(dir, name);
    let at = header.iter().position(|column| column == wanted).unwrap();
    rows.iter().map(|row| row[at].parse().unwrap()).collect()
}

#[test]
fn all_files_are_there_and_nothing_else() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("new").join("folder");
    let paths = write_all(&plausible::run(), &out).unwrap();
    assert_eq!(names_in(&out), FILES);
    let told: BTreeSet<_> = paths.into_iter().collect();
    assert_eq!(told, FILES.iter().map(|name| out.join(name)).collect());
}

#[test]
fn writing_again_replaces_the_files() {
    let dir = written(&plausible::run());
    write_all(&plausible::interrupted(), dir.path()).unwrap();
    assert_eq!(names_in(dir.path()), FILES);
    assert!(read_csv(dir.path(), "history.csv").1.is_empty());
}

#[test]
fn a_run_is_read_from_its_folder() {
    for record in [plausible::run(), plausible::interrupted()] {
        let dir = written(&record);
        assert_eq!(result::read(dir.path()).unwrap(), record);
        let summary = dir.path().join("summary.json");
        let refused = || result::read(dir.path()).unwrap_err().to_string();
        fs::write(&summary, "{}").unwrap();
        assert!(refused().contains("summary of another run"), "{}", refused());
        fs::remove_file(&summary).unwrap();
        assert!(refused().contains("found no summary.json"), "{}", refused());
    }
    assert!(result::read(Path::new("no such folder")).unwrap_err().to_string().contains("cannot be read"));
}

#[cfg(unix)]
#[test]
fn files_are_as_readable_as_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let dir = written(&plausible::run());
    fs::write(dir.path().join("ordinary"), "").unwrap();
    let mode = |name: &str| fs::metadata(dir.path().join(name)).unwrap().permissions().mode();
    for name in FILES {
        assert_eq!(mode(name), mode("ordinary"), "{name}");
    }
}

/// Names and order of columns are the contract's; what is added comes after.
#[test]
fn columns_are_those_of_the_contract() {
    let contract = [
        (
            "pinion.csv",
            "radius_mm,roll_angle_deg,width_mm,removed_um,sliding_mm_per_mesh,wear_um,pressure_new_MPa,pressure_worn_MPa",
        ),
        (
            "wheel.csv",
            "radius_mm,roll_angle_deg,width_mm,removed_um,sliding_mm_per_mesh,wear_um,pressure_new_MPa,pressure_worn_MPa",
        ),
        (
            "history.csv",
            "hours,revolutions,pinion_peak_wear_um,pinion_root_wear_um,pinion_pitch_wear_um,wheel_peak_wear_um,\
             peak_pressure_MPa,transmission_error_peak_to_peak_um",
        ),
        ("profiles.csv", "hours,gear,radius_mm,width_mm,wear_um"),
        (
            "mesh_cycle.csv",
            "position_mm,load_share_new,load_share_worn,peak_pressure_new_MPa,peak_pressure_worn_MPa,half_width_mm,\
             transmission_error_new_um,transmission_error_worn_um,temperature_rise_K",
        ),
    ];
    for record in [plausible::run(), plausible::interrupted()] {
        let dir = written(&record);
        for (name, columns) in contract {
            let header = read_csv(dir.path(), name).0.join(",");
            assert!(header.starts_with(columns), "{name}: {header}");
        }
    }
}

#[test]
fn tables_hold_every_row_and_every_bit() {
    let record = plausible::run();
    let dir = written(&record);
    let (pinion, wheel) = (&record.flanks.pinion, &record.flanks.wheel);
    assert_eq!(column(dir.path(), "pinion.csv", "radius_mm"), pinion.radius_mm);
    assert_eq!(column(dir.path(), "pinion.csv", "wear_um"), pinion.wear_um);
    assert_eq!(column(dir.path(), "wheel.csv", "pressure_worn_MPa"), wheel.pressure_worn_MPa);
    assert_eq!(column(dir.path(), "wheel.csv", "point").last(), Some(&(wheel.radius_mm.len() as f64 - 1.0)));
    let peaks: Vec<f64> = record.history.iter().map(|row| row.pinion_peak_wear_um).collect();
    assert_eq!(column(dir.path(), "history.csv", "pinion_peak_wear_um"), peaks);
    let shares: Vec<f64> = record.mesh_cycle.iter().map(|row| row.load_share_worn).collect();
    assert_eq!(column(dir.path(), "mesh_cycle.csv", "load_share_worn"), shares);
    let (header, rows) = read_csv(dir.path(), "mesh_cycle.csv");
    let temperature = header.iter().position(|name| name == "temperature_rise_K").unwrap();
    assert!(rows.iter().all(|row| row[temperature].is_empty()), "what was not computed is empty");
}

#[test]
fn profiles_hold_both_flanks_at_every_snapshot() {
    let record = plausible::run();
    let dir = written(&record);
    let (_, rows) = read_csv(dir.path(), "profiles.csv");
    let points = record.flanks.pinion.radius_mm.len() + record.flanks.wheel.radius_mm.len();
    assert_eq!(rows.len(), points * record.history.len());
    let wheel_at_first: Vec<f64> =
        rows.iter().filter(|row| row[0] == "0.25" && row[1] == "wheel").map(|row| row[4].parse().unwrap()).collect();
    assert_eq!(wheel_at_first, record.flanks.wheel.snapshot_wear_um[0]);
}

/// Any plain reader reads the tables: their first line names the columns, and what these hold stands beside.
#[test]
fn columns_are_described_beside_the_tables() {
    let dir = written(&plausible::run());
    let text = fs::read_to_string(dir.path().join("columns.json")).unwrap();
    let columns: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!([&columns["program_version"], &columns["scene_hash"]], ["0.1.0", "0123456789abcdef"]);
    for name in FILES.iter().filter(|name| name.ends_with(".csv")) {
        let (header, _) = read_csv(dir.path(), name);
        let described = columns["files"][name].as_object().unwrap();
        assert_eq!(described.len(), header.len(), "{name}");
        for column in header {
            assert!(!described[&column].as_str().unwrap().is_empty(), "{name}: {column}");
        }
    }
}

#[test]
fn scene_is_kept_byte_for_byte() {
    let record = plausible::run();
    let dir = written(&record);
    assert_eq!(fs::read_to_string(dir.path().join("scene.toml")).unwrap(), record.scene_toml);
}

#[test]
fn summary_has_the_keys_of_the_contract() {
    let mut record = plausible::run();
    record.summary.worn.pitch_pressure_MPa = f64::NAN;
    let dir = written(&record);
    let text = fs::read_to_string(dir.path().join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    for pointer in [
        "/title",
        "/stages/0/name",
        "/stages/0/wall_s",
        "/wall_s",
        "/geometry/transverse_contact_ratio",
        "/geometry/overlap_ratio",
        "/geometry/base_pitch_mm",
        "/geometry/working_pressure_angle_deg",
        "/geometry/curvature_radius_mm/A",
        "/geometry/curvature_radius_mm/E",
        "/geometry/pitch_point_index",
        "/contact/line_load_N_per_mm",
        "/contact/foundation_MPa_per_mm",
        "/contact/hertz_half_width_mm",
        "/contact/hertz_peak_pressure_MPa",
        "/new/peak_pressure_MPa",
        "/new/sharp_edge_pressure_MPa",
        "/new/pitch_pressure_MPa",
        "/worn/transmission_error_um/min",
        "/worn/transmission_error_um/max",
        "/worn/transmission_error_um/peak_to_peak",
        "/pinion/peak_wear_um",
        "/pinion/peak_wear_radius_mm",
        "/pinion/tip_edge_wear_um",
        "/pinion/below_sap_wear_um",
        "/pinion/root_wear_um",
        "/wheel/pitch_wear_um",
        "/wheel/worn_volume_mm3",
        "/wheel/worn_mass_mg",
        "/error/discretisation",
        "/error/wear_step",
        "/error/surface_model",
        "/warnings/0",
    ] {
        assert!(summary.pointer(pointer).is_some(), "{pointer} is missing");
    }
    assert!(summary["worn"]["pitch_pressure_MPa"].is_null(), "not a number is null");
    assert_eq!(summary["pinion"]["peak_wear_um"].as_f64(), Some(record.summary.pinion.peak_wear_um));
}

#[test]
fn page_stands_alone() {
    for record in [plausible::run(), plausible::interrupted()] {
        let page = fs::read_to_string(written(&record).path().join("report.html")).unwrap();
        // Plots are clipped to areas of the page itself, and saved from it.
        let own = page.to_lowercase().replace("url(#", "").replace("todataurl(", "");
        for outside in ["http:", "https:", "src=", "<link", "@import", "url("] {
            assert!(!own.contains(outside), "{outside} in the page");
        }
        assert!(page.len() < 700_000, "{} bytes", page.len());
        assert_eq!(page.matches("<script").count(), page.matches("</script>").count());
    }
}

#[test]
fn what_the_user_wrote_is_text_in_the_page() {
    let own = fs::read_to_string(written(&plausible::run()).path().join("report.html")).unwrap().to_lowercase();
    assert!(own.contains("<h1>&lt;b&gt;fzg&lt;/b&gt; type c &amp; &quot;128&quot; hours</h1>"));
    assert!(!own.contains("<b>fzg"));
    assert!(own.contains("pinion_speed_rpm &lt;150&gt;"));
}

#[test]
fn page_answers_in_a_sentence_with_numbers() {
    let page = fs::read_to_string(written(&plausible::run()).path().join("report.html")).unwrap();
    assert!(page.contains("After 127.75\u{a0}h (1.15 million pinion revolutions) the pinion has lost up to"));
    assert!(page.contains("close to A"));
    for id in ["pair", "wear-pinion", "wear-wheel", "pressure-pinion", "load-sharing", "transmission-error", "history"]
    {
        assert!(page.contains(&format!("<div class=\"plot\" id=\"{id}\"")), "{id}");
    }
}

/// First the answer and wear and pressure as pictures, then warnings and three tables, then all else behind headings that open it.
#[test]
fn page_begins_with_pictures() {
    let page = fs::read_to_string(written(&plausible::run()).path().join("report.html")).unwrap();
    let at = |what: &str| page.find(what).unwrap_or_else(|| panic!("no {what}"));
    let order = [
        "class=\"answer\"",
        "id=\"wear-pinion\"",
        "id=\"pressure-wheel\"",
        "id=\"warnings\"",
        "The pair</span>",
        "<details class=\"fold\" id=\"wear-law\"",
        "id=\"history\"",
        "id=\"load-sharing\"",
        "id=\"pair\"",
        "<details class=\"fold\" id=\"sources\"",
    ];
    assert!(order.windows(2).all(|pair| at(pair[0]) < at(pair[1])), "{:?}", order.map(at));
    let figures = page.matches("<b>Figure ").count();
    assert!((1..=figures).all(|number| page.contains(&format!("<b>Figure {number}."))), "figures are numbered");
}

#[test]
fn modifications_are_shown_only_where_there_are_any() {
    let mut record = plausible::run();
    record.flanks.wheel.removed_um.fill(0.0);
    let page = fs::read_to_string(written(&record).path().join("report.html")).unwrap();
    assert!(page.contains("id=\"modifications-pinion\""));
    assert!(!page.contains("id=\"modifications-wheel\""));
}

#[test]
fn an_interrupted_run_says_so() {
    let page = fs::read_to_string(written(&plausible::interrupted()).path().join("report.html")).unwrap();
    assert!(page.contains("The run was interrupted after 0 h (0 pinion revolutions)."));
    assert!(page.contains("neither flank has worn"));
    assert!(
        !fs::read_to_string(written(&plausible::run()).path().join("report.html"))
            .unwrap()
            .contains("interrupted after")
    );
}

/// Nothing computed at all: every table and plot is empty, and the page still stands.
#[test]
fn an_empty_record_can_be_shown() {
    let mut record = plausible::interrupted();
    record.mesh_cycle.clear();
    for flank in [&mut record.flanks.pinion, &mut record.flanks.wheel] {
        for values in [
            &mut flank.radius_mm,
            &mut flank.roll_angle_deg,
            &mut flank.removed_um,
            &mut flank.sliding_mm_per_mesh,
            &mut flank.wear_um,
            &mut flank.pressure_new_MPa,
            &mut flank.pressure_worn_MPa,
        ] {
            values.clear();
        }
    }
    record.drawing.path_of_contact.clear();
    let dir = written(&record);
    assert_eq!(names_in(dir.path()), FILES);
}

#[test]
fn probing_a_folder_leaves_nothing_behind() {
    let dir = tempfile::tempdir().unwrap();
    report::writable(&dir.path().join("a").join("b")).unwrap();
    assert!(names_in(dir.path()).is_empty());
    report::writable(dir.path()).unwrap();
    assert!(names_in(dir.path()).is_empty() && dir.path().is_dir());
}

#[test]
fn a_file_in_the_way_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("taken");
    fs::write(&file, "").unwrap();
    assert!(matches!(report::writable(&file), Err(ReportError::NotAFolder { path }) if path == file));
    assert!(matches!(report::writable(&file.join("out")), Err(ReportError::CreateFolder { .. })));
    assert!(matches!(write_all(&plausible::run(), &file), Err(ReportError::NotAFolder { .. })));
}
