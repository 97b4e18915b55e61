use serde_json::{Value, json};

use super::attributes::{CUSTOM, Naming, Of, figures};
use super::document::RexsDocument;
use super::mesh_stiffness::MeshStiffness;
use super::results::{RunResults, WearDepths, WithResults, with_results};
use super::same_loads::Loads;
use super::{RexsError, VERSIONS, scene};
use crate::evaluate::output::SummaryOutput;
use crate::scene::Resolved;
use gearwear_bodies::gear::PerGear;

const TWO_STAGES: &str = include_str!("two_stages.rexs");

/// A run of stage 1 under these loads, torque in N·m and speed in 1/min: of every figure there is the number that the test looks for.
fn run(loads: &[[f64; 2]]) -> RunResults {
    let text = scene(TWO_STAGES, Some(1)).unwrap().text;
    let pair = Resolved::from_toml(&text).unwrap().scene.pair;
    let phases: Vec<Value> = loads
        .iter()
        .map(|[torque, speed]| {
            let wear =
                json!({ "greatest_depth_um": torque / 100.0, "tip_edge_depth_um": 0.5, "below_sap_depth_um": 0.25 });
            json!({
                "pinion_torque_Nm": torque, "pinion_speed_rpm": speed, "line_load_N_per_mm": 600.0,
                "hertz_peak_pressure_MPa": 1500.0, "greatest_rise_K": null, "pinion": wear, "wheel": wear,
            })
        })
        .collect();
    let section = json!({ "nominal_stress_MPa": 123.5, "form_factor": 1.4, "stress_correction_factor": 2.1 });
    let summary = json!({
        "program_version": "0.1.0", "scene_hash": "0123456789abcdef", "reference_phase": 1, "phases": phases,
        "hours": 2000.0, "contact": { "hertz_peak_pressure_MPa": 1500.0 }, "helical": { "K_Hbeta_new": 1.25 },
        "pinion": { "peak_wear_um": 4.5 }, "wheel": { "peak_wear_um": 3.5 },
        "root_stress": { "pinion": { "iso_6336_3": section, "vdi_2736": section }, "wheel": { "iso_6336_3": null } },
    });
    let wear_profile = WearDepths { radius_mm: vec![35.0, 41.25], depth_um: vec![0.0, 4.5] };
    RunResults {
        summary,
        pair,
        mesh_stiffness: MeshStiffness {
            pinion_rotation_deg: (0..30).map(f64::from).collect(),
            new_N_per_mm_um: vec![20.0; 30],
            worn_N_per_mm_um: vec![19.0; 30],
        },
        wear_profile: PerGear { pinion: wear_profile.clone(), wheel: wear_profile },
    }
}

/// The loads of the file: the external load of each case, where it says one, and the speed of the shaft.
const OF_THE_FILE: [[f64; 2]; 2] = [[302.0, 1500.0], [100.0, 750.0]];

fn written(text: &str, run: &RunResults) -> WithResults {
    let with = with_results(text, Some(1), run).unwrap();
    // The file is still one of the format, for our reader and for another, and the same run changes it no more.
    RexsDocument::parse(&with.text).unwrap();
    roxmltree::Document::parse(&with.text).unwrap();
    assert_eq!(with_results(&with.text, Some(1), run).unwrap().text, with.text);
    with
}

/// The file without its load spectrum, and so with the load of its components: 100 N·m.
fn without_load_spectrum() -> String {
    let (start, end) = (TWO_STAGES.find("  <load_spectrum").unwrap(), TWO_STAGES.find("</model>").unwrap());
    format!("{}{}", &TWO_STAGES[..start], &TWO_STAGES[end..])
}

/// The file with the first of its load cases alone.
fn with_one_load_case() -> String {
    let start = TWO_STAGES.find("    <load_case id=\"2\">").unwrap();
    let end = TWO_STAGES.find("    <accumulation>").unwrap();
    format!("{}{}", &TWO_STAGES[..start], &TWO_STAGES[end..])
}

