//! What the finite-element contact of the FZG type C pair costs: unknowns, meshing, factorisation with condensation, time
//! a position, memory, for four meshes; and how well the meshes agree.
//!
//! `cargo bench --bench fem_pair`

use std::time::Instant;

use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::cycle::cycle;
use gearwear::fem::gear::model::MeshedGear;
use gearwear::fem::gear::position::CondensedPair;
use gearwear::gear::{Gear, GearPair, PerGear};
use gearwear::gear_mesh::settings::{Body, BodySettings};
use gearwear::scene::{Scene, presets};

const POSITIONS: usize = 400;
const FACE_WIDTH_MM: f64 = 14.0;
const TORQUE_N_MM: f64 = 302e3;

/// Peak resident memory of this process in MB, where the system tells.
fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kib| kib / 1024.0)
}

fn main() {
    // Under `cargo test --benches` there is nothing to measure.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    threads.install(table);
}

fn table() {
    let resolved = Scene::from_toml(presets::find("fzg-c").expect("fzg-c is a preset").text).expect("it is sound");
    let pair = GearPair::new(&resolved.scene.pair).expect("the preset is sound");
    let line_load = TORQUE_N_MM / pair.path.involute.pinion.base_radius_mm / FACE_WIDTH_MM;
    let steel = PerGear::from_fn(|_| Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 });
    println!(
        "elements/half-width  unknowns  mesh s  condense s  cycle s  ms/position  total s  peak MB  TE at C um  p at C MPa"
    );
    let mut costs = Vec::new();
    for elements_per_half_width in [4.0, 6.0, 8.0, 10.0, 14.0] {
        let settings = BodySettings {
            body: Body::Ring,
            clamp_radius_mm: PerGear { pinion: 19.943, wheel: 37.897 },
            elements_per_half_width,
        };
        let start = Instant::now();
        let meshed = PerGear::from_fn(|gear| {
            MeshedGear::new(&pair, gear, &steel, line_load, &settings).expect("the teeth can be meshed")
        });
        let mesh_s = start.elapsed().as_secs_f64();
        let condensed =
            PerGear::from_fn(|gear| meshed[gear].condense(&pair, steel[gear]).expect("the gears can be condensed"));
        let condense_s = start.elapsed().as_secs_f64() - mesh_s;
        let model = CondensedPair::new(&pair, &steel, condensed);
        let positions: Vec<f64> = (0..POSITIONS)
            .map(|k| pair.path.start_mm + (pair.path.end_mm - pair.path.start_mm) * k as f64 / (POSITIONS - 1) as f64)
            .collect();
        let before = start.elapsed().as_secs_f64();
        let solved = cycle(&model, &positions, line_load).expect("every position has an equilibrium");
        let cycle_s = start.elapsed().as_secs_f64() - before;
        let total_s = start.elapsed().as_secs_f64();
        let unknowns: usize = Gear::BOTH.into_iter().map(|gear| meshed[gear].dofs()).sum();
        let pitch = cycle(&model, &[pair.path.pitch_point_mm], line_load).expect("the pitch point has an equilibrium");
        println!(
            "{elements_per_half_width:>19} {unknowns:>9} {mesh_s:>7.3} {condense_s:>11.3} {cycle_s:>8.3} {:>12.3} {total_s:>8.3} {:>8.0} {:>11.4} {:>11.1}",
            1e3 * cycle_s / solved.len() as f64,
            peak_memory_mb().unwrap_or(f64::NAN),
            1e3 * pitch[0].transmission_error_mm,
            pitch[0].pairs[0].peak_pressure_mpa,
        );
        costs.push(((unknowns as f64).ln(), total_s.ln()));
    }
    let n = costs.len() as f64;
    let (x, y) = (costs.iter().map(|c| c.0).sum::<f64>() / n, costs.iter().map(|c| c.1).sum::<f64>() / n);
    let slope =
        costs.iter().map(|c| (c.0 - x) * (c.1 - y)).sum::<f64>() / costs.iter().map(|c| (c.0 - x).powi(2)).sum::<f64>();
    println!("total time goes with unknowns to the power {slope:.2}");
}
