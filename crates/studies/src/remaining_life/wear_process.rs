//! Wear that wanders, measured with scatter: what measurements say of the wear coefficient, and of wear to come.
//!
//! The exposure S of a gear is how far the run must go with its own coefficient k₀ to wear it as much; both S and the revolutions n of the pinion are
//! over the duration of the run. With the factor κ = k/k₀ it is κ n on the mean. About this mean it wanders as a gamma process, whose increments are
//! independent and never negative, and a measurement scatters by a factor about it:
//!
//! ```text
//! S(n + Δ) − S(n) ~ Gamma        mean κ Δ,   variance c² κ Δ
//! ln s_i = ln S(n_i) + N(0, r² + r_i²)
//! ```
//!
//! c is the relative standard deviation of the wear at the end of the run under k₀; r that of a measurement, beside what is known of it, r_i. Neither c nor
//! r is known: their priors are half of Student's t with 3 degrees of freedom and the scale [`SCATTER_SCALE`]. κ is lognormal before any measurement.
//!
//! **Computed.** For given κ, c and r the three first cumulants of S follow by addition; S is taken as a constant plus a gamma distributed number with the
//! same cumulants, which is exact up to the first measurement and from a perfect one on. A measurement changes them by quadrature ([`Wear::measured`]).
//! ln κ has [`FACTORS`] places about the mode of its density for each pair of c and r, which lie on a grid of [`SCATTERS`] by as many, evenly in their
//! logarithms, and a second grid where the first has found them likely.
//!
//! **Valid** where one coefficient holds: a step in the wear rate is none of the model.
//!
//! Sources: M. Abdel-Hameed, *A gamma wear process*, IEEE Trans. Reliability 24 (1975) 152–153; J. M. van Noortwijk, *A survey of the application of
//! gamma processes in maintenance*, Reliability Engineering and System Safety 94 (2009) 2–21; G. A. Whitmore, *Estimating degradation by a Wiener
//! diffusion process subject to measurement error*, Lifetime Data Analysis 1 (1995) 307–319; E. B. Wilson and M. M. Hilferty, *The distribution of
//! chi-square*, Proc. Nat. Acad. Sci. 17 (1931) 684–688; A. Gelman, *Prior distributions for variance parameters in
//! hierarchical models*, Bayesian Analysis 1 (2006) 515–534 (half-t).

use rayon::prelude::*;
use statrs::function::erf::erfc;
use statrs::function::gamma::ln_gamma;

/// Scale of the priors of c and r. Repeated wear tests scatter by 40 to 60 % (A. Flodin, KTH 2000), two standard deviations; a third each of their variance for
/// the specimen, the wander of its wear, and its measurement: 25 %/√3.
pub const SCATTER_SCALE: f64 = 0.15;
/// Degrees of freedom of these priors.
pub const SCATTER_FREEDOM: f64 = 3.0;
/// Least and greatest c and r.
pub const SCATTER_RANGE: [f64; 2] = [0.003, 2.0];
/// Places of c, and of r.
const SCATTERS: usize = 9;
/// Places of ln κ for each pair of c and r.
const FACTORS: i32 = 11;
/// Distance of these places in standard deviations.
const FACTOR_STEP: f64 = 0.8;
/// Places of the quadrature over S.
const GAMMA_NODES: usize = 11;
/// Distance of these places in standard deviations.
const GAMMA_STEP: f64 = 1.0;
/// Greatest shape of a gamma distribution, beyond which it is normal.
const MOST_SHAPE: f64 = 1e5;
/// Greatest number of steps of Newton's method to the mode.
const MODE_STEPS: usize = 40;
/// Share of the greatest density over c, or r, below which a place is left out of the finer grid.
const NEGLIGIBLE: f64 = 1e-3;
/// Weight below which a node is left out.
const LIGHTEST: f64 = 1e-5;
/// Halvings of an interval that is searched for a quantile.
const HALVINGS: usize = 36;
/// Range of the logarithm of a quantile about that of the run.
const LOG_RANGE: f64 = 60.0;

/// A measurement as exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExposureMeasurement {
    /// Revolutions of the pinion over those of the run, above 0, rising from one to the next, or the same.
    pub revolutions: f64,
    /// Exposure s over the revolutions of the run, above 0.
    pub exposure: f64,
    /// Known relative standard deviation r_i of the exposure.
    pub relative_sigma: f64,
}

/// Normal distribution of the logarithm of κ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FactorPrior {
    /// Mean of ln κ.
    pub mean: f64,
    /// Standard deviation of ln κ.
    pub deviation: f64,
}

