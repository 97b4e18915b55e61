//! The plan has what the scene needs, and nothing else.

use gearwear::scene::Resolved;
use gearwear::scene::draft::Draft;
use gearwear::scene::presets;
use gearwear_bodies::gear::GearPair;
use gearwear_physics::plan::cost::RunCost;
use gearwear_physics::plan::{Plan, StageKind};

/// Names of the stages of the thesis-spur scene with parts of its text exchanged, and of those left out.
fn plan(exchange: &[(&str, &str)]) -> (Vec<&'static str>, Vec<&'static str>) {
    let mut text = presets::find("thesis-spur").unwrap().text.to_owned();
    for (old, new) in exchange {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    let plan = Plan::of(&Resolved::from_toml(&text).unwrap().scene);
    let names =
        |stages: &[gearwear_physics::plan::PlannedStage]| stages.iter().map(|stage| stage.kind.name()).collect();
    assert_eq!(plan.stages.len() + plan.left_out.len(), StageKind::ALL.len());
    assert!(plan.stages.iter().chain(&plan.left_out).all(|stage| !stage.reason.is_empty()));
    (names(&plan.stages), names(&plan.left_out))
}

#[test]
fn given_stiffness_needs_no_stiffness_stage() {
    let (stages, left_out) = plan(&[]);
    let of_springs = ["contact-match", "step-bound", "simulation", "error-estimates"];
    let stages_with = |model: &[&'static str], check: &[&'static str]| {
        [&["geometry"], model, &of_springs[..], check, &["report"]].concat()
    };
    assert_eq!(stages, stages_with(&["finite-element-model"], &["verification"]));
    let spring = [
        "tooth-stiffness",
        "teeth-in-space",
        "helical-slices",
        "contact-temperature",
        "film",
        "losses",
        "torque-curve",
    ];
    assert_eq!(left_out, [&["finite-element-calibration"], &spring[..]].concat());
    // Nothing else asks for finite elements.
    let (stages, left_out) = plan(&[("error_estimate = true", "error_estimate = true\nverify = false")]);
    assert_eq!(stages, stages_with(&[], &[]));
    let fem = ["finite-element-model", "finite-element-calibration"];
    assert_eq!(left_out, [&fem[..], &spring[..], &["verification"]].concat());
}

#[test]
fn closed_form_stiffness_is_a_stage() {
    for model in ["weber-banaschek", "iso6336"] {
        let (stages, _) = plan(&[("model = \"constant\"", &format!("model = \"{model}\""))]);
        assert!(stages.contains(&"tooth-stiffness"), "{model}");
    }
}

#[test]
fn a_stiffness_of_finite_elements_is_computed_unless_a_calibration_is_given() {
    let model = ("model = \"constant\"", "model = \"fem\"");
    assert!(plan(&[model]).0.contains(&"finite-element-calibration"));
    let given = ("match = \"half-width\"", "match = \"half-width\"\ncalibration = \"fzg-c.json\"");
    let (stages, left_out) = plan(&[model, given]);
    assert!(stages.contains(&"tooth-stiffness") && left_out.contains(&"finite-element-calibration"), "{stages:?}");
    // The surface fem bends its own teeth.
    let (stages, _) = plan(&[model, ("surface = \"winkler\"", "surface = \"fem\"")]);
    assert!(stages.contains(&"finite-element-model") && !stages.contains(&"finite-element-calibration"), "{stages:?}");
}

#[test]
fn given_foundation_and_hertz_surfaces_need_no_match() {
    for exchange in [
        ("match = \"half-width\"", "foundation_MPa_per_mm = 5.4e5"),
        ("surface = \"winkler\"", "surface = \"hertz\""),
        ("surface = \"winkler\"", "surface = \"hertz-mean\""),
    ] {
        assert!(plan(&[exchange]).1.contains(&"contact-match"), "{exchange:?}");
    }
}

/// Only fixed steps on a surface that answers to short waves of wear have a bound.
#[test]
fn the_step_bound_only_where_steps_have_one() {
    for exchange in
        [("surface = \"winkler\"", "surface = \"hertz\""), ("step = { revolutions = 7665.0 }", "step = \"adaptive\" #")]
    {
        let (stages, left_out) = plan(&[exchange]);
        assert!(!stages.contains(&"step-bound") && left_out.contains(&"step-bound"), "{exchange:?}");
    }
}

#[test]
fn error_estimates_only_where_asked_for() {
    let (stages, left_out) = plan(&[("error_estimate = true", "error_estimate = false")]);
    assert!(!stages.contains(&"error-estimates") && left_out.contains(&"error-estimates"));
}

/// Cost of a preset with keys changed.
fn cost(preset: &str, keys: &[(&str, toml::Value)]) -> RunCost {
    let mut draft = Draft::parse(presets::find(preset).unwrap().text).unwrap();
    for (key, value) in keys {
        draft.set(key, value.clone());
    }
    let scene = draft.resolve().unwrap().scene;
    RunCost::of(&scene, &Plan::of(&scene), &GearPair::new(&scene.pair).unwrap())
}

/// Costs grow with what is computed: those of slices and positions as these, and only what is much is said.
#[test]
fn a_cost_grows_with_the_work_and_much_of_it_is_said() {
    let seconds = |cost: &RunCost, kind: StageKind| {
        cost.stages.iter().find(|stage| stage.kind == kind).map_or(0.0, |stage| stage.seconds)
    };
    let plane = cost("fzg-c", &[]);
    assert!(plane.announcement().is_none() && plane.seconds < 20.0 && plane.memory_gb < 1.0, "{plane:?}");
    assert_eq!(plane.seconds, plane.stages.iter().map(|stage| stage.seconds).sum::<f64>());
    // The verification tells the error of the elements, which takes a run of its own without it.
    let unverified = cost("fzg-c", &[("numerics.verify", false.into())]);
    assert!(seconds(&unverified, StageKind::Verification) == 0.0 && seconds(&plane, StageKind::ErrorEstimates) == 0.0);
    assert!(seconds(&unverified, StageKind::ErrorEstimates) > 0.0);
    let alone = cost("fzg-c", &[("numerics.verify", false.into()), ("numerics.error_estimate", false.into())]);
    assert!(alone.seconds < plane.seconds && alone.seconds < unverified.seconds);
    let finer = cost("fzg-c", &[("numerics.positions", 800.into())]);
    let ratio = seconds(&finer, StageKind::Simulation) / seconds(&plane, StageKind::Simulation);
    assert!((1.0..=2.0).contains(&ratio), "{ratio}: a contact need not move less than a half-width");
    let [few, many] = [20, 100].map(|slices| cost("helical", &[("helical.slices", slices.into())]));
    let ratio = seconds(&many, StageKind::Simulation) / seconds(&few, StageKind::Simulation);
    assert!((ratio / 5.0 - 1.0).abs() < 1e-12 && many.memory_gb > few.memory_gb, "{ratio}, {many:?}");
    // Narrow contact is not meshed as narrow as it is.
    let light = cost("fzg-c", &[("operation.pinion_torque_Nm", 1e-6.into())]);
    assert!(light.memory_gb < 1.0 && light.seconds < 20.0, "{light:?}");
    // On half-planes all flank points pass through contact, however few the positions.
    let halved = |surface: &str| {
        let [all, half] = [60, 30].map(|positions| {
            cost("helical", &[("contact.surface", surface.into()), ("numerics.positions", positions.into())])
        });
        seconds(&half, StageKind::Simulation) / seconds(&all, StageKind::Simulation)
    };
    assert!(halved("half-space") > 0.7 && (halved("winkler") - 0.5).abs() < 1e-12);
    let said = many.announcement().unwrap();
    assert!(said.contains(" GB; less with fewer helical.slices") && said.contains(" s on one thread"), "{said}");
    assert!(said.contains("numerics.verify = false") && !said.contains("phases"), "{said}");
    // What a scene does not have is not advised.
    let plane = cost("fzg-c", &[("numerics.positions", 20_000.into()), ("numerics.verify", false.into())]);
    let said = plane.announcement().unwrap();
    assert!(
        said.contains("fem.elements_per_half_width") && !said.contains("slices") && !said.contains("verify"),
        "{said}"
    );
}

/// Elements grow away from a tip rounding: the cost rises as its radius falls to what counts as sharp, and less than in proportion. Radii are those of
/// both gears, in mm; measured (`gearwear run --threads 1` of the preset, without verification and estimates) on the machine whose units these are: 0.7 s and 0.11 GB, 1.2 s and 0.18 GB, 2 s and 0.23 GB, 1.8 s and 0.22 GB.
#[test]
fn ver_a_sharper_rounding_costs_as_its_elements_do() {
    let of = |rounding_mm: f64| {
        let roundings = ["pair.pinion.tip_rounding_mm", "pair.wheel.tip_rounding_mm"];
        let alone = ["numerics.verify", "numerics.error_estimate"].map(|key| (key, false.into()));
        cost("fzg-c", &[roundings.map(|key| (key, rounding_mm.into())), alone].concat())
    };
    let measured = [(0.1, 0.7, 0.11), (0.03, 1.2, 0.18), (0.01, 2.0, 0.23), (0.005, 1.8, 0.22)];
    for (rounding_mm, seconds, memory_gb) in measured {
        let RunCost { seconds: said_s, memory_gb: said_gb, .. } = of(rounding_mm);
        println!("{rounding_mm} mm: {said_s:.2} s, {said_gb:.2} GB");
        assert!((0.5..2.0).contains(&(said_s / seconds)), "{rounding_mm} mm: {said_s} s");
        assert!((0.5..2.0).contains(&(said_gb / memory_gb)), "{rounding_mm} mm: {said_gb} GB");
    }
    assert!(of(0.002).seconds < of(0.1).seconds, "a sharp edge has no elements of its own");
}
