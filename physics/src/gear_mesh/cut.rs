//! Nodes on the radial cuts between two sectors: at radii that depend on the gear alone.
//!
//! Elements grow from the root circle inward at a constant rate g from a first length h_0 up to a greatest one; radii
//! are at equal shares of ∫ dr / h(r), h = min(h_0 + g (r_f − r), h_max), so that there is a whole number of elements.

use super::{GREATEST_MODULES, ToothMeshError, ToothShape};
use crate::gear_mesh::settings::greatest_clamp_mm;

/// Rate of growth along the cut.
const GROWTH: f64 = 0.2;
/// Fewest elements along the cut.
const FEWEST: usize = 4;

/// The radii of a cut's nodes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cut {
    /// Ends and middles of elements alternately, from the clamp circle to the root circle.
    pub radius_mm: Vec<f64>,
    /// Length of the element at the clamp circle.
    pub lowest_mm: f64,
}

impl Cut {
    /// The cut of a gear clamped at `clamp_radius_mm`, whose first element is to be about `first_mm` long.
    pub(super) fn new(shape: &ToothShape, clamp_radius_mm: f64, first_mm: f64) -> Result<Self, ToothMeshError> {
        let root_mm = shape.tooth.root_radius_mm;
        let greatest_mm = greatest_clamp_mm(root_mm, shape.normal_module_mm);
        if !(clamp_radius_mm > 0.0 && clamp_radius_mm <= greatest_mm) {
            return Err(ToothMeshError::ClampRadius { clamp_radius_mm, greatest_mm });
        }
        let depth_mm = root_mm - clamp_radius_mm;
        let longest_mm = (GREATEST_MODULES * shape.normal_module_mm).max(first_mm);
        // Elements down to a depth: ln(1 + g d/h_0)/g while they grow, then evenly.
        let grown_mm = (longest_mm - first_mm) / GROWTH;
        let grown = (longest_mm / first_mm).ln() / GROWTH;
        let elements = |depth: f64| {
            if depth <= grown_mm {
                (GROWTH * depth / first_mm).ln_1p() / GROWTH
            } else {
                grown + (depth - grown_mm) / longest_mm
            }
        };
        let depth = |elements: f64| {
            if elements <= grown {
                first_mm * (GROWTH * elements).exp_m1() / GROWTH
            } else {
                grown_mm + (elements - grown) * longest_mm
            }
        };
        let whole = elements(depth_mm);
        let count = (whole.ceil() as usize).max(FEWEST);
        let ends: Vec<f64> =
            (0..=count).map(|k| root_mm - depth_mm.min(depth(whole * (count - k) as f64 / count as f64))).collect();
        let lowest_mm = ends[1] - ends[0];
        let mut radius_mm = Vec::with_capacity(2 * count + 1);
        for k in 0..count {
            radius_mm.extend([ends[k], 0.5 * (ends[k] + ends[k + 1])]);
        }
        radius_mm.push(root_mm);
        radius_mm[0] = clamp_radius_mm;
        Ok(Self { radius_mm, lowest_mm })
    }
}
