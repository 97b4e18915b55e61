//! Charts: what is drawn, in the words of plotly.js, which draws them in the page; as files they are drawn by `figure`.
//!
//! A [`Chart`] is built line by line; what has no method of its own is set under plotly's name, as plotly's reference has it,
//! <https://plotly.com/javascript/reference/>. Which bundle of the script goes into a page follows from its traces (`plot_script`).
//!
//! Colours are tokens, `var(--name)` or `mix(--from,--to,share)`. The page's script replaces them by the custom properties
//! of `page.css` in force, so that one place holds the palette and charts follow the light, dark or printed page.

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::control::Control;
use super::html::number::plotted;
use crate::gear::Gear;
use crate::results::run::PathPoints;

pub(crate) const NEW: &str = "var(--new)";
pub(crate) const WORN: &str = "var(--worn)";
/// Secondary lines and labels.
pub(crate) const MUTED: &str = "var(--muted)";
/// The path of contact.
pub(crate) const PATH: &str = "var(--path)";
/// Outlines and the answer that others are compared with.
pub(crate) const INK: &str = "var(--ink)";
const RULE: &str = "var(--rule)";
const PAPER: &str = "var(--paper)";
const NOTHING: &str = "rgba(0,0,0,0)";

pub(crate) fn gear_colour(gear: Gear) -> &'static str {
    match gear {
        Gear::Pinion => "var(--pinion)",
        Gear::Wheel => "var(--wheel)",
    }
}

pub(crate) fn gear_fill(gear: Gear) -> &'static str {
    match gear {
        Gear::Pinion => "var(--pinion-fill)",
        Gear::Wheel => "var(--wheel-fill)",
    }
}

/// Colour of a gear at `share` of its life: from pale to full.
pub(crate) fn gear_colour_at(gear: Gear, share: f64) -> String {
    format!("mix(--{0}-early,--{0},{share:.3})", gear.name())
}

/// Colour between those of the gears.
pub(crate) fn colour_between_gears(share: f64) -> String {
    format!("mix(--pinion,--wheel,{share:.3})")
}

/// How a line is dashed, in plotly's words.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Dash {
    Solid,
    #[serde(rename = "dash")]
    Dashed,
    Dot,
    #[serde(rename = "dashdot")]
    Mixed,
}

/// plotly's types of traces that charts use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TraceKind {
    /// Lines and points.
    Scatter,
    Bar,
    HeatMap,
    Contour,
    Surface,
}

impl TraceKind {
    /// As plotly calls it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Scatter => "scatter",
            Self::Bar => "bar",
            Self::HeatMap => "heatmap",
            Self::Contour => "contour",
            Self::Surface => "surface",
        }
    }
}

/// One of the things that a chart shows.
#[derive(Debug, Clone)]
pub(crate) struct Trace {
    pub kind: TraceKind,
    attributes: Map<String, Value>,
}

/// Numbers rounded to what a chart needs; what is none, or no number, is a gap.
fn rounded(values: impl IntoIterator<Item = impl Into<Option<f64>>>) -> Value {
    values.into_iter().map(|value| value.into().map(plotted)).collect()
}

impl Trace {
    pub(crate) fn new(kind: TraceKind, name: impl Into<String>) -> Self {
        Self::of_kind(kind).set("name", name.into())
    }

    fn of_kind(kind: TraceKind) -> Self {
        Self { kind, attributes: Map::new() }.set("type", kind.name())
    }

    /// An attribute under plotly's name; null where it is not set.
    pub(crate) fn get(&self, key: &str) -> &Value {
        self.attributes.get(key).unwrap_or(&Value::Null)
    }

    /// Sets an attribute under plotly's name.
    pub(crate) fn set(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.attributes.insert(key.to_owned(), value.into());
        self
    }

    /// A line through points, of a colour, a width in pixels and a dash.
    pub(crate) fn line(
        name: impl Into<String>,
        x: impl IntoIterator<Item = impl Into<Option<f64>>>,
        y: impl IntoIterator<Item = impl Into<Option<f64>>>,
        (colour, width_px, dash): (impl Into<String>, f64, Dash),
    ) -> Self {
        let points = Self::new(TraceKind::Scatter, name).set("x", rounded(x)).set("y", rounded(y));
        // Through all its points: plotly would leave some out, which puts corners into smooth curves.
        let line = json!({ "color": colour.into(), "width": width_px, "dash": dash, "simplify": false });
        points.set("mode", "lines").set("line", line)
    }

    /// Points, each a sign of plotly's symbols.
    pub(crate) fn points(
        name: impl Into<String>,
        x: impl IntoIterator<Item = impl Into<Option<f64>>>,
        y: impl IntoIterator<Item = impl Into<Option<f64>>>,
        (colour, symbol, size_px): (&str, &str, i32),
    ) -> Self {
        let points = Self::new(TraceKind::Scatter, name).set("x", rounded(x)).set("y", rounded(y));
        points.set("mode", "markers").set("marker", json!({ "color": colour, "symbol": symbol, "size": size_px }))
    }

