//! What a computation fails of although the scene alone is to blame: found only when the teeth are meshed or the springs are made, it is told
//! at its key like everything else that is wrong with a scene.

use crate::calibration::CalibrationError;
use crate::fem::gear::model::ModelError;
use crate::pipeline::RunError;
use crate::pipeline::calibrate::CalibrateError;
use crate::pipeline::fem_scene::FemPairError;
use crate::scene::Problem;
use crate::scene::loaded::{SceneError, SceneText};

impl RunError {
    /// What is wrong with the scene in the text `given`, if that is why its run failed.
    pub fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        if let Some(stiffness) = self.stiffness() {
            return Some(given.refused(vec![Problem::of_stiffness(&given.text, stiffness)]));
        }
        if let RunError::TeethInSpace(error) = self {
            return Some(given.refused(vec![Problem::of_teeth_in_space(&given.text, error)]));
        }
        self.model().and_then(|model| of_model(model, given))
    }
}

impl CalibrateError {
    /// What is wrong with the scene in the text `given`, if that is why there is no calibration of it.
    pub fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        match self {
            CalibrateError::Calibration(CalibrationError::Model(model)) => of_model(model, given),
            _ => None,
        }
    }
}

impl FemPairError {
    /// What is wrong with the scene in the text `given`, if that is why its pair cannot be solved.
    pub fn in_the_scene(&self, given: &SceneText) -> Option<SceneError> {
        match self {
            FemPairError::Model(model) => of_model(model, given),
            _ => None,
        }
    }
}

/// A finite-element model that cannot be made, at the key to blame, where it has one.
fn of_model(error: &ModelError, given: &SceneText) -> Option<SceneError> {
    let problem = match error {
        ModelError::TooFewTeeth { teeth, least, .. } => Problem::of_sector_teeth(&given.text, *teeth, *least),
        ModelError::Mesh { gear, source } => Problem::of_tooth_mesh(&given.text, Some(*gear), source),
        ModelError::TooFine { .. } => Problem::of_elements(&given.text, error.to_string()),
        ModelError::Condense { .. } => return None,
    };
    Some(given.refused(vec![problem]))
}
