//! The scene's `[fem]` table.

use gearwear::scene::Resolved;
use gearwear::scene::presets;
use gearwear_bodies::gear_mesh::settings::{Body, SectorSides};

/// The fzg-c scene with a `[fem]` table.
fn scene(fem: &str) -> String {
    format!("{}\n[fem]\n{fem}\n", presets::find("fzg-c").unwrap().text)
}

#[test]
fn a_scene_without_fem_gets_the_default_bodies() {
    let resolved = Resolved::from_toml(presets::find("fzg-c").unwrap().text).unwrap();
    assert_eq!(resolved.file.fem, None);
    let fem = resolved.scene.fem;
    assert_eq!(fem.body, Body::Ring);
    assert_eq!(fem.elements_per_half_width, 10.0);
    // Root radii less 2.5 modules: 36 + 0.1817·4.5 − 5.625 − 11.25 and 54 + 0.1715·4.5 − 5.625 − 11.25 mm.
    assert!((fem.clamp_radius_mm.pinion - 19.94265).abs() < 1e-9, "{fem:?}");
    assert!((fem.clamp_radius_mm.wheel - 37.89675).abs() < 1e-9, "{fem:?}");
}

#[test]
fn the_table_is_resolved_and_resolves_to_itself() {
    let text = scene(
        "body = \"sector\"\nsector_sides = \"clamped\"\nclamp_radius_mm = { wheel = 30 }\nelements_per_half_width = 12.5",
    );
    let resolved = Resolved::from_toml(&text).unwrap();
    assert_eq!(resolved.warnings, [""; 0]);
    let fem = resolved.scene.fem;
    assert_eq!(fem.body, Body::Sector { teeth: 3, sides: SectorSides::Clamped });
    assert_eq!((fem.clamp_radius_mm.wheel, fem.elements_per_half_width), (30.0, 12.5));
    let again = Resolved::from_toml(&resolved.to_toml()).unwrap();
    assert_eq!((again.scene, again.file), (resolved.scene, resolved.file));
}

#[test]
fn settings_that_change_nothing_or_little_are_warned_of() {
    for (fem, warning) in [
        ("elements_per_half_width = 4", "fewer than 8 elements"),
        ("sector_teeth = 5", "fem.sector_teeth is not used"),
        ("sector_sides = \"free\"", "fem.sector_sides is not used"),
        ("clamp_radius_mm = { pinion = 0.01994 }", "did you mean 19.94? (m given for mm)"),
    ] {
        let warnings = Resolved::from_toml(&scene(fem)).unwrap().warnings;
        assert!(warnings.iter().any(|w| w.contains(warning)), "{fem}: {warnings:?}");
    }
}

#[test]
fn a_small_gear_gets_a_smaller_body_with_a_warning() {
    // r_f = 3.5 + 0.65 − 1.25 = 2.9 mm: 2.5 mm less leave 0.4 mm, less than a fifth of it, so two fifths are taken.
    let text = "[pair]\nnormal_module_mm = 1.0\npressure_angle_deg = 20.0\ncentre_distance_mm = 24.45\n\
                face_width_mm = 10.0\n\
                [pair.pinion]\nteeth = 7\nprofile_shift = 0.65\ntip_diameter_mm = 9.6\n\
                [pair.wheel]\nteeth = 40\nprofile_shift = 0.35\n\
                [fem]\n[operation]\npinion_torque_Nm = 1.0\npinion_revolutions = 1000\n\
                [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n";
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}"));
    assert!((resolved.scene.fem.clamp_radius_mm.pinion - 0.4 * 2.9).abs() < 1e-12);
    assert!(resolved.warnings.iter().any(|w| w.contains("the pinion is too small")), "{:?}", resolved.warnings);
}

#[test]
fn what_is_wrong_with_the_table_is_said_with_what_is_allowed() {
    for (fem, says) in [
        ("body = \"cube\"", "\"ring\", \"sector\""),
        ("body = \"sector\"\nsector_teeth = 4", "an odd number of teeth, at most 16"),
        ("body = \"sector\"\nsector_teeth = 17", "an odd number of teeth, at most 16"),
        ("elements_per_half_width = 1", "at least 2 and at most 60"),
        ("elements_per_half_width = 61", "at least 2 and at most 60"),
        ("clamp_radius_mm = { pinion = 31.0 }", "at most 30.7427"),
        ("clamp_radius_mm = { pinion = 0.0 }", "greater than 0"),
        ("clamp_radius = 20", "unknown key fem.clamp_radius"),
    ] {
        let problems = Resolved::from_toml(&scene(fem)).unwrap_err();
        let text: String = problems.iter().map(|problem| problem.to_string()).collect();
        assert!(problems.len() == 1 && text.contains(says), "{fem}: {problems:?}");
    }
}