    /// Colours over cells.
    pub(crate) fn heat_map(unit: &str, x: &[f64], y: &[f64], z: impl Into<Value>) -> Self {
        let edges = |edges: &[f64]| rounded(edges.iter().copied());
        Self::of_kind(TraceKind::HeatMap).set("x", edges(x)).set("y", edges(y)).set("z", z).colour_bar(unit)
    }

    /// Colours for values, with their scale beside the chart.
    pub(crate) fn colour_bar(self, unit: &str) -> Self {
        // With empty lines below, so that the unit stands clear of a number at the very top.
        let title = json!({ "text": format!("{unit}<br>\u{a0}<br>\u{a0}"), "font": { "size": 12 } });
        let bar = json!({
            "title": title,
            "thickness": 12,
            "exponentformat": "power",
            "minexponent": LARGEST_PLAIN_EXPONENT,
        });
        self.set("colorscale", "Viridis").set("colorbar", bar)
    }

    /// The scale of colours farther out, as part of the chart's width.
    pub(crate) fn colour_bar_at(mut self, x: f64) -> Self {
        self.attributes["colorbar"]["x"] = x.into();
        self
    }

    /// The signs of a line's points too.
    pub(crate) fn with_points(self, symbol: &str, size_px: i32) -> Self {
        let colour = self.attributes["line"]["color"].clone();
        let marker = json!({ "color": colour, "symbol": symbol, "size": size_px });
        self.set("mode", "lines+markers").set("marker", marker)
    }

    /// An area instead of a line.
    pub(crate) fn filled(self, colour: impl Into<String>) -> Self {
        self.set("fill", "toself").set("fillcolor", colour.into()).silent()
    }

    /// What is read at a point, as a template of plotly's.
    pub(crate) fn hover(self, template: impl Into<String>) -> Self {
        self.set("hovertemplate", template.into())
    }

    /// A text of its own to be read at each point.
    pub(crate) fn hover_texts(self, texts: Vec<String>) -> Self {
        self.set("hovertext", texts).hover("%{hovertext}<extra></extra>")
    }

    /// Nothing is read at its points.
    pub(crate) fn silent(self) -> Self {
        self.set("hoverinfo", "skip")
    }

    pub(crate) fn unlisted(self) -> Self {
        self.set("showlegend", false)
    }

    /// Shown and hidden with the others of the group.
    pub(crate) fn group(self, name: &str) -> Self {
        self.set("legendgroup", name)
    }

    /// Drawn from the beginning, or not before its entry in the legend is chosen.
    pub(crate) fn at_once(self, at_once: bool) -> Self {
        self.set("visible", if at_once { json!(true) } else { json!("legendonly") })
    }

    pub(crate) fn opacity(self, opacity: f64) -> Self {
        self.set("opacity", opacity)
    }
}

/// A chart with its words.
#[derive(Debug, Clone)]
pub(crate) struct Chart {
    /// Identifier in the page, letters and hyphens.
    pub id: String,
    pub title: String,
    /// One sentence that says what the chart shows, with its numbers.
    pub reading: String,
    /// Over the whole width of the page, or beside the next one where there is room.
    pub is_wide: bool,
    /// What the reader may move.
    pub control: Option<Control>,
    traces: Vec<Trace>,
    layout: Value,
}

impl Chart {
    /// An empty chart. Its width and the legend's height follow from the room there is, in the page's script.
    pub(crate) fn new(id: impl Into<String>, title: impl Into<String>) -> Self {
        let layout = json!({
            "height": 380,
            "paper_bgcolor": PAPER,
            "plot_bgcolor": PAPER,
            "font": { "family": "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif", "size": 13, "color": INK },
            "margin": { "l": 56, "r": 12, "t": 28, "b": 48 },
            "separators": ".\u{202f}",
            "hovermode": "x unified",
            "hoverlabel": { "bgcolor": PAPER, "bordercolor": RULE },
            "modebar": { "bgcolor": NOTHING, "color": MUTED, "activecolor": INK },
            "showlegend": true,
            "legend": {
                "orientation": "h", "x": 0.0, "xanchor": "left", "itemwidth": 34, "bgcolor": NOTHING, "font": { "size": 12 },
            },
        });
        let (id, title) = (id.into(), title.into());
        Self { id, title, reading: String::new(), is_wide: false, control: None, traces: Vec::new(), layout }
    }

    pub(crate) fn reading(mut self, text: impl Into<String>) -> Self {
        self.reading = text.into();
        self
    }

