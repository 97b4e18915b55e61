//! The contact surface, from a short wear run on a truer one.
//!
//! Worn flanks that fit their own surface do not fit another: one mesh on the flanks that a run has worn says little of
//! where the wear on the other surface would have gone. A wear run of few steps does, as errors of its resolution and its steps
//! are alike on both surfaces and cancel in the difference. With the pinion's peak wear h of such a run on the run's own surface
//! and on an elastic half-plane,
//!
//! ```text
//! surface model    |h(coarse, few steps) − h_half-plane(coarse, few steps)| / h_half-plane
//! ```
//!
//! On the fzg-c pair four steps with 188 points and 100 positions tell the difference of whole runs to two per cent of the wear
//! (Winkler) or a fifth of the difference (Hertz); more points would let short waves swing with so few steps.
//!
//! The elastic half-plane stands in for finite elements: it knows the real gap and the real elasticity near the contact.
//! The tooth stiffness is the same on both surfaces, and so is contact outside the line of action; neither is judged.

use super::{Companion, Estimate, SIMPLIFIED_COST, peak_wear_of_both_mm, relative_cost, severe_switch};
use crate::contact::half_space::HalfSpace;
use crate::contact::settings::SurfaceKind;
use crate::pipeline::Model;
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::settings::{Numerics, Stepping};
use crate::simulation::wear_run::{Outcome, Progress, RunPhase, SimulationError, WearRun};
use crate::stiffness::TeethSpring;

/// Flank points and positions of the companions, where the run has more.
const FLANK_POINTS: usize = 188;
const POSITIONS: usize = 100;
/// Wear steps of the companions: as many as the budget allows within these.
const STEPS: [u64; 2] = [4, 10];

/// The estimate and its cost over that of the run.
pub(super) struct FromShortRuns {
    pub estimate: Estimate,
    pub cost: f64,
}

impl FromShortRuns {
    fn none(reason: &str) -> Self {
        Self { estimate: Estimate::none(reason), cost: 0.0 }
    }
}

/// Estimates within `budget`, a cost over that of the run.
pub(super) fn estimate(
    model: &Model<'_>,
    outcome: &Outcome,
    tip_contact: bool,
    budget: f64,
    observer: &dyn Progress,
) -> FromShortRuns {
    if model.scene.contact.surface == SurfaceKind::HalfSpace {
        return FromShortRuns::none(
            "only finite elements are truer than the elastic half-plane; gearwear accuracy compares them",
        );
    }
    if severe_switch::felt(model, outcome) {
        return FromShortRuns::none(
            "severe wear swings in runs of few steps, on either surface; gearwear accuracy compares whole runs",
        );
    }
    let fine = model.scene.numerics;
    let (flank_points, positions) = (fine.flank_points.min(FLANK_POINTS), fine.positions.min(POSITIONS));
    let own = if let MeshContact::Simplified { .. } = model.first().contact {
        SIMPLIFIED_COST
    } else {
        relative_cost(model.scene.contact.surface)
    };
    let weight = relative_cost(SurfaceKind::HalfSpace) / own;
    let of_the_run = |own: u64, truer: u64| (own as f64 + weight * truer as f64) / outcome.work.equilibria as f64;
    // A run of s steps evaluates s working cycles, and one more at the beginning of each phase.
    let affordable = budget / of_the_run(positions as u64, positions as u64) - model.phases.len() as f64;
    if affordable < STEPS[0] as f64 {
        return FromShortRuns::none(
            "the run is too short for another one on an elastic half-plane to be cheap beside it",
        );
    }
    let steps = (affordable as u64).min(STEPS[1]);
    let revolutions = model.scene.operation.pinion_revolutions / steps as f64;
    let numerics = Numerics { flank_points, positions, stepping: Stepping::Fixed { revolutions }, ..fine };
    let own = WearRun { numerics, snapshots_revolutions: &[], ..model.wear_run() };

    let line_load = model.first().line_load_n_per_mm;
    let surface = HalfSpace { material: model.scene.material, expected_line_load_n_per_mm: line_load };
    let stiffness = (model.scene.stiffness, model.stiffness_curve);
    let teeth = TeethSpring::new(stiffness.0, stiffness.1, model.pair, &model.scene.material, &surface, line_load);
    let sliced = model.sliced;
    let contact = MeshContact::LineOfAction { surface: &surface, teeth: &teeth, tip_contact, sliced };
    let phases: Vec<RunPhase<'_>> = model.phases.iter().map(|phase| RunPhase { contact, ..*phase }).collect();
    let truer = WearRun { phases: &phases, ..own };

    let mut equilibria = [0; 2];
    let mut peak_mm = |k: usize, run: &WearRun<'_>| -> Result<f64, SimulationError> {
        let outcome = run.run(&Companion { observer, share: (0.9, 0.1) })?;
        equilibria[k] = outcome.work.equilibria;
        match &outcome.failure {
            Some(failure) => Err(failure.clone()),
            None => Ok(peak_wear_of_both_mm(model, &outcome).pinion),
        }
    };
    let peaks = peak_mm(0, &own).and_then(|own_mm| Ok((own_mm, peak_mm(1, &truer)?)));
    let estimate = match peaks {
        Ok((own_mm, truer_mm)) => Estimate {
            relative: Some(if truer_mm > 0.0 { (own_mm - truer_mm).abs() / truer_mm } else { 0.0 }),
            how: format!(
                "difference of two short wear runs, on the run's own surface and on an elastic half-plane: {flank_points} \
                 flank points, {positions} positions, {steps} wear steps; the half-plane stands in for finite elements, \
                 tooth stiffness and contact outside the line of action are not judged"
            ),
        },
        Err(error) => Estimate::none(&format!("the short wear run on a truer surface failed: {error}")),
    };
    FromShortRuns { estimate, cost: of_the_run(equilibria[0], equilibria[1]) }
}
