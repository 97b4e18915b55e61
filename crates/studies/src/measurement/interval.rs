//! Uncertainty of the parameters of a fit, from its residuals.
//!
//! Neighbouring points of a trace are not independent: the tip is wider than their distance, and what the model does not describe is smooth.
//! With the influence w_i = −J N of the residuals of a profile on the parameter θ_i, N = (Σ JᵀJ)⁻¹ over the profiles,
//!
//! ```text
//! white noise       v_i = |r|²/(n − q) |w_i|²                    ν_i = n − q
//! correlated noise  P(|t| √v_im ≤ h_i) = 0.95                    over the spectra m and their probabilities, v_i = exp ⟨ln v_im⟩,
//!                                                                ν_i with t(0.975, ν_i) √v_i = h_i
//! θ_i ± t(0.975, ν_i) √v_i
//! ```
//!
//! with t Student's, and q the number of values fitted to a profile: columns of its form and of its waves ([`super::waviness`]), and its leverage
//! tr (N JᵀJ), which together for all profiles is the number of parameters. Residuals are white noise where that is the more probable
//! half ([`super::correlation`]), and the interval then is the textbook's. Residuals and J are those of the sum of squares that was made least,
//! weighted where profiles are. The covariance of two parameters is Σ w_ik w_jk S_k of the spectra by their probabilities. Of several profiles the
//! variances are added, with the degrees of freedom of Welch and Satterthwaite,
//!
//! ```text
//! ν_i   = v_i²/Σ (v_ip²/ν_ip),     v_i = Σ v_ip
//! ```
//!
//! The mean of n teeth has the scatter between them too: with the deviations d_t of the tooth t, form removed, each parameter moves by
//! g_t = w · d_t, and
//!
//! ```text
//! cov θ  gains  Σ_t g_t g_tᵀ/(n (n − 1))         with n − 1 degrees of freedom
//! ```
//!
//! so that noise of the teeth counts a little more than once. The interval stands for scatter alone: what is wrong alike at all points
//! (load, hours, a wrong law) is not in it.
//!
//! Sources: G. A. F. Seber and C. J. Wild, *Nonlinear Regression* (1989), chapters 5 and 6; F. E. Satterthwaite, *An approximate distribution of estimates of
//! variance components*, Biometrics Bulletin 2 (1946) 110–114.

use std::ops::Range;

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::correlation::{Cosines, FittedSpectrum, IS_WHITE, in_cosines, probabilities};
use super::fit::{dot, inverse_normal_matrix};

/// Probability that the interval holds.
pub const CONFIDENCE: f64 = 0.95;
/// Probability below which a spectrum is left out.
const NEGLIGIBLE: f64 = 1e-4;
/// Greatest number of degrees of freedom that is told from more.
const MOST_FREEDOM: f64 = 1e6;
/// Halvings of an interval that is searched.
const HALVINGS: usize = 60;

/// Part of the residuals that one profile has.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfilePart {
    /// Number of points.
    pub points: usize,
    /// Orthonormal columns fitted to them beside the parameters: those of the form and of waves.
    pub also_fitted: Vec<Vec<f64>>,
    /// Deviations of the teeth whose mean the profile is; none of a single tooth.
    pub teeth: Vec<Vec<f64>>,
}

/// Scatter of the residuals of one profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Points that count: n times the variance of the first parameter of the profile with independent residuals, over that with
    /// these.
    pub effective_points: f64,
    /// ν of that parameter.
    pub degrees_of_freedom: f64,
    /// √v/|w|: standard deviation of a point, times the root of the number of points correlated with it.
    pub deviation: f64,
}

/// Uncertainty of fitted parameters.
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

