//! What a run works from.

use crate::calibration::Calibration;
use crate::mesh_cycle::pair_in_space::KeptInSpace;
use crate::operation::Scene;
use crate::results::provenance::Provenance;
use crate::stiffness::curve::PairCompliance;

/// What a run works from: the scene, curves that others have found, and what its record says of its origin.
#[derive(Debug, Clone, Copy)]
pub struct RunInputs<'a> {
    /// Pair, operation and models.
    pub scene: &'a Scene,
    /// Calibration by finite elements that the scene asks for; none where it has none.
    pub calibration: Option<&'a Calibration>,
    /// Curve of tooth stiffness that the scene asks for; none where it has none.
    pub stiffness_curve: Option<&'a PairCompliance>,
    /// Three-dimensional teeth that an earlier run of the same pair has condensed.
    pub teeth_in_space: &'a KeptInSpace,
    /// Origin of the scene.
    pub provenance: &'a Provenance,
}
