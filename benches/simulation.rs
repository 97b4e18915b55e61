//! How long a wear run takes: the fzg-c scene (750 points a flank, 400 positions, 150 wear steps) on each surface, and
//! how the time grows with positions and wear steps. One thread; quote ratios, machines are noisy.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gearwear::pipeline;
use gearwear::pipeline::inputs::Inputs;
use gearwear::plan::Plan;
use gearwear::scene::{Resolved, Scene, presets};
use gearwear::simulation::record::RunRecord;
use gearwear::simulation::wear_run::Unwatched;

/// The fzg-c scene without snapshots and error estimates, some keys replaced.
fn scene(edits: &[(&str, &str)]) -> Resolved {
    let mut text = presets::find("fzg-c").expect("fzg-c is a preset").text.to_owned();
    for (from, to) in
        [("error_estimate = true", "error_estimate = false"), ("snapshots_h", "# snapshots_h")].iter().chain(edits)
    {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    let mut resolved = Scene::from_toml(&text).expect("the preset is sound");
    resolved.scene.operation.snapshots_revolutions.clear();
    resolved
}

fn run(resolved: &Resolved) -> RunRecord {
    pipeline::run(resolved, &Plan::of(&resolved.scene), &Inputs::default(), &Unwatched).expect("the preset runs").record
}

fn wear_run(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is not built yet");
    let mut group = criterion.benchmark_group("fzg-c");
    group.sample_size(20);
    for surface in ["winkler", "half-space", "hertz", "hertz-mean"] {
        let scene = scene(&[("surface = \"winkler\"", &format!("surface = \"{surface}\""))]);
        println!("{surface}: {:?}", run(&scene).summary.work);
        group.bench_function(BenchmarkId::new("surface", surface), |bencher| bencher.iter(|| run(&scene)));
    }
    group.finish();

    // Cost per equilibrium must stay the same: linear in positions × wear steps.
    let mut group = criterion.benchmark_group("linear");
    group.sample_size(20);
    for (positions, steps) in [(200, 150), (400, 150), (800, 150), (400, 75), (400, 300)] {
        let step = format!("step = {{ revolutions = {} }}", 1_149_750.0 / f64::from(steps));
        let scene = scene(&[
            ("positions = 400 ", &format!("positions = {positions} ")),
            ("# step = { revolutions = 1000.0 }", &step),
        ]);
        group.throughput(Throughput::Elements(run(&scene).summary.work.equilibria));
        group.bench_function(BenchmarkId::new("positions x steps", format!("{positions} x {steps}")), |bencher| {
            bencher.iter(|| run(&scene));
        });
    }
    group.finish();
}

criterion_group!(benches, wear_run);
criterion_main!(benches);
