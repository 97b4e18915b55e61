//! Plot of wear against time.

use plotly::Plot;
use plotly::common::{DashType, Marker, Mode};

use super::number::{figure, significant};
use super::reading::duration;
use super::theme::{Figure, axis, curve, from_zero, gear_colour, layout, line};
use crate::gear::Gear;
use crate::simulation::record::{HistoryRow, RunRecord};

/// One line of the plot.
struct Series {
    name: &'static str,
    gear: Gear,
    dash: DashType,
    width_px: f64,
    value: fn(&HistoryRow) -> f64,
}

const SERIES: [Series; 3] = [
    Series {
        name: "pinion, greatest over the root",
        gear: Gear::Pinion,
        dash: DashType::Solid,
        width_px: 2.4,
        value: |row| row.pinion_root_wear_um,
    },
    Series {
        name: "pinion, greatest anywhere",
        gear: Gear::Pinion,
        dash: DashType::Dot,
        width_px: 2.0,
        value: |row| row.pinion_peak_wear_um,
    },
    Series {
        name: "wheel, greatest anywhere",
        gear: Gear::Wheel,
        dash: DashType::Solid,
        width_px: 2.0,
        value: |row| row.wheel_peak_wear_um,
    },
];

/// Greatest root wear, and peak wear of both gears, against time.
pub fn wear_against_time(record: &RunRecord) -> Figure {
    let rows = &record.history;
    let hours: Option<Vec<f64>> = rows.iter().map(|row| row.hours).collect();
    let (time, title, hover) = match hours {
        Some(hours) => (hours, "running time, h", "%{y:.3f} µm"),
        None => (rows.iter().map(|row| row.revolutions).collect(), "pinion revolutions", "%{y:.3f} µm"),
    };
    let mut plot = Plot::new();
    for Series { name, gear, dash, width_px, value } in SERIES {
        let x = std::iter::once(0.0).chain(time.iter().copied());
        let y = std::iter::once(0.0).chain(rows.iter().map(value));
        plot.add_trace(
            curve(name, x, y, line(gear_colour(gear), width_px, dash))
                .mode(Mode::LinesMarkers)
                .marker(Marker::new().color(gear_colour(gear)).size(5))
                .hover_template(hover),
        );
    }
    let deepest = rows.iter().flat_map(|row| SERIES.map(|s| (s.value)(row))).fold(0.0, f64::max);
    let last = time.last().copied().unwrap_or(0.0);
    plot.set_layout(
        layout(380)
            .show_legend(true)
            .x_axis(axis(title).range(from_zero(last).to_vec()))
            .y_axis(axis("wear depth, µm").range(from_zero(deepest).to_vec())),
    );
    Figure {
        id: "history".into(),
        title: "Greatest root wear against time".into(),
        reading: reading(record),
        plot,
        wide: false,
    }
}

fn reading(record: &RunRecord) -> String {
    let Some(last) = record.history.last() else {
        return "No snapshot was reached, so there is no history to show.".into();
    };
    let before = record.history.len().checked_sub(2).and_then(|i| record.history.get(i));
    let (turns, wear) = before.map_or((0.0, 0.0), |row| (row.revolutions, row.pinion_root_wear_um));
    let rate = (last.pinion_root_wear_um - wear) / (last.revolutions - turns) * 1e6;
    let mean = last.pinion_root_wear_um / last.revolutions * 1e6;
    format!(
        "The pinion’s root has worn {} µm after {}: {} µm per million revolutions on the whole, {} since the snapshot before.",
        figure(last.pinion_root_wear_um),
        duration(&record.summary),
        significant(mean, 3),
        significant(rate, 3),
    )
}
