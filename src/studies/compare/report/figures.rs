//! The plots of a comparison: profiles with their form removed, wear depths, and what is left between them.

use crate::reference::statistics::extent;
use crate::report::chart::{Chart, Dash, MUTED, NEW, Trace, WORN, padded};
use crate::report::html::number::{figure, significant};
use crate::report::html::reading::greatest;
use crate::results::path_points::among;
use crate::studies::compare::record::{CompareRecord, CompareRow};

const MEASURED: &str = "var(--wheel)";
const SIMULATED: &str = "var(--pinion)";

pub(super) fn all(record: &CompareRecord) -> Vec<Chart> {
    [profiles(record), depths(record), differences(record)].map(|chart| over_radius(record, chart)).into()
}

fn column(record: &CompareRecord, of: fn(&CompareRow) -> f64) -> Vec<f64> {
    record.rows.iter().map(of).collect()
}

/// Whether there is another simulated profile beside that of the run as it is.
fn is_fitted(record: &CompareRecord) -> bool {
    record.fit.coefficient_factor.is_some() || record.fit.severe_factor.is_some()
}

fn simulated_name(record: &CompareRecord) -> &'static str {
    if is_fitted(record) { "simulated, fitted" } else { "simulated" }
}

fn over_radius(record: &CompareRecord, chart: Chart) -> Chart {
    let [low, high] = extent(record.rows.iter().map(|row| row.radius_mm));
    let chart =
        chart.x(&format!("radius on the {}, mm", record.gear.name())).x_range(padded(low, high)).x_format(".3f");
    chart.mark_path_points(&record.path_point_radius_mm)
}

fn curve(chart: Chart, record: &CompareRecord, name: &str, y: Vec<f64>, stroke: (&str, f64, Dash)) -> Chart {
    chart.line(name, record.rows.iter().map(|row| row.radius_mm), y, stroke, "%{y:.3f} µm")
}

fn profiles(record: &CompareRecord) -> Chart {
    let (title, height) = match record.form.as_str() {
        "none" => ("Measured and simulated profile", "height, µm"),
        _ => ("Measured and simulated profile, form removed", "height, form removed, µm"),
    };
    let form = match record.form.as_str() {
        "cubic" => "The least-squares cubic is taken from both, and with it a part of the wear.",
        "involute" => "Offset and tilt against the nominal involute are taken from both.",
        _ => "Nothing is taken from either.",
    };
    let f = &record.figures;
    let before = match is_fitted(record) {
        true => format!("{} µm as run and ", figure(f.as_run_difference_um)),
        false => String::new(),
    };
    let chart = Chart::new("profiles", title).wide().height(520).y(height).reading(format!(
        "{form} Their arithmetic mean deviations are {} µm measured and {} µm simulated; they differ by {before}{} µm (root \
         mean square){}.",
        figure(f.mean_deviation_um),
        figure(f.simulated_mean_deviation_um),
        figure(f.difference_um),
        if before.is_empty() { "" } else { " fitted" },
    ));
    let measured = column(record, |row| row.measured_um);
    let mut chart = curve(chart, record, "measured", measured, (MEASURED, 1.4, Dash::Solid));
    if is_fitted(record) {
        let as_run = column(record, |row| row.as_run_um);
        chart = curve(chart, record, "simulated, as run", as_run, (NEW, 1.8, Dash::Dashed));
    }
    let simulated = column(record, |row| row.simulated_um);
    curve(chart, record, simulated_name(record), simulated, (SIMULATED, 2.4, Dash::Solid))
}

fn depths(record: &CompareRecord) -> Chart {
    let measured = column(record, |row| row.measured_wear_um);
    let simulated = column(record, |row| row.wear_um);
    let [highest, deepest] = extent(measured.iter().chain(&simulated).copied().chain([0.0]));
    let margin = 0.04 * (deepest - highest);
    let at = greatest(&simulated);
    let places = record.path_point_radius_mm.named();
    let stands = match record.form.as_str() {
        "none" => "",
        _ => {
            " The measured profile is aligned with the simulated one by the form removed: only its shape is measured, not its level."
        }
    };
    let reading = at.map_or_else(String::new, |at| {
        let radius = record.rows[at.index].radius_mm;
        format!(
            "The maximum simulated wear within the measured range is {} µm at {} mm, {}.{stands}",
            figure(at.value),
            significant(radius, 4),
            among(&places, radius)
        )
    });
    // Depths grow downwards.
    let chart = Chart::new("depths", "Wear depth").height(460).y("wear depth, µm").reading(reading);
    let chart = chart.y_range([deepest + margin, highest - margin]);
    let chart = curve(chart, record, "measured", measured, (MEASURED, 1.4, Dash::Solid));
    curve(chart, record, simulated_name(record), simulated, (SIMULATED, 2.4, Dash::Solid))
}

fn differences(record: &CompareRecord) -> Chart {
    let f = &record.figures;
    let places = record.path_point_radius_mm.named();
    let count = match record.fit.effective_points {
        Some(effective) => format!(
            " By the autocorrelation of the differences {} of {} points count.",
            significant(effective, 3),
            record.fit.points
        ),
        None => String::new(),
    };
    let mut chart = Chart::new("differences", "Residuals: measured less simulated")
        .height(460)
        .y("measured less simulated height, µm")
        .reading(format!(
            "The maximum difference is {} µm at {} mm, {}.{count}",
            figure(f.greatest_difference_um),
            significant(f.greatest_difference_radius_mm, 4),
            among(&places, f.greatest_difference_radius_mm)
        ));
    if let Some(uncertainty) = f.uncertainty_um {
        for (name, value) in [("uncertainty of a height", uncertainty), ("", -uncertainty)] {
            let radius = record.rows.iter().map(|row| row.radius_mm);
            let level = Trace::line(name, radius, record.rows.iter().map(|_| value), (MUTED, 1.0, Dash::Dashed));
            chart = chart.add(level.set("showlegend", !name.is_empty()).hover("%{y:.3f} µm"));
        }
    }
    let differences = column(record, |row| row.difference_um);
    curve(chart, record, "measured less simulated", differences, (WORN, 1.4, Dash::Solid))
}
