//! The user's scene.

use crate::contact::settings::{ContactSettings, Material};
use crate::gear::{PerGear, spec::PairSpec};
use crate::simulation::settings::{Numerics, Operation};
use crate::stiffness::settings::StiffnessSettings;
use crate::wear::settings::WearSettings;

/// A scene with every choice made: what the plan and the pipeline work from.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The user's title.
    pub title: String,
    /// The gear pair as given.
    pub pair: PairSpec,
    /// Material of each gear.
    pub material: PerGear<Material>,
    /// Load, speed, duration.
    pub operation: Operation,
    /// Contact surface.
    pub contact: ContactSettings,
    /// Tooth stiffness.
    pub stiffness: StiffnessSettings,
    /// Wear law.
    pub wear: WearSettings,
    /// Resolution.
    pub numerics: Numerics,
}
