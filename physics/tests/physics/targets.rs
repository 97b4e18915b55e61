//! What the thesis says the simulator must show, for spur gears (targets S2–S5, S11, S12; S1 is in `validation/fzg-c-geometry`).
//! Thresholds marked "ours" were set by the project; the others are the thesis's own.

use gearwear_bodies::gear::{
    Gear, GearPair,
    modification::{Relief, ReliefShape},
};
use gearwear_physics::contact::settings::MatchCriterion;
use gearwear_physics::mesh_cycle::wearing_pair::Snapshot;
use gearwear_physics::simulation::figures::WearFigures;
use gearwear_physics::simulation::wear_run::Outcome;
use gearwear_physics::wear::settings::SevereTransition;

use super::common::{assert_close, fzg_c, fzg_c_scene, pair};

/// Load stage 6, at which S3 and S5 are asked.
const STAGE_6_N_MM: f64 = 135.3e3;

fn figures(pair: &GearPair, outcome: &Outcome, snapshot: &Snapshot) -> WearFigures {
    WearFigures::at(pair, Gear::Pinion, outcome, snapshot)
}

/// S2, Fig 17a: most wear near the root, least at the pitch line, more again at the tip: root maximum more than 10 times
/// the pitch value, and a local maximum in the last 10 % of the flank (ours).
#[test]
fn val_s2_root_pitch_line_and_tip() {
    let pair = pair(&fzg_c());
    let outcome = fzg_c_scene().run();
    let wear = figures(&pair, &outcome, &outcome.worn);
    assert!(wear.root_mm > 10.0 * wear.pitch_mm, "{wear:?}");
    assert_eq!(wear.root_mm, wear.peak_mm);
    // An independent calculation for the project gives 7.3 µm at SAP + 0.1 mm.
    assert_close("root wear", wear.root_mm, 7.3e-3, 0.05);
    assert!((wear.peak_radius_mm - pair.active_start_radius_mm(Gear::Pinion) - 0.1).abs() < 0.05, "{wear:?}");

    let points = &outcome.worn.wear_mm.pinion;
    let local = (675..750).find(|&i| points[i] > points[i - 1] && points[i] > points[i + 1]);
    let tip = local.expect("a local maximum near the tip");
    assert!(points[tip] > 1.1 * points[700], "{} at {tip}, {} before", points[tip], points[700]);
}

/// S3, Fig 17a: the greatest wear moves from the very root towards the pitch point and the wear there slows down. At
/// 135.3 N·m over 1e7 revolutions an independent calculation for the project finds the place going from 0.12 to about
/// 0.28 mm above SAP and the rate at SAP falling to 0.53 of its first value.
#[test]
fn val_s3_wear_moves_up_from_the_root() {
    let pair = pair(&fzg_c());
    let mut scene = fzg_c_scene();
    scene.torque_n_mm = STAGE_6_N_MM;
    scene.revolutions = 1e7;
    scene.snapshots = (1..10).map(|k| 1e6 * f64::from(k)).collect();
    let outcome = scene.run();
    let start = pair.active_start_radius_mm(Gear::Pinion);
    let places: Vec<f64> =
        outcome.snapshots.iter().map(|s| figures(&pair, &outcome, s).peak_radius_mm - start).collect();
    assert!(places.windows(2).all(|two| two[1] >= two[0]), "{places:?}");
    assert!(places[0] < 0.13 && (places[9] - 0.28).abs() < 0.03, "{places:?}");

    let rate_at_start = |snapshot: &Snapshot| {
        outcome.grid.pinion.value_at(&snapshot.depth_per_mesh_mm.pinion, pair.active_start_rho_mm(Gear::Pinion))
    };
    let rates: Vec<f64> = std::iter::once(&outcome.new).chain(&outcome.snapshots).map(rate_at_start).collect();
    assert!(rates.windows(2).all(|two| two[1] < two[0]), "{rates:?}");
    let fallen_to = rates[10] / rates[0];
    assert!((fallen_to - 0.53).abs() < 0.05, "{fallen_to}");
}

/// S3 with the severe transition at load stage 10: the greatest wear moves on to about 2 mm above SAP, where the
/// independent calculation finds 26.5 µm at SAP + 1.9 mm.
#[test]
fn val_s3_severe_wear_moves_on_to_two_millimetres() {
    let pair = pair(&fzg_c());
    let mut scene = fzg_c_scene();
    scene.torque_n_mm = 372.6e3;
    scene.severe = Some(SevereTransition { above_mpa: 2000.0, factor: 100.0, band_mpa: 0.0 });
    scene.steps = 1500.0;
    let outcome = scene.run();
    let wear = figures(&pair, &outcome, &outcome.worn);
    let above = wear.peak_radius_mm - pair.active_start_radius_mm(Gear::Pinion);
    assert!((above - 1.9).abs() < 0.15, "{above}");
    assert_close("depth", wear.peak_mm, 26.5e-3, 0.05);
}

/// S4, Fig 17a against 17b: integrating the pressure over the strip smooths the change in the number of pairs; the
/// simplified model is sharply pointed there. Largest second difference at B and D: at least 5 times as large (ours).
#[test]
fn val_s4_the_simplified_model_is_sharply_pointed() {
    let pair = pair(&fzg_c());
    let mut scene = fzg_c_scene();
    let mut sharpest = |surface| {
        scene.surface = surface;
        let outcome = scene.run();
        let wear = outcome.worn.wear_mm.pinion;
        [pair.path.lower_single_contact_mm(), pair.path.upper_single_contact_mm()].map(|change| {
            let radius = pair.radius_at_mm(Gear::Pinion, change);
            (1..wear.len() - 1)
                .filter(|&i| {
                    (pair.path.involute.pinion.radius_mm(outcome.grid.pinion.coordinate_mm[i]) - radius).abs() < 0.15
                })
                .map(|i| (wear[i + 1] - 2.0 * wear[i] + wear[i - 1]).abs())
                .fold(0.0, f64::max)
        })
    };
    let simplified = sharpest("hertz-mean");
    for integrated in [sharpest("winkler"), sharpest("hertz")] {
        for (simplified, integrated) in simplified.iter().zip(integrated) {
            assert!(*simplified > 5.0 * integrated, "{simplified:e} {integrated:e}");
        }
    }
}

