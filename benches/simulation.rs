//! How long a wear run takes: the thesis-spur scene (750 points a flank, 400 positions, 150 wear steps) on each surface, and
//! how the time grows with positions and wear steps. One thread; quote ratios, machines are noisy.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gearwear::{LoadedScene, RunRecord, Unwatched};

/// The thesis-spur scene without snapshots, error estimates and verification, some keys replaced.
fn scene(edits: &[(&str, &str)]) -> LoadedScene {
    let scene = LoadedScene::preset("thesis-spur")
        .and_then(|scene| scene.without("operation.snapshots_h"))
        .expect("thesis-spur is a preset");
    let off = [("numerics.error_estimate", "false"), ("numerics.verify", "false")];
    off.iter().chain(edits).fold(scene, |scene, (key, value)| {
        let value: toml::Table = format!("value = {value}").parse().expect("a value");
        scene.with(key, value["value"].clone()).expect("the scene is sound")
    })
}

fn run(scene: &LoadedScene) -> RunRecord {
    gearwear::run(scene, &Unwatched).expect("the preset runs").record
}

fn wear_run(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is not built yet");
    let mut group = criterion.benchmark_group("thesis-spur");
    group.sample_size(20);
    for surface in ["winkler", "half-space", "hertz", "hertz-mean"] {
        let scene = scene(&[("contact.surface", &format!("\"{surface}\""))]);
        println!("{surface}: {:?}", run(&scene).summary.work);
        group.bench_function(BenchmarkId::new("surface", surface), |bencher| bencher.iter(|| run(&scene)));
    }
    group.finish();

    // Cost per equilibrium must stay the same: linear in positions × wear steps.
    let mut group = criterion.benchmark_group("linear");
    group.sample_size(20);
    for (positions, steps) in [(200, 150), (400, 150), (800, 150), (400, 75), (400, 300)] {
        let step = format!("{{ revolutions = {:?} }}", 1_149_750.0 / f64::from(steps));
        let scene = scene(&[("numerics.positions", &positions.to_string()), ("numerics.step", &step)]);
        group.throughput(Throughput::Elements(run(&scene).summary.work.equilibria));
        group.bench_function(BenchmarkId::new("positions x steps", format!("{positions} x {steps}")), |bencher| {
            bencher.iter(|| run(&scene));
        });
    }
    group.finish();
}

criterion_group!(benches, wear_run);
criterion_main!(benches);
