//! Error of the wear against working cycles evaluated, quick look.

#[path = "../tests/common/mod.rs"]
mod common;

use common::{Scene, fzg_c_scene};
use gearwear::gear::Gear;
use gearwear::simulation::settings::{AdaptiveMethod, Stepping};
use gearwear::simulation::wear_run::Outcome;
use gearwear::wear::settings::SevereTransition;

fn l2(a: &Outcome, b: &Outcome) -> (f64, f64, f64) {
    let (mut sum, mut norm, mut max): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for gear in Gear::BOTH {
        for (x, y) in a.worn.wear_mm[gear].iter().zip(&b.worn.wear_mm[gear]) {
            sum += (x - y).powi(2);
            norm += y * y;
            max = max.max((x - y).abs());
        }
    }
    let peak = |o: &Outcome| o.worn.wear_mm.pinion.iter().copied().fold(0.0, f64::max);
    ((sum / norm).sqrt(), (peak(a) / peak(b) - 1.0).abs(), max * 1e3)
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let surface: &'static str = Box::leak(args[1].clone().into_boxed_str());
    let factor: f64 = args[2].parse().unwrap();
    let limit: f64 = args[3].parse().unwrap();
    let band: f64 = args[4].parse().unwrap();
    let by: usize = args[5].parse().unwrap();
    let reference: f64 = args[6].parse().unwrap();
    let euler: Vec<f64> = args[7].split(',').filter(|s| !s.is_empty()).map(|s| s.parse().unwrap()).collect();
    let tols: Vec<f64> = args[8].split(',').filter(|s| !s.is_empty()).map(|s| s.parse().unwrap()).collect();
    let methods: Vec<&str> = args[9].split(',').collect();
    let severe = (factor > 1.0).then_some(SevereTransition { above_mpa: limit, factor, band_mpa: band });
    let base = Scene { surface, severe, flank_points: 750 / by, positions: 400 / by, ..fzg_c_scene() };
    let run = |stepping: Stepping| {
        let start = std::time::Instant::now();
        let o = Scene { stepping: Some(stepping), ..base.clone() }.run();
        (o, start.elapsed().as_secs_f64())
    };
    let adaptive = |tol: f64, method| Stepping::Adaptive { tolerance_mm: 1e-3 * tol, method };
    let (fine, s) = if reference > 1.0 {
        run(Stepping::Fixed { revolutions: base.revolutions / reference })
    } else {
        run(adaptive(reference, AdaptiveMethod::RungeKuttaChebyshev))
    };
    let peak = |o: &Outcome| o.worn.wear_mm.pinion.iter().copied().fold(0.0, f64::max) * 1e3;
    println!(
        "reference: {:?} {} {s:.1}s peak {:.4} um, peak p {:.0}",
        fine.steps,
        fine.work.mesh_cycles,
        peak(&fine),
        fine.worn.cycle.peak_pressure_mpa()
    );
    for n in euler {
        let (o, s) = run(Stepping::Fixed { revolutions: base.revolutions / n });
        let (l, p, m) = l2(&o, &fine);
        println!("euler {n:7} evals {:6} L2 {l:.2e} peak {p:.2e} max {m:.4} um {s:.2}s", o.work.mesh_cycles);
    }
    for (name, method) in [("rkc", AdaptiveMethod::RungeKuttaChebyshev), ("ros", AdaptiveMethod::LinearlyImplicit)] {
        if !methods.contains(&name) {
            continue;
        }
        for &tol in &tols {
            let (o, s) = run(adaptive(tol, method));
            let (l, p, m) = l2(&o, &fine);
            let c = o.steps;
            let e = o
                .step_error_mm
                .as_ref()
                .map_or(0.0, |e| Gear::BOTH.iter().flat_map(|&g| &e[g]).fold(0.0f64, |m, x| m.max(x.abs())) * 1e3);
            println!(
                "{name} tol {tol:7} evals {:6} L2 {l:.2e} peak {p:.2e} max {m:.4} um est {e:.4} acc {} rej {} floor {} stages {} probes {} {s:.2}s",
                o.work.mesh_cycles, c.accepted, c.rejected, c.at_floor, c.stages, c.probes
            );
        }
    }
}
