//! The plots of a comparison: profiles with their form removed, wear depths, and what is left between them.

use crate::report::chart::{Axis, DashType, Layout, Plot};

use crate::report::html::number::{figure, significant};
use crate::report::html::reading::{among, greatest};
use crate::report::html::theme::{
    Figure, MUTED, NEW, WORN, axis, curve, layout, line, mark_path_points, named, padded,
};
use crate::studies::compare::record::{CompareRecord, CompareRow};

const MEASURED: &str = "var(--wheel)";
const SIMULATED: &str = "var(--pinion)";

/// All of them.
pub fn all(record: &CompareRecord) -> Vec<Figure> {
    vec![profiles(record), depths(record), differences(record)]
}

fn column(record: &CompareRecord, of: fn(&CompareRow) -> f64) -> Vec<f64> {
    record.rows.iter().map(of).collect()
}

/// Whether there is another simulated profile beside that of the run as it is.
fn is_fitted(record: &CompareRecord) -> bool {
    record.fit.coefficient_factor.is_some() || record.fit.severe_factor.is_some()
}

/// What the simulated profile is called.
fn simulated_name(record: &CompareRecord) -> &'static str {
    if is_fitted(record) { "simulated, fitted" } else { "simulated" }
}

fn radius_axis(record: &CompareRecord) -> Axis {
    let radius = column(record, |row| row.radius_mm);
    let (low, high) = radius.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &r| (a.min(r), b.max(r)));
    axis(&format!("radius on the {}, mm", record.gear.name())).range(padded(low, high)).hover_format(".3f")
}

fn laid_out(record: &CompareRecord, height_px: usize, y: Axis) -> Layout {
    let layout = layout(height_px).show_legend(true).x_axis(radius_axis(record)).y_axis(y);
    mark_path_points(layout, &record.path_point_radius_mm)
}

/// A curve over the radius.
fn add(plot: &mut Plot, record: &CompareRecord, name: &str, y: Vec<f64>, stroke: (&'static str, f64, DashType)) {
    let (colour, width, dash) = stroke;
    let trace = curve(name, record.rows.iter().map(|row| row.radius_mm), y, line(colour, width, dash));
    plot.add_trace(trace.hover_template("%{y:.3f} µm"));
}

fn profiles(record: &CompareRecord) -> Figure {
    let mut plot = Plot::new();
    add(&mut plot, record, "measured", column(record, |row| row.measured_um), (MEASURED, 1.4, DashType::Solid));
    if is_fitted(record) {
        let as_run = column(record, |row| row.as_run_um);
        add(&mut plot, record, "simulated, as run", as_run, (NEW, 1.8, DashType::Dash));
    }
    let simulated = column(record, |row| row.simulated_um);
    add(&mut plot, record, simulated_name(record), simulated, (SIMULATED, 2.4, DashType::Solid));
    let (title, height) = match record.form.as_str() {
        "none" => ("Measured and simulated profile", "height, µm"),
        _ => ("Measured and simulated profile, form removed", "height, form removed, µm"),
    };
    plot.set_layout(laid_out(record, 520, axis(height)));
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
    Figure {
        id: "profiles".to_owned(),
        title: title.to_owned(),
        reading: format!(
            "{form} Their arithmetic mean deviations are {} µm measured and {} µm simulated; they differ by {before}{} µm (root \
             mean square){}.",
            figure(f.mean_deviation_um),
            figure(f.simulated_mean_deviation_um),
            figure(f.difference_um),
            if before.is_empty() { "" } else { " fitted" },
        ),
        plot,
        wide: true,
    }
}

fn depths(record: &CompareRecord) -> Figure {
    let mut plot = Plot::new();
    let measured = column(record, |row| row.measured_wear_um);
    let simulated = column(record, |row| row.wear_um);
    let deepest = measured.iter().chain(&simulated).copied().fold(0.0, f64::max);
    let highest = measured.iter().chain(&simulated).copied().fold(0.0, f64::min);
    let margin = 0.04 * (deepest - highest);
    let at = greatest(&simulated);
    add(&mut plot, record, "measured", measured, (MEASURED, 1.4, DashType::Solid));
    add(&mut plot, record, simulated_name(record), simulated, (SIMULATED, 2.4, DashType::Solid));
    // Depths grow downwards.
    plot.set_layout(laid_out(record, 460, axis("wear depth, µm").range(vec![deepest + margin, highest - margin])));
    let places = named(&record.path_point_radius_mm);
    let stands = match record.form.as_str() {
        "none" => "",
        _ => {
            " The measured profile stands on it by the form that is left open: only its shape is measured, not its level."
        }
    };
    let reading = at.map_or_else(String::new, |at| {
        let radius = record.rows[at.index].radius_mm;
        format!(
            "The simulation is deepest over the measured stretch with {} µm at {} mm, {}.{stands}",
            figure(at.value),
            significant(radius, 4),
            among(&places, radius)
        )
    });
    Figure { id: "depths".to_owned(), title: "Wear depth".to_owned(), reading, plot, wide: false }
}

fn differences(record: &CompareRecord) -> Figure {
    let mut plot = Plot::new();
    let differences = column(record, |row| row.difference_um);
    let f = &record.figures;
    if let Some(uncertainty) = f.uncertainty_um {
        for (name, value) in [("uncertainty of a height", uncertainty), ("", -uncertainty)] {
            let level = vec![value; record.rows.len()];
            let trace =
                curve(name, record.rows.iter().map(|row| row.radius_mm), level, line(MUTED, 1.0, DashType::Dash));
            plot.add_trace(trace.show_legend(!name.is_empty()).hover_template("%{y:.3f} µm"));
        }
    }
    add(&mut plot, record, "measured less simulated", differences, (WORN, 1.4, DashType::Solid));
    plot.set_layout(laid_out(record, 460, axis("measured less simulated height, µm")));
    let places = named(&record.path_point_radius_mm);
    let count = match record.fit.effective_points {
        Some(effective) => format!(
            " By the autocorrelation of the differences {} of {} points count.",
            significant(effective, 3),
            record.fit.points
        ),
        None => String::new(),
    };
    Figure {
        id: "differences".to_owned(),
        title: "What the simulation leaves unexplained".to_owned(),
        reading: format!(
            "The difference is greatest with {} µm at {} mm, {}.{count}",
            figure(f.greatest_difference_um),
            significant(f.greatest_difference_radius_mm, 4),
            among(&places, f.greatest_difference_radius_mm)
        ),
        plot,
        wide: false,
    }
}
