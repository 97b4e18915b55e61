//! Preparation of a run: elasticity of the teeth, contact under each load, springs, slices, conditions of the phases. Each borrows from those before.

use std::sync::Arc;

use super::calibrate;
use super::contact_case::{ContactCase, contact_case};
use super::inputs::RunInputs;
use super::run_error::RunError;
use super::stage_clock::StageClock;
use super::temperature;
use super::verification::{self, Elements};
use crate::calibration::{self, CalibrationError};
use crate::contact::settings::SurfaceKind;
use crate::lubrication::running_pair::RunningPair;
use crate::mesh_cycle::condensed::WearingElements;
use crate::mesh_cycle::pair_in_space::{PairInSpace, PairInSpaceError};
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::mesh_cycle::slice_coupling::SliceCompliance;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::operation::Scene;
use crate::plan::{Plan, StageKind};
use crate::simulation::wear_run::RunPhase;
use crate::stiffness::curve::PairCompliance;
use crate::stiffness::{StiffnessError, TeethSpring, settings::StiffnessSettings};
use crate::thermal::ContactHeat;
use crate::wear::settings::WearOfPair;
use crate::wear::{self, Laws, WearModel};
use gearwear_bodies::gear::GearPair;
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::model::ModelError;
use gearwear_bodies::material::Material;
use gearwear_bodies::reference::flattening::Flattening;

/// Plane finite elements for both stiffness and verification; none where the plan has neither, or where the elements themselves wear.
pub(super) fn elements<'a>(
    inputs: RunInputs<'_>,
    plan: &Plan,
    pair: &'a GearPair,
    at_pitch: &Flattening,
    stages: &mut StageClock<'_>,
) -> Option<Result<Elements<'a>, ModelError>> {
    if inputs.scene.contact.surface == SurfaceKind::Fem {
        return None;
    }
    let observer = stages.observer;
    stages.planned(plan, StageKind::FiniteElementModel, || verification::elements(inputs, pair, at_pitch, observer))
}

/// Finite elements whose flank nodes wear in all phases; none of other surfaces.
pub(super) fn wearing_elements<'a>(
    inputs: RunInputs<'_>,
    pair: &'a GearPair,
    stages: &mut StageClock<'_>,
) -> Result<Option<CondensedPair<'a>>, ModelError> {
    let (scene, observer) = (inputs.scene, stages.observer);
    let wearing = (scene.contact.surface == SurfaceKind::Fem).then(|| {
        let load = pair.line_load_n_per_mm(scene.meshed_torque_n_mm());
        stages.run(StageKind::FiniteElementModel.name(), || {
            verification::condensed(scene, pair, load, &scene.wear_bodies(), (inputs.elements, observer))
        })
    });
    wearing.transpose()
}

/// Stiffness of the teeth, and the wearing finite elements of `contact.surface = "fem"`.
pub(super) struct ToothElasticity<'a> {
    /// Stiffness model in use.
    pub stiffness: StiffnessSettings,
    /// Stiffness along the path of contact, where the run itself computes it.
    computed: Option<PairCompliance>,
    /// Reason why the stiffness model is not the default one.
    pub warning: Option<String>,
    /// Finite elements whose flank nodes wear in all phases; none of other surfaces.
    worn: Option<WearingElements<'a>>,
}

impl<'a> ToothElasticity<'a> {
    pub(super) fn new(
        inputs: RunInputs<'_>,
        plan: &Plan,
        pair: &'a GearPair,
        elements: Option<&Result<Elements<'a>, ModelError>>,
        worn: Option<CondensedPair<'a>>,
        stages: &mut StageClock<'_>,
    ) -> Result<Self, RunError> {
        let setup = calibrate::setup(inputs.scene, pair);
        let (stiffness, computed, warning) = own_stiffness(inputs, plan, elements, &setup, stages)?;
        Ok(Self { stiffness, computed, warning, worn: worn.map(WearingElements::new) })
    }

    /// Curve of the stiffness model in use, for the scene's own material.
    fn curve<'c>(&'c self, inputs: RunInputs<'c>) -> Option<&'c PairCompliance> {
        match self.stiffness {
            StiffnessSettings::Fem => self.curve_by_elements(inputs),
            _ => inputs.stiffness_curve,
        }
    }

    /// Stiffness along the path of contact by finite elements: of the calibration file, or of the run.
    pub(super) fn curve_by_elements<'c>(&'c self, inputs: RunInputs<'c>) -> Option<&'c PairCompliance> {
        inputs.calibration.map(|calibration| &calibration.pair_compliance).or(self.computed.as_ref())
    }
}

/// Law, contact temperatures and lubricated mesh of a phase.
pub(super) type Conditions<'a> = (Laws, Option<ContactHeat>, Option<RunningPair<'a>>);

