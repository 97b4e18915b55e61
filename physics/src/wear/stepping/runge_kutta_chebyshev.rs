//! The Runge–Kutta–Chebyshev method of second order.
//!
//! The stability polynomial of s stages is Chebyshev's, stretched over the negative real axis and damped a little,
//!
//! ```text
//! P(z) = a_s + b_s T_s(w₀ + w₁ z)      b_j = T_j″(w₀)/T_j′(w₀)²      a_j = 1 − b_j T_j(w₀)
//! w₀ = 1 + ε/s²      w₁ = T_s′(w₀)/T_s″(w₀)      ε = 2/13
//! ```
//!
//! stable for −β(s) ≤ z ≤ 0 with β(s) ≈ ⅔ (s² − 1)(1 − 2ε/15): s evaluations go about s/3 as far as s steps of Euler's method,
//! which is stable for −2 ≤ z. The three-term recurrence of T_j gives the stages,
//!
//! ```text
//! Y₁ = y + b₁ w₁ h F₀
//! Y_j = (1 − μ_j − ν_j) y + μ_j Y_{j−1} + ν_j Y_{j−2} + μ̃_j h (F_{j−1} − a_{j−1} F₀)
//! μ_j = 2 b_j w₀/b_{j−1}      ν_j = −b_j/b_{j−2}      μ̃_j = 2 b_j w₁/b_{j−1}
//! ```
//!
//! in which round-off does not grow. Five rows are all the memory it takes, however many stages.
//!
//! Source: B. P. Sommeijer, L. F. Shampine and J. G. Verwer, "RKC: an explicit solver for parabolic PDEs", *J. Comput. Appl. Math.*
//! 88 (1997) 315–326, section 2.

use serde::{Deserialize, Serialize};

use super::Rate;

/// Damping.
const EPSILON: f64 = 2.0 / 13.0;
/// Fewest stages.
pub(crate) const LEAST_STAGES: usize = 2;
/// Most stages. With more the error control has long shortened the step.
pub(crate) const MOST_STAGES: usize = 250;
/// c of the estimated error.
pub(crate) const ERROR_FACTOR: f64 = 0.8;

/// β(s): steps are stable while the length times the spectral radius is below it.
pub(crate) fn stability_bound(stages: usize) -> f64 {
    let s = stages as f64;
    2.0 / 3.0 * (s * s - 1.0) * (1.0 - 2.0 / 15.0 * EPSILON)
}

/// Fewest stages that are stable for a length times spectral radius; none where [`MOST_STAGES`] are not.
pub(crate) fn stages_for(stiffness: f64) -> Option<usize> {
    let per_square = 2.0 / 3.0 * (1.0 - 2.0 / 15.0 * EPSILON);
    let stages = (1.0 + stiffness / per_square).sqrt().ceil();
    (stages <= MOST_STAGES as f64).then_some((stages as usize).max(LEAST_STAGES))
}

/// T_j(w₀) with its first and second derivatives.
#[derive(Clone, Copy)]
struct Chebyshev {
    value: f64,
    first: f64,
    second: f64,
}

impl Chebyshev {
    /// T₀.
    const CONSTANT: Self = Self { value: 1.0, first: 0.0, second: 0.0 };

    /// T₁.
    fn linear(w: f64) -> Self {
        Self { value: w, first: 1.0, second: 0.0 }
    }

    /// T_{j+1} = 2 w T_j − T_{j−1}, differentiated term by term.
    fn next(self, before: Self, w: f64) -> Self {
        Self {
            value: 2.0 * w * self.value - before.value,
            first: 2.0 * (self.value + w * self.first) - before.first,
            second: 2.0 * (2.0 * self.first + w * self.second) - before.second,
        }
    }

    /// b_j.
    fn weight(self) -> f64 {
        self.second / (self.first * self.first)
    }
}

/// The method with its rows.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct RungeKuttaChebyshev {
    #[serde(skip)]
    stage: Vec<f64>,
    #[serde(skip)]
    before: Vec<f64>,
    #[serde(skip)]
    rate: Vec<f64>,
}

