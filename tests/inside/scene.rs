//! Scenes: presets, defaults, overrides, and the resolved scene that says it all.

use gearwear::scene::loaded::{LoadError, LoadedScene, SceneError};
use gearwear::scene::{Resolved, presets, schema};
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_physics::contact::settings::{Foundation, MatchCriterion, SurfaceKind};
use gearwear_physics::simulation::settings::Stepping;
use gearwear_physics::stiffness::settings::StiffnessSettings;
use proptest::prelude::*;

use super::common::preset_pairs;

/// The least a scene can say.
const LEAST: &str = "pair.preset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302\npinion_revolutions = 6400\n\
                     [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n";

fn resolve(text: &str) -> Resolved {
    Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:#?}"))
}

/// ISO 14635-1: module 4.5, 20°, 16/24 teeth, centre distance 91.5, type C and type A.
#[test]
fn val_presets_are_the_fzg_gears() {
    for (name, width, shifts, tips) in
        [("fzg-c", 14.0, [0.1817, 0.1715], [82.46, 118.36]), ("fzg-a", 20.0, [0.8532, -0.5], [88.77, 112.5])]
    {
        let resolved = resolve(presets::find(name).unwrap().text);
        assert_eq!(resolved.warnings, [""; 0]);
        let pair = &resolved.scene.pair;
        assert_eq!((pair.normal_module_mm, pair.centre_distance_mm, pair.face_width_mm), (4.5, 91.5, width));
        assert_eq!(pair.normal_pressure_angle_rad, 20.0_f64.to_radians());
        assert_eq!(pair.helix_angle_rad, 0.0);
        assert_eq!(Gear::BOTH.map(|gear| pair.gears[gear].teeth), [16, 24]);
        assert_eq!(Gear::BOTH.map(|gear| pair.gears[gear].profile_shift), shifts);
        assert_eq!(Gear::BOTH.map(|gear| pair.gears[gear].tip_diameter_mm), tips.map(Some));
    }
}

/// Tests of physics know no presets: the pairs that they have instead are these.
#[test]
fn ver_presets_are_the_pairs_of_the_tests_of_physics() {
    for (name, pair) in preset_pairs() {
        assert_eq!(resolve(presets::find(name).unwrap().text).scene.pair, pair, "{name}");
    }
}

#[test]
fn a_decimal_comma_is_recognised() {
    let problems = |value: &str| Resolved::from_toml(&LEAST.replace("= 302", value)).unwrap_err();
    let said = &problems("= 30,5")[0];
    assert_eq!((said.key.as_str(), said.found.as_str()), ("operation.pinion_torque_Nm", "30,5"));
    assert!(said.allowed.contains("decimal point, not a comma") && said.help.as_ref().unwrap().contains("30.5"));
    assert!(!problems("= 30,")[0].to_string().contains("point"));
    let quoted = &problems("= \"30,5\"")[0];
    assert!(quoted.help.as_ref().unwrap().contains("decimal point, not comma: 30.5, without quotes"), "{quoted}");
}

/// 302 N·m, 150 rpm, 127.75 h, Winkler matched on half-width from A to E, 20 N/(mm·µm), 1e-17 m²/N, 150 wear steps; whatever the
/// defaults become.
#[test]
fn thesis_spur_is_the_model_of_the_thesis() {
    let resolved = resolve(presets::find("thesis-spur").unwrap().text);
    assert_eq!(resolved.warnings, [""; 0]);
    let scene = resolved.scene;
    let mut broken = resolve(LEAST).scene.pair;
    for gear in Gear::BOTH {
        // The edges of fzg-c are broken, by assumption; the thesis's are not.
        assert_eq!(std::mem::take(&mut broken.gears[gear].modification.tip_rounding_mm), 0.1);
    }
    assert_eq!(scene.pair, broken, "FZG type C");
    assert!(!scene.contact.tip_contact);
    assert_eq!(scene.operation.pinion_torque_n_mm, 302e3);
    assert_eq!(scene.operation.pinion_revolutions, 127.75 * 60.0 * 150.0);
    assert_eq!(scene.operation.snapshots_revolutions.len(), 9);
    assert_eq!(scene.operation.snapshots_revolutions.last(), Some(&scene.operation.pinion_revolutions));
    assert_eq!(scene.contact.surface, SurfaceKind::Winkler);
    assert_eq!(scene.contact.foundation, Foundation::Matched(MatchCriterion::HalfWidth));
    assert_eq!(scene.stiffness, StiffnessSettings::Constant { pair_n_per_mm2: 20e3 });
    assert!((scene.wear.pinion.coefficient_mm2_per_n / 1e-11 - 1.0).abs() < 1e-15);
    assert_eq!(scene.wear.pinion.severe, None);
    assert_eq!((scene.numerics.flank_points, scene.numerics.positions), (750, 400));
    let revolutions = scene.operation.pinion_revolutions / 150.0;
    assert_eq!(scene.numerics.stepping, Stepping::Fixed { revolutions });
}

