//! Where Euler's steps break, and that adaptive ones do not.

mod common;

use common::{Scene, fzg_c, fzg_c_scene, pair, steel};
use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::position::CondensedPair;
use gearwear::gear::{Gear, PerGear};
use gearwear::mesh::settings::{Body, BodySettings, default_clamp};
use gearwear::simulation::{
    mesh_contact::MeshContact,
    settings::{AdaptiveMethod, Numerics, Stepping},
    wear_run::{Outcome, RunPhase, Unwatched, WearRun},
};
use gearwear::wear::{WearModel, settings::SevereTransition, settings::WearSettings};

const STEPS: u32 = 40;

/// A quarter of the points and positions of the fzg-c scene.
fn coarse(surface: &'static str) -> Scene {
    Scene { surface, flank_points: 188, positions: 100, ..fzg_c_scene() }
}

fn chebyshev(tolerance_um: f64) -> Option<Stepping> {
    Some(Stepping::Adaptive { tolerance_mm: 1e-3 * tolerance_um, method: AdaptiveMethod::RungeKuttaChebyshev })
}

/// How much the wear of one step differs from that of the next, over the wear of a step, in the last five steps: with a wave that
/// swings from step to step it comes to 1 and more, in a steady course to nothing.
fn swing(outcome: &Outcome) -> f64 {
    let last = &outcome.snapshots[outcome.snapshots.len() - 6..];
    let mut greatest: f64 = 0.0;
    for gear in Gear::BOTH {
        let increments: Vec<Vec<f64>> = last
            .windows(2)
            .map(|two| two[1].wear_mm[gear].iter().zip(&two[0].wear_mm[gear]).map(|(b, a)| b - a).collect())
            .collect();
        let step = increments.iter().flatten().copied().fold(0.0, f64::max);
        for two in increments.windows(2) {
            let change = two[1].iter().zip(&two[0]).map(|(b, a)| (b - a).abs()).fold(0.0, f64::max);
            greatest = greatest.max(change / step);
        }
    }
    greatest
}

/// Snapshots after each of the steps.
fn every(step: f64) -> Vec<f64> {
    (1..=STEPS).map(|n| f64::from(n) * step).collect()
}

/// Two thirds of the bound are stable, half as much again is not: on Winkler beds and on half-planes.
#[test]
fn ver_eulers_steps_break_where_the_bound_says() {
    for surface in ["winkler", "half-space"] {
        let scene = coarse(surface);
        let bound = scene.step_bound();
        // The rate of the shortest waves, by the closed form, with the sliding at A, the greatest: k K (s₁ + s₂ z₁/z₂).
        println!("{surface}: {bound:?}");
        assert!(bound.evaluations <= 22);
        let swing_at = |factor: f64| {
            let step = factor * bound.revolutions;
            let stepping = Some(Stepping::Fixed { revolutions: step });
            let revolutions = f64::from(STEPS) * step;
            swing(&Scene { revolutions, snapshots: every(step), stepping, ..scene.clone() }.run())
        };
        let (short, long) = (swing_at(1.0 / 1.5), swing_at(1.5));
        println!("{surface}: {short} {long}");
        assert!(short < 0.25, "{surface}: {short}");
        assert!(long > 0.5, "{surface}: {long}");
    }
}

