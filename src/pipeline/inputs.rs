//! What a scene names beside itself: files that are read before the work begins.

use crate::calibration::Calibration;
use crate::stiffness::curve::PairCompliance;

/// The files a scene names, read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Inputs {
    /// `contact.calibration`.
    pub calibration: Option<Calibration>,
    /// `stiffness.curve`.
    pub stiffness_curve: Option<PairCompliance>,
}
