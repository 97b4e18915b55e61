//! Wear that wanders, measured with scatter: what measurements say of the wear coefficient, and of wear to come.
//!
//! The exposure S of a gear is how far the run must go with its own coefficient k₀ to wear it as much; both S and the revolutions n of the pinion are
//! over the duration of the run. With the factor κ = k/k₀ it is κ n on the mean. Its logarithm is a Gaussian process, with the mean and covariance of
//! S those of a gamma process, whose increments are independent, with the mean κ Δn and the variance c² κ Δn:
//!
//! ```text
//! S(n) = κ n exp(Z(n) − g(n)/2)        g(n) = ln(1 + c²/(κ n))        cov (Z(n), Z(n')) = g(n'),  n ≤ n'
//! Z(n') = ρ Z(n) + N(0, g(n') (1 − ρ))                                ρ = g(n')/g(n)
//! ln s_i = ln S(n_i) + N(0, r² + r_i²)
//! ```
//!
//! c is the relative standard deviation of the wear at the end of the run under k₀; r that of a measurement, beside what is known of it, r_i. Neither c nor
//! r is known: their priors are half of Student's t with 3 degrees of freedom and the scale [`SCATTER_SCALE`]. κ is lognormal before any measurement.
//!
//! **Computed.** For given κ, c and r everything is Gaussian (Kalman's filter, exact). ln κ has [`FACTORS`] places about the mode of its density for each
//! pair of c and r, which lie on a grid of [`SCATTERS`] by as many, evenly in their logarithms.
//!
//! **Valid** where one coefficient holds: a step in the wear rate is none of the model. The gamma process never decreases, which S here does with the
//! little probability that matters for c near 1 alone.
//!
//! Sources: M. Abdel-Hameed, *A gamma wear process*, IEEE Trans. Reliability 24 (1975) 152–153; J. M. van Noortwijk, *A survey of the application of
//! gamma processes in maintenance*, Reliability Engineering and System Safety 94 (2009) 2–21; G. A. Whitmore, *Estimating degradation by a Wiener
//! diffusion process subject to measurement error*, Lifetime Data Analysis 1 (1995) 307–319; A. Gelman, *Prior distributions for variance parameters in
//! hierarchical models*, Bayesian Analysis 1 (2006) 515–534 (half-t).

use statrs::function::erf::erfc;

/// Scale of the priors of c and r: a tenth.
pub const SCATTER_SCALE: f64 = 0.1;
/// Degrees of freedom of these priors.
pub const SCATTER_FREEDOM: f64 = 3.0;
/// Least and greatest c and r.
pub const SCATTER_RANGE: [f64; 2] = [0.003, 2.0];
/// Places of c, and of r.
const SCATTERS: usize = 13;
/// Places of ln κ for each pair of c and r.
const FACTORS: i32 = 19;
/// Distance of these places in standard deviations.
const FACTOR_STEP: f64 = 0.5;
/// Greatest number of steps of Newton's method to the mode.
const MODE_STEPS: usize = 40;
/// Share of the greatest density over c, or r, below which a place is left out of the finer grid.
const NEGLIGIBLE: f64 = 1e-3;
/// Weight below which a node is left out.
const LIGHTEST: f64 = 1e-9;
/// Halvings of an interval that is searched for a quantile.
const HALVINGS: usize = 60;
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

impl ExposureMeasurement {
    fn ln_revolutions(&self) -> f64 {
        self.revolutions.ln()
    }

    fn ln_exposure(&self) -> f64 {
        self.exposure.ln()
    }
}

/// Normal distribution of the logarithm of κ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FactorPrior {
    /// Mean of ln κ.
    pub mean: f64,
    /// Standard deviation of ln κ.
    pub deviation: f64,
}

/// g = ln(1 + c²/(κ n)): variance of Z, and of ln S for given κ.
fn variance_of_wander(kappa: f64, c: f64, revolutions: f64) -> f64 {
    (c * c / (kappa * revolutions)).ln_1p()
}

/// Z at some revolutions as far as measurements tell: its mean and variance, and g there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Wander {
    mean: f64,
    variance: f64,
    /// g; infinite at the beginning, where nothing is worn.
    prior_variance: f64,
}

impl Wander {
    const AT_BEGINNING: Self = Self { mean: 0.0, variance: 0.0, prior_variance: f64::INFINITY };

    /// Where g has become `prior_variance`.
    fn at(self, prior_variance: f64) -> Self {
        let rho = prior_variance / self.prior_variance;
        Self {
            mean: rho * self.mean,
            variance: rho * rho * self.variance + prior_variance * (1.0 - rho),
            prior_variance,
        }
    }
}

/// Z at the last measurement, and the logarithm of the probability density of all of them, for given ln κ, c and r.
fn filtered(measurements: &[ExposureMeasurement], ln_kappa: f64, c: f64, r: f64) -> (Wander, f64) {
    let (mut wander, mut log_density) = (Wander::AT_BEGINNING, 0.0);
    let kappa = ln_kappa.exp();
    for of in measurements {
        wander = wander.at(variance_of_wander(kappa, c, of.revolutions));
        let noise = r * r + of.relative_sigma * of.relative_sigma;
        let expected = ln_kappa + of.ln_revolutions() - 0.5 * wander.prior_variance + wander.mean;
        let (beside, total) = (of.ln_exposure() - expected, wander.variance + noise);
        log_density -= 0.5 * (total.ln() + beside * beside / total);
        let gain = wander.variance / total;
        wander.mean += gain * beside;
        wander.variance *= 1.0 - gain;
    }
    (wander, log_density)
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
    /// Z at the last measurement.
    wander: Wander,
    /// d mean Z/d ln κ.
    wander_slope: f64,
}

