//! Nodes on the radial cuts between two sectors: at radii that depend on the gear alone.
//!
//! Elements grow from the root circle inward at a constant rate g from a first length h_0 up to a greatest one; radii
//! are at equal shares of ∫ dr / h(r), h = min(h_0 + g (r_f − r), h_max), so that there is a whole number of elements.

use super::{GREATEST_MODULES, ToothMeshError, ToothShape};
use crate::gear_mesh::settings::greatest_clamp_mm;

/// Rate of growth g along the cut.
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

/// Wanted element lengths below the root circle: h_0, growing to h_max, then constant.
struct Lengths {
    first_mm: f64,
    longest_mm: f64,
}

impl Lengths {
    /// Depth down to which elements grow.
    fn grown_mm(&self) -> f64 {
        (self.longest_mm - self.first_mm) / GROWTH
    }

    /// Number of elements that grow.
    fn grown(&self) -> f64 {
        (self.longest_mm / self.first_mm).ln() / GROWTH
    }

    /// Elements down to a depth: ln(1 + g d/h_0)/g while they grow, then evenly.
    fn elements(&self, depth_mm: f64) -> f64 {
        if depth_mm <= self.grown_mm() {
            (GROWTH * depth_mm / self.first_mm).ln_1p() / GROWTH
        } else {
            self.grown() + (depth_mm - self.grown_mm()) / self.longest_mm
        }
    }

    /// Depth of a number of elements, the inverse.
    fn depth_mm(&self, elements: f64) -> f64 {
        if elements <= self.grown() {
            self.first_mm * (GROWTH * elements).exp_m1() / GROWTH
        } else {
            self.grown_mm() + (elements - self.grown()) * self.longest_mm
        }
    }
}

impl Cut {
    /// Cut of a gear clamped at `clamp_radius_mm`, whose element at the root circle is to be about `first_mm` long.
    pub(super) fn new(shape: &ToothShape, clamp_radius_mm: f64, first_mm: f64) -> Result<Self, ToothMeshError> {
        let root_mm = shape.tooth.root_radius_mm;
        let greatest_mm = greatest_clamp_mm(root_mm, shape.normal_module_mm);
        if !((clamp_radius_mm > 0.0 || shape.tooth.is_internal()) && clamp_radius_mm <= greatest_mm) {
            return Err(ToothMeshError::ClampRadius { clamp_radius_mm, greatest_mm });
        }
        let depth_mm = root_mm - clamp_radius_mm;
        let longest_mm = (GREATEST_MODULES * shape.normal_module_mm).max(first_mm);
        let lengths = Lengths { first_mm, longest_mm };
        let whole = lengths.elements(depth_mm);
        let count = (whole.ceil() as usize).max(FEWEST);
        let ends: Vec<f64> = (0..=count)
            .map(|k| root_mm - depth_mm.min(lengths.depth_mm(whole * (count - k) as f64 / count as f64)))
            .collect();
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
