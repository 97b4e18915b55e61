//! Steps of either method, one after another, as long as the error allows.
//!
//! **What the tolerance means.** It is a depth. The estimated error of a step, at whichever place it is greatest, stays below
//!
//! ```text
//! 0.3 · tolerance · max(1, greatest wear / 0.05 mm)
//! ```
//!
//! which leaves room for several steps whose errors add up where the wear is neutral (its mean over a contact); elsewhere later steps
//! wear the error down. Measured on the preset fzg-c (`docs/runs.md`) the error at the end is below the tolerance, unless a rate
//! jumps. What is estimated is kept with its sign ([`Adaptive::accumulated_error`]), so that a run can say in the end what it came to.
//!
//! **What else can happen to a step.** A trial state may have no rate (teeth without equilibrium): the step is shortened. A place
//! may seem to have grown where the rate jumps to and fro: it is taken to have stayed as it was, before the error is estimated.
//! No step is shorter than 1e-5 of what the run has done since it was last started anew (and never below 1e-11 of it all): at that
//! floor a step is taken whatever its error, and counted, so that a run ends in any case.

use serde::{Deserialize, Serialize};

use super::{
    Rate, diagonal, greatest,
    linearly_implicit::LinearlyImplicit,
    runge_kutta_chebyshev::{ERROR_FACTOR, MOST_STAGES, RungeKuttaChebyshev, stability_bound, stages_for},
    spectral_radius::SpectralRadius,
    step_control::{StepControl, Verdict},
};

/// Part of the tolerance that any step may spend.
const SHARE: f64 = 0.3;
/// Wear to which the tolerance itself holds, mm; beyond it grows in proportion: the default of 0.05 µm is a thousandth of it.
pub const SHALLOW_MM: f64 = 0.05;
/// Probes of the Jacobian over the tolerance.
const PROBE: f64 = 0.1;
/// Accepted steps until the spectral radius or the diagonal is estimated anew.
const RENEWAL: u32 = 20;
/// Shortest step over the length run since the start.
const FLOOR: f64 = 1e-5;
/// The same over the length of the whole run.
const FLOOR_OF_RUN: f64 = 1e-11;
/// Steps without a rate at their end are repeated with this part of their length.
const SHORTER: f64 = 0.25;

/// How a step is taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Method {
    Chebyshev { step: RungeKuttaChebyshev, radius: SpectralRadius },
    Implicit { step: LinearlyImplicit, diagonal: Vec<f64> },
}

/// What the steps came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct StepCounts {
    /// Steps taken.
    pub accepted: u64,
    /// Trial steps that were not, for their error or for want of a rate.
    pub rejected: u64,
    /// Steps taken at the shortest length in spite of their error.
    pub at_floor: u64,
    /// Evaluations of the rate in all steps and at their beginnings together.
    pub stages: u64,
    /// Evaluations that went into the spectral radius, the diagonal or the first length.
    pub probes: u64,
}

/// The integrator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Adaptive {
    tolerance: f64,
    duration: f64,
    blocks: Vec<usize>,
    method: Method,
    control: StepControl,
    /// Accepted steps since the Jacobian was last probed.
    age: u32,
    /// Length run since the start.
    run: f64,
    counts: StepCounts,
    accumulated: Vec<f64>,
    #[serde(skip)]
    end: Vec<f64>,
    #[serde(skip)]
    end_slope: Vec<f64>,
    #[serde(skip)]
    error: Vec<f64>,
}

impl Adaptive {
    fn new(tolerance: f64, duration: f64, blocks: &[usize], method: Method) -> Self {
        Self {
            tolerance,
            duration,
            blocks: blocks.to_vec(),
            method,
            control: StepControl::default(),
            age: 0,
            run: 0.0,
            counts: StepCounts::default(),
            accumulated: vec![0.0; blocks.iter().sum()],
            end: Vec::new(),
            end_slope: Vec::new(),
            error: Vec::new(),
        }
    }

    /// By Runge–Kutta–Chebyshev, for a run of the length `duration`; the state has `blocks` of these lengths.
    pub fn chebyshev(tolerance: f64, duration: f64, blocks: &[usize]) -> Self {
        let method = Method::Chebyshev { step: RungeKuttaChebyshev::default(), radius: SpectralRadius::default() };
        Self::new(tolerance, duration, blocks, method)
    }

    /// By the linearly implicit method.
    pub(crate) fn linearly_implicit(tolerance: f64, duration: f64, blocks: &[usize]) -> Self {
        let method = Method::Implicit { step: LinearlyImplicit::default(), diagonal: Vec::new() };
        Self::new(tolerance, duration, blocks, method)
    }

    /// What the steps came to so far.
    pub fn counts(&self) -> StepCounts {
        self.counts
    }

    /// The estimated errors of all steps together, place by place.
    pub(crate) fn accumulated_error(&self) -> &[f64] {
        &self.accumulated
    }

