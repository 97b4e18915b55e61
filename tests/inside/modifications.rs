//! Runs of pairs with profile slopes and tip chamfers: what an exact statement, or another contact surface, says of them; and the mass of gears.

use gearwear::{LoadedScene, RunRecord, Unwatched};
use gearwear_bodies::gear::{Gear, outline::polyline};

use super::common::{assert_close, fzg_c, pair};

fn run(preset: &str, changes: &[(&str, toml::Value)]) -> RunRecord {
    let given = [("numerics.error_estimate", false.into()), ("numerics.verify", false.into())];
    let scene = LoadedScene::preset(preset).unwrap();
    let scene = given.iter().chain(changes).fold(scene, |scene, (key, value)| scene.with(key, value.clone()).unwrap());
    gearwear::run(&scene, &Unwatched).unwrap().complete().unwrap()
}

/// Where the active profiles of both gears are one path from A to E, the same slope f on both takes f (½ − v) of one flank and f (½ + v) of the other at
/// each place: f everywhere, which turns the wheel and is not worn off. The contact moves along the flanks by at most R f/L (r_b1/ρ_1 − r_b2/ρ_2), 3 µm at A
/// with f = 2 µm, R = 4 mm, L = 17 mm: some thousandths of the wear there, and some nanometres of the transmission error of 17 µm. Slopes that are not
/// alike change that by tenths of f.
#[test]
fn ver_slopes_alike_do_nothing() {
    let with_slopes = |pinion_um: f64, wheel_um: f64| {
        let slopes = [
            ("pair.pinion.profile_slope_deviation_um", pinion_um.into()),
            ("pair.wheel.profile_slope_deviation_um", wheel_um.into()),
        ];
        let summary = run("thesis-spur", &slopes).summary;
        [summary.pinion.peak_wear_um, summary.wheel.peak_wear_um, summary.new.transmission_error_um.peak_to_peak]
    };
    let plain = with_slopes(0.0, 0.0);
    for slope_um in [2.0, -2.0] {
        let (alike, unlike) = (with_slopes(slope_um, slope_um), with_slopes(slope_um, 0.0));
        for (index, within) in [5e-3, 5e-3, 1e-3].into_iter().enumerate() {
            assert_close(&format!("{slope_um}, {index}"), alike[index], plain[index], within);
        }
        let change_um = (unlike[2] - plain[2]).abs();
        assert!(change_um > 0.1 * 2.0 && change_um < 2.0, "{unlike:?}, {plain:?}");
    }
}

/// Finite elements of chamfered teeth and half-planes, which see the chamfer as material that is gone, wear alike: within 1 % of the maximum wear,
/// as without chamfers (docs/accuracy.md: half-planes 0.9 % off on 95 % of the spur pairs).
#[test]
fn ver_chamfered_teeth_wear_alike_on_both_surfaces() {
    let [fem, half_space] = ["fem", "half-space"].map(|surface| {
        let chamfers = [
            ("contact.surface", surface.into()),
            ("pair.pinion.tip_chamfer_mm", 0.5.into()),
            ("pair.wheel.tip_chamfer_mm", 0.5.into()),
        ];
        run("fzg-c", &chamfers).summary
    });
    assert_close("pinion", half_space.pinion.peak_wear_um, fem.pinion.peak_wear_um, 0.01);
    assert_close("wheel", half_space.wheel.peak_wear_um, fem.wheel.peak_wear_um, 0.01);
    let [new_fem, new] = [&fem, &half_space].map(|of| of.new.transmission_error_um.peak_to_peak);
    assert_close("transmission error", new, new_fem, 0.01);
}

/// Area within the outline (shoelace formula), 14 mm wide, of steel of 7830 kg/m³.
#[test]
fn ver_mass_is_that_of_the_section() {
    let summary = run("thesis-spur", &[]).summary;
    let pair = pair(&fzg_c());
    for (gear, found) in [(Gear::Pinion, summary.pinion.mass_kg), (Gear::Wheel, summary.wheel.mass_kg)] {
        let points = polyline(&pair.teeth[gear], 200);
        let sides = points.iter().zip(points.iter().cycle().skip(1));
        let area_mm2 = 0.5 * sides.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs();
        assert_close(gear.name(), found, area_mm2 * 14.0 * 7830e-9, 1e-4);
    }
}