/// S as far as measurements tell, by its first three cumulants: a gamma distributed number times θ, of shape a, and a constant.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Wear {
    mean: f64,
    variance: f64,
    /// Third central moment.
    third: f64,
}

impl Wear {
    const NONE: Self = Self { mean: 0.0, variance: 0.0, third: 0.0 };

    /// After `more` revolutions with the factor `kappa` and the wander `c`.
    fn after(self, more: f64, kappa: f64, c: f64) -> Self {
        let (mean, c2) = (kappa * more, c * c);
        Self { mean: self.mean + mean, variance: self.variance + c2 * mean, third: self.third + 2.0 * c2 * c2 * mean }
    }

    /// Shape a, scale θ and constant; nearly symmetric distributions have a greatest shape.
    fn shifted_gamma(self) -> (f64, f64, f64) {
        let shape = (4.0 * self.variance.powi(3) / (self.third * self.third)).min(MOST_SHAPE);
        let scale = (self.variance / shape).sqrt();
        (shape, scale, self.mean - shape * scale)
    }

    /// With a measurement of logarithm `ln_s` and variance `noise` of that logarithm, and the logarithm of its probability density.
    ///
    /// Quadrature over v = ln((S − constant)/θ), in which a gamma density is smooth, about the mode of the product.
    fn measured(self, ln_s: f64, noise: f64) -> (Self, f64) {
        let (shape, scale, constant) = self.shifted_gamma();
        let (mode, deviation) = mode_of_measured((shape, scale, constant), ln_s, noise);
        let step = GAMMA_STEP * deviation;
        let mut nodes = [(0.0, 0.0); GAMMA_NODES];
        let (mut v, ratio) = (mode - step * (GAMMA_NODES / 2) as f64, step.exp());
        let mut next = v.exp();
        for node in &mut nodes {
            let x = next;
            let wear = constant + scale * x;
            let beside = ln_s - wear.ln();
            let log_density =
                if wear > 0.0 { shape * v - x - 0.5 * beside * beside / noise } else { f64::NEG_INFINITY };
            *node = (wear, log_density);
            (v, next) = (v + step, next * ratio);
        }
        let greatest = nodes.iter().map(|node| node.1).fold(f64::NEG_INFINITY, f64::max);
        nodes.iter_mut().for_each(|node| node.1 = (node.1 - greatest).exp());
        let sum: f64 = nodes.iter().map(|node| node.1).sum();
        let mean = nodes.iter().map(|(wear, weight)| wear * weight).sum::<f64>() / sum;
        let moment =
            |power: i32| nodes.iter().map(|(wear, weight)| (wear - mean).powi(power) * weight).sum::<f64>() / sum;
        let log_density = greatest + (sum * step).ln() - ln_gamma(shape) - 0.5 * noise.ln();
        (Self { mean, variance: moment(2), third: moment(3).max(0.0) }, log_density)
    }

    /// P(S ≤ `wear`), after Wilson and Hilferty: the cube root of a gamma distributed number is nearly normal.
    fn below(self, wear: f64) -> f64 {
        let (shape, scale, constant) = self.shifted_gamma();
        let x = (wear - constant) / (shape * scale);
        if x <= 0.0 {
            return 0.0;
        }
        normal_below((x.cbrt() - 1.0 + 1.0 / (9.0 * shape)) * 3.0 * shape.sqrt())
    }

    /// Mean and variance of a normal distribution of ln S with the median of S.
    fn of_logarithm(self) -> (f64, f64) {
        let (shape, scale, constant) = self.shifted_gamma();
        let median = constant + shape * scale * (1.0 - 1.0 / (9.0 * shape)).max(0.1).powi(3);
        let variance = (self.variance / (self.mean * self.mean)).ln_1p();
        (if median > 0.0 { median.ln() } else { self.mean.ln() - 0.5 * variance }, variance)
    }
}

