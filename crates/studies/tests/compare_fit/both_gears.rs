//! The coefficients of both gears from profiles of both flanks: what goes in comes out, the intervals hold as often as they say, and fitted
//! values correlate as the fit says.

use std::sync::LazyLock;

use gearwear_studies::compare::question::{CompareOptions, FitKind};
use gearwear_studies::compare::record::CompareRecord;
use gearwear_studies::measurement::fit::FitStop;
use gearwear_studies::measurement::form::Form;

use super::laboratory::{Laboratory, Noise, POINTS, asked};
use super::scene;

/// Pinion and wheel, 2 to 1; the run has 1e-17 m²/N for both.
const TRUE_K: [f64; 2] = [1.7e-17, 8.5e-18];
const SEEDS: u64 = 20;

/// A scene that ends after so many hours, with these coefficients.
fn with(hours: f64, [pinion, wheel]: [f64; 2]) -> String {
    let text = scene(pinion, 1.0).replace("hours = 127.75", &format!("hours = {hours:?}"));
    let both = format!("coefficient_m2_per_N = {pinion:e}\n");
    text.replace(&both, &format!("{both}wheel.coefficient_m2_per_N = {wheel:e}\n"))
        .replace("positions = 100", "positions = 60")
}

/// An eighth of a life, as for one gear.
static SHORT: LazyLock<Laboratory> = LazyLock::new(|| {
    let hours = 15.96875;
    Laboratory::new(&with(hours, [1e-17; 2]), &with(hours, TRUE_K))
});

/// What both noiseless traces say.
fn without_noise(of: &Laboratory, ask: &CompareOptions) -> CompareRecord {
    let texts = [&of.traces.pinion, &of.traces.wheel].map(|trace| trace.file(&trace.heights(&[0.0; POINTS])));
    of.compare_all(&texts.each_ref().map(String::as_str), ask)
}

/// The coefficients of pinion and wheel over the true ones, less one.
fn errors(record: &CompareRecord) -> [f64; 2] {
    [0, 1].map(|gear| record.fit.coefficients[gear].coefficient_m2_per_N.value / TRUE_K[gear] - 1.0)
}

/// Noiseless, after a whole life in which the wear of each gear has changed the pressure on the other, as exactly as wear is interpolated
/// between flank points; runs are counted.
#[test]
fn ver_both_coefficients_come_back_without_noise() {
    let of = Laboratory::new(&with(127.75, [1e-17; 2]), &with(127.75, TRUE_K));
    for form in [Form::None, Form::Cubic] {
        let record = without_noise(&of, &CompareOptions { form: Some(form), fit: None, ..asked(FitKind::Each) });
        println!("{form:?}: {:?} by {} runs, {} cycles", errors(&record), record.fit.runs, record.fit.mesh_cycles);
        assert_eq!(record.fit.stopped, FitStop::Converged);
        assert!(errors(&record).iter().all(|error| error.abs() < 5e-4), "{form:?}: {:?}", record.fit);
        assert!(record.fit.runs <= 6, "{:?}", record.fit);
        assert!((record.fit.coefficient_ratio.unwrap().value / 2.0 - 1.0).abs() < 1e-3);
    }
}

/// White noise of 5 % of each flank's greatest depth, a cubic taken from both traces and each with a shift of its own. Here a coefficient is
/// told by its own flank alone, and nothing correlates much.
#[test]
fn ver_intervals_and_correlations_are_those_of_many_measurements() {
    many_measurements(&SHORT, &asked(FitKind::Each), [1.0, 1.0]);
}

/// The wheel measured twenty times less exactly (10 % of its depth), after so much wear that the pinion's flank tells of the wheel's too: the coefficients
/// correlate, and that of the wheel with the shift of the pinion's profile.
#[test]
fn ver_intervals_and_correlations_where_one_flank_tells_of_the_other() {
    let coarse = |k| {
        let text = with(511.0, k).replace("revolutions = 19162.5", "revolutions = 76650.0");
        text.replace("flank_points = 200", "flank_points = 100").replace("positions = 60", "positions = 40")
    };
    let of = Laboratory::new(&coarse([1e-17; 2]), &coarse(TRUE_K));
    let ask = CompareOptions { form: Some(Form::Involute), ..asked(FitKind::Each) };
    let stated = many_measurements(&of, &ask, [0.1, 2.0]);
    assert!(stated[0][1] < -0.2 && stated[1][2] < -0.3, "{stated:?}");
}

