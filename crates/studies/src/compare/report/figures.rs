//! The plots of a comparison: profiles with their form removed, wear depths, and what is left between them, of each gear; and the
//! coefficients of both gears with their correlation.

use std::f64::consts::TAU;

use crate::compare::record::{CompareRecord, CompareRow, FittedValue, ProfileRecord};
use gearwear::report::chart::{Chart, Dash, MUTED, NEW, Trace, WORN, padded};
use gearwear::report::html::number::{figure, fixed, significant};
use gearwear::report::html::reading::greatest;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::path_points::among;

const MEASURED: &str = "var(--wheel)";
const SIMULATED: &str = "var(--pinion)";
/// Points of an ellipse.
const ELLIPSE_POINTS: usize = 120;

/// The plots of each profile.
pub(super) fn of_profiles(record: &CompareRecord) -> Vec<Chart> {
    let charts = record.profiles.iter().flat_map(|of| {
        let shown = ShownProfile { of, is_fitted: record.fit.is_of_wear(), is_alone: record.profiles.len() == 1 };
        [shown.profiles(), shown.depths(), shown.differences()].map(|chart| shown.over_radius(chart))
    });
    charts.collect()
}

/// The coefficients of both gears, where each was fitted: the ellipse whose extents are their intervals.
pub(super) fn coefficients(record: &CompareRecord) -> Option<Chart> {
    let fit = &record.fit;
    let correlation = fit.coefficient_correlation()?;
    let [pinion, wheel] = Gear::BOTH.map(|gear| fit.coefficients.iter().find(|own| own.gear == Some(gear)));
    let (pinion, wheel) = (pinion?.coefficient_m2_per_N, wheel?.coefficient_m2_per_N);
    let ((x, half_x), (y, half_y)) = (logarithm(pinion)?, logarithm(wheel)?);
    let across = (1.0 - correlation * correlation).max(0.0).sqrt();
    let turns = (0..=ELLIPSE_POINTS).map(|i| TAU * i as f64 / ELLIPSE_POINTS as f64);
    let ellipse_x: Vec<f64> = turns.clone().map(|turn| (x + half_x * turn.cos()).exp()).collect();
    let along_y = turns.map(|turn| correlation * turn.cos() + across * turn.sin());
    let ellipse_y: Vec<f64> = along_y.map(|along| (y + half_y * along).exp()).collect();
    let [range_x, range_y] = [(&ellipse_x, pinion), (&ellipse_y, wheel)].map(|(ellipse, estimate)| {
        let [low, high] = extent(ellipse.iter().copied().chain([estimate.of_run]));
        padded(low, high)
    });
    let ratio = fit.coefficient_ratio.as_ref().map_or_else(String::new, |ratio| {
        format!(
            " The coefficient of the pinion is {} times that of the wheel{}.",
            significant(ratio.value, 3),
            interval(ratio)
        )
    });
    let reading = format!(
        "The correlation coefficient is {}; the ellipse reaches as far along each axis as the 95 % interval of that coefficient.{ratio}",
        fixed(correlation, 2)
    );
    let hover = "pinion %{x:.4e}, wheel %{y:.4e} m²/N";
    let fitted = Trace::points("fitted", [pinion.value], [wheel.value], (WORN, "cross", 9));
    let of_run = Trace::points("run", [pinion.of_run], [wheel.of_run], (NEW, "circle", 8));
    let chart = Chart::new("coefficients", "Wear coefficients of pinion and wheel").height(460).read_nearest();
    let chart = chart.x("k of the pinion, m²/N").x_range(range_x).y("k of the wheel, m²/N").y_range(range_y);
    Some(
        chart
            .reading(reading)
            .line("95 %", ellipse_x, ellipse_y, (WORN, 1.4, Dash::Solid), hover)
            .add(fitted.hover(hover))
            .add(of_run.hover(hover)),
    )
}

/// Logarithm, which is what is fitted, and half the width of its interval.
fn logarithm(of: FittedValue) -> Option<(f64, f64)> {
    Some((of.value.ln(), 0.5 * (of.high?.ln() - of.low?.ln())))
}

/// A profile with what its plots need to know of the others.
struct ShownProfile<'a> {
    of: &'a ProfileRecord,
    /// Whether there is another simulated profile beside that of the run as it is.
    is_fitted: bool,
    is_alone: bool,
}

