//! From one evaluated state of a wearing pair to the next.
//!
//! Euler's method, the thesis's, takes what one evaluation found to hold for the whole step. Each pinion tooth meshes once per
//! pinion turn, each wheel tooth z1/z2 times:
//!
//! ```text
//! h1 ← h1 + Δn · dh1          h2 ← h2 + Δn · (z1/z2) · dh2
//! ```
//!
//! Steps are shortened to end where a stretch does.

use serde::{Deserialize, Serialize};

use super::settings::Stepping;
use super::wearing_pair::WearingPair;
use crate::gear::PerGear;
use crate::wear::WearModel;
use crate::working_cycle::{Work, load_sharing::EquilibriumError};

/// A remainder of a step shorter than this part of it is not worth a step of its own.
const NEGLIGIBLE_STEP: f64 = 1e-9;

/// Where a step begins, and where it ends at the latest, in pinion revolutions.
#[derive(Debug, Clone, Copy)]
pub struct Stretch {
    /// The pair is evaluated here.
    pub from: f64,
    /// Greater than `from`.
    pub limit: f64,
    /// Whether the pair must forget where it was ([`WearingPair::forget`]) before its evaluation at the end of the step: a run may go
    /// on from there another time.
    pub clean_start: bool,
}

/// What came of a step.
#[derive(Debug)]
pub struct Advanced {
    /// Where the pair is now.
    pub revolutions: f64,
    /// Its evaluation there, with the work of the whole step.
    pub evaluated: Result<Work, EquilibriumError>,
}

/// What a [`Stepper`] knows beside what it is made of: nothing for Euler's method.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct StepperState {}

/// Takes wear steps.
pub struct Stepper {
    step_revolutions: f64,
    /// Turns of the wheel per turn of the pinion.
    wheel_meshes: f64,
}

impl Stepper {
    /// Steps as asked for in a run of `duration` pinion revolutions.
    pub fn new(stepping: Stepping, duration: f64, wheel_meshes: f64) -> Self {
        Self { step_revolutions: stepping.euler_revolutions(duration), wheel_meshes }
    }

    /// What it knows after the last step.
    pub fn state(&self) -> StepperState {
        StepperState {}
    }

    /// Goes on from there.
    pub fn resume(&mut self, _state: StepperState) {}

    /// Takes `pair`, which is evaluated where `stretch` begins, one step on, and evaluates it there.
    pub fn advance(
        &mut self,
        pair: &mut dyn WearingPair,
        wear: &WearModel<'_>,
        stretch: Stretch,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Advanced {
        let step = self.step_revolutions;
        let arrives = stretch.from + step * (1.0 + NEGLIGIBLE_STEP) >= stretch.limit;
        let step = if arrives { stretch.limit - stretch.from } else { step };
        pair.wear_for(PerGear { pinion: step, wheel: step * self.wheel_meshes });
        let revolutions = if arrives { stretch.limit } else { stretch.from + step };
        if stretch.clean_start {
            pair.forget();
        }
        Advanced { revolutions, evaluated: pair.evaluate(wear, stopped) }
    }
}