/// Mode of the product of a gamma density over v and a measurement, and the standard deviation of the normal density of the same curvature.
fn mode_of_measured((shape, scale, constant): (f64, f64, f64), ln_s: f64, noise: f64) -> (f64, f64) {
    let mut v = shape.ln();
    let from_s = (ln_s.exp() - constant) / scale;
    if from_s > 0.0 {
        // Weighted as two normal densities of v would be.
        let share = (from_s * scale / ln_s.exp()).powi(2) / noise;
        v += (from_s.ln() - v) * share / (share + shape);
    }
    // S is above 0.
    let least = if constant < 0.0 { (-constant / scale).ln() + 1e-9 } else { f64::NEG_INFINITY };
    let mut deviation = 1.0;
    for _ in 0..MODE_STEPS {
        v = v.max(least);
        let x = v.exp();
        let wear = constant + scale * x;
        let (part, beside) = (scale * x / wear, ln_s - wear.ln());
        let slope = shape - x + beside * part / noise;
        let certain = x + part * part / noise;
        let curvature = certain - beside * part * (1.0 - part) / noise;
        let curvature = if curvature > 0.0 { curvature } else { certain };
        deviation = 1.0 / curvature.sqrt();
        let step = (slope / curvature).clamp(-2.0, 2.0);
        v += step;
        if step.abs() < 0.02 * deviation {
            break;
        }
    }
    (v.max(least), deviation)
}

/// S at the last measurement, and the logarithm of the probability density of all of them, for given ln κ, c and r.
fn filtered(measurements: &[ExposureMeasurement], ln_kappa: f64, c: f64, r: f64) -> (Wear, f64) {
    let (mut wear, mut log_density, mut at) = (Wear::NONE, 0.0, 0.0);
    let kappa = ln_kappa.exp();
    for of in measurements {
        let noise = r * r + of.relative_sigma * of.relative_sigma;
        let (after, density) = wear.after(of.revolutions - at, kappa, c).measured(of.exposure.ln(), noise);
        (wear, at) = (after, of.revolutions);
        log_density += density;
    }
    (wear, log_density)
}

/// Logarithm of the prior density of ln c or ln r.
fn log_scatter_prior(value: f64) -> f64 {
    let square = (value / SCATTER_SCALE).powi(2) / SCATTER_FREEDOM;
    value.ln() - 0.5 * (SCATTER_FREEDOM + 1.0) * square.ln_1p()
}

/// One combination of κ, c and r with its probability.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    weight: f64,
    ln_kappa: f64,
    /// Standard deviation of ln κ within the cell of the node.
    cell: f64,
    c: f64,
    r: f64,
    /// S at the last measurement.
    wear: Wear,
    /// d mean S/d ln κ.
    wear_slope: f64,
}

impl Node {
    /// S at `more` revolutions later; what κ does within the cell is in its variance.
    fn wear_after(&self, more: f64) -> Wear {
        let kappa = self.ln_kappa.exp();
        let wear = self.wear.after(more, kappa, self.c);
        let within = self.cell * (self.wear_slope + kappa * more);
        Wear { variance: wear.variance + within * within, ..wear }
    }
}

/// What is known after some measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Posterior {
    nodes: Vec<Node>,
    /// When the last measurement was made, over the revolutions of the run.
    pub revolutions: f64,
}

impl Posterior {
    /// After `measurements` in the order of their times; without any, the prior.
    pub fn new(prior: FactorPrior, measurements: &[ExposureMeasurement]) -> Self {
        let box_of_all = [SCATTER_RANGE; 2].map(|ends| ends.map(f64::ln));
        let coarse = nodes_in(prior, measurements, box_of_all);
        let finer = [0, 1].map(|side| where_likely(&coarse, side, box_of_all[side]));
        let nodes = if finer == box_of_all { coarse } else { nodes_in(prior, measurements, finer) };
        let revolutions = measurements.last().map_or(0.0, |last| last.revolutions);
        Self { nodes, revolutions }
    }

    /// Probability that κ is at most `kappa`.
    pub fn factor_below(&self, kappa: f64) -> f64 {
        self.expected(|node| normal_below((kappa.ln() - node.ln_kappa) / node.cell))
    }

    pub fn factor_quantile(&self, probability: f64) -> f64 {
        quantile(probability, |ln_kappa| self.factor_below(ln_kappa.exp()))
    }

    /// Probability that the exposure after `revolutions`, at or after the last measurement, is at most `exposure`.
    pub fn exposure_below(&self, revolutions: f64, exposure: f64) -> f64 {
        let more = revolutions - self.revolutions;
        self.expected(|node| node.wear_after(more).below(exposure))
    }

    pub fn exposure_quantile(&self, revolutions: f64, probability: f64) -> f64 {
        quantile(probability, |ln_s| self.exposure_below(revolutions, ln_s.exp()))
    }

    /// What a measurement with known `relative_sigma` after `revolutions` is expected to find.
    pub fn measured(&self, revolutions: f64, relative_sigma: f64) -> ExpectedMeasurement {
        let more = revolutions - self.revolutions;
        let normals = self.nodes.iter().map(|node| {
            let (mean, variance) = node.wear_after(more).of_logarithm();
            let noise = node.r * node.r + relative_sigma * relative_sigma;
            (node.weight, mean, (variance + noise).sqrt())
        });
        ExpectedMeasurement { normals: normals.collect() }
    }

