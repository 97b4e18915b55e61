//! From one evaluated state of a wearing pair to the next.
//!
//! Euler's method, that of the thesis, keeps the depth per mesh of one evaluation for the whole step. Each pinion tooth meshes once per
//! pinion turn, each wheel tooth z1/z2 times; of a gear that several mates run on, as a sun, so many times as often (n1, n2):
//!
//! ```text
//! h1 ← h1 + Δn · n1 · dh1          h2 ← h2 + Δn · n2 · (z1/z2) · dh2
//! ```
//!
//! The last step of an interval is shortened to its end. Adaptive steps ([`crate::wear::stepping`]) integrate the wear of both gears as one
//! row of numbers, in depth per pinion revolution.

use serde::{Deserialize, Serialize};

use super::settings::Stepping;
use crate::mesh_cycle::wearing_pair::WearingPair;
use crate::mesh_cycle::{Work, load_sharing::EquilibriumError};
use crate::wear::WearModel;
use crate::wear::stepping::{
    Rate,
    adaptive::{Adaptive, StepCounts},
    spectral_radius::SpectralRadius,
};
use gearwear_bodies::gear::{Gear, PerGear};

/// Part of a step below which a remainder joins the step before it.
const NEGLIGIBLE_STEP: f64 = 1e-9;

/// Interval of a wear step, in pinion revolutions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepInterval {
    /// Beginning, where the pair is evaluated.
    pub from: f64,
    /// Latest end, greater than `from`.
    pub limit: f64,
    /// Whether the pair is reset ([`WearingPair::reset`]) before its evaluation at the end of the step, from which a run may be resumed.
    pub clean_start: bool,
}

/// Result of a wear step.
#[derive(Debug)]
pub struct Advanced {
    /// Pinion revolutions reached.
    pub revolutions: f64,
    /// Evaluation there, with the work of the whole step.
    pub evaluated: Result<Work, EquilibriumError>,
}

/// State of a [`Stepper`], for checkpoints.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct StepperState {
    euler_steps: u64,
    adaptive: Option<Adaptive>,
}

/// Integrator of the wear in time.
pub(crate) struct Stepper {
    stepping: Stepping,
    duration: f64,
    /// Of a tooth of each gear per turn of the pinion.
    meshes: PerGear<f64>,
    euler_steps: u64,
    /// Integrator of adaptive steps, from the first on.
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
    /// Stepper of a run of `duration` pinion revolutions.
    pub(crate) fn new(stepping: Stepping, duration: f64, meshes: PerGear<f64>) -> Self {
        Self { stepping, duration, meshes, euler_steps: 0, adaptive: None }
    }

    /// Forgets the step length: load, speed or law change here.
    pub(crate) fn begin_phase(&mut self) {
        if let Some(steps) = &mut self.adaptive {
            steps.integrator.start_anew();
        }
    }

    /// Counts of the steps so far.
    pub(crate) fn counts(&self) -> StepCounts {
        match &self.adaptive {
            Some(steps) => steps.integrator.counts(),
            None => StepCounts { accepted: self.euler_steps, stages: self.euler_steps, ..StepCounts::default() },
        }
    }

    /// Estimated error of adaptive steps in each gear's wear where that is greatest, mm: its mean along the flank about that place
    /// ([`WearingPair::mean_about_mm`]), as later steps wear down what differs from place to place.
    pub(crate) fn error_mm(&self, pair: &dyn WearingPair) -> Option<PerGear<f64>> {
        let steps = self.adaptive.as_ref()?;
        let places = steps.wear_mm.pinion.len();
        let (wear, error) = (steps.state.split_at(places), steps.integrator.accumulated_error().split_at(places));
        let [pinion, wheel] =
            [(Gear::Pinion, wear.0, error.0), (Gear::Wheel, wear.1, error.1)].map(|(gear, wear, error)| {
                let greatest = wear.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
                greatest.map_or(0.0, |(place, _)| pair.mean_about_mm(gear, place, error).abs())
            });
        Some(PerGear { pinion, wheel })
    }

