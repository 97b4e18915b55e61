//! What the wear would be with other limits of severe wear.
//!
//! At what pressure wear turns severe is known to a tenth at best, and where the pressure of a flank is near it, the wear hangs on it: by ∂ln h/∂ln T ≈ 18
//! at the pitch point of the preset `fzg-test`. So a run in which wear is severe, or would be with a limit a tenth lower, says what it comes to with limits
//! of 0.9 and 1.1 of the scene's: by the same wear simulation twice more, alike in everything but the limit. Fewer points or positions would not do, for with
//! fewer positions the transition is coarser, by as much as these limits differ.

use crate::assessment::{RunModel, UM_PER_MM};
use crate::gear::Gear;
use crate::observer::{Observer, PartOf};
use crate::results::error::{SevereLimit, WearAtLimit, WearOfGearAtLimit};
use crate::simulation::figures::WearFigures;
use crate::simulation::settings::Phase;
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun};
use crate::wear::{self, Laws, settings::SevereTransition};

/// How far the limit is taken lower and higher, over itself.
const APART: f64 = 0.1;
/// Ratio of the wear at the pitch circle with both limits, at least, that is said to hang on the limit.
const HANGS: f64 = 2.0;

/// Whether any wear of the run is severe, or would be with limits of `part` of the scene's.
fn is_severe_with(model: &RunModel<'_>, outcome: &Outcome, part: f64) -> bool {
    let mut states = outcome.snapshots.iter().chain([&outcome.new]);
    states.any(|state| model.scene.wear.is_severe_under(state.cycle.peak_pressure_mpa(), part))
}

/// The wear of the run with limits of `part` of the scene's; where it does not come to its end, why.
fn with_limit(model: &RunModel<'_>, part: f64, observer: &dyn Observer) -> Result<WearAtLimit, String> {
    let scene = model.scene;
    let other = |own: SevereTransition| Some(own.with_limit(part));
    let laws_in = |phase: &Phase| wear::of_both(&scene.wear_in(phase).with_severe(other));
    let laws: Vec<Laws> = scene.operation.phases.iter().map(laws_in).collect();
    let phases: Vec<RunPhase<'_>> = model
        .phases
        .iter()
        .zip(&laws)
        .map(|(phase, laws)| RunPhase { wear: phase.wear.with_laws(laws), ..*phase })
        .collect();
    // A run that a limit of life has ended has passed no snapshot later than that.
    let asked = scene.operation.snapshots_revolutions.iter().copied();
    let snapshots: Vec<f64> = asked.filter(|at| *at < model.duration()).collect();
    let run = WearRun { phases: &phases, snapshots_revolutions: &snapshots, ..model.wear_run() };
    let outcome = run.run(observer).map_err(|error| error.to_string())?;
    match &outcome.failure {
        Some(failure) => Err(failure.to_string()),
        None if !outcome.stop.is_complete() => Err("interrupted".to_owned()),
        None => Ok(WearAtLimit {
            limit_factor: part,
            pinion: wear_of(model, &outcome, Gear::Pinion),
            wheel: wear_of(model, &outcome, Gear::Wheel),
        }),
    }
}

/// The greatest wear of a gear and that at its pitch circle.
fn wear_of(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> WearOfGearAtLimit {
    let own = WearFigures::at(model.pair, gear, outcome, &outcome.worn);
    WearOfGearAtLimit { peak_wear_um: UM_PER_MM * own.peak_mm, pitch_wear_um: UM_PER_MM * own.pitch_mm }
}

/// The wear with limits a tenth lower and higher, and how it was obtained; none where nothing is severe, and then why.
pub(super) fn estimate(
    model: &RunModel<'_>,
    outcome: &Outcome,
    observer: &dyn Observer,
) -> (Option<SevereLimit>, String) {
    let scene = model.scene;
    let none = |reason: &str| (None, format!("not estimated: {reason}"));
    if !scene.wear.may_be_severe() {
        return none("the scene has no transition to severe wear");
    }
    if !is_severe_with(model, outcome, 1.0 - APART) {
        return none("no pressure comes near the transition to severe wear");
    }
    observer.announcement(
        "wear.severe: what limits of 0.9 and 1.1 times above_MPa make of the wear takes two more wear simulations like this one; \
         numerics.error_estimate = false leaves them out",
    );
    let at = |number: usize, part: f64| with_limit(model, part, &PartOf::new(observer, number, 2));
    match at(0, 1.0 - APART).and_then(|low| Ok(SevereLimit { low, high: at(1, 1.0 + APART)? })) {
        Ok(limit) => (Some(limit), "the same wear simulation with each limit".to_owned()),
        Err(error) => none(&format!("another run failed: {error}")),
    }
}

/// Warns where the wear at the pitch circle hangs on the limit.
pub(super) fn warning(limit: &SevereLimit) -> Option<String> {
    let pitch = |at: &WearAtLimit| [at.pinion.pitch_wear_um, at.wheel.pitch_wear_um];
    let ([low_pinion, low_wheel], [high_pinion, high_wheel]) = (pitch(&limit.low), pitch(&limit.high));
    let ratio = |low: f64, high: f64| if high > 0.0 { low / high } else { 1.0 };
    let (low, high, of) = match ratio(low_pinion, high_pinion) >= ratio(low_wheel, high_wheel) {
        true => (low_pinion, high_pinion, "pinion"),
        false => (low_wheel, high_wheel, "wheel"),
    };
    (ratio(low, high) > HANGS).then(|| {
        // Pressure goes with the root of the torque.
        let by_torque = 0.5 * (low / high).ln() / (limit.high.limit_factor / limit.low.limit_factor).ln();
        format!(
            "wear.severe.above_MPa: the wear of the {of} at the pitch circle hangs on the limit: {low:.2} µm with a limit 10 % lower, {high:.2} µm \
             with one 10 % higher, some {by_torque:.0} % for each per cent of torque between them; error.severe_limit has the maximum wear too"
        )
    })
}