/// Unit and text of an attribute of a component in the part of the file that the path of element names ends in.
fn attribute(text: &str, section: &[&str], component: &str, id: &str) -> Option<(String, String)> {
    let document = roxmltree::Document::parse(text).unwrap();
    let is_of = |node: &roxmltree::Node| {
        let names: Vec<&str> = node.ancestors().skip(1).map(|above| above.tag_name().name()).collect();
        node.attribute("id") == Some(component) && section.iter().rev().eq(names.iter().take(section.len()))
    };
    let components = document.descendants().filter(|node| node.has_tag_name("component")).filter(is_of);
    let mut found = components.flat_map(|node| node.children()).filter(|node| node.attribute("id") == Some(id));
    let first = found.next()?;
    assert!(found.next().is_none(), "{id} stands twice");
    let text: String = first.descendants().filter(|node| node.is_text()).filter_map(|node| node.text()).collect();
    Some((first.attribute("unit").unwrap().to_owned(), text))
}

fn value(unit: &str, text: &str) -> Option<(String, String)> {
    Some((unit.to_owned(), text.to_owned()))
}

const MODEL: &[&str] = &["model", "components"];
const ACCUMULATION: &[&str] = &["load_spectrum", "accumulation"];
const LOAD_CASE: &[&str] = &["load_spectrum", "load_case"];

/// Lines of the file are lines of the new one, in their order, and what is between them are attributes and the elements they stand in.
#[test]
fn ver_all_else_stays_byte_for_byte() {
    for text in [TWO_STAGES.to_owned(), without_load_spectrum(), with_one_load_case()] {
        let new = written(&text, &run(&OF_THE_FILE)).text;
        let mut lines = new.split('\n').peekable();
        for line in text.split('\n') {
            while let Some(other) = lines.next_if(|other| *other != line) {
                let of_new =
                    ["<attribute id=", "<component id=", "</component>", "<relation ", "</relation>", "<ref id="];
                assert!(of_new.iter().any(|start| other.trim_start().starts_with(start)), "{other} before {line}");
            }
            assert_eq!(lines.next(), Some(line));
        }
        assert_eq!(lines.next(), None);
    }
}

/// Without a load spectrum all stands in the components of the model; gears that have no data in the stage get them.
#[test]
fn results_without_load_spectrum_stand_in_the_model() {
    let with = written(&without_load_spectrum(), &run(&[[100.0, 1500.0]]));
    assert!(with.warnings.is_empty(), "{:?}", with.warnings);
    let stage = |id: &str| attribute(&with.text, MODEL, "10", id);
    assert_eq!(stage("face_load_factor_flank"), value("none", "1.25"));
    assert_eq!(stage("custom_gearwear_hertzian_pressure_at_pitch_point"), value("N / mm^2", "1500.0"));
    assert_eq!(stage("custom_gearwear_mean_mesh_stiffness_new"), value("N / (mm mum)", "20.0"));
    assert_eq!(stage("custom_gearwear_scene_hash"), value("none", "0123456789abcdef"));
    assert_eq!(stage("custom_gearwear_running_time"), value("h", "2000.0"));
    // What the run has no number for stands nowhere.
    assert!(!with.text.contains("degree_of_tooth_loss") && !with.text.contains("null"), "{}", with.text);
    // 5 and 6 are the first numbers that no component has, 19 and 20 that no relation has.
    for (component, wear, gear, relation) in [("5", "4.5", "11", "19"), ("6", "3.5", "12", "20")] {
        let id = "custom_gearwear_maximum_wear_depth";
        assert_eq!(attribute(&with.text, MODEL, component, id), value("mum", wear));
        let document = RexsDocument::parse(&with.text).unwrap();
        let related = document.relation("stage_gear_data", &[("stage", "10"), ("gear", gear)]).unwrap();
        assert_eq!(related.member("stage_gear_data"), Some(component));
        assert!(with.text.contains(&format!("<relation id=\"{relation}\" type=\"stage_gear_data\">")));
    }
    let depth = attribute(&with.text, MODEL, "5", "custom_gearwear_wear_depth").unwrap();
    let diameters = attribute(&with.text, MODEL, "5", "custom_gearwear_wear_depth_diameters").unwrap();
    assert_eq!((depth.1.as_str(), diameters.1.as_str()), ("0.04.5", "70.082.5"));
}