    /// State after the last step.
    pub(crate) fn state(&self) -> StepperState {
        let adaptive = self.adaptive.as_ref().map(|steps| steps.integrator.clone());
        StepperState { euler_steps: self.euler_steps, adaptive }
    }

    /// Restores a state, with the wear `wear_mm`; false where the state has other places.
    pub(crate) fn resume(&mut self, state: StepperState, wear_mm: &PerGear<Vec<f64>>) -> bool {
        self.euler_steps = state.euler_steps;
        let places = wear_mm.as_ref().map(Vec::len).sum();
        let fits = state.adaptive.as_ref().is_none_or(|integrator| integrator.accumulated_error().len() == places);
        self.adaptive = state.adaptive.filter(|_| fits).map(|integrator| {
            let state = Gear::BOTH.iter().flat_map(|&gear| &wear_mm[gear]).copied().collect();
            let (wear_mm, depth_mm) = (wear_mm.clone(), wear_mm.clone());
            Box::new(AdaptiveSteps { integrator, state, slope: Vec::new(), wear_mm, depth_mm })
        });
        fits
    }

    /// Takes `pair`, which is evaluated at the beginning of `interval`, one step on, and evaluates it there.
    pub(crate) fn advance(
        &mut self,
        pair: &mut dyn WearingPair,
        wear: &WearModel<'_>,
        interval: StepInterval,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Advanced {
        match self.stepping {
            Stepping::Fixed { revolutions } => self.euler(revolutions, pair, wear, interval, stopped),
            Stepping::Adaptive { tolerance_mm } => {
                let (duration, meshes) = (self.duration, self.meshes);
                let steps =
                    self.adaptive.get_or_insert_with(|| Box::new(AdaptiveSteps::new(pair, tolerance_mm, duration)));
                steps.advance(
                    PairRate { pair, wear, stopped, meshes, work: Work::default(), partial_at_end: 0 },
                    interval,
                )
            }
        }
    }

    fn euler(
        &mut self,
        step: f64,
        pair: &mut dyn WearingPair,
        wear: &WearModel<'_>,
        interval: StepInterval,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Advanced {
        let arrives = interval.from + step * (1.0 + NEGLIGIBLE_STEP) >= interval.limit;
        let step = if arrives { interval.limit - interval.from } else { step };
        pair.wear_for(self.meshes.map(|meshes| step * meshes));
        self.euler_steps += 1;
        let revolutions = if arrives { interval.limit } else { interval.from + step };
        if interval.clean_start {
            pair.reset();
        }
        Advanced { revolutions, evaluated: evaluate(pair, wear, stopped) }
    }
}

/// Evaluates `pair` at the end of a step of Euler's method or of the run.
pub(super) fn evaluate(
    pair: &mut dyn WearingPair,
    wear: &WearModel<'_>,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Work, EquilibriumError> {
    let mut work = pair.evaluate(wear, stopped)?;
    work += pair.linearise_anew(wear, stopped)?.unwrap_or_default();
    Ok(work)
}

impl AdaptiveSteps {
    fn new(pair: &dyn WearingPair, tolerance_mm: f64, duration: f64) -> Self {
        let wear_mm = pair.wear_mm();
        let integrator = Adaptive::new(tolerance_mm, duration, wear_mm.pinion.len() + wear_mm.wheel.len());
        let depth_mm = wear_mm.clone();
        Self { integrator, state: Vec::new(), slope: Vec::new(), wear_mm, depth_mm }
    }

    fn advance(&mut self, rate: PairRate<'_>, interval: StepInterval) -> Advanced {
        self.wear_mm = rate.pair.wear_mm();
        self.state.clear();
        self.state.extend(Gear::BOTH.iter().flat_map(|&gear| &self.wear_mm[gear]));
        self.slope.resize(self.state.len(), 0.0);
        rate.read_slope(&mut self.depth_mm, &mut self.slope);
        rate.pair.begin_stages(rate.wear);
        let is_steep = rate.pair.may_wear_severely(rate.wear);
        let clean_start = interval.clean_start;
        let (wear_mm, depth_mm) = (&mut self.wear_mm, &mut self.depth_mm);
        let mut pair = OnRows { rate, wear_mm, depth_mm, clean_start, probes_a_part: true, is_steep };
        let room = interval.limit - interval.from;
        match self.integrator.step(&mut pair, &mut self.state, &mut self.slope, room) {
            Ok(length) => {
                let arrives = length >= room;
                let revolutions = if arrives { interval.limit } else { interval.from + length };
                Advanced { revolutions, evaluated: Ok(pair.rate.work) }
            }
            Err(failure) => Advanced { revolutions: interval.from, evaluated: Err(failure) },
        }
    }
}

/// Depth of the waves that are probed on otherwise linear flanks, mm: well above the rounding of equilibria, well below any approach.
const PROBE_MM: f64 = 1e-5;

/// The fastest rate at which waves of wear of `pair`, which is evaluated, decay, per pinion revolution, and how many evaluations
/// it took to find. `stopped` is asked now and then whether to give up.
pub(super) fn fastest_decay(
    pair: &mut dyn WearingPair,
    wear: &WearModel<'_>,
    meshes: PerGear<f64>,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<(f64, u64), EquilibriumError> {
    let mut wear_mm = pair.wear_mm();
    let mut depth_mm = wear_mm.clone();
    let state: Vec<f64> = Gear::BOTH.iter().flat_map(|&gear| &wear_mm[gear]).copied().collect();
    let mut slope = vec![0.0; state.len()];
    let rate = PairRate { pair, wear, stopped, meshes, work: Work::default(), partial_at_end: 0 };
    rate.read_slope(&mut depth_mm, &mut slope);
    let (wear_mm, depth_mm) = (&mut wear_mm, &mut depth_mm);
    let mut rows = OnRows { rate, wear_mm, depth_mm, clean_start: false, probes_a_part: false, is_steep: false };
    let mut radius = SpectralRadius::default();
    let evaluations = radius.estimate(&mut rows, (&state, &slope), PROBE_MM)?;
    Ok((radius.found(), evaluations))
}

/// A wearing pair whose mesh cycles are counted.
struct PairRate<'a> {
    pair: &'a mut dyn WearingPair,
    wear: &'a WearModel<'a>,
    stopped: &'a (dyn Fn() -> bool + Sync),
    /// Of a tooth of each gear per turn of the pinion.
    meshes: PerGear<f64>,
    work: Work,
    /// Equilibria at the end of the last step, where they were those of a part of the positions.
    partial_at_end: u64,
}

impl PairRate<'_> {
    /// Depth of the last evaluation, per pinion revolution.
    fn read_slope(&self, depth_mm: &mut PerGear<Vec<f64>>, slope: &mut [f64]) {
        self.pair.depth_mm(depth_mm);
        let (pinion, wheel) = slope.split_at_mut(depth_mm.pinion.len());
        for (row, gear) in [(pinion, Gear::Pinion), (wheel, Gear::Wheel)] {
            row.iter_mut().zip(&depth_mm[gear]).for_each(|(slope, depth)| *slope = self.meshes[gear] * depth);
        }
    }
}

/// Wear of both gears as one row of numbers.
struct OnRows<'a, 'b> {
    rate: PairRate<'a>,
    wear_mm: &'b mut PerGear<Vec<f64>>,
    depth_mm: &'b mut PerGear<Vec<f64>>,
    /// Whether the next step begins from a clean start.
    clean_start: bool,
    /// Whether wear may be severe within the step.
    is_steep: bool,
    /// Whether a part of the mesh cycle may stand for all of it in probes of the spectral radius.
    probes_a_part: bool,
}

impl OnRows<'_, '_> {
    /// Sets the wear of the pair.
    fn set(&mut self, state: &[f64]) {
        let (pinion, wheel) = state.split_at(self.wear_mm.pinion.len());
        self.wear_mm.pinion.copy_from_slice(pinion);
        self.wear_mm.wheel.copy_from_slice(wheel);
        self.rate.pair.set_wear_mm(self.wear_mm);
    }
}

impl Rate for OnRows<'_, '_> {
    type Error = EquilibriumError;

