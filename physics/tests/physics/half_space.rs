//! The half-space surface: Hertz's contact on plain gear flanks, and what springs do not know on worn ones.

use gearwear_bodies::gear::Gear;
use gearwear_physics::contact::hertz;
use gearwear_physics::simulation::figures::WearFigures;
use gearwear_physics::simulation::wear_run::SimulationError;
use gearwear_physics::stiffness::settings::StiffnessSettings;

use super::common::{Scene, assert_close, fzg_c_scene, pair, steel};

fn half_space() -> Scene {
    Scene { surface: "half-space", ..fzg_c_scene() }
}

/// Away from the tip edges, pressure and half-width of unworn flanks are those of Hertz under the same load; while one pair
/// carries it, so is the transmission error.
#[test]
fn val_unworn_flanks_touch_as_hertz_says() {
    let at_first = Scene { revolutions: 1.0, steps: 1.0, ..half_space() };
    let found = at_first.run().new.cycle;
    let of_hertz = Scene { surface: "hertz", ..at_first.clone() }.run().new.cycle;
    let gears = pair(&at_first.pair);
    let path = &gears.path;
    for (at, other) in found.positions.iter().zip(&of_hertz.positions) {
        if at.position_mm < path.start_mm + 1.0 || at.position_mm > path.end_mm - 0.5 {
            continue;
        }
        let load = at.load_share * at_first.line_load();
        let strip = hertz::flattening(&gears, &steel(), at.position_mm).contact.loaded(load);
        let what = |quantity| format!("{quantity} at {:.3}", at.position_mm);
        // At a depth t of the teeth half-planes flatten by parts of (a/t)² less than Hertz's ellipse says: 0.4 %.
        assert_close(&what("peak"), at.footprint.peak_pressure_mpa, strip.peak_pressure_mpa, 5e-3);
        assert_close(&what("half-width"), at.footprint.half_width_mm, strip.half_width_mm, 1e-2);
        if at.load_share > 0.999 {
            assert_close(&what("error"), at.transmission_error_mm, other.transmission_error_mm, 1e-3);
        }
    }
}

/// 128 h: peak wear converges with the resolution: twice it would change the answer by less than 0.5 %. Of first order at the least, half
/// as much again takes a third of the error away, where twice takes a half.
#[test]
fn ver_peak_wear_converges() {
    let peak = |scene: &Scene| {
        let outcome = scene.run();
        assert!(outcome.failure.is_none());
        WearFigures::at(&pair(&scene.pair), Gear::Pinion, &outcome, &outcome.worn).peak_mm
    };
    let at = |refinement: usize| {
        peak(&Scene {
            flank_points: 375 * refinement,
            positions: 200 * refinement,
            steps: 75.0 * refinement as f64,
            ..half_space()
        })
    };
    let [standard, fine] = [2, 3].map(at);
    println!("{standard:.6e} {fine:.6e}");
    assert_close("standard against fine", standard, fine, 5e-3 * 2.0 / 3.0);
}

/// Loads balance to 1e-10 in any case, and nothing blows up where flanks conform, part, or are worn away.
#[test]
fn ver_loads_balance_in_stiff_and_extreme_cases() {
    let scenes = [
        ("plain", half_space()),
        ("weber-banaschek", Scene { stiffness: StiffnessSettings::WeberBanaschek, ..half_space() }),
        ("1e-6 N·m", Scene { torque_n_mm: 1e-3, ..half_space() }),
        ("1e5 N·m", Scene { torque_n_mm: 1e8, ..half_space() }),
        ("soft teeth", Scene { stiffness: StiffnessSettings::Constant { pair_n_per_mm2: 20e-3 }, ..half_space() }),
        ("stiff teeth", Scene { stiffness: StiffnessSettings::Constant { pair_n_per_mm2: 20e9 }, ..half_space() }),
        ("material gone in one step", Scene { coefficient_mm2_per_n: 1e-2, ..half_space() }),
        ("a hundred times the wear", Scene { revolutions: 100.0 * 1_149_750.0, ..half_space() }),
    ];
    for (name, mut scene) in scenes {
        (scene.steps, scene.positions) = (20.0, 100);
        let start = std::time::Instant::now();
        let outcome = scene.run();
        let cycles = outcome.snapshots.iter().map(|s| &s.cycle).chain([&outcome.new.cycle]);
        let worst = cycles.flat_map(|c| &c.positions).map(|p| p.load_imbalance.abs()).fold(0.0, f64::max);
        println!("{name}: imbalance {worst:.1e}, {:?}", start.elapsed());
        let sound = matches!(outcome.failure, None | Some(SimulationError::WornThrough { .. }));
        assert!(sound && worst <= 1e-10, "{name}: {worst:e}, {:?}", outcome.failure);
        let wear = outcome.worn.wear_mm.pinion.iter().chain(&outcome.worn.wear_mm.wheel);
        assert!(wear.clone().all(|h| h.is_finite() && *h >= 0.0), "{name}");
        let at_once =
            matches!(outcome.failure, Some(SimulationError::WornThrough { revolutions, .. }) if revolutions == 0.0);
        assert_eq!(name == "material gone in one step", at_once, "{name}");
    }
}
