//! Least squares in a few bounded parameters, by Levenberg and Marquardt's method ([`levenberg_marquardt`](gearwear_bodies::reference::levenberg_marquardt)).
//!
//! J is found by central differences, and steps are cut at the bounds. Parameters are logarithms of positive quantities, or lengths: each has the
//! width of its differences, which is also the measure of a step that no longer matters.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use gearwear_bodies::reference::levenberg_marquardt::{
    LeastSquares, LevenbergMarquardt, Minimum, sum_of_squares as square,
};

/// A step shorter than this part of the width of the differences ends the search.
const SMALL_STEP: f64 = 1e-4;
/// Settings of the search.
const SEARCH: LevenbergMarquardt = LevenbergMarquardt {
    most_steps: 60,
    damping_decrease: 0.1,
    least_damping: 1e-12,
    most_damping: 1e12,
    settled: 0.0,
};
/// A parameter whose column of J, times the width of its differences, is shorter than this part of r is not determined.
const NO_EFFECT: f64 = 1e-12;

/// r(θ), or why it cannot be computed.
pub type Residuals<'a, E> = dyn FnMut(&[f64]) -> Result<Vec<f64>, E> + 'a;

/// A parameter to fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Where the search begins.
    pub start: f64,
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub greatest: f64,
    /// Width of the differences.
    pub width: f64,
}

/// Why the search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FitStop {
    /// A minimum was found.
    Converged,
    /// Too many iterations.
    MaxIterations,
    /// A parameter has no effect on the residuals.
    Undetermined,
    /// The least sum of squares is at the bound of a parameter.
    AtBound,
    /// The residuals are not numbers.
    NotFinite,
}

/// Result of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedParameters {
    /// θ.
    pub parameters: Vec<f64>,
    /// r(θ).
    pub residuals: Vec<f64>,
    /// Columns of J at θ.
    pub jacobian: Vec<Vec<f64>>,
    /// Why the search ended.
    pub stop: FitStop,
    /// Parameter that is not determined or at a bound.
    pub blamed: Option<usize>,
}

/// Residuals as a function of bounded parameters.
struct BoundedResiduals<'a, 'f, E> {
    parameters: &'a [Parameter],
    residuals: &'a mut Residuals<'f, E>,
}

impl<E> LeastSquares for BoundedResiduals<'_, '_, E> {
    type Error = E;
    type Jacobian = Vec<Vec<f64>>;

    fn residuals(&mut self, theta: &[f64]) -> Result<Vec<f64>, E> {
        (self.residuals)(theta)
    }

    /// Central differences, one-sided at a bound.
    fn jacobian(&mut self, theta: &[f64], _: &[f64]) -> Result<Vec<Vec<f64>>, E> {
        let mut columns = Vec::with_capacity(theta.len());
        let mut moved = theta.to_vec();
        for (i, p) in self.parameters.iter().enumerate() {
            let [low, high] = [-p.width, p.width].map(|by| (theta[i] + by).clamp(p.least, p.greatest));
            moved[i] = low;
            let below = (self.residuals)(&moved)?;
            moved[i] = high;
            let above = (self.residuals)(&moved)?;
            moved[i] = theta[i];
            let span = (high - low).max(f64::MIN_POSITIVE);
            columns.push(below.iter().zip(&above).map(|(a, b)| (b - a) / span).collect());
        }
        Ok(columns)
    }

    fn damped_step(&self, theta: &[f64], r: &[f64], jacobian: &Vec<Vec<f64>>, damping: f64) -> Option<Vec<f64>> {
        let step = newton_step(jacobian, r, damping)?;
        let bounded = self.parameters.iter().zip(theta.iter().zip(&step));
        let next: Vec<f64> = bounded.map(|(p, (value, by))| (value + by).clamp(p.least, p.greatest)).collect();
        let changes = self.parameters.iter().zip(theta.iter().zip(&next));
        let change = changes.map(|(p, (a, b))| (b - a).abs() / p.width).fold(0.0, f64::max);
        (change >= SMALL_STEP).then_some(next)
    }
}

