//! Pairs with slices: how the answer changes on doubling slices, positions and wear steps, from the default resolution (20 slices,
//! 400 positions, 60 wear steps). Wear is compared at fixed places of the face width, as maximum wear is read: the outermost slices themselves
//! move outwards.

use gearwear_bodies::gear::Gear;
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};
use gearwear_physics::simulation::figures::WearFigures;
use gearwear_physics::stiffness::settings::StiffnessSettings;

use super::common::{Scene, fzg_c_scene, pair, preset};

const BOTH: [Coupling; 2] = [Coupling::None, Coupling::Slicing];

fn scene(coupling: Coupling, slices: usize, positions: usize, steps: f64) -> Scene {
    Scene {
        pair: preset("thesis-helical"),
        revolutions: 6e5,
        surface: "hertz",
        stiffness: StiffnessSettings::WeberBanaschek,
        positions,
        flank_points: 750,
        steps,
        slices: Some(SliceSettings { count: slices, coupling }),
        ..fzg_c_scene()
    }
}

/// Worn volume of both gears, root wear at a tenth, a quarter, the middle and nine tenths of the face width, transmission error peak to
/// peak of the worn pair, maximum wear of both gears.
fn answers(scene: &Scene) -> [f64; 9] {
    let (pair, outcome) = (pair(&scene.pair), scene.run());
    let figures = Gear::BOTH.map(|gear| WearFigures::at(&pair, gear, &outcome, &outcome.worn));
    let slices = &figures[0].slices;
    let root = |part: f64| {
        let place = (part * slices.len() as f64 - 0.5).clamp(0.0, slices.len() as f64 - 1.001);
        let (before, weight) = (place as usize, place.fract());
        slices[before].root_mm + weight * (slices[before + 1].root_mm - slices[before].root_mm)
    };
    let errors = &outcome.worn.cycle.slices.as_ref().unwrap().transmission_error_mm;
    let greatest = errors.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let [area, peak] = [figures.each_ref().map(|of| of.area_mm2), figures.each_ref().map(|of| of.peak_mm)];
    [area[0], area[1], root(0.1), root(0.25), root(0.5), root(0.9), greatest - least, peak[0], peak[1]]
}

/// Greatest relative change of the answers.
fn change(from: &[f64], to: &[f64]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (b / a - 1.0).abs()).fold(0.0, f64::max)
}

/// Root mean square of the relative changes of wear: less at the mercy of a single sign than the greatest.
fn mean_change(from: &[f64; 9], to: &[f64; 9]) -> f64 {
    (from.iter().zip(to).take(6).map(|(a, b)| (b / a - 1.0).powi(2)).sum::<f64>() / 6.0).sqrt()
}

/// Measured at 20 to 40 slices: at most 0.46 %, in the transmission error; wear is of an order above one in the width of a slice with
/// coupling (1.35: volumes settle at once, root wear of single slices is what changes), and changes by less than 0.1 % without. Maximum wear changes by 0.9 %.
#[test]
fn ver_slices() {
    let few = |coupling, slices| answers(&scene(coupling, slices, 400, 3.0));
    for coupling in BOTH {
        let [ten, twenty, forty] = [10, 20, 40].map(|slices| few(coupling, slices));
        let changes = [change(&ten[..7], &twenty[..7]), change(&twenty[..7], &forty[..7])];
        assert!(changes[1] < 5e-3, "{coupling:?}: {changes:?}");
        let of_peaks = change(&twenty[7..], &forty[7..]);
        assert!(of_peaks < 0.012, "{coupling:?}: {of_peaks}");
        if coupling == Coupling::Slicing {
            let order = (mean_change(&ten, &twenty) / mean_change(&twenty, &forty)).log2();
            assert!(order > 1.2, "order {order}: {ten:?} {twenty:?} {forty:?}");
        }
    }
}

/// Measured at 400 to 800 positions: 0.09 %, of second order (1.8 and 2.2).
#[test]
fn ver_positions() {
    for coupling in BOTH {
        let [a, b, c] = [200, 400, 800].map(|positions| answers(&scene(coupling, 10, positions, 3.0)));
        let changes = [change(&a, &b), change(&b, &c)];
        assert!(changes[1] < 5e-3, "{coupling:?}: {changes:?}");
        let order = (mean_change(&a, &b) / mean_change(&b, &c)).log2();
        assert!(order > 1.5, "order {order}");
    }
}

/// Measured at 60 to 120 wear steps: 0.06 %; Euler's method is of first order.
#[test]
fn ver_wear_steps() {
    for coupling in BOTH {
        let [a, b, c] = [30.0, 60.0, 120.0].map(|steps| answers(&scene(coupling, 5, 100, steps)));
        let changes = [change(&a, &b), change(&b, &c)];
        assert!(changes[1] < 5e-3, "{coupling:?}: {changes:?}");
        let order = (mean_change(&a, &b) / mean_change(&b, &c)).log2();
        assert!((0.9..1.15).contains(&order), "order {order}");
    }
}
