//! Errors of the peak wear, estimated from companion runs that cost at most half of the run itself.
//!
//! | estimate | companions | module |
//! |---|---|---|
//! | wear step, discretisation | coarser wear runs; of a verified run on finite elements its verification | [`wear_runs`] |
//! | wear step of adaptive runs | none: their own steps estimate it | [`wear_runs`] |
//! | transition to severe wear: abrupt or over a band | two short wear runs | [`severe_switch`] |
//! | limits of severe wear a tenth lower and higher | two wear runs as long, beyond that half and announced | [`severe_limit`] |
//!
//! The error of contact surface and tooth stiffness is that against the same wear simulation with finite elements ([`super::verification`]). Cost is
//! counted in equilibria of the run itself.

mod severe_limit;
mod severe_switch;
mod wear_runs;

use super::RunModel;
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::observer::Observer;
use crate::results::error::{ErrorSources, ErrorSummary};
use crate::simulation::figures::WearFigures;
use crate::simulation::wear_run::{Outcome, RunPhase, SimulationError, WearRun};
use crate::wear::settings::WearOfPair;
use crate::wear::{self, Laws, settings::SevereTransition};
use gearwear_bodies::gear::{Gear, PerGear};

/// Fewest flank points and positions of a companion run.
const LEAST_POINTS: usize = 20;
/// Greatest cost of all companions over that of the run.
const BUDGET: f64 = 0.5;
/// Relative error of the peak wear above which it is warned of.
const ALARMING: f64 = 0.02;
/// Relative difference to finite elements, which no refinement reduces, above which it is warned of.
const ALARMING_MODEL: f64 = 0.1;

/// Relative error with its source; without a value, the source is the reason.
struct ErrorEstimate {
    relative: Option<f64>,
    how: String,
}

impl ErrorEstimate {
    fn none(reason: &str) -> Self {
        Self { relative: None, how: format!("not estimated: {reason}") }
    }
}

/// Estimates the errors of the peak wear in `outcome`, the larger of both gears. A companion that fails leaves its estimate out, never the
/// result of the run. `step_over_safe` is the run's wear step over the longest stable one, 0 without a limit; `is_verified` tells whether a verification
/// follows.
pub(super) fn estimate(
    model: &RunModel<'_>,
    outcome: &Outcome,
    step_over_safe: f64,
    is_verified: bool,
    observer: &dyn Observer,
) -> ErrorSummary {
    let peaks_mm = peak_wear_of_both_mm(model, outcome);
    if Gear::BOTH.into_iter().all(|gear| peaks_mm[gear] <= 0.0) {
        return ErrorSummary::not_estimated("neither gear wears");
    }
    let slices = coarse_slices(model);
    let runs = wear_runs::estimate(model, outcome, slices.as_ref(), step_over_safe, is_verified, observer);
    // First what is on the positions of the run, which are kept: the other has fewer.
    let (severe_limit, limit_how) = severe_limit::estimate(model, outcome, observer);
    let (severe_switch, switch_cost) = severe_switch::estimate(model, outcome, BUDGET - runs.cost, observer);
    if observer.interrupted() {
        return ErrorSummary::not_estimated("the estimates were interrupted");
    }
    ErrorSummary {
        discretisation: runs.discretisation.relative,
        wear_step: runs.wear_step.relative,
        severe_switch: severe_switch.relative,
        severe_limit,
        companions_cost: Some(runs.cost + switch_cost),
        how: ErrorSources {
            discretisation: runs.discretisation.how,
            wear_step: runs.wear_step.how,
            severe_switch: severe_switch.how,
            severe_limit: limit_how,
            ..ErrorSources::default()
        },
        ..ErrorSummary::default()
    }
}

/// Half of the slices of a run; all of them where half would leave positions without contact. None of a run without slices.
fn coarse_slices(model: &RunModel<'_>) -> Option<SlicedTeeth> {
    let fine = model.sliced?;
    let count = fine.settings.count.div_ceil(2);
    let between = 1.0 - 1.0 / count as f64;
    let covers = model.pair.path.contact_ratio() + between * model.pair.overlap_ratio() >= 1.0;
    Some(if covers { fine.with_count(model.pair, &model.scene.material, count) } else { fine.clone() })
}

/// Wear of the run with other wear laws, the severe transition of each exchanged by `transition`.
fn run_with_transition(
    run: WearRun<'_>,
    model: &RunModel<'_>,
    transition: impl Fn(SevereTransition) -> SevereTransition,
    observer: &dyn Observer,
) -> Result<Outcome, SimulationError> {
    let scene = model.scene;
    let followed = |own| Some(run.numerics.stepping.followed(transition(own)));
    let phases = scene.operation.phases.iter();
    let laws: Vec<Laws> = phases.map(|phase| wear::of_both(&scene.wear_in(phase).with_severe(followed))).collect();
    let phases = model.phases.iter().zip(&laws);
    let phases: Vec<RunPhase<'_>> =
        phases.map(|(phase, laws)| RunPhase { wear: phase.wear.with_laws(laws), ..*phase }).collect();
    WearRun { phases: &phases, ..run }.run(observer)
}

/// Larger of both gears' differences |one − other| over `reference`; 0 of a gear whose reference does not wear.
fn greatest_difference(one: PerGear<f64>, other: PerGear<f64>, reference: PerGear<f64>) -> f64 {
    let [pinion, wheel] = Gear::BOTH
        .map(|gear| if reference[gear] > 0.0 { (one[gear] - other[gear]).abs() / reference[gear] } else { 0.0 });
    pinion.max(wheel)
}

/// Greatest wear depth of each gear's flank.
fn peak_wear_of_both_mm(model: &RunModel<'_>, outcome: &Outcome) -> PerGear<f64> {
    PerGear::from_fn(|gear| WearFigures::at(model.pair, gear, outcome, &outcome.worn).peak_mm)
}

/// Warns where the maximum wear is far from converged, or far from that by finite elements.
pub(super) fn warnings(surface: SurfaceKind, error: &ErrorSummary) -> Vec<String> {
    let resolution = match surface {
        SurfaceKind::Fem => "fem.elements_per_half_width",
        _ => "numerics.flank_points and numerics.positions",
    };
    let causes = [(resolution, error.discretisation), ("numerics.step", error.wear_step)];
    let unresolved = causes.into_iter().filter_map(|(keys, estimate)| {
        let off = 100.0 * estimate.filter(|e| *e > ALARMING)?;
        Some(format!("{keys}: the maximum wear is estimated to be off by {off:.0} %; refine"))
    });
    let model = error.surface_model.filter(|e| *e > ALARMING_MODEL).map(|estimate| {
        format!(
            "contact.surface: against finite elements the maximum wear is off by {:.0} %; gearwear accuracy compares all surfaces",
            100.0 * estimate
        )
    });
    let hangs = error.severe_limit.as_ref().and_then(severe_limit::warning);
    unresolved.chain(model).chain(hangs).collect()
}