/// A run of a lubricated pair, of which the pinion is a plastic: each figure has its own number.
fn lubricated() -> RunResults {
    let mut run = run(&[[100.0, 1500.0]]);
    let path = |value: f64| json!({ "min": value, "max": 900.0, "mean": 901.0 });
    run.summary["lubrication"] = json!({
        "oil": { "bulk_temperature_C": 78.5 },
        "losses": {
            "loss_factor_ohlendorf": 0.195, "mesh_power_loss_new_W": 177.5, "mesh_power_loss_worn_W": 166.5,
            "efficiency_new": 0.9925, "efficiency_worn": 0.9935,
        },
        "friction": { "mean_new": 0.045, "mean_worn": 0.044 },
        "film": {
            "minimum_film_new_um": path(0.375), "minimum_film_worn_um": path(0.365), "lambda_new": path(0.875),
            "lambda_worn": path(0.865), "micropitting_safety_new": 1.125, "micropitting_safety_worn": 1.115,
            "greatest_flash_new_K": 46.5, "greatest_flash_worn_K": 45.5,
        },
        "method_b": { "micropitting_safety": 1.25 },
        "scuffing": {
            "contact_temperature_C": 119.0, "integral_temperature_C": 158.0, "scuffing_safety": 1.5,
            "integral_scuffing_safety": 0.96,
        },
    });
    run.summary["temperature"] = json!({
        "greatest_rise_new_K": 33.5, "greatest_rise_worn_K": 32.5,
        "tooth": { "pinion": null, "wheel": { "flank_C": 61.5, "root_C": 41.5 } },
    });
    run.summary["pinion"]["vdi_2736_mean_wear_um"] = json!(12.5);
    run
}

/// Figures of films, friction, scuffing and of VDI 2736 in the unit of their attribute; W_m is in mm.
#[test]
fn ver_figures_of_films_and_wear_stand_in_their_unit() {
    let run = lubricated();
    let with = written(&without_load_spectrum(), &run);
    for (id, unit, text) in [
        ("degree_of_tooth_loss_vdi_2736_2014", "none", "0.195"),
        ("custom_gearwear_mesh_power_loss_new", "W", "177.5"),
        ("custom_gearwear_mesh_power_loss_worn", "W", "166.5"),
        ("custom_gearwear_mesh_efficiency_new", "none", "0.9925"),
        ("custom_gearwear_mesh_efficiency_worn", "none", "0.9935"),
        ("custom_gearwear_mean_coefficient_of_friction_new", "none", "0.045"),
        ("custom_gearwear_mean_coefficient_of_friction_worn", "none", "0.044"),
        ("custom_gearwear_minimum_lubricant_film_thickness_new", "mum", "0.375"),
        ("custom_gearwear_minimum_lubricant_film_thickness_worn", "mum", "0.365"),
        ("custom_gearwear_minimum_specific_lubricant_film_thickness_new", "none", "0.875"),
        ("custom_gearwear_minimum_specific_lubricant_film_thickness_worn", "none", "0.865"),
        ("custom_gearwear_safety_factor_micropitting_method_a_new", "none", "1.125"),
        ("custom_gearwear_safety_factor_micropitting_method_a_worn", "none", "1.115"),
        ("custom_gearwear_safety_factor_micropitting_method_b", "none", "1.25"),
        ("custom_gearwear_maximum_flash_temperature_new", "K", "46.5"),
        ("custom_gearwear_maximum_flash_temperature_worn", "K", "45.5"),
        ("custom_gearwear_maximum_contact_temperature_iso_ts_6336_20", "C", "119.0"),
        ("custom_gearwear_integral_temperature_iso_ts_6336_21", "C", "158.0"),
        ("custom_gearwear_safety_factor_scuffing_iso_ts_6336_20", "none", "1.5"),
        ("custom_gearwear_safety_factor_scuffing_iso_ts_6336_21", "none", "0.96"),
        ("custom_gearwear_maximum_contact_temperature_rise_new", "K", "33.5"),
        ("custom_gearwear_maximum_contact_temperature_rise_worn", "K", "32.5"),
    ] {
        assert_eq!(attribute(&with.text, MODEL, "10", id), value(unit, text), "{id}");
    }
    for (component, id, expected) in [
        ("11", "bulk_temperature", value("C", "78.5")),
        ("12", "bulk_temperature", value("C", "78.5")),
        ("5", "averaged_linear_wear_vdi_2736_2014", value("mm", "0.0125")),
        ("6", "averaged_linear_wear_vdi_2736_2014", None),
        ("5", "flank_temperature_characteristic_vdi_2736_2014", None),
        ("6", "flank_temperature_characteristic_vdi_2736_2014", value("C", "61.5")),
        ("6", "root_temperature_vdi_2736_2014", value("C", "41.5")),
    ] {
        assert_eq!(attribute(&with.text, MODEL, component, id), expected, "{component} {id}");
    }
}