impl RungeKuttaChebyshev {
    /// Takes a step of `h` from `state`, where the rate is `slope`, to `end`. Costs `stages` − 1 evaluations.
    pub(crate) fn step<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        (state, slope): (&[f64], &[f64]),
        h: f64,
        stages: usize,
        end: &mut Vec<f64>,
    ) -> Result<(), R::Error> {
        let w0 = 1.0 + EPSILON / (stages * stages) as f64;
        let w1 = {
            let (mut before, mut last) = (Chebyshev::CONSTANT, Chebyshev::linear(w0));
            for _ in 2..=stages {
                (before, last) = (last, last.next(before, w0));
            }
            last.first / last.second
        };
        let (mut before, mut last) = (Chebyshev::CONSTANT, Chebyshev::linear(w0));
        // b₀ = b₁ = b₂.
        let b = last.next(before, w0).weight();
        let (mut b_before, mut b_last) = (b, b);

        self.rate.resize(state.len(), 0.0);
        self.before.clear();
        self.before.extend_from_slice(state);
        self.stage.clear();
        self.stage.extend(state.iter().zip(slope).map(|(y, f)| y + b * w1 * h * f));
        for j in 2..=stages {
            rate.evaluate_stage(&self.stage, &mut self.rate)?;
            let next = last.next(before, w0);
            let b_next = if j == 2 { b } else { next.weight() };
            let mu = 2.0 * b_next * w0 / b_last;
            let nu = -b_next / b_before;
            let mu_rate = 2.0 * b_next * w1 / b_last;
            let a_last = 1.0 - b_last * last.value;
            let rates = self.rate.iter().zip(slope);
            let stages = self.stage.iter().zip(&mut self.before);
            for ((y, (stage, before)), (f, f0)) in state.iter().zip(stages).zip(rates) {
                *before = (1.0 - mu - nu) * y + mu * stage + nu * *before + mu_rate * h * (f - a_last * f0);
            }
            std::mem::swap(&mut self.stage, &mut self.before);
            (before, last) = (last, next);
            (b_before, b_last) = (b_last, b_next);
        }
        end.clear();
        end.extend_from_slice(&self.stage);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// y' = λ y, one unknown.
    struct LinearDecay(f64);

    impl Rate for LinearDecay {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate[0] = self.0 * state[0];
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// P(z).
    fn amplification(z: f64, stages: usize) -> f64 {
        let mut end = Vec::new();
        let Ok(()) = RungeKuttaChebyshev::default().step(&mut LinearDecay(z), (&[1.0], &[z]), 1.0, stages, &mut end);
        end[0]
    }

    /// |P(z)| ≤ 1 up to β(s), and not beyond 1.25 β(s): where s is odd, P leaves its last minimum of about 1/3 downwards, and passes
    /// −1 somewhat later than P of an even s passes 1.
    #[test]
    fn ver_stable_as_far_as_the_bound_says() {
        for stages in [2, 3, 5, 10, 40, MOST_STAGES] {
            let bound = stability_bound(stages);
            let samples = 2000;
            let greatest = (0..=samples)
                .map(|i| amplification(-bound * f64::from(i) / f64::from(samples), stages).abs())
                .fold(0.0, f64::max);
            assert!(greatest <= 1.0 + 1e-9, "{stages}: {greatest}");
            assert!(amplification(-1.25 * bound, stages).abs() > 1.0, "{stages}");
        }
    }

    /// P(z) = 1 + z + z²/2 + O(z³) whatever the number of stages.
    #[test]
    fn ver_consistent_of_second_order() {
        for stages in [2, 3, 7, 30] {
            let [long, half, short] =
                [-1e-2, -5e-3, -1e-3].map(|z| (amplification(z, stages) - (1.0 + z + 0.5 * z * z)).abs());
            assert!(long < 1e-6 / 4.0 && long / half.max(1e-15) > 7.0 || stages == 2, "{stages}");
            assert!(short < 2e-10, "{stages}: {short}");
        }
    }

    /// The fewest stages are enough, and one less is not.
    #[test]
    fn ver_fewest_stages() {
        for stiffness in [0.0, 1.0, 1.9, 2.1, 30.0, 1e3, 4e4] {
            let stages = stages_for(stiffness).unwrap();
            assert!(stability_bound(stages) >= stiffness && stages <= MOST_STAGES);
            assert!(stages == LEAST_STAGES || stability_bound(stages - 1) < stiffness, "{stiffness}: {stages}");
        }
        assert_eq!(stages_for(1e6), None);
        assert_eq!(stages_for(f64::INFINITY), None);
    }
}
