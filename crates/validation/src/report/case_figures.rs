//! The plots of a case.

use super::markup::identifier;
use crate::record::{CasePlot, CaseRecord, CurveStyle, PlotCurve};
use gearwear::report::chart::{Chart, Dash, MUTED, Trace};
use gearwear_bodies::reference::statistics::extent;

/// Colour and symbol of curve `number`; they repeat.
pub(super) fn colour_and_symbol(number: usize) -> (&'static str, &'static str) {
    const COLOURS: [&str; 5] = ["var(--pinion)", "var(--wheel)", "var(--path)", "var(--worn)", "var(--new)"];
    const SYMBOLS: [&str; 7] = ["circle", "square", "diamond", "triangle-up", "cross", "triangle-down", "x"];
    (COLOURS[number % COLOURS.len()], SYMBOLS[number % SYMBOLS.len()])
}

/// Greatest number of points of a curve that are marked.
const FEW_POINTS: usize = 40;

pub(super) fn all(case: &CaseRecord) -> Vec<Chart> {
    case.plots.iter().enumerate().map(|(number, plot)| figure(case, number, plot)).collect()
}

fn figure(case: &CaseRecord, number: usize, of: &CasePlot) -> Chart {
    // Bands first: curves are drawn over them.
    let (bands, curves): (Vec<_>, Vec<_>) =
        of.curves.iter().enumerate().partition(|(_, curve)| curve.style == CurveStyle::Band);
    let mut chart = Chart::new(format!("plot-{}-{}", identifier(&case.name), number + 1), &*of.title)
        .wide_if(of.curves.len() > 6)
        .height(400)
        .legend(of.curves.len() + of.levels.len() > 1)
        .read_nearest()
        .x(&of.x)
        .y(&of.y)
        .add_all(bands.into_iter().chain(curves).map(|(number, curve)| trace(number, curve)))
        .reading(&*of.reading);
    if of.log_x {
        chart = chart.x_logarithmic();
    }
    if of.log_y {
        chart = chart.y_logarithmic();
    }
    if let Some(ends) = ends(of) {
        for (name, level) in &of.levels {
            chart = chart.line(&**name, ends, [*level; 2], (MUTED, 1.4, Dash::Dot), "%{y:.4~g}");
        }
    }
    chart.mark(of.marks.iter().cloned(), "")
}

fn trace(number: usize, of: &PlotCurve) -> Trace {
    let (colour, symbol) = colour_and_symbol(number);
    let (x, y) = (of.x.iter().copied(), of.y.iter().copied());
    let line = |width_px, dash| Trace::line(&*of.name, x.clone(), y.clone(), (colour, width_px, dash));
    let hover = "%{x:.5~g}, %{y:.5~g}";
    match of.style {
        CurveStyle::Line if of.x.len() <= FEW_POINTS => line(2.0, Dash::Solid).with_points(symbol, 6).hover(hover),
        CurveStyle::Line => line(2.0, Dash::Solid).hover(hover),
        CurveStyle::Dashed => line(1.8, Dash::Dashed).hover(hover),
        CurveStyle::Points => {
            let points = Trace::points(&*of.name, x, y, (colour, symbol, 8)).hover(hover);
            points.uncertain_by(&of.uncertainty)
        }
        CurveStyle::Band => line(0.8, Dash::Solid).filled(["var(--pinion-fill)", "var(--wheel-fill)"][number % 2]),
    }
}

/// From the least to the greatest abscissa.
fn ends(of: &CasePlot) -> Option<[f64; 2]> {
    let all = of.curves.iter().flat_map(|curve| curve.x.iter().copied());
    let ends = extent(all.filter(|x| x.is_finite() && (!of.log_x || *x > 0.0)));
    (ends[0] < ends[1]).then_some(ends)
}
