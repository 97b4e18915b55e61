//! What a run is prepared from: bodies, contact under each load, springs of the teeth, slices, conditions of the phases. Each borrows from those before.

use std::sync::Arc;

use super::calibrate;
use super::inputs::RunInputs;
use super::load_case::{LoadCase, load_case};
use super::run_error::RunError;
use super::stage_clock::StageClock;
use super::temperature;
use super::verification::{self, Elements};
use crate::calibration::{self, CalibrationError};
use crate::contact::settings::SurfaceKind;
use crate::gear::GearPair;
use crate::gear_fem::condensed_pair::CondensedPair;
use crate::gear_fem::model::ModelError;
use crate::lubrication::running_pair::RunningPair;
use crate::material::Material;
use crate::mesh_cycle::pair_in_space::{PairInSpace, PairInSpaceError};
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::mesh_cycle::slice_coupling::SliceCompliance;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::operation::Scene;
use crate::plan::{MUCH_OF_SLICES_GB, Plan, StageKind, memory_in_space_gb, memory_of_slices_gb};
use crate::reference::flattening::Flattening;
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::wear_run::RunPhase;
use crate::stiffness::curve::PairCompliance;
use crate::stiffness::{StiffnessError, TeethSpring, settings::StiffnessSettings};
use crate::thermal::ContactHeat;
use crate::wear::{self, Laws, WearModel};

/// Part of the greatest load whose contact is still resolved by the elements that wear: half as wide as that of the whole. Phases under
/// less load see fewer elements, and wear little.
const LEAST_MESHED_LOAD: f64 = 0.25;

/// What teeth in space take more than this is said before, GB.
const MUCH_IN_SPACE_GB: f64 = 0.8;

/// The finite elements of the stiffness and of the verification, which one model serves; none where the plan has neither, or the elements wear.
pub(super) fn elements<'a>(
    scene: &Scene,
    plan: &Plan,
    pair: &'a GearPair,
    at_pitch: &Flattening,
    stages: &mut StageClock<'_>,
) -> Option<Result<Elements<'a>, ModelError>> {
    let observer = stages.observer;
    (plan.has(StageKind::FiniteElementModel) && scene.contact.surface != SurfaceKind::Fem).then(|| {
        stages.run(StageKind::FiniteElementModel.name(), || verification::elements(scene, pair, at_pitch, observer))
    })
}

/// The stiffness of the teeth, and the finite elements that wear.
pub(super) struct Bodies<'a> {
    /// The model of the teeth's stiffness that is used.
    pub stiffness: StiffnessSettings,
    /// The stiffness along the path of contact, where the run computes it.
    computed: Option<PairCompliance>,
    /// Why the stiffness is not the one that the scene leaves open.
    pub warning: Option<String>,
    /// One mesh whose nodes all phases wear; none of other surfaces.
    worn: Option<CondensedPair<'a>>,
}

impl<'a> Bodies<'a> {
    pub(super) fn new(
        inputs: RunInputs<'_>,
        plan: &Plan,
        pair: &'a GearPair,
        elements: Option<&Result<Elements<'a>, ModelError>>,
        stages: &mut StageClock<'_>,
    ) -> Result<Self, RunError> {
        let (scene, observer) = (inputs.scene, stages.observer);
        let setup = calibrate::setup(scene, pair);
        let (stiffness, computed, warning) = own_stiffness(inputs, plan, elements, &setup, stages)?;
        let worn = (scene.contact.surface == SurfaceKind::Fem).then(|| {
            let [least, greatest] = scene.operation.torque_range_n_mm().map(|torque| pair.line_load_n_per_mm(torque));
            let load = least.max(LEAST_MESHED_LOAD * greatest);
            let condensed = || verification::condensed(scene, pair, load, &scene.wear_bodies(), observer);
            stages.run(StageKind::FiniteElementModel.name(), condensed)
        });
        Ok(Self { stiffness, computed, warning, worn: worn.transpose()? })
    }

    /// The curve of the stiffness model that is used, of the scene's own material.
    fn curve<'c>(&'c self, inputs: RunInputs<'c>) -> Option<&'c PairCompliance> {
        match self.stiffness {
            StiffnessSettings::Fem => self.told_by_elements(inputs),
            _ => inputs.stiffness_curve,
        }
    }

    /// The stiffness along the path of contact that finite elements have told: of the calibration file, or of the run.
    pub(super) fn told_by_elements<'c>(&'c self, inputs: RunInputs<'c>) -> Option<&'c PairCompliance> {
        inputs.calibration.map(|calibration| &calibration.pair_compliance).or(self.computed.as_ref())
    }
}

