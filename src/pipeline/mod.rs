//! Carries out a plan, stage by stage, and hands back the record that reports are written from.
//!
//! This is the one way in which the program runs anything; the only clock it reads times the stages.

mod blame;
pub(crate) mod calibrate;
pub(crate) mod deformed_teeth;
mod drawing;
mod error_estimates;
pub(crate) mod fem_problem;
pub(crate) mod fem_scene;
pub(crate) mod guarded;
mod invariants;
mod left_out_contact;
mod load_case;
mod lubrication;
pub(crate) mod pair_mesh;
mod phases;
mod recording;
mod root_stress;
mod run_error;
mod scuffing;
mod severe_pressure;
mod slices;
mod springs;
mod stability;
mod stage_clock;
mod temperature;
mod verification;

use std::sync::Arc;
use std::time::Instant;

use crate::calibration::{self, CalibrationError};
use crate::contact::{
    hertz,
    settings::{Material, SurfaceKind},
};
use crate::fem::gear::model::ModelError;
use crate::gear::{GearPair, PerGear, flank_zones::FlankZones};
use crate::lubrication::running_pair::RunningPair;
use crate::mesh_cycle::pair_in_space::{PairInSpace, PairInSpaceError};
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::mesh_cycle::slice_coupling::SliceCompliance;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::observer::Observer;
use crate::plan::{MUCH_OF_SLICES_GB, Plan, StageKind, memory_in_space_gb, memory_of_slices_gb};
use crate::reference::flattening::Flattening;
use crate::results::error::ErrorSummary;
use crate::results::run::{RunRecord, StopReason, Summary};
use crate::results::worn_pair::WornPair;
use crate::scene::Scene;
use crate::scene::loaded::{LoadedScene, NamedFiles};
use crate::simulation::checkpoint::{Checkpoint, Keeper, NothingKept};
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::settings::{LifeLimits, Phase};
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun, reference_phase};
use crate::stiffness::curve::PairCompliance;
use crate::stiffness::{StiffnessError, TeethSpring, settings::StiffnessSettings};
use crate::thermal::ContactHeat;
use crate::wear::{self, Laws, WearModel};
use load_case::{LoadCase, load_case};
use recording::RunFindings;
pub use run_error::RunError;
use stage_clock::StageClock;
use verification::{Elements, Means, Verified};

/// What a computation came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Done<R = RunRecord, E = RunError> {
    /// Everything that was finished, or what is wanted of it.
    pub record: R,
    /// What went wrong where that is not all; none also where the observer interrupted the work, which the record's summary says.
    pub failure: Option<E>,
}

impl<R, E> Done<R, E> {
    /// The record, unless something went wrong.
    ///
    /// # Errors
    /// What went wrong: what was finished by then is lost.
    pub fn complete(self) -> Result<R, E> {
        match self.failure {
            None => Ok(self.record),
            Some(failure) => Err(failure),
        }
    }
}

/// What is to be said before teeth are condensed in space, where that takes much.
fn much_in_space(scene: &Scene) -> Option<String> {
    let gb = memory_in_space_gb(scene);
    (gb > MUCH_IN_SPACE_GB).then(|| {
        format!(
            "the teeth in space take some {gb:.1} GB, and a minute or more; a smaller pair.face_width_mm, fewer helical.slices, \
             numerics.positions or loads of operation.phases, or numerics.verify = false take less"
        )
    })
}

/// What is to be said before the contacts of many slices are made, where they take much.
fn many_slices(scene: &Scene) -> Option<String> {
    let gb = memory_of_slices_gb(scene);
    (gb > MUCH_OF_SLICES_GB).then(|| {
        format!(
            "the contacts of all slices take some {gb:.1} GB, and a wear step as much longer; fewer helical.slices, numerics.positions or \
             loads of operation.phases take less"
        )
    })
}

/// What teeth in space take more than this is said before, GB.
const MUCH_IN_SPACE_GB: f64 = 0.8;
/// Micrometres, in which records are written.
const UM_PER_MM: f64 = 1e3;
/// Part of the greatest load whose contact is still resolved by the elements that wear: half as wide as that of the whole. Phases under
/// less load see fewer elements, and wear little.
const LEAST_MESHED_LOAD: f64 = 0.25;

