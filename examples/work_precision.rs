//! Error of the wear against mesh cycles evaluated: Euler's method and adaptive steps on the scene `thesis-spur`, half of the points
//! and positions, without severe wear, with a factor of 100 above 2000 MPa over a band of 100 MPa, and with the hard switch.
//! Prints the tables that docs/runs.md summarises; `work_precision winkler` does so for one surface alone.

use gearwear::{LoadError, LoadedScene, RunRecord, Unwatched};

/// 127.75 h at 150 rpm.
const REVOLUTIONS: f64 = 127.75 * 60.0 * 150.0;

/// Relative L2 norm of the difference of both flanks' wear, and relative difference of the pinion's peak.
fn errors(run: &RunRecord, reference: &RunRecord) -> [f64; 2] {
    let (mut sum, mut norm) = (0.0, 0.0);
    for (own, exact) in [(&run.flanks.pinion, &reference.flanks.pinion), (&run.flanks.wheel, &reference.flanks.wheel)] {
        for (h, exact) in own.wear_um.iter().zip(&exact.wear_um) {
            sum += (h - exact).powi(2);
            norm += exact.powi(2);
        }
    }
    let peak = |run: &RunRecord| run.flanks.pinion.wear_um.iter().copied().fold(0.0, f64::max);
    [(sum / norm).sqrt(), (peak(run) / peak(reference) - 1.0).abs()]
}

fn table(text: &str) -> toml::Table {
    text.parse().expect("a table of the scene")
}

fn scene(surface: &str, band_mpa: Option<f64>) -> Result<LoadedScene, LoadError> {
    let scene = LoadedScene::preset("thesis-spur")?
        .without("operation.snapshots_h")?
        .with("contact.surface", surface)?
        .with("numerics.flank_points", 375)?
        .with("numerics.positions", 200)?
        .with("numerics.error_estimate", false)?
        .with("numerics.verify", false)?;
    match band_mpa {
        None => Ok(scene),
        Some(band) => {
            scene.with("wear.severe", table(&format!("above_MPa = 2000.0\nfactor = 100.0\nband_MPa = {band:?}")))
        }
    }
}

fn euler(scene: &LoadedScene, steps: f64) -> Result<RunRecord, Box<dyn std::error::Error>> {
    let step = table(&format!("revolutions = {:?}", REVOLUTIONS / steps));
    Ok(gearwear::run(&scene.with("numerics.step", step)?, &Unwatched)?.complete()?)
}

fn adaptive(scene: &LoadedScene, tolerance_um: f64) -> Result<RunRecord, Box<dyn std::error::Error>> {
    let scene = scene.with("numerics.step", "adaptive")?.with("numerics.tolerance_um", tolerance_um)?;
    Ok(gearwear::run(&scene, &Unwatched)?.complete()?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let only = std::env::args().nth(1);
    for surface in ["winkler", "half-space"] {
        if only.as_ref().is_some_and(|only| only != surface) {
            continue;
        }
        for (name, band_mpa, reference_steps) in
            [("no severe wear", None, 4800.0), ("band", Some(100.0), 19200.0), ("hard switch", Some(0.0), 19200.0)]
        {
            let scene = scene(surface, band_mpa)?;
            let reference = euler(&scene, reference_steps)?;
            println!("\n{surface}, {name}; reference: Euler, {reference_steps} steps\n");
            println!("| method | steps or µm | evaluations | rejected | L2 | peak |\n|---|---|---|---|---|---|");
            // Some evaluations of adaptive steps are of a part of the positions.
            let positions = reference.summary.work.equilibria / reference.summary.work.mesh_cycles.max(1);
            let row = |method: &str, setting: f64, run: &RunRecord| {
                let [l2, peak] = errors(run, &reference);
                let work = &run.summary.work;
                println!(
                    "| {method} | {setting} | {} | {} | {l2:.1e} | {peak:.1e} |",
                    work.equilibria / positions,
                    work.rejected_steps
                );
            };
            for steps in [20.0, 40.0, 75.0, 150.0, 300.0, 600.0, 1200.0, 2400.0] {
                row("Euler", steps, &euler(&scene, steps)?);
            }
            // The hard switch takes tens of thousands of evaluations with a smaller one.
            let tolerances: &[f64] = if name == "hard switch" { &[1.0, 0.2] } else { &[1.0, 0.2, 0.05, 0.01] };
            for &tolerance_um in tolerances {
                row("Runge–Kutta–Chebyshev", tolerance_um, &adaptive(&scene, tolerance_um)?);
            }
        }
    }
    Ok(())
}
