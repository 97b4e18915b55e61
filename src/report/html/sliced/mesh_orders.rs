//! The first mesh orders of the loaded transmission error, new and worn.

use crate::report::chart::{BarMode, Marker, Plot, Trace};

use super::SlicedRun;
use crate::report::html::number::{change, figure, plotted};
use crate::report::html::theme::{Figure, NEW, WORN, axis, layout};

/// Bars for each order.
pub fn new_and_worn(run: SlicedRun<'_>) -> Figure {
    let orders = [&run.helical.mesh_orders_new_um, &run.helical.mesh_orders_worn_um];
    let mut plot = Plot::new();
    for ((name, colour), amplitudes) in [("new", NEW), ("worn", WORN)].into_iter().zip(orders) {
        let names = (1..=amplitudes.len()).map(|order| format!("{order}×")).collect();
        plot.add_trace(
            Trace::bar(names, amplitudes.iter().map(|&um| plotted(um)).collect())
                .name(name)
                .marker(Marker::new().color(colour))
                .hover_template("%{y:.4~g} µm"),
        );
    }
    plot.set_layout(
        layout(380)
            .show_legend(true)
            .bar_mode(BarMode::Group)
            .x_axis(axis("multiple of the tooth-mesh frequency"))
            .y_axis(axis("amplitude, µm")),
    );
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
    Figure {
        id: "mesh-orders".into(),
        title: "Mesh orders of the transmission error".into(),
        reading,
        plot,
        wide: false,
    }
}