/// What `ask` says of traces with so many times the noise of 5 %, again and again: the 95 % intervals of both coefficients and of their
/// ratio hold the true values for 16 to 20 of 20 seeds (fewer in one of 390 such samples), and the stated correlations of all four fitted
/// values, which are given back, are those of the values fitted, within three of the standard deviations (1 − ρ²)/√n of a sample correlation.
fn many_measurements(of: &Laboratory, ask: &CompareOptions, times: [f64; 2]) -> [[f64; 4]; 4] {
    let ask = &CompareOptions { shift_within_mm: 0.5, ..*ask };
    let mut held = [0; 3];
    let mut fitted: [Vec<f64>; 4] = Default::default();
    let mut stated = [[0.0; 4]; 4];
    for seed in 0..SEEDS {
        let mut noise = Noise::new(seed);
        let mut white = |times: f64| noise.white(POINTS).iter().map(|value| times * value).collect::<Vec<_>>();
        let [pinion, wheel] = times.map(&mut white);
        let pinion = of.traces.pinion.file(&of.traces.pinion.heights(&pinion));
        let wheel = of.traces.wheel.file(&of.traces.wheel.heights(&wheel));
        let record = of.compare_all(&[&pinion, &wheel], ask);
        assert_eq!(record.fit.stopped, FitStop::Converged, "seed {seed}: {:?}", record.warnings);
        let [pinion, wheel] = [0, 1].map(|gear| record.fit.coefficients[gear].coefficient_m2_per_N);
        let estimates = [(pinion, TRUE_K[0]), (wheel, TRUE_K[1]), (record.fit.coefficient_ratio.unwrap(), 2.0)];
        for (held, (estimate, truth)) in held.iter_mut().zip(estimates) {
            *held += usize::from((estimate.low.unwrap()..=estimate.high.unwrap()).contains(&truth));
        }
        let shifts = [0, 1].map(|profile| record.profiles[profile].shift_mm.unwrap().value);
        let values = [pinion.value.ln(), wheel.value.ln(), shifts[0], shifts[1]];
        fitted.iter_mut().zip(values).for_each(|(all, value)| all.push(value));
        let matrix = record.fit.correlation.unwrap().matrix;
        (0..16).for_each(|at| stated[at / 4][at % 4] += matrix[at / 4][at % 4] / SEEDS as f64);
    }
    println!("held {held:?} of {SEEDS}");
    let deviation = |stated: f64| (1.0 - stated * stated) / (SEEDS as f64).sqrt();
    for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        let (sample, stated) = (correlation(&fitted[i], &fitted[j]), stated[i][j]);
        println!("values {i} and {j}: {sample:.3} found, {stated:.3} stated");
        assert!((sample - stated).abs() < 3.0 * deviation(stated), "{i} and {j}: {sample} {stated}");
    }
    assert!(held.iter().all(|held| (16..=20).contains(held)), "{held:?}");
    stated
}

/// Pearson's correlation coefficient.
fn correlation(x: &[f64], y: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_x, mean_y) = (mean(x), mean(y));
    let moment = |of: fn(f64, f64) -> f64| x.iter().zip(y).map(|(x, y)| of(x - mean_x, y - mean_y)).sum::<f64>();
    moment(|x, y| x * y) / (moment(|x, _| x * x) * moment(|_, y| y * y)).sqrt()
}

/// Flanks measured at different times, after half of the run and at its end.
#[test]
fn ver_both_coefficients_come_back_from_different_times() {
    let of = &*SHORT;
    let early = Laboratory::new(&with(15.96875 / 2.0, [1e-17; 2]), &with(15.96875 / 2.0, TRUE_K));
    let pinion = early.traces.pinion.file(&early.traces.pinion.heights(&[0.0; POINTS]));
    let pinion = pinion.replace("# gear = pinion\n", "# gear = pinion\n# hours = 7.984375\n");
    let wheel = of.traces.wheel.file(&of.traces.wheel.heights(&[0.0; POINTS]));
    let record = of.compare_all(&[&wheel, &pinion], &asked(FitKind::Each));
    println!("{:?} by {} runs", errors(&record), record.fit.runs);
    // Half of the run is in one wear step there, and in two here.
    assert!(errors(&record).iter().all(|error| error.abs() < 5e-3), "{:?}", record.fit);
    assert_eq!([0, 1].map(|profile| record.profiles[profile].hours), [Some(7.984375), Some(15.96875)]);
}

/// Two phases of different loads, in which each pair of coefficients is a run of its own.
#[test]
fn ver_both_coefficients_come_back_from_phases() {
    let phases = |k: [f64; 2]| {
        let phases =
            "[[operation.phases]]\nhours = 8.0\npinion_torque_Nm = 200.0\n[[operation.phases]]\nhours = 7.96875\n";
        with(15.96875, k).replace("hours = 15.96875\n", "").replace("[stiffness]\n", &format!("{phases}[stiffness]\n"))
    };
    let record = without_noise(&Laboratory::new(&phases([1e-17; 2]), &phases(TRUE_K)), &asked(FitKind::Each));
    println!("{:?} by {} runs", errors(&record), record.fit.runs);
    assert!(errors(&record).iter().all(|error| error.abs() < 1e-3), "{:?}", record.fit);
}

/// One coefficient of both gears from both flanks: known better than from either alone, and of all three by the same value.
#[test]
fn ver_one_coefficient_of_both_gears() {
    let hours = 15.96875;
    let of = Laboratory::new(&with(hours, [1e-17; 2]), &with(hours, [1.7e-17; 2]));
    let mut noise = Noise::new(5);
    let texts = [&of.traces.pinion, &of.traces.wheel].map(|trace| trace.file(&trace.heights(&noise.white(POINTS))));
    let [pinion, wheel] = texts.each_ref().map(String::as_str);
    let found = [vec![pinion], vec![wheel], vec![pinion, wheel]].map(|files| {
        let record = of.compare_all(&files, &asked(FitKind::K));
        assert_eq!((record.fit.coefficients.len(), record.fit.coefficients[0].gear), (1, None));
        super::k_of(&record)
    });
    println!("{found:?}");
    let width = |of: usize| (found[of].high.unwrap() / found[of].low.unwrap()).ln();
    assert!((found[2].low.unwrap()..=found[2].high.unwrap()).contains(&1.7e-17), "{found:?}");
    // Two independent measurements of one value: 1/w² = 1/w₁² + 1/w₂².
    let expected = (width(0).powi(-2) + width(1).powi(-2)).powf(-0.5);
    assert!((width(2) / expected - 1.0).abs() < 0.05, "{} {expected}", width(2));
}
