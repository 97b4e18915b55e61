//! What the wear would be with other limits of severe wear.
//!
//! At what pressure wear turns severe is known to a tenth at best, and where the pressure of a flank is near it, the wear hangs on it: by ∂ln h/∂ln T ≈ 18
//! at the pitch point of the preset `fzg-test`. So a run in which wear is severe, or would be with a limit a tenth lower, says what it comes to with limits
//! of 0.9 and 1.1 of the scene's. Three companions, alike in everything but the limit, tell by how much; of the run itself are the figures,
//!
//! ```text
//! h(0.9 p_lim) ≈ h · h'(0.9 p_lim)/h'(p_lim)        h': of the companions
//! ```
//!
//! with half of the points and positions and adaptive steps of four times the usual tolerance. Abrupt transitions are taken over a band in all three, which
//! lets the steps adapt: what the band makes is in `severe_switch`, and hardly differs between limits.

use crate::gear::{Gear, PerGear};
use crate::observer::{Observer, PartOf};
use crate::pipeline::{Model, UM_PER_MM};
use crate::results::error::{SevereLimit, WearAtLimit, WearOfGearAtLimit};
use crate::simulation::figures::WearFigures;
use crate::simulation::settings::{AdaptiveMethod, Numerics, Stepping};
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun};
use crate::wear::{self, Laws, settings::SevereTransition};

use super::LEAST_POINTS;

/// How far the limit is taken lower and higher, over itself.
const APART: f64 = 0.1;
/// Points and positions of a companion are divided by this.
const SPACING: usize = 2;
/// Tolerance of its steps, over the greatest wear of the run.
const TOLERANCE: f64 = 0.01;
/// Least tolerance, mm.
const LEAST_TOLERANCE_MM: f64 = 1e-9;
/// Ratio of the wear at the pitch circle with both limits, at least, that is said to hang on the limit.
const HANGS: f64 = 2.0;

/// Wear at both places of each gear.
struct Wear {
    peak_mm: PerGear<f64>,
    pitch_mm: PerGear<f64>,
}

/// Greatest wear and that at the pitch circle.
fn wear_of(model: &Model<'_>, outcome: &Outcome) -> Wear {
    let of = PerGear::from_fn(|gear| WearFigures::at(model.pair, gear, outcome, &outcome.worn));
    Wear { peak_mm: of.as_ref().map(|own| own.peak_mm), pitch_mm: of.as_ref().map(|own| own.pitch_mm) }
}

/// Whether any wear of the run is severe, or would be with limits of `part` of the scene's.
fn is_severe_with(model: &Model<'_>, outcome: &Outcome, part: f64) -> bool {
    let mut states = outcome.snapshots.iter().chain([&outcome.new]);
    states.any(|state| model.scene.wear.is_severe_under(state.cycle.peak_pressure_mpa(), part))
}

/// The laws of each phase with limits of `part` of their own, over a band at least.
fn laws_with(model: &Model<'_>, part: f64) -> Vec<Laws> {
    let with_limit = |own: SevereTransition| {
        let band_mpa = own.band_mpa.max(SevereTransition::DEFAULT_BAND * own.above_mpa);
        Some(SevereTransition { band_mpa, ..own }.with_limit(part))
    };
    let scene = model.scene;
    scene.operation.phases.iter().map(|phase| wear::of_both(&scene.wear_in(phase).with_severe(with_limit))).collect()
}

/// The wear of a companion with limits of `part` of the scene's; where it does not come to its end, why.
fn companion(model: &Model<'_>, deepest_mm: f64, part: f64, observer: &dyn Observer) -> Result<Wear, String> {
    let laws = laws_with(model, part);
    let phases: Vec<RunPhase<'_>> = model
        .phases
        .iter()
        .zip(&laws)
        .map(|(phase, laws)| RunPhase { wear: phase.wear.with_laws(laws), ..*phase })
        .collect();
    let fine = model.scene.numerics;
    let tolerance_mm = (TOLERANCE * deepest_mm).max(LEAST_TOLERANCE_MM);
    let numerics = Numerics {
        flank_points: fine.flank_points / SPACING,
        positions: fine.positions / SPACING,
        stepping: Stepping::Adaptive { tolerance_mm, method: AdaptiveMethod::RungeKuttaChebyshev },
        ..fine
    };
    let run = WearRun { phases: &phases, numerics, snapshots_revolutions: &[], ..model.wear_run() };
    let outcome = run.run(observer).map_err(|error| error.to_string())?;
    match &outcome.failure {
        Some(failure) => Err(failure.to_string()),
        None if !outcome.stop.is_complete() => Err("interrupted".to_owned()),
        None => Ok(wear_of(model, &outcome)),
    }
}

/// The wear of the run with another limit, by what that makes of the companions.
fn scaled(run: &Wear, own: &Wear, other: &Wear, limit_factor: f64) -> WearAtLimit {
    let of_gear = |gear: Gear| {
        let at = |run: f64, own: f64, other: f64| UM_PER_MM * if own > 0.0 { run * other / own } else { run };
        WearOfGearAtLimit {
            peak_wear_um: at(run.peak_mm[gear], own.peak_mm[gear], other.peak_mm[gear]),
            pitch_wear_um: at(run.pitch_mm[gear], own.pitch_mm[gear], other.pitch_mm[gear]),
        }
    };
    WearAtLimit { limit_factor, pinion: of_gear(Gear::Pinion), wheel: of_gear(Gear::Wheel) }
}

/// The wear with limits a tenth lower and higher, and how it was obtained; none where nothing is severe, and then why.
pub(super) fn estimate(model: &Model<'_>, outcome: &Outcome, observer: &dyn Observer) -> (Option<SevereLimit>, String) {
    let scene = model.scene;
    let none = |reason: &str| (None, format!("not estimated: {reason}"));
    if !scene.wear.may_be_severe() {
        return none("the scene has no transition to severe wear");
    }
    if !is_severe_with(model, outcome, 1.0 - APART) {
        return none("no pressure comes near the transition to severe wear");
    }
    if scene.numerics.flank_points.min(scene.numerics.positions) / SPACING < LEAST_POINTS {
        return none("too few flank points or positions to leave some out");
    }
    observer.announcement(
        "wear.severe: what limits of 0.9 and 1.1 times above_MPa make of the wear takes three more wear simulations, each with half of the \
         points and positions; numerics.error_estimate = false leaves them out",
    );
    let run = wear_of(model, outcome);
    let deepest_mm = run.peak_mm.pinion.max(run.peak_mm.wheel);
    let companions: Result<Vec<Wear>, String> = [1.0 - APART, 1.0, 1.0 + APART]
        .into_iter()
        .enumerate()
        .map(|(number, part)| companion(model, deepest_mm, part, &PartOf::new(observer, number, 3)))
        .collect();
    match companions {
        Ok(wear) => {
            let at = |index: usize, factor: f64| scaled(&run, &wear[1], &wear[index], factor);
            let how =
                "ratio of three wear runs with half of the points and positions, alike in everything but the limit"
                    .to_owned();
            (Some(SevereLimit { low: at(0, 1.0 - APART), high: at(2, 1.0 + APART) }), how)
        }
        Err(error) => none(&format!("a coarser run failed: {error}")),
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
