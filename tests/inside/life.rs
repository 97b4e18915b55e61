//! The life to a limit: where it ends, on every kind of contact, and what is refused.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::{LoadedScene, evaluate};
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::life::LifeLimit;
use gearwear_physics::results::run::{RunRecord, StopReason};

use super::common::loaded;

const FIXED: &str = "step = { revolutions = 9000.0 }";
const HELICAL: &str = "[helical]\nslices = 4\ncoupling = \"none\"";
const FEM: &str = "[fem]\nbody = \"sector\"\nsector_teeth = 3\nelements_per_half_width = 3";

fn scene(operation: &str, contact: &str, coefficient: f64, step: &str, more: &str) -> String {
    let pair = if more.contains("[helical]") { "helical" } else { "fzg-c" };
    format!(
        "[pair]\npreset = \"{pair}\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\n{operation}\n[contact]\n{contact}\n\
         [stiffness]\nmodel = \"weber-banaschek\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = {coefficient:e}\n\
         [numerics]\nerror_estimate = false\nverify = false\nflank_points = 120\npositions = 40\n{step}\n{more}\n"
    )
}

fn run(text: &str) -> RunRecord {
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}\n{text}"));
    let done = runs::run(&loaded(&resolved), &Unwatched).unwrap();
    assert_eq!(done.failure, None);
    done.record
}

fn greatest_wear_um(record: &RunRecord) -> f64 {
    record.summary.pinion.peak_wear_um.max(record.summary.wheel.peak_wear_um)
}

/// While wear changes no pressure it grows in proportion to the time: k Δn, so that three tenths of the wear take three tenths of the
/// duration, on every kind of contact and with every kind of steps.
#[test]
fn ver_life_of_wear_in_proportion_to_time() {
    for (contact, step, more) in [
        ("surface = \"hertz\"", FIXED, ""),
        ("surface = \"winkler\"", "step = \"adaptive\"\ntolerance_um = 1e-4", ""),
        ("surface = \"half-space\"", FIXED, ""),
        ("surface = \"fem\"", FIXED, FEM),
        ("surface = \"hertz-mean\"", FIXED, HELICAL),
        ("surface = \"winkler\"", FIXED, HELICAL),
    ] {
        let whole = run(&scene("pinion_revolutions = 1e5", contact, 1e-24, step, more));
        assert_eq!((whole.summary.stopped, whole.summary.life.as_ref()), (StopReason::Completed, None));
        let limit_um = 0.3 * greatest_wear_um(&whole);
        let stop = format!("pinion_revolutions = 1e5\nstop = {{ wear_um = {limit_um:e} }}");
        let ended = run(&scene(&stop, contact, 1e-24, step, more));
        let life = ended.summary.life.as_ref().unwrap();
        assert_eq!(
            (ended.summary.stopped, life.reached),
            (StopReason::LimitReached, Some(LifeLimit::Wear)),
            "{contact}"
        );
        let revolutions = life.revolutions.unwrap();
        // Equilibria are found to 1e-11 of the load, on finite elements with nodes that tilt by 1e-3 of the levers.
        let known = if contact.contains("fem") { 1e-4 } else { 1e-8 };
        assert!((revolutions / 3e4 - 1.0).abs() <= known, "{contact} {more}: {revolutions}");
        assert!((greatest_wear_um(&ended) / limit_um - 1.0).abs() < 1e-12, "{contact} {more}");
        assert_eq!(ended.summary.revolutions, revolutions);
        assert_eq!(ended.history.last().unwrap().revolutions, revolutions);
        assert!((life.hours.unwrap() - revolutions / 9000.0).abs() < 1e-12);
    }
}