/// Finds the parameters with the least sum of squares of `residuals`.
pub fn least_squares<E>(parameters: &[Parameter], residuals: &mut Residuals<'_, E>) -> Result<FittedParameters, E> {
    let start = parameters.iter().map(|p| p.start.clamp(p.least, p.greatest)).collect();
    let mut problem = BoundedResiduals { parameters, residuals };
    let Minimum { theta, residuals, is_converged } = SEARCH.minimise(&mut problem, start)?;
    let jacobian = problem.jacobian(&theta, &residuals)?;
    let scale = square(&residuals).sqrt();
    let without_effect = (0..theta.len()).find(|&i| {
        square(&jacobian[i]).sqrt() * parameters[i].width <= NO_EFFECT * scale || square(&jacobian[i]) == 0.0
    });
    let at_bound = (0..theta.len()).find(|&i| theta[i] <= parameters[i].least || theta[i] >= parameters[i].greatest);
    let (stop, blamed) = match (without_effect, at_bound) {
        _ if !scale.is_finite() => (FitStop::NotFinite, None),
        (Some(index), _) => (FitStop::Undetermined, Some(index)),
        (None, Some(index)) => (FitStop::AtBound, Some(index)),
        _ if is_converged => (FitStop::Converged, None),
        _ => (FitStop::MaxIterations, None),
    };
    Ok(FittedParameters { parameters: theta, residuals, jacobian, stop, blamed })
}

/// The undamped step −(JᵀJ)⁻¹Jᵀr; `None` where the parameters are not determined.
pub fn gauss_newton_step(jacobian: &[Vec<f64>], residuals: &[f64]) -> Option<Vec<f64>> {
    newton_step(jacobian, residuals, 0.0)
}

/// Broyden's update of J by the `change` of the residuals over the last `step` of the parameters, each measured by its width:
/// J + (Δr − J s) sᵀ/(sᵀs) (C. G. Broyden, *Math. Comp.* 19 (1965) 577–593). J stays as it is where most of the change is none that it foretells,
/// which is scatter.
pub fn broyden_update(jacobian: &mut [Vec<f64>], parameters: &[Parameter], step: &[f64], change: &[f64]) {
    let mut foretold = vec![0.0; change.len()];
    for (column, by) in jacobian.iter().zip(step) {
        foretold.iter_mut().zip(column).for_each(|(sum, slope)| *sum += slope * by);
    }
    let missed: Vec<f64> = change.iter().zip(&foretold).map(|(change, foretold)| change - foretold).collect();
    let widths: Vec<f64> = step.iter().zip(parameters).map(|(by, parameter)| by / parameter.width).collect();
    let length = square(&widths);
    if length == 0.0 || square(&missed) > square(&foretold) {
        return;
    }
    for (column, (width, parameter)) in jacobian.iter_mut().zip(widths.iter().zip(parameters)) {
        let by = width / (parameter.width * length);
        column.iter_mut().zip(&missed).for_each(|(slope, missed)| *slope += missed * by);
    }
}

/// (JᵀJ)⁻¹, row by row; `None` where the parameters are not determined.
pub fn inverse_normal_matrix(jacobian: &[Vec<f64>]) -> Option<DMatrix<f64>> {
    let (scales, normal) = scaled_normal_matrix(jacobian, 0.0)?;
    let inverse = normal.cholesky()?.inverse();
    Some(DMatrix::from_fn(scales.len(), scales.len(), |i, j| inverse[(i, j)] / (scales[i] * scales[j])))
}

/// JᵀJ with its diagonal scaled to 1 and damped, and the lengths of the columns.
fn scaled_normal_matrix(jacobian: &[Vec<f64>], damping: f64) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let scales: Vec<f64> = jacobian.iter().map(|column| square(column).sqrt()).collect();
    if scales.iter().any(|scale| !(*scale > 0.0 && scale.is_finite())) {
        return None;
    }
    let normal = DMatrix::from_fn(scales.len(), scales.len(), |i, j| {
        let product = dot(&jacobian[i], &jacobian[j]) / (scales[i] * scales[j]);
        if i == j { product + damping } else { product }
    });
    Some((scales, normal))
}

