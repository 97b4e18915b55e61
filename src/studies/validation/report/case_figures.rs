//! The plots of a case.

use crate::report::chart::{
    Axis, AxisType, DashType, ErrorBars, ExponentFormat, Fill, HoverInfo, HoverMode, Marker, MarkerSymbol, Mode, Plot,
    Trace,
};

use super::markup::identifier;
use crate::report::html::number::plotted;
use crate::report::html::theme::{Figure, MUTED, axis, curve, layout, line, mark, mark_logarithmic};
use crate::studies::validation::record::{CasePlot, CaseRecord, CurveStyle, PlotAxis, PlotCurve};

/// How the curve of a number is told from the others: by colour and by sign.
pub(super) struct Look {
    /// Colour of line and marks.
    pub(super) colour: &'static str,
    /// Sign of its points.
    pub(super) symbol: MarkerSymbol,
}

/// The look of the curve of that number; they recur.
pub(super) fn look(number: usize) -> Look {
    const COLOURS: [&str; 5] = ["var(--pinion)", "var(--wheel)", "var(--path)", "var(--worn)", "var(--new)"];
    let symbols = [
        MarkerSymbol::Circle,
        MarkerSymbol::Square,
        MarkerSymbol::Diamond,
        MarkerSymbol::TriangleUp,
        MarkerSymbol::Cross,
        MarkerSymbol::TriangleDown,
        MarkerSymbol::X,
    ];
    let symbol = symbols[number % symbols.len()];
    Look { colour: COLOURS[number % COLOURS.len()], symbol }
}

/// Curves with no more points than this show them.
const FEW_POINTS: usize = 40;

/// The figures of `case`.
pub(super) fn all(case: &CaseRecord) -> Vec<Figure> {
    case.plots.iter().enumerate().map(|(number, plot)| figure(case, number, plot)).collect()
}

fn figure(case: &CaseRecord, number: usize, of: &CasePlot) -> Figure {
    let mut plot = Plot::new();
    // Bands first: curves are drawn over them.
    let (bands, curves): (Vec<_>, Vec<_>) =
        of.curves.iter().enumerate().partition(|(_, curve)| curve.style == CurveStyle::Band);
    for (number, curve) in bands.into_iter().chain(curves) {
        plot.add_trace(trace(number, curve));
    }
    if let Some([low, high]) = extent(of) {
        for (name, level) in &of.levels {
            plot.add_trace(
                curve(name, [low, high], [*level; 2], line(MUTED, 1.4, DashType::Dot)).hover_template("%{y:.4~g}"),
            );
        }
    }
    let marks = of.marks.iter().cloned();
    let bare = layout(400);
    let marked = if of.x.log { mark_logarithmic(bare, marks) } else { mark(bare, marks, "") };
    plot.set_layout(
        marked
            .show_legend(of.curves.len() + of.levels.len() > 1)
            .hover_mode(HoverMode::Closest)
            .x_axis(plot_axis(&of.x))
            .y_axis(plot_axis(&of.y)),
    );
    Figure {
        id: format!("plot-{}-{}", identifier(&case.name), number + 1),
        title: of.title.clone(),
        reading: of.reading.clone(),
        plot,
        wide: of.curves.len() > 6,
    }
}

fn plot_axis(of: &PlotAxis) -> Axis {
    let axis = axis(&of.title).exponent_format(ExponentFormat::Power);
    if of.log { axis.type_(AxisType::Log) } else { axis }
}

fn trace(number: usize, of: &PlotCurve) -> Trace {
    let look = look(number);
    let xy = || (of.x.iter().copied(), of.y.iter().copied());
    let drawn = |width_px, dash| curve(&of.name, xy().0, xy().1, line(look.colour, width_px, dash));
    let hover = "%{x:.5~g}, %{y:.5~g}";
    match of.style {
        CurveStyle::Line if of.x.len() <= FEW_POINTS => drawn(2.0, DashType::Solid)
            .mode(Mode::LinesMarkers)
            .marker(Marker::new().color(look.colour).symbol(look.symbol).size(6))
            .hover_template(hover),
        CurveStyle::Line => drawn(2.0, DashType::Solid).hover_template(hover),
        CurveStyle::Dashed => drawn(1.8, DashType::Dash).hover_template(hover),
        CurveStyle::Points => {
            let points = drawn(1.0, DashType::Solid)
                .mode(Mode::Markers)
                .marker(Marker::new().color(look.colour).symbol(look.symbol).size(8))
                .hover_template(hover);
            if of.uncertainty.is_empty() {
                points
            } else {
                let half: Vec<f64> = of.uncertainty.iter().copied().map(plotted).collect();
                points.error_y(ErrorBars::new().type_("data").array(half).color(look.colour).thickness(1.2).width(4))
            }
        }
        CurveStyle::Band => drawn(0.8, DashType::Solid)
            .fill(Fill::ToSelf)
            .fill_color(["var(--pinion-fill)", "var(--wheel-fill)"][number % 2])
            .hover_info(HoverInfo::Skip),
    }
}

/// From the least to the greatest abscissa.
fn extent(of: &CasePlot) -> Option<[f64; 2]> {
    let finite =
        of.curves.iter().flat_map(|curve| curve.x.iter().copied()).filter(|x| x.is_finite() && (!of.x.log || *x > 0.0));
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low < high).then_some([low, high])
}
