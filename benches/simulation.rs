//! How long a wear run takes: the thesis-spur scene (750 points a flank, 400 positions, 150 wear steps) on each surface, and
//! how the time grows with positions and wear steps. One thread; quote ratios, machines are noisy.

use common::run;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gearwear::LoadedScene;

mod common;

/// The preset `thesis-spur`, some keys replaced.
fn scene(edits: &[(&str, &str)]) -> LoadedScene {
    common::scene("thesis-spur", "operation.snapshots_h", edits)
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

/// Tip roundings that are small beside the contact, and severe wear, over a band and abrupt.
fn hard_cases(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("hard cases");
    group.sample_size(10);
    for rounding in ["0.1", "0.03", "0.01", "0.002"] {
        let roundings = [("pair.pinion.tip_rounding_mm", rounding), ("pair.wheel.tip_rounding_mm", rounding)];
        let scene = common::scene(
            "fzg-c",
            "operation.snapshots_h",
            &[&[("contact.surface", "\"fem\"")], &roundings[..]].concat(),
        );
        println!("rounding {rounding}: {:?}", run(&scene).summary.work);
        group.bench_function(BenchmarkId::new("rounding, fem", rounding), |bencher| bencher.iter(|| run(&scene)));
    }
    for surface in ["fem", "half-space"] {
        for (torque, factor, band) in [("372.6", "100.0", "100.0"), ("405.0", "60.0", "0.0")] {
            let severe = format!("{{ above_MPa = 2000.0, factor = {factor}, band_MPa = {band} }}");
            let scene = common::scene(
                "fzg-c",
                "operation.snapshots_h",
                &[
                    ("contact.surface", &format!("\"{surface}\"")),
                    ("operation.pinion_torque_Nm", torque),
                    ("wear.severe", &severe),
                ],
            );
            println!("severe, {surface}, band {band}: {:?}", run(&scene).summary.work);
            group.bench_function(BenchmarkId::new(format!("severe, {surface}"), band), |bencher| {
                bencher.iter(|| run(&scene));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, wear_run, hard_cases);
criterion_main!(benches);
