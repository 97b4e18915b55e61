//! A figure over two varied keys: contours, with the combination where it is least.

use serde_json::json;

use super::best_tables::shown_value;
use super::section_plane::{self, ShownAxis, range};
use crate::report::chart::{Chart, MUTED, Trace, TraceKind, padded};
use crate::report::html::number::{figure as shown_number, plotted};
use crate::report::html::reading::capitalised;
use crate::results::figures::MainFigure;
use crate::studies::sweep::record::{AxisSpacing, SweepRecord, SweepRow};

/// The plot of `figure` over the keys `x` and `y`; further keys stay at the values where the figure is least.
pub(super) fn contour(
    record: &SweepRecord,
    figure: &MainFigure,
    x: &ShownAxis<'_>,
    y: &ShownAxis<'_>,
) -> Option<Chart> {
    let (best, least) = record.least(figure)?;
    let failed: Vec<&SweepRow> =
        rows(record, best, x, y).flatten().flatten().filter(|row| row.error.is_some()).collect();
    let unit = figure.unit();
    let mut chart = Chart::new(id("contour", figure), capitalised(&figure.heading))
        .height(460)
        .read_nearest()
        .x(&x.axis.title())
        .x_range(ends(x))
        .y(&y.axis.title())
        .y_range(ends(y))
        .without_grid()
        .add(contours(record, figure, best, x, y))
        .reading(reading(record, figure, best, &[x, y]));
    if let Some(words) = x.axis.words() {
        chart = chart.x_set("tickvals", places(words)).x_set("ticktext", words.to_vec());
    }
    if let Some(words) = y.axis.words() {
        chart = chart.y_set("tickvals", places(words)).y_set("ticktext", words.to_vec());
    }
    if x.axis.spacing == AxisSpacing::Logarithmic {
        chart = chart.x_logarithmic();
    }
    if y.axis.spacing == AxisSpacing::Logarithmic {
        chart = chart.y_logarithmic();
    }
    if !failed.is_empty() {
        let [along_x, along_y] = [x, y].map(|axis| failed.iter().map(|row| row.values[axis.at]).collect::<Vec<_>>());
        let errors = failed.iter().map(|row| row.error.clone().unwrap_or_default()).collect();
        chart = chart.add(Trace::points("no result", along_x, along_y, (MUTED, "x", 6)).hover_texts(errors));
    }
    let least_at = Trace::points("minimum", [best.values[x.at]], [best.values[y.at]], ("#ff5a36", "star", 15));
    Some(chart.add(least_at.hover(format!("minimum: {} {unit}<extra></extra>", shown_number(least)))))
}

/// The combinations that are shown, row by row; `None` where one is missing.
fn rows<'a>(
    record: &'a SweepRecord,
    best: &'a SweepRow,
    x: &'a ShownAxis<'_>,
    y: &'a ShownAxis<'_>,
) -> impl Iterator<Item = impl Iterator<Item = Option<&'a SweepRow>>> {
    let row = move |i, j| section_plane::row(record, best, &[(x, i), (y, j)]);
    y.shown.iter().map(move |&j| x.shown.iter().map(move |&i| row(i, j)))
}

fn contours(record: &SweepRecord, figure: &MainFigure, best: &SweepRow, x: &ShownAxis<'_>, y: &ShownAxis<'_>) -> Trace {
    let unit = figure.unit();
    let values = rows(record, best, x, y).map(|row| row.map(|row| row?.figure(figure).map(plotted)).collect());
    Trace::new(TraceKind::Contour, figure.heading.as_str())
        .set("x", x.values())
        .set("y", y.values())
        .set("z", values.collect::<Vec<Vec<Option<f64>>>>())
        .colour_bar(unit)
        .set("contours", json!({ "showlabels": true, "labelfont": { "size": 11, "color": "#ffffff" } }))
        .set("ncontours", 16)
        .set("connectgaps", false)
        .set("hoverongaps", false)
        .unlisted()
        .hover(format!("{}: %{{x}}<br>{}: %{{y}}<br>%{{z:.5~g}} {unit}<extra></extra>", x.axis.title(), y.axis.title()))
}

/// Where the words of an axis stand.
pub(super) fn places(words: &[String]) -> Vec<f64> {
    (0..words.len()).map(|place| place as f64).collect()
}

/// The ends of an axis as plotly takes them: of a logarithmic one the exponents.
fn ends(of: &ShownAxis<'_>) -> [f64; 2] {
    let (from, to) = (of.axis.from, of.axis.to);
    match of.axis.spacing {
        AxisSpacing::Logarithmic => padded(from.log10(), to.log10()),
        AxisSpacing::Even | AxisSpacing::Listed(_) | AxisSpacing::Words(_) => padded(from, to),
    }
}

pub(super) fn id(kind: &str, figure: &MainFigure) -> String {
    format!("{kind}-{}", figure.name.to_lowercase().replace(['_', '.'], "-"))
}

/// Where the figure is least, and how far it is from there to its greatest.
pub(super) fn reading(record: &SweepRecord, figure: &MainFigure, best: &SweepRow, shown: &[&ShownAxis<'_>]) -> String {
    let Some((least, greatest)) = range(record, figure) else { return String::new() };
    let axes = record.identity.axes.iter().zip(&best.values).enumerate();
    let values = axes.map(|(at, (axis, &value))| (at, axis, format!("{} = {}", axis.key, shown_value(axis, value))));
    let (places, others): (Vec<_>, Vec<_>) =
        values.filter(|(_, axis, _)| axis.count > 1).partition(|(at, _, _)| shown.iter().any(|axis| axis.at == *at));
    let [places, others] = [places, others].map(|of| of.into_iter().map(|(_, _, said)| said).collect::<Vec<_>>());
    let unit = if figure.unit().is_empty() { String::new() } else { format!(" {}", figure.unit()) };
    let mut text = format!(
        "Minimum {}{unit} at {}, maximum {}{unit} of all combinations: {}.",
        shown_number(least),
        places.join(" and "),
        shown_number(greatest),
        figure.meaning
    );
    if !others.is_empty() {
        text.push_str(&format!(" Shown with {}, where the minimum of all is.", others.join(" and ")));
    }
    if shown.iter().any(|axis| axis.shown.len() < axis.axis.count) {
        text.push_str(" Not every value is drawn; all are in sweep.csv.");
    }
    text
}
