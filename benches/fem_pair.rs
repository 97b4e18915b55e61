//! What the finite-element contact of the FZG type C pair costs: unknowns, meshing, factorisation with condensation, time
//! a position, memory, for four meshes; and how well the meshes agree.
//!
//! `cargo bench --bench fem_pair`

use gearwear::{LoadedScene, Unwatched};

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
    let preset = LoadedScene::preset("fzg-c").expect("fzg-c is a preset");
    println!(
        "elements/half-width  unknowns  mesh s  condense s  cycle s  ms/position  total s  peak MB  TE at C um  p at C MPa"
    );
    let mut costs = Vec::new();
    for elements_per_half_width in [4.0, 6.0, 8.0, 10.0, 14.0] {
        let scene = preset.with("fem.elements_per_half_width", elements_per_half_width).expect("the scene is sound");
        let solve = |position_mm| {
            gearwear::fem_pair(&scene, position_mm, &Unwatched)
                .expect("every position has an equilibrium")
                .record
                .summary
        };
        let whole = solve(None);
        let pitch = solve(Some(whole.geometry.curvature_radius_mm.C));
        let seconds =
            |name: &str| whole.stages.iter().filter(|stage| stage.name == name).map(|stage| stage.wall_s).sum::<f64>();
        let (mesh_s, condense_s, cycle_s) = (seconds("meshing"), seconds("condensation"), seconds("cycle"));
        println!(
            "{elements_per_half_width:>19} {:>9} {mesh_s:>7.3} {condense_s:>11.3} {cycle_s:>8.3} {:>12.3} {:>8.3} {:>8.0} {:>11.4} {:>11.1}",
            whole.dofs,
            1e3 * whole.wall_per_position_s.unwrap_or(f64::NAN),
            whole.wall_s,
            peak_memory_mb().unwrap_or(f64::NAN),
            pitch.new.transmission_error_um.max,
            pitch.new.peak_pressure_MPa.unwrap_or(f64::NAN),
        );
        costs.push(((whole.dofs as f64).ln(), whole.wall_s.ln()));
    }
    let n = costs.len() as f64;
    let (x, y) = (costs.iter().map(|c| c.0).sum::<f64>() / n, costs.iter().map(|c| c.1).sum::<f64>() / n);
    let slope =
        costs.iter().map(|c| (c.0 - x) * (c.1 - y)).sum::<f64>() / costs.iter().map(|c| (c.0 - x).powi(2)).sum::<f64>();
    println!("total time goes with unknowns to the power {slope:.2}");
}
