//! A figure over one varied key: a line, with the value where it is least.

use super::contour_figures::{id, numbered, reading};
use super::section_plane::{self, ShownAxis};
use crate::evaluate::figure::StudyFigure;
use crate::report::chart::{Chart, Dash, Trace};
use crate::report::html::number::figure as shown_number;
use crate::report::html::reading::capitalised;
use crate::sweep::record::{AxisSpacing, SweepRecord};

/// The plot of `figure` over the key `x`.
pub(super) fn along(record: &SweepRecord, figure: &StudyFigure, x: &ShownAxis<'_>) -> Option<Chart> {
    let (best, least) = record.least(figure)?;
    let points: Vec<(f64, f64)> = x
        .shown
        .iter()
        .filter_map(|&i| {
            let row = section_plane::row(record, best, &[(x, i)])?;
            Some((row.values[x.at], row.figure(figure)?))
        })
        .collect();
    let (along, values) = (points.iter().map(|p| p.0), points.iter().map(|p| p.1));
    let line = Trace::line(figure.heading.as_str(), along, values, ("var(--pinion)", 2.0, Dash::Solid)).unlisted();
    let line = if points.len() > 40 { line } else { line.with_points("circle", 6) };
    let least_at = Trace::points("minimum", [best.values[x.at]], [least], ("var(--alert)", "star", 14));
    let chart = Chart::new(id("line", figure), capitalised(&figure.heading))
        .read_nearest()
        .x(&x.axis.title())
        .y(&figure.with_unit())
        .add(line.hover(format!("%{{x}}: %{{y:.5~g}} {}<extra></extra>", figure.unit())))
        .add(least_at.hover(format!("minimum: {} {}<extra></extra>", shown_number(least), figure.unit())))
        .reading(reading(record, figure, best, &[x]));
    let chart = match x.axis.words() {
        Some(words) => chart.x_ticks(numbered(words)),
        None => chart,
    };
    Some(if x.axis.spacing == AxisSpacing::Logarithmic { chart.x_logarithmic() } else { chart })
}
