//! The part of a flank that plots show.

use crate::report::chart::{Chart, padded};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::run::{FlankRecord, PathPoints, RunRecord};

/// Pressure over the flank pressure, which is a mean over a short length, from which a contact is at a tip edge.
const EDGE_OVER_FLANK: f64 = 1.1;

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

    /// Number of the first point on the rounding of the tip edge; that behind the last where there is none.
    pub fn rounding_from(flank: &FlankRecord) -> usize {
        // Of an internal gear radii fall, and those of zones are negative.
        let edge_mm = flank.zones.tip_end_radius_mm.abs();
        let on_flank = |&radius_mm: &f64| if flank.is_internal() { radius_mm >= edge_mm } else { radius_mm <= edge_mm };
        flank.radius_mm.partition_point(on_flank)
    }

    /// Radii up to which the tip edges of the gear itself and of its mate touch a flank: those of the tip-edge zones, and farther where the
    /// pressure is above that between these zones, which is then that of a contact that reaches an edge.
    pub fn tip_edges_mm(record: &RunRecord, gear: Gear) -> [f64; 2] {
        let (flank, summary) = (&record.flanks[gear], &record.summary);
        let base_mm = |gear: Gear| record.drawing.circles_mm[gear].base;
        let zone_mm = |gear: Gear| record.flanks[gear].zones.tip_edge_radius_mm.abs();
        let mate = gear.mate();
        // Radii of curvature of both flanks add up to the line of action; of an internal gear they are negative.
        let of_mate_mm = base_mm(mate).signum() * (zone_mm(mate).powi(2) - base_mm(mate).powi(2)).max(0.0).sqrt();
        let own_mm = (summary.geometry.line_of_action_mm - of_mate_mm).hypot(base_mm(gear));
        let pitch_mm = flank.path_point_radius_mm.C;
        let of_edges = |pressures: &[f64], flank_pressure: f64| -> Vec<f64> {
            let points = flank.radius_mm.iter().cycle().zip(pressures);
            points
                .filter(|(_, pressure)| **pressure > EDGE_OVER_FLANK * flank_pressure)
                .map(|(radius_mm, _)| *radius_mm)
                .collect()
        };
        let mut radii_mm = of_edges(&flank.pressure_new_MPa, summary.new.flank_pressure_MPa);
        radii_mm.extend(of_edges(&flank.pressure_worn_MPa, summary.worn.flank_pressure_MPa));
        [zone_mm(gear), own_mm].map(|edge_mm| {
            let same_side = radii_mm.iter().filter(|radius_mm| (**radius_mm - pitch_mm) * (edge_mm - pitch_mm) > 0.0);
            same_side.fold(edge_mm, |nearest, &radius_mm| {
                match (radius_mm - pitch_mm).abs() < (nearest - pitch_mm).abs() {
                    true => radius_mm,
                    false => nearest,
                }
            })
        })
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
