//! From one evaluated state of a wearing pair to the next.
//!
//! Euler's method, the thesis's, takes what one evaluation found to hold for the whole step. Each pinion tooth meshes once per
//! pinion turn, each wheel tooth z1/z2 times:
//!
//! ```text
//! h1 ← h1 + Δn · dh1          h2 ← h2 + Δn · (z1/z2) · dh2
//! ```
//!
//! Steps are shortened to end where a stretch does. Adaptive steps ([`crate::wear::stepping`]) see the rows of both gears as one
//! state, in depth per pinion revolution.

use serde::{Deserialize, Serialize};

use super::settings::{AdaptiveMethod, Stepping};
use super::wearing_pair::WearingPair;
use crate::gear::{Gear, PerGear};
use crate::wear::WearModel;
use crate::wear::stepping::{
    Rate,
    adaptive::{Adaptive, StepCounts},
};
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

/// What a [`Stepper`] knows beside what it is made of.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct StepperState {
    euler_steps: u64,
    integrator: Option<Adaptive>,
}

/// Takes wear steps.
pub struct Stepper {
    stepping: Stepping,
    duration: f64,
    /// Turns of the wheel per turn of the pinion.
    wheel_meshes: f64,
    euler_steps: u64,
    /// Of adaptive steps, from the first on.
    adaptive: Option<Box<AdaptiveSteps>>,
}

/// The integrator with the rows it works on.
struct AdaptiveSteps {
    integrator: Adaptive,
    state: Vec<f64>,
    slope: Vec<f64>,
    wear_mm: PerGear<Vec<f64>>,
    depth_mm: PerGear<Vec<f64>>,
}

impl Stepper {
    /// Steps as asked for in a run of `duration` pinion revolutions.
    pub fn new(stepping: Stepping, duration: f64, wheel_meshes: f64) -> Self {
        Self { stepping, duration, wheel_meshes, euler_steps: 0, adaptive: None }
    }

    /// Load, speed or law are others from here on.
    pub fn begin_phase(&mut self) {
        if let Some(steps) = &mut self.adaptive {
            steps.integrator.start_anew();
        }
    }

    /// What the steps came to so far.
    pub fn counts(&self) -> StepCounts {
        match &self.adaptive {
            Some(steps) => steps.integrator.counts(),
            None => StepCounts { accepted: self.euler_steps, stages: self.euler_steps, ..StepCounts::default() },
        }
    }

    /// Of adaptive steps: the estimated error of the wear at each place, mm.
    pub fn error_mm(&self) -> Option<PerGear<Vec<f64>>> {
        let steps = self.adaptive.as_ref()?;
        let (pinion, wheel) = steps.integrator.accumulated_error().split_at(steps.wear_mm.pinion.len());
        Some(PerGear { pinion: pinion.to_vec(), wheel: wheel.to_vec() })
    }

    /// What it knows after the last step.
    pub fn state(&self) -> StepperState {
        StepperState {
            euler_steps: self.euler_steps,
            integrator: self.adaptive.as_ref().map(|steps| steps.integrator.clone()),
        }
    }

    /// Goes on from there.
    pub fn resume(&mut self, state: StepperState) {
        self.euler_steps = state.euler_steps;
        self.adaptive = state.integrator.map(|integrator| Box::new(AdaptiveSteps::of(integrator)));
    }