    fn evaluate(&mut self, state: &[f64], slope: &mut [f64]) -> Result<(), EquilibriumError> {
        self.set(state);
        self.rate.work += self.rate.pair.evaluate(self.rate.wear, self.rate.stopped)?;
        self.rate.read_slope(self.depth_mm, slope);
        Ok(())
    }

    fn evaluate_stage(&mut self, state: &[f64], slope: &mut [f64]) -> Result<(), EquilibriumError> {
        self.set(state);
        self.rate.work += self.rate.pair.evaluate_stage(self.rate.wear, self.rate.stopped)?;
        self.rate.read_slope(self.depth_mm, slope);
        Ok(())
    }

    fn evaluate_end(&mut self, state: &[f64], slope: &mut [f64]) -> Result<(), EquilibriumError> {
        self.set(state);
        let work = self.rate.pair.evaluate_end(self.rate.wear, self.rate.stopped)?;
        self.rate.partial_at_end = work.partial_equilibria;
        self.rate.work += work;
        self.rate.read_slope(self.depth_mm, slope);
        Ok(())
    }

    fn complete_stage(&mut self, _state: &[f64], slope: &mut [f64]) -> Result<bool, EquilibriumError> {
        let Some(work) = self.rate.pair.complete_stage(self.rate.wear, self.rate.stopped)? else { return Ok(false) };
        // With those at the end of the step these are all positions.
        self.rate.work += Work { mesh_cycles: 1, partial_equilibria: 0, ..work };
        self.rate.work.partial_equilibria -= self.rate.partial_at_end;
        self.rate.read_slope(self.depth_mm, slope);
        Ok(true)
    }

