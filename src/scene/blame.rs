//! Failures of a computation that the scene causes: found only when the teeth are meshed or the springs are made, they are told
//! at its key like everything else that is wrong with a scene.

use crate::scene::Problem;
use crate::scene::loaded::{SceneError, SceneText};
use gearwear_bodies::gear_fem::model::ModelError;
use gearwear_physics::assessment::RunError;
use gearwear_physics::assessment::calibrate::CalibrateError;
use gearwear_physics::assessment::fem_scene::FemPairError;
use gearwear_physics::assessment::pair_mesh::PairMeshError;
use gearwear_physics::calibration::CalibrationError;

/// A failure of a computation that may be the scene's fault.
pub trait SceneFault {
    /// What is wrong with the scene in the text `given`, if that is why the computation failed.
    fn in_the_scene(&self, given: &SceneText) -> Option<SceneError>;
}

impl SceneFault for RunError {
    fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        let text = &given.text;
        let problem = match (self.stiffness(), self) {
            (Some(stiffness), _) => Some(Problem::of_stiffness(text, stiffness)),
            (None, RunError::TeethInSpace(error)) => Some(Problem::of_teeth_in_space(text, error)),
            (None, RunError::FiniteElements(model)) => Some(of_model(model, text)),
            (None, RunError::Calibration(calibration)) => of_calibration(calibration, text),
            (None, RunError::Pair(pair)) => Some(Problem::of_pair(text, pair)),
            (None, RunError::Memory { .. } | RunError::Stiffness(_)) => None,
            (None, RunError::Simulation(_) | RunError::UnstableSteps { .. }) => None,
        };
        problem.map(|problem| given.refused(vec![problem]))
    }
}

impl SceneFault for CalibrateError {
    fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        let text = &given.text;
        let problem = match self {
            CalibrateError::Calibration(calibration) => of_calibration(calibration, text),
            CalibrateError::Pair(pair) => Some(Problem::of_pair(text, pair)),
            CalibrateError::Stiffness(stiffness) => Some(Problem::of_stiffness(text, stiffness)),
            CalibrateError::Cycle { .. } | CalibrateError::Interrupted => None,
        };
        problem.map(|problem| given.refused(vec![problem]))
    }
}

impl SceneFault for PairMeshError {
    fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        let text = &given.text;
        let problem = match self {
            PairMeshError::Position { .. } => return None,
            PairMeshError::Run(error) => return error.in_the_scene(given),
            PairMeshError::Tooth(tooth) => Problem::of_tooth_mesh(text, None, tooth),
            PairMeshError::Pair(pair) => Problem::of_pair(text, pair),
            PairMeshError::Quality { gear, source } => Problem::of_mesh_quality(text, *gear, source),
        };
        Some(given.refused(vec![problem]))
    }
}

impl SceneFault for FemPairError {
    fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        let text = &given.text;
        let problem = match self {
            FemPairError::Model(model) => Some(of_model(model, text)),
            FemPairError::Pair(pair) => Some(Problem::of_pair(text, pair)),
            FemPairError::Quality { gear, source } => Some(Problem::of_mesh_quality(text, Some(*gear), source)),
            _ => None,
        };
        problem.map(|problem| given.refused(vec![problem]))
    }
}

/// A finite-element model that cannot be made, at the key to change in the scene's `text`.
fn of_model(error: &ModelError, text: &str) -> Problem {
    match error {
        ModelError::TooFewTeeth { teeth, least, .. } => Problem::of_sector_teeth(text, *teeth, *least),
        ModelError::Mesh { gear, source } => Problem::of_tooth_mesh(text, Some(*gear), source),
        ModelError::TooFine { .. } => Problem::of_elements(text, error.to_string()),
        ModelError::Condense { gear, source } => Problem::of_condensation(text, *gear, source),
    }
}

/// A calibration that cannot be made, if the scene in `text` causes it.
fn of_calibration(error: &CalibrationError, text: &str) -> Option<Problem> {
    match error {
        CalibrationError::Model(model) => Some(of_model(model, text)),
        other => Problem::of_contact_strip(text, other),
    }
}
