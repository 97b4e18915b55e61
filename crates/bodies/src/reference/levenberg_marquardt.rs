//! Nonlinear least squares by Levenberg and Marquardt's method.
//!
//! ```text
//! minimise |r(θ)|²          (JᵀJ + λ diag JᵀJ) δ = −Jᵀr          J = ∂r/∂θ
//! ```
//!
//! λ falls with every step that lessens the sum of squares and grows tenfold with every one that does not. The problem itself finds J and solves
//! the damped equations, so that it can scale its parameters and keep them within bounds.
//!
//! Sources: D. W. Marquardt, *J. SIAM* 11 (1963) 431–441; J. J. Moré, *The Levenberg–Marquardt algorithm*, Lecture Notes in Mathematics 630 (1978)
//! 105–116.

/// λ of the first step.
const FIRST_DAMPING: f64 = 1e-3;

/// Residuals r(θ) and their linearisation.
pub trait LeastSquares {
    /// Failure to find the residuals.
    type Error;
    /// J.
    type Jacobian;

    /// r(θ).
    fn residuals(&mut self, theta: &[f64]) -> Result<Vec<f64>, Self::Error>;

    /// J at θ, where the residuals are `residuals`.
    fn jacobian(&mut self, theta: &[f64], residuals: &[f64]) -> Result<Self::Jacobian, Self::Error>;

    /// θ after a step with λ = `damping`; `None` where no step is determined, or where it is too short to matter.
    fn damped_step(
        &self,
        theta: &[f64],
        residuals: &[f64],
        jacobian: &Self::Jacobian,
        damping: f64,
    ) -> Option<Vec<f64>>;
}

/// Settings of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevenbergMarquardt {
    /// Greatest number of steps.
    pub most_steps: usize,
    /// Factor on λ after a step that lessens the sum of squares.
    pub damping_decrease: f64,
    /// Least λ.
    pub least_damping: f64,
    /// λ from which on no step is tried.
    pub most_damping: f64,
    /// Relative decrease of the sum of squares in a step that ends the search.
    pub settled: f64,
}

/// End of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// θ.
    pub theta: Vec<f64>,
    /// r(θ).
    pub residuals: Vec<f64>,
    /// Whether no further step lessens the sum of squares, rather than the steps having run out.
    pub is_converged: bool,
}

impl LevenbergMarquardt {
    /// Searches the least sum of squares from `theta` on; not converged, and without a step, where the residuals there are not finite.
    ///
    /// # Errors
    /// The first failure to find residuals.
    pub fn minimise<P: LeastSquares>(&self, problem: &mut P, theta: Vec<f64>) -> Result<Minimum, P::Error> {
        let residuals = problem.residuals(&theta)?;
        let mut at = Minimum { theta, residuals, is_converged: false };
        if !sum_of_squares(&at.residuals).is_finite() {
            return Ok(at);
        }
        let mut damping = FIRST_DAMPING;
        for _ in 0..self.most_steps {
            let before = sum_of_squares(&at.residuals);
            let Some(next) = self.descend(problem, &at, &mut damping)? else {
                return Ok(Minimum { is_converged: true, ..at });
            };
            let after = sum_of_squares(&next.residuals);
            at = Minimum { is_converged: before - after <= self.settled * before, ..next };
            if at.is_converged {
                break;
            }
        }
        Ok(at)
    }

    /// The first step that lessens the sum of squares, with ever greater `damping`; `None` where there is none.
    fn descend<P: LeastSquares>(
        &self,
        problem: &mut P,
        at: &Minimum,
        damping: &mut f64,
    ) -> Result<Option<Minimum>, P::Error> {
        let jacobian = problem.jacobian(&at.theta, &at.residuals)?;
        while *damping < self.most_damping {
            let Some(theta) = problem.damped_step(&at.theta, &at.residuals, &jacobian, *damping) else { break };
            let residuals = problem.residuals(&theta)?;
            if sum_of_squares(&residuals) < sum_of_squares(&at.residuals) {
                *damping = (*damping * self.damping_decrease).max(self.least_damping);
                return Ok(Some(Minimum { theta, residuals, is_converged: false }));
            }
            *damping *= 10.0;
        }
        Ok(None)
    }
}

/// Sum of squares.
pub fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's function as residuals, 10 (y − x²) and 1 − x: J. J. Moré, B. S. Garbow, K. E. Hillstrom, *ACM Transactions on Mathematical
    /// Software* 7 (1981) 17–41, problem 1.
    struct Rosenbrock {
        evaluations: usize,
    }

    impl LeastSquares for Rosenbrock {
        type Error = std::convert::Infallible;
        type Jacobian = [[f64; 2]; 2];

        fn residuals(&mut self, theta: &[f64]) -> Result<Vec<f64>, Self::Error> {
            self.evaluations += 1;
            Ok(vec![10.0 * (theta[1] - theta[0] * theta[0]), 1.0 - theta[0]])
        }

        fn jacobian(&mut self, theta: &[f64], _residuals: &[f64]) -> Result<Self::Jacobian, Self::Error> {
            Ok([[-20.0 * theta[0], 10.0], [-1.0, 0.0]])
        }

        fn damped_step(
            &self,
            theta: &[f64],
            residuals: &[f64],
            jacobian: &Self::Jacobian,
            damping: f64,
        ) -> Option<Vec<f64>> {
            let product = |a: usize, b: usize| jacobian[0][a] * jacobian[0][b] + jacobian[1][a] * jacobian[1][b];
            let slope = [0, 1].map(|a| jacobian[0][a] * residuals[0] + jacobian[1][a] * residuals[1]);
            let (xx, xy, yy) = ((1.0 + damping) * product(0, 0), product(0, 1), (1.0 + damping) * product(1, 1));
            let determinant = xx * yy - xy * xy;
            let step = [(xy * slope[1] - yy * slope[0]) / determinant, (xy * slope[0] - xx * slope[1]) / determinant];
            Some(vec![theta[0] + step[0], theta[1] + step[1]])
        }
    }

    const SEARCH: LevenbergMarquardt = LevenbergMarquardt {
        most_steps: 100,
        damping_decrease: 0.1,
        least_damping: 1e-12,
        most_damping: 1e9,
        settled: 1e-14,
    };

    /// The minimum is 0 at (1, 1), from the standard start (−1.2, 1).
    #[test]
    fn ver_rosenbrock() {
        let mut problem = Rosenbrock { evaluations: 0 };
        let found = SEARCH.minimise(&mut problem, vec![-1.2, 1.0]).unwrap();
        assert!(found.theta.iter().all(|value| (value - 1.0).abs() < 1e-9), "{found:?}");
        assert!(problem.evaluations < 100, "{} evaluations", problem.evaluations);
    }

    /// Steps that have run out are no convergence, and the best point so far is given.
    #[test]
    fn steps_that_run_out_are_told() {
        let search = LevenbergMarquardt { most_steps: 2, ..SEARCH };
        let mut problem = Rosenbrock { evaluations: 0 };
        let found = search.minimise(&mut problem, vec![-1.2, 1.0]).unwrap();
        assert!(!found.is_converged && sum_of_squares(&found.residuals) < 24.2, "{found:?}");
    }
}