    fn begin_step(&mut self, state: &[f64], slope: &mut [f64]) -> Result<u64, EquilibriumError> {
        if self.clean_start {
            self.rate.pair.reset();
            return self.evaluate(state, slope).map(|()| 1);
        }
        if let Some(work) = self.rate.pair.linearise_anew(self.rate.wear, self.rate.stopped)? {
            self.rate.work += work;
            self.rate.read_slope(self.depth_mm, slope);
        }
        Ok(0)
    }

    fn choose_part(&mut self, state: &[f64]) -> Result<Option<Vec<f64>>, EquilibriumError> {
        if !self.probes_a_part || !self.rate.pair.choose_part() {
            return Ok(None);
        }
        let mut slope = vec![0.0; state.len()];
        self.evaluate_part(state, &mut slope)?;
        Ok(Some(slope))
    }

    fn evaluate_part(&mut self, state: &[f64], slope: &mut [f64]) -> Result<(), EquilibriumError> {
        self.set(state);
        self.rate.work += self.rate.pair.evaluate_part(self.rate.wear, self.rate.stopped)?;
        self.rate.read_slope(self.depth_mm, slope);
        Ok(())
    }

    fn is_steep(&self) -> bool {
        self.is_steep
    }

    fn size(&self, row: &[f64]) -> f64 {
        let (pinion, wheel) = row.split_at(self.wear_mm.pinion.len());
        self.rate.pair.greatest_mean_mm(PerGear { pinion, wheel })
    }

    fn may_succeed_nearer(&self, failure: &EquilibriumError) -> bool {
        !matches!(failure, EquilibriumError::Interrupted)
    }
}
