//! Carries out a plan, stage by stage, and hands back the record that reports are written from.
//!
//! This is the one way in which the program runs anything; the only clock it reads times the stages.

pub mod calibrate;
mod contact_case;
pub mod deformed_teeth;
mod drawing;
mod error_estimates;
pub mod fem_scene;
pub mod guarded;
pub mod hertz_comparison;
mod inputs;
mod invariants;
pub mod kept_elements;
mod law_without_effect;
mod left_out_contact;
mod lubrication;
mod model;
pub mod pair_mesh;
mod phases;
mod prepare;
mod recording;
mod root_stress;
mod run_error;
mod scuffing;
mod severe_pressure;
mod slices;
mod springs;
mod stability;
pub mod stage_clock;
mod temperature;
mod torque_curve;
mod verification;

use std::time::Instant;

use crate::contact::hertz;
use crate::observer::Observer;
use crate::plan::{Plan, StageKind, cost::RunCost};
use crate::results::error::ErrorSummary;
use crate::results::provenance::Provenance;
use crate::results::run::{RunRecord, StopReason, Summary};
use crate::results::worn_pair::WornPair;
use crate::simulation::checkpoint::{Checkpoint, Keeper, NothingKept};
use crate::simulation::wear_run::{Outcome, reference_phase};
use gearwear_bodies::gear::GearPair;
use gearwear_files::memory;
pub use inputs::RunInputs;
use model::RunModel;
use prepare::{ContactCases, RunSlices, ToothElasticity};
use recording::RunFindings;
pub use run_error::RunError;
use stability::Judged;
use stage_clock::StageClock;
use verification::{VerificationModels, Verified};

/// Part of the announced memory without which a run is refused: nine in ten announcements are within a factor of two.
const NEEDED_AT_LEAST: f64 = 0.5;

/// Result of a computation, with the failure that ended it early.
#[derive(Debug, Clone, PartialEq)]
pub struct Done<R = RunRecord, E = RunError> {
    /// Record of everything that was finished.
    pub record: R,
    /// Failure that ended the computation early; none where it was completed or interrupted (the record's summary says which).
    pub failure: Option<E>,
}

impl<R, E> Done<R, E> {
    /// The record, unless something went wrong.
    ///
    /// # Errors
    /// The failure; what was finished by then is lost.
    pub fn complete(self) -> Result<R, E> {
        match self.failure {
            None => Ok(self.record),
            Some(failure) => Err(failure),
        }
    }
}

/// Micrometres per millimetre: records are written in µm.
pub const UM_PER_MM: f64 = 1e3;

/// Checkpoint that a run goes on from, and the keeper of new ones.
pub struct Resumption<'a> {
    /// Checkpoint of this same run; `None`: from the beginning.
    pub from: Option<Checkpoint>,
    /// Receives new checkpoints.
    pub keeper: &'a dyn Keeper,
}

impl Resumption<'_> {
    /// A run from its beginning, of which nothing is kept.
    pub fn none() -> Self {
        Self { from: None, keeper: &NothingKept }
    }
}

/// Runs the scene of `inputs` as its plan says, from its beginning or from a checkpoint, and keeps new checkpoints. The report is left to
/// the caller, who knows where it goes.
///
/// A run that is interrupted or does not converge gives the record of what it had finished, and its failure in the latter
/// case.
///
/// # Errors
/// [`RunError`] where nothing was finished.
pub fn run(inputs: RunInputs<'_>, resumption: Resumption<'_>, observer: &dyn Observer) -> Result<Done, RunError> {
    let start = Instant::now();
    let mut done = announced(inputs, observer, |run, stages| {
        run.assess(resumption, stages, |model, found, summary| {
            recording::record(inputs.provenance, model, found, summary)
        })
    })?;
    done.record.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(done)
}

/// Main figures of a run; what only a report reads is not made.
///
/// # Errors
/// As [`run`].
pub fn summarise(inputs: RunInputs<'_>, observer: &dyn Observer) -> Result<Done<Summary>, RunError> {
    let start = Instant::now();
    let mut done =
        announced(inputs, observer, |run, stages| run.assess(Resumption::none(), stages, |_, _, summary| summary))?;
    done.record.wall_s = start.elapsed().as_secs_f64();
    Ok(done)
}