/// Law, contact temperatures and lubricated mesh of a phase.
pub(super) type Conditions<'a> = (Laws, Option<ContactHeat>, Option<RunningPair<'a>>);

/// What holds in each phase.
pub(super) fn conditions<'a>(scene: &'a Scene, pair: &'a GearPair) -> Vec<Conditions<'a>> {
    let in_phase = |phase| {
        let heat = temperature::in_phase(scene, pair, phase);
        (wear::of_both(&scene.wear_in(phase)), heat, scene.running_in(pair, phase))
    };
    scene.operation.phases.iter().map(in_phase).collect()
}

/// The contact of the gears in each phase: phases under the same load and as warm share a case.
pub(super) struct Cases<'a> {
    all: Vec<LoadCase<'a>>,
    /// The case of each phase.
    pub of_phase: Vec<usize>,
}

impl<'a> Cases<'a> {
    pub(super) fn new(
        inputs: RunInputs<'_>,
        pair: &'a GearPair,
        bodies: &Bodies<'a>,
        elements: Option<&Result<Elements<'a>, ModelError>>,
        stages: &mut StageClock<'_>,
    ) -> Result<Self, RunError> {
        let scene = inputs.scene;
        let mut cases = Self { all: Vec::new(), of_phase: Vec::with_capacity(scene.operation.phases.len()) };
        for phase in &scene.operation.phases {
            let (load, material) = (pair.line_load_n_per_mm(phase.pinion_torque_n_mm), scene.material_in(phase));
            let is_known =
                |case: &LoadCase<'_>| case.line_load_n_per_mm.total_cmp(&load).is_eq() && case.material == material;
            let known = cases.all.iter().position(is_known);
            cases.of_phase.push(known.unwrap_or(cases.all.len()));
            if known.is_none() {
                let mut case = load_case(inputs, pair, material, load, stages)?;
                if material != scene.material {
                    case.elements =
                        bodies.worn.as_ref().map(|elements| verification::of_material(elements, scene, &material));
                    if let (Some(Ok(elements)), Some(_)) = (elements, &bodies.computed) {
                        let line_load_n_per_mm = load.max(elements.line_load_n_per_mm);
                        let curve = || {
                            let softer = verification::of_material(&elements.condensed, scene, &material);
                            calibration::pair_compliance(&softer, &material, line_load_n_per_mm)
                        };
                        case.curve = Some(stages.run(StageKind::FiniteElementCalibration.name(), curve)?);
                    }
                }
                cases.all.push(case);
            }
        }
        Ok(cases)
    }

    /// The springs of the teeth of each case; none with finite elements.
    pub(super) fn springs<'s>(
        &'s self,
        inputs: RunInputs<'s>,
        plan: &Plan,
        pair: &'s GearPair,
        bodies: &'s Bodies<'_>,
        stages: &mut StageClock<'_>,
    ) -> Result<Vec<Option<TeethSpring<'s>>>, StiffnessError> {
        let of_all = bodies.curve(inputs);
        let spring = |case: &'s LoadCase<'_>| {
            let LoadCase { surface, line_load_n_per_mm, material, curve, .. } = case;
            let curve = curve.as_ref().or(of_all);
            let spring = |on| TeethSpring::new(bodies.stiffness, curve, pair, material, on, *line_load_n_per_mm);
            surface.as_deref().map(spring).transpose()
        };
        let springs = || self.all.iter().map(spring).collect();
        match plan.has(StageKind::ToothStiffness) {
            true => stages.run(StageKind::ToothStiffness.name(), springs),
            false => springs(),
        }
    }

    /// K/H under the load of each phase, of the surfaces that have one.
    pub(super) fn foundations_mpa_per_mm(&self) -> Vec<Option<f64>> {
        self.of_phase.iter().map(|&case| self.all[case].foundation_mpa_per_mm).collect()
    }

    /// The phases of the run.
    pub(super) fn phases<'s>(
        &'s self,
        scene: &'s Scene,
        bodies: &'s Bodies<'_>,
        teeth: &'s [Option<TeethSpring<'s>>],
        sliced: Option<&'s SlicedTeeth>,
        conditions: &'s [Conditions<'s>],
    ) -> Vec<RunPhase<'s>> {
        let contact = |case: usize| {
            let elements = self.all[case].elements.as_ref().or(bodies.worn.as_ref());
            match (elements, self.all[case].surface.as_deref(), &teeth[case]) {
                (Some(model), ..) => MeshContact::FiniteElements(model),
                (None, Some(surface), Some(teeth)) => match (scene.contact.surface, sliced) {
                    (SurfaceKind::HertzMean, Some(sliced)) => {
                        MeshContact::Simplified { material: &scene.material, teeth, sliced }
                    }
                    _ => {
                        let tip_contact = scene.contact.tip_contact;
                        MeshContact::LineOfAction { surface, teeth, tip_contact, sliced }
                    }
                },
                (None, ..) => unreachable!("every surface but fem has springs"),
            }
        };
        let phases = scene.operation.phases.iter().zip(&self.of_phase).zip(conditions);
        phases
            .map(|((phase, &case), (laws, heat, running))| RunPhase {
                contact: contact(case),
                wear: WearModel::new(laws).under(heat.as_ref(), running.as_ref()),
                line_load_n_per_mm: self.all[case].line_load_n_per_mm,
                end_revolutions: phase.end_revolutions,
            })
            .collect()
    }
}