/// Wear that changes the pressure: a run just as long as the life has worn the limit, to the bits of another length of the last step
/// with Euler's method, and within the tolerance with adaptive steps.
#[test]
fn ver_a_run_as_long_as_the_life_wears_the_limit() {
    let contact = "surface = \"winkler\"\ntip_contact = false";
    for (step, within) in [(FIXED, 1e-9), ("step = \"adaptive\"\ntolerance_um = 0.01", 2e-3)] {
        let stop = "pinion_revolutions = 1e6\nsnapshots_revolutions = [1e6]\nstop = { wear_um = 5.0 }";
        let ended = run(&scene(stop, contact, 2e-17, step, ""));
        let revolutions = ended.summary.life.unwrap().revolutions.unwrap();
        let operation = format!("pinion_revolutions = {revolutions:e}\nsnapshots_revolutions = [{revolutions:e}]");
        let plain = run(&scene(&operation, contact, 2e-17, step, ""));
        for (one, other) in [(&ended.flanks.pinion, &plain.flanks.pinion), (&ended.flanks.wheel, &plain.flanks.wheel)] {
            let off = one.wear_um.iter().zip(&other.wear_um).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= 5.0 * within, "{step}: {off} µm");
        }
        assert!(greatest_wear_um(&plain) > 4.9);
    }
}

/// s_an = (s_a − h/cos α_a) cos β_a: the figures of the summary themselves, and the gear with less room comes to the limit.
#[test]
fn ver_life_to_a_tip_thickness() {
    let contact = "surface = \"hertz-mean\"";
    let new = run(&scene("pinion_revolutions = 1e3", contact, 1e-24, FIXED, HELICAL));
    let left = |record: &RunRecord| {
        [record.summary.pinion.normal_tip_thickness_mm, record.summary.wheel.normal_tip_thickness_mm]
    };
    let thin = if left(&new)[0] < left(&new)[1] { Gear::Pinion } else { Gear::Wheel };
    let limit_mm = left(&new)[thin as usize] - 0.002;
    let stop = format!("pinion_revolutions = 1e7\nstop = {{ tip_thickness_mm = {limit_mm}, wear_um = 500.0 }}");
    let ended = run(&scene(&stop, contact, 1e-17, "", HELICAL));
    let life = ended.summary.life.clone().unwrap();
    assert_eq!(life.reached, Some(LifeLimit::TipThickness), "{life:?}");
    let gear = life.gear.unwrap();
    let (s, geometry) = (&ended.summary, &ended.summary.geometry.gears[gear]);
    assert!((left(&ended)[gear as usize] - limit_mm).abs() < 1e-12);
    let wear = [&s.pinion, &s.wheel][gear as usize];
    let radii = [geometry.tip_diameter_mm, geometry.base_diameter_mm, geometry.reference_diameter_mm];
    let [tip, base, reference] = radii.map(|diameter| 0.5 * diameter);
    let helix_angle = s.helical.as_ref().unwrap().helix_angle_deg.to_radians();
    let beta_a = (helix_angle.tan() * tip / reference).atan();
    let expected = (geometry.tip_thickness_mm - 1e-3 * wear.tip_edge_wear_um * tip / base) * beta_a.cos();
    assert!((expected - limit_mm).abs() < 1e-12, "{expected} {limit_mm}");
}

/// A limit in a later phase ends the life there; hours are those of the phases' speeds.
#[test]
fn ver_life_in_a_phase() {
    let contact = "surface = \"hertz\"";
    let phase = |speed: f64, revolutions: f64| {
        format!("[[operation.phases]]\npinion_speed_rpm = {speed}\npinion_revolutions = {revolutions:e}\n")
    };
    let phases = format!("{}{}", phase(100.0, 6e4), phase(1000.0, 6e4));
    let whole = run(&scene("pinion_revolutions = 1.2e5", contact, 1e-24, FIXED, ""));
    let stop = format!("stop = {{ wear_um = {:e} }}\n{phases}", 0.75 * greatest_wear_um(&whole));
    let ended = run(&scene(&stop, contact, 1e-24, FIXED, ""));
    let life = ended.summary.life.as_ref().unwrap();
    assert!((life.revolutions.unwrap() / 9e4 - 1.0).abs() < 1e-9);
    assert!((life.hours.unwrap() / (6e4 / 6e3 + 3e4 / 6e4) - 1.0).abs() < 1e-9);
    assert_eq!(ended.summary.phases.len(), 2);
    assert!((ended.summary.phases[1].revolutions / 3e4 - 1.0).abs() < 1e-9);
}

