//! Length of the next step.
//!
//! The error of a step of a method of second order grows with the cube of its length. The next step aims at a part of the
//! tolerance, with the trend of the last two steps in mind (a predictive controller),
//!
//! ```text
//! h ← h · c E^(−1/3) · (h/h₋₁) (E₋₁/E)^(1/3)            between 1/10 and 10 times as long
//! ```
//!
//! E being the estimated error over the tolerance, c a safety below 1; after a rejected step the trend counts for nothing. Where a rate jumps the error
//! shrinks with the length alone, and repeated rejections come to the same by themselves.
//!
//! Source: K. Gustafsson, *ACM Trans. Math. Softw.* 20 (1994) 496; Sommeijer, Shampine and Verwer (1997), section 3.

use serde::{Deserialize, Serialize};

/// One over the order of the error of a step.
const EXPONENT: f64 = 1.0 / 3.0;
/// Greatest ratio of a repeated step to the rejected one.
const REPEATED: f64 = 0.8;
const LEAST_FACTOR: f64 = 0.1;
const MOST_FACTOR: f64 = 10.0;
/// Part of the tolerance as which smaller errors count.
const NEGLIGIBLE: f64 = 1e-4;

/// Verdict on a trial step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StepVerdict {
    /// The step is taken.
    Accepted,
    /// A shorter step is tried instead.
    Rejected,
}

/// The controller.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct StepControl {
    /// Length of the next step; none before the first.
    next: Option<f64>,
    /// Length, and error over tolerance, of the last accepted step, where it was not cut short.
    last: Option<(f64, f64)>,
    rejected_before: bool,
}

impl StepControl {
    /// Length of the next step; none before the first.
    pub(crate) fn next(&self) -> Option<f64> {
        self.next
    }

    /// Sets the length of the next step: a first guess, or a repetition for reasons beside the error.
    pub(crate) fn set_next(&mut self, length: f64) {
        (self.next, self.last) = (Some(length), None);
    }

    /// Judges a step of `length` by its error over the tolerance, and plans the next one with this `safety`. A step that was `cut` shorter than
    /// planned never makes the next one shorter.
    pub(crate) fn judge(&mut self, length: f64, error: f64, cut: bool, safety: f64) -> StepVerdict {
        if error.is_nan() || error > 1.0 {
            let factor = if error.is_finite() { safety * error.powf(-EXPONENT) } else { LEAST_FACTOR };
            self.next = Some(length * factor.clamp(LEAST_FACTOR, REPEATED));
            (self.last, self.rejected_before) = (None, true);
            return StepVerdict::Rejected;
        }
        let error = error.max(NEGLIGIBLE);
        let mut factor = safety * error.powf(-EXPONENT);
        if let Some((before, error_before)) = self.last {
            // The trend may shorten a step. It never lengthens one: that would aim at the tolerance itself, and be rejected.
            factor *= ((length / before) * (error_before / error).powf(EXPONENT)).min(1.0);
        }
        let most = if self.rejected_before { 1.0 } else { MOST_FACTOR };
        let planned = length * factor.clamp(LEAST_FACTOR, most);
        self.next = Some(if cut { planned.max(self.next.unwrap_or(planned)) } else { planned });
        self.last = (!cut).then_some((length, error));
        self.rejected_before = false;
        StepVerdict::Accepted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With an error of c h³ the length settles where the error is a part of the tolerance, without a rejection.
    #[test]
    fn ver_settles_within_the_tolerance() {
        let mut control = StepControl::default();
        control.set_next(1e-3);
        for _ in 0..30 {
            let h = control.next().unwrap();
            assert_eq!(control.judge(h, 7.0 * h.powi(3), false, 0.8), StepVerdict::Accepted);
        }
        let error = 7.0 * control.next().unwrap().powi(3);
        assert!((0.3..0.9).contains(&error), "{error}");
    }

    /// Too large an error, or none at all, is repeated with a shorter step; a step cut short does not make the next one short.
    #[test]
    fn rejected_and_cut_steps() {
        let mut control = StepControl::default();
        control.set_next(1.0);
        assert_eq!(control.judge(1.0, 8.0, false, 0.8), StepVerdict::Rejected);
        assert!((control.next().unwrap() - 0.4).abs() < 1e-12);
        assert_eq!(control.judge(0.4, f64::NAN, false, 0.8), StepVerdict::Rejected);
        assert!((control.next().unwrap() - 0.04).abs() < 1e-12);
        assert_eq!(control.judge(1e-9, 1e-9, true, 0.8), StepVerdict::Accepted);
        assert!((control.next().unwrap() - 0.04).abs() < 1e-12);
        // However near the step was to the tolerance, and the next ones aim.
        assert_eq!(control.judge(0.04, 1.001, false, 0.95), StepVerdict::Rejected);
        assert!((control.next().unwrap() - 0.8 * 0.04).abs() < 1e-12);
    }
}
