use std::fmt::Write;
use std::path::Path;

use super::document::RexsDocument;
use super::mesh_stiffness::MeshStiffness;
use super::results::{RunResults, StageResults, WearDepths, with_results_of_stage};
use super::{RexsError, scene};
use crate::planetary_run::{self, record::PlanetaryRecord};
use crate::scene::loaded::SceneText;
use crate::scene::planetary::PlanetaryScene;
use crate::scene::planetary::mesh::StageMesh;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

/// A unit of one sun, three planets and a ring: 17/22/61 teeth, module 4 mm, 78 mm apart; attributes of the ring as given.
fn unit(ring: &str) -> String {
    let mut relations = String::new();
    let mut components = String::from(
        "<component id=\"1\" name=\"Unit\" type=\"gear_unit\"><attribute id=\"operating_time\" unit=\"h\">500</attribute></component>\n\
         <component id=\"9\" name=\"Minus gear\" type=\"planetary_stage\"/>\n<component id=\"3\" name=\"Sun shaft\" type=\"shaft\"/>\n",
    );
    let gear = |id: u32, name: &str, kind: &str, attributes: &str| {
        format!(
            "<component id=\"{id}\" name=\"{name}\" type=\"{kind}\"><attribute id=\"normal_module\" unit=\"mm\">4</attribute>\
             <attribute id=\"face_width\" unit=\"mm\">50</attribute>{attributes}</component>\n"
        )
    };
    let teeth = |number: u32, tip: f64| {
        format!(
            "<attribute id=\"number_of_teeth\" unit=\"none\">{number}</attribute><attribute id=\"tip_diameter\" unit=\"mm\">{tip}</attribute>"
        )
    };
    components += &gear(53, "Sun", "cylindrical_gear", &teeth(17, 76.0));
    components += &gear(58, "Ring", "ring_gear", ring);
    for planet in 0..3 {
        let (gear_id, with_sun, with_ring, flank) = (170 + planet, 134 + planet, 143 + planet, 192 + planet);
        components += &gear(gear_id, "Planet", "cylindrical_gear", &teeth(22, 96.0));
        for stage in [with_sun, with_ring] {
            let _ = writeln!(
                components,
                "<component id=\"{stage}\" name=\"Mesh\" type=\"cylindrical_stage\"><attribute id=\"center_distance\" unit=\"mm\">78</attribute></component>"
            );
        }
        let _ = writeln!(
            components,
            "<component id=\"{flank}\" type=\"cylindrical_gear_flank\"><attribute id=\"normal_pressure_angle\" unit=\"deg\">20</attribute>\
             <attribute id=\"addendum_modification_coefficient\" unit=\"none\">0</attribute></component>"
        );
        for (stage, one, other) in [(with_sun, 53, gear_id), (with_ring, gear_id, 58)] {
            let _ = writeln!(
                relations,
                "<relation id=\"{stage}\" type=\"stage\"><ref id=\"{stage}\" role=\"stage\"/><ref id=\"{one}\" role=\"gear_1\"/><ref id=\"{other}\" role=\"gear_2\"/></relation>"
            );
        }
        let _ = writeln!(
            relations,
            "<relation id=\"{flank}\" type=\"flank\"><ref id=\"{gear_id}\" role=\"gear\"/><ref id=\"{flank}\" role=\"left\"/></relation>\n\
             <relation id=\"{}\" type=\"stage_gear_data\"><ref id=\"{with_sun}\" role=\"stage\"/><ref id=\"53\" role=\"gear\"/><ref id=\"{}\" role=\"stage_gear_data\"/></relation>",
            200 + planet,
            210 + planet
        );
        let _ = writeln!(
            components,
            "<component id=\"{}\" type=\"stage_gear_data\"><attribute id=\"is_driving_gear\" unit=\"none\">true</attribute>\
             <attribute id=\"torque\" unit=\"Nm\">100</attribute></component>",
            210 + planet
        );
    }
    format!(
        "<model applicationId=\"by hand\" applicationVersion=\"1\" date=\"2026-01-01T00:00:00+00:00\" version=\"1.4\">\n\
         <relations>\n{relations}<relation id=\"300\" type=\"assembly\"><ref id=\"3\" role=\"assembly\"/><ref id=\"53\" role=\"part\"/></relation></relations>\n\
         <components>\n{components}</components></model>"
    )
}

