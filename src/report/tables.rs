//! `pinion.csv`, `wheel.csv` and `profiles.csv`: wear and pressure over both flanks, point by point.

use schemars::JsonSchema;
use serde::Serialize;

use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::{FlankRecord, RunRecord};

/// A point of a flank; rows run from the base circle to the tip circle, slice after slice.
#[allow(non_snake_case, reason = "the contract's column names")]
#[derive(Serialize, JsonSchema)]
struct FlankRow {
    /// distance from the gear's axis, new
    radius_mm: f64,
    /// roll angle of the transverse involute
    roll_angle_deg: f64,
    /// place over the face width
    width_mm: f64,
    /// material removed by modifications, normal to the flank
    removed_um: f64,
    /// distance the point slides against the other flank during one mesh, new
    sliding_mm_per_mesh: f64,
    /// wear depth at the end of the run, normal to the flank
    wear_um: f64,
    /// greatest pressure during one mesh, new
    pressure_new_MPa: f64,
    /// greatest pressure during one mesh, worn
    pressure_worn_MPa: f64,
    /// index of the flank point, 0 at the base circle
    point: usize,
    /// number of the slice over the face width, 0 at width 0
    slice: usize,
}

/// A point of a flank at a snapshot.
#[derive(Serialize, JsonSchema)]
struct ProfileRow {
    /// running time; empty where the scene gives no speed
    hours: Option<f64>,
    /// pinion or wheel
    gear: Gear,
    /// distance from the gear's axis, new
    radius_mm: f64,
    /// place over the face width
    width_mm: f64,
    /// wear depth, normal to the flank
    wear_um: f64,
    /// of the pinion
    revolutions: f64,
    /// number of the slice over the face width, 0 at width 0
    slice: usize,
    /// number of the phase of the operation, from 1; at the end of one, that one
    phase: usize,
}

/// The rows of a flank.
pub fn flank(flank: &FlankRecord) -> impl Iterator<Item = impl Serialize + JsonSchema> {
    let points = flank.radius_mm.len();
    flank.width_mm.iter().enumerate().flat_map(move |(slice, &width_mm)| {
        (0..points).map(move |point| {
            let place = slice * points + point;
            FlankRow {
                radius_mm: flank.radius_mm[point],
                roll_angle_deg: flank.roll_angle_deg[point],
                width_mm,
                removed_um: flank.removed_um[place],
                sliding_mm_per_mesh: flank.sliding_mm_per_mesh[place],
                wear_um: flank.wear_um[place],
                pressure_new_MPa: flank.pressure_new_MPa[place],
                pressure_worn_MPa: flank.pressure_worn_MPa[place],
                point,
                slice,
            }
        })
    })
}

/// The rows of both flanks at every snapshot.
pub fn profiles(record: &RunRecord) -> impl Iterator<Item = impl Serialize + JsonSchema> {
    record.history.iter().enumerate().flat_map(move |(snapshot, at)| {
        Gear::BOTH.into_iter().flat_map(move |gear| {
            let flank = &record.flanks[gear];
            let slices = flank.snapshot_wear_um[snapshot].chunks_exact(flank.radius_mm.len().max(1));
            flank.width_mm.iter().zip(slices).enumerate().flat_map(move |(slice, (&width_mm, wear_um))| {
                flank.radius_mm.iter().zip(wear_um).map(move |(&radius_mm, &wear_um)| ProfileRow {
                    hours: at.hours,
                    gear,
                    radius_mm,
                    width_mm,
                    wear_um,
                    revolutions: at.revolutions,
                    slice,
                    phase: at.phase,
                })
            })
        })
    })
}