/// The same on finite elements, whose short waves are those of their nodes.
#[test]
fn ver_eulers_steps_break_where_the_bound_says_on_finite_elements() {
    let pair = pair(&fzg_c());
    let clamp = |gear| default_clamp(pair.teeth[gear].root_radius_mm, pair.spec.normal_module_mm).radius_mm;
    let bodies =
        BodySettings { body: Body::Ring, clamp_radius_mm: PerGear::from_fn(clamp), elements_per_half_width: 4.0 };
    let material =
        steel().map(|own| Elastic { young_modulus_mpa: own.young_modulus_mpa, poisson_ratio: own.poisson_ratio });
    let scene = fzg_c_scene();
    let model = CondensedPair::build(&pair, &material, scene.line_load(), &bodies).expect("the pair can be condensed");
    let law = gearwear::wear::of(&WearSettings::archard(scene.coefficient_mm2_per_n));
    let run = |steps: f64, step: f64, snapshots: &[f64], bound: bool| {
        let phase = RunPhase {
            contact: MeshContact::FiniteElements(&model),
            wear: WearModel::cold(law.as_ref()),
            line_load_n_per_mm: scene.line_load(),
            end_revolutions: steps * step,
        };
        let stepping = Stepping::Fixed { revolutions: step };
        let numerics = Numerics { flank_points: 300, positions: 40, stepping, error_estimate: false };
        let run = WearRun { pair: &pair, phases: &[phase], snapshots_revolutions: snapshots, numerics };
        match bound {
            true => Err(run.step_bound(&phase).expect("the unworn pair has an equilibrium")),
            false => Ok(run.run(&Unwatched).expect("the run converges")),
        }
    };
    let bound = run(1.0, 1.0, &[], true).unwrap_err();
    println!("fem: {bound:?}");
    let swing_at = |factor: f64| {
        let step = factor * bound.revolutions;
        swing(&run(f64::from(STEPS), step, &every(step), false).unwrap())
    };
    let (short, long) = (swing_at(1.0 / 1.5), swing_at(1.5));
    println!("fem: {short} {long}");
    assert!(short < 0.25 && long > 0.5, "{short} {long}");
}

/// What must hold of any run.
fn assert_sound(what: &str, outcome: &Outcome) {
    assert!(outcome.failure.is_none(), "{what}: {:?}", outcome.failure);
    for gear in Gear::BOTH {
        assert!(outcome.worn.wear_mm[gear].iter().all(|h| h.is_finite() && *h >= 0.0), "{what}");
    }
    let worst = outcome.worn.cycle.positions.iter().map(|p| p.load_imbalance.abs()).fold(0.0, f64::max);
    assert!(worst <= 1e-10, "{what}: {worst:e}");
    let steps = outcome.steps;
    // The first evaluation belongs to no step; a rejected step may have ended before its last stage.
    assert!(outcome.work.mesh_cycles <= 1 + steps.stages + steps.probes, "{what}: {steps:?}");
    assert_eq!(steps.at_floor, 0, "{what}: {steps:?}");
}

/// Greatest difference of the wear, µm.
fn difference_um(one: &Outcome, other: &Outcome) -> f64 {
    let of = |gear: Gear| {
        one.worn.wear_mm[gear].iter().zip(&other.worn.wear_mm[gear]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    1e3 * of(Gear::Pinion).max(of(Gear::Wheel))
}

/// Runs of 1/100 to 100 times the bound: the error stays within the tolerance, against Euler's method with steps of a fiftieth of the
/// bound (or of the run, where it is shorter).
#[test]
fn ver_adaptive_steps_never_break() {
    for surface in ["winkler", "half-space"] {
        let scene = coarse(surface);
        let bound = scene.step_bound().revolutions;
        for factor in [0.01, 1.0, 10.0, 100.0] {
            let revolutions = factor * bound;
            let step = (bound / 50.0).min(revolutions / 200.0);
            let fine =
                Scene { revolutions, stepping: Some(Stepping::Fixed { revolutions: step }), ..scene.clone() }.run();
            for tolerance_um in [0.5, 0.05] {
                let what = format!("{surface}, {factor} times the bound, {tolerance_um} µm");
                let outcome = Scene { revolutions, stepping: chebyshev(tolerance_um), ..scene.clone() }.run();
                assert_sound(&what, &outcome);
                let error = difference_um(&outcome, &fine);
                println!("{what}: {error:.4} µm, {:?}", outcome.steps);
                assert!(error <= tolerance_um, "{what}: {error}");
            }
        }
    }
}

/// Severe wear, at once or over a band, of any strength: never more than soundly slow.
#[test]
fn ver_adaptive_steps_bear_any_transition() {
    for band in [0.0, 0.05] {
        for above_mpa in [500.0, 1200.0, 3000.0] {
            for factor in [1.0, 10.0, 100.0, 1000.0] {
                let severe = Some(SevereTransition { above_mpa, factor, band_mpa: band * above_mpa });
                let scene = Scene { severe, revolutions: 1e5, stepping: chebyshev(1.0), ..coarse("winkler") };
                let what = format!("factor {factor} above {above_mpa} MPa, band {band}");
                let outcome = scene.run();
                println!("{what}: {:?}", outcome.steps);
                assert_sound(&what, &outcome);
            }
        }
    }
}