/// Conditions of each phase.
pub(super) fn conditions<'a>(scene: &'a Scene, pair: &'a GearPair) -> Vec<Conditions<'a>> {
    let phases = scene.operation.phases.iter();
    phases
        .map(|phase| {
            let heat = temperature::in_phase(scene, pair, phase);
            let wear = scene.wear_in(phase).with_severe(|own| Some(scene.numerics.stepping.followed(own)));
            (wear::of_both(&wear), heat, scene.running_in(pair, phase))
        })
        .collect()
}

/// Contact of the gears in each phase; phases under the same load and with the same materials share a case.
pub(super) struct ContactCases<'a> {
    all: Vec<ContactCase<'a>>,
    /// Index of the case of each phase.
    pub of_phase: Vec<usize>,
    /// Index of the case of each torque of the curve.
    of_torque: Vec<usize>,
}

impl<'a> ContactCases<'a> {
    pub(super) fn new(
        inputs: RunInputs<'_>,
        pair: &'a GearPair,
        elasticity: &ToothElasticity<'a>,
        elements: Option<&Result<Elements<'a>, ModelError>>,
        stages: &mut StageClock<'_>,
    ) -> Result<Self, RunError> {
        let scene = inputs.scene;
        let operation = &scene.operation;
        let mut cases = Self { all: Vec::new(), of_phase: Vec::new(), of_torque: Vec::new() };
        let of_phases = operation.phases.iter().map(|phase| (phase.pinion_torque_n_mm, scene.material_in(phase)));
        let heaviest = scene.material_in(operation.heaviest_phase());
        let of_torques = operation.torque_curve_n_mm.iter().map(|&torque| (torque, heaviest));
        for (index, (torque_n_mm, material)) in of_phases.chain(of_torques).enumerate() {
            let load = pair.line_load_n_per_mm(torque_n_mm);
            let known = cases
                .all
                .iter()
                .position(|case| case.line_load_n_per_mm.total_cmp(&load).is_eq() && case.material == material);
            let of = if index < operation.phases.len() { &mut cases.of_phase } else { &mut cases.of_torque };
            of.push(known.unwrap_or(cases.all.len()));
            if known.is_some() {
                continue;
            }
            let mut case = contact_case(inputs, pair, material, load, stages)?;
            if material != scene.material {
                let worn = elasticity.worn.as_ref();
                let of_material = |own: &WearingElements<'a>| verification::of_material(&own.model, scene, &material);
                case.elements = worn.map(of_material).map(WearingElements::new);
                if let (Some(Ok(elements)), Some(_)) = (elements, &elasticity.computed) {
                    let line_load_n_per_mm = load.max(elements.line_load_n_per_mm);
                    let curve = stages.run(StageKind::FiniteElementCalibration.name(), || {
                        let softer = verification::of_material(&elements.condensed, scene, &material);
                        calibration::pair_compliance(&softer, &material, line_load_n_per_mm)
                    });
                    case.curve = Some(curve?);
                }
            }
            cases.all.push(case);
        }
        Ok(cases)
    }

    /// Springs of the teeth of each case; none with finite elements.
    pub(super) fn springs<'s>(
        &'s self,
        inputs: RunInputs<'s>,
        plan: &Plan,
        pair: &'s GearPair,
        elasticity: &'s ToothElasticity<'_>,
        stages: &mut StageClock<'_>,
    ) -> Result<Vec<Option<TeethSpring<'s>>>, StiffnessError> {
        let curve = elasticity.curve(inputs);
        let springs = self.all.iter().map(|case| case.spring(elasticity.stiffness, curve, pair));
        match plan.has(StageKind::ToothStiffness) {
            true => stages.run(StageKind::ToothStiffness.name(), || springs.collect()),
            false => springs.collect(),
        }
    }

    /// K/H under the load of each phase, of the surfaces that have one.
    pub(super) fn foundations_mpa_per_mm(&self) -> Vec<Option<f64>> {
        self.of_phase.iter().map(|&case| self.all[case].foundation_mpa_per_mm).collect()
    }

    /// Phases of the run.
    pub(super) fn phases<'s>(
        &'s self,
        scene: &'s Scene,
        elasticity: &'s ToothElasticity<'_>,
        teeth: &'s [Option<TeethSpring<'s>>],
        sliced: Option<&'s SlicedTeeth>,
        conditions: &'s [Conditions<'s>],
    ) -> Vec<RunPhase<'s>> {
        let phases = scene.operation.phases.iter().zip(&self.of_phase).zip(conditions);
        phases
            .map(|((phase, &case), (laws, heat, running))| RunPhase {
                contact: self.all[case].mesh_contact(scene, elasticity.worn.as_ref(), teeth[case].as_ref(), sliced),
                wear: WearModel::new(laws).under(heat.as_ref(), running.as_ref()),
                line_load_n_per_mm: self.all[case].line_load_n_per_mm,
                end_revolutions: phase.end_revolutions,
            })
            .collect()
    }

    /// The phase `like` under each torque of the curve, N·mm, and with the springs of its load.
    pub(super) fn torque_curve<'s>(
        &'s self,
        scene: &'s Scene,
        elasticity: &'s ToothElasticity<'_>,
        teeth: &'s [Option<TeethSpring<'s>>],
        sliced: Option<&'s SlicedTeeth>,
        like: RunPhase<'s>,
    ) -> Vec<(f64, RunPhase<'s>)> {
        let torques = scene.operation.torque_curve_n_mm.iter().zip(&self.of_torque);
        torques
            .map(|(&torque_n_mm, &case)| {
                let own = &self.all[case];
                let contact = own.mesh_contact(scene, elasticity.worn.as_ref(), teeth[case].as_ref(), sliced);
                (torque_n_mm, RunPhase { contact, line_load_n_per_mm: own.line_load_n_per_mm, ..like })
            })
            .collect()
    }
}