/// Uncertainty from `residuals` with the columns `jacobian`, profile after profile as in `parts`; `None` where too few points of a profile
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
    let mut noise: Vec<PartNoise> = Vec::with_capacity(parts.len());
    let mut not_yet_fitted = count as f64;
    for (index, (part, rows)) in parts.iter().zip(&rows).enumerate() {
        let leverage = match index + 1 == parts.len() {
            true => not_yet_fitted,
            false => (0..count).map(|i| dot(&jacobian[i][rows.clone()], &influence[i][rows.clone()])).sum(),
        };
        not_yet_fitted -= leverage;
        let own: Vec<&[f64]> = jacobian.iter().map(|column| &column[rows.clone()]).collect();
        let influence: Vec<&[f64]> = influence.iter().map(|of| &of[rows.clone()]).collect();
        noise.push(PartNoise::new(&residuals[rows.clone()], part, &own, leverage, &influence)?);
    }
    let moves: Vec<Vec<Vec<f64>>> = influence.iter().map(|own| tooth_moves(own, parts, &rows)).collect();
    let sources = |i: usize, j: usize| {
        let of_noise = noise.iter().map(|of| of.covariance(i, j));
        let of_teeth = moves[i].iter().zip(&moves[j]).map(|(a, b)| dot(a, b) / (a.len() * (a.len() - 1)) as f64);
        of_noise.chain(of_teeth).collect::<Vec<f64>>()
    };
    let mut deviations = Vec::with_capacity(count);
    let mut half_widths = Vec::with_capacity(count);
    for (i, own) in moves.iter().enumerate() {
        let variances = sources(i, i);
        let of_teeth = own.iter().map(|of| of.len() as f64 - 1.0);
        let freedom: Vec<f64> = noise.iter().map(|of| of.freedom[i]).chain(of_teeth).collect();
        let deviation = variances.iter().sum::<f64>().sqrt();
        deviations.push(deviation);
        half_widths.push(quantile(degrees_of_freedom(&variances, &freedom))? * deviation);
    }
    let scatter = noise.iter().map(PartNoise::scatter).collect::<Option<_>>()?;
    let mut correlation = vec![vec![1.0; count]; count];
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))).filter(|(i, j)| i != j) {
        let covariance: f64 = sources(i, j).iter().sum();
        correlation[i][j] = covariance / (deviations[i] * deviations[j]);
    }
    Some(FitUncertainty { scatter, half_widths, deviations, correlation })
}