#[test]
fn defaults_are_those_of_the_contract() {
    let resolved = resolve(LEAST);
    assert_eq!(resolved.title(), "Gear pair 16/24, module 4.5 mm");
    let scene = resolved.scene;
    for gear in Gear::BOTH {
        let material = scene.material[gear];
        assert_eq!(
            (material.young_modulus_mpa, material.poisson_ratio, material.density_kg_per_m3),
            (206e3, 0.3, 7830.0)
        );
    }
    assert_eq!(scene.pair.rack, gearwear_bodies::gear::spec::BasicRack::default());
    assert_eq!((scene.contact.surface, scene.surface_by_default), (SurfaceKind::Fem, true));
    assert!(scene.contact.tip_contact && scene.verify);
    assert_eq!((scene.stiffness, scene.stiffness_by_default), (StiffnessSettings::Fem, true));
    assert!(matches!(scene.numerics.stepping, Stepping::Adaptive { .. }));
    assert_eq!(scene.operation.snapshots_revolutions, [100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0, 6400.0]);
    assert!(scene.numerics.error_estimate);
}

/// Finite elements are the default surface where all sections are alike and nothing is given that only another surface reads; contact too narrow for them
/// is left to half-planes with a warning.
#[test]
fn the_default_surface_follows_what_is_given() {
    let surface = |more: &str| {
        let resolved = resolve(&format!("{LEAST}\n{more}\n"));
        (resolved.scene.contact.surface, resolved.warnings.join("\n"))
    };
    for (more, expected) in [
        ("", SurfaceKind::Fem),
        ("[contact]\ntip_contact = true", SurfaceKind::Fem),
        ("[contact]\ntip_contact = false", SurfaceKind::HalfSpace),
        ("[stiffness]\nmodel = \"weber-banaschek\"", SurfaceKind::HalfSpace),
        ("[contact]\nmatch = \"half-width\"", SurfaceKind::Winkler),
    ] {
        assert_eq!(surface(more).0, expected, "{more}");
    }
    let crowned = format!("pair.pinion.lead_crowning_um = 5.0\n{LEAST}");
    assert_eq!(resolve(&crowned).scene.contact.surface, SurfaceKind::HalfSpace);
    let light = LEAST.replace("pinion_torque_Nm = 302", "pinion_torque_Nm = 0.01");
    let light = resolve(&light);
    assert_eq!(light.scene.contact.surface, SurfaceKind::HalfSpace);
    assert!(light.warnings.iter().any(|warning| warning.contains("too narrow")), "{:?}", light.warnings);
}

#[test]
fn a_key_beside_a_preset_overrides_it() {
    let text = LEAST.replace(
        "pair.preset = \"fzg-c\"\n",
        "[pair]\npreset = \"fzg-c\"\nface_width_mm = 20\ntransverse_module_mm = 4.5\n\
         [pair.wheel]\ntip_relief = { amount_um = 20.0, length_mm = 2.0 }\n",
    );
    let resolved = resolve(&text);
    let pair = &resolved.scene.pair;
    assert_eq!((pair.face_width_mm, pair.normal_module_mm, pair.gears.wheel.teeth), (20.0, 4.5, 24));
    assert_eq!(pair.gears.wheel.modification.tip_relief.unwrap().amount_mm, 20.0 * 1e-3);
    assert_eq!(resolved.file.pair.normal_module_mm, None, "the preset's own module is replaced");
}

