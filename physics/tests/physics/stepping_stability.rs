//! Where Euler's steps break, and that adaptive ones do not.

use gearwear_bodies::gear::{Gear, GearPair, PerGear, flank::PointSpacing};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_mesh::settings::{BodySettings, default_clamp};
use gearwear_fem::elastic::Elastic;
use gearwear_physics::mesh_cycle::condensed::WearingElements;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::simulation::mesh_contact::MeshContact;
use gearwear_physics::simulation::settings::{Numerics, Stepping};
use gearwear_physics::simulation::wear_run::{Outcome, RunPhase};
use gearwear_physics::wear::stepping::adaptive::StepCounts;
use gearwear_physics::wear::{WearModel, settings::SevereTransition, settings::WearSettings};

use super::common::{Scene, fzg_c, fzg_c_scene, pair, steel, wear_run};

/// Steps of Euler's method: a wave that grows by 1.5 · 2 − 1 a step rises from rounding to its full height in them.
const STEPS: u32 = 20;
/// Waves that die out leave less than this.
const STEADY: f64 = 0.25;
/// Waves that grow until nothing is worn at their bottom, or nearly so, come to more than this.
const SWINGS: f64 = 0.5;

/// The pair of a scene on finite elements.
fn condensed<'a>(pair: &'a GearPair, scene: &Scene, elements_per_half_width: f64) -> CondensedPair<'a> {
    let clamp = |gear| default_clamp(pair.teeth[gear].root_radius_mm, pair.spec.normal_module_mm).radius_mm;
    let bodies = BodySettings::rings(PerGear::from_fn(clamp), elements_per_half_width);
    let material =
        steel().map(|own| Elastic { young_modulus_mpa: own.young_modulus_mpa, poisson_ratio: own.poisson_ratio });
    CondensedPair::build(pair, &material, scene.line_load(), &bodies, &|_| {}).expect("the pair can be condensed")
}

/// A quarter of the points and positions of the fzg-c scene.
fn coarse(surface: &'static str) -> Scene {
    Scene { surface, flank_points: 188, positions: 100, ..fzg_c_scene() }
}

fn chebyshev(tolerance_um: f64) -> Option<Stepping> {
    Some(Stepping::Adaptive { tolerance_mm: 1e-3 * tolerance_um })
}

/// How far the wear of a place in a step swings about its mean, over that mean, in the last five steps, wherever at least a
/// fiftieth of the greatest wear is: a wave that goes to and fro between nothing and twice the mean gives 1, a slow change nothing.
fn swing(outcome: &Outcome) -> f64 {
    let last = &outcome.snapshots[outcome.snapshots.len() - 7..];
    let mut greatest: f64 = 0.0;
    for gear in Gear::BOTH {
        let increments: Vec<Vec<f64>> = last
            .windows(2)
            .map(|two| two[1].wear_mm[gear].iter().zip(&two[0].wear_mm[gear]).map(|(b, a)| b - a).collect())
            .collect();
        let step = increments.iter().flatten().copied().fold(0.0, f64::max);
        for three in increments.windows(3) {
            for ((before, now), after) in three[0].iter().zip(&three[1]).zip(&three[2]) {
                let mean = (before + 2.0 * now + after) / 4.0;
                if mean > 0.02 * step {
                    greatest = greatest.max((before - 2.0 * now + after).abs() / 4.0 / mean);
                }
            }
        }
    }
    greatest
}

/// Snapshots after each of the steps.
fn every(step: f64) -> Vec<f64> {
    (1..=STEPS).map(|n| f64::from(n) * step).collect()
}

/// Two thirds of the bound are stable, half as much again is not: on Winkler foundations and on half-planes.
#[test]
fn ver_eulers_steps_break_where_the_bound_says() {
    for surface in ["winkler", "half-space"] {
        let scene = coarse(surface);
        let bound = scene.step_bound();
        println!("{surface}: {bound:?}");
        assert!(bound.evaluations <= 22);
        let swing_at = |factor: f64| {
            let step = factor * bound.revolutions;
            let stepping = Some(Stepping::Fixed { revolutions: step });
            let revolutions = f64::from(STEPS) * step;
            swing(&Scene { revolutions, snapshots: every(step), stepping, ..scene.clone() }.run())
        };
        let (short, long) = (swing_at(1.0 / 1.5), swing_at(1.5));
        println!("{surface}: {short} {} {} {long} {}", swing_at(1.0), swing_at(1.2), swing_at(2.0));
        assert!(short < STEADY && long > SWINGS, "{surface}: {short} {long}");
    }
}

