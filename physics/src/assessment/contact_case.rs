//! Contact of the gears under the load and with the material of a phase.

use super::stage_clock::StageClock;
use super::{RunError, RunInputs};
use crate::contact::{
    ContactSurface,
    edge_foundation::EdgeFoundations,
    foundation::matched_mpa_per_mm,
    half_space::HalfSpace,
    hertz::{self, Hertz},
    hertz_mean::HertzMean,
    settings::{Foundation, MatchCriterion, SurfaceKind},
    winkler::{Winkler, WinklerFoundation},
};
use crate::mesh_cycle::condensed::WearingElements;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::operation::Scene;
use crate::plan::StageKind;
use crate::simulation::mesh_contact::MeshContact;
use crate::stiffness::{StiffnessError, TeethSpring, curve::PairCompliance, settings::StiffnessSettings};
use gearwear_bodies::gear::{GearPair, PerGear};
use gearwear_bodies::material::Material;

/// Contact of the gears under one load, with one material.
pub(super) struct ContactCase<'a> {
    pub line_load_n_per_mm: f64,
    pub material: PerGear<Material>,
    /// Stiffness along the path of contact, where it differs from that of the run.
    pub curve: Option<PairCompliance>,
    /// Wearing finite elements, where they differ from those of the run.
    pub elements: Option<WearingElements<'a>>,
    pub foundation_mpa_per_mm: Option<f64>,
    /// Contact surface of the springs on the line of action; none with finite elements.
    pub surface: Option<Box<dyn ContactSurface>>,
}

impl<'a> ContactCase<'a> {
    /// Spring of the teeth on the case's own curve, or on `curve` of the run; none with finite elements.
    pub(super) fn spring<'s>(
        &'s self,
        stiffness: StiffnessSettings,
        curve: Option<&'s PairCompliance>,
        pair: &'s GearPair,
    ) -> Result<Option<TeethSpring<'s>>, StiffnessError> {
        let Some(surface) = self.surface.as_deref() else { return Ok(None) };
        let curve = self.curve.as_ref().or(curve);
        TeethSpring::new(stiffness, curve, pair, &self.material, surface, self.line_load_n_per_mm).map(Some)
    }

    /// Elastic model of the mesh with these springs and slices, on the case's own wearing elements or `worn` of the run.
    pub(super) fn mesh_contact<'s>(
        &'s self,
        scene: &'s Scene,
        worn: Option<&'s WearingElements<'a>>,
        teeth: Option<&'s TeethSpring<'s>>,
        sliced: Option<&'s SlicedTeeth>,
    ) -> MeshContact<'s> {
        if let Some(elements) = self.elements.as_ref().or(worn) {
            return MeshContact::FiniteElements(elements);
        }
        let (Some(surface), Some(teeth)) = (self.surface.as_deref(), teeth) else {
            unreachable!("every surface but fem has springs")
        };
        match (scene.contact.surface, sliced) {
            (SurfaceKind::HertzMean, Some(sliced)) => {
                MeshContact::Simplified { material: &scene.material, teeth, sliced }
            }
            _ => MeshContact::LineOfAction { surface, teeth, tip_contact: scene.contact.tip_contact, sliced },
        }
    }
}

/// Prepares the contact of gears of `material` under one load, with stiffness and elements of the run.
pub(super) fn contact_case<'a>(
    inputs: RunInputs<'_>,
    pair: &GearPair,
    material: PerGear<Material>,
    line_load_n_per_mm: f64,
    stages: &mut StageClock<'_>,
) -> Result<ContactCase<'a>, RunError> {
    let scene = inputs.scene;
    let foundation = foundation(inputs, pair, &material, line_load_n_per_mm, stages);
    let springs_at_pitch = foundation.as_ref().map(|foundation| foundation.at(pair.path.pitch_point_mm));
    let foundation_mpa_per_mm = springs_at_pitch.map(|springs| springs.mpa_per_mm(line_load_n_per_mm));
    let surface = surface(scene, material, foundation, line_load_n_per_mm);
    Ok(ContactCase { line_load_n_per_mm, material, curve: None, elements: None, foundation_mpa_per_mm, surface })
}

/// K/H of a Winkler foundation; none of other surfaces.
fn foundation(
    RunInputs { scene, calibration, .. }: RunInputs<'_>,
    pair: &GearPair,
    material: &PerGear<Material>,
    line_load_n_per_mm: f64,
    stages: &mut StageClock<'_>,
) -> Option<WinklerFoundation> {
    if scene.contact.surface != SurfaceKind::Winkler {
        return None;
    }
    Some(match scene.contact.foundation {
        Foundation::Given { foundation_mpa_per_mm } => WinklerFoundation::Uniform { mpa_per_mm: foundation_mpa_per_mm },
        Foundation::Calibrated(criterion) => {
            let calibrated = &calibration.expect("a loaded scene has its calibration").foundation;
            let approach = calibrated[&MatchCriterion::Approach].in_normal_section(pair.obliquity());
            let edges = scene
                .contact
                .tip_contact
                .then(|| EdgeFoundations::new(pair, material, line_load_n_per_mm, criterion, &approach));
            let pressure = calibrated[&criterion].in_normal_section(pair.obliquity());
            WinklerFoundation::Curve { pressure, approach, edges }
        }
        Foundation::Matched(criterion) => {
            let at_pitch = hertz::flattening(&pair.normal_section(), material, pair.path.pitch_point_mm);
            let mpa_per_mm = stages
                .run(StageKind::ContactMatch.name(), || matched_mpa_per_mm(criterion, &at_pitch, line_load_n_per_mm));
            WinklerFoundation::Uniform { mpa_per_mm }
        }
    })
}

/// Contact surface of the springs on the line of action; none with finite elements.
fn surface(
    scene: &Scene,
    material: PerGear<Material>,
    foundation: Option<WinklerFoundation>,
    expected_line_load_n_per_mm: f64,
) -> Option<Box<dyn ContactSurface>> {
    match (scene.contact.surface, foundation) {
        (SurfaceKind::Fem, _) => None,
        (SurfaceKind::Winkler, Some(foundation)) => Some(Box::new(Winkler { foundation, expected_line_load_n_per_mm })),
        (SurfaceKind::HertzMean, _) => Some(Box::new(HertzMean { material })),
        (SurfaceKind::HalfSpace, _) => Some(Box::new(HalfSpace { material, expected_line_load_n_per_mm })),
        (SurfaceKind::Hertz, _) | (SurfaceKind::Winkler, None) => {
            Some(Box::new(Hertz { material, expected_line_load_n_per_mm }))
        }
    }
}
