//! What the residuals of a fit say of its parameters.
//!
//! Neighbouring points of a stylus trace are not independent: the tip is wider than their distance, and what the model does
//! not describe is smooth. With ρ_k the autocorrelation of the residuals at a distance of k points,
//!
//! ```text
//! τ     = 1 + 2 Σ ρ_k            until the sum of two neighbouring ρ_k is no longer positive
//! n_eff = n/τ                    points that count
//! σ²    = |r|²/n · n_eff/(n_eff − q)
//! cov θ = σ² τ (JᵀJ)⁻¹
//! θ     ± t(0.975, n_eff − q) √cov θ
//! ```
//!
//! with q the number of fitted values, those of the form included, and t Student's. For independent residuals τ is 1 and this is
//! the textbook's interval. Fitting q values takes correlation away from the residuals; what it takes at a distance of k points is
//! about q τ σ²/n, and is put back before the sum is made. The interval stands for scatter alone: what is wrong alike at all points
//! (load, hours, a wrong law) is not in it.
//!
//! Source: G. A. F. Seber and C. J. Wild, *Nonlinear Regression* (1989), chapters 5 and 6; C. J. Geyer, *Practical Markov chain Monte
//! Carlo*, Statistical Science 7 (1992) 473–483, for where the sum ends.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::fit::inverse_normal_matrix;

/// Probability that the interval holds.
pub(crate) const CONFIDENCE: f64 = 0.95;
/// Rounds in which the autocorrelation is corrected for what the fit has taken.
const ROUNDS: usize = 20;

/// What the residuals of a fit say.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Uncertainty {
    /// n_eff: points that count.
    pub effective_points: f64,
    /// n_eff − q.
    pub degrees_of_freedom: f64,
    /// σ: standard deviation of a point.
    pub standard_deviation: f64,
    /// Half the width of each parameter's interval.
    pub half_widths: Vec<f64>,
    /// Standard deviation of each parameter.
    pub deviations: Vec<f64>,
}

/// What `residuals` with the columns `jacobian` say, `also_fitted` values having been taken from them besides; `None` where too
/// few points count for an interval, or parameters are not determined.
pub(crate) fn uncertainty(jacobian: &[Vec<f64>], residuals: &[f64], also_fitted: usize) -> Option<Uncertainty> {
    let points = residuals.len() as f64;
    let fitted = (jacobian.len() + also_fitted) as f64;
    let time = correlation_points(residuals, fitted);
    let effective_points = points / time;
    let degrees_of_freedom = effective_points - fitted;
    if degrees_of_freedom < 1.0 {
        return None;
    }
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    let variance = square / points * effective_points / degrees_of_freedom;
    let inverse = inverse_normal_matrix(jacobian)?;
    let student = StudentsT::new(0.0, 1.0, degrees_of_freedom).ok()?;
    let quantile = student.inverse_cdf(0.5 + 0.5 * CONFIDENCE);
    let deviations: Vec<f64> = (0..jacobian.len()).map(|i| (variance * time * inverse[(i, i)]).sqrt()).collect();
    Some(Uncertainty {
        effective_points,
        degrees_of_freedom,
        standard_deviation: variance.sqrt(),
        half_widths: deviations.iter().map(|deviation| quantile * deviation).collect(),
        deviations,
    })
}

/// τ: how many neighbouring points say what one says, at least 1. `fitted` values were taken from the residuals.
fn correlation_points(residuals: &[f64], fitted: f64) -> f64 {
    let n = residuals.len();
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    if n < 4 || square <= 0.0 {
        return 1.0;
    }
    let raw = |k: usize| residuals.iter().zip(&residuals[k..]).map(|(a, b)| a * b).sum::<f64>() / square;
    let mut time = 1.0_f64;
    for _ in 0..ROUNDS {
        // Of γ_k, σ²ρ_k less about q τ σ²/n is left; of γ_0, σ² (1 − q τ/n).
        let taken = (fitted * time / n as f64).min(0.9);
        let rho = |k: usize| (1.0 - taken) * raw(k) + taken;
        let mut sum = 1.0;
        let mut k = 1;
        while k + 1 < n {
            let two = rho(k) + rho(k + 1);
            // The first pair is that of ρ_1 alone with ρ_2: white residuals end here.
            if two - 2.0 * taken <= 0.0 || rho(k) <= 0.0 {
                break;
            }
            sum += 2.0 * rho(k).max(0.0) + 2.0 * rho(k + 1).max(0.0);
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

    /// The mean of n independent values: σ²/n with n − 1 degrees of freedom. t(0.975, 9) = 2.262 in any table.
    #[test]
    fn val_the_mean_of_ten_values() {
        let column = vec![vec![1.0; 10]];
        let found = uncertainty(&column, &alternating(10), 0).unwrap();
        assert_eq!(found.effective_points, 10.0);
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
        let column = |n: usize| vec![vec![1.0; n]];
        let once = uncertainty(&column(400), &signs, 0).unwrap();
        let tenfold = uncertainty(&column(4000), &repeated, 0).unwrap();
        assert!((0.5..2.0).contains(&(tenfold.effective_points / 400.0)), "{}", tenfold.effective_points);
        // The textbook's interval would be √10 times too narrow.
        assert!((0.7..1.5).contains(&(tenfold.half_widths[0] / once.half_widths[0])), "{tenfold:?} {once:?}");
    }

    #[test]
    fn too_few_points_that_count_give_no_interval() {
        let smooth: Vec<f64> = (0..100).map(|i| (f64::from(i) * 0.03).cos()).collect();
        assert_eq!(uncertainty(&[vec![1.0; 100]], &smooth, 4), None);
        assert_eq!(uncertainty(&[vec![1.0; 4]], &alternating(4), 4), None);
        assert_eq!(uncertainty(&[vec![0.0; 20]], &alternating(20), 0), None);
    }
}
