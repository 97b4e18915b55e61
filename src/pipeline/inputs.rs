//! What a scene names beside itself: files that are read before the work begins.

use crate::calibration::{Calibration, identity::Identity};
use crate::gear::GearPair;
use crate::scene::Resolved;
use crate::stiffness::curve::PairCompliance;

/// The files a scene names, read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Inputs {
    /// `contact.calibration`.
    pub calibration: Option<Calibration>,
    /// `stiffness.curve`.
    pub stiffness_curve: Option<PairCompliance>,
}

impl Inputs {
    /// In what the pair of the calibration differs from that of the scene; empty where there is none, or none differs.
    pub fn foreign_to(&self, resolved: &Resolved) -> Vec<String> {
        self.calibration.as_ref().map_or_else(Vec::new, |calibration| foreign(calibration, resolved))
    }
}

/// In what the pair of `calibration` differs from that of the scene. Bodies of finite elements count where the scene says
/// what they are.
pub fn foreign(calibration: &Calibration, resolved: &Resolved) -> Vec<String> {
    match GearPair::new(&resolved.scene.pair) {
        Ok(pair) => {
            let own = Identity::of(&pair, &resolved.scene.material, &resolved.scene.fem);
            calibration.belongs_to.differences(&own, resolved.file.fem.is_some())
        }
        Err(error) => vec![error.to_string()],
    }
}
