//! Steps of [`RungeKuttaChebyshev`] one after another, each as long as the error allows.
//!
//! **What the tolerance means.** It is a depth. The estimated error of a step, by its [`Rate::size`] (of gear flanks the greatest mean over half the
//! length over which pressures are averaged), stays below
//!
//! ```text
//! min(T, max(0.3 T, 2 % of the greatest wear))          T = tolerance · max(1, greatest wear / 0.05 mm)
//! ```
//!
//! What was estimated is worn down by later steps but for its mean over a contact, and is most of all that a worn zone grows by a place: of 72 random
//! scenes without severe wear the error at the end of the run is 0.05 of the tolerance in the median, in 95 % of them at most 0.5 of it; beyond that at
//! cliffs of the wear, whatever the tolerance. Steps of steep rates, as near severe wear, may spend 0.3 T whatever the wear: waves that they
//! leave are worn severely. The error at the end is 0.07 of the tolerance in the geometric mean of 20 random scenes with severe wear, and 1.4 of it at most
//! (wear of eleven tolerances, soft wheel, abrupt limit).
//!
//! What is estimated, where the change of the mean rate bounds it with the sign of what it bounds, is kept with its sign
//! ([`Adaptive::accumulated_error`]), so that a run can say in the end what it came to.
//!
//! **What else can happen to a step.** A trial state may have no rate (teeth without equilibrium): the step is shortened. A place
//! may seem to have grown where the rate jumps to and fro: it is taken to have stayed as it was, before the error is estimated.
//! No step is shorter than 1e-5 of what the run has done since it was last started anew (and never below 1e-11 of it all): at that
//! floor a step is taken whatever its error, and counted, so that a run ends in any case.

use serde::{Deserialize, Serialize};

use super::{
    Rate, greatest,
    runge_kutta_chebyshev::{ERROR_FACTOR, MOST_STAGES, RungeKuttaChebyshev, stability_bound, stages_for},
    spectral_radius::SpectralRadius,
    step_control::{StepControl, StepVerdict},
};

/// What steps of smooth rates spend, aim at and probe.
const OF_SMOOTH_RATES: Aim = Aim { least_share: 0.3, most_share: 1.0, safety: 0.8, probe: 0.1 };
/// What steps of steep rates do. Waves lower than the probe are not damped where rates jump: with 0.1 severe wear of eleven tolerances is a third too deep, with
/// 0.01 a tenth at most, for as many evaluations on average. Smooth rates take half as many stages again with 0.01 on tip edges that are all but sharp.
const OF_STEEP_RATES: Aim = Aim { least_share: 0.3, most_share: 0.3, safety: 0.9, probe: 0.01 };
/// Part of the greatest wear that a step may spend, between the least and the most share of the tolerance.
const OF_GREATEST_WEAR: f64 = 0.02;
/// Wear to which the tolerance itself holds, mm; beyond it grows in proportion: the default of 0.05 µm is a thousandth of it.
pub const SHALLOW_MM: f64 = 0.05;
/// Accepted steps until the spectral radius is estimated anew.
const RENEWAL: u32 = 20;
/// Shortest step over the length run since the start.
const FLOOR: f64 = 1e-5;
/// Shortest step over the length of the whole run.
const FLOOR_OF_RUN: f64 = 1e-11;
/// Factor of the change of the mean rate from step to step, where that is the estimated error.
const CHANGE_FACTOR: f64 = 2.0;
/// Part of the jumps of a rate that is remembered from step to step.
const REMEMBERED: f64 = 0.9;
/// Greatest ratio of a jump to those seen before that still counts as one of them.
const LIKE_BEFORE: f64 = 2.0;
/// Steps without a rate at their end are repeated with this part of their length.
const SHORTER: f64 = 0.25;

/// What the steps of a rate spend, aim at and probe.
#[derive(Debug, Clone, Copy)]
struct Aim {
    /// Part of the tolerance that any step may spend.
    least_share: f64,
    /// Part of the tolerance that no step may exceed.
    most_share: f64,
    /// Part of the length that would spend it, at which the next step aims.
    safety: f64,
    /// Height of the probes of the spectral radius over the tolerance.
    probe: f64,
}

impl Aim {
    fn of<R: Rate + ?Sized>(rate: &R) -> Self {
        if rate.is_steep() { OF_STEEP_RATES } else { OF_SMOOTH_RATES }
    }

    /// Error that a step may have within `tolerance` where the greatest wear is `deepest`.
    fn allowed(&self, tolerance: f64, deepest: f64) -> f64 {
        (OF_GREATEST_WEAR * deepest).max(self.least_share * tolerance).min(self.most_share * tolerance)
    }
}

