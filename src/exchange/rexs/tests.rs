use super::{RexsError, scene};
use crate::scene::Resolved;
use crate::scene::presets;

const TWO_STAGES: &str = include_str!("two_stages.rexs");

/// The file with another text in place of one that stands in it once or more.
fn with(from: &str, to: &str) -> String {
    assert!(TWO_STAGES.contains(from), "{from}");
    TWO_STAGES.replace(from, to)
}

fn error(text: &str, stage: Option<usize>) -> String {
    scene(text, stage).unwrap_err().to_string()
}

/// Gears of FZG type C by their attributes are those of the preset, but for the tip edge that is assumed.
#[test]
fn ver_a_stage_is_the_pair_of_its_attributes() {
    let found = scene(TWO_STAGES, Some(1)).unwrap();
    let own = Resolved::from_toml(&found.text).unwrap_or_else(|problems| panic!("{problems:?}\n{}", found.text));
    assert_eq!(own.title(), "FZG & type C");
    let own = own.scene;
    let preset = presets::find("fzg-c").unwrap().text;
    let mut expected = Resolved::from_toml(preset).unwrap().scene.pair;
    for (own, expected) in
        [(&own.pair.gears.pinion, &mut expected.gears.pinion), (&own.pair.gears.wheel, &mut expected.gears.wheel)]
    {
        assert_eq!(own.modification.tip_rounding_mm, 0.1);
        expected.modification.tip_rounding_mm = own.modification.tip_rounding_mm;
    }
    assert_eq!(own.pair, expected);
    // The case's torque stands before the component's own; a component that the case does not name keeps its own.
    let phases: Vec<(f64, Option<f64>)> =
        own.operation.phases.iter().map(|phase| (phase.pinion_torque_n_mm, phase.pinion_speed_rpm)).collect();
    assert_eq!(phases, [(302e3, Some(1500.0)), (100e3, Some(750.0))]);
    assert!(found.text.contains("hours = 500.0") && found.text.contains("hours = 1500.0"), "{}", found.text);
    // Roughness, speed and temperature are all there, so that films can be had.
    assert!(found.text.contains("\n[lubricant]\nviscosity_40C_mm2_per_s = 100.0\n"), "{}", found.text);
}

/// Every modification in the units of the scene; the gear that drives is the pinion, and its loaded flank is the right one.
#[test]
fn ver_modifications_come_in_their_units() {
    let found = scene(TWO_STAGES, Some(2)).unwrap();
    for line in [
        "teeth = 22\nprofile_shift = 0.35\n",
        // 2 (0.325 − 0.35) · 3 mm · tan 20° (ISO 21771).
        "tooth_thickness_allowance_um = -54.5955351399",
        "tip_relief = { amount_um = 15.0, begins_at_diameter_mm = 71.5, shape = \"parabolic\" }",
        "end_relief = { amount_um = 10.0, length_mm = 3.0 }",
        "lead_crowning_um = 6.0",
        "tip_chamfer_mm = 0.2\n",
        "tip_chamfer_deg = 45.0 ",
        "tip_rounding_mm = 0.1 ",
        // (66 − 60.6) / 6 + 0.325.
        "basic_rack = { dedendum_factor = 1.225 }",
        // 302 N·m · 24/16 of the shaft before, which nothing else leaves.
        "pinion_torque_Nm = 453.0          # derived: from the loads on other shafts, without losses\npinion_speed_rpm = 1000.0",
    ] {
        assert!(found.text.contains(line), "{line}\n{}", found.text);
    }
    for warning in [
        "tip_diameter 1 mm lies within the base circle",
        "Slope (id 44) is left out",
        "helix_highest_point is not read",
    ] {
        assert!(found.warnings.iter().any(|said| said.contains(warning)), "{warning}: {:?}", found.warnings);
    }
    assert!(Resolved::from_toml(&found.text).is_ok(), "{}", found.text);
}

#[test]
fn what_gives_no_pair_is_said_with_its_place() {
    let stages = error(TWO_STAGES, None);
    assert!(
        stages.contains(
            "--stage: found none; allowed: 1 (FZG & type C (id 10), 16/24 teeth); 2 (Second (id 20), 57/22 teeth)"
        ),
        "{stages}"
    );
    assert!(error(TWO_STAGES, Some(3)).starts_with("--stage: found 3; allowed: 1 ("));
    assert!(error(TWO_STAGES, Some(0)).starts_with("--stage: found 0; allowed: 1 ("));
    assert!(error(&with("type=\"stage\"", "type=\"other\""), Some(1)).contains("no stage of two cylindrical gears"));
    assert_eq!(
        error(&with("version=\"1.4\"", "version=\"0.9\""), Some(1)),
        "line 3: version: found \"0.9\"; allowed: 1.0 to 1.7 and 2.0"
    );
    assert!(error("", None).contains("an empty file"));
    assert!(error("<html></html>", None).contains("no element <model>"));
    let unit = error(&with("unit=\"mm\">4.5<", "unit=\"inch\">4.5<"), Some(1));
    assert_eq!(unit, "line 51: Pinion C (id 11): normal_module: found the unit \"inch\"; allowed: \"mm\", \"m\"");
    let word = error(&with(">91.5<", ">wide<"), Some(1));
    assert!(word.contains("FZG & type C (id 10): center_distance: found \"wide\"; allowed: a number"), "{word}");
    let internal = error(&with(">24<", ">-24<"), Some(1));
    assert!(internal.contains("number_of_teeth: found -24; allowed: a whole number, positive"), "{internal}");
    let helix = "<attribute id=\"helix_angle_reference_diameter\" unit=\"deg\">";
    let both = with("unit=\"deg\">0<", "unit=\"deg\">12<").replacen(
        "type=\"cylindrical_gear\">",
        &format!("type=\"cylindrical_gear\">{helix}0</attribute>"),
        1,
    );
    let helix = error(&both, Some(1));
    assert!(helix.contains("helix_angle_reference_diameter: found 12; allowed: 0 for external gears"), "{helix}");
}

/// A file that is cut anywhere is refused: nothing of it is taken for the whole, and nothing panics.
#[test]
fn prop_a_cut_file_is_refused() {
    let end = TWO_STAGES.rfind("</model>").unwrap();
    for at in (0..end).filter(|&at| TWO_STAGES.is_char_boundary(at)) {
        let refused = scene(&TWO_STAGES[..at], Some(1)).unwrap_err();
        assert!(matches!(refused, RexsError::NoModel { .. }), "{at}: {refused}");
    }
}
