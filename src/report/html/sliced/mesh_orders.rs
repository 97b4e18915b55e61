//! The first mesh orders of the loaded transmission error, new and worn.

use super::sliced_run::SlicedRun;
use crate::report::chart::{BarPlaces, Chart, NEW, Trace, WORN};
use crate::report::html::number::{change, figure, plotted};

pub(super) fn new_and_worn(run: SlicedRun<'_>) -> Chart {
    let orders = [&run.helical.mesh_orders_new_um, &run.helical.mesh_orders_worn_um];
    let bars = [("new", NEW), ("worn", WORN)].into_iter().zip(orders).map(|((name, colour), amplitudes)| {
        let names: Vec<String> = (1..=amplitudes.len()).map(|order| format!("{order}×")).collect();
        let heights: Vec<f64> = amplitudes.iter().map(|&um| plotted(um)).collect();
        Trace::bars(name, BarPlaces::Named(names), heights, colour).hover("%{y:.4~g} µm")
    });
    let reading = match (orders[0].first(), orders[1].first()) {
        (Some(new), Some(worn)) => format!(
            "The tooth-mesh frequency itself has an amplitude of {} µm new and {} µm worn ({}); the transmission error as a whole varies by \
             {} and {} µm peak to peak.",
            figure(*new),
            figure(*worn),
            change(*new, *worn),
            figure(run.record.summary.new.transmission_error_um.peak_to_peak),
            figure(run.record.summary.worn.transmission_error_um.peak_to_peak),
        ),
        _ => "No mesh order was computed.".into(),
    };
    Chart::new("mesh-orders", "Mesh orders of the transmission error")
        .x("multiple of the tooth-mesh frequency")
        .y("amplitude, µm")
        .add_all(bars)
        .reading(reading)
}