/// Counts of steps and of evaluations of the rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct StepCounts {
    /// Steps taken.
    pub accepted: u64,
    /// Trial steps repeated, for their error or for want of a rate.
    pub rejected: u64,
    /// Steps taken at the shortest length in spite of their error.
    pub at_floor: u64,
    /// Evaluations of the rate in all steps and at their beginnings together.
    pub stages: u64,
    /// Evaluations for the spectral radius and the length of the first step.
    pub probes: u64,
}

/// The integrator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Adaptive {
    tolerance: f64,
    duration: f64,
    method: RungeKuttaChebyshev,
    radius: SpectralRadius,
    control: StepControl,
    /// Accepted steps since the spectral radius was last estimated.
    age: u32,
    /// Whether the rate was steep in the last step.
    was_steep: bool,
    /// Rejected steps since the last accepted one.
    rejected_in_a_row: u32,
    /// Length run since the start.
    run: f64,
    counts: StepCounts,
    accumulated: Vec<f64>,
    /// Mean rate of each place over the last step since the start; empty before one.
    mean_rate: Vec<f64>,
    /// How far the mean of the rates at both ends of earlier steps was from the mean rate of each place.
    jumps: Vec<f64>,
    #[serde(skip)]
    end: Vec<f64>,
    #[serde(skip)]
    end_slope: Vec<f64>,
    #[serde(skip)]
    error: Vec<f64>,
}

impl Adaptive {
    /// An integrator for a run of the length `duration` with `places` in its state, whose errors stay below `tolerance`.
    pub fn new(tolerance: f64, duration: f64, places: usize) -> Self {
        Self {
            tolerance,
            duration,
            method: RungeKuttaChebyshev::default(),
            radius: SpectralRadius::default(),
            control: StepControl::default(),
            age: 0,
            was_steep: false,
            rejected_in_a_row: 0,
            run: 0.0,
            counts: StepCounts::default(),
            accumulated: vec![0.0; places],
            mean_rate: Vec::new(),
            jumps: Vec::new(),
            end: Vec::new(),
            end_slope: Vec::new(),
            error: Vec::new(),
        }
    }

    /// Counts of the steps so far.
    pub fn counts(&self) -> StepCounts {
        self.counts
    }

    /// Sum of the estimated errors of all steps, place by place, mm.
    pub(crate) fn accumulated_error(&self) -> &[f64] {
        &self.accumulated
    }

    /// Tolerance at the wear `state`, mm.
    fn tolerance_at(&self, state: &[f64]) -> f64 {
        // max ignores a NaN.
        self.tolerance * (greatest(state) / SHALLOW_MM).max(1.0)
    }

    /// Forgets what was learned of the rate, which is another one from here on.
    pub(crate) fn start_anew(&mut self) {
        (self.control, self.run) = (StepControl::default(), 0.0);
        (self.age, self.rejected_in_a_row) = (0, 0);
        self.radius.reset();
        self.mean_rate.clear();
        self.jumps.clear();
    }

