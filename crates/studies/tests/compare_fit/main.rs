//! Fitting wear coefficients to synthetic profiles: what goes in comes out, and the interval holds as often as it says.
#![allow(unreachable_pub, dead_code, reason = "test modules are of one crate")]

mod both_gears;
#[path = "../../../../tests/inside/common/mod.rs"]
mod common;
mod laboratory;
mod mutated;
mod slope;

use std::sync::LazyLock;

use gearwear_bodies::gear::Gear;
use gearwear_studies::compare::question::{CompareOptions, FitKind};
use gearwear_studies::compare::record::{CompareRecord, FittedValue};
use gearwear_studies::measurement::fit::FitStop;
use gearwear_studies::measurement::form::Form;
use laboratory::{Laboratory, Noise, POINTS, asked, wave};

/// fzg-c at coarse resolution, with a wear coefficient and a severe factor above 1600 MPa.
fn scene(coefficient: f64, severe_factor: f64) -> String {
    format!(
        "[pair]\npreset = \"thesis-spur\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\nhours = 127.75\n\
         [contact]\nsurface = \"winkler\"\ntip_contact = false\n\
         [stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = {coefficient:e}\n\
         severe = {{ above_MPa = 1600.0, factor = {severe_factor:?}, band_MPa = 200.0 }}\n\
         [numerics]\nflank_points = 200\npositions = 100\nstep = {{ revolutions = 19162.5 }}\nerror_estimate = false\nverify = false\n"
    )
}

const TRUE_K: f64 = 1.7e-17;
const SEEDS: u64 = 50;

static LABORATORY: LazyLock<Laboratory> = LazyLock::new(|| Laboratory::new(&scene(1e-17, 1.0), &scene(TRUE_K, 1.0)));

/// An eighth of the life in an eighth of the steps: how often an interval holds is a matter of noise and points, not of depth.
static SHORT: LazyLock<Laboratory> = LazyLock::new(|| {
    let short = |k: f64| {
        scene(k, 1.0).replace("hours = 127.75", "hours = 15.96875").replace("positions = 100", "positions = 60")
    };
    Laboratory::new(&short(1e-17), &short(TRUE_K))
});

/// The coefficient that was fitted.
fn k_of(record: &CompareRecord) -> FittedValue {
    record.fit.coefficients[0].coefficient_m2_per_N
}

/// How many of the seeds have the true coefficient in their interval, by what `noise` makes of each and with `more` added.
fn covered(of: &Laboratory, ask: &CompareOptions, more: &[f64], noise: impl Fn(&mut Noise) -> Vec<f64>) -> usize {
    (0..SEEDS)
        .filter(|&seed| {
            let mut z = of.traces.pinion.heights(&noise(&mut Noise::new(seed)));
            z.iter_mut().zip(more).for_each(|(z, more)| *z += more);
            let record = of.compare(&of.traces.pinion.file(&z), ask);
            assert_eq!(record.fit.stopped, FitStop::Converged, "seed {seed}");
            let k = k_of(&record);
            (k.low.unwrap()..=k.high.unwrap()).contains(&TRUE_K)
        })
        .count()
}

/// Without noise the coefficient comes back as exactly as the wear is interpolated between flank points.
#[test]
fn ver_the_coefficient_comes_back_without_noise() {
    let of = &*LABORATORY;
    for form in [Form::None, Form::Involute, Form::Cubic] {
        let ask = CompareOptions { form: Some(form), ..asked(FitKind::K) };
        let record = of.compare(&of.traces.pinion.file(&of.traces.pinion.heights(&[0.0; POINTS])), &ask);
        let k = k_of(&record);
        println!("{form:?}: {:e} by {} runs, {} cycles", k.value, record.fit.runs, record.fit.mesh_cycles);
        assert!((k.value / TRUE_K - 1.0).abs() < 2e-4, "{form:?}: {k:?}");
        assert!(
            record.fit.runs <= 5 && record.profiles[0].figures.difference_um < 1e-3 * of.traces.pinion.depth_um(),
            "{:?}",
            record.fit
        );
    }
}

