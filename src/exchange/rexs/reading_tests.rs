//! Files as other programs write them: forms, older versions, what is missing, and what no program can read.

use std::io::{Cursor, Write, repeat};

use proptest::prelude::*;
use roxmltree::{Document, Node};
use serde_json::{Value, json};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::container::{self, FileError, MOST_BYTES};
use super::{FromRexs, RexsError, scene};
use crate::scene::Resolved;

const TWO_STAGES: &str = include_str!("two_stages.rexs");

/// The file with other texts in place of those that stand in it once or more.
fn with(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(TWO_STAGES.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

fn read(text: &str, stage: usize) -> FromRexs {
    scene(text, Some(stage)).unwrap_or_else(|error| panic!("{error}"))
}

/// The scene without its first line, which names the version.
fn body(text: &str, stage: usize) -> String {
    read(text, stage).text.split_once('\n').unwrap().1.to_owned()
}

/// The same model in JSON, as a program may write it that knows the type of every attribute.
fn as_json(text: &str) -> String {
    let document = Document::parse(text).unwrap();
    let named = |within: Node, name: &str| -> Vec<Value> {
        within.children().filter(|child| child.has_tag_name(name)).map(|child| element(child)).collect()
    };
    let root = document.root_element();
    let child = |name: &str| root.children().find(|child| child.has_tag_name(name));
    let mut model = json!({
        "applicationId": "by hand", "applicationVersion": "1", "version": root.attribute("version"),
        "relations": named(child("relations").unwrap(), "relation"),
        "components": named(child("components").unwrap(), "component"),
    });
    if let Some(spectrum) = child("load_spectrum") {
        model["load_spectrum"] = json!({ "id": 1, "load_cases": named(spectrum, "load_case") });
    }
    serde_json::to_string_pretty(&json!({ "model": model })).unwrap()
}

fn element(node: Node) -> Value {
    let mut value: serde_json::Map<String, Value> =
        node.attributes().map(|attribute| (attribute.name().to_owned(), Value::from(attribute.value()))).collect();
    if let Some(id) = node.attribute("id").and_then(|id| id.parse::<u32>().ok()) {
        value.insert("id".to_owned(), id.into());
    }
    let list = |name: &str| node.children().filter(|child| child.has_tag_name(name)).map(element).collect::<Vec<_>>();
    match node.tag_name().name() {
        "relation" => drop(value.insert("refs".to_owned(), list("ref").into())),
        "component" => drop(value.insert("attributes".to_owned(), list("attribute").into())),
        "load_case" => drop(value.insert("components".to_owned(), list("component").into())),
        "attribute" => {
            let cells: Vec<f64> = node
                .descendants()
                .filter(|cell| cell.has_tag_name("c"))
                .map(|cell| cell.text().unwrap().parse().unwrap())
                .collect();
            let text = node.text().unwrap_or_default();
            let (kind, content) = match (cells.is_empty(), text.parse::<f64>(), text.parse::<bool>()) {
                (false, ..) => ("floating_point_array", json!(cells)),
                (_, Ok(number), _) => ("floating_point", json!(number)),
                (_, _, Ok(truth)) => ("boolean", json!(truth)),
                _ => ("enum", json!(text)),
            };
            value.insert(kind.to_owned(), content);
        }
        _ => {}
    }
    Value::Object(value)
}

fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(content).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn ver_json_says_what_xml_says() {
    let json = as_json(TWO_STAGES);
    for stage in [1, 2] {
        assert_eq!(body(&json, stage), body(TWO_STAGES, stage));
    }
    let wrong = json.replacen("91.5", "\"wide\"", 1);
    let line = wrong[..wrong.find("\"wide\"").unwrap()].lines().count();
    let error = scene(&wrong, Some(1)).unwrap_err().to_string();
    // An attribute begins two or three lines above its value.
    let said: usize = error.strip_prefix("line ").and_then(|rest| rest.split(':').next()?.parse().ok()).unwrap();
    assert!((line - 4..=line).contains(&said) && error.contains("center_distance: found \"wide\""), "{line} {error}");
    let cut = scene(&json[..json.len() / 2], Some(1)).unwrap_err().to_string();
    assert!(cut.contains("JSON that cannot be read (EOF") && !cut.contains('\n'), "{cut}");
    assert!(scene("{\"model\": {}}", None).unwrap_err().to_string().contains("version: found \"\""));
}

#[test]
fn archives_are_opened_and_other_files_in_them_left_alone() {
    let json = as_json(TWO_STAGES);
    for (name, model) in [("rexs-model.rexs", TWO_STAGES), ("folder/Unit.REXSJ", json.as_str())] {
        let archive = zipped(&[("flank.gde", b"other"), ("__MACOSX/._Unit.rexs", b"\0\x05"), (name, model.as_bytes())]);
        assert_eq!(body(&container::text(&archive).unwrap(), 1), body(TWO_STAGES, 1));
    }
    let refused = |files: &[(&str, &[u8])]| container::text(&zipped(files)).unwrap_err().to_string();
    assert!(refused(&[("flank.gde", b"")]).contains("an archive without a file whose name ends in .rexs"));
    assert!(refused(&[("a.rexs", b"<a/>"), ("b.rexsj", b"{}")]).contains("an archive of 2 models, a.rexs and others"));
    assert!(container::text(b"PK\x03\x04").unwrap_err().to_string().contains("an archive that cannot be read"));
}

/// What has no end is refused, in a file and in an archive whose content is a thousand times its size.
#[test]
fn what_has_no_end_is_refused_at_a_stated_limit() {
    let endless = container::read(repeat(0)).unwrap_err();
    assert!(matches!(endless, FileError::Rexs(RexsError::TooLarge { most_mb: 64 })));
    let bomb = zipped(&[("a.rexs", &vec![b' '; MOST_BYTES + 1])]);
    assert!(bomb.len() < MOST_BYTES / 100);
    let said = container::text(&bomb).unwrap_err().to_string();
    assert_eq!(said, "found more than 64 MB, or no end; allowed: a REXS model of up to 64 MB");
}

#[test]
fn text_is_in_the_encoding_that_it_names() {
    let latin = with(&[("encoding=\"UTF-8\"", "encoding=\"ISO-8859-1\""), ("Pinion C", "Stirnrad §")]);
    let bytes: Vec<u8> = latin.chars().map(|c| u8::try_from(c).unwrap()).collect();
    assert!(read(&container::text(&bytes).unwrap(), 1).text.contains("Stirnrad §"));
    let undeclared = [TWO_STAGES.as_bytes(), b"\n\xff"].concat();
    let said = container::text(&undeclared).unwrap_err().to_string();
    assert!(said.starts_with("line 149: found bytes that are not UTF-8"), "{said}");
}

/// Names and units of versions before 1.4 are those of today by another name.
#[test]
fn ver_older_versions_are_read_by_their_names() {
    for version in ["1.0", "1.1", "1.2"] {
        let older = with(&[
            ("version=\"1.4\"", &format!("version=\"{version}\"")),
            ("type=\"cylindrical_gear_flank\"", "type=\"flank_geometry\""),
            ("type=\"cylindrical_stage_gear_data\"", "type=\"stage_gear_data\""),
            ("unit=\"deg\"", "unit=\"°\""),
            ("\"operating_time\"", "\"load_duration\""),
            ("\"operating_time_fraction\"", "\"load_duration_fraction\""),
        ]);
        for stage in [1, 2] {
            assert_eq!(body(&older, stage), body(TWO_STAGES, stage));
        }
    }
    let newest = with(&[
        ("version=\"1.4\"", "version=\"2.0.0\""),
        ("\"arithmetic_average_roughness_flank\"", "\"arithmetic_mean_roughness_flank_iso_4287_1997\""),
        ("unit=\"N / mm^2\"", "unit=\"MPa\""),
    ]);
    assert_eq!(body(&newest, 1), body(TWO_STAGES, 1));
}

const CENTRE_DISTANCE: &str = "<attribute id=\"center_distance\" unit=\"mm\">91.5</attribute>";

/// A place of a gear: on an axis along `u` through (x, y, z) in mm.
fn place(gear: &str, at: [f64; 3], u: [f64; 3]) -> (String, String) {
    let vector = |id: &str, [x, y, z]: [f64; 3]| {
        format!("<attribute id=\"{id}\" unit=\"mm\"><array><c>{x}</c><c>{y}</c><c>{z}</c></array></attribute>")
    };
    let tag = format!("name=\"{gear}\" type=\"cylindrical_gear\">");
    (tag.clone(), format!("{tag}{}{}", vector("support_vector", at), vector("u_axis_vector", u)))
}

/// The centre distance is that of both axes, wherever on them the gears stand and however the unit lies; without places it is left to be filled in.
#[test]
fn ver_centre_distance_of_axes() {
    let along = [0.6, 0.0, 0.8];
    // 91.5 mm square to the axis, and 40 mm along it.
    let [one, other] = [([1.0, 2.0, 3.0], along), ([1.0 + 0.8 * 91.5 + 24.0, 2.0, 3.0 - 0.6 * 91.5 + 32.0], along)];
    let (pinion, wheel) = (place("Pinion C", one.0, one.1), place("Wheel C", other.0, other.1));
    let placed = with(&[(CENTRE_DISTANCE, ""), (&pinion.0, &pinion.1), (&wheel.0, &wheel.1)]);
    let found = read(&placed, 1);
    let line = "centre_distance_mm = 91.5         # derived: the distance of both axes (support_vector)\n";
    assert!(found.text.contains(line), "{}", found.text);
    assert!(found.provenance.derived.iter().any(|key| key.starts_with("pair.centre_distance_mm (")));

    let nowhere = read(&with(&[(CENTRE_DISTANCE, "")]), 1);
    assert!(nowhere.text.contains("\n# centre_distance_mm =            # REQUIRED"), "{}", nowhere.text);
    assert_eq!(nowhere.provenance.required, ["pair.centre_distance_mm"]);
    let problems = Resolved::from_toml(&nowhere.text).unwrap_err();
    assert!(problems.iter().all(|problem| problem.to_string().contains("centre_distance_mm")), "{problems:?}");

    let (_, crossed) = place("Wheel C", other.0, [0.0, 1.0, 0.0]);
    let crossed = scene(&with(&[(&pinion.0, &pinion.1), (&wheel.0, &crossed)]), Some(1)).unwrap_err().to_string();
    assert!(crossed.contains("axes of its gears that cross; allowed: parallel axes"), "{crossed}");
}

/// ISO 53 teeth on 16 and 24: the shift that a file leaves out is that of the preset, from the other gear's or from both tips.
#[test]
fn ver_profile_shifts_of_tips_and_centre_distance() {
    let shifts = |text: &str| -> Vec<f64> {
        let found = read(text, 1).text;
        let lines =
            found.lines().filter_map(|line| line.strip_prefix("profile_shift = ")?.split(' ').next()?.parse().ok());
        lines.collect()
    };
    let of_wheel = "<attribute id=\"addendum_modification\" unit=\"mm\">0.77175</attribute>";
    let of_pinion = "<attribute id=\"addendum_modification_coefficient\" unit=\"none\">0.1817</attribute>";
    // x1 + x2 of 91.5 mm without backlash is 0.3532; the preset's sum is that to four digits.
    let one = shifts(&with(&[(of_wheel, "")]));
    assert!((one[0] - 0.1817).abs() < 1e-12 && (one[1] - 0.1715).abs() < 1e-4, "{one:?}");
    // The tips of the preset are rounded to 0.01 mm, of which x has 0.001.
    let both = shifts(&with(&[(of_wheel, ""), (of_pinion, "")]));
    assert!((both[0] - 0.1817).abs() < 2e-3 && (both[1] - 0.1715).abs() < 2e-3, "{both:?}");
    let without_tips = with(&[(of_wheel, ""), (of_pinion, ""), ("\"tip_diameter\"", "\"other\"")]);
    let found = read(&without_tips, 1);
    assert_eq!(found.provenance.required, ["pair.pinion.profile_shift", "pair.wheel.profile_shift"]);
}

/// Data of both gears of stage 1, each with its word for is_driving_gear.
fn driving(words: [Option<&str>; 2]) -> String {
    let (mut relations, mut components) = (String::new(), String::new());
    for (index, (word, gear)) in words.into_iter().zip(["11", "12"]).enumerate() {
        let id = 90 + index;
        relations += &format!(
            "<relation id=\"{id}\" type=\"stage_gear_data\"><ref id=\"10\" role=\"stage\"/><ref id=\"{gear}\" role=\"gear\"/><ref id=\"{id}\" role=\"stage_gear_data\"/></relation>"
        );
        let attribute = word.map(|word| format!("<attribute id=\"is_driving_gear\" unit=\"none\">{word}</attribute>"));
        components += &format!(
            "<component id=\"{id}\" type=\"cylindrical_stage_gear_data\">{}</component>",
            attribute.unwrap_or_default()
        );
    }
    let (relations, components) = (format!("{relations}</relations>"), format!("{components}</components>"));
    with(&[("</relations>", &relations), ("</components>", &components)])
}

/// A file that says the same of both gears is never turned round: gear 1 keeps its torque and speed. One that says nothing is read by its powers.
#[test]
fn gear_1_drives_unless_the_file_says_otherwise() {
    for word in ["false", "true"] {
        let found = read(&driving([Some(word); 2]), 1);
        let warning =
            format!("is_driving_gear is {word} for both gears: gear_1, Pinion C (id 11), is taken as the driving one");
        assert!(found.warnings.contains(&warning), "{:?}", found.warnings);
        assert!(
            found.text.contains("teeth = 16")
                && found.text.contains("pinion_torque_Nm = 302.0\npinion_speed_rpm = 1500.0\n")
        );
        assert!(found.text.find("teeth = 16") < found.text.find("teeth = 24"), "{}", found.text);
    }
    let turned = read(&driving([Some("false"), Some("true")]), 1).text;
    assert!(turned.find("teeth = 24") < turned.find("teeth = 16"), "{turned}");
    // 302 N·m on the shaft of gear 1, 1500/min · 16/24.
    assert!(turned.contains("pinion_torque_Nm = 453.0 ") && turned.contains("pinion_speed_rpm = 1000.0 "), "{turned}");
    // A torque against the speed takes power out.
    let braked = read(&with(&[(">-1500<", ">1500<")]), 1);
    assert!(braked.text.find("teeth = 24") < braked.text.find("teeth = 16"), "{}", braked.text);
    assert!(
        braked.warnings.iter().any(|said| said.contains("Wheel C (id 12), gear_2, by torque and speed")),
        "{:?}",
        braked.warnings
    );
    let contradicted = read(&driving([Some("false"); 2]).replace(">-1500<", ">1500<"), 1);
    assert!(
        contradicted
            .warnings
            .iter()
            .any(|said| said.ends_with("torque and speed of the shafts say that Wheel C (id 12) drives"))
    );
    let unknown = read(&with(&[("\"rotational_speed\"", "\"other\"")]), 1);
    assert!(
        unknown.warnings.iter().any(|said| said.contains("does not say which gear drives: Pinion C")),
        "{:?}",
        unknown.warnings
    );
    assert!(unknown.provenance.assumed.iter().any(|said| said.starts_with("which gear is pair.pinion")));
}

/// A sun of 17 teeth with three planets of 22 in a ring of 61 teeth, module 4 mm: 1500/min and 636 N·m on the sun's shaft.
fn planetary() -> String {
    let gear = |id: u32, kind: &str, name: &str, teeth: i32| {
        format!(
            "<component id=\"{id}\" name=\"{name}\" type=\"{kind}\"><attribute id=\"number_of_teeth\" unit=\"none\">{teeth}</attribute>\
             <attribute id=\"normal_module\" unit=\"mm\">4</attribute><attribute id=\"face_width\" unit=\"mm\">50</attribute></component>\
             <component id=\"{}\" type=\"cylindrical_gear_flank\"><attribute id=\"normal_pressure_angle\" unit=\"deg\">20</attribute>\
             <attribute id=\"addendum_modification_coefficient\" unit=\"none\">0</attribute></component>",
            id + 100
        )
    };
    let relation = |kind: &str, members: &[(&str, u32)]| {
        let refs: String = members.iter().map(|(role, id)| format!("<ref role=\"{role}\" id=\"{id}\"/>")).collect();
        format!("<relation id=\"0\" type=\"{kind}\">{refs}</relation>")
    };
    let mut components = gear(1, "cylindrical_gear", "Sun", 17) + &gear(5, "ring_gear", "Ring", 61);
    let mut relations =
        relation("flank", &[("gear", 1), ("left", 101)]) + &relation("flank", &[("gear", 5), ("left", 105)]);
    components += "<component id=\"30\" type=\"planetary_stage\"/><component id=\"40\" type=\"shaft\"><attribute id=\"rotational_speed\" unit=\"1 / min\">1500</attribute></component>\
                   <component id=\"50\" type=\"external_load\"><attribute id=\"torque_around_u_axis\" unit=\"N m\">636</attribute></component>";
    relations += &relation("assembly", &[("assembly", 40), ("part", 1)]);
    relations += &relation("assembly", &[("assembly", 40), ("part", 50)]);
    for planet in 2..5 {
        components += &gear(planet, "cylindrical_gear", "Planet", 22);
        components += &format!("<component id=\"{}\" type=\"shaft\"/>", 40 + planet);
        for (stage, mates) in [(10 + planet, [1, planet]), (20 + planet, [planet, 5])] {
            components += &format!(
                "<component id=\"{stage}\" name=\"Mesh\" type=\"cylindrical_stage\"><attribute id=\"center_distance\" unit=\"mm\">78</attribute></component>"
            );
            relations += &relation("stage", &[("stage", stage), ("gear_1", mates[0]), ("gear_2", mates[1])]);
        }
        relations += &relation("flank", &[("gear", planet), ("left", planet + 100)]);
        relations += &relation("assembly", &[("assembly", 40 + planet), ("part", planet)]);
        relations += &relation("planet_shaft", &[("planetary_stage", 30), ("shaft", 40 + planet)]);
    }
    format!("<model version=\"1.6\"><relations>{relations}</relations><components>{components}</components></model>")
}

#[test]
fn ver_a_sun_has_a_mesh_with_each_planet_and_the_torque_of_its_shaft() {
    for stage in 1..=3 {
        let found = read(&planetary(), stage);
        for line in [
            "planets = 3 ",
            "[planetary.sun]\n# Sun (id 1)\nteeth = 17\n",
            "[planetary.ring]\n# Ring (id 5)\nteeth = 61\n",
            "member = \"sun\"\ntorque_Nm = 636.0 ",
            "speed_rpm = 1500.0\n",
        ] {
            assert!(found.text.contains(line), "{line}\n{}", found.text);
        }
        assert!(!found.warnings.iter().any(|said| said.contains("left out")), "{:?}", found.warnings);
    }
    let ring = scene(&planetary(), Some(4)).unwrap_err().to_string();
    assert!(ring.starts_with("--stage: found 4; allowed: 1 (Mesh (id 12), 17/22 teeth); "), "{ring}");
}

#[test]
fn circular_reliefs_are_parabolic_to_first_order() {
    let found = read(&with(&[(">parabolic<", ">circular<")]), 2).text;
    let line = "shape = \"parabolic\" } # circular in the file, which is parabolic to first order\n";
    assert!(found.contains(line), "{found}");
}

/// What no parser of XML accepts is refused with its line.
#[test]
fn what_is_not_xml_is_refused_with_its_line() {
    let declared = scene(&with(&[("<?xml version", "<?xml]]> version")]), Some(1)).unwrap_err().to_string();
    assert!(declared.starts_with("line 1: found an XML declaration that cannot be read"), "{declared}");
    let [opened, closed] = ["<c>", "</c>"].map(|tag| tag.repeat(100_000));
    let deep = format!("{opened}{closed}<component id=\"11\"");
    let long = format!("<component {}>", "a=\"\" ".repeat(3000));
    for (from, to) in [
        ("Pinion C", "Pinion\u{1}C"),
        ("Pinion C", "Pinion\0C"),
        ("Pinion C", "Pinion <C>"),
        ("name=\"Pinion C\"", "name=\"Pinion C\" name=\"Again\""),
        ("Pinion C", "Pinion &other; C"),
        ("Pinion C", "Pinion &#0; C"),
        (">16<", ">1\u{7}6<"),
        ("<component id=\"11\"", "<!DOCTYPE a [<!ENTITY b \"b\">]><component id=\"11\""),
        ("<component id=\"11\"", &deep),
        ("<component id=\"11\"", &long),
    ] {
        let error = scene(&with(&[(from, to)]), Some(1)).unwrap_err();
        let (said, head) = (error.to_string(), &to[..to.len().min(40)]);
        let RexsError::NoModel { line, .. } = error else { panic!("{head:?}: {said}") };
        assert!((48..=56).contains(&line) && !said.contains('\n'), "{head:?}: {said}");
    }
}

/// A refusal is one line.
fn is_told(bytes: &[u8]) -> Result<(), TestCaseError> {
    for stage in [None, Some(1), Some(2)] {
        if let Err(error) = container::text(bytes).and_then(|text| scene(&text, stage)) {
            let said = error.to_string();
            prop_assert!(!said.is_empty() && !said.contains('\n'), "{said:?}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Bytes that are exchanged, taken out or doubled anywhere, in every form: no panic, and a refusal is one line.
    #[test]
    fn prop_spoilt_files_are_read_or_refused(
        form in 0_usize..4,
        spoils in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..5, any::<u8>(), 1_usize..60), 1..6),
    ) {
        let mut bytes = match form {
            0 => TWO_STAGES.as_bytes().to_vec(),
            1 => as_json(TWO_STAGES).into_bytes(),
            2 => zipped(&[("unit.rexs", TWO_STAGES.as_bytes())]),
            _ => planetary().into_bytes(),
        };
        for (at, kind, byte, length) in spoils {
            let at = at.index(bytes.len());
            let end = (at + length).min(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => drop(bytes.drain(at..end)),
                2 => bytes.splice(at..at, bytes[at..end].to_vec()).for_each(drop),
                3 => bytes.insert(at, b"<>&\"'09-.{}[]\0"[usize::from(byte) % 14]),
                _ => bytes[at] = b'0' + byte % 10,
            }
            if bytes.is_empty() {
                bytes.push(byte);
            }
        }
        is_told(&bytes)?;
    }
}