/// What a run is made of, beyond the scene's own data. Where loads of phases differ, figures of one load are of the greatest.
struct Model<'a> {
    scene: &'a Scene,
    /// The model of the teeth's stiffness that is used.
    stiffness: StiffnessSettings,
    pair: &'a GearPair,
    phases: Vec<RunPhase<'a>>,
    /// What ends a run before its time.
    limits: LifeLimits,
    /// The slices over the face width; none where all sections are alike.
    sliced: Option<&'a SlicedTeeth>,
    /// Springs of the teeth; none with finite elements.
    teeth: Option<&'a TeethSpring<'a>>,
    /// Hertz at the pitch point.
    at_pitch: Flattening,
    /// K/H under the load of each phase, of the surfaces that have one.
    foundations_mpa_per_mm: Vec<Option<f64>>,
}

impl Model<'_> {
    /// The scene's own run.
    fn wear_run(&self) -> WearRun<'_> {
        WearRun {
            pair: self.pair,
            zones: self.zones(),
            phases: &self.phases,
            snapshots_revolutions: &self.scene.operation.snapshots_revolutions,
            limits: self.limits,
            numerics: self.scene.numerics,
        }
    }

    /// The parts of both flanks, as wide as the greatest load of any phase asks for.
    fn zones(&self) -> PerGear<FlankZones> {
        let greatest = self.phases.iter().map(|phase| phase.line_load_n_per_mm).fold(0.0, f64::max);
        FlankZones::of_pair(self.pair, self.at_pitch.contact.loaded(greatest).half_width_mm)
    }

    /// How long a run is, pinion revolutions.
    fn duration(&self) -> f64 {
        self.phases.last().map_or(0.0, |phase| phase.end_revolutions)
    }

    /// That of the runs which `outcome` is held against: as long as it was, whatever they wear.
    fn ending_with(mut self, outcome: &Outcome) -> Self {
        self.limits = LifeLimits::default();
        if outcome.limit_reached.is_some() {
            let end = outcome.worn.revolutions;
            self.phases.iter_mut().for_each(|phase| phase.end_revolutions = phase.end_revolutions.min(end));
        }
        self
    }

    /// The phase of the greatest load.
    fn reference(&self) -> &RunPhase<'_> {
        &self.phases[reference_phase(&self.phases)]
    }
}

/// Where a run goes on, and who keeps its checkpoints.
pub(crate) struct Resumption<'a> {
    /// A checkpoint of this same run; `None`: it begins.
    pub from: Option<Checkpoint>,
    /// Gets new ones.
    pub keeper: &'a dyn Keeper,
}

impl Resumption<'_> {
    /// A run from its beginning, of which nothing is kept.
    fn none() -> Self {
        Self { from: None, keeper: &NothingKept }
    }
}

/// Runs `scene` as its plan says, the report apart: that is left to the caller, who knows where it goes.
///
/// A run that is interrupted or does not converge gives the record of what it had finished, and its failure in the latter
/// case.
///
/// # Errors
/// [`RunError`] where nothing was finished.
pub fn run(scene: &LoadedScene, observer: &dyn Observer) -> Result<Done, RunError> {
    scene.check_springs()?;
    run_from(&scene.clone().naming_copies(), Resumption::none(), observer)
}

/// The same for a run that may go on from a checkpoint, and gives new ones.
pub(crate) fn run_from(
    scene: &LoadedScene,
    resumption: Resumption<'_>,
    observer: &dyn Observer,
) -> Result<Done, RunError> {
    let start = Instant::now();
    let mut done = carry_out(scene, resumption, observer, |model, found, summary| {
        recording::record(scene, model, found, summary)
    })?;
    done.record.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(done)
}

/// The same for the main figures alone: what only a report reads is not made.
pub(crate) fn summarise(scene: &LoadedScene, observer: &dyn Observer) -> Result<Done<Summary>, RunError> {
    let start = Instant::now();
    let mut done = carry_out(scene, Resumption::none(), observer, |_, _, summary| summary)?;
    done.record.wall_s = start.elapsed().as_secs_f64();
    Ok(done)
}

/// The same for what a study of many runs keeps of each.
pub(crate) fn worn_pair(scene: &LoadedScene, observer: &dyn Observer) -> Result<Done<WornPair>, RunError> {
    carry_out(scene, Resumption::none(), observer, recording::worn_pair)
}

