//! Plots over the mesh cycle of the reference pair, from A to E: load sharing, transmission error, pressure.

use super::number::{change, figure, percent, significant};
use super::reading::{Extreme, defined_pressures, greatest, tip_edge_note};
use super::{mesh_orders, torque_curve_plot};
use crate::report::chart::Chart;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::path_points::among;
use gearwear_physics::results::run::{MeshCycleRow, RunRecord};

/// A pair that carries at least this share of the load counts as carrying it alone.
pub(super) const ALONE: f64 = 0.9995;

pub(super) fn all(record: &RunRecord) -> Vec<Chart> {
    let mut charts = vec![load_sharing(record), transmission_error(record)];
    charts.extend(mesh_orders::new_and_worn(&record.summary));
    charts.extend(torque_curve_plot::all(record));
    charts.extend(mesh_stiffness(record));
    charts.push(pressure(record));
    charts
}

fn load_sharing(record: &RunRecord) -> Chart {
    let rows = &record.mesh_cycle;
    let reading = match (rows.first(), alone(rows, |r| r.load_share_new), alone(rows, |r| r.load_share_worn)) {
        (None, ..) => NOT_COMPUTED.into(),
        (Some(first), new, worn) => format!(
            "At A the entering pair takes {} of the load new and {} worn; it carries all of it {} new and {} worn.",
            percent(first.load_share_new),
            percent(first.load_share_worn),
            stretch(new),
            stretch(worn),
        ),
    };
    let chart = Chart::new("load-sharing", "Load sharing").y("share of the load").y_up_to(1.0).reading(reading);
    over_cycle(record, chart, [|r| r.load_share_new, |r| r.load_share_worn], "%{y:.3f}")
}

pub(super) fn transmission_error(record: &RunRecord) -> Chart {
    let (new, worn) = (&record.summary.new.transmission_error_um, &record.summary.worn.transmission_error_um);
    let reading = if record.mesh_cycle.is_empty() {
        NOT_COMPUTED.into()
    } else {
        format!(
            "Over the cycle the wheel lags {} to {} µm along the line of action new and {} to {} µm worn: peak to peak \
             {} and {} µm.",
            figure(new.min),
            figure(new.max),
            figure(worn.min),
            figure(worn.max),
            figure(new.peak_to_peak),
            figure(worn.peak_to_peak),
        )
    };
    let chart =
        Chart::new("transmission-error", "Loaded transmission error").y("transmission error, µm").reading(reading);
    over_cycle(record, chart, [|r| r.transmission_error_new_um, |r| r.transmission_error_worn_um], "%{y:.3f} µm")
}

/// None where the model does not give it.
pub(super) fn mesh_stiffness(record: &RunRecord) -> Option<Chart> {
    let rows = &record.mesh_cycle;
    let column = |value: fn(&MeshCycleRow) -> Option<f64>| rows.iter().map(value).collect::<Option<Vec<f64>>>();
    let new = extent(column(|r| r.mesh_stiffness_new_N_per_mm_um)?);
    let worn = extent(column(|r| r.mesh_stiffness_worn_N_per_mm_um)?);
    let range = |[low, high]: [f64; 2]| format!("{} to {}", figure(low), figure(high));
    let reading = match rows.is_empty() {
        true => NOT_COMPUTED.into(),
        false => format!(
            "About the load of the run, all pairs in contact together resist with {} N/(mm·µm) new and {} N/(mm·µm) worn.",
            range(new),
            range(worn)
        ),
    };
    let chart = Chart::new("mesh-stiffness", "Mesh stiffness").y("mesh stiffness, N/(mm·µm)");
    let chart = chart.y_up_to(new[1].max(worn[1]).max(0.0)).reading(reading);
    let stiffness: [fn(&MeshCycleRow) -> f64; 2] = [
        |r| r.mesh_stiffness_new_N_per_mm_um.unwrap_or_default(),
        |r| r.mesh_stiffness_worn_N_per_mm_um.unwrap_or_default(),
    ];
    Some(over_cycle(record, chart, stiffness, "%{y:.2f} N/(mm·µm)"))
}

fn pressure(record: &RunRecord) -> Chart {
    let rows = &record.mesh_cycle;
    let column = |value: fn(&MeshCycleRow) -> (f64, bool)| greatest(&defined_pressures(rows, value));
    let place = |at: Extreme| {
        let position = rows[at.index].position_mm;
        let points = record.summary.geometry.curvature_radius_mm.named();
        format!("at {} mm, {}", significant(position, 4), among(&points, position))
    };
    let reading = match (
        column(|r| (r.peak_pressure_new_MPa, r.at_sharp_edge_new)),
        column(|r| (r.peak_pressure_worn_MPa, r.at_sharp_edge_worn)),
    ) {
        (Some(new), Some(worn)) => format!(
            "New, the maximum is {} MPa {}; worn, {} MPa {} ({}).{}{}",
            figure(new.value),
            place(new),
            figure(worn.value),
            place(worn),
            change(new.value, worn.value),
            outside(record, new.value),
            tip_edge_note(&record.summary.geometry.curvature_radius_mm.named(), rows[worn.index].position_mm),
        ),
        _ => NOT_COMPUTED.into(),
    };
    let top = rows.iter().flat_map(|r| [r.peak_pressure_new_MPa, r.peak_pressure_worn_MPa]).fold(0.0, f64::max);
    let chart = Chart::new("cycle-pressure", "Maximum pressure over the cycle").y("maximum pressure, MPa").y_up_to(top);
    over_cycle(
        record,
        chart.reading(reading),
        [|r| r.peak_pressure_new_MPa, |r| r.peak_pressure_worn_MPa],
        "%{y:.1f} MPa",
    )
}

/// What to say where the new pair has its maximum pressure before A or after E, which this plot does not show.
fn outside(record: &RunRecord, on_path_mpa: f64) -> String {
    let anywhere = record.summary.new.peak_pressure_MPa;
    if anywhere <= 1.01 * on_path_mpa {
        return String::new();
    }
    format!(" Outside A–E, where a tip edge is in contact, it is up to {} MPa new.", figure(anywhere))
}

/// What to say of a run without a mesh cycle.
pub(super) const NOT_COMPUTED: &str = "The run ended before a mesh cycle was evaluated.";

/// A quantity new and worn over the cycle.
fn over_cycle(record: &RunRecord, chart: Chart, [new, worn]: [fn(&MeshCycleRow) -> f64; 2], hover: &str) -> Chart {
    let column = |value: fn(&MeshCycleRow) -> f64| record.mesh_cycle.iter().map(value).collect::<Vec<f64>>();
    let chart = chart.new_and_worn(&column(|row| row.position_mm), column(new), column(worn), hover);
    chart.over_path(&record.summary.geometry.curvature_radius_mm)
}

/// First and last position where the pair carries the whole load.
fn alone(rows: &[MeshCycleRow], share: fn(&MeshCycleRow) -> f64) -> Option<[f64; 2]> {
    let mut carrying = rows.iter().filter(|r| share(r) >= ALONE).map(|r| r.position_mm);
    let first = carrying.next()?;
    Some([first, carrying.next_back().unwrap_or(first)])
}

fn stretch(alone: Option<[f64; 2]>) -> String {
    match alone {
        Some([from, to]) => format!("from {} to {} mm", significant(from, 4), significant(to, 4)),
        None => "nowhere".into(),
    }
}
