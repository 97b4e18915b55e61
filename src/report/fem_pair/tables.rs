//! `mesh_cycle.csv` and `pressure.csv`.

#![allow(non_snake_case, reason = "the contract's column names")]

use std::io::{self, Write};

use serde::Serialize;

use crate::reference::hertz_line::LineContact;
use crate::report::tables::{Column, Provenance, table};
use crate::results::fem_pair::{FemCycleRow, PressureCurve};

/// Columns of `mesh_cycle.csv`; one row per position and tooth pair in contact.
pub const MESH_CYCLE: [Column; 17] = [
    (
        "position_mm",
        "radius of curvature of the pinion's flank at the theoretical contact point of the reference pair, from A to E",
    ),
    ("pair", "tooth pair: 0 the reference pair, 1 the one a base pitch ahead, -1 the one behind"),
    ("line_load_N_per_mm", "the pair's part of the torque over base radius and face width"),
    ("peak_pressure_MPa", "greatest contact pressure of the pair"),
    ("half_width_mm", "half the length of flank under pressure"),
    ("transmission_error_um", "of the gear pair at this position, along the line of action, positive under load"),
    ("load_share", "line load over that of the whole torque"),
    ("hertz_pressure_MPa", "Hertz's greatest pressure of the pair's line load on the unmodified involutes there"),
    ("hertz_half_width_mm", "Hertz's half-width of the same"),
    ("pinion_radius_mm", "radius on the pinion where the resultant of the pressure acts"),
    ("at_sharp_edge", "whether a sharp tip edge carries pressure: the peak then is singular and grows with refinement"),
    (
        "pinion_root_tension_MPa",
        "greatest principal stress at the pinion's fillet below the working flank, reference pair, at this position",
    ),
    ("pinion_root_compression_MPa", "least principal stress at the pinion's other fillet"),
    ("wheel_root_tension_MPa", "greatest principal stress at the wheel's fillet below the working flank"),
    ("wheel_root_compression_MPa", "least principal stress at the wheel's other fillet"),
    ("torque_ratio", "|T2/T1| at this position"),
    ("iterations", "active sets tried at this position"),
];

/// Columns of `pressure.csv`; one row per node of the flank with the multipliers around each contact, towards the pinion's tip.
pub const PRESSURE: [Column; 6] = [
    ("position_mm", "of the reference pair"),
    ("pair", "tooth pair: 0 the reference pair, 1 the one a base pitch ahead, -1 the one behind"),
    ("along_mm", "distance from the resultant of the pressure along the flank, towards the pinion's tip"),
    ("pressure_MPa", "contact pressure"),
    ("hertz_pressure_MPa", "Hertz's pressure of the pair's line load at this distance from its middle"),
    ("point", "A to E, where the position is one of them"),
];

#[derive(Serialize)]
struct PressureRow {
    position_mm: f64,
    pair: i32,
    along_mm: f64,
    pressure_MPa: f64,
    hertz_pressure_MPa: f64,
    point: Option<&'static str>,
}

/// Writes `mesh_cycle.csv`.
pub fn mesh_cycle(out: &mut dyn Write, provenance: Provenance, rows: &[FemCycleRow]) -> io::Result<()> {
    table(out, provenance, &MESH_CYCLE, rows)
}

/// Writes `pressure.csv`.
pub fn pressure(out: &mut dyn Write, provenance: Provenance, curves: &[PressureCurve]) -> io::Result<()> {
    let rows = curves.iter().flat_map(|curve| {
        let hertz = hertz(curve);
        curve.along_mm.iter().zip(&curve.pressure_MPa).map(move |(&along_mm, &pressure_mpa)| PressureRow {
            position_mm: curve.row.position_mm,
            pair: curve.row.pair,
            along_mm,
            pressure_MPa: pressure_mpa,
            hertz_pressure_MPa: hertz.pressure_mpa(along_mm),
            point: curve.point,
        })
    });
    table(out, provenance, &PRESSURE, rows)
}

/// Hertz's contact under the load of a curve.
pub(super) fn hertz(curve: &PressureCurve) -> LineContact {
    LineContact { half_width_mm: curve.row.hertz_half_width_mm, peak_pressure_mpa: curve.row.hertz_pressure_MPa }
}
