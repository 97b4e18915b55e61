//! The points of the path of contact.

use crate::calibration::Calibration;
use crate::results::run::PathPoints;

/// A to E by name.
pub(super) fn path_points(calibration: &Calibration) -> PathPoints {
    let [a, b, c, d, e] = calibration.path_points_mm;
    PathPoints { A: a, B: b, C: c, D: d, E: e }
}
