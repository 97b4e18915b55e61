//! How the time of a run grows with each of its sizes, on one thread: the exponent p of time ∝ sizeᵖ between the smallest and the largest.
//! Prints the table that docs/accuracy.md quotes; `scaling slices` prints one row.

use std::error::Error;
use std::time::Instant;

use gearwear::{LoadedScene, UncertaintyQuestion, Unwatched};

type Failure = Box<dyn Error + Send + Sync>;
type Run = fn(&LoadedScene, f64) -> Result<(), Failure>;

/// A size, the scene that it is varied in, its values and how a run takes one.
struct Row {
    size: &'static str,
    scene: LoadedScene,
    values: [f64; 4],
    run: Run,
}

fn run(scene: &LoadedScene) -> Result<(), Failure> {
    gearwear::run(scene, &Unwatched)?.complete()?;
    Ok(())
}

/// The preset without snapshots, error estimates and verification.
fn alone(preset: &str) -> Result<LoadedScene, Failure> {
    let scene = LoadedScene::preset(preset)?.without("operation.snapshots_h")?;
    Ok(scene.with("numerics.error_estimate", false)?.with("numerics.verify", false)?)
}

fn of_samples(scene: &LoadedScene, samples: f64) -> Result<(), Failure> {
    let uncertain = ["wear.coefficient_m2_per_N=lognormal:1.5", "operation.pinion_torque_Nm=normal:5%"];
    let uncertain = uncertain.map(str::to_owned).to_vec();
    let (samples, run_all) = (samples as usize, true);
    let question = UncertaintyQuestion { uncertain, samples, run_all, ..UncertaintyQuestion::default() };
    gearwear::uncertainty(scene, &question, None, 1, &Unwatched)?;
    Ok(())
}

fn rows() -> Result<Vec<Row>, Failure> {
    let on_elements = alone("fzg-c")?.with("contact.surface", "fem")?;
    Ok(vec![
        Row {
            size: "flank points",
            scene: alone("fzg-c")?,
            values: [375.0, 750.0, 1500.0, 3000.0],
            run: |scene, value| run(&scene.with("numerics.flank_points", value as i64)?),
        },
        Row {
            size: "positions",
            scene: alone("fzg-c")?,
            values: [200.0, 400.0, 800.0, 1600.0],
            run: |scene, value| run(&scene.with("numerics.positions", value as i64)?),
        },
        Row {
            size: "positions, finite elements",
            scene: on_elements.clone(),
            values: [200.0, 400.0, 800.0, 1600.0],
            run: |scene, value| run(&scene.with("numerics.positions", value as i64)?),
        },
        Row {
            size: "hours",
            scene: alone("fzg-c")?,
            values: [16.0, 64.0, 256.0, 1024.0],
            run: |scene, value| run(&scene.with("operation.hours", value)?),
        },
        Row {
            size: "1/tip rounding, finite elements",
            scene: on_elements,
            values: [5.0, 10.0, 20.0, 80.0],
            run: |scene, value| {
                run(&scene
                    .with("pair.pinion.tip_rounding_mm", 1.0 / value)?
                    .with("pair.wheel.tip_rounding_mm", 1.0 / value)?)
            },
        },
        Row {
            size: "slices",
            scene: alone("helical")?,
            values: [10.0, 20.0, 40.0, 80.0],
            run: |scene, value| run(&scene.with("helical.slices", value as i64)?),
        },
        Row { size: "samples of two keys", scene: alone("fzg-c")?, values: [16.0, 32.0, 64.0, 128.0], run: of_samples },
    ])
}

fn main() -> Result<(), Failure> {
    let only = std::env::args().nth(1);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    println!("| size | from | to | time, s | exponent |\n|---|---|---|---|---|");
    for row in rows()?.into_iter().filter(|row| only.as_ref().is_none_or(|only| row.size.starts_with(only.as_str()))) {
        let mut seconds = Vec::new();
        for value in row.values {
            let start = Instant::now();
            one_thread.install(|| (row.run)(&row.scene, value))?;
            seconds.push(start.elapsed().as_secs_f64());
        }
        let ([first, .., last], [least, .., greatest]) = (&seconds[..], row.values) else { continue };
        let exponent = (last / first).ln() / (greatest / least).ln();
        let said: Vec<String> = seconds.iter().map(|seconds| format!("{seconds:.2}")).collect();
        println!("| {} | {least} | {greatest} | {} | {exponent:.2} |", row.size, said.join(", "));
    }
    Ok(())
}
