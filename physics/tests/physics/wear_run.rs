//! The wear run as a numerical method: convergence, equilibrium, scaling, determinism, work.

use std::sync::LazyLock;

use gearwear_bodies::gear::{
    Gear,
    involute::{inv, inverse_inv},
    modification::{Relief, ReliefShape},
};
use gearwear_physics::simulation::figures::WearFigures;
use gearwear_physics::simulation::wear_run::{Outcome, SimulationError};
use gearwear_physics::stiffness::settings::StiffnessSettings;

use super::common::{Scene, assert_close, fzg_a, fzg_c_scene, gear, pair, spur};

fn peak_wear_mm(scene: &Scene) -> f64 {
    peak_mm(&scene.run())
}

/// Of a run of the fzg-c pair.
fn peak_mm(outcome: &Outcome) -> f64 {
    WearFigures::at(&pair(&fzg_c_scene().pair), Gear::Pinion, outcome, &outcome.worn).peak_mm
}

/// The fzg-c scene, with twice its positions, and with twice its steps.
static STANDARD: LazyLock<Outcome> = LazyLock::new(|| fzg_c_scene().run());
static MORE_POSITIONS: LazyLock<Outcome> = LazyLock::new(|| Scene { positions: 800, ..fzg_c_scene() }.run());
static MORE_STEPS: LazyLock<Outcome> = LazyLock::new(|| Scene { steps: 300.0, ..fzg_c_scene() }.run());

fn worst_imbalance(outcome: &Outcome) -> f64 {
    let cycles = outcome.snapshots.iter().map(|s| &s.cycle).chain([&outcome.new.cycle, &outcome.worn.cycle]);
    cycles.flat_map(|cycle| &cycle.positions).map(|p| p.load_imbalance.abs()).fold(0.0, f64::max)
}

/// Relative change below which the places of points decide which way it goes.
const NOTHING: f64 = 2e-4;

/// Halving the spacing of points and positions and the wear step changes the peak wear of the fzg-c scene by less than
/// 0.5 %, and by less and less, in first order or better, until it is nothing; the observed order is printed. The peak of hertz-mean is the value at its jump at A, averaged over the stretch
/// of the first point: that is of first order in the spacing of points, and changes by up to 1 %.
#[test]
fn ver_peak_wear_converges() {
    for (surface, allowed) in [("winkler", 5e-3), ("hertz", 5e-3), ("hertz-mean", 1e-2)] {
        let at = |refinement: usize| {
            let mut scene = fzg_c_scene();
            scene.surface = surface;
            scene.flank_points = 375 * refinement;
            scene.positions = 200 * refinement;
            scene.steps = 75.0 * refinement as f64;
            peak_wear_mm(&scene)
        };
        let [coarse, standard, fine] = [1, 2, 4].map(at);
        let order = ((coarse - standard) / (standard - fine)).abs().log2();
        let change = (fine / standard - 1.0).abs();
        println!("{surface}: {coarse:.6e} {standard:.6e} {fine:.6e} mm, change {change:.2e}, order {order:.2}");
        assert!(change < allowed && (order > 0.9 || change < NOTHING), "{surface}: {change}, order {order}");
    }
}

/// Each of the three refinements alone.
#[test]
fn ver_each_refinement_alone_changes_little() {
    let reference = peak_mm(&STANDARD);
    let refined = [
        ("points", peak_wear_mm(&Scene { flank_points: 1500, ..fzg_c_scene() })),
        ("positions", peak_mm(&MORE_POSITIONS)),
        ("steps", peak_mm(&MORE_STEPS)),
    ];
    for (name, peak) in refined {
        let change = (peak / reference - 1.0).abs();
        println!("{name}: {change:.2e}");
        assert!(change < 5e-3, "{name}: {change}");
    }
}

/// A pair of 32 and 48 long teeth: contact ratio above 2, so two and three pairs share the load.
fn high_contact_ratio() -> gearwear_bodies::gear::spec::PairSpec {
    let alpha = 20f64.to_radians();
    let working = inverse_inv(inv(alpha) + 2.0 * alpha.tan() * 0.0 / 80.0);
    let mut spec = spur(
        2.5,
        0.5 * 2.5 * 80.0 * alpha.cos() / working.cos() + 0.02,
        20.0,
        gear(32, 0.0, None),
        gear(48, 0.0, None),
    );
    spec.rack.addendum_factor = 1.35;
    spec.rack.dedendum_factor = 1.6;
    spec.rack.fillet_radius_factor = 0.2;
    spec
}