/// The coefficient of the measured pinion beside a wheel whose own stays as it is, and beside one that does not wear, where one longer
/// run holds all coefficients.
#[test]
fn ver_the_own_coefficient_of_the_measured_gear_comes_back() {
    for (wheel, most_runs) in [("5e-18", 16), ("0.0", 5)] {
        let of_pinion = |k: f64| {
            let both = format!("coefficient_m2_per_N = {k:e}\n");
            scene(k, 1.0)
                .replace("hours = 127.75", "hours = 15.96875")
                .replace("positions = 100", "positions = 60")
                .replace(&both, &format!("{both}wheel.coefficient_m2_per_N = {wheel}\n"))
        };
        let of = &Laboratory::new(&of_pinion(1e-17), &of_pinion(TRUE_K));
        let record = of.compare(&of.traces.pinion.file(&of.traces.pinion.heights(&[0.0; POINTS])), &asked(FitKind::K));
        let k = k_of(&record);
        println!("wheel {wheel}: {:e} by {} runs", k.value, record.fit.runs);
        assert!((k.value / TRUE_K - 1.0).abs() < 2e-4, "wheel {wheel}: {k:?}");
        assert!(record.fit.how.contains("that of the pinion alone"), "{}", record.fit.how);
        assert!(record.fit.runs <= most_runs, "{:?}", record.fit);
    }
}

/// White noise of 5 % of the greatest depth: the 95 % interval holds the true coefficient for 44 to 50 of 50 seeds.
#[test]
fn ver_the_interval_covers_as_often_as_it_says_white_noise() {
    let of = &*SHORT;
    for form in [Form::None, Form::Cubic] {
        let ask = CompareOptions { form: Some(form), ..asked(FitKind::K) };
        let count = covered(of, &ask, &[0.0; POINTS], |noise| noise.white(POINTS));
        println!("{form:?}: {count} of {SEEDS}");
        assert!((44..=50).contains(&count), "{form:?}: {count}");
    }
}

/// The same where the trace has a form of its own, a cubic of a hundred times the depth, and lies by 0.04 mm beside its place.
#[test]
fn ver_form_and_shift_are_taken_out() {
    let of = &*SHORT;
    let form: Vec<f64> =
        of.traces.pinion.arc_mm.iter().map(|s| 100.0 + 200.0 * s - 60.0 * s * s + 4.0 * s.powi(3)).collect();
    let ask = CompareOptions { shift_within_mm: 0.1, ..asked(FitKind::K) };
    let count = covered(of, &ask, &form, |noise| noise.white(POINTS));
    println!("{count} of {SEEDS}");
    assert!((44..=50).contains(&count), "{count}");

    // Noiseless, the cubic takes nothing of the coefficient; and the same trace 0.04 mm towards the root of where it was taken.
    let z: Vec<f64> = of.traces.pinion.heights(&[0.0; POINTS]).iter().zip(&form).map(|(z, form)| z + form).collect();
    let rows: String = of.traces.pinion.arc_mm.iter().zip(&z).map(|(s, z)| format!("{},{z}\n", s - 0.04)).collect();
    let text = format!("# gear = pinion\n# arc_from = base-circle\narc_mm,height_um\n{rows}");
    let record = of.compare(&text, &ask);
    let (shift, k) = (record.profiles[0].shift_mm.unwrap(), k_of(&record));
    println!("shift {shift:?}, k {k:?}");
    assert!((shift.value - 0.04).abs() < 1e-3 && (k.value / TRUE_K - 1.0).abs() < 5e-3, "{shift:?} {k:?}");
}

/// Noise whose neighbours depend on each other, as of a stylus wider than their distance: the interval is still honest, within
/// what 50 seeds tell, where the textbook's would hold far less often.
#[test]
fn ver_the_interval_covers_as_often_as_it_says_correlated_noise() {
    let of = &*SHORT;
    for rho in [0.5, 0.8] {
        let count = covered(of, &asked(FitKind::K), &[0.0; POINTS], |noise| noise.correlated(POINTS, rho));
        println!("correlation {rho}: {count} of {SEEDS}");
        assert!((43..=50).contains(&count), "{rho}: {count}");
    }
}

/// The severe factor, alone and together with the coefficient. Wear steps are short enough for Euler's method where wear is severe:
/// beyond the stable step wear is no smooth function of what is fitted.
#[test]
fn ver_the_severe_factor_comes_back() {
    let scene = |k: f64, severe: f64| scene(k, severe).replace("19162.5", "4000.0");
    let of = Laboratory::new(&scene(1e-17, 8.0), &scene(1.3e-17, 20.0));
    let record = of.compare(&of.traces.pinion.file(&of.traces.pinion.heights(&[0.0; POINTS])), &asked(FitKind::Both));
    let (k, severe) = (k_of(&record), record.fit.severe_factor.unwrap());
    println!("{k:?} {severe:?}: {} runs, {} cycles, {:?}", record.fit.runs, record.fit.mesh_cycles, record.warnings);
    assert_eq!((record.fit.stopped, record.warnings.len()), (FitStop::Converged, 0), "{:?}", record.warnings);
    assert!((k.value / 1.3e-17 - 1.0).abs() < 1e-3 && (severe.value / 20.0 - 1.0).abs() < 1e-3, "{k:?} {severe:?}");

    let of = Laboratory::new(&scene(1e-17, 8.0), &scene(1e-17, 20.0));
    let noisy = of.compare(
        &of.traces.pinion.file(&of.traces.pinion.heights(&Noise::new(1).white(POINTS))),
        &asked(FitKind::Severe),
    );
    let severe = noisy.fit.severe_factor.unwrap();
    println!("{severe:?}: {} runs", noisy.fit.runs);
    assert!((severe.low.unwrap()..=severe.high.unwrap()).contains(&20.0), "{severe:?}");
    assert!(noisy.fit.coefficients.is_empty());
}