/// Teeth condensed in space, or why they cannot be.
pub(super) type InSpace = Result<Arc<PairInSpace>, PairInSpaceError>;

/// The teeth in space that couple slices; none where the plan has none.
pub(super) fn teeth_in_space(
    inputs: RunInputs<'_>,
    plan: &Plan,
    pair: &GearPair,
    stages: &mut StageClock<'_>,
) -> Option<InSpace> {
    if !plan.has(StageKind::TeethInSpace) {
        return None;
    }
    let scene = inputs.scene;
    let gb = memory_in_space_gb(scene);
    if gb > MUCH_IN_SPACE_GB {
        stages.observer.announcement(&format!(
            "the teeth in space take some {gb:.1} GB, and a minute or more; a smaller pair.face_width_mm, fewer helical.slices, \
             numerics.positions or loads of operation.phases, or numerics.verify = false take less"
        ));
    }
    Some(stages.run(StageKind::TeethInSpace.name(), || {
        let material = scene.material.map(Material::elastic);
        let slices = scene.slices.map_or(1, |slices| slices.count);
        let load = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
        inputs.teeth_in_space.condensed(pair, material, scene.fem.in_space(), slices, load)
    }))
}

/// The slices over the face width.
pub(super) struct RunSlices {
    /// None where all sections are alike.
    pub of_teeth: Option<SlicedTeeth>,
    /// Why their coupling is not the one that the scene leaves open.
    pub warning: Option<String>,
}

impl RunSlices {
    pub(super) fn new(
        inputs: RunInputs<'_>,
        pair: &GearPair,
        stiffness: StiffnessSettings,
        teeth: Option<&TeethSpring<'_>>,
        in_space: Option<&InSpace>,
        stages: &mut StageClock<'_>,
    ) -> Result<Self, RunError> {
        let scene = inputs.scene;
        let (slices, warning) = own_slices(scene, stiffness, in_space)?;
        let gb = memory_of_slices_gb(scene);
        if gb > MUCH_OF_SLICES_GB {
            stages.observer.announcement(&format!(
                "the contacts of all slices take some {gb:.1} GB, and a wear step as much longer; fewer helical.slices, \
                 numerics.positions or loads of operation.phases take less"
            ));
        }
        let of_teeth = slices.map(|settings| {
            let coupling = in_space.and_then(|teeth| teeth.as_ref().ok()).cloned();
            let compliance = slice_compliance(inputs, pair, teeth);
            let sliced = || SlicedTeeth::new(pair, &scene.material, settings, compliance, coupling);
            stages.run(StageKind::HelicalSlices.name(), sliced)
        });
        Ok(Self { of_teeth, warning })
    }
}

/// The stiffness model of a run, and the curve that it makes for itself on `elements`. Where these cannot be had and the scene does not
/// ask for them by name, it is Weber and Banaschek's, with a warning.
fn own_stiffness(
    inputs: RunInputs<'_>,
    plan: &Plan,
    elements: Option<&Result<Elements<'_>, ModelError>>,
    setup: &calibration::bodies::Setup<'_>,
    stages: &mut StageClock<'_>,
) -> Result<(StiffnessSettings, Option<PairCompliance>, Option<String>), RunError> {
    let scene = inputs.scene;
    let Some(elements) =
        elements.filter(|_| plan.has(StageKind::FiniteElementCalibration) && inputs.calibration.is_none())
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
fn slice_compliance(inputs: RunInputs<'_>, pair: &GearPair, teeth: Option<&TeethSpring<'_>>) -> SliceCompliance {
    let states_the_section = teeth.is_some_and(TeethSpring::states_the_section);
    let fitted = inputs.calibration.and_then(|calibration| calibration.slices);
    match fitted.filter(|fit| inputs.scene.stiffness == StiffnessSettings::Fem && fit.is_of(pair)) {
        Some(fit) => fit.compliance,
        None => SliceCompliance::of_plates(pair, &inputs.scene.material, states_the_section),
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
    in_space: Option<&InSpace>,
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
