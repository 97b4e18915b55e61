//! FitUncertainty of the parameters of a fit, from its residuals.
//!
//! Neighbouring points of a stylus trace are not independent: the tip is wider than their distance, and what the model does
//! not describe is smooth. With ρ_k the autocorrelation of the residuals of a profile at a distance of k points,
//!
//! ```text
//! τ     = 1 + 2 Σ ρ_k            until the sum of two neighbouring ρ_k is no longer positive
//! n_eff = n/τ                    points that count
//! ν     = n_eff − q
//! σ²    = |r|²/n · n_eff/ν
//! cov θ = N [Σ σ² τ JᵀJ] N       over the profiles, each with its own σ and τ;      N = (Σ JᵀJ)⁻¹
//! θ_i   ± t(0.975, ν_i) √(cov θ)_ii
//! ρ_ij  = (cov θ)_ij/√((cov θ)_ii (cov θ)_jj)
//! ```
//!
//! with t Student's and q the number of values fitted to a profile: those of its form, and its leverage tr (N JᵀJ), which together for all
//! profiles is the number of parameters. Residuals and J are those of the sum of squares that was made least, weighted where profiles
//! are. For one profile and independent residuals τ is 1, cov θ is σ² N, and this is the textbook's interval. ν_i is ν for one
//! profile; for several it is that of Welch and Satterthwaite,
//!
//! ```text
//! ν_i   = v_i²/Σ (v_ip²/ν_p),     v_ip = (N [σ² τ JᵀJ]_p N)_ii,     v_i = Σ v_ip = (cov θ)_ii
//! ```
//!
//! Fitting q values takes correlation away from the residuals; what it takes at a distance of k points is
//! about q τ σ²/n, and is put back before the sum is made. The interval stands for scatter alone: what is wrong alike at all points
//! (load, hours, a wrong law) is not in it.
//!
//! Sources: G. A. F. Seber and C. J. Wild, *Nonlinear Regression* (1989), chapters 5 and 6; C. J. Geyer, *Practical Markov chain Monte
//! Carlo*, Statistical Science 7 (1992) 473–483, for where the sum ends; F. E. Satterthwaite, *An approximate distribution of estimates of
//! variance components*, Biometrics Bulletin 2 (1946) 110–114.

use std::ops::Range;

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::fit::{dot, inverse_normal_matrix};

/// Probability that the interval holds.
pub const CONFIDENCE: f64 = 0.95;
/// Rounds in which the autocorrelation is corrected for what the fit has taken.
const ROUNDS: usize = 20;

/// Part of the residuals that one profile has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProfilePart {
    /// Number of points.
    pub points: usize,
    /// Values fitted to them beside the parameters: those of the form.
    pub also_fitted: usize,
}

/// Scatter of the residuals of one profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// n_eff: points that count.
    pub effective_points: f64,
    /// ν = n_eff − q.
    pub degrees_of_freedom: f64,
    /// σ √τ: standard deviation of a point, times the root of the number of points correlated with it.
    pub deviation: f64,
}

/// FitUncertainty of fitted parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct FitUncertainty {
    /// Scatter of each profile.
    pub scatter: Vec<Scatter>,
    /// Half the width of each parameter's interval.
    pub half_widths: Vec<f64>,
    /// Standard deviation of each parameter.
    pub deviations: Vec<f64>,
    /// Correlation coefficients of the parameters, row by row.
    pub correlation: Vec<Vec<f64>>,
}

impl FitUncertainty {
    /// Half the width of the interval of θ_i − θ_j, with the fewer degrees of freedom of both.
    pub fn half_width_of_difference(&self, i: usize, j: usize) -> f64 {
        let [a, b] = [i, j].map(|index| self.deviations[index]);
        let quantile = [i, j].map(|index| self.half_widths[index] / self.deviations[index]);
        let variance = a * a + b * b - 2.0 * self.correlation[i][j] * a * b;
        quantile[0].max(quantile[1]) * variance.max(0.0).sqrt()
    }
}

