//! Wear stepping: integrators of y' = f(y), where y is the wear of both flanks and the "time" is pinion revolutions.
//!
//! Short waves of wear are stiff. A bump of height e raises the pressure by K e and is worn down at the rate k K s e, so that
//! Euler's method swings once Δn k K s > 2, while the wear as a whole goes on for many thousand times as long. The spectrum is
//! real and negative: bumps decay, and nothing oscillates by itself.
//!
//! | module | what |
//! |---|---|
//! | [`runge_kutta_chebyshev`] | stabilised explicit method of second order: s evaluations of f reach about 0.65 s² as far as one |
//! | [`spectral_radius`] | the fastest decay, which tells how many stages that takes |
//! | [`step_control`] | length of the next step |
//! | [`adaptive`] | steps one after another, within a tolerance |
//!
//! Nothing here knows of gears: a [`Rate`] is a row of numbers.
//!
//! **Error of a step.** The trapezoidal rule with the rates at both ends of a step is of second order too, and its difference from the step is
//! of the size of the error,
//!
//! ```text
//! e = c [½ Δn (f(yₙ) + f(yₙ₊₁)) − (yₙ₊₁ − yₙ)]
//! ```
//!
//! with c = 0.8 (Sommeijer, Shampine and Verwer, equation 2.11). It costs nothing: the rate at the end is that at the beginning of the next step.
//! Slow sources of the rate may stay as they are at the beginning of a step in all of its stages ([`Rate::evaluate_stage`]): positions of the mesh
//! that wear mildly, beside severe ones whose fast decay cuts the steps short. The rate at the end is that of all sources, so that what they changed by is
//! in the error; unless the others alone reject the step ([`Rate::complete_stage`]).
//!
//! Where rates jump to and fro, as at a fine tip edge that wears severely, those at both ends of a step say little of their mean. At a place where
//! they were as far from the mean rate in earlier steps, and that wears, the change of the mean rate from the step before bounds the estimate:
//!
//! ```text
//! |e| ≤ 2 |(yₙ₊₁ − yₙ) − Δn (yₙ − yₙ₋₁)/Δn₋₁|
//! ```

pub mod adaptive;
pub(crate) mod runge_kutta_chebyshev;
pub(crate) mod spectral_radius;
pub(crate) mod step_control;

/// f of y' = f(y): wear rate of each place, mm per revolution, at the wear `state`, mm.
pub trait Rate {
    /// Failure to find a rate.
    type Error;

    /// Fills in the rate of each place.
    fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Self::Error>;

    /// Prepares the step from `state`, where `rate` was just found, and may find the rate anew there: within a step it must remain one smooth
    /// function of the state. Returns the number of evaluations.
    fn begin_step(&mut self, _state: &[f64], _rate: &mut [f64]) -> Result<u64, Self::Error> {
        Ok(0)
    }

    /// As [`Self::evaluate`], within a step from the state where the rate was found last: slow sources of the rate may stay as they were there.
    fn evaluate_stage(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        self.evaluate(state, rate)
    }

    /// As [`Self::evaluate_stage`], at the end of the step: a rate that stages find near the last one alone is looked for everywhere.
    fn evaluate_end(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        self.evaluate_stage(state, rate)
    }

    /// After [`Self::evaluate_end`] at `state`: finds the sources that stayed as they were there too, and the rate of all. Returns whether there are any.
    fn complete_stage(&mut self, _state: &[f64], _rate: &mut [f64]) -> Result<bool, Self::Error> {
        Ok(false)
    }

    /// Chooses a part of the sources of the rate, whose fastest decay is that of all, and finds the rate at `state` of that part alone; `None`, and
    /// nothing chosen, where no part is as good as the whole.
    fn choose_part(&mut self, _state: &[f64]) -> Result<Option<Vec<f64>>, Self::Error> {
        Ok(None)
    }

    /// Fills in the rate of the part chosen last.
    fn evaluate_part(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        self.evaluate(state, rate)
    }

    /// Whether the rate may change by more than itself over depths as small as errors may be, as severe wear does.
    fn is_steep(&self) -> bool {
        false
    }

    /// Size of a row of depths, such as the error of a step, mm.
    fn size(&self, row: &[f64]) -> f64 {
        greatest(row)
    }

    /// Whether a state nearer to the last good one may have a rate after this `failure`.
    fn may_succeed_nearer(&self, failure: &Self::Error) -> bool;
}

/// Greatest magnitude of a row; NaN where one is.
pub fn greatest(row: &[f64]) -> f64 {
    row.iter().fold(0.0, |greatest, value| greater_or_nan(greatest, value.abs()))
}

/// Greater of two numbers; NaN where one is.
pub(crate) fn greater_or_nan(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Pseudo-random numbers in −1…1, the same in every run: SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, 2014).
struct Noise(u64);

impl Noise {
    fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let bits = (z ^ (z >> 31)) >> 11;
        2.0 * bits as f64 / (1u64 << 53) as f64 - 1.0
    }
}
