//! How far the peak wear is from converged, from coarser companion runs.
//!
//! Two companions take a quarter of the wear steps; one of them also half of the flank points and positions. Their cost
//! is 1/4 + 1/16 of the run itself. With the orders that the methods have (Euler: first in the step; the flank and the
//! path of contact: second in their spacing),
//!
//! ```text
//! wear step        |h(N, S) − h(N, S/4)| / (4 − 1) / h
//! discretisation   |h(N, S/4) − h(N/2, S/4)| / (4 − 1) / h
//! ```
//!
//! Source: L. F. Richardson (1911); P. J. Roache, *Verification and Validation in Computational Science* (1998).

use super::Model;
use crate::gear::Gear;
use crate::simulation::{
    figures::WearFigures,
    record::{ErrorSources, ErrorSummary},
    settings::{Numerics, Operation},
    wear_run::{Outcome, Progress, SimulationError, WearRun},
};

/// Fewest points and positions of a companion: with fewer nothing can be learned.
const LEAST_POINTS: usize = 20;
/// Estimates above this part of the peak wear are warned of.
const ALARMING: f64 = 0.02;

/// Hides how far the companions have come, but hears an interrupt.
struct Companion<'a> {
    observer: &'a dyn Progress,
    /// Share of the companions' work done before this one, and its own share.
    share: (f64, f64),
}

impl Progress for Companion<'_> {
    fn progress(&self, done: f64, total: f64) {
        self.observer.progress(self.share.0 + self.share.1 * done / total, 1.0);
    }

    fn interrupted(&self) -> bool {
        self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.observer.gives_up()
    }
}

/// Estimates the errors of the pinion's peak wear in `outcome`.
pub(super) fn estimate(
    model: &Model<'_>,
    outcome: &Outcome,
    observer: &dyn Progress,
) -> Result<ErrorSummary, SimulationError> {
    let fine = model.scene.numerics;
    let coarse_steps = Numerics { step_revolutions: 4.0 * fine.step_revolutions, ..fine };
    let coarse = Numerics { flank_points: fine.flank_points / 2, positions: fine.positions / 2, ..coarse_steps };
    let can_coarsen = coarse.flank_points.min(coarse.positions) >= LEAST_POINTS;
    let operation = Operation { snapshots_revolutions: Vec::new(), ..model.scene.operation.clone() };
    let peak = |numerics, share| -> Result<f64, SimulationError> {
        let run = WearRun { numerics, operation: &operation, ..model.wear_run() };
        Ok(peak_wear_mm(model, &run.run(&Companion { observer, share })?))
    };
    let reference = peak_wear_mm(model, outcome);
    let stepped = peak(coarse_steps, (0.0, 0.8))?;
    let spaced = if can_coarsen { Some(peak(coarse, (0.8, 0.2))?) } else { None };
    if observer.interrupted() {
        return Ok(ErrorSummary::not_estimated("the estimates were interrupted"));
    }
    // Where nothing wears there is nothing to be wrong about.
    let relative = |difference: f64| if reference > 0.0 { difference.abs() / 3.0 / reference } else { 0.0 };
    Ok(ErrorSummary {
        discretisation: spaced.map(|spaced| relative(stepped - spaced)),
        wear_step: Some(relative(reference - stepped)),
        surface_model: None,
        how: ErrorSources {
            discretisation: if can_coarsen {
                format!(
                    "Richardson, second order, from companion runs with {} and {} flank points, {} and {} positions",
                    fine.flank_points, coarse.flank_points, fine.positions, coarse.positions
                )
            } else {
                "not estimated: too few flank points or positions to halve".to_owned()
            },
            wear_step: "Richardson, first order, from a companion run with wear steps four times as long".to_owned(),
            surface_model: "not estimated: this version has no finite-element reference".to_owned(),
        },
    })
}

fn peak_wear_mm(model: &Model<'_>, outcome: &Outcome) -> f64 {
    WearFigures::at(model.pair, Gear::Pinion, outcome, &outcome.worn).peak_mm
}

/// Warns where an estimate says that the peak wear is far from converged.
pub(super) fn warnings(error: &ErrorSummary) -> Vec<String> {
    let causes =
        [("numerics.flank_points and numerics.positions", error.discretisation), ("numerics.step", error.wear_step)];
    causes
        .into_iter()
        .filter_map(|(keys, estimate)| estimate.filter(|e| *e > ALARMING).map(|e| (keys, e)))
        .map(|(keys, estimate)| {
            format!("{keys}: the peak wear is estimated to be off by {:.0} %; refine", 100.0 * estimate)
        })
        .collect()
}
