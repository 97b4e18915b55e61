//! Gears that several mates run on: wear, life and closed forms count every mesh.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

use super::common::loaded;

const FIXED: &str = "step = { revolutions = 9000.0 }";
const ADAPTIVE: &str = "step = \"adaptive\"\ntolerance_um = 1e-4";

fn scene(operation: &str, surface: &str, coefficient: f64, step: &str) -> String {
    format!(
        "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\n{operation}\n[contact]\nsurface = \"{surface}\"\n\
         [stiffness]\nmodel = \"weber-banaschek\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = {coefficient:e}\n[material.wheel]\npreset = \"POM\"\n\
         [numerics]\nerror_estimate = false\nverify = false\nflank_points = 120\npositions = 40\n{step}\n"
    )
}

fn run(text: &str) -> RunRecord {
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}\n{text}"));
    let done = runs::run(&loaded(&resolved), &Unwatched).unwrap();
    assert_eq!(done.failure, None);
    done.record
}

fn near(found: f64, expected: f64, within: f64) {
    assert!((found / expected - 1.0).abs() < within, "{found} and {expected}");
}

/// While wear changes no pressure, a sun with three planets wears three times as fast as one with one, by every figure, and its planets as before.
#[test]
fn ver_a_sun_with_three_planets_wears_three_times_as_fast() {
    for (surface, step) in [("hertz", FIXED), ("winkler", ADAPTIVE), ("half-space", FIXED)] {
        let of = |operation: &str| run(&scene(operation, surface, 1e-24, step)).summary;
        let one = of("pinion_revolutions = 1e5");
        let three = of("pinion_revolutions = 1e5\nmeshes_per_revolution = { pinion = 3 }");
        // What both flanks of a mesh lose is the same still.
        near(three.error.volume_balance.unwrap() + 1.0, one.error.volume_balance.unwrap() + 1.0, 1e-6);
        for (one, three, times) in [(&one.pinion, &three.pinion, 3.0), (&one.wheel, &three.wheel, 1.0)] {
            near(three.peak_wear_um, times * one.peak_wear_um, 1e-6);
            near(three.worn_volume_mm3, times * one.worn_volume_mm3, 1e-6);
            near(three.worn_mass_mg, times * one.worn_mass_mg, 1e-6);
            near(three.vdi_2736_mean_wear_um.unwrap(), times * one.vdi_2736_mean_wear_um.unwrap(), 1e-12);
        }
    }
}

/// The depth at which a life ends comes after a third of it.
#[test]
fn ver_the_life_of_a_sun_is_a_third() {
    let of = |more: &str| {
        let operation = format!("pinion_revolutions = 1e6\nstop = {{ wear_um = 1e-7 }}\n{more}");
        let life = run(&scene(&operation, "hertz", 1e-22, ADAPTIVE)).summary.life.unwrap();
        (life.gear.unwrap(), life.revolutions.unwrap())
    };
    let (gear, one) = of("meshes_per_revolution = { pinion = 2 }");
    assert_eq!(gear, Gear::Pinion);
    let (_, three) = of("meshes_per_revolution = { pinion = 6 }");
    near(3.0 * three, one, 1e-6);
}

/// So many mates over a duration are one over so many durations, in as many steps to the last digits; one each is what is had without the key.
#[test]
fn ver_mates_are_duration() {
    let of = |operation: &str, step: &str| run(&scene(operation, "winkler", 1e-17, step));
    let one = of("pinion_revolutions = 9e4", FIXED);
    let three = of(
        "pinion_revolutions = 3e4\nmeshes_per_revolution = { pinion = 3, wheel = 3 }",
        "step = { revolutions = 3000.0 }",
    );
    near(three.summary.pinion.peak_wear_um, one.summary.pinion.peak_wear_um, 1e-9);
    near(three.summary.wheel.worn_volume_mm3, one.summary.wheel.worn_volume_mm3, 1e-9);
    let said = of("pinion_revolutions = 9e4\nmeshes_per_revolution = { pinion = 1, wheel = 1 }", FIXED);
    assert_eq!(said.summary.pinion, one.summary.pinion);
    assert_eq!(said.summary.wheel, one.summary.wheel);
}

#[test]
fn counts_that_are_none_are_refused_at_their_key() {
    for (count, found) in [("0", "0"), ("21", "21"), ("1.5", "1.5"), ("-3", "-3")] {
        let operation = format!("pinion_revolutions = 1e5\nmeshes_per_revolution = {{ wheel = {count} }}");
        let problems = Resolved::from_toml(&scene(&operation, "hertz", 1e-18, FIXED)).unwrap_err();
        let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
        let key = "operation.meshes_per_revolution.wheel: found";
        assert!(said.len() == 1 && said[0].starts_with(&format!("{key} {found}; allowed: a whole number")), "{said:?}");
    }
}
