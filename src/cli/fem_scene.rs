//! `gearwear fem` of a gear pair.

use super::failure::{Failure, InputError};
use super::scene_source::Text;

/// Refuses the scene: this version has no finite-element pair.
pub fn run(text: &Text) -> Result<(), Failure> {
    Err(InputError::NoFemPair { name: text.name.clone() }.into())
}
