//! A figure over one varied key: a line, with the value where it is least.

use crate::report::chart::{DashType, HoverMode, Marker, MarkerSymbol, Mode, Plot};

use super::contour_figures::{capitalised, reading};
use super::section_plane::{self, ShownAxis};
use crate::report::html::number::figure as shown_number;
use crate::report::html::theme::{Figure, axis, curve, layout, line};
use crate::studies::sweep::figures::SweepFigure;
use crate::studies::sweep::record::SweepRecord;

/// The plot of `figure` over the key `x`.
pub fn along(record: &SweepRecord, figure: &SweepFigure, x: &ShownAxis<'_>) -> Option<Figure> {
    let (best, least) = record.least(figure)?;
    let points: Vec<(f64, f64)> = x
        .shown
        .iter()
        .filter_map(|&i| {
            let row = section_plane::row(record, best, &[(x, i)])?;
            Some((row.values[x.at], row.figure(figure)?))
        })
        .collect();
    let mut plot = Plot::new();
    plot.add_trace(
        curve(
            figure.title,
            points.iter().map(|p| p.0),
            points.iter().map(|p| p.1),
            line("var(--pinion)", 2.0, DashType::Solid),
        )
        .mode(if points.len() > 40 { Mode::Lines } else { Mode::LinesMarkers })
        .show_legend(false)
        .hover_template(format!("%{{x}}: %{{y:.5~g}} {}<extra></extra>", figure.unit)),
    );
    plot.add_trace(
        curve("least", [best.values[x.at]], [least], line("var(--alert)", 1.0, DashType::Solid))
            .mode(Mode::Markers)
            .marker(Marker::new().color("var(--alert)").symbol(MarkerSymbol::Star).size(14))
            .hover_template(format!("least: {} {}<extra></extra>", shown_number(least), figure.unit)),
    );
    plot.set_layout(
        layout(380)
            .show_legend(true)
            .hover_mode(HoverMode::Closest)
            .x_axis(axis(&x.axis.key))
            .y_axis(axis(&figure.with_unit())),
    );
    Some(Figure {
        id: format!("line-{}", figure.name.to_lowercase().replace('_', "-")),
        title: capitalised(figure.title),
        reading: reading(record, figure, best, &[x]),
        plot,
        wide: false,
    })
}
