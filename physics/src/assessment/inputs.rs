//! Inputs of a run.

use super::kept_elements::KeptElements;
use crate::calibration::Calibration;
use crate::mesh_cycle::pair_in_space::KeptInSpace;
use crate::operation::Scene;
use crate::results::provenance::Provenance;
use crate::stiffness::curve::PairCompliance;

/// Inputs of a run: the scene, its calibration and stiffness curve, and the origin that its record quotes.
#[derive(Debug, Clone, Copy)]
pub struct RunInputs<'a> {
    /// Gear pair, operation and choice of models.
    pub scene: &'a Scene,
    /// Finite-element calibration named by the scene.
    pub calibration: Option<&'a Calibration>,
    /// Curve of tooth stiffness named by the scene.
    pub stiffness_curve: Option<&'a PairCompliance>,
    /// Three-dimensional finite elements of the teeth, kept from an earlier run of the same pair.
    pub teeth_in_space: &'a KeptInSpace,
    /// Plane finite elements, kept from an earlier run of the same pair.
    pub elements: &'a KeptElements,
    /// Origin of the scene.
    pub provenance: &'a Provenance,
}
