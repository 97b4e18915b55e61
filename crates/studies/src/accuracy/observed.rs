//! The curves of a run that errors are measured on, and how they are brought onto common coordinates.

use super::over_width::{OverWidth, corrected, depths_at_widths, interpolated, pressure_along_path_mpa};
use gearwear_bodies::gear::PerGear;
use gearwear_bodies::gear::flank_zones::{FlankZone, FlankZones};
use gearwear_bodies::gear::slices::greatest_over_width;
use gearwear_physics::results::run::{FlankRecord, RunRecord};

/// Curves and figures that errors are measured on.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedRun {
    pub flanks: PerGear<ObservedFlank>,
    pub cycle: ObservedCycle,
    /// Over the face width; none where all sections are alike.
    pub over_width: Option<OverWidth>,
}

/// Wear over one flank.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedFlank {
    /// Distance from the gear's axis, increasing.
    pub radius_mm: Vec<f64>,
    /// Arc length of the involute from the base circle.
    pub arc_mm: Vec<f64>,
    /// Place of each slice over the face width: one where all sections are alike.
    pub width_mm: Vec<f64>,
    /// Wear depth, slice after slice.
    pub wear_um: Vec<f64>,
    /// Zones of the flank.
    pub zones: FlankZones,
}

/// The reference pair over the path of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedCycle {
    /// Radius of curvature of the pinion at the theoretical contact point, increasing.
    pub position_mm: Vec<f64>,
    /// Greatest pressure, new; of a pair with slices the greatest of any slice whose own contact point is there.
    pub peak_pressure_mpa: Vec<f64>,
    /// Half-width, new.
    pub half_width_mm: Vec<f64>,
    /// Loaded transmission error, new.
    pub transmission_error_um: Vec<f64>,
    /// Loaded transmission error, worn.
    pub worn_transmission_error_um: Vec<f64>,
}

impl ObservedRun {
    /// The curves of a run.
    pub fn of(record: &RunRecord) -> Self {
        let rows = &record.mesh_cycle;
        let position_mm: Vec<f64> = rows.iter().map(|row| row.position_mm).collect();
        let peak_pressure_mpa = match &record.slices {
            Some(slices) => pressure_along_path_mpa(slices, &position_mm),
            None => rows.iter().map(|row| row.peak_pressure_new_MPa).collect(),
        };
        Self {
            flanks: PerGear::from_fn(|gear| ObservedFlank::of(&record.flanks[gear])),
            over_width: OverWidth::of(record),
            cycle: ObservedCycle {
                position_mm,
                peak_pressure_mpa,
                half_width_mm: rows.iter().map(|row| row.half_width_mm).collect(),
                transmission_error_um: rows.iter().map(|row| row.transmission_error_new_um).collect(),
                worn_transmission_error_um: rows.iter().map(|row| row.transmission_error_worn_um).collect(),
            },
        }
    }

    /// Curves at the coordinates of `other`, linear in between.
    pub fn at_coordinates_of(&self, other: &Self) -> Self {
        let (own, at) = (&self.cycle, &other.cycle.position_mm);
        Self {
            flanks: PerGear::from_fn(|gear| {
                let (own, common) = (&self.flanks[gear], &other.flanks[gear]);
                ObservedFlank { wear_um: own.wear_at(&common.radius_mm, &common.width_mm), ..common.clone() }
            }),
            over_width: self.over_width.as_ref().map(|own| own.at_widths(&other.flanks.pinion.width_mm)),
            cycle: ObservedCycle::of(at.clone(), |curve| interpolated(&own.position_mm, curve(own), at)),
        }
    }

    /// self + factor · (fine − coarse), value by value; all three at the same coordinates.
    pub fn corrected(&self, factor: f64, fine: &Self, coarse: &Self) -> Self {
        Self {
            flanks: PerGear::from_fn(|gear| {
                let [own, fine, coarse] = [self, fine, coarse].map(|of| &of.flanks[gear].wear_um[..]);
                // Wear is never negative, also where a correction would have it so.
                let wear_um = corrected(factor, own, fine, coarse).map(|depth| depth.max(0.0)).collect();
                ObservedFlank { wear_um, ..self.flanks[gear].clone() }
            }),
            over_width: match (&self.over_width, &fine.over_width, &coarse.over_width) {
                (Some(own), Some(fine), Some(coarse)) => Some(own.corrected(factor, fine, coarse)),
                _ => self.over_width.clone(),
            },
            cycle: ObservedCycle::of(self.cycle.position_mm.clone(), |curve| {
                corrected(factor, curve(&self.cycle), curve(&fine.cycle), curve(&coarse.cycle)).collect()
            }),
        }
    }
}

impl ObservedCycle {
    /// Curves that `make` makes, each of those that another cycle has under the same name.
    fn of(position_mm: Vec<f64>, make: impl Fn(fn(&Self) -> &[f64]) -> Vec<f64>) -> Self {
        Self {
            position_mm,
            peak_pressure_mpa: make(|c| &c.peak_pressure_mpa),
            half_width_mm: make(|c| &c.half_width_mm),
            transmission_error_um: make(|c| &c.transmission_error_um),
            worn_transmission_error_um: make(|c| &c.worn_transmission_error_um),
        }
    }
}

impl ObservedFlank {
    fn of(flank: &FlankRecord) -> Self {
        // r = r_b √(1 + φ²) and s = r_b φ²/2 with the roll angle φ.
        let arcs = flank.radius_mm.iter().zip(&flank.roll_angle_deg).map(|(radius, roll_deg)| {
            let roll = roll_deg.to_radians();
            0.5 * roll * roll * radius / (1.0 + roll * roll).sqrt()
        });
        Self {
            radius_mm: flank.radius_mm.clone(),
            arc_mm: arcs.collect(),
            width_mm: flank.width_mm.clone(),
            wear_um: flank.wear_um.clone(),
            zones: flank.zones,
        }
    }

    /// Greatest depth on the active profile, as in the summary of a run.
    pub fn peak_wear_um(&self) -> f64 {
        self.greatest_wear_um(FlankZone::Active)
    }

    /// Greatest depth at the tip edge, as in the summary of a run.
    pub fn tip_edge_wear_um(&self) -> f64 {
        self.greatest_wear_um(FlankZone::TipEdge)
    }

    fn greatest_wear_um(&self, zone: FlankZone) -> f64 {
        let of_slices = self.slices().map(|slice| {
            let points = slice.iter().zip(&self.radius_mm).filter(|(_, radius)| self.zones.at(**radius) == zone);
            points.map(|(depth, _)| *depth).fold(0.0, f64::max)
        });
        greatest_over_width(&of_slices.collect::<Vec<f64>>())
    }

    /// The slices one after the other.
    pub fn slices(&self) -> impl Iterator<Item = &[f64]> {
        self.wear_um.chunks_exact(self.radius_mm.len())
    }

    /// Depth at other radii and widths, slice after slice.
    pub fn wear_at(&self, radius_mm: &[f64], width_mm: &[f64]) -> Vec<f64> {
        let at_radii: Vec<Vec<f64>> =
            self.slices().map(|slice| interpolated(&self.radius_mm, slice, radius_mm)).collect();
        let slices: Vec<&[f64]> = at_radii.iter().map(Vec::as_slice).collect();
        depths_at_widths(&self.width_mm, &slices, width_mm)
    }
}