/// FitUncertainty from `residuals` with the columns `jacobian`, profile after profile as in `parts`; `None` where too few points of a profile
/// count for an interval, or parameters are not determined.
pub fn uncertainty(jacobian: &[Vec<f64>], residuals: &[f64], parts: &[ProfilePart]) -> Option<FitUncertainty> {
    let count = jacobian.len();
    let inverse = inverse_normal_matrix(jacobian)?;
    // J N, column by column: the part of each residual in each parameter.
    let influence: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            let rows = 0..residuals.len();
            rows.map(|row| (0..count).map(|j| jacobian[j][row] * inverse[(j, i)]).sum()).collect()
        })
        .collect();

    let rows = rows(parts);
    let mut scatter: Vec<Scatter> = Vec::with_capacity(parts.len());
    let mut not_yet_fitted = count as f64;
    for (index, (part, rows)) in parts.iter().zip(&rows).enumerate() {
        let leverage = match index + 1 == parts.len() {
            true => not_yet_fitted,
            false => (0..count).map(|i| dot(&jacobian[i][rows.clone()], &influence[i][rows.clone()])).sum(),
        };
        not_yet_fitted -= leverage;
        scatter.push(scatter_of(&residuals[rows.clone()], part.also_fitted as f64 + leverage)?);
    }
    let mut deviations = Vec::with_capacity(count);
    let mut half_widths = Vec::with_capacity(count);
    for own in &influence {
        let variances = covariances(own, own, &rows, &scatter);
        let student = StudentsT::new(0.0, 1.0, degrees_of_freedom(&variances, &scatter)).ok()?;
        let deviation = variances.iter().sum::<f64>().sqrt();
        deviations.push(deviation);
        half_widths.push(student.inverse_cdf(0.5 + 0.5 * CONFIDENCE) * deviation);
    }
    let mut correlation = vec![vec![1.0; count]; count];
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))).filter(|(i, j)| i != j) {
        let covariance: f64 = covariances(&influence[i], &influence[j], &rows, &scatter).iter().sum();
        correlation[i][j] = covariance / (deviations[i] * deviations[j]);
    }
    Some(FitUncertainty { scatter, half_widths, deviations, correlation })
}

/// Part of each profile in the covariance of the parameters with these `influence`s.
fn covariances(one: &[f64], other: &[f64], rows: &[Range<usize>], scatter: &[Scatter]) -> Vec<f64> {
    let profiles = rows.iter().zip(scatter);
    profiles.map(|(rows, scatter)| scatter.deviation.powi(2) * dot(&one[rows.clone()], &other[rows.clone()])).collect()
}

/// Range of the residuals of each profile.
fn rows(parts: &[ProfilePart]) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::with_capacity(parts.len());
    for part in parts {
        let start = ranges.last().map_or(0, |range| range.end);
        ranges.push(start..start + part.points);
    }
    ranges
}

/// Scatter of the residuals of a profile to which `fitted` values were fitted; `None` where too few points count.
fn scatter_of(residuals: &[f64], fitted: f64) -> Option<Scatter> {
    let points = residuals.len() as f64;
    let time = correlation_points(residuals, fitted);
    let effective_points = points / time;
    let degrees_of_freedom = effective_points - fitted;
    if degrees_of_freedom < 1.0 {
        return None;
    }
    let variance = dot(residuals, residuals) / points * effective_points / degrees_of_freedom;
    Some(Scatter { effective_points, degrees_of_freedom, deviation: (variance * time).sqrt() })
}

/// ν_i after Welch and Satterthwaite.
fn degrees_of_freedom(variances: &[f64], scatter: &[Scatter]) -> f64 {
    let whole: f64 = variances.iter().sum();
    let parts = variances.iter().zip(scatter).map(|(v, s)| (v / whole).powi(2) / s.degrees_of_freedom);
    parts.sum::<f64>().recip()
}

/// Autocorrelation of residuals at a distance of `k` points, over their sum of `squares`.
fn autocorrelation(residuals: &[f64], k: usize, squares: f64) -> f64 {
    residuals.iter().zip(&residuals[k..]).map(|(a, b)| a * b).sum::<f64>() / squares
}

