//! How long a wear run takes: the thesis-spur scene (750 points a flank, 400 positions, 150 wear steps) on each surface, and
//! how the time grows with positions and wear steps. One thread; quote ratios, machines are noisy.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gearwear::observer::Unwatched;
use gearwear::pipeline;
use gearwear::results::run::RunRecord;
use gearwear::scene::{Resolved, Scene, presets};
use gearwear::studies::sweep::combination::Sweep;
use gearwear::studies::sweep::journal::Journal;
use gearwear::studies::sweep::{axis, study};

/// The thesis-spur scene without snapshots and error estimates, some keys replaced.
fn scene(edits: &[(&str, &str)]) -> Resolved {
    let mut text = presets::find("thesis-spur").expect("thesis-spur is a preset").text.to_owned();
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
    pipeline::run(scene, &Unwatched).expect("the preset runs").record
}

fn wear_run(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is not built yet");
    let mut group = criterion.benchmark_group("thesis-spur");
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
            ("step = { revolutions = 7665.0 }", &step),
        ]);
        group.throughput(Throughput::Elements(run(&scene).summary.work.equilibria));
        group.bench_function(BenchmarkId::new("positions x steps", format!("{positions} x {steps}")), |bencher| {
            bencher.iter(|| run(&scene));
        });
    }
    group.finish();
}

/// A sweep of the preset helical with the simplified model: one combination, and some on all threads, journal included.
fn sweep(criterion: &mut Criterion) {
    let preset = presets::find("helical").expect("helical is a preset").text;
    let text = preset.replace("surface = \"hertz\" ", "surface = \"hertz-mean\" ");
    let resolved = Scene::from_toml(&text).expect("the preset is sound");
    let sweep_of = |vary: [&str; 2]| {
        let axes = axis::parse_all(vary).expect("the ranges are sound");
        Sweep::new(&text, &resolved, Inputs::default(), axes, false).expect("the preset is TOML")
    };
    let mut group = criterion.benchmark_group("sweep");
    group.sample_size(10);
    let one = sweep_of(["pair.helix_angle_deg=20:20:1", "pair.face_width_mm=20:20:1"]);
    group.bench_function("one combination", |bencher| bencher.iter(|| one.row(0, &Unwatched)));
    let some = sweep_of(["pair.helix_angle_deg=0:30:7", "pair.face_width_mm=10:30:3"]);
    group.throughput(Throughput::Elements(21));
    group.bench_function("21 combinations on 2 threads", |bencher| {
        bencher.iter(|| {
            let folder = tempfile::tempdir().expect("a folder for the journal");
            let mut journal = Journal::open(folder.path(), &some.identity, None).expect("a new journal");
            study::run(&some, None, &mut journal, 2, &Unheard).expect("rows are kept")
        });
    });
    group.finish();
}

/// Nobody watches the sweep.
struct Unheard;

impl study::Observer for Unheard {
    fn row(&self, _done: usize, _total: usize, _failed: usize) {}

    fn verified(&self, _done: usize, _total: usize) {}

    fn interrupted(&self) -> bool {
        false
    }
}

criterion_group!(benches, wear_run, sweep);
criterion_main!(benches);
