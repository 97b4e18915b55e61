//! The part of a flank that plots show.

use crate::report::chart::{Chart, padded};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::run::{FlankRecord, PathPoints};

/// From a little below the start of active profile up to the tip.
pub struct ActiveFlank {
    /// The first point shown; the last is that at the tip.
    pub first: usize,
    path_point_radius_mm: PathPoints,
}

impl ActiveFlank {
    pub fn of(flank: &FlankRecord) -> Self {
        let [from_mm, to_mm] = Self::ends_mm(&flank.path_point_radius_mm);
        let margin = 0.03 * (to_mm - from_mm);
        let root_mm = if flank.is_internal() { to_mm + margin } else { from_mm - margin };
        let first = flank.first_from(root_mm);
        Self { first, path_point_radius_mm: flank.path_point_radius_mm }
    }

    /// From the lowest to the highest of the points A–E.
    fn ends_mm(points: &PathPoints) -> [f64; 2] {
        extent(points.named().map(|(_, radius)| radius))
    }

    /// Its part of the `values` of one row of points.
    pub fn cut(&self, values: &[f64]) -> Vec<f64> {
        values.get(self.first..).unwrap_or_default().to_vec()
    }

    /// The chart with the radius across, and the points A–E.
    pub fn across(&self, chart: Chart, gear: Gear) -> Chart {
        let [from_mm, to_mm] = Self::ends_mm(&self.path_point_radius_mm);
        let chart =
            chart.x(&format!("radius on the {}, mm", gear.name())).x_range(padded(from_mm, to_mm)).x_format(".3f");
        chart.mark_path_points(&self.path_point_radius_mm)
    }
}
