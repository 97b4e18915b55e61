//! `pressure.csv`: pressure along the flank beside Hertz's.

#![allow(non_snake_case, reason = "the contract's column names")]

use schemars::JsonSchema;
use serde::Serialize;

use gearwear_bodies::reference::hertz_line::LineContact;
use gearwear_physics::results::fem_pair::PressureCurve;

/// A node of the flank with the multipliers around a contact; rows run towards the pinion's tip.
#[derive(Serialize, JsonSchema)]
struct PressureRow<'a> {
    /// of the reference pair
    position_mm: f64,
    /// tooth pair: 0 the reference pair, 1 the one a base pitch ahead, -1 the one behind
    pair: i32,
    /// distance from the resultant of the pressure along the flank, towards the pinion's tip
    along_mm: f64,
    /// contact pressure
    pressure_MPa: f64,
    /// Hertz's pressure of the pair's line load at this distance from its middle
    hertz_pressure_MPa: f64,
    /// A to E, where the position is one of them
    point: Option<&'a str>,
}

/// Its rows.
pub fn rows(curves: &[PressureCurve]) -> impl Iterator<Item = impl Serialize + JsonSchema> {
    curves.iter().flat_map(|curve| {
        let hertz = hertz(curve);
        curve.along_mm.iter().zip(&curve.pressure_MPa).map(move |(&along_mm, &pressure_mpa)| PressureRow {
            position_mm: curve.row.position_mm,
            pair: curve.row.pair,
            along_mm,
            pressure_MPa: pressure_mpa,
            hertz_pressure_MPa: hertz.pressure_mpa(along_mm),
            point: curve.point.as_deref(),
        })
    })
}

/// Hertz's contact under the load of a curve.
pub(super) fn hertz(curve: &PressureCurve) -> LineContact {
    LineContact { half_width_mm: curve.row.hertz_half_width_mm, peak_pressure_mpa: curve.row.hertz_pressure_MPa }
}