/// A load case alone has the figures of its load, the accumulation those of the whole life.
#[test]
fn results_of_one_load_case_stand_in_it() {
    let with = written(&with_one_load_case(), &run(&OF_THE_FILE[..1]));
    assert_eq!(attribute(&with.text, LOAD_CASE, "10", "face_load_factor_flank"), value("none", "1.25"));
    assert_eq!(attribute(&with.text, ACCUMULATION, "5", "custom_gearwear_maximum_wear_depth"), value("mum", "4.5"));
    assert_eq!(attribute(&with.text, MODEL, "10", "face_load_factor_flank"), None);
}

/// Of several load cases each has the figures of its phase; the greatest load has its name in the ids of those that it has alone.
#[test]
fn results_of_load_cases_stand_in_each() {
    let with = written(TWO_STAGES, &run(&OF_THE_FILE));
    assert!(with.warnings.is_empty(), "{:?}", with.warnings);
    let id = "custom_gearwear_maximum_wear_depth";
    let depths = with.text.matches(&format!("<attribute id=\"{id}\" unit=\"mum\">3.02<")).count();
    assert_eq!(depths, 2, "pinion and wheel, in the first load case");
    assert!(with.text.contains(&format!("<attribute id=\"{id}\" unit=\"mum\">1.0<")));
    assert_eq!(attribute(&with.text, ACCUMULATION, "5", id), value("mum", "4.5"));
    let of_greatest = "custom_gearwear_greatest_load_face_load_factor_flank";
    assert_eq!(attribute(&with.text, ACCUMULATION, "10", of_greatest), value("none", "1.25"));
    assert!(!with.text.contains("\"face_load_factor_flank\""));
    // σ_F0 is proportional to the load; Y_F is of the pair.
    let stress = "<attribute id=\"custom_gearwear_nominal_tooth_root_stress_iso_6336_2006\" unit=\"N / mm^2\">";
    let stress: Vec<&str> = with.text.split(stress).skip(1).map(|rest| rest.split_once('<').unwrap().0).collect();
    assert_eq!(stress, ["123.5", &super::scene_text::rounded(123.5 / 3.02)]);
    assert_eq!(attribute(&with.text, MODEL, "5", "form_factor_vdi_2736_2014"), value("none", "1.4"));
    // As many attributes in every load case.
    let document = roxmltree::Document::parse(&with.text).unwrap();
    let cases = document.descendants().filter(|node| node.has_tag_name("load_case"));
    let counts: Vec<usize> = cases
        .map(|case| {
            let all = case.descendants().filter_map(|node| node.attribute("id"));
            all.filter(|id| id.starts_with(CUSTOM)).count()
        })
        .collect();
    assert!(counts[0] > 0 && counts[0] == counts[1], "{counts:?}");

    // Under other loads than those of the file its load cases are left alone.
    let other = written(TWO_STAGES, &run(&[[50.0, 1500.0]]));
    assert!(other.warnings[0].contains("not those of the file"), "{:?}", other.warnings);
    assert_eq!(attribute(&other.text, ACCUMULATION, "10", of_greatest), value("none", "1.25"));
    assert_eq!(attribute(&other.text, LOAD_CASE, "10", "custom_gearwear_line_load"), None);
    // What the first run left there goes with the second.
    let again = written(&with.text, &run(&[[50.0, 1500.0]])).text;
    assert_eq!(attribute(&again, LOAD_CASE, "10", "custom_gearwear_line_load"), None);
}

