//! Coverage of the intervals of wear coefficient and remaining life on synthetic specimens.

mod specimen;

use fastrand::Rng;
use gearwear_studies::remaining_life::wear_process::{FactorPrior, Posterior};
use specimen::{Specimen, Truth};

/// Coefficients within a factor of 100 of that of the run, 95 %.
const PRIOR: FactorPrior = FactorPrior { mean: 0.0, deviation: 2.3496 };
const SPECIMENS: usize = 1000;

/// Shares of specimens whose true coefficient, and life, lie within their 95 % and 50 % intervals.
fn coverage(
    specimens: usize,
    times: &[f64],
    relative_sigma: f64,
    truth: impl Fn(&mut Rng) -> Truth,
    rate: impl Fn(f64) -> f64 + Copy,
) -> [[f64; 2]; 2] {
    let mut random = Rng::with_seed(1);
    let mut inside = [[0usize; 2]; 2];
    let mut lives = 0usize;
    for _ in 0..specimens {
        let truth = truth(&mut random);
        let specimen = Specimen::new(truth, times, 1.0, relative_sigma, rate, &mut random);
        let posterior = Posterior::new(PRIOR, &specimen.measurements);
        let of_k = posterior.factor_below(truth.kappa);
        let mut found = vec![(0, of_k)];
        if specimen.life > posterior.revolutions {
            lives += 1;
            found.push((1, posterior.life_below(specimen.life, 1.0)));
        }
        for (which, below) in found {
            inside[which][0] += usize::from((0.025..=0.975).contains(&below));
            inside[which][1] += usize::from((0.25..=0.75).contains(&below));
        }
    }
    [inside[0].map(|n| n as f64 / specimens as f64), inside[1].map(|n| n as f64 / lives as f64)]
}

#[test]
fn survey() {
    for (name, times, sigma) in [
        ("three", &[0.1, 0.2, 0.4][..], 0.0),
        ("eight", &[0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6], 0.0),
    ] {
        let start = std::time::Instant::now();
        println!("{name} {:?} {:?}", coverage(500, times, sigma, |random| Truth::drawn(PRIOR, random), |_| 1.0), start.elapsed());
    }
}
