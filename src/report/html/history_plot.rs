//! Plot of wear against time.

use super::number::{figure, significant};
use super::reading::duration;
use crate::report::chart::{Chart, Dash, Trace, from_zero, gear_colour};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::{HistoryRow, PhaseSummary, RunRecord};

/// Phases whose ends are marked at the most: more would hide the curves.
const MOST_MARKED: usize = 20;

type Value = fn(&HistoryRow) -> f64;

/// Name, gear, whether it is a line through dots (otherwise rings, which show also around dots in the same place) and value.
const SERIES: [(&str, Gear, bool, Value); 3] = [
    ("pinion, root zone", Gear::Pinion, true, |row| row.pinion_root_wear_um),
    ("pinion, active profile", Gear::Pinion, false, |row| row.pinion_peak_wear_um),
    ("wheel, active profile", Gear::Wheel, true, |row| row.wheel_peak_wear_um),
];

/// Maximum wear of the root zone, and of the active profile of both gears, against time.
pub(super) fn wear_against_time(record: &RunRecord) -> Chart {
    let rows = &record.history;
    let hours: Option<Vec<f64>> = rows.iter().map(|row| row.hours).collect();
    let in_hours = hours.is_some();
    let (time, title) = match hours {
        Some(hours) => (hours, "running time, h"),
        None => (rows.iter().map(|row| row.revolutions).collect(), "pinion revolutions"),
    };
    let traces = SERIES.map(|(name, gear, joined, value)| {
        let x = std::iter::once(0.0).chain(time.iter().copied());
        let y = std::iter::once(0.0).chain(rows.iter().map(value));
        let colour = gear_colour(gear);
        let trace = match joined {
            true => Trace::line(name, x, y, (colour, 2.2, Dash::Solid)).with_points("circle", 5),
            false => Trace::points(name, x, y, (colour, "circle-open", 10)),
        };
        trace.hover("%{y:.3f} µm")
    });
    let deepest = rows.iter().flat_map(|row| SERIES.map(|(.., value)| value(row))).fold(0.0, f64::max);
    let phases = &record.summary.phases;
    let marked = if (2..=MOST_MARKED).contains(&phases.len()) { ends_of_phases(phases, in_hours) } else { Vec::new() };
    Chart::new("history", "Maximum wear against time")
        .x(title)
        .x_range(from_zero(time.last().copied().unwrap_or(0.0)))
        .y("maximum wear depth, µm")
        .y_up_to(deepest)
        .add_all(traces)
        .mark(marked, "")
        .reading(reading(record))
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
        "The pinion’s root zone has worn {} µm after {}: {} µm per million revolutions on average, {} since the snapshot before.{phases}",
        figure(last.pinion_root_wear_um),
        duration(&record.summary),
        significant(mean, 3),
        significant(rate, 3),
    )
}
