//! Finite-element models that cannot be made: what the input is to blame for.

use crate::fem::gear::model::ModelError;
use crate::scene::Problem;

use super::failure::{Failure, InputError, SceneProblems};
use super::scene_source::Source;

/// The failure that `error` is, if the scene is to blame: at its key, where it has one.
pub fn in_the_scene(error: &ModelError, source: &Source) -> Option<Failure> {
    match *error {
        ModelError::TooFewTeeth { teeth, least, .. } => Some(Failure::Scene(SceneProblems {
            name: source.name.clone(),
            text: source.text.clone(),
            problems: vec![Problem::of_sector_teeth(&source.text, teeth, least)],
        })),
        ModelError::Mesh { .. } | ModelError::TooFine { .. } => Some(InputError::Model(error.clone()).into()),
        ModelError::Condense { .. } => None,
    }
}