/// Condensed three-dimensional finite elements of the teeth, or the reason why there are none.
pub(super) type InSpace = Result<Arc<PairInSpace>, PairInSpaceError>;

/// Three-dimensional finite elements that couple the slices; none where the plan has none.
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
    Some(stages.run(StageKind::TeethInSpace.name(), || {
        let material = scene.material.map(Material::elastic);
        let slices = scene.slices.map_or(1, |slices| slices.count);
        let load = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
        inputs.teeth_in_space.condensed(pair, material, scene.fem.in_space(), slices, load)
    }))
}

/// Slices over the face width.
pub(super) struct RunSlices {
    /// Slices with their coupling; none where all sections are alike.
    pub of_teeth: Option<SlicedTeeth>,
    /// Reason why their coupling is not the default one.
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
        let of_teeth = slices.map(|settings| {
            let coupling = in_space.and_then(|teeth| teeth.as_ref().ok()).cloned();
            let compliance = slice_compliance(inputs, pair, teeth);
            stages.run(StageKind::HelicalSlices.name(), || {
                SlicedTeeth::new(pair, &scene.material, settings, compliance, coupling)
            })
        });
        Ok(Self { of_teeth, warning })
    }
}

/// Stiffness model of a run, and its curve computed on `elements`. Where these cannot be made and the scene does not name
/// them, Weber and Banaschek's model with a warning.
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
        Err(error) if scene.stiffness_by_default && !names_fem_coupling(scene) => {
            let warning = format!(
                "stiffness.model: Weber and Banaschek's, as finite elements, the default, cannot be made for this pair: {error}"
            );
            Ok((StiffnessSettings::WeberBanaschek, None, Some(warning)))
        }
        Err(error) => Err(error.into()),
    }
}

/// Compliance of slices coupled as plates: fitted in the calibration of this same pair, otherwise in closed form.
fn slice_compliance(inputs: RunInputs<'_>, pair: &GearPair, teeth: Option<&TeethSpring<'_>>) -> SliceCompliance {
    let states_the_section = teeth.is_some_and(TeethSpring::states_the_section);
    let fitted = inputs.calibration.and_then(|calibration| calibration.slices);
    match fitted.filter(|fit| inputs.scene.stiffness == StiffnessSettings::Fem && fit.is_of(pair)) {
        Some(fit) => fit.compliance,
        None => SliceCompliance::of_plates(pair, &inputs.scene.material, states_the_section),
    }
}

/// Whether the scene itself names `helical.coupling = "fem"`, which needs the stiffness of plane finite elements.
fn names_fem_coupling(scene: &Scene) -> bool {
    !scene.coupling_by_default && scene.slices.is_some_and(|slices| slices.coupling == Coupling::Fem)
}

/// Slices of a run. Where three-dimensional finite elements cannot be made and the scene does not name them, slices are coupled as plates,
/// with a warning.
fn own_slices(
    scene: &Scene,
    stiffness: StiffnessSettings,
    in_space: Option<&InSpace>,
) -> Result<(Option<SliceSettings>, Option<String>), RunError> {
    let Some(settings) = scene.slices.filter(|slices| slices.coupling == Coupling::Fem) else {
        return Ok((scene.slices, None));
    };
    let reason = match in_space {
        Some(Err(error)) if names_fem_coupling(scene) => return Err(error.clone().into()),
        Some(Err(error)) => error.to_string(),
        // Stiffness by default too: a scene that names it has failed before.
        _ if stiffness != StiffnessSettings::Fem => "there are no plane finite elements".to_owned(),
        _ => return Ok((Some(settings), None)),
    };
    let warning = format!(
        "helical.coupling: \"slicing\", as three-dimensional finite elements, the default, cannot be made for this pair: {reason}"
    );
    Ok((Some(SliceSettings { coupling: Coupling::Slicing, ..settings }), Some(warning)))
}
