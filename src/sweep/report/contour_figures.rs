//! A figure over two varied keys: contours, with the combination where it is least.

use super::best_tables::shown_value;
use super::section_plane::{self, ShownAxis, range};
use crate::evaluate::figure::StudyFigure;
use crate::report::chart::{Chart, ColourScale, Drawn, Field, MUTED, Rows, Trace, padded};
use crate::report::html::number::{figure as shown_number, plotted};
use crate::report::html::reading::capitalised;
use crate::sweep::record::{AxisSpacing, SweepRecord, SweepRow};

/// The plot of `figure` over the keys `x` and `y`; further keys stay at the values where the figure is least.
pub(super) fn contour(
    record: &SweepRecord,
    figure: &StudyFigure,
    x: &ShownAxis<'_>,
    y: &ShownAxis<'_>,
) -> Option<Chart> {
    let (best, least) = record.least(figure)?;
    let rows: Vec<Vec<Option<&SweepRow>>> = y
        .shown
        .iter()
        .map(|&j| x.shown.iter().map(|&i| section_plane::row(record, best, &[(x, i), (y, j)])).collect())
        .collect();
    let mut chart = Chart::new(id("contour", figure), capitalised(&figure.heading))
        .height(460)
        .read_nearest()
        .x(&x.axis.title())
        .x_range(ends(x))
        .y(&y.axis.title())
        .y_range(ends(y))
        .without_grid()
        .add(contours(figure, x, y, &rows))
        .reading(reading(record, figure, best, &[x, y]));
    if let Some(words) = x.axis.words() {
        chart = chart.x_ticks(numbered(words));
    }
    if let Some(words) = y.axis.words() {
        chart = chart.y_ticks(numbered(words));
    }
    if x.axis.spacing == AxisSpacing::Logarithmic {
        chart = chart.x_logarithmic();
    }
    if y.axis.spacing == AxisSpacing::Logarithmic {
        chart = chart.y_logarithmic();
    }
    let done = rows.iter().flatten().flatten().filter(|row| row.error.is_none());
    let places: Vec<[f64; 2]> = done.map(|row| [row.values[x.at], row.values[y.at]]).collect();
    let [along_x, along_y] = [0, 1].map(|axis| places.iter().map(move |place| place[axis]));
    chart = chart.add(Trace::points("run", along_x, along_y, ("rgba(255,255,255,0.85)", "circle", 4)));
    let failed = rows.iter().flatten().flatten().filter_map(|row| Some((row, row.error.clone()?)));
    let (failed, errors): (Vec<&SweepRow>, Vec<String>) = failed.unzip();
    if !failed.is_empty() {
        let [along_x, along_y] = [x, y].map(|axis| failed.iter().map(|row| row.values[axis.at]).collect::<Vec<_>>());
        chart = chart.add(Trace::points("no result", along_x, along_y, (MUTED, "x", 6)).hover_texts(errors));
    }
    let least_at = Trace::points("minimum", [best.values[x.at]], [best.values[y.at]], ("#ff5a36", "star", 15));
    Some(chart.add(least_at.hover(format!("minimum: {} {}<extra></extra>", shown_number(least), figure.unit()))))
}

/// Contours of a figure, from a row of combinations for each value of `y`.
fn contours(figure: &StudyFigure, x: &ShownAxis<'_>, y: &ShownAxis<'_>, rows: &[Vec<Option<&SweepRow>>]) -> Trace {
    let values: Rows = rows
        .iter()
        .map(|rows| {
            let figures = rows.iter().map(|row| row.as_ref().and_then(|row| row.figure(figure)));
            figures.map(|value| value.map_or(f64::NAN, plotted)).collect()
        })
        .collect();
    let unit = figure.unit();
    let field = Field { x: x.values(), y: y.values(), values, scale: ColourScale::of(unit) };
    Trace::new(Drawn::Contours(field), figure.heading.as_str()).unlisted().hover(format!(
        "{}: %{{x}}<br>{}: %{{y}}<br>%{{z:.5~g}} {unit}<extra></extra>",
        x.axis.title(),
        y.axis.title()
    ))
}

/// Words with their places on an axis.
pub(super) fn numbered(words: &[String]) -> impl Iterator<Item = (f64, String)> {
    words.iter().enumerate().map(|(place, word)| (place as f64, word.clone()))
}

/// The ends of an axis, with a little room.
fn ends(of: &ShownAxis<'_>) -> [f64; 2] {
    let (from, to) = (of.axis.from, of.axis.to);
    match of.axis.spacing {
        AxisSpacing::Logarithmic => padded(from.log10(), to.log10()).map(|exponent| 10f64.powf(exponent)),
        AxisSpacing::Even | AxisSpacing::Listed(_) | AxisSpacing::Words(_) => padded(from, to),
    }
}

pub(super) fn id(kind: &str, figure: &StudyFigure) -> String {
    format!("{kind}-{}", figure.name.to_lowercase().replace(['_', '.'], "-"))
}

/// Sentence with the least and greatest value of the figure and where it is least.
pub(super) fn reading(record: &SweepRecord, figure: &StudyFigure, best: &SweepRow, shown: &[&ShownAxis<'_>]) -> String {
    let Some((least, greatest)) = range(record, figure) else { return String::new() };
    let axes = &record.identity.axes;
    let values: Vec<String> = axes
        .iter()
        .zip(&best.values)
        .map(|(axis, &value)| format!("{} = {}", axis.key, shown_value(axis, value)))
        .collect();
    let places: Vec<&str> = shown.iter().map(|axis| values[axis.at].as_str()).collect();
    let others = (0..axes.len()).filter(|&at| axes[at].count > 1 && shown.iter().all(|axis| axis.at != at));
    let others: Vec<&str> = others.map(|at| values[at].as_str()).collect();
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
