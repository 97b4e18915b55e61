//! Announced against measured time and memory of random scenes, each run by a process of its own on one thread: `run_costs SEED COUNT` prints a line
//! for each scene and the ratios of all; a scene that cannot be run is left out. Runs write no output, so that the announced time is that without. `run_costs SEED NUMBER --scene` prints one of the scenes.
//!
//! Scenes are those of the invariants, with resolutions that users choose in place of their coarse ones.

#[path = "../common/mod.rs"]
mod common;

use std::error::Error;
use std::time::Instant;

use gearwear::scene::loaded::LoadedScene;
use gearwear::scene::table::set;
use gearwear_bodies::gear::GearPair;
use gearwear_physics::plan::{StageKind, cost::RunCost};
use gearwear_validation::invariants::scene_generator;
use serde_json::{Value, json};

/// The scene of this number, at a resolution of its own.
fn scene(seed: u64, index: u64) -> String {
    let mut table = scene_generator::scene(seed, index);
    let mut random = fastrand::Rng::with_seed(seed.rotate_left(32) ^ index);
    let fineness = 0.25 + 0.75 * random.f64();
    set(&mut table, "numerics.positions", (400.0 * fineness) as i64);
    set(&mut table, "numerics.flank_points", (750.0 * fineness) as i64);
    set(&mut table, "numerics.verify", random.bool());
    set(&mut table, "numerics.error_estimate", random.bool());
    if table.contains_key("helical") {
        set(&mut table, "helical.slices", random.i64(8..=24));
    }
    table.to_string()
}

/// Runs a scene and prints what it was to cost and what it did, JSON.
fn measure(seed: u64, index: u64) -> Result<(), Box<dyn Error>> {
    let scene = LoadedScene::from_toml(&scene(seed, index))?;
    let announced = RunCost::of(scene.scene(), &scene.plan(), &GearPair::new(&scene.scene().pair)?);
    let without_output = announced.stages.iter().filter(|stage| stage.kind != StageKind::Report);
    let seconds: f64 = without_output.map(|stage| stage.seconds).sum();
    let start = Instant::now();
    let done = gearwear::run(&scene, &gearwear::Unwatched)?;
    let summary = done.record.summary;
    let stages: Vec<Value> = summary.stages.iter().map(|stage| json!([stage.name, stage.wall_s])).collect();
    let line = json!({
        "index": index, "announced": {"seconds": seconds, "memory_GB": announced.memory_gb, "stages": announced.stages}, "measured": common::cost_since(start), "stages": stages,
        "surface": summary.contact.surface, "mesh_cycles": summary.work.mesh_cycles,
        "depth_um": summary.pinion.peak_wear_um.max(summary.wheel.peak_wear_um),
    });
    println!("{line}");
    Ok(())
}

/// Ratios with which at least these parts of the values lie within a factor.
fn print_ratios(name: &str, mut ratios: Vec<f64>) {
    ratios.sort_by(f64::total_cmp);
    let within = |factor: f64| ratios.iter().filter(|ratio| (1.0 / factor..=factor).contains(*ratio)).count();
    let (least, greatest) = (ratios.first().copied().unwrap_or(f64::NAN), ratios.last().copied().unwrap_or(f64::NAN));
    println!(
        "{name}: announced over measured {least:.2} to {greatest:.2}, {} of {} within a factor of 2, {} within 3",
        within(2.0),
        ratios.len(),
        within(3.0)
    );
}

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<u64> = args.iter().filter_map(|arg| arg.parse().ok()).collect();
    let [seed, count] = numbers[..] else { return Err("usage: run_costs SEED COUNT".into()) };
    if args.iter().any(|arg| arg == "--scene") {
        print!("{}", scene(seed, count));
        return Ok(());
    }
    if args.iter().any(|arg| arg == "--one") {
        return measure(seed, count);
    }
    let (mut seconds, mut memory) = (Vec::new(), Vec::new());
    for index in 0..count {
        let args = ["--one", &seed.to_string(), &index.to_string()];
        let Ok(found) = common::in_its_own_process(&args, 1) else { continue };
        println!("{found}");
        let ratio = |announced: &str, measured: &str| {
            Some(
                found["announced"][announced].as_f64()?
                    / found["measured"][measured].as_f64().filter(|cost| *cost > 0.0)?,
            )
        };
        seconds.extend(ratio("seconds", "processor_s"));
        memory.extend(ratio("memory_GB", "memory_GB"));
    }
    print_ratios("time", seconds);
    print_ratios("memory", memory);
    Ok(())
}