/// The same on finite elements, whose short waves are those of their nodes.
#[test]
fn ver_eulers_steps_break_where_the_bound_says_on_finite_elements() {
    let (pair, scene) = (pair(&fzg_c()), fzg_c_scene());
    let elements = WearingElements::new(condensed(&pair, &scene, 4.0));
    let law = gearwear_physics::wear::of(&WearSettings::archard(scene.coefficient_mm2_per_n));
    let run = |steps: f64, step: f64, snapshots: &[f64], bound: bool| {
        let phase = RunPhase {
            contact: MeshContact::FiniteElements(&elements),
            wear: WearModel::cold(law.as_ref()),
            line_load_n_per_mm: scene.line_load(),
            end_revolutions: steps * step,
        };
        let stepping = Stepping::Fixed { revolutions: step };
        let numerics = Numerics {
            flank_points: 300,
            point_spacing: PointSpacing::Even,
            positions: 40,
            stepping,
            error_estimate: false,
        };
        let phases = [phase];
        let run = wear_run(&pair, &phases, snapshots, numerics);
        match bound {
            true => Err(run.step_bound(&phase, false, &|| false).expect("the unworn pair has an equilibrium")),
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
    println!("fem: {short} {} {} {long} {}", swing_at(1.0), swing_at(1.2), swing_at(2.0));
    assert!(short < STEADY && long > SWINGS, "{short} {long}");
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
    // Every step that is taken ends with an evaluation of all positions, and these are as many each time.
    let work = outcome.work;
    assert!(work.mesh_cycles > steps.accepted, "{what}: {work:?}, {steps:?}");
    assert_eq!((work.equilibria - work.partial_equilibria) % work.mesh_cycles, 0, "{what}: {work:?}");
}

/// Greatest difference of the wear, µm, and where on which flank it is.
fn difference_um(one: &Outcome, other: &Outcome) -> (f64, Gear, usize) {
    let mut greatest = (0.0, Gear::Pinion, 0);
    for gear in Gear::BOTH {
        for (i, (a, b)) in one.worn.wear_mm[gear].iter().zip(&other.worn.wear_mm[gear]).enumerate() {
            let difference = 1e3 * (a - b).abs();
            if difference > greatest.0 {
                greatest = (difference, gear, i);
            }
        }
    }
    greatest
}

/// Runs of 1/100 to 100 times the bound are sound, with few steps. On the Winkler foundation, and up to ten times the bound (the 128 h of the
/// scene) on half-planes, the error stays within the tolerance, against Euler's method with steps of a fiftieth of the bound. Beyond,
/// points below the wheel's active profile differ by more (docs/runs.md).
#[test]
fn ver_adaptive_steps_never_break() {
    for surface in ["winkler", "half-space"] {
        let scene = coarse(surface);
        let bound = scene.step_bound().revolutions;
        for factor in [0.01, 1.0, 10.0, 100.0] {
            let revolutions = factor * bound;
            let step = (bound / 50.0).min(revolutions / 200.0);
            let compared = surface == "winkler" || factor <= 10.0;
            let fine = compared.then(|| {
                Scene { revolutions, stepping: Some(Stepping::Fixed { revolutions: step }), ..scene.clone() }.run()
            });
            for tolerance_um in [0.5, 0.05] {
                let what = format!("{surface}, {factor} times the bound, {tolerance_um} µm");
                let outcome = Scene { revolutions, stepping: chebyshev(tolerance_um), ..scene.clone() }.run();
                assert_sound(&what, &outcome);
                println!("{what}: {:?}", outcome.steps);
                if let Some(fine) = &fine {
                    let (error, gear, place) = difference_um(&outcome, fine);
                    let deepest = 1e3 * fine.worn.wear_mm.pinion.iter().copied().fold(0.0, f64::max);
                    println!("{error:.4} µm of {deepest:.1} at {gear:?} {place}");
                    assert!(error <= tolerance_um * (deepest / 50.0).max(1.0), "{what}: {error}");
                }
                assert!(outcome.steps.accepted < 3000, "{what}: {:?}", outcome.steps);
            }
        }
    }
}

/// Severe wear, at once or over a band, of any strength: never more than soundly slow.
#[test]
fn ver_adaptive_steps_bear_any_transition() {
    for band in [0.0, 0.05] {
        for above_mpa in [500.0, 1200.0, 3000.0] {
            for factor in [10.0, 1000.0] {
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

/// The 128 h of the scene under load stage 10 with wear a hundred times as fast above 2000 MPa, over bands of 5 and 2 % of that: estimates of the
/// spectral radius take a small part of the evaluations, positions that wear mildly are left out of most of them, and the wear is that of steps with
/// a fifth of the tolerance.
#[test]
fn ver_severe_wear_takes_few_evaluations() {
    for (band, most) in [(0.05, 750), (SevereTransition::LEAST_BAND, 1200)] {
        let severe = Some(SevereTransition { above_mpa: 2000.0, factor: 100.0, band_mpa: band * 2000.0 });
        let scene = Scene { severe, torque_n_mm: 372.6e3, ..coarse("half-space") };
        let [outcome, fine] =
            [0.05, 0.01].map(|tolerance_um| Scene { stepping: chebyshev(tolerance_um), ..scene.clone() }.run());
        let StepCounts { stages, probes, .. } = outcome.steps;
        let (error, gear, place) = difference_um(&outcome, &fine);
        println!("band {band}: {:?}, {:?}: {error:.4} µm at {gear:?} {place}", outcome.steps, fine.steps);
        assert_sound(&format!("band {band}"), &outcome);
        assert!(stages + probes <= most && 5 * probes <= stages, "band {band}: {:?}", outcome.steps);
        assert!(error <= 0.05, "band {band}: {error} µm at {gear:?} {place}");
        // An evaluation of all positions has so many equilibria as each of the mesh cycles, which are counted where no position is left out.
        let all = f64::from(u32::try_from(outcome.worn.cycle.positions.len()).unwrap());
        let (equilibria, evaluations) = (outcome.work.equilibria as f64, (stages + probes) as f64);
        println!("band {band}: {:.2} of all positions", equilibria / (all * evaluations));
        assert!(equilibria < 0.6 * all * evaluations, "band {band}: {equilibria} equilibria");
        // All positions are evaluated at the ends of steps alone.
        assert!(outcome.work.mesh_cycles < 150, "band {band}: {:?}", outcome.work);
    }
}

/// The same on finite elements with the edge broken, where wear is sixty times as fast above the limit: waves that steps leave would shorten the next ones,
/// whatever the tolerance.
#[test]
fn ver_severe_wear_takes_few_evaluations_on_finite_elements() {
    let mut spec = fzg_c();
    Gear::BOTH.into_iter().for_each(|gear| spec.gears[gear].modification.tip_rounding_mm = 0.1);
    let band_mpa = SevereTransition::LEAST_BAND * 2000.0;
    let scene = Scene { pair: spec, torque_n_mm: 405e3, ..fzg_c_scene() };
    let severe = Some(SevereTransition { above_mpa: 2000.0, factor: 60.0, band_mpa });
    let law =
        gearwear_physics::wear::of(&WearSettings { severe, ..WearSettings::archard(scene.coefficient_mm2_per_n) });
    let pair = pair(&scene.pair);
    let elements = WearingElements::new(condensed(&pair, &scene, 3.0));
    let phases = [RunPhase {
        contact: MeshContact::FiniteElements(&elements),
        wear: WearModel::cold(law.as_ref()),
        line_load_n_per_mm: scene.line_load(),
        end_revolutions: scene.revolutions,
    }];
    let [usual, loose] = [0.05, 0.5].map(|tolerance_um| {
        let numerics = Numerics { stepping: chebyshev(tolerance_um).unwrap(), positions: 100, ..scene.numerics() };
        wear_run(&pair, &phases, &[], numerics).run(&Unwatched).expect("the run converges")
    });
    for outcome in [&usual, &loose] {
        println!("{:?}, {:?}", outcome.steps, outcome.work);
        assert_sound("finite elements", outcome);
    }
    let (error, gear, place) = difference_um(&loose, &usual);
    println!("{error:.4} µm at {gear:?} {place}");
    assert!(error <= 0.5, "{error} µm at {gear:?} {place}");
    assert!(usual.steps.accepted < 150, "{:?}", usual.steps);
    assert!(5 * loose.steps.accepted < 3 * usual.steps.accepted, "{:?}, {:?}", usual.steps, loose.steps);
}