    /// Over the whole width of the page.
    pub(crate) fn wide(self) -> Self {
        self.wide_if(true)
    }

    pub(crate) fn wide_if(mut self, is_wide: bool) -> Self {
        self.is_wide = is_wide;
        self
    }

    /// With a slider below it; states of which there is only one need none.
    pub(crate) fn movable(mut self, control: Control) -> Self {
        let moves = !matches!(&control, Control::Steps { steps, .. } if steps.len() < 2);
        self.control = moves.then_some(control);
        self
    }

    /// Sets an attribute of the layout under plotly's name.
    pub(crate) fn set(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.layout[key] = value.into();
        self
    }

    pub(crate) fn height(self, px: usize) -> Self {
        self.set("height", px)
    }

    /// Whether traces are named below it.
    pub(crate) fn legend(self, is_shown: bool) -> Self {
        self.set("showlegend", is_shown)
    }

    /// The nearest point is read, not all above one another.
    pub(crate) fn read_nearest(self) -> Self {
        self.set("hovermode", "closest")
    }

    /// Names the axis across, unit included.
    pub(crate) fn x(self, title: &str) -> Self {
        self.set("xaxis", axis(title))
    }

    /// Names the axis upwards, unit included.
    pub(crate) fn y(self, title: &str) -> Self {
        self.set("yaxis", axis(title))
    }

    /// Sets an attribute of the axis across under plotly's name.
    pub(crate) fn x_set(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.layout["xaxis"][key] = value.into();
        self
    }

    /// Sets an attribute of the axis upwards under plotly's name.
    pub(crate) fn y_set(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.layout["yaxis"][key] = value.into();
        self
    }

    pub(crate) fn x_range(self, range: [f64; 2]) -> Self {
        self.x_set("range", range.to_vec())
    }

    pub(crate) fn y_range(self, range: [f64; 2]) -> Self {
        self.y_set("range", range.to_vec())
    }

    /// The axis upwards from 0 to somewhat above `greatest`.
    pub(crate) fn y_up_to(self, greatest: f64) -> Self {
        self.y_range(from_zero(greatest))
    }

    /// The axis upwards as a depth: from somewhat below `greatest` up to 0.
    pub(crate) fn y_down_to(self, greatest: f64) -> Self {
        let [_, bottom] = from_zero(greatest);
        self.y_range([bottom, -0.02 * bottom])
    }

    /// How places across are read, a format of d3.
    pub(crate) fn x_format(self, format: &str) -> Self {
        self.x_set("hoverformat", format)
    }

    /// Powers of ten written as such, across.
    pub(crate) fn x_logarithmic(self) -> Self {
        self.x_set("type", "log")
    }

    pub(crate) fn y_logarithmic(self) -> Self {
        self.y_set("type", "log")
    }

    pub(crate) fn without_grid(self) -> Self {
        self.x_set("showgrid", false).y_set("showgrid", false)
    }

    /// The axis across as the path of contact, with its points.
    pub(crate) fn over_path(self, points: &PathPoints) -> Self {
        self.x("contact position, mm").x_range(padded(points.A, points.E)).x_format(".3f").mark_path_points(points)
    }

    pub(crate) fn add(mut self, trace: Trace) -> Self {
        self.traces.push(trace);
        self
    }

    /// Everything but its traces, in plotly's words.
    pub(crate) fn layout(&self) -> &Value {
        &self.layout
    }

    pub(crate) fn traces(&self) -> impl Iterator<Item = &Trace> {
        self.traces.iter()
    }

    /// Draws all of `traces`, one over the other.
    pub(crate) fn add_all(self, traces: impl IntoIterator<Item = Trace>) -> Self {
        traces.into_iter().fold(self, Self::add)
    }

    /// Draws a line, read at its points by the template `hover`.
    pub(crate) fn line(
        self,
        name: impl Into<String>,
        x: impl IntoIterator<Item = impl Into<Option<f64>>>,
        y: impl IntoIterator<Item = impl Into<Option<f64>>>,
        stroke: (impl Into<String>, f64, Dash),
        hover: &str,
    ) -> Self {
        self.add(Trace::line(name, x, y, stroke).hover(hover))
    }

    /// Draws a quantity new (dashed, grey) and worn (full) against `x`.
    pub(crate) fn new_and_worn(self, x: &[f64], new: Vec<f64>, worn: Vec<f64>, hover: &str) -> Self {
        let x = || x.iter().copied();
        self.line("new", x(), new, (NEW, 2.0, Dash::Dashed), hover).line(
            "worn",
            x(),
            worn,
            (WORN, 2.2, Dash::Solid),
            hover,
        )
    }

    /// A vertical line with its letter at each of the points A–E; the pitch point C is the stronger one.
    pub(crate) fn mark_path_points(self, points: &PathPoints) -> Self {
        self.mark(points.named(), "C")
    }

