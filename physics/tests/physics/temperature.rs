//! Contact temperatures by every method: the hand calculation at A, and the exact moving band of heat.

use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use gearwear_bodies::reference::moving_heat_band;
use gearwear_physics::thermal::{
    ContactHeat, HeatedStrip, SpeedRatios,
    band::Spread,
    heat_equation::{CELLS, Passage},
    settings::{HeatPartition, HeatSettings, HeatVelocity, TemperatureMethod, ThermalMaterial},
    tian_kennedy, williams,
};

use super::common::{fzg_c, fzg_c_scene, pair};

/// Steel of the targets: 46 W/(m·K), 1.2e-5 m²/s.
const STEEL: ThermalMaterial = ThermalMaterial { conductivity_n_per_s_k: 46.0, diffusivity_mm2_per_s: 12.0 };

fn settings(method: TemperatureMethod, velocity: HeatVelocity, partition: HeatPartition) -> HeatSettings {
    HeatSettings {
        method,
        velocity,
        partition,
        friction_coefficient: None,
        bulk_temperature_k: 363.15,
        is_bulk_of_mesh: false,
        tooth: None,
        material: PerGear { pinion: STEEL, wheel: STEEL },
    }
}

/// By Tian and Kennedy at A, equal shares, one third to the whole load, 302 N·m: 23–59 K at 150 rpm and 37–92 K at 300 rpm, with
/// each body's own surface velocity 21–80 K (computed for the project independently).
#[test]
fn val_tian_and_kennedy_at_a() {
    let (pair, line_load) = (pair(&fzg_c()), fzg_c_scene().line_load());
    let a = pair.path.start_mm;
    let ratios = SpeedRatios::over(&pair, a, a);
    let rises = |velocity, rpm: f64, part: f64| {
        let speed = pair.path.involute.pinion.base_radius_mm * std::f64::consts::TAU * rpm / 60.0;
        let heat = ContactHeat::new(settings(TemperatureMethod::TianKennedy, velocity, HeatPartition::Equal), speed);
        // Hertz's half-width: a² = 4 w R/(π E*), E* = 206000/(2 (1 − 0.3²)).
        let modulus = 206_000.0 / (2.0 * (1.0 - 0.09));
        let load = part * line_load;
        let half_width = (4.0 * load * pair.relative_radius_mm(a) / (std::f64::consts::PI * modulus)).sqrt();
        let (line_load_n_per_mm, half_width_mm) = (load, half_width);
        let band = heat.band(&HeatedStrip { ratios, line_load_n_per_mm, half_width_mm, friction_coefficient: 0.1 });
        Gear::BOTH.map(|gear| band.greatest_rise_k(gear, Spread::Even))
    };
    for (rpm, part, expected) in
        [(150.0, 1.0 / 3.0, 23.0), (150.0, 1.0, 59.0), (300.0, 1.0 / 3.0, 37.0), (300.0, 1.0, 92.0)]
    {
        let [pinion, wheel] = rises(HeatVelocity::Sliding, rpm, part);
        assert_eq!(pinion, wheel);
        assert!((pinion - expected).abs() < 0.6, "{rpm} {part}: {pinion}");
    }
    let surface = [rises(HeatVelocity::Surface, 150.0, 1.0 / 3.0), rises(HeatVelocity::Surface, 150.0, 1.0)].concat();
    println!("with surface velocities at 150 rpm: {surface:.1?}");
    let (low, high) = surface.iter().fold((f64::MAX, 0.0_f64), |(low, high), &rise| (low.min(rise), high.max(rise)));
    assert!((low - 21.0).abs() < 0.6 && (high - 80.0).abs() < 0.6, "{surface:?}");
}

/// Every method against the exact steady state of an evenly heated band (Carslaw and Jaeger; Blok and Jaeger), greatest rise.
/// The errors are stated in docs/theory.md.
#[test]
fn val_every_method_against_the_moving_band() {
    let (a, q) = (0.2, 1e4);
    // Errors in %: one-dimensional heat equation, Williams, Tian and Kennedy.
    let stated = [(0.1, [62.1, 62.2, -51.1]), (1.0, [13.7, 13.8, -19.6]), (10.0, [2.3, 2.4, -2.4])];
    for (peclet, errors) in stated {
        let velocity = 2.0 * STEEL.diffusivity_mm2_per_s * peclet / a;
        let exact = q * a / STEEL.conductivity_n_per_s_k * moving_heat_band::greatest_rise(peclet);
        let passage_s: f64 = 2.0 * a / velocity;
        let scale = q / STEEL.conductivity_n_per_s_k * (STEEL.diffusivity_mm2_per_s * passage_s).sqrt();
        let rises = [
            scale * Passage::default().rises(&[1.0; CELLS])[CELLS - 1],
            williams::rise_k(q, 2.0 * a, velocity, &STEEL),
            tian_kennedy::greatest_rise_k(q, a, velocity, &STEEL),
        ];
        let found = rises.map(|rise| 100.0 * (rise / exact - 1.0));
        println!("Pe {peclet}: exact {:.4} q a/K; errors {found:.2?} %", moving_heat_band::greatest_rise(peclet));
        for (found, stated) in found.iter().zip(errors) {
            assert!((found - stated).abs() < 0.1, "Pe {peclet}: {found} {stated}");
        }
    }
}
