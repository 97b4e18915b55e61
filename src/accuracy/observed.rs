//! The curves of a run that errors are measured on, and how they are brought onto common coordinates.

use crate::gear::{Gear, PerGear};
use crate::simulation::record::{FlankRecord, RunRecord};

/// What errors are measured on.
#[derive(Debug, Clone, PartialEq)]
pub struct Observed {
    /// Both flanks.
    pub flanks: PerGear<ObservedFlank>,
    /// The working cycle.
    pub cycle: ObservedCycle,
}

/// Wear over one flank.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedFlank {
    /// Distance from the gear's axis, increasing.
    pub radius_mm: Vec<f64>,
    /// Arc length of the involute from the base circle.
    pub arc_mm: Vec<f64>,
    /// Wear depth.
    pub wear_um: Vec<f64>,
}

/// The reference pair over the path of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedCycle {
    /// Radius of curvature of the pinion at the theoretical contact point, increasing.
    pub position_mm: Vec<f64>,
    /// Greatest pressure, new.
    pub peak_pressure_mpa: Vec<f64>,
    /// Half-width, new.
    pub half_width_mm: Vec<f64>,
    /// Loaded transmission error, new.
    pub transmission_error_um: Vec<f64>,
    /// Loaded transmission error, worn.
    pub worn_transmission_error_um: Vec<f64>,
}

impl Observed {
    /// The curves of a run.
    pub fn of(record: &RunRecord) -> Self {
        let column = |value: fn(&crate::simulation::record::MeshCycleRow) -> f64| {
            record.mesh_cycle.iter().map(value).collect::<Vec<f64>>()
        };
        Self {
            flanks: PerGear::from_fn(|gear| ObservedFlank::of(&record.flanks[gear])),
            cycle: ObservedCycle {
                position_mm: column(|row| row.position_mm),
                peak_pressure_mpa: column(|row| row.peak_pressure_new_MPa),
                half_width_mm: column(|row| row.half_width_mm),
                transmission_error_um: column(|row| row.transmission_error_new_um),
                worn_transmission_error_um: column(|row| row.transmission_error_worn_um),
            },
        }
    }

    /// The same curves at the coordinates of `other`, linear in between.
    pub fn at_coordinates_of(&self, other: &Self) -> Self {
        let flank = |gear: Gear| {
            let (own, common) = (&self.flanks[gear], &other.flanks[gear]);
            ObservedFlank { wear_um: own.wear_at(&common.radius_mm), ..common.clone() }
        };
        let (own, at) = (&self.cycle, &other.cycle.position_mm);
        let there = |values: &[f64]| interpolated(&own.position_mm, values, at);
        Self {
            flanks: PerGear::from_fn(flank),
            cycle: ObservedCycle {
                position_mm: at.clone(),
                peak_pressure_mpa: there(&own.peak_pressure_mpa),
                half_width_mm: there(&own.half_width_mm),
                transmission_error_um: there(&own.transmission_error_um),
                worn_transmission_error_um: there(&own.worn_transmission_error_um),
            },
        }
    }

    /// self + factor · (fine − coarse), value by value; all three at the same coordinates.
    pub fn corrected(&self, factor: f64, fine: &Self, coarse: &Self) -> Self {
        let corrected = |own: &[f64], fine: &[f64], coarse: &[f64]| -> Vec<f64> {
            own.iter().zip(fine.iter().zip(coarse)).map(|(x, (f, c))| x + factor * (f - c)).collect()
        };
        let of_cycle = |curve: fn(&ObservedCycle) -> &[f64]| {
            corrected(curve(&self.cycle), curve(&fine.cycle), curve(&coarse.cycle))
        };
        Self {
            flanks: PerGear::from_fn(|gear| {
                let wear = |of: &Self| of.flanks[gear].wear_um.clone();
                ObservedFlank {
                    // Wear is never negative, also where a correction would have it so.
                    wear_um: corrected(&wear(self), &wear(fine), &wear(coarse))
                        .into_iter()
                        .map(|depth| depth.max(0.0))
                        .collect(),
                    ..self.flanks[gear].clone()
                }
            }),
            cycle: ObservedCycle {
                position_mm: self.cycle.position_mm.clone(),
                peak_pressure_mpa: of_cycle(|c| &c.peak_pressure_mpa),
                half_width_mm: of_cycle(|c| &c.half_width_mm),
                transmission_error_um: of_cycle(|c| &c.transmission_error_um),
                worn_transmission_error_um: of_cycle(|c| &c.worn_transmission_error_um),
            },
        }
    }
}

impl ObservedFlank {
    fn of(flank: &FlankRecord) -> Self {
        // r = r_b √(1 + φ²) and s = r_b φ²/2 with the roll angle φ.
        let arc = |(radius, roll_deg): (&f64, &f64)| {
            let roll = roll_deg.to_radians();
            0.5 * roll * roll * radius / (1.0 + roll * roll).sqrt()
        };
        Self {
            radius_mm: flank.radius_mm.clone(),
            arc_mm: flank.radius_mm.iter().zip(&flank.roll_angle_deg).map(arc).collect(),
            wear_um: flank.wear_um.clone(),
        }
    }

    /// Depth at other radii.
    pub fn wear_at(&self, radius_mm: &[f64]) -> Vec<f64> {
        interpolated(&self.radius_mm, &self.wear_um, radius_mm)
    }
}

/// Values given at increasing `x`, at other places; beyond the ends the value there, 0 where there is none at all.
pub fn interpolated(x: &[f64], values: &[f64], at: &[f64]) -> Vec<f64> {
    at.iter()
        .map(|&place| match (x.len(), values) {
            (0, _) => 0.0,
            (1, values) => values[0],
            (count, values) => {
                let after = x.partition_point(|&known| known <= place).clamp(1, count - 1);
                let weight = ((place - x[after - 1]) / (x[after] - x[after - 1])).clamp(0.0, 1.0);
                values[after - 1] + weight * (values[after] - values[after - 1])
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line is met exactly between its points, and held beyond them.
    #[test]
    fn ver_interpolation_is_exact_for_straight_lines() {
        let found = interpolated(&[0.0, 1.0, 3.0], &[1.0, 3.0, 7.0], &[-1.0, 0.5, 2.0, 3.0, 9.0]);
        assert_eq!(found, [1.0, 2.0, 5.0, 7.0, 7.0]);
        assert_eq!(interpolated(&[], &[], &[1.0]), [0.0]);
        assert_eq!(interpolated(&[2.0], &[5.0], &[1.0, 3.0]), [5.0, 5.0]);
    }
}