    /// Takes `pair`, which is evaluated where `stretch` begins, one step on, and evaluates it there.
    pub fn advance(
        &mut self,
        pair: &mut dyn WearingPair,
        wear: &WearModel<'_>,
        stretch: Stretch,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Advanced {
        match self.stepping {
            Stepping::Fixed { revolutions } => self.euler(revolutions, pair, wear, stretch, stopped),
            Stepping::Adaptive { tolerance_mm, method } => {
                let (duration, wheel_meshes) = (self.duration, self.wheel_meshes);
                let steps = self
                    .adaptive
                    .get_or_insert_with(|| Box::new(AdaptiveSteps::new(pair, tolerance_mm, method, duration)));
                steps.advance(PairRate { pair, wear, stopped, wheel_meshes, work: Work::default() }, stretch)
            }
        }
    }

    fn euler(
        &mut self,
        step: f64,
        pair: &mut dyn WearingPair,
        wear: &WearModel<'_>,
        stretch: Stretch,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Advanced {
        let arrives = stretch.from + step * (1.0 + NEGLIGIBLE_STEP) >= stretch.limit;
        let step = if arrives { stretch.limit - stretch.from } else { step };
        pair.wear_for(PerGear { pinion: step, wheel: step * self.wheel_meshes });
        self.euler_steps += 1;
        let revolutions = if arrives { stretch.limit } else { stretch.from + step };
        if stretch.clean_start {
            pair.forget();
        }
        Advanced { revolutions, evaluated: pair.evaluate(wear, stopped) }
    }
}

impl AdaptiveSteps {
    fn new(pair: &dyn WearingPair, tolerance_mm: f64, method: AdaptiveMethod, duration: f64) -> Self {
        let wear_mm = pair.wear_mm();
        let blocks = Gear::BOTH.map(|gear| wear_mm[gear].len());
        let integrator = match method {
            AdaptiveMethod::RungeKuttaChebyshev => Adaptive::chebyshev(tolerance_mm, duration, &blocks),
            AdaptiveMethod::LinearlyImplicit => Adaptive::linearly_implicit(tolerance_mm, duration, &blocks),
        };
        Self::of(integrator)
    }

    fn of(integrator: Adaptive) -> Self {
        let rows = || PerGear::from_fn(|_| Vec::new());
        Self { integrator, state: Vec::new(), slope: Vec::new(), wear_mm: rows(), depth_mm: rows() }
    }

    fn advance(&mut self, rate: PairRate<'_>, stretch: Stretch) -> Advanced {
        self.wear_mm = rate.pair.wear_mm();
        self.state.clear();
        self.state.extend(Gear::BOTH.iter().flat_map(|&gear| &self.wear_mm[gear]));
        self.slope.resize(self.state.len(), 0.0);
        rate.read_slope(&mut self.depth_mm, &mut self.slope);
        let mut pair = OnRows { rate, wear_mm: &mut self.wear_mm, depth_mm: &mut self.depth_mm };
        let room = stretch.limit - stretch.from;
        match self.integrator.step(&mut pair, &mut self.state, &mut self.slope, room) {
            Ok(length) => {
                let arrives = length >= room;
                let revolutions = if arrives { stretch.limit } else { stretch.from + length };
                let evaluated = if stretch.clean_start { pair.rate.evaluate_from_clean_start() } else { Ok(()) };
                Advanced { revolutions, evaluated: evaluated.map(|()| pair.rate.work) }
            }
            Err(failure) => Advanced { revolutions: stretch.from, evaluated: Err(failure) },
        }
    }
}

/// A wearing pair whose working cycles are counted.
struct PairRate<'a> {
    pair: &'a mut dyn WearingPair,
    wear: &'a WearModel<'a>,
    stopped: &'a (dyn Fn() -> bool + Sync),
    wheel_meshes: f64,
    work: Work,
}

impl PairRate<'_> {
    /// Evaluates the pair once more as it is, as if for the first time.
    fn evaluate_from_clean_start(&mut self) -> Result<(), EquilibriumError> {
        self.pair.forget();
        self.work += self.pair.evaluate(self.wear, self.stopped)?;
        Ok(())
    }

    /// What the pair lost in its last evaluation, per pinion revolution.
    fn read_slope(&self, depth_mm: &mut PerGear<Vec<f64>>, slope: &mut [f64]) {
        self.pair.depth_mm(depth_mm);
        let (pinion, wheel) = slope.split_at_mut(depth_mm.pinion.len());
        pinion.copy_from_slice(&depth_mm.pinion);
        wheel.iter_mut().zip(&depth_mm.wheel).for_each(|(slope, depth)| *slope = self.wheel_meshes * depth);
    }
}

/// The same as rows of numbers.
struct OnRows<'a, 'b> {
    rate: PairRate<'a>,
    wear_mm: &'b mut PerGear<Vec<f64>>,
    depth_mm: &'b mut PerGear<Vec<f64>>,
}

impl Rate for OnRows<'_, '_> {
    type Error = EquilibriumError;

    fn evaluate(&mut self, state: &[f64], slope: &mut [f64]) -> Result<(), EquilibriumError> {
        let (pinion, wheel) = state.split_at(self.wear_mm.pinion.len());
        self.wear_mm.pinion.copy_from_slice(pinion);
        self.wear_mm.wheel.copy_from_slice(wheel);
        self.rate.pair.set_wear_mm(self.wear_mm);
        self.rate.work += self.rate.pair.evaluate(self.rate.wear, self.rate.stopped)?;
        self.rate.read_slope(self.depth_mm, slope);
        Ok(())
    }

    fn may_succeed_nearer(&self, failure: &EquilibriumError) -> bool {
        !matches!(failure, EquilibriumError::Interrupted)
    }
}