#[test]
fn materials_by_name_are_overridden_by_keys() {
    let of = |lines: &str| resolve(&format!("{LEAST}\n{lines}\n")).scene.material;
    let steel = of("");
    assert_eq!(of("[material]\npreset = \"steel\""), steel);
    // The constants of docs/materials.md.
    let mixed = of("[material.wheel]\npreset = \"POM\"\nyoung_modulus_GPa = 2.7");
    assert_eq!(mixed.pinion, steel.pinion);
    let wheel = mixed.wheel;
    assert_eq!([wheel.young_modulus_mpa, wheel.poisson_ratio, wheel.density_kg_per_m3], [2700.0, 0.35, 1415.0]);
    let both = of("[material]\npreset = \"PA66\"\n[material.pinion]\npoisson_ratio = 0.4");
    assert_eq!(
        (both.pinion.young_modulus_mpa, both.pinion.poisson_ratio, both.wheel.poisson_ratio),
        (1850.0, 0.4, 0.3)
    );
    let text = format!("{LEAST}\n[material]\npreset = \"POM\"\n[material.wheel]\npreset = \"steel\"\n");
    assert_eq!(Resolved::from_toml(&text).unwrap_err()[0].key, "material.wheel.preset");
    let text = format!("{LEAST}\n[material]\npreset = \"pom\"\n");
    assert!(Resolved::from_toml(&text).unwrap_err()[0].to_string().contains("POM"));
}

#[test]
fn coefficient_in_either_unit_is_the_same() {
    let other = LEAST.replace("coefficient_m2_per_N = 1e-17", "coefficient_mm3_per_Nm = 1e-8");
    let [one, other] = [LEAST, &other].map(|text| resolve(text).scene.wear.pinion.coefficient_mm2_per_n);
    assert!((one / other - 1.0).abs() < 1e-15, "{one} {other}");
}

#[test]
fn the_end_of_the_run_is_always_kept() {
    for (snapshots, kept) in [
        ("snapshots_revolutions = [100.0]", vec![100.0, 6400.0]),
        ("snapshots_revolutions = [6400.0]", vec![6400.0]),
        ("snapshots_revolutions = []", vec![6400.0]),
        ("pinion_speed_rpm = 10.0\nsnapshots_h = [1.0]", vec![600.0, 6400.0]),
    ] {
        let text = LEAST.replace("pinion_revolutions = 6400", &format!("pinion_revolutions = 6400\n{snapshots}"));
        let resolved = resolve(&text);
        assert_eq!(resolved.scene.operation.snapshots_revolutions, kept);
        assert_eq!(resolve(&resolved.to_toml()).scene, resolved.scene);
    }
}

#[test]
fn extreme_but_meant_values_are_accepted() {
    let text = presets::find("thesis-spur").unwrap().text.replace("step = ", "# step = ");
    for (old, new) in [
        ("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 1e-6"),
        ("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 1e7"),
        ("face_width_mm = 14.0", "face_width_mm = 0.1"),
        ("face_width_mm = 14.0", "face_width_mm = 1000"),
        ("young_modulus_GPa = 206.0", "young_modulus_GPa = 0.001"),
        ("young_modulus_GPa = 206.0", "young_modulus_GPa = 1000"),
        ("hours = 127.75  ", "pinion_revolutions = 1e12 #"),
        ("pair_N_per_mm_um = 20.0", "pair_N_per_mm_um = 2e7"),
        ("pair_N_per_mm_um = 20.0", "pair_N_per_mm_um = 2e-5"),
        ("match = \"half-width\"", "foundation_MPa_per_mm = 0.54"),
        ("match = \"half-width\"", "foundation_MPa_per_mm = 5.4e11"),
        ("coefficient_m2_per_N = 1e-17", "coefficient_m2_per_N = 1e-8"),
    ] {
        assert!(text.contains(old), "{old}");
        resolve(&text.replacen(old, new, 1));
    }
    let least = LEAST.replace("pinion_revolutions = 6400", "pinion_revolutions = 1");
    assert_eq!(resolve(&least).scene.operation.pinion_revolutions, 1.0);
}

