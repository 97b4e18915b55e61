//! How the gears touch in a phase, under its load and of its material.

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
use crate::gear::{GearPair, PerGear};
use crate::gear_fem::condensed_pair::CondensedPair;
use crate::material::Material;
use crate::operation::Scene;
use crate::plan::StageKind;
use crate::stiffness::curve::PairCompliance;

/// How the gears touch under one load, of one material.
pub(super) struct LoadCase<'a> {
    pub line_load_n_per_mm: f64,
    pub material: PerGear<Material>,
    /// Stiffness along the path of contact; none where it is that of the run.
    pub curve: Option<PairCompliance>,
    /// Finite elements that wear; none where there are none, or those of the run.
    pub elements: Option<CondensedPair<'a>>,
    pub foundation_mpa_per_mm: Option<f64>,
    /// None with finite elements.
    pub surface: Option<Box<dyn ContactSurface>>,
}

/// Prepares the contact of gears of `material` under one load, with stiffness and elements of the run.
pub(super) fn load_case<'a>(
    inputs: RunInputs<'_>,
    pair: &GearPair,
    material: PerGear<Material>,
    line_load_n_per_mm: f64,
    stages: &mut StageClock<'_>,
) -> Result<LoadCase<'a>, RunError> {
    let scene = inputs.scene;
    let foundation = match (scene.contact.surface, scene.contact.foundation, inputs.calibration) {
        (SurfaceKind::Winkler, Foundation::Given { foundation_mpa_per_mm }, _) => {
            Some(WinklerFoundation::Uniform { mpa_per_mm: foundation_mpa_per_mm })
        }
        (SurfaceKind::Winkler, Foundation::Calibrated(criterion), Some(calibration)) => {
            let curve = |criterion| calibration.foundation[&criterion].in_normal_section(pair.obliquity());
            let approach = curve(MatchCriterion::Approach);
            let edges = scene
                .contact
                .tip_contact
                .then(|| EdgeFoundations::new(pair, &material, line_load_n_per_mm, criterion, &approach));
            Some(WinklerFoundation::Curve { pressure: curve(criterion), approach, edges })
        }
        (SurfaceKind::Winkler, Foundation::Calibrated(_), None) => unreachable!("a loaded scene has its calibration"),
        (SurfaceKind::Winkler, Foundation::Matched(criterion), _) => {
            let at_pitch = hertz::flattening(&pair.normal_section(), &material, pair.path.pitch_point_mm);
            let matched = || matched_mpa_per_mm(criterion, &at_pitch, line_load_n_per_mm);
            Some(WinklerFoundation::Uniform { mpa_per_mm: stages.run(StageKind::ContactMatch.name(), matched) })
        }
        _ => None,
    };
    let springs_at_pitch = foundation.as_ref().map(|foundation| foundation.at(pair.path.pitch_point_mm));
    let foundation_mpa_per_mm = springs_at_pitch.map(|springs| springs.mpa_per_mm(line_load_n_per_mm));
    let surface = surface(scene, material, foundation, line_load_n_per_mm);
    Ok(LoadCase { line_load_n_per_mm, material, curve: None, elements: None, foundation_mpa_per_mm, surface })
}

/// The surface of the springs on the line of action; none with finite elements, which are no springs.
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