/// S5, Fig 18: the pressure just below the pitch point (point 280) rises with the wear depth there, within
/// 1000–2000 MPa; at least by a quarter at 1.3 µm (ours). Unworn: 1108 MPa matched on the peak, 1305 on the half-width.
#[test]
fn val_s5_pressure_below_the_pitch_point_rises_with_wear() {
    for (criterion, unworn) in [(MatchCriterion::PeakPressure, 1108.0), (MatchCriterion::HalfWidth, 1305.0)] {
        let mut scene = fzg_c_scene();
        (scene.torque_n_mm, scene.criterion) = (STAGE_6_N_MM, criterion);
        (scene.revolutions, scene.steps) = (1.4e7, 700.0);
        scene.snapshots = (1..14).map(|k| 1e6 * f64::from(k)).collect();
        let outcome = scene.run();
        let course: Vec<(f64, f64)> = std::iter::once(&outcome.new)
            .chain(&outcome.snapshots)
            .map(|s| (1e3 * s.wear_mm.pinion[280], s.cycle.pressure_mpa.pinion[280]))
            .collect();
        assert_close("unworn", course[0].1, unworn, 2e-3);
        assert!(course.windows(2).all(|two| two[1].1 > two[0].1), "{course:?}");
        assert!(course.iter().all(|(_, p)| (1000.0..2000.0).contains(p)), "{course:?}");
        // The first snapshot past 1.3 µm is close behind it, and the pressure there rises slowly.
        let worn = course.iter().find(|(depth, _)| *depth >= 1.3).expect("1.3 µm are reached");
        assert!(worn.1 > 1.25 * course[0].1, "{criterion:?}: {worn:?} from {:?}", course[0]);
    }
}

/// S11, section 3.4: a pinion point and the wheel point it meets slide different distances, S1 ≠ S2. Against the closed
/// form 2 a |ζ| with the bed's half-width, away from the changes of load.
#[test]
fn val_s11_pinion_and_wheel_slide_different_distances() {
    let pair = pair(&fzg_c());
    let outcome = fzg_c_scene().run();
    // In the middle of B–C and of D–E, beyond the reach of the changes.
    let [_, _, c, d, e] = pair.path.points_mm();
    for position in [c + 0.6 * (d - c), d + 0.5 * (e - d)] {
        let half_width = outcome.new.cycle.nearest(position).unwrap().footprint.half_width_mm;
        let slid = |gear: Gear| {
            let rho = pair.path.rho_mm(gear, position);
            outcome.grid[gear].value_at(&outcome.new.cycle.sliding_mm[gear], rho)
        };
        for gear in Gear::BOTH {
            let closed_form = 2.0 * half_width * pair.path.specific_sliding(gear, position).abs();
            assert_close(&format!("{gear:?} at {position:.2}"), slid(gear), closed_form, 0.02);
        }
        let ratio = slid(Gear::Wheel) / slid(Gear::Pinion);
        let speeds = pair.path.rho_mm(Gear::Pinion, position)
            / pair.path.involute.pinion.base_radius_mm
            / (pair.path.rho_mm(Gear::Wheel, position) / pair.path.involute.wheel.base_radius_mm);
        assert!((ratio - 1.0).abs() > 0.3, "{ratio}");
        assert_close("S2/S1 is the ratio of the surface velocities", ratio, speeds, 0.02);
    }
}

/// S12, section 5: a spur tooth shaped for least transmission error shows a higher one after wear.
#[test]
fn val_s12_wear_undoes_an_optimal_relief() {
    let peak_to_peak = |snapshot: &Snapshot| {
        let (low, high) = snapshot.cycle.transmission_error_mm();
        1e3 * (high - low)
    };
    let mut scene = fzg_c_scene();
    (scene.positions, scene.flank_points) = (200, 375);
    let relieved = |amount_um: f64, length_mm: f64, scene: &super::common::Scene| {
        let mut scene = scene.clone();
        for gear in Gear::BOTH {
            let relief = Relief { amount_mm: 1e-3 * amount_um, length_mm, shape: ReliefShape::Linear };
            scene.pair.gears[gear].modification.tip_relief = Some(relief);
        }
        scene
    };
    // The best linear tip relief on both gears, by amount and length.
    let (mut best, mut least) = ((0.0, 1.0), f64::INFINITY);
    for amount in (10..=60).step_by(5) {
        for length in 4..=16 {
            let (amount, length) = (f64::from(amount), 0.5 * f64::from(length));
            let mut new = relieved(amount, length, &scene);
            (new.revolutions, new.steps) = (1.0, 1.0);
            let found = peak_to_peak(&new.run().new);
            if found < least {
                (best, least) = ((amount, length), found);
            }
        }
    }
    let plain = peak_to_peak(&scene.run().new);
    assert!(least < 0.5 * plain, "relief {best:?}: {least} µm against {plain} µm without");
    let outcome = relieved(best.0, best.1, &scene).run();
    let worn = peak_to_peak(&outcome.worn);
    assert!(worn > 1.2 * least, "{least} µm new, {worn} µm worn with {best:?}");
}