/// Phases of different loads: wear no longer depends on k n alone, and the coefficient still comes back.
#[test]
fn ver_the_coefficient_comes_back_from_phases() {
    let phases = |k: f64| {
        let text = scene(k, 1.0).replace("hours = 127.75\n", "");
        let phases =
            "[[operation.phases]]\nhours = 40.0\npinion_torque_Nm = 200.0\n[[operation.phases]]\nhours = 87.75\n";
        text.replace("[stiffness]\n", &format!("{phases}[stiffness]\n"))
    };
    let of = Laboratory::new(&phases(1e-17), &phases(TRUE_K));
    let record = of.compare(&of.traces.pinion.file(&of.traces.pinion.heights(&[0.0; POINTS])), &asked(FitKind::K));
    let k = k_of(&record);
    println!("{k:?}: {} runs", record.fit.runs);
    assert!((k.value / TRUE_K - 1.0).abs() < 5e-4, "{k:?}");
}

/// Thesis section 4.2: a trace with a cubic form and a known deviation gives that deviation: a wave of amplitude A has 2 A/π.
#[test]
fn val_the_deviation_of_a_trace_with_a_cubic_form() {
    let of = &*LABORATORY;
    let amplitude = 0.8;
    let z: Vec<f64> = wave(&of.traces.pinion.arc_mm, amplitude, 0.4)
        .iter()
        .zip(&of.traces.pinion.arc_mm)
        .map(|(z, s)| z + 500.0 - 320.0 * s + 75.0 * s * s - 6.0 * s.powi(3))
        .collect();
    let record = of.compare(&of.traces.pinion.file(&z), &asked(FitKind::None));
    let sa = record.profiles[0].figures.mean_deviation_um;
    // The thesis states the uncertainty of Sa with about 5 %; the sampling of this one costs less than 1 %.
    assert!((sa / (amplitude * 2.0 / std::f64::consts::PI) - 1.0).abs() < 1e-2, "{sa}");
    // Half a cutoff long, the wave passes the Gaussian filter by 1 − exp(−4 ln 2) = 15/16.
    let ra = record.profiles[0].figures.roughness_um.unwrap();
    assert!((ra / sa - 15.0 / 16.0).abs() < 2e-2, "{ra} {sa}");
}

/// Heights from a line have the curvature of the tooth in them: the same trace, bent by the nominal involute, tells the same.
#[test]
fn ver_heights_from_a_line_tell_the_same() {
    let of = &*LABORATORY;
    let z = of.traces.pinion.heights(&[0.0; POINTS]);
    let r_b = of.base_radius_mm(Gear::Pinion);
    // The involute as a curve in the plane, ρ from the base circle: r_b (cos φ + φ sin φ), r_b (sin φ − φ cos φ).
    let point = |s: f64| {
        let phi: f64 = (2.0 * s / r_b).sqrt();
        [r_b * (phi.cos() + phi * phi.sin()), r_b * (phi.sin() - phi * phi.cos())]
    };
    let (first, last) = (of.traces.pinion.arc_mm[0], of.traces.pinion.arc_mm[POINTS - 1]);
    let (origin, phi) = (point(0.5 * (first + last)), ((first + last) / r_b).sqrt());
    // The tangent at φ points along (cos φ, sin φ); material lies on the side of the tooth's axis, against (−sin φ, cos φ).
    let heights: Vec<f64> = of
        .traces
        .pinion
        .arc_mm
        .iter()
        .zip(&z)
        .map(|(&s, z)| {
            let [x, y] = point(s);
            let out = -((x - origin[0]) * -phi.sin() + (y - origin[1]) * phi.cos());
            1e3 * out + z
        })
        .collect();
    let text = of.traces.pinion.file(&heights).replace("# gear = pinion\n", "# gear = pinion\n# height_from = line\n");
    for form in [Form::Involute, Form::Cubic] {
        let ask = CompareOptions { form: Some(form), ..asked(FitKind::K) };
        let k = k_of(&of.compare(&text, &ask));
        assert!((k.value / TRUE_K - 1.0).abs() < 1e-3, "{form:?}: {k:?}");
    }
}