    /// Takes one step of at most `room` from `state`, where the rate is `slope`, and moves both to its end, where `rate` was last evaluated.
    /// Returns the length of the step.
    ///
    /// # Errors
    /// Failure of the rate that no shorter step mends.
    pub fn step<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        state: &mut Vec<f64>,
        slope: &mut Vec<f64>,
        room: f64,
    ) -> Result<f64, R::Error> {
        if self.control.next().is_none() {
            let first = self.first_length(rate, state, slope, room)?;
            self.control.set_next(first);
        }
        if std::mem::replace(&mut self.was_steep, rate.is_steep()) != rate.is_steep() {
            self.radius.reset();
        }
        let aim = Aim::of(rate);
        let floor = (FLOOR * self.run).max(FLOOR_OF_RUN * self.duration);
        loop {
            let planned = self.control.next().unwrap_or(room).max(floor);
            let mut length = fitting(planned, room);
            let allowed = aim.allowed(self.tolerance_at(state), greatest(state));
            let tried = self.attempt(rate, (state, slope), &mut length, (allowed, floor));
            let at_floor = is_at_floor(length, floor);
            let error = match tried {
                Ok(error) => error,
                Err(failure) if rate.may_succeed_nearer(&failure) && !at_floor => {
                    self.count_rejected();
                    self.control.set_next(SHORTER * length);
                    continue;
                }
                Err(failure) => return Err(failure),
            };
            let verdict = self.control.judge(length, error, length < planned, aim.safety);
            if verdict == StepVerdict::Rejected && !(at_floor && error.is_finite()) {
                self.count_rejected();
                continue;
            }
            self.counts.at_floor += u64::from(verdict == StepVerdict::Rejected);
            self.counts.accepted += 1;
            (self.age, self.rejected_in_a_row) = (self.age + 1, 0);
            if self.age >= RENEWAL {
                self.radius.reset();
            }
            self.run += length;
            self.remember_jumps(state, slope, length);
            self.mean_rate.clear();
            self.mean_rate.extend(state.iter().zip(&self.end).map(|(start, end)| (end - start) / length));
            self.accumulated.iter_mut().zip(&self.error).for_each(|(sum, e)| *sum += e);
            std::mem::swap(state, &mut self.end);
            std::mem::swap(slope, &mut self.end_slope);
            self.counts.stages += rate.begin_step(state, slope)?;
            return Ok(length);
        }
    }

    /// Counts a rejected step, and has the spectral radius estimated anew where it is that of an earlier state, which may be the reason. An estimate
    /// that wandered is dear, and no better anew: a shorter step comes first.
    fn count_rejected(&mut self) {
        self.counts.rejected += 1;
        self.rejected_in_a_row += 1;
        if self.age > 0 && (!self.radius.wanders() || self.rejected_in_a_row > 1) {
            self.radius.reset();
        }
    }

    /// Tries a step, shortened where no number of stages is stable: finds its end, the rate there and the error over the one that is `allowed`. A step that
    /// is too long by the sources that changed in its stages is not evaluated in the others.
    fn attempt<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        start: (&[f64], &[f64]),
        length: &mut f64,
        (allowed, floor): (f64, f64),
    ) -> Result<f64, R::Error> {
        let (state, slope) = start;
        if self.radius.bound(false).is_none() {
            let probe = Aim::of(rate).probe * self.tolerance_at(state);
            self.counts.probes += self.radius.estimate(rate, start, probe)?;
            self.age = 0;
        }
        let fastest = self.radius.bound(rate.is_steep()).filter(|radius| radius.is_finite()).unwrap_or_default();
        let stages = stages_for(*length * fastest).unwrap_or_else(|| {
            *length = stability_bound(MOST_STAGES) / fastest;
            MOST_STAGES
        });
        self.counts.stages += stages as u64;
        self.method.step(rate, start, *length, stages, &mut self.end)?;
        self.end.iter_mut().zip(state).for_each(|(end, start)| *end = end.max(*start));
        self.end_slope.resize(state.len(), 0.0);
        rate.evaluate_end(&self.end, &mut self.end_slope)?;
        self.estimate_error(state, slope, *length);
        let error = rate.size(&self.error) / allowed;
        let is_taken = error <= 1.0 || is_at_floor(*length, floor);
        if !is_taken || !rate.complete_stage(&self.end, &mut self.end_slope)? {
            return Ok(error);
        }
        self.estimate_error(state, slope, *length);
        Ok(rate.size(&self.error) / allowed)
    }

    /// Difference of the mean of the rates at both ends of a step of `length` from its mean rate, times its length, place by place.
    fn off_mean<'a>(&'a self, state: &'a [f64], slope: &'a [f64], length: f64) -> impl Iterator<Item = f64> + 'a {
        let ends = state.iter().zip(&self.end);
        let rates = slope.iter().zip(&self.end_slope);
        ends.zip(rates).map(move |((y, end), (f0, f1))| 0.5 * length * (f0 + f1) - (end - y))
    }

    /// Estimates the error of a step of `length` from `state` and its `slope` to the end that was found, place by place.
    fn estimate_error(&mut self, state: &[f64], slope: &[f64], length: f64) {
        let mut errors = std::mem::take(&mut self.error);
        errors.clear();
        errors.extend(self.off_mean(state, slope, length).map(|off_mean| ERROR_FACTOR * off_mean));
        // Both are empty before the first step.
        let before = self.mean_rate.iter().zip(&self.jumps);
        let places = errors.iter_mut().zip(before).zip(state.iter().zip(&self.end));
        for ((error, (mean_rate, jump)), (y, end)) in places {
            let jumped_before = error.abs() <= LIKE_BEFORE * ERROR_FACTOR * length * jump;
            let change = CHANGE_FACTOR * ((end - y) - length * mean_rate).abs();
            // A place that would have grown, and was held, says nothing by its mean rate.
            if jumped_before && end > y && change < error.abs() {
                *error = change.copysign(*error);
            }
        }
        self.error = errors;
    }

    /// Remembers how far the rates at the ends of an accepted step were from its mean rate.
    fn remember_jumps(&mut self, state: &[f64], slope: &[f64], length: f64) {
        let mut jumps = std::mem::take(&mut self.jumps);
        jumps.resize(state.len(), 0.0);
        for (jump, off_mean) in jumps.iter_mut().zip(self.off_mean(state, slope, length)) {
            *jump = (REMEMBERED * *jump).max(off_mean.abs() / length);
        }
        self.jumps = jumps;
    }

    /// Length of the first step: half of that after which the error of Euler's method is the part of the tolerance that a step may spend.
    fn first_length<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        state: &[f64],
        slope: &[f64],
        room: f64,
    ) -> Result<f64, R::Error> {
        let fastest = greatest(slope);
        let allowed = Aim::of(rate).allowed(self.tolerance_at(state), greatest(state));
        if fastest * room <= allowed {
            return Ok(room);
        }
        let short = allowed / fastest;
        self.end.clear();
        self.end.extend(state.iter().zip(slope).map(|(y, f)| y + short * f));
        self.end_slope.resize(state.len(), 0.0);
        rate.evaluate(&self.end, &mut self.end_slope)?;
        self.counts.probes += 1;
        self.end_slope.iter_mut().zip(slope).for_each(|(end, f)| *end -= f);
        let change = greatest(&self.end_slope) / short;
        Ok((0.5 * (2.0 * allowed / change).sqrt()).clamp(short, room))
    }
}

