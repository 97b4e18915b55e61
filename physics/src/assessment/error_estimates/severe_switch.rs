//! Sensitivity of the wear to an abrupt transition to severe wear in place of one over a band.
//!
//! The abrupt transition of the thesis makes the rate jump: pressure is worn down to the limit and chatters there, by as much as a step
//! wears. Over a band the rate is continuous, and steps converge. Two short companions, alike in everything else, give the
//! difference: one with the abrupt transition, one with a band,
//!
//! ```text
//! severe switch    |h(abrupt) − h(band)| / h(the scene's own kind)
//! ```
//!
//! with a quarter of the points, a half or a quarter of the positions (as the budget allows) and the longest of Euler's steps that are stable under severe wear; of both gears'
//! differences of the peak wear the larger. Where that many steps cost more than the budget, there is no estimate: longer ones would
//! show the swing of the steps and not the transition.

use super::{ErrorEstimate, LEAST_POINTS, greatest_difference, peak_wear_of_both_mm, run_with_transition};
use crate::assessment::RunModel;
use crate::observer::{Observer, PartOf};
use crate::simulation::settings::{Numerics, Stepping};
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun};
use crate::wear::settings::WearOfPair;
use crate::wear::{self, settings::SevereTransition};
use gearwear_bodies::gear::{Gear, PerGear};

/// Divisor of the flank points.
const POINTS_SPACING: usize = 4;
/// Divisors of the positions, the first within the budget taken. With fewer positions each is a jump of its own, and the transition
/// seems to matter more than it does.
const POSITIONS_SPACINGS: [usize; 2] = [2, 4];
/// Fewest wear steps of a companion.
const LEAST_STEPS: f64 = 40.0;

/// Estimate and its cost over that of the run, within `budget`.
pub(super) fn estimate(
    model: &RunModel<'_>,
    outcome: &Outcome,
    budget: f64,
    observer: &dyn Observer,
) -> (ErrorEstimate, f64) {
    let resolution = match resolution(model, outcome, budget, observer) {
        Ok(resolution) => resolution,
        Err(reason) => return (ErrorEstimate::none(&reason), 0.0),
    };
    let mut equilibria = 0;
    let abrupt = peaks_mm(model, resolution, |_| 0.0, &mut equilibria, observer);
    let peaks =
        abrupt.and_then(|abrupt| Ok((abrupt, peaks_mm(model, resolution, band_mpa, &mut equilibria, observer)?)));
    let estimate = match peaks {
        Ok((abrupt, band)) => {
            let own = PerGear::from_fn(|gear| match model.scene.wear[gear].severe_transition() {
                Some(severe) if severe.band_mpa > 0.0 => band[gear],
                _ => abrupt[gear],
            });
            let Resolution { flank_points, positions, steps } = resolution;
            let band_mpa = transitions(model).map(band_mpa).fold(0.0, f64::max);
            ErrorEstimate {
                relative: Some(greatest_difference(abrupt, band, own)),
                how: format!(
                    "difference of two short wear runs, with the abrupt transition and with a band of {band_mpa:.0} MPa: {flank_points} \
                     flank points, {positions} positions, {steps} wear steps"
                ),
            }
        }
        Err(error) => ErrorEstimate::none(&format!("a coarser run failed: {error}")),
    };
    (estimate, equilibria as f64 / outcome.work.equilibria as f64)
}

/// Resolution of the companions.
#[derive(Clone, Copy)]
struct Resolution {
    flank_points: usize,
    positions: usize,
    steps: f64,
}

impl Resolution {
    fn run<'a>(self, model: &'a RunModel<'_>) -> WearRun<'a> {
        let Self { flank_points, positions, steps } = self;
        let stepping = Stepping::Fixed { revolutions: model.duration() / steps };
        let numerics = Numerics { flank_points, positions, stepping, ..model.scene.numerics };
        WearRun { numerics, snapshots_revolutions: &[], ..model.wear_run() }
    }
}

/// Transitions to severe wear of the gears that have one.
fn transitions(model: &RunModel<'_>) -> impl Iterator<Item = SevereTransition> {
    Gear::BOTH.into_iter().filter_map(|gear| model.scene.wear[gear].severe_transition())
}

/// Band of a transition, MPa: its own, or the default one of an abrupt transition.
fn band_mpa(own: SevereTransition) -> f64 {
    if own.band_mpa > 0.0 { own.band_mpa } else { SevereTransition::DEFAULT_BAND * own.above_mpa }
}

/// Resolution of both companions within `budget`.
///
/// # Errors
/// Reason why there is no estimate.
fn resolution(
    model: &RunModel<'_>,
    outcome: &Outcome,
    budget: f64,
    observer: &dyn Observer,
) -> Result<Resolution, String> {
    let scene = model.scene;
    if !scene.wear.may_be_severe() {
        return Err("the scene has no transition to severe wear".to_owned());
    }
    if !model.wears_severely(outcome) {
        return Err("no pressure reaches the transition to severe wear".to_owned());
    }
    let fine = scene.numerics;
    let (flank_points, fewest) = (fine.flank_points / POINTS_SPACING, fine.positions / POSITIONS_SPACINGS[1]);
    if flank_points.min(fewest) < LEAST_POINTS {
        return Err("too few flank points or positions to leave some out".to_owned());
    }
    let mild = wear::of_both(&scene.wear_in(scene.operation.heaviest_phase()).with_severe(|_| None));
    let reference = model.reference();
    let phase = RunPhase { wear: reference.wear.with_laws(&mild), ..*reference };
    let coarsest = Resolution { flank_points, positions: fewest, steps: 1.0 }.run(model);
    let bound = coarsest.step_bound(&phase, false, &|| observer.gives_up()).map_err(|error| error.to_string())?;
    let factor = transitions(model).map(|severe| severe.factor).fold(1.0, f64::max);
    let steps = (model.duration() / (bound.revolutions / factor)).ceil().max(LEAST_STEPS);
    let positions = POSITIONS_SPACINGS
        .map(|spacing| fine.positions / spacing)
        .into_iter()
        .find(|&positions| 2.0 * (steps + 1.0) * positions as f64 / outcome.work.equilibria as f64 <= budget);
    match positions {
        Some(positions) => Ok(Resolution { flank_points, positions, steps }),
        None => {
            Err("two more runs with steps as short as the transition needs would cost too much beside this one"
                .to_owned())
        }
    }
}

/// Peak wear of both gears with transitions over bands of `band_mpa`; `equilibria` counts its cost.
///
/// # Errors
/// Failure of the companion.
fn peaks_mm(
    model: &RunModel<'_>,
    resolution: Resolution,
    band_mpa: impl Fn(SevereTransition) -> f64,
    equilibria: &mut u64,
    observer: &dyn Observer,
) -> Result<PerGear<f64>, String> {
    let part = PartOf { observer, before: 0.9, share: 0.1, of: 1.0 };
    let with_band = |own| SevereTransition { band_mpa: band_mpa(own), ..own };
    let outcome = run_with_transition(resolution.run(model), model, with_band, &part);
    let outcome = outcome.map_err(|error| error.to_string())?;
    *equilibria += outcome.work.equilibria;
    match &outcome.failure {
        Some(failure) => Err(failure.to_string()),
        None => Ok(peak_wear_of_both_mm(model, &outcome)),
    }
}