#[test]
fn settings_that_are_not_used_are_named() {
    let warnings = |surface: &str, tip_contact: bool| {
        let text = presets::find("thesis-spur").unwrap().text.replace("match = ", "# match = ");
        let text = text.replace("surface = \"winkler\"", &format!("surface = \"{surface}\""));
        resolve(&text.replace("tip_contact = false", &format!("tip_contact = {tip_contact}"))).warnings
    };
    let text = presets::find("thesis-spur").unwrap().text.replace("surface = \"winkler\"", "surface = \"hertz\"");
    assert_eq!(resolve(&text).warnings.len(), 1);
    assert!(resolve(&text).warnings[0].starts_with("contact.match is not used"));
    // Hertz's closed forms end at A and E, finite elements do not: only the opposite goes unheard.
    for (surface, heard) in [("hertz", false), ("hertz-mean", false), ("fem", true)] {
        let unheard = |asked| warnings(surface, asked).iter().any(|w| w.starts_with("contact.tip_contact is not used"));
        assert_eq!([heard, !heard].map(unheard), [false, true], "{surface}");
    }
}

#[test]
fn the_resolved_scene_says_the_same_bit_for_bit() {
    for text in presets::PRESETS.map(|preset| preset.text).into_iter().chain([LEAST]) {
        let resolved = resolve(text);
        let again = resolve(&resolved.to_toml());
        assert_eq!(again.scene, resolved.scene);
        assert_eq!(again.to_toml(), resolved.to_toml());
        assert_eq!(again.scene_hash(), resolved.scene_hash());
        assert_eq!(resolved.scene_hash().len(), 16);
        assert!(!resolved.to_toml().contains("preset"));
        assert!(resolved.to_toml().contains("coefficient_m2_per_N = 1e-17\n"));
    }
}

/// Resolving `more` above the least scene, and the scene that it writes: the same to the bit.
fn resolved_twice(more: &str) -> Resolved {
    let resolved = resolve(&format!("{more}{LEAST}"));
    let again = resolve(&resolved.to_toml());
    assert_eq!((&again.scene, again.to_toml()), (&resolved.scene, resolved.to_toml()), "{more}");
    resolved
}

/// FZG type C, ISO 21771: inv α_wt = inv 20° + 2 tan 20° · 0.3532/40 = 0.0213323, α_wt = 22.4389°, a = 90 cos 20°/cos α_wt = 91.50008 mm without
/// backlash. With j_wt or j_bn = j_wt cos α_wt the pair has it, instead of the preset's centre distance.
#[test]
fn val_the_centre_distance_follows_from_the_backlash() {
    for key in ["backlash_um", "normal_backlash_um"] {
        let spec = resolved_twice(&format!("pair.{key} = 0\n")).scene.pair;
        assert!((spec.centre_distance_mm - 91.50008).abs() < 1e-5, "{key}: {}", spec.centre_distance_mm);
    }
    let resolved = resolved_twice("pair.backlash_um = 150\n");
    let pair = GearPair::new(&resolved.scene.pair).unwrap();
    assert!((pair.backlash_mm - 0.15).abs() < 1e-12, "{}", pair.backlash_mm);
    assert!(resolved.to_toml().contains("centre_distance_mm = 91.6") && !resolved.to_toml().contains("backlash"));
    let normal_um = 150.0 * pair.working_pressure_angle_rad.cos();
    let normal = resolved_twice(&format!("pair.normal_backlash_um = {normal_um:?}\n")).scene.pair;
    assert!((normal.centre_distance_mm / pair.spec.centre_distance_mm - 1.0).abs() < 1e-14);
}