/// Main figures, history and worn profiles of a run, which a study of many runs keeps of each.
///
/// # Errors
/// As [`run`].
pub fn worn_pair(inputs: RunInputs<'_>, observer: &dyn Observer) -> Result<Done<WornPair>, RunError> {
    let start = Instant::now();
    let mut done =
        announced(inputs, observer, |run, stages| run.assess(Resumption::none(), stages, recording::worn_pair))?;
    done.record.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(done)
}

/// The pair of a run at each of `revolutions`, which are snapshots of the scene, as [`worn_pair`] has it at the end; one evaluation of the wear stands
/// for all. A run that ends early has none.
///
/// # Errors
/// As [`run`].
pub fn worn_pairs(
    inputs: RunInputs<'_>,
    revolutions: &[f64],
    observer: &dyn Observer,
) -> Result<Done<Vec<WornPair>>, RunError> {
    announced(inputs, observer, |run, stages| run.at_moments(revolutions, stages))
}

/// [`prepared`], where the memory for it can be had, after an announcement of what the run takes where that is much.
fn announced<R>(
    inputs: RunInputs<'_>,
    observer: &dyn Observer,
    carry_out: impl FnOnce(PreparedRun<'_, '_>, StageClock<'_>) -> Result<Done<R>, RunError>,
) -> Result<Done<R>, RunError> {
    let scene = inputs.scene;
    let cost = RunCost::of(scene, &Plan::of(scene), &GearPair::new(&scene.pair)?);
    if let Some(much) = cost.announcement() {
        observer.announcement(&much);
    }
    if !memory::can_be_had((NEEDED_AT_LEAST * cost.memory_gb * 1e9) as u64) {
        return Err(RunError::Memory { gb: cost.memory_gb, savings: cost.savings });
    }
    prepared(inputs, observer, carry_out)
}

/// Prepares the run of a scene up to its first wear step and hands it to `carry_out`.
fn prepared<R>(
    inputs: RunInputs<'_>,
    observer: &dyn Observer,
    carry_out: impl FnOnce(PreparedRun<'_, '_>, StageClock<'_>) -> Result<Done<R>, RunError>,
) -> Result<Done<R>, RunError> {
    let mut stages = StageClock::new(observer);

    let pair = stages.run(StageKind::Geometry.name(), || GearPair::new(&inputs.scene.pair))?;
    let (worn, on_half_planes) = match prepare::wearing_elements(inputs, &pair, &mut stages) {
        Err(error) if inputs.scene.surface_by_default => (None, Some((inputs.scene.on_half_planes(), error))),
        worn => (worn?, None),
    };
    let scene = on_half_planes.as_ref().map_or(inputs.scene, |(scene, _)| scene);
    let inputs = RunInputs { scene, ..inputs };
    let plan = &Plan::of(scene);
    let surface_warning = on_half_planes.as_ref().map(|(_, error)| {
        format!("contact.surface: elastic half-planes, as finite elements, the default, cannot be made for this pair: {error}")
    });
    let at_pitch = hertz::flattening(&pair.normal_section(), &scene.material, pair.path.pitch_point_mm);
    let elements = prepare::elements(inputs, plan, &pair, &at_pitch, &mut stages);
    let elasticity = ToothElasticity::new(inputs, plan, &pair, elements.as_ref(), worn, &mut stages)?;
    let cases = ContactCases::new(inputs, &pair, &elasticity, elements.as_ref(), &mut stages)?;
    let teeth = cases.springs(inputs, plan, &pair, &elasticity, &mut stages)?;
    // Slices are verified by other slices with the curve of the plane elements, which make room for the teeth in space once that is known.
    let elements = elements.filter(|_| scene.slices.is_none() || elasticity.curve_by_elements(inputs).is_none());
    let in_space = prepare::teeth_in_space(inputs, plan, &pair, &mut stages);
    let slices =
        RunSlices::new(inputs, &pair, elasticity.stiffness, teeth[0].as_ref(), in_space.as_ref(), &mut stages)?;
    let conditions = prepare::conditions(scene, &pair);
    let phases = cases.phases(scene, &elasticity, &teeth, slices.of_teeth.as_ref(), &conditions);
    let heaviest = phases[reference_phase(&phases)];
    let torque_curve = cases.torque_curve(scene, &elasticity, &teeth, slices.of_teeth.as_ref(), heaviest);
    let model = RunModel {
        scene,
        stiffness: elasticity.stiffness,
        pair: &pair,
        limits: scene.operation.stop,
        sliced: slices.of_teeth.as_ref(),
        teeth: teeth[cases.of_phase[reference_phase(&phases)]].as_ref(),
        phases,
        torque_curve,
        at_pitch,
        foundations_mpa_per_mm: cases.foundations_mpa_per_mm(),
    };
    let verification = VerificationModels { elements, curve: elasticity.curve_by_elements(inputs), in_space };
    let warnings = surface_warning.iter().chain(&elasticity.warning).chain(&slices.warning).cloned().collect();
    carry_out(PreparedRun { provenance: inputs.provenance, plan, model, verification, warnings }, stages)
}

/// A run whose first wear step can be taken.
struct PreparedRun<'a, 'b> {
    provenance: &'b Provenance,
    plan: &'b Plan,
    model: RunModel<'a>,
    verification: VerificationModels<'a, 'b>,
    /// Warnings of the preparation.
    warnings: Vec<String>,
}

impl PreparedRun<'_, '_> {
    /// Simulates the wear, observes the new and the worn pair, estimates and verifies the errors, and hands all of it to `keep`, with a summary
    /// that lacks only the whole wall time.
    fn assess<R>(
        self,
        resumption: Resumption<'_>,
        mut stages: StageClock<'_>,
        keep: impl FnOnce(&RunModel<'_>, RunFindings<'_>, Summary) -> R,
    ) -> Result<Done<R>, RunError> {
        let (outcome, judged) = self.simulate(resumption, &mut stages)?;
        let Self { provenance, plan, model, verification, warnings } = self;
        let step_over_safe = judged.step_over_safe;
        let ended = EndedRun { provenance, plan, model: model.ending_with(&outcome), outcome: &outcome, warnings };
        let errors = |model: &RunModel<'_>, stages: &mut StageClock<'_>| {
            let error = estimates(plan, model, &outcome, step_over_safe, stages);
            model.drop_idle_positions();
            (error, verify(plan, model, &outcome, verification, stages))
        };
        let record = ended.sum_up(judged, &mut stages, errors, keep)?;
        Ok(Done { record, failure: outcome.failure.map(|failure| RunError::of_run(failure, step_over_safe)) })
    }

    /// Simulates the wear and observes the pair at each of `revolutions`; nothing of a run that ends early.
    fn at_moments(self, revolutions: &[f64], mut stages: StageClock<'_>) -> Result<Done<Vec<WornPair>>, RunError> {
        let (outcome, judged) = self.simulate(Resumption::none(), &mut stages)?;
        let Self { provenance, plan, mut model, warnings, .. } = self;
        let step_over_safe = judged.step_over_safe;
        model = model.ending_with(&outcome);
        model.drop_idle_positions();
        let at = revolutions.iter().map_while(|&revolutions| outcome.ended_at(revolutions));
        let mut pairs = Vec::new();
        for outcome in at {
            let ended = EndedRun { provenance, plan, model, outcome: &outcome, warnings: warnings.clone() };
            let errors = |_: &RunModel<'_>, _: &mut StageClock<'_>| {
                let reason = not_estimated_because(&outcome);
                (ErrorSummary::not_estimated(reason), Verified::none(reason))
            };
            pairs.push(ended.sum_up(judged.clone(), &mut stages, errors, recording::worn_pair)?);
            model = ended.model;
        }
        Ok(Done { record: pairs, failure: outcome.failure.map(|failure| RunError::of_run(failure, step_over_safe)) })
    }

    /// The outcome of the wear run, and the judgement of its steps.
    fn simulate(
        &self,
        Resumption { from, keeper }: Resumption<'_>,
        stages: &mut StageClock<'_>,
    ) -> Result<(Outcome, Judged), RunError> {
        let observer = stages.observer;
        let judged = stages.planned(self.plan, StageKind::StepBound, || stability::judge(&self.model, observer));
        let run = || self.model.wear_run().run_from(from, keeper, observer);
        Ok((stages.run(StageKind::Simulation.name(), run)?, judged.unwrap_or_default()))
    }
}

/// A run whose wear is simulated.
struct EndedRun<'a, 'b> {
    provenance: &'b Provenance,
    plan: &'b Plan,
    model: RunModel<'a>,
    outcome: &'b Outcome,
    /// Warnings of the preparation.
    warnings: Vec<String>,
}

impl EndedRun<'_, '_> {
    /// Observes the new and the worn pair and hands the findings to `keep`, with the errors that `errors` gives.
    fn sum_up<R>(
        &self,
        judged: Judged,
        stages: &mut StageClock<'_>,
        errors: impl FnOnce(&RunModel<'_>, &mut StageClock<'_>) -> (ErrorSummary, Verified),
        keep: impl FnOnce(&RunModel<'_>, RunFindings<'_>, Summary) -> R,
    ) -> Result<R, RunError> {
        let Self { plan, model, outcome, .. } = self;
        let heat = stages.planned(plan, StageKind::ContactTemperature, || temperature::observe(model, outcome));
        let heat = heat.flatten();
        let films = films_and_losses(plan, model, outcome, stages);
        let observer = stages.observer;
        let torque_curve =
            stages.planned(plan, StageKind::TorqueCurve, || torque_curve::observe(model, outcome, observer));
        let (mut error, verified) = errors(model, stages);
        verified.tell(&mut error);
        let found = RunFindings {
            outcome,
            heat: heat.as_ref(),
            lubrication: films.as_ref(),
            torque_curve: torque_curve.as_deref().unwrap_or_default(),
            verified: Some(&verified),
        };
        let mut summary = recording::summary(self.provenance, plan, model, found, error, judged)?;
        summary.warnings.extend_from_slice(&self.warnings);
        summary.stages.clone_from(&stages.times);
        Ok(keep(model, found, summary))
    }
}

/// Errors of the wear, estimated from coarser runs; none of a run that is not complete.
fn estimates(
    plan: &Plan,
    model: &RunModel<'_>,
    outcome: &Outcome,
    step_over_safe: f64,
    stages: &mut StageClock<'_>,
) -> ErrorSummary {
    if !plan.has(StageKind::ErrorEstimates) || !outcome.stop.is_complete() {
        return ErrorSummary::not_estimated(not_estimated_because(outcome));
    }
    let (observer, is_verified) = (stages.observer, plan.has(StageKind::Verification));
    stages.run(StageKind::ErrorEstimates.name(), || {
        error_estimates::estimate(model, outcome, step_over_safe, is_verified, observer)
    })
}

/// The verification of a complete run by finite elements, or why there is none.
fn verify<'a>(
    plan: &Plan,
    model: &RunModel<'a>,
    outcome: &Outcome,
    models: VerificationModels<'a, '_>,
    stages: &mut StageClock<'_>,
) -> Verified {
    if !outcome.stop.is_complete() {
        return Verified::none(not_estimated_because(outcome));
    }
    match plan.left_out_because(StageKind::Verification) {
        Some(reason) if model.scene.verify => Verified::failed(reason),
        Some(reason) => Verified::none(reason),
        None => {
            let observer = stages.observer;
            stages.run(StageKind::Verification.name(), || verification::verify(model, outcome, models, observer))
        }
    }
}

/// Films and losses, from one observation of the contacts of the mesh; none where the plan has neither.
fn films_and_losses(
    plan: &Plan,
    model: &RunModel<'_>,
    outcome: &Outcome,
    stages: &mut StageClock<'_>,
) -> Option<lubrication::LubricationFindings> {
    let contacts = stages.planned(plan, StageKind::Film, || lubrication::observe(model, outcome)).flatten();
    let findings = stages.planned(plan, StageKind::Losses, || {
        let contacts = contacts.or_else(|| lubrication::observe(model, outcome))?;
        Some(lubrication::sum_up(model, outcome, &contacts))
    });
    findings.flatten()
}

fn not_estimated_because(outcome: &Outcome) -> &'static str {
    match outcome.stop {
        StopReason::Completed | StopReason::LimitReached => "numerics.error_estimate is false",
        StopReason::Interrupted => "the run was interrupted",
        StopReason::NotConverged => "the run did not converge",
        StopReason::WornThrough => "a tooth is worn through",
    }
}