/// An attribute that stands in the file gets the new value, one that stands twice is there once, and what a load case says is not said by the
/// model too.
#[test]
fn standing_attributes_are_replaced() {
    let standing = "<attribute id=\"face_load_factor_flank\" unit=\"none\">9</attribute>\n      ";
    let before = "<attribute id=\"center_distance\" unit=\"mm\">91.5";
    let with = |text: &str, count: usize| text.replacen(before, &format!("{}{before}", standing.repeat(count)), 1);
    let once = written(&without_load_spectrum(), &run(&[[100.0, 1500.0]])).text;
    for count in [1, 2] {
        let text = with(&without_load_spectrum(), count);
        let new = written(&text, &run(&[[100.0, 1500.0]])).text;
        assert_eq!(attribute(&new, MODEL, "10", "face_load_factor_flank"), value("none", "1.25"));
        // But for its place it is the file that never had it.
        let sorted = |text: &str| {
            let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
            lines.sort();
            lines
        };
        assert_eq!(sorted(&new), sorted(&once));
    }
    let new = written(&with(&with_one_load_case(), 1), &run(&OF_THE_FILE[..1])).text;
    assert_eq!(new, written(&with_one_load_case(), &run(&OF_THE_FILE[..1])).text);
}

/// Ids and units of the format's database (database.rexs.info).
#[test]
fn val_attributes_are_those_of_the_version() {
    let stress = "nominal_tooth_root_stress_iso_6336_2006";
    let in_custom = format!("{CUSTOM}{stress}");
    for (version, face_load_factor, (stress, unit), form_factor, stiffness) in [
        ("1.4", "face_load_factor_flank", (in_custom.as_str(), "N / mm^2"), "form_factor_vdi_2736_2014", false),
        ("1.5", "face_load_factor_flank", (in_custom.as_str(), "N / mm^2"), "form_factor_vdi_2736_2014", true),
        ("1.6", "face_load_factor_flank", (in_custom.as_str(), "N / mm^2"), "form_factor_vdi_2736_2014", true),
        ("1.7", "face_load_factor_flank", (stress, "N / mm^2"), "form_factor_vdi_2736_2014", true),
        ("2.0", "face_load_factor_contact_stress", (stress, "MPa"), "form_factor_tooth_root_vdi_2736_2014", true),
        ("2.0.0", "face_load_factor_contact_stress", (stress, "MPa"), "form_factor_tooth_root_vdi_2736_2014", true),
    ] {
        let text = without_load_spectrum().replace("version=\"1.4\"", &format!("version=\"{version}\""));
        let new = written(&text, &run(&[[100.0, 1500.0]])).text;
        assert_eq!(attribute(&new, MODEL, "10", face_load_factor), value("none", "1.25"), "{version}");
        assert_eq!(attribute(&new, MODEL, "5", stress), value(unit, "123.5"), "{version}");
        assert_eq!(attribute(&new, MODEL, "6", stress), None, "{version}");
        assert_eq!(attribute(&new, MODEL, "5", form_factor), value("none", "1.4"), "{version}");
        let curve = attribute(&new, MODEL, "10", "meshing_stiffness_characteristic");
        // 20 N/(mm·µm) over 14 mm, at 23 whole degrees of the pitch of 22.5°; of the wheel two thirds of them.
        let expected = stiffness.then(|| ("N / mm".to_owned(), "280000.0".repeat(23)));
        assert_eq!(curve, expected, "{version}");
        let positions = attribute(&new, MODEL, "6", "rotational_meshing_position");
        assert_eq!(positions.map(|(_, text)| text.starts_with("0.00.666666666667")), stiffness.then_some(true));
    }
}

