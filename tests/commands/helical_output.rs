//! What `gearwear run` writes for a helical pair: files, rows and columns, the same numbers in all of them, flanks that touch.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use serde_json::Value;
use tempfile::TempDir;
use vtkio::model::{Attribute, DataSet};

use crate::program::{exchanged, gearwear};

const SLICES: usize = 5;
const POINTS: usize = 301;

/// The preset `thesis-helical` with five slices, and fewer points and steps.
fn quick_helical() -> String {
    exchanged(
        "thesis-helical",
        &[
            ("slices = 20 ", "slices = 5 "),
            ("flank_points = 750 ", "flank_points = 300 "),
            ("positions = 400 ", "positions = 60 "),
            ("step = { revolutions = 10000.0 }", "step = { revolutions = 100000.0 }"),
            ("error_estimate = true ", "verify = false\nerror_estimate = false "),
        ],
    )
}

fn run(folder: &Path, scene: &str) -> String {
    let file = folder.join("scene.toml");
    fs::write(&file, scene).unwrap();
    let output = gearwear().arg("run").arg(&file).arg("--out").arg(folder.join("out")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The run that the tests read: its folder, and what it printed.
static RUN: LazyLock<(TempDir, String)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let printed = run(folder.path(), &quick_helical());
    (folder, printed)
});

fn path(name: &str) -> std::path::PathBuf {
    RUN.0.path().join("out").join(name)
}

fn summary() -> Value {
    serde_json::from_slice(&fs::read(path("summary.json")).unwrap()).unwrap()
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer}"))
}

/// Columns of numbers by name; other text is left out.
fn columns(name: &str) -> BTreeMap<String, Vec<f64>> {
    let mut reader = csv::Reader::from_path(path(name)).unwrap();
    let header: Vec<String> = reader.headers().unwrap().iter().map(String::from).collect();
    let mut columns: BTreeMap<String, Vec<f64>> = header.iter().map(|name| (name.clone(), Vec::new())).collect();
    for row in reader.records() {
        for (name, field) in header.iter().zip(row.unwrap().iter()) {
            columns.get_mut(name).unwrap().extend(field.parse::<f64>());
        }
    }
    columns
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// One row a flank point and slice, slice after slice, with the figures of the summary in them.
#[test]
fn flank_tables_have_a_row_for_each_point_and_slice() {
    let summary = summary();
    for gear in ["pinion", "wheel"] {
        let flank = columns(&format!("{gear}.csv"));
        assert_eq!(flank["wear_um"].len(), SLICES * POINTS);
        let slices: Vec<f64> = (0..SLICES).flat_map(|slice| vec![slice as f64; POINTS]).collect();
        assert_eq!(flank["slice"], slices);
        // Five slices of 20 mm: their middles.
        let middles: Vec<f64> = slices.iter().map(|slice| 4.0 * slice + 2.0).collect();
        assert_eq!(flank["width_mm"], middles);
        let zones = ["peak", "tip_edge", "below_sap"].map(|zone| number(&summary, &format!("/{gear}/{zone}_wear_um")));
        // Of five slices the outermost lie farther from the end faces than where the summary reads what is greatest.
        let read_beyond = |most: f64, read: f64| assert!((most..=1.1 * most).contains(&read), "{gear}: {most}, {read}");
        read_beyond(greatest(&flank["wear_um"]), greatest(&zones));
        read_beyond(greatest(&flank["pressure_new_MPa"]), number(&summary, "/new/peak_pressure_MPa"));
        let root = summary.pointer(&format!("/helical/wear/{gear}/root_wear_um")).unwrap().as_array().unwrap();
        assert_eq!(root.len(), SLICES);
    }
    let profiles = columns("profiles.csv");
    let snapshots = columns("history.csv")["revolutions"].len();
    assert_eq!(profiles["slice"].len(), snapshots * 2 * SLICES * POINTS);
}

/// Positions of the tooth from the first slice's A to the last slice's E; slices only where a part of them is within A–E; at every place
/// of the gears all teeth and slices together carry the whole line load.
#[test]
fn ver_slices_csv_carries_the_whole_load_at_every_place() {
    let (summary, table) = (summary(), columns("slices.csv"));
    let [a, e] = ["A", "E"].map(|point| number(&summary, &format!("/geometry/curvature_radius_mm/{point}")));
    let pitch = number(&summary, "/geometry/base_pitch_mm");
    let whole = number(&summary, "/contact/line_load_N_per_mm");
    let tan_beta_b = number(&summary, "/helical/base_helix_angle_deg").to_radians().tan();
    let distinct = table["position_mm"].windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0);
    let spacing = distinct.fold(f64::INFINITY, f64::min);
    // A slice is in contact from where its first side is, within a position's stretch, though its middle be outside A–E.
    let reach = 0.5 * (20.0 / SLICES as f64 * tan_beta_b + spacing);
    let column = |name: &str| table[name].iter().copied();
    for ((position, at), width) in column("position_mm").zip(column("slice_position_mm")).zip(column("width_mm")) {
        assert!((a - reach..e + reach).contains(&at), "{at}");
        let ahead = (10.0 - width) * tan_beta_b;
        assert!((at - position - ahead).abs() < 1e-12, "{at} at {position}, {width}");
    }
    let mut loads: BTreeMap<i64, f64> = BTreeMap::new();
    let first = table["position_mm"][0];
    for (position, load) in column("position_mm").zip(column("line_load_worn_N_per_mm")) {
        // The same place of the gears a base pitch later is the next tooth's.
        let phase = ((position - first) / spacing).round().rem_euclid((pitch / spacing).round());
        *loads.entry(phase as i64).or_default() += load / SLICES as f64;
    }
    assert_eq!(loads.len(), (pitch / spacing).round() as usize);
    for load in loads.values() {
        assert!((load / whole - 1.0).abs() < 1e-9, "{load} of {whole}");
    }
    assert!(greatest(&table["peak_pressure_new_MPa"]) > 1000.0);
}

