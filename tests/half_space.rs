//! The half-space surface: Hertz's contact on plain gear flanks, and what springs do not know on worn ones.

mod common;

use common::{Scene, assert_close, fzg_c_scene, pair, steel};
use gearwear::contact::hertz;
use gearwear::gear::Gear;
use gearwear::simulation::figures::WearFigures;
use gearwear::stiffness::settings::StiffnessSettings;

fn half_space() -> Scene {
    Scene { surface: "half-space", ..fzg_c_scene() }
}

/// Away from the tip edges, pressure, half-width and transmission error of unworn flanks are those of Hertz under the same
/// load.
#[test]
fn val_unworn_flanks_touch_as_hertz_says() {
    let at_first = Scene { revolutions: 1.0, steps: 1.0, ..half_space() };
    let found = at_first.run().new.cycle;
    let hertz_found = Scene { surface: "hertz", ..at_first.clone() }.run().new.cycle;
    let gears = pair(&at_first.pair);
    let mut worst = [0.0_f64; 4];
    for (at, other) in found.positions.iter().zip(&hertz_found.positions) {
        if at.position_mm < gears.path.start_mm + 0.5 || at.position_mm > gears.path.end_mm - 0.5 {
            continue;
        }
        let load = at.load_share * at_first.line_load();
        let strip = hertz::flattening(&gears, &steel(), at.position_mm).contact.loaded(load);
        let ratios = [
            at.footprint.peak_pressure_mpa / strip.peak_pressure_mpa,
            at.footprint.half_width_mm / strip.half_width_mm,
            at.transmission_error_mm / other.transmission_error_mm,
            at.load_share / other.load_share,
        ];
        if ratios.iter().any(|r| (r - 1.0).abs() > 4e-3) {
            println!("{:.3} {ratios:?}", at.position_mm);
        }
        worst.iter_mut().zip(ratios).for_each(|(worst, ratio)| *worst = worst.max((ratio - 1.0).abs()));
    }
    println!("{worst:?}");
    // Half-planes flatten to parts of (a/t)² less than Hertz's, 0.4 %; the involute is no parabola.
    let [peak, half_width, transmission_error, share] = worst;
    assert!(peak < 5e-3 && half_width < 1e-2 && transmission_error < 2e-3 && share < 2e-3, "{worst:?}");
}

/// 128 h: peak wear converges with the resolution, and is within the range of the other surfaces.
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
    let [coarse, standard, fine] = [1, 2, 4].map(at);
    let r = [1, 2, 4, 8].map(|r: usize| {
        let mut s = Scene { flank_points: 375 * r, positions: 200 * r, steps: 75.0 * r as f64, ..half_space() };
        s.pair.gears.pinion.modification.tip_rounding_mm = 0.1;
        s.pair.gears.wheel.modification.tip_rounding_mm = 0.1;
        (peak(&s), {
            s.surface = "winkler";
            peak(&s)
        })
    });
    println!("rounded {r:?}");
    println!("{coarse:.6e} {standard:.6e} {fine:.6e}, winkler {:.6e}", peak(&fzg_c_scene()));
    assert_close("standard against fine", standard, fine, 5e-3);
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
        assert!(outcome.failure.is_none() && worst <= 1e-10, "{name}: {worst:e}, {:?}", outcome.failure);
        let wear = outcome.worn.wear_mm.pinion.iter().chain(&outcome.worn.wear_mm.wheel);
        assert!(wear.clone().all(|h| h.is_finite() && *h >= 0.0), "{name}");
    }
}
