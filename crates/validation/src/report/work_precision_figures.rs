//! Error against run time of the cases that ask for it: one plot a case, one curve a series, both axes logarithmic.

use super::case_figures::colour_and_symbol;
use super::markup::identifier;
use super::words::time;
use crate::record::{CaseRecord, ValidationRecord, WorkPrecisionPoint};
use gearwear::report::chart::{Chart, Dash, Trace};
use gearwear::report::html::number::{count, percent};

/// Least error shown; smaller ones are drawn here, on the logarithmic axis.
const LEAST_SHOWN: f64 = 1e-12;

/// One figure for each case that has such points.
pub(super) fn all(record: &ValidationRecord) -> Vec<Chart> {
    record.cases.iter().filter(|case| !case.work_precision.is_empty()).map(figure).collect()
}

fn figure(case: &CaseRecord) -> Chart {
    let mut names: Vec<&str> = Vec::new();
    for point in &case.work_precision {
        if !names.contains(&point.series.as_str()) {
            names.push(&point.series);
        }
    }
    let series = names.iter().enumerate().map(|(number, name)| {
        let mut points: Vec<&WorkPrecisionPoint> = case.work_precision.iter().filter(|p| p.series == *name).collect();
        points.sort_by(|a, b| a.wall_s.total_cmp(&b.wall_s));
        let (colour, symbol) = colour_and_symbol(number);
        let x = points.iter().map(|point| point.wall_s);
        let y = points.iter().map(|point| point.error.max(LEAST_SHOWN));
        let line = Trace::line(*name, x, y, (colour, 1.2, Dash::Dot)).with_points(symbol, 9);
        line.hover_texts(points.iter().map(|point| hover(point)).collect())
    });
    Chart::new(format!("work-precision-{}", identifier(&case.name)), &*case.title)
        .height(400)
        .read_nearest()
        .x("wall time, s")
        .x_logarithmic()
        .y("relative error")
        .y_logarithmic()
        .add_all(series)
        .reading(reading(case))
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
