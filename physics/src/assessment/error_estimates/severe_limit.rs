//! Wear with other limits of severe wear.
//!
//! The pressure at which wear turns severe is known to a tenth at best, and where the pressure of a flank is near it, the wear is sensitive to it: ∂ln h/∂ln T ≈ 18
//! at the pitch point of the preset `fzg-test`. A run in which wear is severe, or would be with a limit a tenth lower, is therefore repeated with limits of 0.9 and
//! 1.1 of the scene's, all else alike: with fewer positions the transition is coarser, by as much as these limits differ.

use super::run_with_transition;
use crate::assessment::{RunModel, UM_PER_MM};
use crate::observer::{Observer, PartOf};
use crate::results::error::{SevereLimit, WearAtLimit, WearOfGearAtLimit};
use crate::simulation::figures::WearFigures;
use crate::simulation::wear_run::{Outcome, WearRun};
use crate::wear::settings::WearOfPair;
use gearwear_bodies::gear::Gear;

/// Relative change of the limit, lower and higher.
const APART: f64 = 0.1;
/// Ratio of the wear at the pitch circle with both limits, above which it is warned of.
const HANGS: f64 = 2.0;

/// Whether any wear of the run is severe, or would be with limits of `part` of the scene's.
fn is_severe_with(model: &RunModel<'_>, outcome: &Outcome, part: f64) -> bool {
    let mut states = outcome.snapshots.iter().chain([&outcome.new]);
    states.any(|state| model.scene.wear.is_severe_under(state.cycle.peak_pressure_mpa(), part))
}

/// Wear of the run with limits of `part` of the scene's.
///
/// # Errors
/// Reason why that run is not completed.
fn with_limit(model: &RunModel<'_>, part: f64, observer: &dyn Observer) -> Result<WearAtLimit, String> {
    let run = WearRun { snapshots_revolutions: &[], ..model.wear_run() };
    let outcome = run_with_transition(run, model, |own| own.with_limit(part), observer);
    let outcome = outcome.map_err(|error| error.to_string())?;
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

/// Greatest wear of a gear, and its wear at the pitch circle.
fn wear_of(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> WearOfGearAtLimit {
    let own = WearFigures::at(model.pair, gear, outcome, &outcome.worn);
    WearOfGearAtLimit { peak_wear_um: UM_PER_MM * own.peak_mm, pitch_wear_um: UM_PER_MM * own.pitch_mm }
}

/// Wear with limits a tenth lower and higher, and how it was obtained; none where nothing is severe, with the reason.
pub(super) fn estimate(
    model: &RunModel<'_>,
    outcome: &Outcome,
    observer: &dyn Observer,
) -> (Option<SevereLimit>, String) {
    let reason = if !model.scene.wear.may_be_severe() {
        "the scene has no transition to severe wear".to_owned()
    } else if !is_severe_with(model, outcome, 1.0 - APART) {
        "no pressure comes near the transition to severe wear".to_owned()
    } else {
        observer.announcement(
            "wear.severe: the wear with limits of 0.9 and 1.1 times above_MPa takes two more wear simulations like this one; \
             numerics.error_estimate = false leaves them out",
        );
        let both = with_limit(model, 1.0 - APART, &PartOf::new(observer, 0, 2)).and_then(|low| {
            Ok(SevereLimit { low, high: with_limit(model, 1.0 + APART, &PartOf::new(observer, 1, 2))? })
        });
        match both {
            Ok(limit) => return (Some(limit), "the same wear simulation with each limit".to_owned()),
            Err(error) => format!("another run failed: {error}"),
        }
    };
    (None, format!("not estimated: {reason}"))
}

/// Warns where the wear at the pitch circle is sensitive to the limit.
pub(super) fn warning(limit: &SevereLimit) -> Option<String> {
    let SevereLimit { low, high } = limit;
    let (ratio, low_um, high_um, gear) = [(&low.pinion, &high.pinion, "pinion"), (&low.wheel, &high.wheel, "wheel")]
        .map(|(low, high, gear)| (low.pitch_wear_um, high.pitch_wear_um, gear))
        .map(|(low, high, gear)| (if high > 0.0 { low / high } else { 1.0 }, low, high, gear))
        .into_iter()
        .reduce(|pinion, wheel| if pinion.0 >= wheel.0 { pinion } else { wheel })?;
    (ratio > HANGS).then(|| {
        // Pressure is proportional to the root of the torque.
        let by_torque = 0.5 * (low_um / high_um).ln() / (high.limit_factor / low.limit_factor).ln();
        format!(
            "wear.severe.above_MPa: the wear of the {gear} at the pitch circle is sensitive to the limit: {low_um:.2} µm with a limit 10 % lower, {high_um:.2} µm \
             with one 10 % higher, some {by_torque:.0} % for each per cent of torque between them; error.severe_limit has the maximum wear too"
        )
    })
}
