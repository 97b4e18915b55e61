//! A chart in a page: its drawing, the entries of its legend, and what the page's script (`html/page.js`) reads at its points.

use serde::Serialize;

use super::drawing::{Drawing, TICK_SPACING, is_shown};
use super::picture::Medium;
use super::sign;
use super::traces::{bar_middles, edges};
use super::{axis::PlacedAxis, drawing::range_of_colours, palette};
use crate::report::chart::{Chart, Drawn, Field, Rows, Surface, Trace, View};
use crate::report::control::Control;

pub struct InPage {
    pub svg: String,
    pub legend: Vec<Entry>,
    /// JSON.
    pub data: String,
}

/// A trace in the legend.
pub struct Entry {
    /// Number of the trace.
    pub trace: usize,
    pub name: String,
    /// SVG.
    pub sign: String,
    pub is_shown: bool,
}

#[derive(Serialize)]
struct Data<'a> {
    size: [f64; 2],
    /// Left, top, right and bottom of the plot.
    frame: [f64; 4],
    x: AxisData<'a>,
    y: AxisData<'a>,
    is_to_scale: bool,
    is_dragged: bool,
    reads_nearest: bool,
    is_cut: bool,
    traces: Vec<TraceData<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    control: Option<&'a Control>,
}

/// An axis in coordinates: of a logarithmic axis exponents.
#[derive(Serialize)]
struct AxisData<'a> {
    range: [f64; 2],
    asked: [f64; 2],
    /// Around all that is shown.
    whole: [f64; 2],
    is_logarithmic: bool,
    has_grid: bool,
    spacing_px: f64,
    format: Option<&'static str>,
    names: &'a [String],
    ticks: &'a [(f64, String)],
}

#[derive(Serialize)]
struct TraceData<'a> {
    name: &'a str,
    colour: String,
    group: Option<&'a str>,
    is_shown: bool,
    /// None where nothing is read.
    hover: Option<&'a str>,
    texts: &'a [String],
    further: &'a [f64],
    /// Left out where it is that of the trace before.
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<Vec<f64>>,
    y: Vec<f64>,
    /// Values over cells between `x` and `y`.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<&'a Rows>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface: Option<SurfaceData<'a>>,
}

#[derive(Serialize)]
struct SurfaceData<'a> {
    rise: f64,
    view: &'a View,
    titles: [&'a str; 2],
    /// Values of the first and the last of `colours`.
    range: [f64; 2],
    colours: Vec<String>,
    unit: &'a str,
}

/// Colours of a surface.
const COLOURS: usize = 64;

/// What a page shows of `chart`.
pub fn of(chart: &Chart) -> InPage {
    let drawing = Drawing::new(chart, Medium::Page).finished();
    let listed = chart.traces.iter().enumerate().filter(|(_, trace)| chart.has_legend && sign::is_listed(trace));
    let legend = listed.map(|(number, trace)| Entry {
        trace: number,
        name: trace.name.clone(),
        sign: sign::in_page(trace),
        is_shown: is_shown(trace),
    });
    let [x, y] = drawing.whole();
    let data = Data {
        size: drawing.picture.size,
        frame: drawing.picture.frame,
        x: axis(&drawing.x, x, TICK_SPACING[0]),
        y: axis(&drawing.y, y, TICK_SPACING[1]),
        is_to_scale: chart.is_to_scale,
        is_dragged: chart.is_dragged,
        reads_nearest: chart.reads_nearest,
        is_cut: chart.is_cut,
        traces: traces(&drawing),
        control: chart.control.as_ref(),
    };
    let data = serde_json::to_string(&data).expect("numbers and texts are JSON");
    InPage { svg: drawing.picture.svg(), legend: legend.collect(), data }
}

fn axis<'a>(axis: &'a PlacedAxis<'_>, whole: [f64; 2], spacing_px: f64) -> AxisData<'a> {
    AxisData {
        range: axis.range,
        asked: axis.asked,
        whole,
        is_logarithmic: axis.words.is_logarithmic,
        has_grid: axis.words.has_grid && axis.categories.is_empty(),
        spacing_px,
        format: axis.words.format,
        names: &axis.categories,
        ticks: &axis.words.ticks,
    }
}

fn traces<'a>(drawing: &Drawing<'a>) -> Vec<TraceData<'a>> {
    let all = drawing.chart.traces.iter().enumerate();
    let mut all: Vec<TraceData<'a>> = all.map(|(number, trace)| of_trace(drawing, number, trace)).collect();
    for number in (1..all.len()).rev() {
        if all[number].x == all[number - 1].x {
            all[number].x = None;
        }
    }
    all
}

fn of_trace<'a>(drawing: &Drawing<'a>, number: usize, trace: &'a Trace) -> TraceData<'a> {
    let hover = trace.hover.as_deref();
    let (x, y, colour) = match &trace.drawn {
        // Places of what is not read are in the drawing already, but for bodies that turn with it.
        Drawn::Curve(curve) if hover.is_none() => (Vec::new(), Vec::new(), curve.colour()),
        Drawn::Curve(curve) => (curve.x.clone(), curve.y.clone(), curve.colour()),
        Drawn::Bars(bars) => {
            let before = drawing.chart.traces[..number].iter().filter(|trace| matches!(trace.drawn, Drawn::Bars(_)));
            let middles = bar_middles(drawing, bars, before.count());
            let (x, y) =
                if bars.is_horizontal { (bars.length.clone(), middles) } else { (middles, bars.length.clone()) };
            (x, y, bars.colour.as_str())
        }
        Drawn::Cells(field) => {
            let cells = (field.values.first().map_or(0, Vec::len), field.values.len());
            let sides = (edges(&field.x, cells.0), edges(&field.y, cells.1));
            (sides.0.unwrap_or_default(), sides.1.unwrap_or_default(), "")
        }
        Drawn::Contours(field) | Drawn::Surface(Surface { field, .. }) => (field.x.clone(), field.y.clone(), ""),
    };
    let (values, surface) = match &trace.drawn {
        Drawn::Cells(Field { values, .. }) | Drawn::Contours(Field { values, .. }) => (Some(values), None),
        Drawn::Surface(surface) => {
            let (titles, range) =
                ([&*drawing.chart.x.title, &*drawing.chart.y.title], range_of_colours(&surface.field));
            let unit = &*surface.field.scale.unit;
            let colours =
                (0..COLOURS).map(|i| palette::hex(palette::of_scale(i as f64 / (COLOURS - 1) as f64))).collect();
            let data = SurfaceData { rise: surface.rise, view: &surface.view, titles, range, colours, unit };
            (Some(&surface.field.values), Some(data))
        }
        Drawn::Curve(_) | Drawn::Bars(_) => (None, None),
    };
    TraceData {
        name: &trace.name,
        colour: palette::in_page(colour),
        group: trace.group.as_deref(),
        is_shown: is_shown(trace),
        hover,
        texts: &trace.texts,
        further: &trace.further,
        x: Some(x),
        y,
        values,
        surface,
    }
}