/// Whether a step is not longer than the shortest.
fn is_at_floor(length: f64, floor: f64) -> bool {
    length <= floor * (1.0 + 1e-9)
}

/// Length of a step: `planned`, `room` where that is shorter, or half of `room` where the remainder would be a short step of its own.
fn fitting(planned: f64, room: f64) -> f64 {
    if planned >= room {
        room
    } else if 2.0 * planned > room {
        0.5 * room
    } else {
        planned
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// A drive y₀ that rises evenly, and a wear y₁ that is a thousand times as fast where y₀ − y₁ is above 1: it holds y₀ − y₁ at that limit.
    struct HeldAtALimit;

    impl Rate for HeldAtALimit {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate.copy_from_slice(&[1.0, if state[0] - state[1] > 1.0 { 100.0 } else { 0.1 }]);
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// A rate that becomes a hundred times as great once, and stays so.
    struct RisesOnce;

    impl Rate for RisesOnce {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate.copy_from_slice(&[0.02, if state[0] < 0.02 * 0.617 { 0.002 } else { 0.2 }]);
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// A source y₀' that rises at the time t = y₂ = 0.41, beside a slow one, y₁' = y₂, which stays as it is over the stages.
    #[derive(Default)]
    struct RisesBesideSlow {
        kept: Option<f64>,
        completed: u64,
    }

    impl Rate for RisesBesideSlow {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate.copy_from_slice(&[if state[2] < 0.41 { 0.1 } else { 5.0 }, state[2], 1.0]);
            Ok(())
        }

        fn begin_step(&mut self, _: &[f64], rate: &mut [f64]) -> Result<u64, Infallible> {
            self.kept = Some(rate[1]);
            Ok(0)
        }

        fn evaluate_stage(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            let Ok(()) = self.evaluate(state, rate);
            rate[1] = self.kept.unwrap_or(rate[1]);
            Ok(())
        }

        fn complete_stage(&mut self, state: &[f64], rate: &mut [f64]) -> Result<bool, Infallible> {
            self.completed += 1;
            self.evaluate(state, rate).map(|()| true)
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// Slow sources are found at the ends of the steps that are taken, and not of those that others reject; what they changed by is in the error.
    #[test]
    fn ver_slow_sources_are_found_where_a_step_is_taken() {
        let tolerance = 1e-3;
        let mut integrator = Adaptive::new(tolerance, 1.0, 3);
        let mut rate = RisesBesideSlow::default();
        let (mut state, mut slope) = (vec![0.0, 0.0, 0.01], vec![0.0; 3]);
        let Ok(()) = rate.evaluate(&state, &mut slope);
        let mut reached = 0.0;
        while reached < 1.0 - 1e-12 {
            let Ok(length) = integrator.step(&mut rate, &mut state, &mut slope, 1.0 - reached);
            reached += length;
        }
        let counts = integrator.counts();
        assert!(counts.rejected > 0, "{counts:?}");
        let by_slow = rate.completed - counts.accepted;
        assert!(by_slow < counts.rejected, "{} completed, {counts:?}", rate.completed);
        // Euler's method, of which the estimated errors add up.
        let exact = 0.01 + 0.5;
        let (off, estimated) = (exact - state[1], integrator.accumulated_error()[1]);
        assert!(off > 0.0 && (off - estimated / ERROR_FACTOR).abs() < 0.01 * off, "{off:e}, estimated {estimated:e}");
    }

    /// y₀' = 0.05 e^(−300 y₁), y₁' = 0.01: smooth, whatever it says of itself.
    struct Smooth {
        is_steep: bool,
    }

    impl Rate for Smooth {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate.copy_from_slice(&[0.05 * (-300.0 * state[1]).exp(), 0.01]);
            Ok(())
        }

        fn is_steep(&self) -> bool {
            self.is_steep
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// Steps spend the part of the tolerance that docs/theory.md names, all of it where wear is deep, or 0.3 of rates that may be steep, in one step with
    /// another more than a third of it; and what they say they spent is no less than the error at the end.
    #[test]
    fn ver_steps_spend_their_part_of_the_tolerance() {
        let tolerance = 1e-5;
        for (is_steep, part) in [(false, 1.0), (true, 0.3)] {
            let mut integrator = Adaptive::new(tolerance, 1.0, 2);
            let (mut rate, mut state, mut slope) = (Smooth { is_steep }, vec![0.0; 2], vec![0.05, 0.01]);
            let mut reached = 0.0;
            while reached < 1.0 - 1e-12 {
                let Ok(length) = integrator.step(&mut rate, &mut state, &mut slope, 1.0 - reached);
                reached += length;
            }
            let exact = 0.05 / 3.0 * (1.0 - (-3.0_f64).exp());
            let (off, spent) = ((state[0] - exact).abs(), integrator.accumulated_error()[0].abs());
            let of_each = spent / tolerance / integrator.counts().accepted as f64;
            println!("{is_steep}: {of_each} of the tolerance a step, {off:e} of {spent:e}");
            assert!(part / 3.0 < of_each && of_each <= part, "{is_steep}: {of_each}");
            assert!(0.3 * spent < off && off <= spent, "{is_steep}: {off:e} of {spent:e}");
        }
    }

    /// What a step may spend of the tolerance grows with the wear beside it, and not of steep rates.
    #[test]
    fn ver_shallow_wear_has_a_smaller_part_of_the_tolerance() {
        let parts = [(0.0, 0.3), (10.0, 0.3), (30.0, 0.6), (50.0, 1.0), (1e4, 1.0), (f64::NAN, 0.3)];
        for (deepest, part) in parts {
            let tolerance = 5e-5;
            let allowed = |aim: Aim| aim.allowed(tolerance, deepest * tolerance) / tolerance;
            assert!((allowed(OF_SMOOTH_RATES) - part).abs() < 1e-12, "{deepest}: {}", allowed(OF_SMOOTH_RATES));
            assert!((allowed(OF_STEEP_RATES) - 0.3).abs() < 1e-12, "{deepest}");
        }
    }

    /// A rise that was not there before counts as what it is, however steps are cut.
    #[test]
    fn ver_a_rate_that_rises_once_is_not_missed() {
        for room in [1.0, 0.05] {
            let mut integrator = Adaptive::new(5e-5, 1.0, 2);
            let (mut state, mut slope) = (vec![0.0, 0.0], vec![0.02, 0.002]);
            let (mut reached, mut cuts) = (0.0, 1.0);
            while reached < 1.0 - 1e-12 {
                let to_cut = f64::min(cuts * room, 1.0) - reached;
                let Ok(length) = integrator.step(&mut RisesOnce, &mut state, &mut slope, to_cut);
                reached += length;
                if length >= to_cut {
                    cuts += 1.0;
                }
            }
            let exact = 0.002 * 0.617 + 0.2 * 0.383;
            assert!((state[1] - exact).abs() < 5e-5, "{room}: {state:?} {exact}");
        }
    }

    /// At the limit the rate jumps to and fro; steps follow its mean, and need not be as short as its jumps ask for.
    #[test]
    fn ver_jumping_rates_take_few_steps() {
        let (duration, tolerance) = (10.0, 0.02);
        let mut integrator = Adaptive::new(tolerance, duration, 2);
        let (mut state, mut slope) = (vec![0.0, 0.0], vec![1.0, 0.1]);
        let mut reached = 0.0;
        while reached < duration {
            let Ok(length) = integrator.step(&mut HeldAtALimit, &mut state, &mut slope, duration - reached);
            reached += length;
        }
        let counts = integrator.counts();
        assert!((state[1] - (duration - 1.0)).abs() < 2.0 * tolerance, "{state:?}");
        assert!(counts.stages + counts.probes < 500, "{counts:?}");
    }
}