/// Every figure is there in the summary, and every id keeps to the naming convention of the format: a–z, 0–9 and _.
#[test]
fn every_figure_has_a_number_and_a_name() {
    for figure in figures() {
        let path = figure.path.replace("{gear}", "wheel").replace("{phase}", "1");
        assert!(SummaryOutput::find(&path).is_ok(), "{path}");
        for version in VERSIONS {
            let text = TWO_STAGES.replace("version=\"1.4\"", &format!("version=\"{version}\""));
            let document = RexsDocument::parse(&text).unwrap();
            for loads in [Loads::One, Loads::PhaseForEach, Loads::Different] {
                let id = Naming::of(&document, loads).id(&figure.attribute);
                let mut letters = id.iter().flat_map(|id| id.bytes());
                assert!(letters.all(|b| matches!(b, b'a'..=b'z' | b'0'..=b'9' | b'_')), "{id:?}");
                let is_of_one = loads == Loads::One || figure.attribute.of != Of::Load;
                assert!(is_of_one || id.is_none_or(|id| id.starts_with("custom_gearwear_greatest_load_")), "{path}");
            }
        }
    }
}

/// The table of docs/rexs.md has every figure and every id.
#[test]
fn the_document_has_every_figure() {
    let page = include_str!("../../../docs/rexs.md");
    let of_state = |state: &'static str| page.replace("{state}", state);
    let page = of_state("new") + &of_state("worn");
    for figure in figures() {
        let mut names = vec![figure.path.to_string()];
        for version in VERSIONS {
            let text = TWO_STAGES.replace("version=\"1.4\"", &format!("version=\"{version}\""));
            let id = Naming::of(&RexsDocument::parse(&text).unwrap(), Loads::One).id(&figure.attribute);
            names.extend(id.map(|id| id.strip_prefix(CUSTOM).unwrap_or(&id).to_owned()));
        }
        names.iter().for_each(|name| assert!(page.contains(&format!("`{name}`")), "docs/rexs.md: no {name}"));
    }
}

/// A byte order mark, lines that end in CR LF, no lines at all, and elements without content.
#[test]
fn files_of_every_layout_take_results() {
    let marked = format!("\u{feff}{TWO_STAGES}");
    let new = written(&marked, &run(&OF_THE_FILE)).text;
    assert_eq!(new.strip_prefix('\u{feff}'), Some(written(TWO_STAGES, &run(&OF_THE_FILE)).text.as_str()));
    let crlf = written(&TWO_STAGES.replace('\n', "\r\n"), &run(&OF_THE_FILE)).text;
    assert_eq!(crlf.replace("\r\n", "\n"), written(TWO_STAGES, &run(&OF_THE_FILE)).text);
    assert_eq!(crlf.matches('\n').count(), crlf.matches("\r\n").count());
    let flat: String = TWO_STAGES.lines().map(str::trim_start).collect();
    let new = written(&flat, &run(&OF_THE_FILE)).text;
    assert!(!new.contains('\n') && !new.contains("> "), "{new}");
    let pieces =
        "<component id=\"24\" type=\"cylindrical_stage_gear_data\"/><component id=\"11\" type=\"cylindrical_gear\"/>";
    let empty = TWO_STAGES.replace("<load_case id=\"2\">", &format!("<load_case id=\"2\">{pieces}"));
    let empty = empty.replace("id=\"20\" role=\"stage\"/><ref id=\"22\"", "id=\"10\" role=\"stage\"/><ref id=\"11\"");
    let new = written(&empty.replace(">right<", ">left<"), &run(&OF_THE_FILE)).text;
    assert!(new.contains("<component id=\"24\" type=\"cylindrical_stage_gear_data\">\n"), "{new}");
    assert!(new.contains("<component id=\"11\" type=\"cylindrical_gear\"/>"), "{new}");
}

