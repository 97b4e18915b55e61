//! Plot of the transmission error over torque, new and worn, with the torque of the run.

use super::number::{figure, significant};
use crate::report::chart::{Chart, padded};
use gearwear_physics::results::run::RunRecord;
use gearwear_physics::results::torque_curve::TorqueCurveRow;

type Column = fn(&TorqueCurveRow) -> Option<f64>;

/// None where the run has no such curve, or a single torque.
pub(super) fn all(record: &RunRecord) -> Option<Chart> {
    let rows = &record.torque_curve;
    let (first, last) = (rows.first()?.pinion_torque_Nm, rows.last()?.pinion_torque_Nm);
    if rows.len() < 2 {
        return None;
    }
    let columns: [Column; 2] =
        [|row| row.transmission_error_peak_to_peak_new_um, |row| row.transmission_error_peak_to_peak_worn_um];
    let own = record.summary.phases.iter().map(|phase| phase.pinion_torque_Nm).reduce(f64::max);
    let reading = format!("{}{}", least("New", rows, columns[0]), least(" Worn", rows, columns[1]));
    let x: Vec<f64> = rows.iter().map(|row| row.pinion_torque_Nm).collect();
    let [new, worn] = columns.map(|of| rows.iter().map(|row| of(row).unwrap_or(f64::NAN)).collect::<Vec<f64>>());
    let top = new.iter().chain(&worn).copied().fold(0.0, f64::max);
    let chart = Chart::new("transmission-error-over-torque", "Transmission error over torque")
        .x("torque on the pinion, N·m")
        .x_range(padded(first, last))
        .y("transmission error, peak to peak, µm")
        .y_up_to(top)
        .mark(own.map(|torque| ("run", torque)), "run")
        .reading(reading);
    Some(chart.new_and_worn(&x, new, worn, "%{x:.4~g} N·m: %{y:.3f} µm"))
}

/// Where the curve is least; says where that lies at an end of the torques.
fn least(when: &str, rows: &[TorqueCurveRow], of: Column) -> String {
    let known = rows.iter().enumerate().filter_map(|(index, row)| Some((index, row.pinion_torque_Nm, of(row)?)));
    let Some((index, torque, um)) = known.min_by(|a, b| a.2.total_cmp(&b.2)) else { return String::new() };
    let at_end = if index == 0 || index + 1 == rows.len() { ", at the end of these torques" } else { "" };
    format!("{when}, it is least at {} N·m, {} µm{at_end}.", significant(torque, 3), figure(um))
}
