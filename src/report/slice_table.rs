//! `slices.csv`: what each slice of a tooth carries while the tooth goes through the mesh.

use schemars::JsonSchema;
use serde::Serialize;

use gearwear_physics::results::run::{PathPoints, SliceRecord};

/// Positions are compared with A and E to this part of A–E.
const SAME_PLACE: f64 = 1e-9;

/// A slice at a position of the tooth; rows by position, and there by slice: those whose middle is between A and E, or that are loaded
/// outside, in part of their width or at a tip edge.
#[allow(non_snake_case, reason = "the contract's column names")]
#[derive(Serialize, JsonSchema)]
struct SliceRow {
    /// position of the tooth in the middle of the face width: radius of curvature of the pinion's flank, also before A
    /// and after E
    position_mm: f64,
    /// number of the slice, 0 at width 0
    slice: usize,
    /// place of the slice over the face width: its middle
    width_mm: f64,
    /// position of the slice's own theoretical contact point
    slice_position_mm: f64,
    /// load of the slice per mm of face width, new
    line_load_new_N_per_mm: f64,
    /// the same, worn
    line_load_worn_N_per_mm: f64,
    /// greatest pressure of the slice, new
    peak_pressure_new_MPa: f64,
    /// the same, worn
    peak_pressure_worn_MPa: f64,
    /// whether a sharp tip edge cuts the contact off: its pressure is not defined, new
    at_sharp_edge_new: bool,
    /// the same, worn
    at_sharp_edge_worn: bool,
}

/// Its rows; `path` are the positions of A–E.
pub fn rows(record: &SliceRecord, path: &PathPoints) -> impl Iterator<Item = impl Serialize + JsonSchema> {
    let count = record.width_mm.len();
    let slack = SAME_PLACE * (path.E - path.A);
    let rows = record.position_mm.iter().enumerate().flat_map(move |(position, &position_mm)| {
        (0..count).map(move |slice| {
            let place = position * count + slice;
            SliceRow {
                position_mm,
                slice,
                width_mm: record.width_mm[slice],
                slice_position_mm: position_mm + record.ahead_mm[slice],
                line_load_new_N_per_mm: record.line_load_new_N_per_mm[place],
                line_load_worn_N_per_mm: record.line_load_worn_N_per_mm[place],
                peak_pressure_new_MPa: record.peak_pressure_new_MPa[place],
                peak_pressure_worn_MPa: record.peak_pressure_worn_MPa[place],
                at_sharp_edge_new: record.at_sharp_edge_new[place],
                at_sharp_edge_worn: record.at_sharp_edge_worn[place],
            }
        })
    });
    let reach = path.A - slack..=path.E + slack;
    let in_contact = move |row: &SliceRow| {
        reach.contains(&row.slice_position_mm) || row.line_load_new_N_per_mm > 0.0 || row.line_load_worn_N_per_mm > 0.0
    };
    rows.filter(in_contact)
}
