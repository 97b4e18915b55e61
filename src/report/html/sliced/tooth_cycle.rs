//! The tooth as a whole from the first touch of its first slice to the last of its last: its share of the load, and the greatest
//! pressure anywhere on it.

use super::sliced_run::{SlicedRun, slice_name};
use crate::report::chart::{Chart, padded};
use crate::report::html::cycle_plots::{ALONE, NOT_COMPUTED};
use crate::report::html::number::{change, figure, percent, significant};
use crate::report::html::reading::{Extreme, greatest};

/// What `of` makes of all slices at each position.
fn at_each_position(run: SlicedRun<'_>, field: &[f64], of: fn(&[f64]) -> f64) -> Vec<f64> {
    field.chunks_exact(run.slices.width_mm.len().max(1)).map(of).collect()
}

fn over_mesh(run: SlicedRun<'_>, chart: Chart, [new, worn]: [Vec<f64>; 2], hover: &str) -> Chart {
    let position = &run.slices.position_mm;
    let [first, last] = [position.first(), position.last()].map(|end| end.copied().unwrap_or_default());
    chart
        .x("position of the tooth, mm")
        .x_range(padded(first, last))
        .x_format(".3f")
        .new_and_worn(position, new, worn, hover)
        .mark_path_points(&run.record.summary.geometry.curvature_radius_mm)
}

pub(super) fn load_share(run: SlicedRun<'_>) -> Chart {
    let whole = run.record.summary.contact.line_load_N_per_mm;
    let mean: fn(&[f64]) -> f64 = |slices| slices.iter().sum::<f64>() / slices.len() as f64;
    let shares = [&run.slices.line_load_new_N_per_mm, &run.slices.line_load_worn_N_per_mm]
        .map(|loads| at_each_position(run, loads, mean).into_iter().map(|load| load / whole).collect::<Vec<f64>>());
    let reading = match [most_of_the_load(run, &shares[0]), most_of_the_load(run, &shares[1])] {
        [Some(new), Some(worn)] => format!("New, a tooth carries {new}; worn, {worn}."),
        _ => NOT_COMPUTED.into(),
    };
    let chart = Chart::new("load-sharing", "Load of one tooth over its mesh").y("share of the load").y_up_to(1.0);
    over_mesh(run, chart.reading(reading), shares, "%{y:.3f}")
}

/// "the whole load from 12.7 to 15.3 mm", or how much of it at the most.
fn most_of_the_load(run: SlicedRun<'_>, shares: &[f64]) -> Option<String> {
    let place = |index: usize| significant(run.slices.position_mm[index], 4);
    let most = greatest(shares)?;
    let alone = |share: &f64| *share >= ALONE;
    Some(match (shares.iter().position(alone), shares.iter().rposition(alone)) {
        (Some(first), Some(last)) => format!("the whole load from {} to {} mm", place(first), place(last)),
        _ => format!("at most {} of the load, at {} mm", percent(most.value), place(most.index)),
    })
}

pub(super) fn pressure(run: SlicedRun<'_>) -> Chart {
    let fields = [&run.slices.peak_pressure_new_MPa, &run.slices.peak_pressure_worn_MPa];
    let most: fn(&[f64]) -> f64 = |slices| slices.iter().copied().fold(0.0, f64::max);
    let [new, worn] = fields.map(|field| at_each_position(run, field, most));
    let count = run.slices.width_mm.len().max(1);
    let place = |peak: Extreme| {
        let position = significant(run.slices.position_mm[peak.index / count], 4);
        format!("in {} with the tooth at {position} mm", slice_name(&run.record.flanks.pinion, peak.index % count))
    };
    let reading = match fields.map(|field| greatest(field)) {
        [Some(new), Some(worn)] => format!(
            "New, the pressure peaks {} with {} MPa; worn, {} with {} MPa ({}). Spikes are slices that have just entered or are about to \
             leave.",
            place(new),
            figure(new.value),
            place(worn),
            figure(worn.value),
            change(new.value, worn.value),
        ),
        _ => NOT_COMPUTED.into(),
    };
    let top = new.iter().chain(&worn).copied().fold(0.0, f64::max);
    let chart = Chart::new("cycle-pressure", "Maximum pressure on one tooth over its mesh");
    let chart = chart.y("maximum pressure, MPa").y_up_to(top).reading(reading);
    over_mesh(run, chart, [new, worn], "%{y:.1f} MPa")
}