/// Error estimates of a life are those of its own length.
#[test]
fn ver_errors_are_those_of_the_life() {
    let contact = "surface = \"hertz\"";
    let estimated = |operation: &str| {
        let text = scene(operation, contact, 2e-17, "step = { revolutions = 5000.0 }", "");
        run(&text.replace("error_estimate = false", "error_estimate = true")).summary
    };
    let ended = estimated("pinion_revolutions = 1e6\nsnapshots_revolutions = [1e6]\nstop = { wear_um = 2.0 }");
    let revolutions = ended.revolutions;
    let plain = estimated(&format!("pinion_revolutions = {revolutions:e}\nsnapshots_revolutions = [{revolutions:e}]"));
    for (one, other) in
        [(ended.error.discretisation, plain.error.discretisation), (ended.error.wear_step, plain.error.wear_step)]
    {
        assert!((one.unwrap() / other.unwrap() - 1.0).abs() < 1e-6, "{one:?} {other:?}");
    }
}

#[test]
fn a_limit_that_is_not_reached_leaves_no_life() {
    let stop = "pinion_revolutions = 1e5\nstop = { wear_um = 50.0, tip_thickness_mm = 0.5 }";
    let summary = run(&scene(stop, "surface = \"hertz\"", 1e-18, FIXED, "")).summary;
    let life = summary.life.unwrap();
    assert_eq!(summary.stopped, StopReason::Completed);
    assert_eq!((life.reached, life.gear, life.hours, life.revolutions), (None, None, None, None));
    let reason = life.not_reached.unwrap();
    assert!(reason.starts_with("after 11.1111 h the maximum wear is "), "{reason}");
}

#[test]
fn a_life_is_an_output() {
    let text = scene("hours = 200.0\nstop = { wear_um = 5.0 }", "surface = \"hertz\"", 1e-17, "", "");
    let scene = LoadedScene::from_toml(&text).unwrap();
    let rows = [vec![5.0.into()], vec![2.5.into()], vec![100.0.into()]];
    let found = evaluate(&scene, &["operation.stop.wear_um"], &rows, &["life.hours"], 2, &Unwatched).unwrap();
    let lives: Vec<f64> = found.values.iter().map(|row| row[0]).collect();
    assert!(lives[0] > 1.5 * lives[1] && lives[1] > 0.0, "{lives:?} {:?}", found.reasons);
    assert!(lives[2].is_nan());
    assert_eq!(found.reasons[2].as_deref(), Some("life.hours: the run has no such figure"));
}

#[test]
fn limits_that_cannot_be_meant_are_refused() {
    for (stop, key, allowed) in [
        ("stop = {}", "operation.stop.wear_um", "a number greater than 0"),
        ("stop = { wear_um = -1.0 }", "operation.stop.wear_um", "greater than 0"),
        ("stop = { wear = 1.0 }", "operation.stop.wear", "wear_um"),
        ("stop = { tip_thickness_mm = 3.0 }", "operation.stop.tip_thickness_mm", "the normal tip thickness of the new"),
    ] {
        let text = scene(&format!("pinion_revolutions = 1e5\n{stop}"), "surface = \"hertz\"", 1e-18, FIXED, "");
        let problems = Resolved::from_toml(&text).unwrap_err();
        assert_eq!(problems.len(), 1, "{problems:?}");
        assert_eq!(problems[0].key, key);
        assert!(problems[0].to_string().contains(allowed), "{}", problems[0]);
    }
}