    /// A vertical line with its name at each place; that of the name `strongest` is the stronger one.
    pub(crate) fn mark(self, places: impl IntoIterator<Item = (impl Into<String>, f64)>, strongest: &str) -> Self {
        // On a logarithmic axis plotly takes the place of a line as it is and that of its name as a logarithm.
        let is_logarithmic = self.layout["xaxis"]["type"] == "log";
        let (mut lines, mut names) = (Vec::new(), Vec::new());
        for (name, x) in places {
            if !x.is_finite() || is_logarithmic && x <= 0.0 {
                continue;
            }
            let name = name.into();
            let (width, dash) = if name == strongest { (1.4, "dashdot") } else { (1.0, "dot") };
            lines.push(json!({
                "type": "line", "layer": "below", "xref": "x", "yref": "paper", "x0": x, "x1": x, "y0": 0.0, "y1": 1.0,
                "line": { "color": MUTED, "width": width, "dash": dash },
            }));
            let at = if is_logarithmic { x.log10() } else { x };
            names.push(label(name, json!({ "xref": "x", "yref": "paper", "x": at, "y": 1.0, "yanchor": "bottom" })));
        }
        self.set("shapes", lines).set("annotations", names)
    }

    /// As plotly.js takes it; a number that is none is `null`, a gap.
    pub(crate) fn to_json(&self) -> String {
        #[derive(Serialize)]
        struct Whole<'a> {
            data: Vec<&'a Map<String, Value>>,
            layout: &'a Value,
            config: Value,
            #[serde(skip_serializing_if = "Option::is_none")]
            control: Option<&'a Control>,
        }
        let config = json!({
            "typesetMath": false,
            "displaylogo": false,
            "displayModeBar": "hover",
            "doubleClick": "reset+autosize",
            "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d", "toggleSpikelines"],
        });
        let data = self.traces.iter().map(|trace| &trace.attributes).collect();
        let whole = Whole { data, layout: &self.layout, config, control: self.control.as_ref() };
        serde_json::to_string(&whole).expect("numbers and texts are JSON")
    }
}

/// A name over a chart, at `place`.
pub(crate) fn label(name: impl Into<String>, place: Value) -> Value {
    let mut label = json!({ "showarrow": false, "text": name.into(), "font": { "size": 12, "color": MUTED } });
    if let (Value::Object(label), Value::Object(place)) = (&mut label, place) {
        label.extend(place);
    }
    label
}

/// Numbers at an axis are written out up to this power of ten: 10000, not 10k.
const LARGEST_PLAIN_EXPONENT: i32 = 5;

fn axis(title: &str) -> Value {
    json!({
        "title": { "text": title, "font": { "size": 13 } },
        "automargin": true,
        "gridcolor": "var(--grid)",
        "zeroline": false,
        "showline": true,
        "linecolor": RULE,
        "ticks": "outside",
        "tickcolor": RULE,
        "ticklen": 4,
        "exponentformat": "power",
        "minexponent": LARGEST_PLAIN_EXPONENT,
    })
}

/// Range from 0 to somewhat above `greatest`; from 0 to 1 where nothing is above zero.
pub(crate) fn from_zero(greatest: f64) -> [f64; 2] {
    if greatest > 0.0 && greatest.is_finite() { [0.0, greatest * 1.06] } else { [0.0, 1.0] }
}

/// The range from `low` to `high` and a little more on either side.
pub(crate) fn padded(low: f64, high: f64) -> [f64; 2] {
    let pad = 0.025 * (high - low).abs();
    [low - pad, high + pad]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_are_in_the_words_of_the_script() {
        let dots = Trace::points("dots", [1.0, f64::NAN], [0.5, 2.0], (PATH, "circle-open", 5)).at_once(false);
        let chart =
            Chart::new("id", "title").x("x, mm").x_logarithmic().add(dots).mark([("low", -1.0), ("high", 10.0)], "");
        let json: Value = serde_json::from_str(&chart.to_json()).unwrap();
        let trace = json!({ "type": "scatter", "name": "dots", "x": [1.0, null], "y": [0.5, 2.0], "mode": "markers",
            "visible": "legendonly", "marker": { "size": 5, "symbol": "circle-open", "color": PATH } });
        assert_eq!(json["data"][0], trace);
        assert_eq!(json["layout"]["xaxis"]["title"]["text"], "x, mm");
        assert_eq!(json["layout"]["shapes"].as_array().unwrap().len(), 1);
        assert_eq!(
            (&json["layout"]["shapes"][0]["x0"], &json["layout"]["annotations"][0]["x"]),
            (&json!(10.0), &json!(1.0))
        );
        assert_eq!(json["config"]["doubleClick"], "reset+autosize");
    }
}