/// Loads add up to the torque over the base radius at every position to 1e-10, new and worn, whatever the pair.
#[test]
fn ver_loads_balance_the_torque_everywhere() {
    let relief = Relief { amount_mm: 0.08, length_mm: 4.0, shape: ReliefShape::Linear };
    let mut parted = fzg_c_scene();
    // Relief deeper than the deflection: pairs part near A and E.
    parted.pair.gears.pinion.modification.tip_relief = Some(relief);
    parted.pair.gears.wheel.modification.tip_relief = Some(relief);
    let scenes = [
        ("fzg-c", fzg_c_scene(), 2),
        ("fzg-a", Scene { pair: fzg_a(), ..fzg_c_scene() }, 2),
        ("high contact ratio", Scene { pair: high_contact_ratio(), ..fzg_c_scene() }, 3),
        ("parted", parted, 2),
        ("hertz", Scene { surface: "hertz", ..fzg_c_scene() }, 2),
        ("weber-banaschek", Scene { stiffness: StiffnessSettings::WeberBanaschek, ..fzg_c_scene() }, 2),
        ("iso6336", Scene { stiffness: StiffnessSettings::Iso6336, ..fzg_c_scene() }, 2),
    ];
    for (name, mut scene, most_pairs) in scenes {
        scene.steps = 30.0;
        let ratio = pair(&scene.pair).path.contact_ratio();
        assert_eq!(ratio.ceil() as usize, most_pairs, "{name}: {ratio}");
        let outcome = scene.run();
        let worst = worst_imbalance(&outcome);
        assert!(worst < 1e-10, "{name}: {worst:e}");
        assert!(outcome.worn.wear_mm.pinion.iter().all(|h| h.is_finite() && *h >= 0.0), "{name}");
        let least_share = outcome.new.cycle.positions.iter().map(|p| p.load_share).fold(1.0, f64::min);
        assert_eq!(least_share == 0.0, name == "parted", "{name}: {least_share}");
    }
}

/// Type A: the pitch point lies before B, so least wear is inside double contact.
#[test]
fn type_a_wears_least_at_its_pitch_point() {
    let scene = Scene { pair: fzg_a(), ..fzg_c_scene() };
    let pair = pair(&scene.pair);
    assert!(pair.path.pitch_point_mm < pair.path.lower_single_contact_mm());
    let outcome = scene.run();
    let wear = &outcome.worn.wear_mm.pinion;
    let active: Vec<usize> = (0..wear.len())
        .filter(|&i| (pair.path.start_mm + 0.5..pair.path.end_mm - 0.5).contains(&outcome.grid.pinion.coordinate_mm[i]))
        .collect();
    let least = active.iter().copied().min_by(|&a, &b| wear[a].total_cmp(&wear[b])).unwrap();
    let place = outcome.grid.pinion.coordinate_mm[least];
    assert!((place - pair.path.pitch_point_mm).abs() < 0.1, "{place} against {}", pair.path.pitch_point_mm);
}

/// The whole problem scaled up, lengths × 20 and forces × 400, has the same stresses and the same wear over size.
#[test]
fn ver_results_do_not_depend_on_the_scale() {
    for stiffness in [StiffnessSettings::Constant { pair_n_per_mm2: 20e3 }, StiffnessSettings::WeberBanaschek] {
        let mut small = Scene { stiffness, steps: 50.0, ..fzg_c_scene() };
        small.pair.gears.pinion.modification.tip_rounding_mm = 0.1;
        let mut large = small.clone();
        large.torque_n_mm *= 400.0 * 20.0;
        large.pair.normal_module_mm *= 20.0;
        large.pair.centre_distance_mm *= 20.0;
        large.pair.face_width_mm *= 20.0;
        for gear in Gear::BOTH {
            large.pair.gears[gear].tip_diameter_mm = large.pair.gears[gear].tip_diameter_mm.map(|d| 20.0 * d);
            large.pair.gears[gear].modification.tip_rounding_mm *= 20.0;
        }
        let (small, large) = (small.run(), large.run());
        for gear in Gear::BOTH {
            for (s, l) in small.worn.wear_mm[gear].iter().zip(&large.worn.wear_mm[gear]) {
                assert!((20.0 * s - l).abs() <= 1e-9 * l.abs() + 1e-15, "{s:e} {l:e}");
            }
        }
        for (s, l) in small.worn.cycle.positions.iter().zip(&large.worn.cycle.positions) {
            assert_close("pressure", l.footprint.peak_pressure_mpa, s.footprint.peak_pressure_mpa, 1e-9);
            assert_close("transmission error", l.transmission_error_mm, 20.0 * s.transmission_error_mm, 1e-9);
        }
    }
}

/// One thread and two give the same bits.
#[test]
fn ver_threads_do_not_change_a_bit() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Scene { steps: 20.0, ..fzg_c_scene() }.run())
    };
    let one = with(1);
    assert!(one == with(2) && one == with(3));
}