    /// Probability that the exposure comes to `limit` within `revolutions` from the beginning.
    pub fn life_below(&self, revolutions: f64, limit: f64) -> f64 {
        (1.0 - self.exposure_below(revolutions.max(self.revolutions), limit)).max(0.0)
    }

    /// Revolutions left until the exposure comes to `limit`; 0 where it has come to it with this probability.
    pub fn remaining_quantile(&self, limit: f64, probability: f64) -> f64 {
        if self.life_below(self.revolutions, limit) >= probability {
            return 0.0;
        }
        quantile(probability, |ln_more| self.life_below(self.revolutions + ln_more.exp(), limit))
    }

    /// Median c, and r.
    pub fn scatter_medians(&self) -> [f64; 2] {
        [self.median(|node| node.c), self.median(|node| node.r)]
    }

    /// Median of a quantity on a grid even in its logarithm, with the probability of a place spread over its cell.
    fn median(&self, value: fn(&Node) -> f64) -> f64 {
        let mut sums: Vec<(f64, f64)> = Vec::new();
        for node in &self.nodes {
            let ln_value = value(node).ln();
            match sums.iter_mut().find(|(place, _)| *place == ln_value) {
                Some((_, sum)) => *sum += node.weight,
                None => sums.push((ln_value, node.weight)),
            }
        }
        sums.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let cell = sums.windows(2).map(|ends| ends[1].0 - ends[0].0).fold(f64::INFINITY, f64::min);
        let mut below = 0.0;
        for (place, weight) in sums {
            if below + weight >= 0.5 {
                let within = if cell.is_finite() { cell * ((0.5 - below) / weight - 0.5) } else { 0.0 };
                return (place + within).exp();
            }
            below += weight;
        }
        f64::NAN
    }

    fn expected(&self, value: impl Fn(&Node) -> f64) -> f64 {
        self.nodes.iter().map(|node| node.weight * value(node)).sum()
    }
}

/// Distribution of a measurement to come.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpectedMeasurement {
    /// Probability, mean and standard deviation of the logarithm of its exposure, for each κ, c and r.
    normals: Vec<(f64, f64, f64)>,
}

impl ExpectedMeasurement {
    /// Probability that it finds at most `exposure`.
    pub fn below(&self, exposure: f64) -> f64 {
        let ln_s = exposure.ln();
        self.normals.iter().map(|(weight, mean, deviation)| weight * normal_below((ln_s - mean) / deviation)).sum()
    }

    pub fn quantile(&self, probability: f64) -> f64 {
        quantile(probability, |ln_s| self.below(ln_s.exp()))
    }
}

/// Φ(z).
fn normal_below(z: f64) -> f64 {
    0.5 * erfc(-z * std::f64::consts::FRAC_1_SQRT_2)
}

/// exp x with `below`(x) = `probability`.
fn quantile(probability: f64, below: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (-LOG_RANGE, LOG_RANGE);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if below(middle) < probability { low = middle } else { high = middle }
    }
    (0.5 * (low + high)).exp()
}

/// Places from `low` to `high`, evenly.
fn places([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..SCATTERS).map(move |i| low + (high - low) * i as f64 / (SCATTERS - 1) as f64)
}

/// Nodes over ln c and ln r in a box, weights of sum 1.
fn nodes_in(prior: FactorPrior, measurements: &[ExposureMeasurement], [of_c, of_r]: [[f64; 2]; 2]) -> Vec<Node> {
    let rows: Vec<f64> = places(of_c).map(f64::exp).collect();
    let rows: Vec<Vec<Node>> = rows.into_par_iter().map(|c| over_scatters(prior, measurements, c, of_r)).collect();
    let mut nodes = rows.concat();
    // Weights are logarithms until here.
    let greatest = nodes.iter().map(|node| node.weight).fold(f64::NEG_INFINITY, f64::max);
    nodes.iter_mut().for_each(|node| node.weight = (node.weight - greatest).exp());
    nodes.retain(|node| node.weight > LIGHTEST);
    let sum: f64 = nodes.iter().map(|node| node.weight).sum();
    nodes.iter_mut().for_each(|node| node.weight /= sum);
    nodes
}