/// Points, quadrilaterals with their gear, and data at the points by name.
struct Flanks {
    points: Vec<[f64; 3]>,
    quads: Vec<[usize; 4]>,
    gear: Vec<i64>,
    data: BTreeMap<String, Vec<f64>>,
}

fn flanks() -> Flanks {
    let vtk = vtkio::Vtk::parse_xml(fs::read(path("flank.vtu")).unwrap().as_slice()).expect("vtkio reads it");
    let DataSet::UnstructuredGrid { pieces, .. } = vtk.data else { panic!("not an unstructured grid") };
    let piece = pieces[0].load_piece_data(None).expect("one piece inline");
    let coordinates: Vec<f64> = piece.points.clone().cast_into().unwrap();
    let (nodes, ends) = piece.cells.cell_verts.clone().into_xml();
    assert!(ends.iter().enumerate().all(|(i, &end)| end as usize == 4 * (i + 1)), "quadrilaterals alone");
    let array = |attribute: &Attribute| match attribute {
        Attribute::DataArray(array) => (array.name.clone(), array.data.clone()),
        Attribute::Field { .. } => panic!("a field"),
    };
    let (name, gear) = array(&piece.data.cell[0]);
    assert_eq!(name, "gear");
    Flanks {
        points: coordinates.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
        quads: nodes.chunks_exact(4).map(|n| [0, 1, 2, 3].map(|i| n[i] as usize)).collect(),
        gear: gear.cast_into().unwrap(),
        data: piece.data.point.iter().map(array).map(|(name, data)| (name, data.cast_into::<f64>().unwrap())).collect(),
    }
}