impl ShownProfile<'_> {
    /// A plot that the other profile has too.
    fn chart(&self, id: &str, title: &str) -> Chart {
        let gear = self.of.gear.name();
        match self.is_alone {
            true => Chart::new(id, title),
            false => Chart::new(format!("{id}-{gear}"), format!("{title}: {gear}")),
        }
    }

    fn column(&self, value: fn(&CompareRow) -> f64) -> Vec<f64> {
        self.of.rows.iter().map(value).collect()
    }

    fn simulated_name(&self) -> &'static str {
        if self.is_fitted { "simulated, fitted" } else { "simulated" }
    }

    fn over_radius(&self, chart: Chart) -> Chart {
        let [low, high] = extent(self.of.rows.iter().map(|row| row.radius_mm));
        let radius = format!("radius on the {}, mm", self.of.gear.name());
        let chart = chart.x(&radius).x_range(padded(low, high)).x_format(".3f");
        chart.mark_path_points(&self.of.path_point_radius_mm)
    }

    fn curve(&self, chart: Chart, name: &str, y: Vec<f64>, stroke: (&str, f64, Dash)) -> Chart {
        chart.line(name, self.of.rows.iter().map(|row| row.radius_mm), y, stroke, "%{y:.3f} µm")
    }

    fn profiles(&self) -> Chart {
        let (title, height) = match self.of.form.as_str() {
            "none" => ("Measured and simulated profile", "height, µm"),
            _ => ("Measured and simulated profile, form removed", "height, form removed, µm"),
        };
        let form = match self.of.form.as_str() {
            "cubic" => "The least-squares cubic is taken from both, and with it a part of the wear.",
            "involute" => "Offset and tilt against the nominal involute are taken from both.",
            _ => "Nothing is taken from either.",
        };
        let f = &self.of.figures;
        let before = match self.is_fitted {
            true => format!("{} µm as run and ", figure(f.as_run_difference_um)),
            false => String::new(),
        };
        let chart = self.chart("profiles", title).wide().height(520).y(height).reading(format!(
            "{form} Their arithmetic mean deviations are {} µm measured and {} µm simulated; they differ by {before}{} µm (root \
             mean square){}.",
            figure(f.mean_deviation_um),
            figure(f.simulated_mean_deviation_um),
            figure(f.difference_um),
            if before.is_empty() { "" } else { " fitted" },
        ));
        let measured = self.column(|row| row.measured_um);
        let mut chart = self.curve(chart, "measured", measured, (MEASURED, 1.4, Dash::Solid));
        if self.is_fitted {
            let as_run = self.column(|row| row.as_run_um);
            chart = self.curve(chart, "simulated, as run", as_run, (NEW, 1.8, Dash::Dashed));
        }
        let simulated = self.column(|row| row.simulated_um);
        self.curve(chart, self.simulated_name(), simulated, (SIMULATED, 2.4, Dash::Solid))
    }

    fn depths(&self) -> Chart {
        let measured = self.column(|row| row.measured_wear_um);
        let simulated = self.column(|row| row.wear_um);
        let [highest, deepest] = extent(measured.iter().chain(&simulated).copied().chain([0.0]));
        let margin = 0.04 * (deepest - highest);
        let at = greatest(&simulated);
        let places = self.of.path_point_radius_mm.named();
        let stands = match self.of.form.as_str() {
            "none" => "",
            _ => {
                " The measured profile is aligned with the simulated one by the form removed: only its shape is measured, not its level."
            }
        };
        let reading = at.map_or_else(String::new, |at| {
            let radius = self.of.rows[at.index].radius_mm;
            format!(
                "The maximum simulated wear within the measured range is {} µm at {} mm, {}.{stands}",
                figure(at.value),
                significant(radius, 4),
                among(&places, radius)
            )
        });
        // Depths grow downwards.
        let chart = self.chart("depths", "Wear depth").height(460).y("wear depth, µm").reading(reading);
        let chart = chart.y_range([deepest + margin, highest - margin]);
        let chart = self.curve(chart, "measured", measured, (MEASURED, 1.4, Dash::Solid));
        self.curve(chart, self.simulated_name(), simulated, (SIMULATED, 2.4, Dash::Solid))
    }

    fn differences(&self) -> Chart {
        let f = &self.of.figures;
        let places = self.of.path_point_radius_mm.named();
        let count = match self.of.effective_points {
            Some(effective) => format!(
                " By the autocorrelation of the differences {} of {} points count.",
                significant(effective, 3),
                self.of.points
            ),
            None => String::new(),
        };
        let mut chart = self
            .chart("differences", "Residuals: measured less simulated")
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
                let radius = self.of.rows.iter().map(|row| row.radius_mm);
                let level = Trace::line(name, radius, self.of.rows.iter().map(|_| value), (MUTED, 1.0, Dash::Dashed));
                chart = chart.add(level.listed(!name.is_empty()).hover("%{y:.3f} µm"));
            }
        }
        let differences = self.column(|row| row.difference_um);
        self.curve(chart, "measured less simulated", differences, (WORN, 1.4, Dash::Solid))
    }
}

/// ", 95 % interval … to …".
pub(super) fn interval(estimate: &FittedValue) -> String {
    match (estimate.low, estimate.high) {
        (Some(low), Some(high)) => {
            format!(", 95 % interval {} to {}", significant(low, 3), significant(high, 3))
        }
        _ => ", without an interval".to_owned(),
    }
}
