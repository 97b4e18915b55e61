//! How long wear runs of helical gears take: the preset `helical` (20 slices, 750 points a flank, 400 positions, 60 wear steps), the
//! simplified model and slices coupled on a Winkler foundation, and how the time grows with the number of slices. One thread; only the wear
//! run itself is timed (the stage "simulation"), and the whole of a run beside it. Quote ratios, machines are noisy.

use std::time::{Duration, Instant};

use common::run;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gearwear::{LoadedScene, RunRecord};

mod common;

/// The preset `helical`, some keys replaced.
fn scene(edits: &[(&str, &str)]) -> LoadedScene {
    common::scene("thesis-helical", "operation.snapshots_revolutions", edits)
}

/// Wall time of the wear run alone, in `times` runs.
fn simulation(scene: &LoadedScene, times: u64) -> Duration {
    let stage = |record: RunRecord| record.summary.stages.into_iter().find(|stage| stage.name == "simulation");
    let seconds = (0..times).filter_map(|_| stage(run(scene))).map(|stage| stage.wall_s).sum();
    Duration::from_secs_f64(seconds)
}

const SURFACE: &str = "contact.surface";
const SLICES: &str = "helical.slices";
const COUPLING: &str = "helical.coupling";

fn helical(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is not built yet");
    let simplified = (SURFACE, "\"hertz-mean\"");
    let coupled = (COUPLING, "\"slicing\"");

    let mut group = criterion.benchmark_group("helical");
    for (name, edits) in [("simplified", vec![simplified]), ("simplified, coupled", vec![simplified, coupled])] {
        let scene = scene(&edits);
        println!("{name}: {:?}", run(&scene).summary.work);
        group.bench_function(BenchmarkId::new("simulation", name), |bencher| {
            bencher.iter_custom(|times| simulation(&scene, times));
        });
        group.bench_function(BenchmarkId::new("whole run", name), |bencher| bencher.iter(|| run(&scene)));
    }
    group.sample_size(10);
    let winkler = scene(&[(SURFACE, "\"winkler\""), coupled]);
    let start = Instant::now();
    println!("winkler, coupled: {:?} in {:?}", run(&winkler).summary.work, start.elapsed());
    group.bench_function(BenchmarkId::new("simulation", "winkler, coupled"), |bencher| {
        bencher.iter_custom(|times| simulation(&winkler, times));
    });
    group.finish();

    // Cost a slice must stay the same.
    let mut group = criterion.benchmark_group("linear in slices");
    for slices in [5, 10, 20, 40, 80] {
        let scene = scene(&[simplified, (SLICES, &slices.to_string())]);
        println!("{slices} slices: {:?}", run(&scene).summary.work);
        group.throughput(Throughput::Elements(slices));
        group.bench_function(BenchmarkId::new("simplified", slices), |bencher| {
            bencher.iter_custom(|times| simulation(&scene, times));
        });
    }
    group.finish();
}

criterion_group!(benches, helical);
criterion_main!(benches);
