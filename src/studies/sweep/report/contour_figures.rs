//! A figure over two varied keys: contours, with the combination where it is least.

use crate::report::chart::{
    ColorBar, ColorScale, Contours, DashType, Font, HoverMode, Marker, MarkerSymbol, Mode, Plot, Title, Trace,
};

use super::section_plane::{self, ShownAxis, range};
use crate::report::html::number::{figure as shown_number, given, plotted};
use crate::report::html::theme::{Figure, axis, curve, layout, line, padded};
use crate::studies::sweep::figures::SweepFigure;
use crate::studies::sweep::record::{SweepRecord, SweepRow};

/// The plot of `figure` over the keys `x` and `y`; further keys stay at the values where the figure is least.
pub fn contour(record: &SweepRecord, figure: &SweepFigure, x: &ShownAxis<'_>, y: &ShownAxis<'_>) -> Option<Figure> {
    let (best, least) = record.least(figure)?;
    let at = |i: usize, j: usize| section_plane::row(record, best, &[(x, i), (y, j)]);
    let z: Vec<Vec<Option<f64>>> = y
        .shown
        .iter()
        .map(|&j| x.shown.iter().map(|&i| at(i, j).and_then(|row| row.figure(figure)).map(plotted)).collect())
        .collect();
    let failed: Vec<&SweepRow> = y
        .shown
        .iter()
        .flat_map(|&j| x.shown.iter().filter_map(move |&i| at(i, j)))
        .filter(|row| row.error.is_some())
        .collect();
    let mut plot = Plot::new();
    plot.add_trace(
        Trace::contour(x.values(), y.values(), z)
            .name(figure.title)
            .color_scale(ColorScale::Viridis)
            .color_bar(ColorBar::new().title(Title::new().text(figure.unit).font(Font::new().size(12))).thickness(14))
            .contours(Contours::new().show_labels(true).label_font(Font::new().size(11).color("#ffffff")))
            .n_contours(16)
            .connect_gaps(false)
            .hover_on_gaps(false)
            .show_legend(false)
            .hover_template(format!(
                "{} %{{x}}<br>{} %{{y}}<br>%{{z:.5~g}} {}<extra></extra>",
                x.axis.key, y.axis.key, figure.unit
            )),
    );
    if !failed.is_empty() {
        plot.add_trace(
            curve(
                "no result",
                failed.iter().map(|row| row.values[x.at]),
                failed.iter().map(|row| row.values[y.at]),
                line("var(--muted)", 1.0, DashType::Solid),
            )
            .mode(Mode::Markers)
            .marker(Marker::new().color("var(--muted)").symbol(MarkerSymbol::X).size(6))
            .hover_text_array(failed.iter().map(|row| row.error.clone().unwrap_or_default()).collect::<Vec<_>>())
            .hover_template("%{hovertext}<extra></extra>"),
        );
    }
    plot.add_trace(
        curve("least", [best.values[x.at]], [best.values[y.at]], line("var(--alert)", 1.0, DashType::Solid))
            .mode(Mode::Markers)
            .marker(Marker::new().color("#ff5a36").symbol(MarkerSymbol::Star).size(15))
            .hover_template(format!("least: {} {}<extra></extra>", shown_number(least), figure.unit)),
    );
    plot.set_layout(
        layout(460)
            .show_legend(true)
            .hover_mode(HoverMode::Closest)
            .x_axis(axis(&x.axis.key).show_grid(false).range(padded(x.axis.from, x.axis.to)))
            .y_axis(axis(&y.axis.key).show_grid(false).range(padded(y.axis.from, y.axis.to))),
    );
    Some(Figure {
        id: format!("contour-{}", figure.name.to_lowercase().replace('_', "-")),
        title: capitalised(figure.title),
        reading: reading(record, figure, best, &[x, y]),
        plot,
        wide: false,
    })
}

/// Where the figure is least, and how far it is from there to its greatest.
pub fn reading(record: &SweepRecord, figure: &SweepFigure, best: &SweepRow, shown: &[&ShownAxis<'_>]) -> String {
    let Some((least, greatest)) = range(record, figure) else { return String::new() };
    let value_of = |at: usize| format!("{} = {}", record.identity.axes[at].key, given(best.values[at]));
    let places: Vec<String> = shown.iter().map(|axis| value_of(axis.at)).collect();
    let others: Vec<String> = (0..record.identity.axes.len())
        .filter(|at| record.identity.axes[*at].count > 1 && shown.iter().all(|axis| axis.at != *at))
        .map(value_of)
        .collect();
    let unit = if figure.unit.is_empty() { String::new() } else { format!(" {}", figure.unit) };
    let mut text = format!(
        "Least {}{unit} at {}, greatest {}{unit} of all combinations: {}.",
        shown_number(least),
        places.join(" and "),
        shown_number(greatest),
        figure.meaning
    );
    if !others.is_empty() {
        text.push_str(&format!(" Shown with {}, where the least of all is.", others.join(" and ")));
    }
    if shown.iter().any(|axis| axis.shown.len() < axis.axis.count) {
        text.push_str(" Not every value is drawn; all are in sweep.csv.");
    }
    text
}

/// With a capital first letter.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