impl Node {
    /// Mean and variance of ln S after `revolutions`; what κ does within the cell is in the variance.
    fn ln_exposure(&self, revolutions: f64) -> (f64, f64) {
        let kappa = self.ln_kappa.exp();
        let g = variance_of_wander(kappa, self.c, revolutions);
        let wander = self.wander.at(g);
        let within = self.cell * (1.0 + g / self.wander.prior_variance * self.wander_slope);
        (self.ln_kappa + revolutions.ln() - 0.5 * g + wander.mean, wander.variance + within * within)
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
        self.below(revolutions, exposure.ln(), |_| 0.0)
    }

    pub fn exposure_quantile(&self, revolutions: f64, probability: f64) -> f64 {
        quantile(probability, |ln_s| self.below(revolutions, ln_s, |_| 0.0))
    }

    /// Probability that a measurement with known `relative_sigma` after `revolutions` finds at most `exposure`.
    pub fn measured_below(&self, revolutions: f64, exposure: f64, relative_sigma: f64) -> f64 {
        self.below(revolutions, exposure.ln(), |r| r * r + relative_sigma * relative_sigma)
    }

    pub fn measured_quantile(&self, revolutions: f64, relative_sigma: f64, probability: f64) -> f64 {
        quantile(probability, |ln_s| {
            self.below(revolutions, ln_s, |r| r * r + relative_sigma * relative_sigma)
        })
    }

    /// Probability that the exposure comes to `limit` within `revolutions` from the beginning.
    pub fn life_below(&self, revolutions: f64, limit: f64) -> f64 {
        1.0 - self.exposure_below(revolutions.max(self.revolutions), limit)
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
        let median = |value: fn(&Node) -> f64| {
            let mut sorted: Vec<(f64, f64)> = self.nodes.iter().map(|node| (value(node), node.weight)).collect();
            sorted.sort_by(|(a, _), (b, _)| a.total_cmp(b));
            let mut sum = 0.0;
            let found = sorted.iter().find(|(_, weight)| {
                sum += weight;
                sum >= 0.5
            });
            found.map_or(f64::NAN, |(value, _)| *value)
        };
        [median(|node| node.c), median(|node| node.r)]
    }

    /// P(ln S ≤ `ln_s`) with a variance of the logarithm added that depends on r.
    fn below(&self, revolutions: f64, ln_s: f64, noise: impl Fn(f64) -> f64) -> f64 {
        self.expected(|node| {
            let (mean, variance) = node.ln_exposure(revolutions);
            normal_below((ln_s - mean) / (variance + noise(node.r)).sqrt())
        })
    }

    fn expected(&self, value: impl Fn(&Node) -> f64) -> f64 {
        self.nodes.iter().map(|node| node.weight * value(node)).sum()
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
    let mut nodes = Vec::with_capacity(SCATTERS * SCATTERS * FACTORS as usize);
    for (c, r) in places(of_c).flat_map(|c| places(of_r).map(move |r| (c.exp(), r.exp()))) {
        over_factors(prior, measurements, (c, r), &mut nodes);
    }
    // Weights are logarithms until here.
    let greatest = nodes.iter().map(|node| node.weight).fold(f64::NEG_INFINITY, f64::max);
    nodes.iter_mut().for_each(|node| node.weight = (node.weight - greatest).exp());
    nodes.retain(|node| node.weight > LIGHTEST);
    let sum: f64 = nodes.iter().map(|node| node.weight).sum();
    nodes.iter_mut().for_each(|node| node.weight /= sum);
    nodes
}

/// Adds the nodes of one pair of c and r, with the logarithms of their weights.
fn over_factors(
    prior: FactorPrior,
    measurements: &[ExposureMeasurement],
    (c, r): (f64, f64),
    nodes: &mut Vec<Node>,
) {
    let (mode, deviation) = mode(prior, measurements, (c, r));
    let step = FACTOR_STEP * deviation;
    let of_scatter = log_scatter_prior(c) + log_scatter_prior(r) + step.ln();
    let first = nodes.len();
    for j in -(FACTORS / 2)..=FACTORS / 2 {
        let ln_kappa = mode + step * f64::from(j);
        let (wander, log_density) = filtered(measurements, ln_kappa, c, r);
        let weight = log_density + prior.log_density(ln_kappa) + of_scatter;
        // A value evenly within a cell has its width over √12 as standard deviation.
        nodes.push(Node { weight, ln_kappa, cell: step / 12f64.sqrt(), c, r, wander, wander_slope: 0.0 });
    }
    let means: Vec<f64> = nodes[first..].iter().map(|node| node.wander.mean).collect();
    for (i, node) in nodes[first..].iter_mut().enumerate() {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(means.len() - 1));
        node.wander_slope = (means[after] - means[before]) / (step * (after - before) as f64);
    }
}

impl FactorPrior {
    fn log_density(self, ln_kappa: f64) -> f64 {
        -0.5 * ((ln_kappa - self.mean) / self.deviation).powi(2)
    }
}

/// Mode of ln κ for given c and r, and the standard deviation of the normal density of the same curvature, by Newton's method on differences.
fn mode(prior: FactorPrior, measurements: &[ExposureMeasurement], (c, r): (f64, f64)) -> (f64, f64) {
    let Some(last) = measurements.last() else { return (prior.mean, prior.deviation) };
    let log_density = |x: f64| filtered(measurements, x, c, r).1 + prior.log_density(x);
    let variance = c * c / last.exposure + r * r + last.relative_sigma * last.relative_sigma;
    let mut x = (last.exposure / last.revolutions).ln();
    let mut deviation = (1.0 / (1.0 / variance + 1.0 / (prior.deviation * prior.deviation))).sqrt();
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
