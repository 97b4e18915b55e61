//! Error of the wear against mesh cycles evaluated: Euler's method and both adaptive ones on the fzg-c scene after 128 h, half of
//! the points and positions, without severe wear, with a factor of 100 above 2000 MPa over a band of 100 MPa, and with the hard switch.
//! Prints the tables of docs/stepping.md;

use super::super::common::{Scene, fzg_c_scene};
use gearwear::gear::Gear;
use gearwear::simulation::settings::{AdaptiveMethod, Stepping};
use gearwear::simulation::wear_run::Outcome;
use gearwear::wear::settings::SevereTransition;

/// Relative L2 norm of the difference of both flanks' wear, and relative difference of the pinion's peak.
fn errors(run: &Outcome, reference: &Outcome) -> [f64; 2] {
    let (mut sum, mut norm) = (0.0, 0.0);
    for gear in Gear::BOTH {
        for (h, exact) in run.worn.wear_mm[gear].iter().zip(&reference.worn.wear_mm[gear]) {
            sum += (h - exact).powi(2);
            norm += exact.powi(2);
        }
    }
    let peak = |outcome: &Outcome| outcome.worn.wear_mm.pinion.iter().copied().fold(0.0, f64::max);
    [(sum / norm).sqrt(), (peak(run) / peak(reference) - 1.0).abs()]
}

#[test]
#[ignore = "prints the tables of docs/stepping.md"]
fn work_precision_tables() {
    let severe = |band_mpa| Some(SevereTransition { above_mpa: 2000.0, factor: 100.0, band_mpa });
    let transitions =
        [("no severe wear", None, 4800.0), ("band", severe(100.0), 19200.0), ("hard switch", severe(0.0), 19200.0)];
    let chebyshev = AdaptiveMethod::RungeKuttaChebyshev;
    let methods = [("Runge–Kutta–Chebyshev", chebyshev), ("linearly implicit", AdaptiveMethod::LinearlyImplicit)];
    for surface in ["winkler", "half-space"] {
        for (name, severe, reference_steps) in transitions {
            let base = Scene { surface, severe, flank_points: 375, positions: 200, ..fzg_c_scene() };
            let run = |stepping| Scene { stepping: Some(stepping), ..base.clone() }.run();
            let euler = |steps: f64| run(Stepping::Fixed { revolutions: base.revolutions / steps });
            let reference = euler(reference_steps);
            println!("\n{surface}, {name}; reference: Euler, {reference_steps} steps\n");
            println!("| method | steps or µm | evaluations | rejected | L2 | peak |\n|---|---|---|---|---|---|");
            let row = |method: &str, setting: f64, outcome: &Outcome| {
                let [l2, peak] = errors(outcome, &reference);
                let (evaluations, rejected) = (outcome.work.mesh_cycles, outcome.steps.rejected);
                println!("| {method} | {setting} | {evaluations} | {rejected} | {l2:.1e} | {peak:.1e} |");
            };
            for steps in [20.0, 40.0, 75.0, 150.0, 300.0, 600.0, 1200.0, 2400.0] {
                row("Euler", steps, &euler(steps));
            }
            for (method, choice) in methods {
                // The hard switch takes tens of thousands of evaluations with a smaller one.
                let tolerances: &[f64] = if name == "hard switch" { &[1.0, 0.2] } else { &[1.0, 0.2, 0.05, 0.01] };
                for &tolerance_um in tolerances {
                    let stepping = Stepping::Adaptive { tolerance_mm: 1e-3 * tolerance_um, method: choice };
                    row(method, tolerance_um, &run(stepping));
                }
            }
        }
    }
}