/// ρ = √((d/2)² − r_b²) = r_b φ, r_b = 36 cos 20° of the pinion, 54 cos 20° of the wheel.
#[test]
fn val_reliefs_begin_at_a_diameter_or_a_roll_angle() {
    let resolved = resolved_twice(
        "pair.pinion.tip_relief = { amount_um = 20, begins_at_diameter_mm = 80.1 }\n\
         pair.pinion.root_relief = { amount_um = 10, begins_at_roll_angle_deg = 12 }\n\
         pair.wheel.root_relief = { amount_um = 10, begins_at_diameter_mm = 106.0, shape = \"parabolic\" }\n",
    );
    let pair = GearPair::new(&resolved.scene.pair).unwrap();
    let rb = [36.0, 54.0].map(|r| r * 20.0_f64.to_radians().cos());
    let rho = |diameter: f64, rb: f64| ((0.5 * diameter).powi(2) - rb * rb).sqrt();
    let of = |gear: Gear| pair.spec.gears[gear].modification;
    let tip = of(Gear::Pinion).tip_relief.unwrap();
    assert!((tip.length_mm - (rho(82.46, rb[0]) - rho(80.1, rb[0]))).abs() < 1e-10, "{}", tip.length_mm);
    // SAP: 2 ρ_Nf from the mate's tip, ρ_1 + ρ_2 = √(a² − (r_b1 + r_b2)²).
    let tangents = (91.5_f64.powi(2) - (rb[0] + rb[1]).powi(2)).sqrt();
    let root = of(Gear::Pinion).root_relief.unwrap();
    let expected = rb[0] * 12.0_f64.to_radians() - (tangents - rho(118.36, rb[1]));
    assert!((root.length_mm - expected).abs() < 1e-10, "{}", root.length_mm);
    let of_wheel = of(Gear::Wheel).root_relief.unwrap();
    let expected = rho(106.0, rb[1]) - (tangents - rho(82.46, rb[0]));
    assert!((of_wheel.length_mm - expected).abs() < 1e-10, "{}", of_wheel.length_mm);
    assert!(!resolved.to_toml().contains("begins_at"));
}

/// ISO 1328-1:2013, helix slope tolerance: d = 72 mm, b = 14 mm, class 6: (0.05 √72 + 0.35 √14 + 4) √2 = 8.11, rounded to 8 µm; class 8 of the wheel,
/// d = 108 mm: 5.829 · 2√2 = 16.49, rounded to 16 µm.
#[test]
fn val_a_class_is_the_whole_tolerance_of_the_helix_slope() {
    let resolved = resolved_twice("pair.pinion.helix_slope_class = 6\npair.wheel.helix_slope_class = 8\n");
    let slopes = Gear::BOTH.map(|gear| resolved.scene.pair.gears[gear].modification.helix_slope_mm);
    assert_eq!(slopes, [8.0 * 1e-3, 16.0 * 1e-3]);
    assert!(resolved.to_toml().contains("helix_slope_deviation_um = 8.0") && !resolved.to_toml().contains("class"));
    let wide = resolve(&format!("pair.face_width_mm = 3.0\npair.pinion.helix_slope_class = 6\n{LEAST}"));
    assert!(
        wide.warnings.iter().any(|warning| warning.contains("face width of 3 mm") && warning.contains("4 to 1200"))
    );
}

/// A key changed in one way of saying takes the place of the other, also of a preset's.
#[test]
fn a_changed_key_takes_the_place_of_the_other_ways_to_say_it() {
    let scene =
        LoadedScene::from_toml(&format!("{LEAST}[pair.pinion]\ntip_relief = {{ amount_um = 20, length_mm = 2 }}\n"))
            .unwrap();
    let tip =
        |scene: &LoadedScene| scene.to_toml().lines().find(|line| line.starts_with("length_mm")).unwrap().to_owned();
    let begun = scene.with("pair.pinion.tip_relief.begins_at_diameter_mm", 80.1).unwrap();
    assert!(tip(&scene) == "length_mm = 2.0" && tip(&begun).starts_with("length_mm = 2.1"), "{}", tip(&begun));
    assert_eq!(tip(&begun.with("pair.pinion.tip_relief.length_mm", 3.0).unwrap()), "length_mm = 3.0");
    let close = scene.with("pair.backlash_um", 0.0).unwrap();
    assert!(close.with("pair.centre_distance_mm", 91.6).unwrap().to_toml().contains("centre_distance_mm = 91.6"));
}

