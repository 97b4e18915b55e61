//! A Rosenbrock method of second order, whatever the Jacobian that it is given.
//!
//! ```text
//! (I − γ h W) k₁ = f(y)
//! (I − γ h W) k₂ = f(y + h k₁) − 2 k₁
//! y₊ = y + 3/2 h k₁ + 1/2 h k₂            γ = 1 + 1/√2
//! ```
//!
//! Order 2 holds for every W: expanding, y₊ = y + h f + ½ h² f′f + O(h³) with no term in W. With W the Jacobian it is L-stable,
//! and R(z) → 0 with 0 ≤ R(z) ≤ 1 on the negative axis, so that nothing overshoots; that is why γ is the larger of the two. W is
//! a diagonal here ([`super::diagonal`]), so that a step costs two evaluations and nothing else.
//!
//! Source: J. G. Verwer, E. J. Spee, J. G. Blom and W. Hundsdorfer, *SIAM J. Sci. Comput.* 20 (1999) 1456, ROS2.

use serde::{Deserialize, Serialize};

use super::Rate;

/// γ.
pub(crate) const GAMMA: f64 = 1.0 + std::f64::consts::FRAC_1_SQRT_2;

/// The method with its rows.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct LinearlyImplicit {
    #[serde(skip)]
    first: Vec<f64>,
    #[serde(skip)]
    middle: Vec<f64>,
    #[serde(skip)]
    rate: Vec<f64>,
}

impl LinearlyImplicit {
    /// Takes a step of `h` from `state`, where the rate is `slope`, to `end`, with the diagonal W. Costs one evaluation.
    pub(crate) fn step<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        (state, slope): (&[f64], &[f64]),
        h: f64,
        diagonal: &[f64],
        end: &mut Vec<f64>,
    ) -> Result<(), R::Error> {
        let damped = |f: f64, w: f64| f / (1.0 - GAMMA * h * w);
        self.first.clear();
        self.first.extend(slope.iter().zip(diagonal).map(|(&f, &w)| damped(f, w)));
        self.middle.clear();
        self.middle.extend(state.iter().zip(&self.first).map(|(y, k)| y + h * k));
        self.rate.resize(state.len(), 0.0);
        rate.evaluate(&self.middle, &mut self.rate)?;
        end.clear();
        let rates = self.rate.iter().zip(&self.first).zip(diagonal);
        end.extend(state.iter().zip(rates).map(|(y, ((f, k1), &w))| {
            let k2 = damped(f - 2.0 * k1, w);
            y + 1.5 * h * k1 + 0.5 * h * k2
        }));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// y' = −y².
    struct Quadratic;

    impl Rate for Quadratic {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate[0] = -state[0] * state[0];
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    fn error(steps: u32, jacobian: impl Fn(f64) -> f64) -> f64 {
        let (mut y, mut end) = (vec![1.0], Vec::new());
        let mut method = LinearlyImplicit::default();
        for _ in 0..steps {
            let w = jacobian(y[0]);
            let Ok(()) = method.step(&mut Quadratic, (&y, &[-y[0] * y[0]]), 1.0 / f64::from(steps), &[w], &mut end);
            std::mem::swap(&mut y, &mut end);
        }
        // y(1) = 1/(1 + 1).
        (y[0] - 0.5).abs()
    }

    /// Halving the step quarters the error, with the Jacobian, with parts or a multiple of it, and with none. (With one half of it
    /// this problem happens to be solved to third order.)
    #[test]
    fn ver_second_order_with_any_jacobian() {
        for part in [1.0, 0.75, 0.25, 0.0, 3.0] {
            let ratio = error(200, |y| -2.0 * part * y) / error(400, |y| -2.0 * part * y);
            assert!((3.6..4.4).contains(&ratio), "{part}: {ratio}");
        }
    }

    /// R(z) between 0 and 1 on the negative axis, and 0 at its end.
    #[test]
    fn ver_damps_without_overshoot() {
        struct Decay(f64);
        impl Rate for Decay {
            type Error = Infallible;
            fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
                rate[0] = self.0 * state[0];
                Ok(())
            }
            fn may_succeed_nearer(&self, _: &Infallible) -> bool {
                false
            }
        }
        for exponent in -20..60 {
            let z = -(10f64.powf(0.1 * f64::from(exponent)));
            let mut end = Vec::new();
            let Ok(()) = LinearlyImplicit::default().step(&mut Decay(z), (&[1.0], &[z]), 1.0, &[z], &mut end);
            assert!((0.0..1.0).contains(&end[0]) && (z > -1e5 || end[0] < 1e-4), "{z}: {}", end[0]);
        }
    }
}
