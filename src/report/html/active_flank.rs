//! The part of a flank that plots show.

use crate::report::chart::Axis;
use std::ops::RangeInclusive;

use super::theme::{self, axis, padded};
use crate::gear::Gear;
use crate::results::run::FlankRecord;

/// From a little below the start of active profile up to the tip.
pub struct ActiveFlank {
    /// The first point shown; the last is that at the tip.
    pub first: usize,
    /// From the lowest to the highest of the points A–E.
    pub radius_mm: RangeInclusive<f64>,
}

impl ActiveFlank {
    /// That of `flank`.
    pub fn of(flank: &FlankRecord) -> Self {
        let ends = theme::named(&flank.path_point_radius_mm).map(|(_, radius)| radius);
        let from_mm = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let to_mm = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let margin = 0.03 * (to_mm - from_mm);
        Self { first: flank.radius_mm.partition_point(|&r| r < from_mm - margin), radius_mm: from_mm..=to_mm }
    }

    /// Its part of the `values` of one row of points.
    pub fn cut(&self, values: &[f64]) -> Vec<f64> {
        values.get(self.first..).unwrap_or_default().to_vec()
    }

    /// The axis of the radius.
    pub fn axis(&self, gear: Gear) -> Axis {
        axis(&format!("radius on the {}, mm", gear.name()))
            .range(padded(*self.radius_mm.start(), *self.radius_mm.end()))
            .hover_format(".3f")
    }
}