#[test]
fn wear_coefficients_of_any_size_survive_the_resolved_scene() {
    for k in ["1e-17", "1.25e-19", "0.001", "1", "1e30"] {
        let scene = resolve(&LEAST.replace("1e-17", k));
        assert_eq!(resolve(&scene.to_toml()).scene, scene.scene, "{k}");
    }
}

#[test]
fn the_schema_holds_for_presets_and_resolved_scenes() {
    let validator = jsonschema::validator_for(schema::schema()).unwrap();
    for text in presets::PRESETS.map(|preset| preset.text).into_iter().chain([LEAST]) {
        for text in [text.to_owned(), resolve(text).to_toml()] {
            let scene: toml::Table = text.parse().unwrap();
            let scene = serde_json::to_value(scene).unwrap();
            assert!(
                validator.is_valid(&scene),
                "{:?}",
                validator.iter_errors(&scene).map(|e| e.to_string()).collect::<Vec<_>>()
            );
        }
    }
    for wrong in ["{}", r#"{"pair": {"presett": "fzg-c"}}"#] {
        assert!(!validator.is_valid(&serde_json::from_str(wrong).unwrap()));
    }
    assert_eq!(schema::schema()["additionalProperties"], false);
}

/// Editors take an internal wheel with negative numbers (DIN 3960), and none between.
#[test]
fn the_published_schema_takes_negative_numbers() {
    let validator = jsonschema::validator_for(schema::published()).unwrap();
    let with = |teeth: i64, centre_distance_mm: f64| {
        let mut scene: toml::Table = LEAST.parse().unwrap();
        gearwear::scene::table::set(&mut scene, "pair.wheel.teeth", teeth);
        gearwear::scene::table::set(&mut scene, "pair.centre_distance_mm", centre_distance_mm);
        validator.is_valid(&serde_json::to_value(scene).unwrap())
    };
    assert!(with(24, 91.5) && with(-60, -60.0) && with(-60, 60.0));
    assert!(!with(-4, -60.0) && !with(60, 0.0));
}

/// Every key has its meaning written beside it.
#[test]
fn the_schema_describes_every_key() {
    fn walk(node: &serde_json::Value, path: &str) {
        for (key, child) in node.get("properties").and_then(|p| p.as_object()).into_iter().flatten() {
            assert!(child.get("description").is_some(), "{path}.{key}");
            walk(child, &format!("{path}.{key}"));
        }
    }
    walk(schema::schema(), "");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever becomes of a scene's text, it is resolved or refused, and every span lies in the text.
    #[test]
    fn prop_no_text_makes_it_panic(
        which in 0..presets::PRESETS.len(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, "[-=.\\[\\]{}\"#\\n0-9e a-zµ]{0,6}"), 0..6),
        cut in proptest::option::of(any::<prop::sample::Index>()),
    ) {
        let mut text: Vec<char> = presets::PRESETS[which].text.chars().collect();
        for (at, removed, inserted) in edits {
            let at = at.index(text.len() + 1);
            let end = (at + removed).min(text.len());
            text.splice(at..end, inserted.chars());
        }
        if let Some(cut) = cut {
            text.truncate(cut.index(text.len() + 1));
        }
        let text: String = text.into_iter().collect();
        match Resolved::from_toml(&text) {
            Ok(resolved) => {
                let again = Resolved::from_toml(&resolved.to_toml()).map_err(|p| TestCaseError::fail(format!("{p:?}")))?;
                prop_assert_eq!(again.scene, resolved.scene);
            }
            Err(problems) => {
                prop_assert!(!problems.is_empty());
                for problem in problems {
                    prop_assert!(problem.span.is_none_or(|s| s.start <= s.end && s.end <= text.len()));
                }
            }
        }
    }
}