/// The damped step; `None` where the parameters are not determined.
fn newton_step(jacobian: &[Vec<f64>], residuals: &[f64], damping: f64) -> Option<Vec<f64>> {
    let (scales, normal) = scaled_normal_matrix(jacobian, damping)?;
    let gradient = DVector::from_fn(scales.len(), |i, _| -dot(&jacobian[i], residuals) / scales[i]);
    let step = normal.cholesky()?.solve(&gradient);
    Some(step.iter().zip(&scales).map(|(value, scale)| value / scale).collect())
}

/// Σ a b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn free(start: f64) -> Parameter {
        Parameter { start, least: -10.0, greatest: 10.0, width: 1e-3 }
    }

    fn fit(parameters: &[Parameter], mut of: impl FnMut(&[f64]) -> Vec<f64>) -> FittedParameters {
        let Ok(fitted) = least_squares::<Infallible>(parameters, &mut |theta| Ok(of(theta)));
        fitted
    }

    /// Rosenbrock's valley, Moré, Garbow and Hillstrom (1981) problem 1: minimum at (1, 1).
    #[test]
    fn val_rosenbrock() {
        let fitted = fit(&[free(-1.2), free(1.0)], |t| vec![10.0 * (t[1] - t[0] * t[0]), 1.0 - t[0]]);
        assert_eq!(fitted.stop, FitStop::Converged);
        assert!(fitted.parameters.iter().all(|t| (t - 1.0).abs() < 1e-6), "{fitted:?}");
    }

    /// A linear problem has the solution of its normal equations, whatever the scales of its parameters.
    #[test]
    fn ver_linear_regression() {
        let x: Vec<f64> = (0..20).map(f64::from).collect();
        let fitted = fit(&[free(0.0), Parameter { width: 1e-6, ..free(0.0) }], |t| {
            x.iter().map(|x| t[0] + 1e3 * t[1] * x - (2.0 + 0.5 * x)).collect()
        });
        assert!((fitted.parameters[0] - 2.0).abs() < 1e-6 && (fitted.parameters[1] - 5e-4).abs() < 1e-9, "{fitted:?}");
        // Var of the slope: 1/Σ(x − x̄)² = 1/665, in units of a thousandth.
        let covariance = inverse_normal_matrix(&fitted.jacobian).unwrap();
        assert!((covariance[(1, 1)] * 1e6 * 665.0 - 1.0).abs() < 1e-6);
    }

    /// The secant condition: the updated J foretells the change it was given, and says what it did across the step.
    #[test]
    fn ver_broydens_update_knows_the_last_change() {
        let parameters = [free(0.0), Parameter { width: 0.1, ..free(0.0) }];
        let mut jacobian = vec![vec![1.0, 0.0, 2.0], vec![0.5, -1.0, 0.0]];
        let (step, change) = ([2e-3, 0.3], [0.16, -0.28, 0.01]);
        broyden_update(&mut jacobian, &parameters, &step, &change);
        let along = |step: [f64; 2]| [0, 1, 2].map(|row| jacobian[0][row] * step[0] + jacobian[1][row] * step[1]);
        assert!(along(step).iter().zip(change).all(|(a, b)| (a - b).abs() < 1e-12), "{jacobian:?}");
        // Across the step where both parameters are measured by their widths: 2 and 3 widths along, so (−3, 2).
        let (across, before) = (along([-3e-3, 0.2]), [-3e-3 + 0.1, -0.2, -6e-3]);
        assert!(across.iter().zip(before).all(|(a, b)| (a - b).abs() < 1e-12), "{across:?}");
        let settled = jacobian.clone();
        broyden_update(&mut jacobian, &parameters, &step, &[-0.2, 0.3, 0.0]);
        assert_eq!(jacobian, settled);
    }

    #[test]
    fn it_says_what_is_not_determined_and_what_is_at_a_bound() {
        let nothing = fit(&[free(0.0), free(1.0)], |t| vec![t[0] - 1.0, 0.5]);
        assert_eq!((nothing.stop, nothing.blamed), (FitStop::Undetermined, Some(1)));
        let bound = fit(&[free(0.0)], |t| vec![t[0] - 20.0]);
        assert_eq!((bound.stop, bound.blamed, bound.parameters[0]), (FitStop::AtBound, Some(0), 10.0));
        let wrong = fit(&[free(0.0)], |_| vec![f64::NAN]);
        assert_eq!(wrong.stop, FitStop::NotFinite);
    }
}
