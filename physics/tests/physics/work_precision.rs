//! How many mesh cycles a given accuracy of the wear takes, by Euler's method and by adaptive steps.

use gearwear_bodies::gear::Gear;
use gearwear_physics::simulation::settings::Stepping;
use gearwear_physics::simulation::wear_run::Outcome;

use super::common::{Scene, fzg_c_scene};

/// Relative L2 norm of the difference of both flanks' wear.
fn error(run: &Outcome, reference: &Outcome) -> f64 {
    let (mut sum, mut norm) = (0.0, 0.0);
    for gear in Gear::BOTH {
        for (h, exact) in run.worn.wear_mm[gear].iter().zip(&reference.worn.wear_mm[gear]) {
            sum += (h - exact).powi(2);
            norm += exact.powi(2);
        }
    }
    (sum / norm).sqrt()
}

/// fzg-c, 128 h on half-planes, a quarter of the points and positions. The error of Euler's method is of first order, that of the
/// adaptive steps nearly of second, so that what they save grows with the accuracy. Measured here (docs/runs.md has it at higher resolution): 2.8, 1.9, 1.7, 1.7
/// times with tolerances of 0.3, 0.2, 0.15, 0.12 µm (0.06 to 0.08 %) and 4.2, 7.3, 4.5 times with 0.1, 0.05, 0.02 µm (0.02 to 0.03 %).
#[test]
fn ver_adaptive_steps_take_fewer_evaluations() {
    let base = Scene { surface: "half-space", flank_points: 188, positions: 100, ..fzg_c_scene() };
    let run = |stepping| Scene { stepping: Some(stepping), ..base.clone() }.run();
    let euler = |steps: f64| run(Stepping::Fixed { revolutions: base.revolutions / steps });
    // Richardson's extrapolation takes the error of first order away.
    let mut reference = euler(1200.0);
    let twice_as_long = euler(600.0);
    for gear in Gear::BOTH {
        let longer = &twice_as_long.worn.wear_mm[gear];
        reference.worn.wear_mm[gear].iter_mut().zip(longer).for_each(|(h, longer)| *h += *h - longer);
    }
    // Of first order: the evaluations that an error takes follow from one run.
    let (coarse, fine) = (error(&euler(75.0), &reference), error(&euler(150.0), &reference));
    assert!((1.8..2.2).contains(&(coarse / fine)), "{coarse} {fine}");
    let of_euler = |wanted: f64| 150.0 * fine / wanted;
    for (tolerance_um, times) in [(0.2, 1.6), (0.02, 4.0)] {
        let outcome = run(Stepping::Adaptive { tolerance_mm: 1e-3 * tolerance_um });
        let reached = error(&outcome, &reference);
        let saved = of_euler(reached) / outcome.work.mesh_cycles as f64;
        println!(
            "{tolerance_um} µm: {reached:.2e} with {} evaluations, {saved:.1} times fewer",
            outcome.work.mesh_cycles
        );
        assert!(saved > times, "{tolerance_um} µm: {saved}");
    }
}