/// Both flanks from end face to end face with the numbers of the CSV files at the middle of every slice.
#[test]
fn flank_vtu_holds_the_numbers_of_the_tables() {
    let flanks = flanks();
    let tables = ["pinion", "wheel"].map(|gear| columns(&format!("{gear}.csv")));
    assert_eq!(flanks.gear.len(), flanks.quads.len());
    let mut points_of = [BTreeMap::new(), BTreeMap::new()];
    for (quad, &gear) in flanks.quads.iter().zip(&flanks.gear) {
        for &point in quad {
            points_of[gear as usize].insert(point, ());
        }
    }
    let summary = summary();
    for (gear, (points, table)) in points_of.iter().zip(&tables).enumerate() {
        let name = ["pinion", "wheel"][gear];
        let root_form = 0.5 * number(&summary, &format!("/geometry/gears/{name}/root_form_diameter_mm"));
        let on_involute: Vec<usize> =
            (0..table["wear_um"].len()).filter(|&row| table["radius_mm"][row] >= root_form).collect();
        // The slices' middles and the two end faces.
        assert_eq!(points.len() * SLICES, on_involute.len() * (SLICES + 2), "{name}");
        for column in
            ["removed_um", "sliding_mm_per_mesh", "wear_um", "pressure_new_MPa", "pressure_worn_MPa", "radius_mm"]
        {
            let within = |&&point: &&usize| (1.0..19.0).contains(&flanks.data["width_mm"][point]);
            let all: Vec<f64> = points.keys().filter(within).map(|&point| flanks.data[column][point]).collect();
            let expected: Vec<f64> = on_involute.iter().map(|&row| table[column][row]).collect();
            assert_eq!(all, expected, "{name} {column}");
        }
        let axis_y = [0.0, 91.5][gear];
        for &point in points.keys() {
            let [x, y, z] = flanks.points[point];
            assert!((x.hypot(y - axis_y) - flanks.data["radius_mm"][point]).abs() < 1e-12);
            assert_eq!(z, flanks.data["width_mm"][point]);
        }
        let widths = points.keys().map(|&point| flanks.data["width_mm"][point]);
        assert_eq!(widths.fold([20.0_f64, 0.0], |[low, high], z| [low.min(z), high.max(z)]), [0.0, 20.0]);
    }
}

/// In the file the flanks of both gears touch: in every section the two rows of points cross the line of action in the same point,
/// to what a chord between points of 0.03 mm is off its curve (0.03²/8ρ, ρ ≥ 4 mm: 3e-5 mm), and the quadrilaterals look out of
/// their teeth, at each other.
#[test]
fn ver_flanks_in_the_file_touch_along_the_line_of_contact() {
    let (flanks, summary) = (flanks(), summary());
    let alpha = number(&summary, "/geometry/working_pressure_angle_deg").to_radians();
    let r_b1 = 0.5 * number(&summary, "/geometry/gears/pinion/base_diameter_mm");
    let (sin, cos) = alpha.sin_cos();
    // Along and across the line of action, from T1.
    let frame = |[x, y, _]: [f64; 3]| {
        let (x, y) = (x - r_b1 * sin, y - r_b1 * cos);
        (-x * cos + y * sin, x * sin + y * cos)
    };
    let crossings = |gear: i64| -> BTreeMap<i64, f64> {
        let mut found = BTreeMap::new();
        for (quad, _) in flanks.quads.iter().zip(&flanks.gear).filter(|(_, of)| **of == gear) {
            for (from, to) in [(quad[0], quad[3]), (quad[1], quad[2])] {
                let ((along_0, across_0), (along_1, across_1)) = (frame(flanks.points[from]), frame(flanks.points[to]));
                if across_0 * across_1 <= 0.0 && across_0 != across_1 {
                    let along = along_0 + (along_1 - along_0) * across_0 / (across_0 - across_1);
                    found.insert((1e6 * flanks.points[from][2]).round() as i64, along);
                }
            }
        }
        found
    };
    let (pinion, wheel) = (crossings(0), crossings(1));
    assert_eq!((pinion.len(), wheel.len()), (SLICES + 2, SLICES + 2));
    let pitch_point = number(&summary, "/geometry/curvature_radius_mm/C");
    let tan_beta_b = number(&summary, "/helical/base_helix_angle_deg").to_radians().tan();
    for (width, along) in &pinion {
        assert!((along - wheel[width]).abs() < 3e-5, "{} mm apart at {width}", along - wheel[width]);
        let expected = pitch_point + (10.0 - *width as f64 * 1e-6) * tan_beta_b;
        assert!((along - expected).abs() < 3e-5, "{along} instead of {expected}");
    }
    // Outward: the pinion pushes along the line of action, the wheel against it.
    for (quad, gear) in flanks.quads.iter().zip(&flanks.gear) {
        let [a, b, d] = [quad[0], quad[1], quad[3]].map(|node| flanks.points[node]);
        let [u, v] = [b, d].map(|to| [0, 1, 2].map(|axis| to[axis] - a[axis]));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]];
        let out = &flanks.data["transverse_normal"][3 * quad[0]..3 * quad[0] + 2];
        assert!(normal[0] * out[0] + normal[1] * out[1] > 0.0, "gear {gear}, {normal:?} {out:?}");
    }
}

