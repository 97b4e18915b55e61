//! Plot of wear against time.

use crate::report::chart::{DashType, Marker, MarkerSymbol, Mode, Plot};

use super::number::{figure, significant};
use super::reading::duration;
use super::theme::{Figure, axis, curve, from_zero, gear_colour, layout, line, mark};
use crate::gear::Gear;
use crate::results::run::{HistoryRow, PhaseSummary, RunRecord};

/// Phases whose ends are marked at the most: more would hide the curves.
const MOST_MARKED: usize = 20;

/// One quantity of the plot.
struct Series {
    name: &'static str,
    gear: Gear,
    /// A line through dots; otherwise rings, which show also around dots in the same place.
    joined: bool,
    value: fn(&HistoryRow) -> f64,
}

const SERIES: [Series; 3] = [
    Series { name: "pinion, over the root", gear: Gear::Pinion, joined: true, value: |row| row.pinion_root_wear_um },
    Series { name: "pinion, active profile", gear: Gear::Pinion, joined: false, value: |row| row.pinion_peak_wear_um },
    Series { name: "wheel, active profile", gear: Gear::Wheel, joined: true, value: |row| row.wheel_peak_wear_um },
];

/// Greatest root wear, and peak wear of both gears, against time.
pub fn wear_against_time(record: &RunRecord) -> Figure {
    let rows = &record.history;
    let hours: Option<Vec<f64>> = rows.iter().map(|row| row.hours).collect();
    let in_hours = hours.is_some();
    let (time, title) = match hours {
        Some(hours) => (hours, "running time, h"),
        None => (rows.iter().map(|row| row.revolutions).collect(), "pinion revolutions"),
    };
    let mut plot = Plot::new();
    for Series { name, gear, joined, value } in SERIES {
        let x = std::iter::once(0.0).chain(time.iter().copied());
        let y = std::iter::once(0.0).chain(rows.iter().map(value));
        let dots = Marker::new().color(gear_colour(gear));
        let trace = curve(name, x, y, line(gear_colour(gear), 2.2, DashType::Solid)).hover_template("%{y:.3f} µm");
        plot.add_trace(if joined {
            trace.mode(Mode::LinesMarkers).marker(dots.size(5))
        } else {
            trace.mode(Mode::Markers).marker(dots.size(10).symbol(MarkerSymbol::CircleOpen))
        });
    }
    let deepest = rows.iter().flat_map(|row| SERIES.map(|s| (s.value)(row))).fold(0.0, f64::max);
    let last = time.last().copied().unwrap_or(0.0);
    let shape = layout(380)
        .show_legend(true)
        .x_axis(axis(title).range(from_zero(last).to_vec()))
        .y_axis(axis("greatest wear depth, µm").range(from_zero(deepest).to_vec()));
    let phases = &record.summary.phases;
    let marked = if (2..=MOST_MARKED).contains(&phases.len()) { ends_of_phases(phases, in_hours) } else { Vec::new() };
    plot.set_layout(mark(shape, marked, ""));
    Figure {
        id: "history".into(),
        title: "Greatest root wear against time".into(),
        reading: reading(record),
        plot,
        wide: false,
    }
}

/// When each phase ends, with its number.
fn ends_of_phases(phases: &[PhaseSummary], in_hours: bool) -> Vec<(String, f64)> {
    let mut end = 0.0;
    let marks = phases.iter().map(|phase| {
        end += if in_hours { phase.hours.unwrap_or(f64::NAN) } else { phase.revolutions };
        (phase.number.to_string(), end)
    });
    marks.collect()
}

fn reading(record: &RunRecord) -> String {
    let Some(last) = record.history.last() else {
        return "No snapshot was reached, so there is no history to show.".into();
    };
    let before = record.history.len().checked_sub(2).and_then(|i| record.history.get(i));
    let (turns, wear) = before.map_or((0.0, 0.0), |row| (row.revolutions, row.pinion_root_wear_um));
    let rate = (last.pinion_root_wear_um - wear) / (last.revolutions - turns) * 1e6;
    let mean = last.pinion_root_wear_um / last.revolutions * 1e6;
    let phases = match record.summary.phases.len() {
        0 | 1 => "",
        _ => " Vertical lines mark where the numbered phases end.",
    };
    format!(
        "The pinion’s root has worn {} µm after {}: {} µm per million revolutions on the whole, {} since the snapshot before.{phases}",
        figure(last.pinion_root_wear_um),
        duration(&record.summary),
        significant(mean, 3),
        significant(rate, 3),
    )
}