/// τ: number of neighbouring points correlated with one, itself included, at least 1. `fitted` values were fitted to the residuals.
fn correlation_points(residuals: &[f64], fitted: f64) -> f64 {
    let n = residuals.len();
    let square = dot(residuals, residuals);
    if n < 4 || square <= 0.0 {
        return 1.0;
    }
    let mut time = 1.0_f64;
    for _ in 0..ROUNDS {
        // Of γ_k, σ²ρ_k less about q τ σ²/n is left; of γ_0, σ² (1 − q τ/n).
        let taken = (fitted * time / n as f64).min(0.9);
        let mut sum = 1.0;
        let mut k = 1;
        while k + 1 < n {
            let [rho, next_rho] = [k, k + 1].map(|k| (1.0 - taken) * autocorrelation(residuals, k, square) + taken);
            // The first pair is ρ_1 and ρ_2: white residuals end here.
            if rho + next_rho - 2.0 * taken <= 0.0 || rho <= 0.0 {
                break;
            }
            sum += 2.0 * rho.max(0.0) + 2.0 * next_rho.max(0.0);
            k += 2;
        }
        let next = sum.clamp(1.0, n as f64);
        let settled = (next - time).abs() < 1e-3 * time;
        time = next;
        if settled {
            break;
        }
    }
    time
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum of waves without correlation between neighbours: every second point of the opposite sign, and of all signs in turn.
    fn alternating(count: usize) -> Vec<f64> {
        (0..count).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect()
    }

    /// FitUncertainty where all residuals are of one profile.
    fn of_one(jacobian: &[Vec<f64>], residuals: &[f64], also_fitted: usize) -> Option<FitUncertainty> {
        uncertainty(jacobian, residuals, &[ProfilePart { points: residuals.len(), also_fitted }])
    }

    /// The mean of n independent values: σ²/n with n − 1 degrees of freedom. t(0.975, 9) = 2.262 in any table.
    #[test]
    fn val_the_mean_of_ten_values() {
        let column = vec![vec![1.0; 10]];
        let found = of_one(&column, &alternating(10), 0).unwrap();
        assert_eq!(found.scatter[0].effective_points, 10.0);
        let deviation = (10.0_f64 / 9.0 / 10.0).sqrt();
        assert!((found.deviations[0] / deviation - 1.0).abs() < 1e-12);
        assert!((found.half_widths[0] / (2.262 * deviation) - 1.0).abs() < 1e-3);
    }

    /// Each value repeated m times counts once: n/m points, whatever is said m times.
    #[test]
    fn ver_repeated_values_count_once() {
        // Signs of a linear congruential generator (Numerical Recipes): no correlation of neighbours.
        let mut state = 1u32;
        let signs: Vec<f64> = (0..400)
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                if state >> 31 == 0 { 1.0 } else { -1.0 }
            })
            .collect();
        let repeated: Vec<f64> = signs.iter().flat_map(|&s| [s; 10]).collect();
        let once = of_one(&[vec![1.0; 400]], &signs, 0).unwrap();
        let tenfold = of_one(&[vec![1.0; 4000]], &repeated, 0).unwrap();
        let count = tenfold.scatter[0].effective_points;
        assert!((0.5..2.0).contains(&(count / 400.0)), "{count}");
        // The textbook's interval would be √10 times too narrow.
        assert!((0.7..1.5).contains(&(tenfold.half_widths[0] / once.half_widths[0])), "{tenfold:?} {once:?}");
    }

    #[test]
    fn too_few_points_that_count_give_no_interval() {
        let smooth: Vec<f64> = (0..100).map(|i| (f64::from(i) * 0.03).cos()).collect();
        assert_eq!(of_one(&[vec![1.0; 100]], &smooth, 4), None);
        assert_eq!(of_one(&[vec![1.0; 4]], &alternating(4), 4), None);
        assert_eq!(of_one(&[vec![0.0; 20]], &alternating(20), 0), None);
    }

    /// Two means, each of a profile of its own: Welch's problem. Their difference has the variance s₁²/n₁ + s₂²/n₂, and neither knows of
    /// the other.
    #[test]
    fn ver_two_means_are_welchs_problem() {
        let parts = [ProfilePart { points: 10, also_fitted: 0 }, ProfilePart { points: 40, also_fitted: 0 }];
        let residuals = [alternating(10), alternating(40).iter().map(|r| 3.0 * r).collect()].concat();
        let apart = uncertainty(
            &[[[1.0; 10].as_slice(), &[0.0; 40]].concat(), [[0.0; 10].as_slice(), &[1.0; 40]].concat()],
            &residuals,
            &parts,
        )
        .unwrap();
        let variances = [10.0 / 9.0 / 10.0, 9.0 * 40.0 / 39.0 / 40.0];
        for (deviation, variance) in apart.deviations.iter().zip(variances) {
            assert!((deviation * deviation / variance - 1.0).abs() < 1e-12);
        }
        assert_eq!(apart.correlation, [[1.0, 0.0], [0.0, 1.0]]);

        // The same by their sum and difference: θ₁ = (a + b)/2, θ₂ = (a − b)/2 have equal variances, a quarter of the sum of both, and
        // the correlation (s_a² − s_b²)/(s_a² + s_b²).
        let turned = uncertainty(
            &[[[1.0; 10].as_slice(), &[1.0; 40]].concat(), [[1.0; 10].as_slice(), &[-1.0; 40]].concat()],
            &residuals,
            &parts,
        )
        .unwrap();
        let sum = variances[0] + variances[1];
        assert!(turned.deviations.iter().all(|deviation| (deviation * deviation / (0.25 * sum) - 1.0).abs() < 1e-12));
        assert!((turned.correlation[0][1] - (variances[0] - variances[1]) / sum).abs() < 1e-12, "{turned:?}");
        // θ₁ − θ₂ = b, with the fewer degrees of freedom of θ₁ and θ₂ in place of the 39 of b.
        let t = turned.half_widths[0] / turned.deviations[0];
        let half = turned.half_width_of_difference(0, 1);
        assert!((half / (t * variances[1].sqrt()) - 1.0).abs() < 1e-12, "{turned:?}");
    }

    /// Welch, Biometrika 34 (1947) 28–35: ν = (Σ v)²/Σ (v²/ν); of equal parts with 9 degrees of freedom each 18, of one alone its own.
    #[test]
    fn val_degrees_of_freedom_after_welch_and_satterthwaite() {
        let scatter =
            [9.0, 9.0].map(|degrees_of_freedom| Scatter { effective_points: 10.0, degrees_of_freedom, deviation: 1.0 });
        assert!((degrees_of_freedom(&[2.0, 2.0], &scatter) - 18.0).abs() < 1e-12);
        assert!((degrees_of_freedom(&[2.0, 0.0], &scatter) - 9.0).abs() < 1e-12);
    }
}