#[test]
fn the_page_shows_the_whole_flank() {
    let page = fs::read_to_string(path("report.html")).unwrap();
    for id in [
        "map-wear",
        "map-sliding",
        "map-pressure-new",
        "map-pressure-worn",
        "surface",
        "over-width",
        "wear",
        "pressure",
    ] {
        for gear in ["pinion", "wheel"] {
            assert!(page.contains(&format!("<div class=\"plot\" id=\"{id}-{gear}\"")), "{id}-{gear}");
        }
    }
    for id in ["slice-load-new", "slice-load-worn", "load-sharing", "transmission-error", "mesh-orders", "history"] {
        assert!(page.contains(&format!("<div class=\"plot\" id=\"{id}\"")), "{id}");
    }
    for words in ["slices.csv", "flank.vtu", "Face load factor", "Overlap ratio", "Total contact ratio", "mesh order 5"]
    {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("map-modifications"), "the preset has none");
}

#[test]
fn the_terminal_tells_how_even_load_and_wear_are() {
    let printed = &RUN.1;
    for words in
        ["face load factor ", "transmission error, first mesh order, µm", "variation of root wear over the width, %"]
    {
        assert!(printed.contains(words), "{words} in {printed}");
    }
}

/// A spur pair has sections alike: no table of slices, and none that an earlier run has left; its flanks in space are there.
#[test]
fn a_spur_run_in_the_same_folder_takes_the_slices_away() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    run(folder.path(), &quick_helical());
    assert!(out.join("slices.csv").is_file() && out.join("flank.vtu").is_file());
    let spur = exchanged(
        "thesis-spur",
        &[
            ("flank_points = 750 ", "flank_points = 200 "),
            ("positions = 400 ", "positions = 60 "),
            ("step = { revolutions = 7665.0 }", "step = { revolutions = 100000.0 }"),
            ("error_estimate = true ", "error_estimate = false\nverify = false "),
        ],
    );
    let printed = run(folder.path(), &spur);
    assert!(!out.join("slices.csv").exists() && out.join("flank.vtu").is_file());
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(!page.contains("slices.csv") && !page.contains("map-wear") && !printed.contains("K_Hbeta"));
}

/// Sections that differ by crowning alone have slices too, and a map of the modifications; a single slice, in the middle, shows
/// none of it and is no trouble.
#[test]
fn a_crowned_spur_pair_is_shown_slice_by_slice() {
    for (slices, shown) in [(5, true), (1, false)] {
        let folder = tempfile::tempdir().unwrap();
        let scene = quick_helical()
            .replace("helix_angle_deg = 15.0", "helix_angle_deg = 0.0")
            .replace("# lead_crowning_um", "lead_crowning_um")
            .replace("slices = 5 ", &format!("slices = {slices} "));
        run(folder.path(), &scene);
        let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
        assert!(page.contains("id=\"map-wear-pinion\"") && folder.path().join("out/flank.vtu").is_file());
        assert_eq!(page.contains("id=\"map-modifications-pinion\""), shown, "{slices} slices");
        // Crowning of 10 µm is parabolic over the half-width: 10 · 0.8² at the middle of the first of five slices.
        assert_eq!(
            page.contains("Modifications, or what was measured, take up to 6.400\u{a0}µm"),
            shown,
            "{slices} slices"
        );
    }
}

/// A face width that asks for more teeth in mesh than a gear has, with slices coupled in space by name.
#[test]
fn teeth_that_cannot_be_had_in_space_are_refused_at_their_key() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let wide = exchanged(
        "helical",
        &[("face_width_mm = 20.0", "face_width_mm = 900.0"), ("# coupling = \"slicing\" ", "coupling = \"fem\" ")],
    );
    fs::write(&file, wide).unwrap();
    let output = gearwear().arg("run").arg(&file).arg("--out").arg(folder.path().join("out")).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("pair.face_width_mm") && told.contains("teeth may touch together"), "{told}");
    assert!(!folder.path().join("out").join("summary.json").exists());
}