/// What a scene names is read when it is opened; what is missing is an error and never another model.
#[test]
fn a_loaded_scene_has_its_files() {
    let with = |lines: &str| {
        let text = presets::find("fzg-c").unwrap().text.replace("# surface = \"fem\"", "surface = \"winkler\"");
        LoadedScene::from_toml(&format!("{text}\n{lines}"))
    };
    let refused = |scene: Result<LoadedScene, LoadError>, key: &str| match scene {
        Err(LoadError::Scene(SceneError { problems, .. })) => {
            assert_eq!(problems.len(), 1, "{problems:?}");
            assert_eq!(problems[0].key, key);
        }
        other => panic!("{key}: {other:?}"),
    };
    let winkler = with("").unwrap();
    refused(winkler.with("contact.calibration", "nowhere.json"), "contact.calibration");
    refused(with("[stiffness]\nmodel = \"simon\"\ncurve = \"nowhere.csv\"\n"), "stiffness.curve");

    // A variant of a scene without files, as studies make them, cannot ask for one.
    let asks = |change: &dyn Fn(&mut gearwear_physics::operation::Scene)| {
        let mut resolved = winkler.resolved.clone();
        change(&mut resolved.scene);
        winkler.variant(resolved).map(drop)
    };
    let calibrated = |scene: &mut gearwear_physics::operation::Scene| {
        scene.contact.foundation = Foundation::Calibrated(MatchCriterion::HalfWidth);
    };
    assert_eq!(asks(&calibrated).unwrap_err().key, "contact.calibration");
    let by_curve = |scene: &mut gearwear_physics::operation::Scene| scene.stiffness = StiffnessSettings::WangCheng;
    assert_eq!(asks(&by_curve).unwrap_err().key, "stiffness.curve");
    asks(&|_| ()).unwrap();
}

/// What a program changes in a scene is as if the file said so: files that it names anew are read, keys that no scene has are refused,
/// and the folder of its run is complete.
#[test]
fn a_changed_scene_is_as_if_the_file_said_so() {
    use gearwear_physics::assessment::calibrate::{self, CalibrationExtent};

    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let text = presets::find("fzg-c").unwrap().text.replace("# surface = \"fem\"", "surface = \"winkler\"");
    let scene = LoadedScene::open(file("scene.toml", &text)).unwrap();
    let key_of = |scene: Result<LoadedScene, LoadError>| match scene {
        Err(LoadError::Scene(SceneError { problems, .. })) => problems[0].key.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(key_of(scene.with("operation.hours.x", 3.0)), "operation.hours");
    assert_eq!(key_of(scene.with("operation.hour", 3.0)), "operation.hour");
    assert_eq!(key_of(scene.without("operation.hour")), "operation.hour");
    assert_eq!(scene.without("fem").unwrap().resolved.scene.fem, scene.resolved.scene.fem);

    // Coarse elements: the fewer, the faster.
    let coarse = scene.with("fem.elements_per_half_width", 3.0).unwrap();
    let made =
        calibrate::run(coarse.scene(), CalibrationExtent::FastModel, &coarse.teeth_in_space, &gearwear::Unwatched)
            .unwrap()
            .calibration;
    file("other.json", "{}");
    file("same.json", &made.to_json());
    let calibrated = scene.with_calibration(made.clone()).unwrap();
    assert_eq!(key_of(calibrated.with("contact.calibration", "other.json")), "contact.calibration");
    let named = scene.with("contact.calibration", "same.json").unwrap();
    assert_eq!(named.files.calibration.as_ref(), Some(&made));
    // Without it there is none.
    assert_eq!(named.without("contact.calibration").unwrap().files.calibration, None);

    let quick = calibrated.without("operation.snapshots_h").unwrap().with("operation.hours", 1).unwrap();
    let quick = ["numerics.verify", "numerics.error_estimate"].iter().fold(quick, |s, key| s.with(key, false).unwrap());
    let run = gearwear::run(&quick, &gearwear::Unwatched).unwrap().complete().unwrap();
    let out = folder.path().join("out");
    gearwear::write(&run, &out).unwrap();
    let again = LoadedScene::open(out.join("scene.toml")).unwrap();
    assert_eq!(again.files.calibration.as_ref(), Some(&made));
    assert_eq!(again.resolved.scene_hash(), run.summary.scene_hash);
}