/// Carries out the plan of `loaded` and hands the outcome to `keep`, with a summary that lacks only the whole wall time.
fn carry_out<R>(
    loaded: &LoadedScene,
    resumption: Resumption<'_>,
    observer: &dyn Observer,
    keep: impl FnOnce(&Model<'_>, RunFindings<'_>, Summary) -> R,
) -> Result<Done<R>, RunError> {
    let LoadedScene { resolved, files, .. } = loaded;
    let (scene, plan) = (&resolved.scene, &loaded.plan());
    let mut stages = StageClock::new(observer);

    let pair = stages.run(StageKind::Geometry.name(), || GearPair::new(&scene.pair))?;
    let at_pitch = hertz::flattening(&pair.normal_section(), &scene.material, pair.path.pitch_point_mm);
    let line_load = |phase: &Phase| pair.line_load_n_per_mm(phase.pinion_torque_n_mm);
    // One model of finite elements serves the stiffness of the teeth and the verification.
    let elements = match plan.has(StageKind::FiniteElementModel) && scene.contact.surface != SurfaceKind::Fem {
        true => Some(stages.run(StageKind::FiniteElementModel.name(), || {
            verification::elements(scene, &pair, &at_pitch, line_load, observer)
        })),
        false => None,
    };
    let (stiffness, computed, stiffness_warning) =
        own_stiffness(scene, plan, files, elements.as_ref(), &calibrate::setup(scene, &pair), &mut stages)?;
    // All phases wear the nodes of one mesh.
    let worn_elements = match scene.contact.surface {
        SurfaceKind::Fem => Some(stages.run(StageKind::FiniteElementModel.name(), || {
            let loads = || scene.operation.phases.iter().map(line_load);
            let (least, greatest) = (loads().fold(f64::INFINITY, f64::min), loads().fold(0.0, f64::max));
            let load = least.max(LEAST_MESHED_LOAD * greatest);
            verification::condensed(scene, &pair, load, &scene.wear_bodies(), observer)
        })?),
        _ => None,
    };
    // Phases under the same load and as warm share a case.
    let mut cases: Vec<LoadCase<'_>> = Vec::new();
    let mut case_of_phase: Vec<usize> = Vec::with_capacity(scene.operation.phases.len());
    for phase in &scene.operation.phases {
        let (load, material) = (line_load(phase), scene.material_in(phase));
        let is_known =
            |case: &LoadCase<'_>| case.line_load_n_per_mm.total_cmp(&load).is_eq() && case.material == material;
        let known = cases.iter().position(is_known);
        case_of_phase.push(known.unwrap_or(cases.len()));
        if known.is_none() {
            let mut case = load_case(scene, &pair, files, material, load, &mut stages)?;
            if material != scene.material {
                case.elements =
                    worn_elements.as_ref().map(|elements| verification::of_material(elements, scene, &material));
                if let (Some(Ok(elements)), Some(_)) = (&elements, &computed) {
                    let line_load_n_per_mm = load.max(elements.line_load_n_per_mm);
                    let curve = || {
                        let softer = verification::of_material(&elements.condensed, scene, &material);
                        calibration::pair_compliance(&softer, &material, line_load_n_per_mm)
                    };
                    case.curve = Some(stages.run(StageKind::FiniteElementCalibration.name(), curve)?);
                }
            }
            cases.push(case);
        }
    }
    let curve = match (stiffness, &files.calibration) {
        (StiffnessSettings::Fem, Some(calibration)) => Some(&calibration.pair_compliance),
        (StiffnessSettings::Fem, None) => computed.as_ref(),
        _ => files.stiffness_curve.as_ref(),
    };
    let springs = || -> Result<Vec<_>, StiffnessError> {
        let mut springs = Vec::with_capacity(cases.len());
        for LoadCase { surface, line_load_n_per_mm, material, curve: own, .. } in &cases {
            let curve = own.as_ref().or(curve);
            let spring = match surface.as_deref() {
                Some(on) => Some(TeethSpring::new(stiffness, curve, &pair, material, on, *line_load_n_per_mm)?),
                None => None,
            };
            springs.push(spring);
        }
        Ok(springs)
    };
    let teeth = match plan.has(StageKind::ToothStiffness) {
        true => stages.run(StageKind::ToothStiffness.name(), springs),
        false => springs(),
    }?;
    if plan.has(StageKind::TeethInSpace)
        && let Some(much) = much_in_space(scene)
    {
        observer.announcement(&much);
    }
    let in_space = match plan.has(StageKind::TeethInSpace) {
        true => Some(stages.run(StageKind::TeethInSpace.name(), || {
            let material = scene.material.map(Material::elastic);
            let slices = scene.slices.map_or(1, |slices| slices.count);
            let load = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
            loaded.teeth_in_space.condensed(&pair, material, scene.fem.in_space(), slices, load)
        })),
        false => None,
    };
    let (slices, coupling_warning) = own_slices(scene, stiffness, in_space.as_ref())?;
    if let Some(much) = many_slices(scene) {
        observer.announcement(&much);
    }
    let sliced = slices.map(|settings| {
        let coupling = in_space.as_ref().and_then(|teeth| teeth.as_ref().ok()).cloned();
        let compliance = slice_compliance(&pair, scene, files, teeth[0].as_ref());
        let slices = || SlicedTeeth::new(&pair, &scene.material, settings, compliance, coupling);
        stages.run(StageKind::HelicalSlices.name(), slices)
    });
    let elements_of = |case: usize| cases[case].elements.as_ref().or(worn_elements.as_ref());
    let contact = |case: usize| match (elements_of(case), cases[case].surface.as_deref(), &teeth[case]) {
        (Some(model), ..) => MeshContact::FiniteElements(model),
        (None, Some(surface), Some(teeth)) => match (scene.contact.surface, sliced.as_ref()) {
            (SurfaceKind::HertzMean, Some(sliced)) => {
                MeshContact::Simplified { material: &scene.material, teeth, sliced }
            }
            (_, sliced) => MeshContact::LineOfAction { surface, teeth, tip_contact: scene.contact.tip_contact, sliced },
        },
        (None, ..) => unreachable!("every surface but fem has springs"),
    };
    let laws: Vec<(Laws, Option<ContactHeat>, Option<RunningPair<'_>>)> = scene
        .operation
        .phases
        .iter()
        .map(|phase| {
            let running = scene.running_in(&pair, phase);
            let heat = temperature::in_phase(scene, &pair, phase);
            (wear::of_both(&scene.wear_in(phase)), heat, running)
        })
        .collect();
    let foundations_mpa_per_mm = case_of_phase.iter().map(|&case| cases[case].foundation_mpa_per_mm).collect();
    let phases: Vec<RunPhase<'_>> = scene
        .operation
        .phases
        .iter()
        .zip(&case_of_phase)
        .zip(&laws)
        .map(|((phase, &case), (laws, heat, running))| RunPhase {
            contact: contact(case),
            wear: WearModel::new(laws).under(heat.as_ref(), running.as_ref()),
            line_load_n_per_mm: cases[case].line_load_n_per_mm,
            end_revolutions: phase.end_revolutions,
        })
        .collect();
    let reference = reference_phase(&phases);
    let model = Model {
        scene,
        stiffness,
        pair: &pair,
        phases,
        limits: scene.operation.stop,
        sliced: sliced.as_ref(),
        teeth: teeth[case_of_phase[reference]].as_ref(),
        at_pitch,
        foundations_mpa_per_mm,
    };

    let judged = match plan.has(StageKind::StepBound) {
        true => stages.run(StageKind::StepBound.name(), || stability::judge(&model, observer)),
        false => stability::Judged::default(),
    };
    let step_over_safe = judged.step_over_safe;
    let Resumption { from, keeper } = resumption;
    let outcome = stages.run(StageKind::Simulation.name(), || model.wear_run().run_from(from, keeper, observer))?;
    let model = model.ending_with(&outcome);
    let heat = match plan.has(StageKind::ContactTemperature) {
        true => stages.run(StageKind::ContactTemperature.name(), || temperature::observe(&model, &outcome)),
        false => None,
    };
    let films = films_and_losses(plan, &model, &outcome, &mut stages);
    let found = RunFindings { outcome: &outcome, heat: heat.as_ref(), lubrication: films.as_ref(), verified: None };
    let mut error = if plan.has(StageKind::ErrorEstimates) && outcome.stop.is_complete() {
        let estimate = || error_estimates::estimate(&model, &outcome, step_over_safe, observer);
        stages.run(StageKind::ErrorEstimates.name(), estimate)
    } else {
        ErrorSummary::not_estimated(not_estimated_because(&outcome))
    };

    let verified = match (outcome.stop.is_complete(), plan.left_out_because(StageKind::Verification)) {
        (true, None) => {
            let curve =
                files.calibration.as_ref().map(|calibration| &calibration.pair_compliance).or(computed.as_ref());
            let means = Means { elements, curve, in_space };
            stages.run(StageKind::Verification.name(), || verification::verify(&model, &outcome, means, observer))
        }
        (true, Some(reason)) => Verified::none(reason),
        (false, _) => Verified::none(not_estimated_because(&outcome)),
    };
    verified.tell(&mut error);

    let found = RunFindings { verified: Some(&verified), ..found };
    let mut summary = recording::summary(resolved, plan, &model, found, error, judged)?;
    summary.warnings.extend(stiffness_warning.into_iter().chain(coupling_warning));
    summary.stages = stages.times;
    let record = keep(&model, found, summary);
    Ok(Done { record, failure: outcome.failure.map(|failure| RunError::of_run(failure, step_over_safe)) })
}

/// The stiffness model of a run, and the curve that it makes for itself on `elements`. Where these cannot be had and the scene does not
/// ask for them by name, it is Weber and Banaschek's, with a warning.
fn own_stiffness(
    scene: &Scene,
    plan: &Plan,
    files: &NamedFiles,
    elements: Option<&Result<Elements<'_>, ModelError>>,
    setup: &calibration::bodies::Setup<'_>,
    stages: &mut StageClock<'_>,
) -> Result<(StiffnessSettings, Option<PairCompliance>, Option<String>), RunError> {
    let Some(elements) =
        elements.filter(|_| plan.has(StageKind::FiniteElementCalibration) && files.calibration.is_none())
    else {
        return Ok((scene.stiffness, None, None));
    };
    let curve = stages.run(StageKind::FiniteElementCalibration.name(), || match elements {
        Ok(elements) => {
            let line_load_n_per_mm = setup.line_load_n_per_mm.max(elements.line_load_n_per_mm);
            calibration::pair_compliance(&elements.condensed, &setup.material, line_load_n_per_mm)
        }
        Err(error) => Err(CalibrationError::Model(error.clone())),
    });
    match curve {
        Ok(curve) => Ok((scene.stiffness, Some(curve), None)),
        Err(error) if scene.stiffness_by_default && !asks_for_space(scene) => {
            let warning = format!(
                "stiffness.model: Weber and Banaschek's, as finite elements, the default, cannot be had for this pair: {error}"
            );
            Ok((StiffnessSettings::WeberBanaschek, None, Some(warning)))
        }
        Err(error) => Err(error.into()),
    }
}

/// How slices yield that are not coupled in space: as the calibration of this very pair found, otherwise in closed form.
fn slice_compliance(
    pair: &GearPair,
    scene: &Scene,
    files: &NamedFiles,
    teeth: Option<&TeethSpring<'_>>,
) -> SliceCompliance {
    let states_the_section = teeth.is_some_and(TeethSpring::states_the_section);
    let fitted = files.calibration.as_ref().and_then(|calibration| calibration.slices);
    match fitted.filter(|fit| scene.stiffness == StiffnessSettings::Fem && fit.is_of(pair)) {
        Some(fit) => fit.compliance,
        None => SliceCompliance::of_plates(pair, &scene.material, states_the_section),
    }
}

/// Whether the scene asks for slices coupled in space by name, which need the stiffness of plane finite elements.
fn asks_for_space(scene: &Scene) -> bool {
    !scene.coupling_by_default && scene.slices.is_some_and(|slices| slices.coupling == Coupling::Fem)
}

/// The slices of a run. Where they are coupled in space, that cannot be had, and the scene does not ask for it by name, they are coupled
/// as plates, with a warning.
fn own_slices(
    scene: &Scene,
    stiffness: StiffnessSettings,
    in_space: Option<&Result<Arc<PairInSpace>, PairInSpaceError>>,
) -> Result<(Option<SliceSettings>, Option<String>), RunError> {
    let Some(settings) = scene.slices.filter(|slices| slices.coupling == Coupling::Fem) else {
        return Ok((scene.slices, None));
    };
    let reason = match in_space {
        Some(Err(error)) if asks_for_space(scene) => return Err(error.clone().into()),
        Some(Err(error)) => error.to_string(),
        // By default too, or the run would have ended there.
        _ if stiffness != StiffnessSettings::Fem => "there are no plane ones".to_owned(),
        _ => return Ok((Some(settings), None)),
    };
    let warning = format!(
        "helical.coupling: \"slicing\", as three-dimensional finite elements, the default, cannot be had for this pair: {reason}"
    );
    Ok((Some(SliceSettings { coupling: Coupling::Slicing, ..settings }), Some(warning)))
}

/// Films and losses, which are one look at the contacts of the mesh; none where the plan has neither.
fn films_and_losses(
    plan: &Plan,
    model: &Model<'_>,
    outcome: &Outcome,
    stages: &mut StageClock<'_>,
) -> Option<lubrication::Observed> {
    let seen = match plan.has(StageKind::Film) {
        true => stages.run(StageKind::Film.name(), || lubrication::look(model, outcome)),
        false => None,
    };
    match plan.has(StageKind::Losses) {
        true => stages.run(StageKind::Losses.name(), || {
            let seen = seen.or_else(|| lubrication::look(model, outcome))?;
            Some(lubrication::sum_up(model, outcome, &seen))
        }),
        false => None,
    }
}

fn not_estimated_because(outcome: &Outcome) -> &'static str {
    match outcome.stop {
        StopReason::Completed | StopReason::LimitReached => "numerics.error_estimate is false",
        StopReason::Interrupted => "the run was interrupted",
        StopReason::NotConverged => "the run did not converge",
        StopReason::WornThrough => "a tooth is worn through",
    }
}
