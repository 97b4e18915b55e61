//! Finite-element models that cannot be made: what the input is to blame for.

use crate::fem::gear::model::ModelError;
use crate::scene::Problem;
use crate::scene::loaded::SceneText;

use super::failure::{Failure, InputError};

/// The failure that `error` is, if the scene is to blame: at its key, where it has one.
pub(super) fn in_the_scene(error: &ModelError, text: &SceneText) -> Option<Failure> {
    match *error {
        ModelError::TooFewTeeth { teeth, least, .. } => {
            Some(text.refused(vec![Problem::of_sector_teeth(&text.text, teeth, least)]).into())
        }
        ModelError::Mesh { .. } | ModelError::TooFine { .. } => Some(InputError::Model(error.clone()).into()),
        ModelError::Condense { .. } => None,
    }
}
