//! Processor time and peak memory of random pairs as a user would run them, with check and without another key of contact, stiffness or numerics than the
//! defaults: `random_pairs SEED SPUR HELICAL` runs that many pairs of each kind, each in a process of its own, and prints the slowest of them, and the median
//! and the greatest of all.
//!
//! Pairs, materials, operation and wear laws are those of the scenes of the invariants.

#[path = "../common/mod.rs"]
mod common;

use std::error::Error;
use std::time::Instant;

use gearwear::scene::loaded::LoadedScene;
use gearwear::scene::table::remove;
use gearwear_validation::invariants::scene_generator;
use serde_json::{Value, json};

/// Processor time above which a pair is printed, s.
const SLOW_S: f64 = 2.0;
/// Threads of a run of a spur and of a helical pair.
const THREADS: [usize; 2] = [1, 2];

/// The scene of this number on the defaults.
fn on_defaults(seed: u64, index: u64) -> Result<LoadedScene, Box<dyn Error>> {
    let mut table = scene_generator::scene(seed, index);
    for key in ["contact", "stiffness", "numerics", "helical"] {
        remove(&mut table, key);
    }
    Ok(LoadedScene::from_toml(&table.to_string())?)
}

/// Runs a scene and prints what it took, JSON.
fn measure(seed: u64, index: u64) -> Result<(), Box<dyn Error>> {
    let scene = on_defaults(seed, index)?;
    let start = Instant::now();
    let done = gearwear::run(&scene, &gearwear::Unwatched)?;
    let summary = done.record.summary;
    let stages: Vec<Value> = summary.stages.iter().map(|stage| json!([stage.name, stage.wall_s])).collect();
    let depth_um = summary.pinion.peak_wear_um.max(summary.wheel.peak_wear_um);
    let line = json!({
        "index": index, "cost": common::cost_since(start), "stages": stages, "surface": summary.contact.surface,
        "mesh_cycles": summary.work.mesh_cycles, "depth_um": depth_um, "warnings": summary.warnings,
    });
    println!("{line}");
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<u64> = args.iter().filter_map(|arg| arg.parse().ok()).collect();
    if args.iter().any(|arg| arg == "--one") {
        let [seed, index] = numbers[..] else { return Err("--one SEED INDEX".into()) };
        return measure(seed, index);
    }
    let [seed, spur, helical] = numbers[..] else { return Err("usage: random_pairs SEED SPUR HELICAL".into()) };
    let mut indices = 0_u64..;
    for (kind, count, threads, sliced) in [("spur", spur, THREADS[0], false), ("helical", helical, THREADS[1], true)] {
        let mut measured: Vec<[f64; 3]> = Vec::new();
        while (measured.len() as u64) < count {
            let index = indices.next().unwrap_or_default();
            // Scenes that cannot be run are left out: so few keys of the generator may not go together.
            if !on_defaults(seed, index).is_ok_and(|scene| scene.scene().slices.is_some() == sliced) {
                continue;
            }
            let one = ["--one", &seed.to_string(), &index.to_string()];
            let Ok(found) = common::in_its_own_process(&one, threads) else { continue };
            let cost = ["processor_s", "wall_s", "memory_GB"].map(|of| found["cost"][of].as_f64().unwrap_or(f64::NAN));
            if cost[0] > SLOW_S {
                println!("{found}");
            }
            measured.push(cost);
        }
        for (at, what) in ["processor, s", "wall, s", "memory, GB"].into_iter().enumerate() {
            let mut values: Vec<f64> = measured.iter().map(|cost| cost[at]).collect();
            values.sort_by(f64::total_cmp);
            if let (Some(median), Some(most)) = (values.get(values.len() / 2), values.last()) {
                println!("{kind}, {count} pairs, {what}: median {median:.2}, greatest {most:.2}");
            }
        }
    }
    Ok(())
}