/// g_t of each profile that is the mean of some teeth: by how much the deviations of each tooth move the parameter with this `influence`.
fn tooth_moves(influence: &[f64], parts: &[ProfilePart], rows: &[Range<usize>]) -> Vec<Vec<f64>> {
    let means = parts.iter().zip(rows).filter(|(part, _)| part.teeth.len() > 1);
    means.map(|(part, rows)| part.teeth.iter().map(|own| -dot(&influence[rows.clone()], own)).collect()).collect()
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

/// What the residuals of one profile say of every parameter.
struct PartNoise {
    points: f64,
    /// |r|²/(n − q).
    white_variance: f64,
    /// |w_i|².
    influence_squares: Vec<f64>,
    /// v_i on the diagonal, and covariances.
    covariances: Vec<Vec<f64>>,
    /// ν_i.
    freedom: Vec<f64>,
}

impl PartNoise {
    /// From the residuals of a profile, the rows of J and of the influences that are its own; `None` where too few points are left.
    fn new(
        residuals: &[f64],
        part: &ProfilePart,
        jacobian: &[&[f64]],
        leverage: f64,
        influence: &[&[f64]],
    ) -> Option<Self> {
        let points = residuals.len() as f64;
        let white_freedom = points - part.also_fitted.len() as f64 - leverage;
        if white_freedom < 1.0 {
            return None;
        }
        let white_variance = dot(residuals, residuals) / white_freedom;
        let products = |variance: f64| -> Vec<Vec<f64>> {
            influence.iter().map(|a| influence.iter().map(|b| variance * dot(a, b)).collect()).collect()
        };
        let influence_squares = influence.iter().map(|of| dot(of, of)).collect();
        let also = part.also_fitted.iter().map(Vec::as_slice);
        let cosines =
            Cosines::new(residuals, also.chain(jacobian.iter().copied().filter(|column| dot(column, column) > 0.0)));
        // Smooth spectra say nothing of the longest waves, which are fitted: their strength there would be a guess.
        let spectra: Vec<FittedSpectrum> = cosines.spectra().into_iter().filter(|of| !of.is_smooth).collect();
        let probability = probabilities(&spectra);
        if probability.first().is_none_or(|&white| white > IS_WHITE) {
            let freedom = vec![white_freedom; influence.len()];
            return Some(Self {
                points,
                white_variance,
                influence_squares,
                covariances: products(white_variance),
                freedom,
            });
        }
        let likely: Vec<(f64, &FittedSpectrum)> =
            probability.into_iter().zip(&spectra).filter(|(probability, _)| *probability > NEGLIGIBLE).collect();
        let parts: Vec<Vec<f64>> = influence.iter().map(|of| in_cosines(of)).collect();
        let of_spectrum = |of: &FittedSpectrum, i: usize, j: usize| {
            let products = parts[i].iter().zip(&parts[j]).zip(&of.shape);
            of.variance * products.map(|((a, b), s)| a * b * s).sum::<f64>()
        };
        let mean = |i: usize, j: usize| likely.iter().map(|(p, of)| p * of_spectrum(of, i, j)).sum::<f64>();
        // Of each parameter, √(v_i/⟨v_im⟩) and ν_i.
        let (mut scales, mut freedom) = (Vec::with_capacity(influence.len()), Vec::with_capacity(influence.len()));
        let student = StudentsT::new(0.0, 1.0, cosines.freedom()).ok()?;
        for i in 0..influence.len() {
            let variances: Vec<(f64, f64)> = likely.iter().map(|&(p, of)| (p, of_spectrum(of, i, i))).collect();
            if variances.iter().any(|(_, variance)| *variance <= 0.0) {
                scales.push(1.0);
                freedom.push(white_freedom);
                continue;
            }
            let whole: f64 = variances.iter().map(|(p, _)| p).sum();
            let middle = (variances.iter().map(|(p, v)| p * v.ln()).sum::<f64>() / whole).exp();
            let outside = |half: f64| {
                let parts = variances.iter().map(|(p, v)| 2.0 * p * student.cdf(-half / v.sqrt()));
                parts.sum::<f64>() / whole
            };
            let widest = variances.iter().map(|(_, v)| v.sqrt()).fold(0.0, f64::max);
            let half =
                root(|half| outside(half) - (1.0 - CONFIDENCE), 0.0, widest * quantile(cosines.freedom())? * 2.0);
            scales.push((middle / mean(i, i)).sqrt());
            freedom.push(freedom_of(half / middle.sqrt())?);
        }
        let covariances = scales.iter().enumerate().map(|(i, a)| {
            let row = scales.iter().enumerate().map(|(j, b)| a * b * mean(i, j));
            row.collect()
        });
        let covariances = covariances.collect();
        Some(Self { points, white_variance, influence_squares, covariances, freedom })
    }

    fn covariance(&self, i: usize, j: usize) -> f64 {
        self.covariances[i][j]
    }

    /// Scatter by the first parameter that the profile has a part in.
    fn scatter(&self) -> Option<Scatter> {
        let first = self.influence_squares.iter().position(|&square| square > 0.0)?;
        let square = self.covariances[first][first] / self.influence_squares[first];
        Some(Scatter {
            effective_points: self.points * (self.white_variance / square).min(1.0),
            degrees_of_freedom: self.freedom[first],
            deviation: square.sqrt(),
        })
    }
}

/// Where a falling function is 0.
fn root(falling: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if falling(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// t(0.975, ν).
pub(crate) fn quantile(freedom: f64) -> Option<f64> {
    Some(StudentsT::new(0.0, 1.0, freedom).ok()?.inverse_cdf(0.5 + 0.5 * CONFIDENCE))
}

/// ν with this quantile, from 1 to [`MOST_FREEDOM`].
fn freedom_of(wanted: f64) -> Option<f64> {
    let ends = [quantile(1.0)?, quantile(MOST_FREEDOM)?];
    if wanted >= ends[0] || wanted <= ends[1] {
        return Some(if wanted >= ends[0] { 1.0 } else { MOST_FREEDOM });
    }
    let logarithm = root(|log| quantile(log.exp()).unwrap_or(0.0) - wanted, 0.0, MOST_FREEDOM.ln());
    Some(logarithm.exp())
}

/// ν_i after Welch and Satterthwaite, of variances with these degrees of freedom each.
fn degrees_of_freedom(variances: &[f64], freedom: &[f64]) -> f64 {
    let whole: f64 = variances.iter().sum();
    let parts = variances.iter().zip(freedom).map(|(v, freedom)| (v / whole).powi(2) / freedom);
    parts.sum::<f64>().recip()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::form::{Form, FormRemoval};

    /// A sum of waves without correlation between neighbours: every second point of the opposite sign, and of all signs in turn.
    fn alternating(count: usize) -> Vec<f64> {
        (0..count).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect()
    }

    /// Uncertainty where all residuals are of one profile.
    fn of_one(jacobian: &[Vec<f64>], residuals: &[f64], also_fitted: usize) -> Option<FitUncertainty> {
        let n = residuals.len();
        let columns = (0..also_fitted).map(|k| {
            let column = (0..n).map(|i| (std::f64::consts::PI * k as f64 * (i as f64 + 0.5) / n as f64).cos());
            let column: Vec<f64> = column.collect();
            let length = dot(&column, &column).sqrt();
            column.iter().map(|value| value / length).collect()
        });
        uncertainty(
            jacobian,
            residuals,
            &[ProfilePart { points: n, also_fitted: columns.collect(), teeth: Vec::new() }],
        )
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
    fn too_few_points_give_no_interval_and_smooth_residuals_a_wide_one() {
        assert_eq!(of_one(&[vec![1.0; 4]], &alternating(4), 4), None);
        assert_eq!(of_one(&[vec![0.0; 20]], &alternating(20), 0), None);
        let places: Vec<f64> = (0..100).map(f64::from).collect();
        let removal = FormRemoval::new(Form::Involute, &places);
        let left = |values: Vec<f64>| {
            let mut values = values;
            removal.remove(&mut values);
            values
        };
        let smooth = left(places.iter().map(|i| (i * 0.15).cos()).collect());
        let bend = left(places.iter().map(|i| (i / 100.0).powi(2)).collect());
        let found = |residuals: &[f64]| {
            let also_fitted = removal.columns().to_vec();
            let part = ProfilePart { points: 100, also_fitted, teeth: Vec::new() };
            uncertainty(std::slice::from_ref(&bend), residuals, &[part]).unwrap()
        };
        let [wide, narrow] = [smooth, left(alternating(100))].map(|residuals| found(&residuals));
        assert!(wide.half_widths[0] > narrow.half_widths[0], "{wide:?} {narrow:?}");
        assert!(wide.scatter[0].effective_points < 50.0, "{wide:?}");
    }

    /// The mean of teeth that differ among each other by more than their points do: t(0.975, 2) s/√3.
    #[test]
    fn ver_the_scatter_between_teeth_counts() {
        let teeth = [-2.0, -1.0, 3.0].map(|height| vec![height; 40]).to_vec();
        let part = ProfilePart { points: 40, also_fitted: Vec::new(), teeth };
        let residuals: Vec<f64> = alternating(40).iter().map(|r| 1e-3 * r).collect();
        let found = uncertainty(&[vec![1.0; 40]], &residuals, &[part]).unwrap();
        let deviation = (14.0f64 / 6.0).sqrt();
        assert!((found.deviations[0] / deviation - 1.0).abs() < 1e-6);
        assert!((found.half_widths[0] / (4.303 * deviation) - 1.0).abs() < 1e-3, "{found:?}");
    }

    /// Two means, each of a profile of its own: Welch's problem. Their difference has the variance s₁²/n₁ + s₂²/n₂, and neither knows of
    /// the other.
    #[test]
    fn ver_two_means_are_welchs_problem() {
        let parts = [10, 40].map(|points| ProfilePart { points, also_fitted: Vec::new(), teeth: Vec::new() });
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
        assert!((degrees_of_freedom(&[2.0, 2.0], &[9.0, 9.0]) - 18.0).abs() < 1e-12);
        assert!((degrees_of_freedom(&[2.0, 0.0], &[9.0, 9.0]) - 9.0).abs() < 1e-12);
    }
}
