//! Synthetic specimens: wear that wanders as a gamma process, measured with scatter.

use std::f64::consts::TAU;

use fastrand::Rng;
use gearwear_studies::remaining_life::wear_process::{
    ExposureMeasurement, FactorPrior, SCATTER_FREEDOM, SCATTER_RANGE, SCATTER_SCALE,
};

/// Steps in which a specimen is worn on to its limit, as a share of its mean life.
const STEP: f64 = 2e-3;

/// What is true of a specimen.
#[derive(Debug, Clone, Copy)]
pub struct Truth {
    pub kappa: f64,
    /// Relative standard deviation of the wear at the end of the run.
    pub wander: f64,
    /// Relative standard deviation of a measurement.
    pub scatter: f64,
}

impl Truth {
    /// Drawn from the priors.
    pub fn drawn(prior: FactorPrior, random: &mut Rng) -> Self {
        let kappa = (prior.mean + prior.deviation * normal(random)).exp();
        Self { kappa, wander: half_t(random), scatter: half_t(random) }
    }
}

/// Standard normal number (Box and Muller).
pub fn normal(random: &mut Rng) -> f64 {
    (-2.0 * (1.0 - random.f64()).ln()).sqrt() * (TAU * random.f64()).cos()
}

/// Size of a number after Student's t with the freedom and scale of the scatters, within their range.
fn half_t(random: &mut Rng) -> f64 {
    loop {
        let square: f64 = (0..SCATTER_FREEDOM as usize).map(|_| normal(random).powi(2)).sum();
        let value = SCATTER_SCALE * (normal(random) / (square / SCATTER_FREEDOM).sqrt()).abs();
        if (SCATTER_RANGE[0]..=SCATTER_RANGE[1]).contains(&value) {
            return value;
        }
    }
}

/// Gamma distributed number (Marsaglia and Tsang, ACM Trans. Math. Softw. 26 (2000) 363–372).
pub fn gamma(shape: f64, scale: f64, random: &mut Rng) -> f64 {
    if shape < 1.0 {
        return gamma(shape + 1.0, scale, random) * (1.0 - random.f64()).powf(1.0 / shape);
    }
    let d = shape - 1.0 / 3.0;
    let c = 1.0 / (9.0 * d).sqrt();
    loop {
        let x = normal(random);
        let v = (1.0 + c * x).powi(3);
        if v > 0.0 && (1.0 - random.f64()).ln() < 0.5 * x * x + d - d * v + d * v.ln() {
            return d * v * scale;
        }
    }
}

/// When specimens are measured.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    /// Over the time at which the limit is reached on the mean.
    pub times: &'static [f64],
    /// Known relative standard deviation of a measurement.
    pub relative_sigma: f64,
}

/// A specimen that was measured, and what came of it.
#[derive(Debug, Clone)]
pub struct Specimen {
    pub measurements: Vec<ExposureMeasurement>,
    /// Revolutions over those of the run at which the exposure is that of the limit.
    pub life: f64,
}

impl Specimen {
    /// Worn and measured as planned, then worn on to the exposure 1; `rate` is the factor on the wear rate at an exposure.
    pub fn new(truth: Truth, plan: &Plan, rate: impl Fn(f64) -> f64, random: &mut Rng) -> Self {
        let mean_life = 1.0 / truth.kappa;
        let c2 = truth.wander * truth.wander;
        let (mut exposure, mut at, mut life) = (0.0, 0.0, f64::INFINITY);
        let mut measurements = Vec::new();
        for time in plan.times {
            exposure += gamma(truth.kappa * (time * mean_life - at) * rate(exposure) / c2, c2, random);
            at = time * mean_life;
            if exposure >= 1.0 {
                life = life.min(at);
            }
            let noise = truth.scatter.hypot(plan.relative_sigma) * normal(random);
            let relative_sigma = plan.relative_sigma;
            measurements.push(ExposureMeasurement {
                revolutions: at,
                exposure: exposure * noise.exp(),
                relative_sigma,
            });
        }
        while exposure < 1.0 {
            exposure += gamma(STEP * rate(exposure) / c2, c2, random);
            at += STEP * mean_life;
        }
        Self { measurements, life: life.min(at) }
    }
}