#[test]
fn what_takes_no_results_is_said() {
    let error = |text: &str, run: &RunResults| with_results(text, Some(1), run).unwrap_err().to_string();
    let other = |change: fn(&mut RunResults)| {
        let mut run = run(&OF_THE_FILE);
        change(&mut run);
        error(TWO_STAGES, &run)
    };
    assert_eq!(
        other(|run| run.pair.gears.wheel.teeth = 25),
        "RUN: teeth of the wheel: found 25; allowed: 24, that of FZG & type C (id 10)"
    );
    for (said, what) in [
        (other(|run| run.pair.normal_module_mm = 4.0), "normal module in mm: found 4; allowed: 4.5"),
        (other(|run| run.pair.normal_pressure_angle_rad = 0.3), "normal pressure angle in deg: found 17.188"),
        (other(|run| run.pair.helix_angle_rad = 0.2), "helix angle in deg: found 11.459"),
        (other(|run| run.pair.centre_distance_mm = 91.6), "centre distance in mm: found 91.6; allowed: 91.5"),
        (other(|run| run.pair.face_width_mm = 15.0), "face width in mm: found 15; allowed: 14"),
        (
            other(|run| run.pair.gears.pinion.profile_shift = 0.2),
            "profile shift of the pinion: found 0.2; allowed: 0.1817",
        ),
    ] {
        assert!(said.contains(what), "{said}");
    }
    let spectrum = TWO_STAGES.replace("</model>", "<load_spectrum id=\"2\"/></model>");
    assert!(error(&spectrum, &run(&OF_THE_FILE)).contains("found a second load_spectrum; allowed: one"));
    let outside = TWO_STAGES.replace("</model>", "<load_case id=\"3\"/></model>");
    assert!(error(&outside, &run(&OF_THE_FILE)).contains("a load_case outside <load_spectrum>"));
    let start = TWO_STAGES.find("    <component id=\"11\"").unwrap();
    let (before, after) = TWO_STAGES.split_at(start);
    let split = format!("{before}</components><components>{after}");
    assert!(error(&split, &run(&OF_THE_FILE)).contains("line 48: found a component outside <components>"));
    let stage = with_results(TWO_STAGES, Some(3), &run(&OF_THE_FILE)).unwrap_err();
    assert!(matches!(stage, RexsError::Stage { asked: Some(3), .. }));
    let version = TWO_STAGES.replace("version=\"1.4\"", "version=\"3.0\"");
    assert!(error(&version, &run(&OF_THE_FILE)).contains("version: found \"3.0\""));
}

/// A file that is cut anywhere is refused.
#[test]
fn prop_a_cut_file_takes_no_results() {
    let run = run(&OF_THE_FILE);
    let end = TWO_STAGES.rfind("</model>").unwrap();
    for at in (0..end).filter(|&at| TWO_STAGES.is_char_boundary(at)) {
        let refused = with_results(&TWO_STAGES[..at], Some(1), &run).unwrap_err();
        assert!(matches!(refused, RexsError::NoModel { .. }), "{at}: {refused}");
    }
}
