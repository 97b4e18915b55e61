//! Fitting wear coefficients to synthetic profiles: what goes in comes out, and the interval holds as often as it says.

mod laboratory;

use gearwear::compare::question::{Asked, FitKind};
use gearwear::measurement::fit::FitStop;
use gearwear::measurement::form::Form;
use laboratory::{Laboratory, Noise, POINTS, asked, wave};

/// fzg-c at coarse resolution, with a wear coefficient and a severe factor above 1600 MPa.
fn scene(coefficient: f64, severe_factor: f64) -> String {
    format!(
        "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\nhours = 127.75\n\
         [stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = {coefficient:e}\n\
         severe = {{ above_MPa = 1600.0, factor = {severe_factor:?}, band_MPa = 200.0 }}\n\
         [numerics]\nflank_points = 200\npositions = 100\nstep = {{ revolutions = 19162.5 }}\nerror_estimate = false\n"
    )
}

const TRUE_K: f64 = 1.7e-17;
const SEEDS: u64 = 100;

fn laboratory() -> Laboratory {
    Laboratory::new(&scene(1e-17, 1.0), &scene(TRUE_K, 1.0))
}

/// Heights of the trace with noise of 5 % of the greatest depth.
fn heights(of: &Laboratory, noise: &[f64]) -> Vec<f64> {
    let depth = of.depth_um();
    of.wear_um.iter().zip(noise).map(|(wear, noise)| -wear + 0.05 * depth * noise).collect()
}

/// How many of the seeds have the true coefficient in their interval, by what `noise` makes of each and with `more` added.
fn covered(of: &Laboratory, ask: &Asked, more: &[f64], noise: impl Fn(&mut Noise) -> Vec<f64>) -> usize {
    (0..SEEDS)
        .filter(|&seed| {
            let mut z = heights(of, &noise(&mut Noise::new(seed)));
            z.iter_mut().zip(more).for_each(|(z, more)| *z += more);
            let record = of.compare(&of.file(&z), ask);
            assert_eq!(record.fit.stopped, FitStop::Converged, "seed {seed}");
            let k = record.fit.coefficient_m2_per_N.unwrap();
            (k.low.unwrap()..=k.high.unwrap()).contains(&TRUE_K)
        })
        .count()
}

/// Without noise the coefficient comes back as exactly as the wear is interpolated between flank points.
#[test]
fn ver_the_coefficient_comes_back_without_noise() {
    let of = laboratory();
    for form in [Form::None, Form::Involute, Form::Cubic] {
        let ask = Asked { form: Some(form), ..asked(FitKind::K) };
        let record = of.compare(&of.file(&heights(&of, &[0.0; POINTS])), &ask);
        let k = record.fit.coefficient_m2_per_N.unwrap();
        println!("{form:?}: {:e} by {} runs, {} cycles", k.value, record.fit.runs, record.fit.mesh_cycles);
        assert!((k.value / TRUE_K - 1.0).abs() < 2e-4, "{form:?}: {k:?}");
        assert!(record.fit.runs <= 5 && record.figures.difference_um < 1e-3 * of.depth_um(), "{:?}", record.fit);
    }
}

/// White noise of 5 % of the greatest depth: the 95 % interval holds the true coefficient for 90 to 100 of 100 seeds.
#[test]
fn ver_the_interval_covers_as_often_as_it_says_white_noise() {
    let of = laboratory();
    for form in [Form::None, Form::Cubic] {
        let ask = Asked { form: Some(form), ..asked(FitKind::K) };
        let count = covered(&of, &ask, &[0.0; POINTS], |noise| noise.white(POINTS));
        println!("{form:?}: {count} of {SEEDS}");
        assert!((90..=100).contains(&count), "{form:?}: {count}");
    }
}
