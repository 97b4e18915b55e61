//! What it makes whether wear turns severe at once or over a band.
//!
//! The hard switch of the thesis makes the rate jump: pressure is worn down to the limit and chatters there, by as much as a step
//! wears. Over a band the rate is continuous, and steps converge. Two short companions, alike in everything else, tell the
//! difference: one with the hard switch, one with a band,
//!
//! ```text
//! severe switch    |h(hard) − h(band)| / h(the scene's own kind)
//! ```
//!
//! with a quarter of the points, a half or a quarter of the positions (as the budget allows) and the longest of Euler's steps that are stable under severe wear; of both gears'
//! differences of the peak wear the larger. Where that many steps cost more than the budget, there is no estimate: longer ones would
//! tell the swing of the steps and not the switch.

use super::{Estimate, LEAST_POINTS, peak_wear_of_both_mm};
use crate::assessment::RunModel;
use crate::gear::{Gear, PerGear};
use crate::observer::{Observer, PartOf};
use crate::simulation::settings::{Numerics, Phase, Stepping};
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun};
use crate::wear::{self, Laws, settings::SevereTransition};

/// Points are divided by this.
const POINTS_SPACING: usize = 4;
/// Positions are divided by the first of these that the budget allows. With fewer each position is a jump of its own, and the switch
/// seems to matter more than it does.
const POSITIONS_SPACINGS: [usize; 2] = [2, 4];
/// Fewest wear steps of a companion.
const LEAST_STEPS: f64 = 40.0;

/// Whether any wear of the run is severe.
pub(super) fn is_severe_anywhere(model: &RunModel<'_>, outcome: &Outcome) -> bool {
    let mut states = outcome.snapshots.iter().chain([&outcome.new]);
    states.any(|state| model.scene.wear.severe_factor_under(state.cycle.peak_pressure_mpa()).is_some())
}

/// The estimate and its cost over that of the run, within `budget`.
pub(super) fn estimate(
    model: &RunModel<'_>,
    outcome: &Outcome,
    budget: f64,
    observer: &dyn Observer,
) -> (Estimate, f64) {
    let scene = model.scene;
    if !scene.wear.may_be_severe() {
        return (Estimate::none("the scene has no transition to severe wear"), 0.0);
    }
    if !is_severe_anywhere(model, outcome) {
        return (Estimate::none("no pressure reaches the transition to severe wear"), 0.0);
    }
    let fine = scene.numerics;
    let (flank_points, fewest) = (fine.flank_points / POINTS_SPACING, fine.positions / POSITIONS_SPACINGS[1]);
    if flank_points.min(fewest) < LEAST_POINTS {
        return (Estimate::none("too few flank points or positions to leave some out"), 0.0);
    }
    let duration = model.duration();
    let coarse = |positions: usize, revolutions: f64| {
        let numerics = Numerics { flank_points, positions, stepping: Stepping::Fixed { revolutions }, ..fine };
        WearRun { numerics, snapshots_revolutions: &[], ..model.wear_run() }
    };
    let mild = wear::of_both(&scene.wear_in(scene.operation.heaviest_phase()).with_severe(|_| None));
    let reference = model.reference();
    let phase = RunPhase { wear: reference.wear.with_laws(&mild), ..*reference };
    let transitions = || Gear::BOTH.into_iter().filter_map(|gear| scene.wear[gear].severe_transition());
    let factor = transitions().map(|severe| severe.factor).fold(1.0, f64::max);
    let bound = match coarse(fewest, duration).step_bound(&phase, false, &|| observer.gives_up()) {
        Ok(bound) => bound.revolutions / factor,
        Err(error) => return (Estimate::none(&error.to_string()), 0.0),
    };
    let steps = (duration / bound).ceil().max(LEAST_STEPS);
    let cost = |positions: usize| 2.0 * (steps + 1.0) * positions as f64 / outcome.work.equilibria as f64;
    let affordable =
        POSITIONS_SPACINGS.map(|spacing| fine.positions / spacing).into_iter().find(|&n| cost(n) <= budget);
    let Some(positions) = affordable else {
        return (
            Estimate::none(
                "two more runs with steps as short as the transition needs would cost too much beside this one",
            ),
            0.0,
        );
    };
    let revolutions = duration / steps;
    let hard = |_: SevereTransition| 0.0;
    let over_band = |own: SevereTransition| {
        if own.band_mpa > 0.0 { own.band_mpa } else { SevereTransition::DEFAULT_BAND * own.above_mpa }
    };
    let mut equilibria = 0;
    let mut peaks_mm = |band_mpa: &dyn Fn(SevereTransition) -> f64| -> Result<PerGear<f64>, String> {
        let with_band = |own: SevereTransition| Some(SevereTransition { band_mpa: band_mpa(own), ..own });
        let laws_in = |phase: &Phase| wear::of_both(&scene.wear_in(phase).with_severe(with_band));
        let laws: Vec<Laws> = scene.operation.phases.iter().map(laws_in).collect();
        let phases: Vec<RunPhase<'_>> = model
            .phases
            .iter()
            .zip(&laws)
            .map(|(phase, laws)| RunPhase { wear: phase.wear.with_laws(laws), ..*phase })
            .collect();
        let run = WearRun { phases: &phases, ..coarse(positions, revolutions) };
        let outcome =
            run.run(&PartOf { observer, before: 0.9, share: 0.1, of: 1.0 }).map_err(|error| error.to_string())?;
        equilibria += outcome.work.equilibria;
        match &outcome.failure {
            Some(failure) => Err(failure.to_string()),
            None => Ok(peak_wear_of_both_mm(model, &outcome)),
        }
    };
    let peaks = peaks_mm(&hard).and_then(|hard| Ok((hard, peaks_mm(&over_band)?)));
    let estimate = match peaks {
        Ok((hard, band)) => {
            let of = |gear: Gear| {
                let has_band = scene.wear[gear].severe_transition().is_some_and(|severe| severe.band_mpa > 0.0);
                let reference = if has_band { band[gear] } else { hard[gear] };
                if reference > 0.0 { (hard[gear] - band[gear]).abs() / reference } else { 0.0 }
            };
            let band_mpa = transitions().map(over_band).fold(0.0, f64::max);
            Estimate {
                relative: Some(of(Gear::Pinion).max(of(Gear::Wheel))),
                how: format!(
                    "difference of two short wear runs, with the abrupt transition and with a band of {band_mpa:.0} MPa: {flank_points} \
                     flank points, {positions} positions, {steps} wear steps"
                ),
            }
        }
        Err(error) => Estimate::none(&format!("a coarser run failed: {error}")),
    };
    (estimate, equilibria as f64 / outcome.work.equilibria as f64)
}