/// Nodes of one c over ln r, with the logarithms of their weights.
fn over_scatters(prior: FactorPrior, measurements: &[ExposureMeasurement], c: f64, of_r: [f64; 2]) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(SCATTERS * FACTORS as usize);
    let mut start = None;
    for r in places(of_r).map(f64::exp) {
        let found = mode(prior, measurements, (c, r), start);
        over_factors(prior, measurements, (c, r), found, &mut nodes);
        start = Some(found);
    }
    nodes
}

/// Adds the nodes of one pair of c and r about the mode of ln κ, with the logarithms of their weights.
fn over_factors(
    prior: FactorPrior,
    measurements: &[ExposureMeasurement],
    (c, r): (f64, f64),
    (mode, deviation): (f64, f64),
    nodes: &mut Vec<Node>,
) {
    let step = FACTOR_STEP * deviation;
    let of_scatter = log_scatter_prior(c) + log_scatter_prior(r) + step.ln();
    let first = nodes.len();
    for j in -(FACTORS / 2)..=FACTORS / 2 {
        let ln_kappa = mode + step * f64::from(j);
        let (wear, log_density) = filtered(measurements, ln_kappa, c, r);
        let weight = log_density + prior.log_density(ln_kappa) + of_scatter;
        // A value evenly within a cell has its width over √12 as standard deviation.
        nodes.push(Node { weight, ln_kappa, cell: step / 12f64.sqrt(), c, r, wear, wear_slope: 0.0 });
    }
    let means: Vec<f64> = nodes[first..].iter().map(|node| node.wear.mean).collect();
    for (i, node) in nodes[first..].iter_mut().enumerate() {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(means.len() - 1));
        node.wear_slope = (means[after] - means[before]) / (step * (after - before) as f64);
    }
}

impl FactorPrior {
    fn log_density(self, ln_kappa: f64) -> f64 {
        -0.5 * ((ln_kappa - self.mean) / self.deviation).powi(2)
    }
}

/// Mode of ln κ for given c and r, and the standard deviation of the normal density of the same curvature, by Newton's method on differences
/// from `start`, where a neighbour has them.
fn mode(
    prior: FactorPrior,
    measurements: &[ExposureMeasurement],
    (c, r): (f64, f64),
    start: Option<(f64, f64)>,
) -> (f64, f64) {
    let Some(last) = measurements.last() else { return (prior.mean, prior.deviation) };
    let log_density = |x: f64| filtered(measurements, x, c, r).1 + prior.log_density(x);
    let noise = r * r + last.relative_sigma * last.relative_sigma;
    let variance = c * c / last.exposure + noise / measurements.len() as f64;
    // As two normal densities of ln κ would have it.
    let [of_measured, of_prior] = [variance, prior.deviation * prior.deviation].map(f64::recip);
    let middle = of_measured * (last.exposure / last.revolutions).ln() + of_prior * prior.mean;
    let guess = (middle / (of_measured + of_prior), (of_measured + of_prior).sqrt().recip());
    let (mut x, mut deviation) = start.unwrap_or(guess);
    for _ in 0..MODE_STEPS {
        let h = 0.5 * deviation;
        let [before, here, after] = [x - h, x, x + h].map(log_density);
        let (slope, curvature) = ((after - before) / (2.0 * h), (after - 2.0 * here + before) / (h * h));
        let newton = if curvature < 0.0 { -slope / curvature } else { f64::INFINITY * slope.signum() };
        let step = newton.clamp(-2.0 * deviation, 2.0 * deviation);
        if curvature < 0.0 {
            deviation = (1.0 / (-curvature).sqrt()).clamp(0.2 * deviation, 5.0 * deviation).min(prior.deviation);
        }
        x += step;
        if step.abs() < 0.05 * deviation {
            break;
        }
    }
    (x, deviation)
}

/// Ends between which c (`side` 0) or r (1) has nearly all its density, one place more at each; the old ends where that is most of them.
fn where_likely(nodes: &[Node], side: usize, ends: [f64; 2]) -> [f64; 2] {
    let all: Vec<f64> = places(ends).collect();
    let mut sums = vec![0.0; all.len()];
    let step = all[1] - all[0];
    for node in nodes {
        let value = [node.c, node.r][side].ln();
        sums[((value - all[0]) / step).round() as usize] += node.weight;
    }
    let greatest = sums.iter().copied().fold(0.0, f64::max);
    let likely = |sum: &f64| *sum > NEGLIGIBLE * greatest;
    let first = sums.iter().position(likely).unwrap_or(0).saturating_sub(1);
    let last = (sums.iter().rposition(likely).unwrap_or(all.len() - 1) + 1).min(all.len() - 1);
    if last - first + 1 >= all.len() - 2 { ends } else { [all[first], all[last]] }
}
