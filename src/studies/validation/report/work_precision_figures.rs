//! Error against run time of the cases that ask for it: one plot a case, one curve a series, both axes logarithmic.

use crate::report::chart::{AxisType, DashType, ExponentFormat, HoverMode, Marker, Mode, Plot};

use super::case_figures::look;
use super::markup::identifier;
use crate::report::html::number::{count, percent};
use crate::report::html::theme::{Figure, axis, curve, layout, line};
use crate::studies::validation::record::{CaseRecord, ValidationRecord, WorkPrecisionPoint};

use super::words::time;

/// Errors below this are drawn at it: a logarithmic axis knows no zero.
const LEAST_SHOWN: f64 = 1e-12;

/// One figure for each case that has such points.
pub(super) fn all(record: &ValidationRecord) -> Vec<Figure> {
    record.cases.iter().filter(|case| !case.work_precision.is_empty()).map(figure).collect()
}

fn figure(case: &CaseRecord) -> Figure {
    let mut plot = Plot::new();
    let mut names: Vec<&str> = Vec::new();
    for point in &case.work_precision {
        if !names.contains(&point.series.as_str()) {
            names.push(&point.series);
        }
    }
    for (number, name) in names.iter().enumerate() {
        let mut points: Vec<&WorkPrecisionPoint> = case.work_precision.iter().filter(|p| p.series == *name).collect();
        points.sort_by(|a, b| a.wall_s.total_cmp(&b.wall_s));
        let look = look(number);
        let text: Vec<String> = points.iter().map(|point| hover(point)).collect();
        plot.add_trace(
            curve(
                name,
                points.iter().map(|point| point.wall_s),
                points.iter().map(|point| point.error.max(LEAST_SHOWN)),
                line(look.colour, 1.2, DashType::Dot),
            )
            .mode(Mode::LinesMarkers)
            .marker(Marker::new().color(look.colour).symbol(look.symbol).size(9))
            .hover_text_array(text)
            .hover_template("%{hovertext}<extra></extra>"),
        );
    }
    let logarithmic = |title: &str| axis(title).type_(AxisType::Log).exponent_format(ExponentFormat::Power);
    plot.set_layout(
        layout(400)
            .show_legend(true)
            .hover_mode(HoverMode::Closest)
            .x_axis(logarithmic("wall time, s"))
            .y_axis(logarithmic("relative error")),
    );
    Figure {
        id: format!("work-precision-{}", identifier(&case.name)),
        title: case.title.clone(),
        reading: reading(case),
        plot,
        wide: false,
    }
}

fn hover(point: &WorkPrecisionPoint) -> String {
    format!(
        "{}, {}: {} in {}, {} {}",
        point.series,
        point.setting,
        percent(point.error),
        time(point.wall_s),
        count(point.work.max(0.0).round() as u64),
        point.counted
    )
}

fn reading(case: &CaseRecord) -> String {
    let best = case.work_precision.iter().filter(|p| p.error.is_finite()).min_by(|a, b| a.error.total_cmp(&b.error));
    let found = best.map_or_else(String::new, |p| {
        format!(" Least: {} with {}, {}, in {}.", percent(p.error), p.series, p.setting, time(p.wall_s))
    });
    format!("Case {}: down and to the left is better.{found}", case.name)
}