    /// What a step from `state` may be wrong by, mm.
    fn tolerance_at(&self, state: &[f64]) -> f64 {
        // The greater of 1 and what is not a number is 1.
        self.tolerance * (greatest(state) / SHALLOW_MM).max(1.0)
    }

    /// The rate is another one from here on: nothing that was learned holds any longer.
    pub(crate) fn start_anew(&mut self) {
        (self.control, self.run, self.age) = (StepControl::default(), 0.0, 0);
        self.forget_jacobian();
    }

    fn forget_jacobian(&mut self) {
        match &mut self.method {
            Method::Chebyshev { radius, .. } => radius.reset(),
            Method::Implicit { diagonal, .. } => diagonal.clear(),
        }
    }

    /// Takes one step of at most `room` from `state`, where the rate is `slope`; both are those of its end then, and `rate` was
    /// last evaluated there and may have been made anew. Answers its length.
    ///
    /// # Errors
    /// Of the rate, where no shorter step mends it.
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
        let floor = (FLOOR * self.run).max(FLOOR_OF_RUN * self.duration);
        loop {
            let planned = self.control.next().unwrap_or(room).max(floor);
            let mut length = fitting(planned, room);
            let tried = self.attempt(rate, state, slope, &mut length);
            let at_floor = length <= floor * (1.0 + 1e-9);
            match tried {
                Ok(()) => {}
                Err(failure) if rate.may_succeed_nearer(&failure) && !at_floor => {
                    self.counts.rejected += 1;
                    self.control.set_next(SHORTER * length);
                    self.renew_unless_fresh();
                    continue;
                }
                Err(failure) => return Err(failure),
            }
            let allowed = SHARE * self.tolerance_at(state);
            let error = greatest(&self.error) / allowed;
            let verdict = self.control.judge(length, error, length < planned);
            if verdict == Verdict::Rejected && !(at_floor && error.is_finite()) {
                self.counts.rejected += 1;
                self.renew_unless_fresh();
                continue;
            }
            self.counts.at_floor += u64::from(verdict == Verdict::Rejected);
            self.counts.accepted += 1;
            self.age += 1;
            if self.age >= RENEWAL {
                self.forget_jacobian();
            }
            self.run += length;
            self.accumulated.iter_mut().zip(&self.error).for_each(|(sum, e)| *sum += e);
            std::mem::swap(state, &mut self.end);
            std::mem::swap(slope, &mut self.end_slope);
            self.counts.stages += rate.begin_step(state, slope)?;
            return Ok(length);
        }
    }

    /// After a rejected step: what is known of the Jacobian may be the reason, where it is of an earlier state.
    fn renew_unless_fresh(&mut self) {
        if self.age > 0 {
            self.forget_jacobian();
        }
    }

    /// Tries a step, shortened where it must be: end, rate there, and error.
    fn attempt<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        state: &[f64],
        slope: &[f64],
        length: &mut f64,
    ) -> Result<(), R::Error> {
        let probe = PROBE * self.tolerance_at(state);
        let start = (state, slope);
        let error_factor = match &mut self.method {
            Method::Chebyshev { step, radius } => {
                if radius.value().is_none() {
                    self.counts.probes += radius.estimate(rate, start, probe)?;
                    self.age = 0;
                }
                let fastest = radius.value().filter(|radius| radius.is_finite()).unwrap_or_default();
                let stages = stages_for(*length * fastest).unwrap_or_else(|| {
                    *length = stability_bound(MOST_STAGES) / fastest;
                    MOST_STAGES
                });
                self.counts.stages += stages as u64;
                step.step(rate, start, *length, stages, &mut self.end)?;
                ERROR_FACTOR
            }
            Method::Implicit { step, diagonal } => {
                if diagonal.is_empty() {
                    self.counts.probes += diagonal::estimate(rate, start, &self.blocks, probe, diagonal)?;
                    self.age = 0;
                }
                self.counts.stages += 2;
                step.step(rate, start, *length, diagonal, &mut self.end)?;
                1.0
            }
        };
        self.end.iter_mut().zip(state).for_each(|(end, start)| *end = end.max(*start));
        self.end_slope.resize(state.len(), 0.0);
        rate.evaluate(&self.end, &mut self.end_slope)?;
        self.error.clear();
        let rates = slope.iter().zip(&self.end_slope);
        let ends = state.iter().zip(&self.end);
        let mean = 0.5 * *length;
        self.error.extend(ends.zip(rates).map(|((y, end), (f0, f1))| error_factor * (mean * (f0 + f1) - (end - y))));
        Ok(())
    }

    /// A length for the first step: half of that after which Euler's method is off by a step's part of the tolerance.
    fn first_length<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        state: &[f64],
        slope: &[f64],
        room: f64,
    ) -> Result<f64, R::Error> {
        let fastest = greatest(slope);
        let allowed = SHARE * self.tolerance_at(state);
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

/// `planned`, or what is left, or half of it where the rest would be a short step of its own.
fn fitting(planned: f64, room: f64) -> f64 {
    if planned >= room {
        room
    } else if 2.0 * planned > room {
        0.5 * room
    } else {
        planned
    }
}