/// Snapshots are hit exactly, and taking them changes the course of wear only through the shortened steps.
#[test]
fn snapshots_are_hit_exactly() {
    let mut scene = fzg_c_scene();
    scene.revolutions = 1000.0;
    scene.steps = 10.0;
    scene.snapshots = vec![250.0, 300.0, 1000.0 / 3.0];
    let outcome = scene.run();
    let reached: Vec<f64> = outcome.snapshots.iter().map(|s| s.revolutions).collect();
    assert_eq!(reached, [250.0, 300.0, 1000.0 / 3.0, 1000.0]);
    // 100, 200, 250; 300; 333.3; seven more: 433.3 … 933.3, 1000.
    assert_eq!(outcome.steps.accepted, 3 + 1 + 1 + 7);
}

/// Work is linear in positions × wear steps, and an equilibrium takes about three Newton steps.
#[test]
fn ver_work_is_linear_in_positions_and_steps() {
    let base = STANDARD.work;
    assert_eq!(base.mesh_cycles, 151);
    assert_eq!(base.equilibria, 151 * 400);
    assert!(base.newton_iterations < 3 * base.equilibria, "{base:?}");
    assert!(base.pair_evaluations < 5 * base.equilibria, "{base:?}");
    let more_of_both = Scene { positions: 800, steps: 300.0, ..fzg_c_scene() }.run().work;
    for (positions, steps, more) in
        [(800, 150.0, MORE_POSITIONS.work), (400, 300.0, MORE_STEPS.work), (800, 300.0, more_of_both)]
    {
        let times = more.pair_evaluations as f64 / base.pair_evaluations as f64;
        let expected = positions as f64 / 400.0 * steps / 150.0;
        // Shorter steps also bring the starts of Newton's method closer, so that somewhat fewer evaluations do.
        assert!((0.75 * expected..1.05 * expected).contains(&times), "{positions} {steps}: {times} against {expected}");
        let cycles = (steps as u64 + 1) * positions as u64;
        assert_eq!(more.equilibria, cycles);
    }
}

/// Balanced at any load, stiffness and wear, where pairs hardly touch, touch everywhere or have worn away.
#[test]
fn ver_loads_balance_in_stiff_and_extreme_cases() {
    let relief = Some(Relief { amount_mm: 0.2, length_mm: 4.0, shape: ReliefShape::Linear });
    let mut relieved = fzg_c_scene();
    relieved.pair.gears.pinion.modification.tip_relief = relief;
    relieved.pair.gears.wheel.modification.tip_relief = relief;
    let scenes = [
        ("1e-6 N·m", Scene { torque_n_mm: 1e-3, ..fzg_c_scene() }),
        ("1e-3 N·m on deep relief", Scene { torque_n_mm: 1.0, ..relieved }),
        ("1e7 N·m", Scene { torque_n_mm: 1e10, ..fzg_c_scene() }),
        ("soft teeth", Scene { stiffness: StiffnessSettings::Constant { pair_n_per_mm2: 20e-3 }, ..fzg_c_scene() }),
        ("stiff teeth", Scene { stiffness: StiffnessSettings::Constant { pair_n_per_mm2: 20e9 }, ..fzg_c_scene() }),
        ("material gone in one step", Scene { coefficient_mm2_per_n: 1e-2, ..fzg_c_scene() }),
        ("1e12 revolutions", Scene { revolutions: 1e12, ..fzg_c_scene() }),
    ];
    for (name, mut scene) in scenes {
        scene.steps = 20.0;
        let outcome = scene.run();
        let worst = worst_imbalance(&outcome);
        let sound = matches!(outcome.failure, None | Some(SimulationError::WornThrough { .. }));
        assert!(sound && worst <= 1e-10, "{name}: {worst:e}, {:?}", outcome.failure);
        let wear = outcome.worn.wear_mm.pinion.iter().chain(&outcome.worn.wear_mm.wheel);
        assert!(wear.clone().all(|h| h.is_finite() && *h >= 0.0), "{name}");
        let at_once =
            matches!(outcome.failure, Some(SimulationError::WornThrough { revolutions, .. }) if revolutions == 0.0);
        assert_eq!(name == "material gone in one step", at_once, "{name}");
    }
}

/// Light loads make the contact narrower than the distance of positions; the volume stays proportional to the load.
#[test]
fn val_worn_volume_is_proportional_to_a_light_load() {
    let volume = |torque_n_mm: f64| {
        let outcome = Scene { torque_n_mm, revolutions: 1.0, steps: 1.0, ..fzg_c_scene() }.run();
        Gear::BOTH.map(|gear| outcome.grid[gear].integral(&outcome.new.depth_per_mesh_mm[gear]) / torque_n_mm)
    };
    let reference = volume(302e3);
    for torque in [3.3e3, 300.0] {
        for (light, full) in volume(torque).iter().zip(reference) {
            assert_close(&format!("{torque} N·mm"), *light, full, 5e-3);
        }
    }
}