fn stage(text: &str) -> PlanetaryScene {
    let given = SceneText { name: "stage".to_owned(), text: text.to_owned() };
    PlanetaryScene::from_text(given, Path::new("")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Sun, planets and ring of a planetary stage make a scene of it, whatever signs the ring's numbers have.
#[test]
fn ver_a_planetary_stage_is_that_of_its_meshes() {
    let with_teeth = |teeth: &str, tip: &str| {
        unit(&format!(
            "<attribute id=\"number_of_teeth\" unit=\"none\">{teeth}</attribute><attribute id=\"tip_diameter\" unit=\"mm\">{tip}</attribute>"
        ))
    };
    for (teeth, tip) in [("61", "237.0"), ("-61", "-237.0")] {
        let found = scene(&with_teeth(teeth, tip), Some(1)).unwrap();
        assert!(!found.text.contains("-0.0"), "{}", found.text);
        let stage = stage(&found.text);
        assert_eq!(stage.title, "Minus gear");
        assert_eq!([stage.stage.sun_teeth, stage.stage.planet_teeth, stage.stage.ring_teeth], [17, 22, 61]);
        assert_eq!(stage.stage.planets(), 3);
        // (17 + 22) · 4 / 2 = 78 and (61 − 22) · 4 / 2 = 78: no shifts but the planet's, which is 0.
        let shifts =
            StageMesh::BOTH.map(|mesh| stage.meshes[mesh].scene().pair.gears.as_ref().map(|gear| gear.profile_shift));
        assert!(shifts.iter().all(|of| of.pinion.abs() < 1e-6 && of.wheel.abs() < 1e-6), "{shifts:?}");
        // 100 N·m of one mesh.
        let torques = StageMesh::BOTH.map(|mesh| stage.meshes[mesh].scene().operation.pinion_torque_n_mm);
        assert!((torques[0] - 100e3).abs() < 1e-6 && (torques[1] - 100e3 * 22.0 / 17.0).abs() < 1e-6, "{torques:?}");
    }
}

/// The shift of a ring, positive away from its axis in some files, is taken towards its tips.
#[test]
fn ver_the_sign_of_a_rings_shift_follows_from_the_centre_distance() {
    let shifted = |shift: &str| {
        let text = unit("<attribute id=\"number_of_teeth\" unit=\"none\">61</attribute><attribute id=\"tip_diameter\" unit=\"mm\">235.6</attribute>")
            .replace("center_distance\" unit=\"mm\">78", "center_distance\" unit=\"mm\">78.5")
            .replace(
                "</components>",
                &format!("<component id=\"400\" type=\"cylindrical_gear_flank\"><attribute id=\"addendum_modification_coefficient\" unit=\"none\">{shift}</attribute></component></components>"),
            );
        text.replace("</relations>", "<relation id=\"401\" type=\"flank\"><ref id=\"58\" role=\"gear\"/><ref id=\"400\" role=\"left\"/></relation></relations>")
    };
    // A pair without backlash at 78.5 mm: x1 + x2 = (inv α_wt − inv α_t)(22 − 61)/(2 tan 20°), α_wt = acos(78 cos 20°/78.5).
    let inv = |angle: f64| angle.tan() - angle;
    let alpha = 20f64.to_radians();
    let tight = (inv((78.0 * alpha.cos() / 78.5).acos()) - inv(alpha)) * -39.0 / (2.0 * alpha.tan());
    for sign in [1.0, -1.0] {
        let found = scene(&shifted(&format!("{:.6}", sign * tight)), Some(1)).unwrap();
        let line = found
            .text
            .split("[planetary.ring]")
            .nth(1)
            .unwrap()
            .lines()
            .find(|line| line.starts_with("profile_shift"))
            .unwrap();
        let value: f64 = line.split('=').nth(1).unwrap().split('#').next().unwrap().trim().parse().unwrap();
        assert!((value - tight).abs() < 1e-5, "{line}, {tight}");
    }
}

/// A ring whose tips run into the fillets of the planets, of which the file does not know the tool, is shortened, and that is said.
#[test]
fn tips_of_a_ring_that_run_into_fillets_are_shortened() {
    let text = unit(
        "<attribute id=\"number_of_teeth\" unit=\"none\">61</attribute><attribute id=\"tip_diameter\" unit=\"mm\">236</attribute>",
    );
    let found = scene(&text, Some(2)).unwrap();
    assert!(
        found.warnings.iter().any(|said| said.contains("Ring (id 58): tip_diameter is left out")),
        "{:?}",
        found.warnings
    );
    let stage = stage(&found.text);
    assert!(2.0 * stage.pairs.planet_ring.teeth.wheel.tip_radius_mm < -236.7);
}

/// Planets that drive the sun, as where the carrier is driven: the torque of a planet's mesh is that of the sun's over the ratio of teeth.
#[test]
fn ver_torque_of_planets_that_drive_the_sun() {
    let mut text = unit(
        "<attribute id=\"number_of_teeth\" unit=\"none\">61</attribute><attribute id=\"tip_diameter\" unit=\"mm\">237</attribute>",
    );
    for planet in 0..3 {
        let of = |gear: u32| format!("<ref id=\"{}\" role=\"stage\"/><ref id=\"{gear}\" role=\"gear\"/>", 134 + planet);
        assert!(text.contains(&of(53)));
        text = text.replace(&of(53), &of(170 + planet));
    }
    let stage = stage(&scene(&text, Some(1)).unwrap().text);
    let torques = StageMesh::BOTH.map(|mesh| stage.meshes[mesh].scene().operation.pinion_torque_n_mm);
    assert!((torques[0] - 100e3 * 17.0 / 22.0).abs() < 1e-6 && (torques[1] - 100e3).abs() < 1e-6, "{torques:?}");
}

/// Results of a run of the unit's stage.
fn results(text: &str) -> StageResults {
    let made = scene(text, Some(1)).unwrap().text;
    // What is quick: no finite elements, few positions.
    let quick = "[contact]\nsurface = \"hertz-mean\"\n[stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n\
                 [numerics]\nverify = false\nerror_estimate = false\nflank_points = 80\npositions = 40\n";
    let done = planetary_run::run(&stage(&format!("{made}\n{quick}")), &Unwatched).unwrap();
    let PlanetaryRecord { summary, meshes, .. } = done.record;
    let of_mesh = |run: Option<RunRecord>| {
        let run = run.unwrap();
        let pair = stage(&format!("{made}\n{quick}"));
        let mesh =
            if run.summary.geometry.gears.pinion.teeth == 17 { StageMesh::SunPlanet } else { StageMesh::PlanetRing };
        RunResults {
            pair: pair.meshes[mesh].scene().pair.clone(),
            mesh_stiffness: MeshStiffness::default(),
            wear_profile: run
                .flanks
                .as_ref()
                .map(|flank| WearDepths { radius_mm: flank.radius_mm.clone(), depth_um: flank.wear_um.clone() }),
            summary: serde_json::to_value(&run.summary).unwrap(),
        }
    };
    StageResults { summary: serde_json::to_value(&summary).unwrap(), meshes: meshes.map(of_mesh) }
}

/// The results of both meshes stand at the stages of the first planet and at the data of its gears in these, all else stays, and the file gives the same scene; the same
/// results change it no more.
#[test]
fn ver_results_of_a_stage_stand_at_both_meshes() {
    let ring = "<attribute id=\"number_of_teeth\" unit=\"none\">-61</attribute><attribute id=\"tip_diameter\" unit=\"mm\">-237</attribute>";
    let text = unit(ring);
    let run = results(&text);
    let with = with_results_of_stage(&text, Some(1), &run).unwrap();
    assert!(with.warnings.is_empty(), "{:?}", with.warnings);
    assert_eq!(with_results_of_stage(&with.text, Some(1), &run).unwrap().text, with.text);
    assert_eq!(scene(&with.text, Some(1)).unwrap().text, scene(&text, Some(1)).unwrap().text);
    let document = RexsDocument::parse(&with.text).unwrap();
    let depth = |stage: &str, gear: &str| {
        let relation = document.relation("stage_gear_data", &[("stage", stage), ("gear", gear)]).unwrap();
        let data = document.component(relation.member("stage_gear_data").unwrap()).unwrap();
        data.text("custom_gearwear_maximum_wear_depth").unwrap().parse::<f64>().unwrap()
    };
    // Sun 53, first planet 170, ring 58; their stages 134 and 143.
    for (stage, gear, path) in [
        ("134", "53", "/sun/peak_wear_um"),
        ("134", "170", "/planet/sun_flank/peak_wear_um"),
        ("143", "170", "/planet/ring_flank/peak_wear_um"),
        ("143", "58", "/ring/peak_wear_um"),
    ] {
        let expected = run.summary.pointer(path).unwrap().as_f64().unwrap();
        let found = depth(stage, gear);
        assert!((found / expected - 1.0).abs() < 1e-9, "{path}: {found} and {expected}");
    }
    // The other planets have none.
    assert_eq!(with.text.matches("custom_gearwear_scene_hash").count(), 2);
    // All tags of the file are still there, in their order.
    let mut rest = with.text.as_str();
    for tag in text.split_inclusive('>') {
        let at = rest.find(tag.trim()).unwrap_or_else(|| panic!("{tag}"));
        rest = &rest[at + tag.trim().len()..];
    }
    let other_load = with_results_of_stage(&text.replace("\"Nm\">100<", "\"Nm\">90<"), Some(1), &run).unwrap();
    assert!(other_load.warnings[0].contains("loads of the run are not those of the file"));
    let other_ring = unit(&ring.replace("-61", "-62"));
    assert!(matches!(with_results_of_stage(&other_ring, Some(1), &run), Err(RexsError::OtherPair { .. })));
    let pair = include_str!("two_stages.rexs");
    let refused = with_results_of_stage(pair, Some(1), &run).unwrap_err().to_string();
    assert!(refused.contains("that of a planetary stage"), "{refused}");
}
