//! A chart as SVG: frame, grid, curves, maps, bars, marks and legend, with the names and ranges that the page gives them.

use serde_json::{Value, json};

use super::axis::Axis;
use super::palette::{colour, of_scale};
use crate::reference::statistics::extent;
use crate::report::chart::{Chart, INK, MUTED, Trace, TraceKind};

/// Widths of figures: over half of a page, over a whole one.
const WIDTH_PX: [f64; 2] = [640.0, 1080.0];
const LEFT: f64 = 76.0;
const RIGHT: f64 = 18.0;
/// With a scale of colours.
const RIGHT_OF_MAP: f64 = 104.0;
const TOP: f64 = 62.0;
/// Below the plot, for ticks and the axis's name.
const BELOW: f64 = 54.0;
const LEGEND_ROW: f64 = 20.0;
const LEGEND_SIGN: f64 = 30.0;
/// Mean width of a character over the size of the font.
const CHARACTER: f64 = 0.6;
/// Colours of a map.
const LEVELS: usize = 256;

/// The whole drawing.
pub(super) fn svg(chart: &Chart) -> String {
    Drawing::new(chart).finish()
}

struct Drawing<'a> {
    chart: &'a Chart,
    width: f64,
    height: f64,
    /// Left, top, right and bottom of the plot.
    frame: [f64; 4],
    x: Axis,
    y: Axis,
    legend: Vec<Vec<&'a Trace>>,
    text: String,
}

fn is_drawn(trace: &Trace) -> bool {
    trace.get("visible").is_null() || trace.get("visible") == true
}

fn numbers(values: &Value) -> impl Iterator<Item = f64> + '_ {
    values.as_array().into_iter().flatten().map(|value| value.as_f64().unwrap_or(f64::NAN))
}

fn name(trace: &Trace) -> &str {
    trace.get("name").as_str().unwrap_or_default()
}

fn width_of(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * CHARACTER * size
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn dash(line: &Value) -> &'static str {
    match line["dash"].as_str() {
        Some("dash") => " stroke-dasharray=\"9 6\"",
        Some("dot") => " stroke-dasharray=\"2 4\"",
        Some("dashdot") => " stroke-dasharray=\"9 4 2 4\"",
        _ => "",
    }
}

fn stroke(line: &Value) -> String {
    let paint = colour(line["color"].as_str().unwrap_or(INK));
    format!("stroke=\"{paint}\" stroke-width=\"{}\"{}", line["width"].as_f64().unwrap_or(2.0), dash(line))
}

impl<'a> Drawing<'a> {
    fn new(chart: &'a Chart) -> Self {
        let layout = chart.layout();
        let width = WIDTH_PX[usize::from(chart.is_wide)];
        let drawn: Vec<&Trace> = chart.traces().filter(|trace| is_drawn(trace)).collect();
        let has_map = drawn.iter().any(|trace| trace.kind == TraceKind::HeatMap);
        let has_bars = drawn.iter().any(|trace| trace.kind == TraceKind::Bar);
        let right = width - if has_map { RIGHT_OF_MAP } else { RIGHT };
        let legend = if layout["showlegend"] == false { Vec::new() } else { legend_rows(&drawn, right - LEFT) };
        let bottom = layout["height"].as_f64().unwrap_or(380.0) - BELOW + 20.0;
        let height = bottom + BELOW + legend.len() as f64 * LEGEND_ROW;
        let mut categories: Vec<String> = Vec::new();
        for name in
            drawn.iter().flat_map(|trace| trace.get("x").as_array().into_iter().flatten()).filter_map(Value::as_str)
        {
            if !categories.iter().any(|known| known == name) {
                categories.push(name.to_owned());
            }
        }
        let values = |key| drawn.iter().flat_map(move |trace| numbers(trace.get(key)));
        let from_zero = has_bars.then_some(0.0);
        let x = Axis::new(&layout["xaxis"], values("x"), categories, has_map).placed(LEFT, right);
        let y = Axis::new(&layout["yaxis"], values("y").chain(from_zero), Vec::new(), has_map).placed(bottom, TOP);
        let (x, y) = match layout["yaxis"]["scaleanchor"] == "x" {
            true => {
                let unit = x.unit_px().min(y.unit_px());
                (x.with_unit(unit), y.with_unit(unit))
            }
            false => (x, y),
        };
        Self { chart, width, height, frame: [LEFT, TOP, right, bottom], x, y, legend, text: String::new() }
    }

    fn add(&mut self, text: impl AsRef<str>) {
        self.text.push_str(text.as_ref());
        self.text.push('\n');
    }

    fn words(&mut self, text: &str, [x, y]: [f64; 2], anchor: &str, size: f64, paint: &str) {
        let (text, paint) = (escaped(text), colour(paint));
        self.add(format!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" font-size=\"{size}\" fill=\"{paint}\">{text}</text>"
        ));
    }

    fn finish(mut self) -> String {
        let (width, height) = (self.width, self.height);
        let [left, top, right, bottom] = self.frame;
        let (across, up) = (right - left, bottom - top);
        self.add(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"DejaVu Sans, Verdana, sans-serif\">"
        ));
        self.add(format!("<title>{}</title>", escaped(&self.chart.title)));
        self.add(format!("<rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>", colour("var(--paper)")));
        self.add(format!(
            "<clipPath id=\"plot\"><rect x=\"{left}\" y=\"{top}\" width=\"{across}\" height=\"{up}\"/></clipPath>"
        ));
        let chart = self.chart;
        self.words(&chart.title, [left, 24.0], "start", 16.0, INK);
        self.axes();
        self.marks();
        self.add("<g clip-path=\"url(#plot)\" stroke-linejoin=\"round\">");
        self.bars();
        for trace in chart.traces().filter(|trace| is_drawn(trace)) {
            match trace.kind {
                TraceKind::Scatter => self.curve(trace),
                TraceKind::HeatMap => self.map(trace),
                TraceKind::Bar | TraceKind::Contour | TraceKind::Surface => {}
            }
        }
        self.add("</g>");
        let frame = colour("var(--rule)");
        self.add(format!("<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"{frame}\"/>"));
        self.annotations();
        self.entries();
        self.add("</svg>");
        self.text
    }

    fn axes(&mut self) {
        let [left, top, right, bottom] = self.frame;
        let (grid, rule) = (colour("var(--grid)"), colour("var(--rule)"));
        for (x, label) in self.x.ticks(80.0) {
            if self.x.has_grid && self.x.categories.is_empty() {
                self.add(format!("<path d=\"M{x:.2} {top}V{bottom}\" stroke=\"{grid}\"/>"));
            }
            self.add(format!("<path d=\"M{x:.2} {bottom}v4\" stroke=\"{rule}\"/>"));
            self.words(&label, [x, bottom + 18.0], "middle", 12.0, INK);
        }
        for (y, label) in self.y.ticks(48.0) {
            if self.y.has_grid {
                self.add(format!("<path d=\"M{left} {y:.2}H{right}\" stroke=\"{grid}\"/>"));
            }
            self.add(format!("<path d=\"M{left} {y:.2}h-4\" stroke=\"{rule}\"/>"));
            self.words(&label, [left - 8.0, y + 4.0], "end", 12.0, INK);
        }
        let (x_title, y_title) = (self.x.title.clone(), self.y.title.clone());
        self.words(&x_title, [left.midpoint(right), bottom + 38.0], "middle", 13.0, INK);
        self.add(format!("<g transform=\"translate(18 {:.2}) rotate(-90)\">", top.midpoint(bottom)));
        self.words(&y_title, [0.0, 0.0], "middle", 13.0, INK);
        self.add("</g>");
    }

    /// The vertical lines at named places.
    fn marks(&mut self) {
        let [_, top, _, bottom] = self.frame;
        for shape in self.chart.layout()["shapes"].as_array().into_iter().flatten() {
            let x = self.x.at(shape["x0"].as_f64().unwrap_or(f64::NAN));
            if x.is_finite() {
                self.add(format!("<path d=\"M{x:.2} {top}V{bottom}\" {}/>", stroke(&shape["line"])));
            }
        }
    }

    fn annotations(&mut self) {
        for note in self.chart.layout()["annotations"].as_array().into_iter().flatten() {
            let place = |axis: &Axis, key: &str, reference: &str| {
                let value = note[key].as_f64().unwrap_or(f64::NAN);
                if note[reference] == "paper" { axis.at_share(value) } else { axis.at_exponent(value) }
            };
            let (x, y) = (place(&self.x, "x", "xref"), place(&self.y, "y", "yref"));
            let [left, top, right, bottom] = self.frame;
            let is_inside = (left - 1.0..=right + 40.0).contains(&x) && (top - 1.0..=bottom + 1.0).contains(&y);
            if !is_inside {
                continue;
            }
            let size = note["font"]["size"].as_f64().unwrap_or(12.0);
            let anchor = match note["xanchor"].as_str() {
                Some("left") => "start",
                Some("right") => "end",
                _ => "middle",
            };
            let below = match note["yanchor"].as_str() {
                Some("bottom") => -4.0,
                Some("top") => size,
                _ => 0.35 * size,
            };
            let text = note["text"].as_str().unwrap_or_default();
            self.words(text, [x, y + below], anchor, size, note["font"]["color"].as_str().unwrap_or(MUTED));
        }
    }

    fn points(&self, trace: &Trace) -> Vec<[f64; 2]> {
        numbers(trace.get("x")).zip(numbers(trace.get("y"))).map(|(x, y)| [self.x.at(x), self.y.at(y)]).collect()
    }

    fn curve(&mut self, trace: &Trace) {
        let points = self.points(trace);
        let mode = trace.get("mode").as_str().unwrap_or("lines");
        let opacity = trace.get("opacity").as_f64().unwrap_or(1.0);
        self.add(format!("<g opacity=\"{opacity}\">"));
        if mode.contains("lines") {
            let is_gap = |point: &[f64; 2]| !point.iter().all(|value| value.is_finite());
            let piece = |piece: &[[f64; 2]]| -> String {
                let places: Vec<String> = piece.iter().map(|[x, y]| format!("{x:.2} {y:.2}")).collect();
                format!("M{}", places.join("L"))
            };
            let path: String = points.split(is_gap).filter(|piece| !piece.is_empty()).map(piece).collect();
            let fill = match trace.get("fill").is_null() {
                true => "none".to_owned(),
                false => colour(trace.get("fillcolor").as_str().unwrap_or("none")),
            };
            self.add(format!("<path d=\"{path}\" fill=\"{fill}\" {}/>", stroke(trace.get("line"))));
        }
        if mode.contains("markers") {
            for &[x, y] in points.iter().filter(|point| point.iter().all(|value| value.is_finite())) {
                self.sign(trace, [x, y]);
            }
        }
        if mode.contains("text") {
            let font = trace.get("textfont");
            let (size, paint) = (font["size"].as_f64().unwrap_or(12.0), font["color"].as_str().unwrap_or(INK));
            for ([x, y], text) in points.iter().zip(trace.get("text").as_array().into_iter().flatten()) {
                self.words(text.as_str().unwrap_or_default(), [*x, y - 8.0], "middle", size, paint);
            }
        }
        self.add("</g>");
    }

    /// The sign of a point, in the colour of the line where it has none of its own.
    fn sign(&mut self, trace: &Trace, [x, y]: [f64; 2]) {
        let marker = trace.get("marker");
        let own = marker["color"].as_str().or(trace.get("line")["color"].as_str());
        let paint = colour(own.unwrap_or(INK));
        let half = 0.5 * marker["size"].as_f64().unwrap_or(6.0);
        let (symbol, is_open) = match marker["symbol"].as_str().unwrap_or("circle") {
            symbol if symbol.ends_with("-open") => (symbol.trim_end_matches("-open"), true),
            symbol => (symbol, false),
        };
        let filled = match is_open {
            true => format!("fill=\"none\" stroke=\"{paint}\" stroke-width=\"1.5\""),
            false => format!("fill=\"{paint}\""),
        };
        self.add(match symbol {
            "square" => {
                let side = 2.0 * half;
                let (x, y) = (x - half, y - half);
                format!("<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{side}\" height=\"{side}\" {filled}/>")
            }
            "diamond" => format!("<path d=\"M{x:.2} {:.2}l{half} {half}l-{half} {half}l-{half} -{half}z\" {filled}/>", y - half),
            "x" => {
                let side = 2.0 * half;
                let (x, y) = (x - half, y - half);
                format!(
                    "<path d=\"M{x:.2} {y:.2}l{side} {side}m0 -{side}l-{side} {side}\" stroke=\"{paint}\" stroke-width=\"1.5\"/>"
                )
            }
            _ => format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{half}\" {filled}/>"),
        });
    }

    /// Bars of one category side by side.
    fn bars(&mut self) {
        let chart = self.chart;
        let all: Vec<&Trace> = chart.traces().filter(|trace| trace.kind == TraceKind::Bar && is_drawn(trace)).collect();
        let width = 0.8 * self.x.unit_px() / all.len().max(1) as f64;
        let zero = self.y.at(0.0);
        for (number, trace) in all.iter().enumerate() {
            let paint = colour(trace.get("marker")["color"].as_str().unwrap_or(INK));
            let names = trace.get("x").as_array().into_iter().flatten();
            for (name, height) in names.zip(numbers(trace.get("y"))) {
                let category = self.x.categories.iter().position(|known| Some(known.as_str()) == name.as_str());
                let (Some(category), true) = (category, height.is_finite()) else { continue };
                let from = self.x.at_exponent(category as f64) + (number as f64 - 0.5 * all.len() as f64) * width;
                let at = self.y.at(height);
                self.add(format!(
                    "<rect x=\"{from:.2}\" y=\"{:.2}\" width=\"{width:.2}\" height=\"{:.2}\" fill=\"{paint}\"/>",
                    at.min(zero),
                    (at - zero).abs()
                ));
            }
        }
    }

    /// Cells of one colour as one path, and the scale of colours beside the plot.
    fn map(&mut self, trace: &Trace) {
        let x: Vec<f64> = numbers(trace.get("x")).map(|x| self.x.at(x)).collect();
        let y: Vec<f64> = numbers(trace.get("y")).map(|y| self.y.at(y)).collect();
        let rows: Vec<Vec<f64>> =
            trace.get("z").as_array().into_iter().flatten().map(|row| numbers(row).collect()).collect();
        let [least, greatest] = extent(rows.iter().flatten().copied().filter(|value| value.is_finite()));
        let low = trace.get("zmin").as_f64().unwrap_or(least);
        let high = trace.get("zmax").as_f64().unwrap_or(greatest);
        let mut paths = vec![String::new(); LEVELS];
        for (row, edges) in rows.iter().zip(y.windows(2)) {
            for (value, sides) in row.iter().zip(x.windows(2)).filter(|(value, _)| value.is_finite()) {
                let share = if high > low { ((value - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
                let path = &mut paths[(share * (LEVELS - 1) as f64).round() as usize];
                let (width, height) = (sides[1] - sides[0], edges[1] - edges[0]);
                path.push_str(&format!("M{:.1} {:.1}h{width:.1}v{height:.1}h{:.1}z", sides[0], edges[0], -width));
            }
        }
        self.add("<g shape-rendering=\"crispEdges\">");
        for (level, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
            let paint = of_scale(level as f64 / (LEVELS - 1) as f64);
            self.add(format!("<path d=\"{path}\" fill=\"{paint}\" stroke=\"{paint}\" stroke-width=\"0.3\"/>"));
        }
        self.add("</g></g>");
        self.colour_scale(
            [low, high],
            trace.get("colorbar")["title"]["text"].as_str().unwrap_or_default().trim_end_matches("<br>\u{a0}"),
        );
        self.add("<g clip-path=\"url(#plot)\" stroke-linejoin=\"round\">");
    }

    fn colour_scale(&mut self, range: [f64; 2], unit: &str) {
        const STEPS: usize = 64;
        let [_, top, right, bottom] = self.frame;
        let (left, step) = (right + 26.0, (bottom - top) / STEPS as f64);
        for i in 0..STEPS {
            let (y, paint) = (bottom - (i + 1) as f64 * step, of_scale((i as f64 + 0.5) / STEPS as f64));
            let height = step + 0.5;
            self.add(format!("<rect x=\"{left}\" y=\"{y:.2}\" width=\"14\" height=\"{height:.2}\" fill=\"{paint}\"/>"));
        }
        let axis = Axis::new(&json!({ "range": range }), std::iter::empty(), Vec::new(), true).placed(bottom, top);
        for (y, label) in axis.ticks(48.0) {
            self.words(&label, [left + 19.0, y + 4.0], "start", 12.0, INK);
        }
        self.words(unit, [left, top - 8.0], "start", 12.0, INK);
    }

    fn entries(&mut self) {
        let below = self.frame[3] + BELOW;
        for (row, entries) in std::mem::take(&mut self.legend).into_iter().enumerate() {
            let y = below + row as f64 * LEGEND_ROW + 4.0;
            let mut x = self.frame[0];
            for trace in entries {
                self.legend_sign(trace, [x, y]);
                self.words(name(trace), [x + LEGEND_SIGN + 4.0, y + 4.0], "start", 12.0, INK);
                x += entry_width(trace);
            }
        }
    }

    fn legend_sign(&mut self, trace: &Trace, [x, y]: [f64; 2]) {
        let mode = trace.get("mode").as_str().unwrap_or_default();
        if trace.kind == TraceKind::Bar {
            let paint = colour(trace.get("marker")["color"].as_str().unwrap_or(INK));
            self.add(format!(
                "<rect x=\"{}\" y=\"{}\" width=\"18\" height=\"10\" fill=\"{paint}\"/>",
                x + 6.0,
                y - 5.0
            ));
        }
        if mode.contains("lines") {
            self.add(format!("<path d=\"M{x:.2} {y:.2}h{LEGEND_SIGN}\" fill=\"none\" {}/>", stroke(trace.get("line"))));
        }
        if mode.contains("markers") {
            self.sign(trace, [x + 0.5 * LEGEND_SIGN, y]);
        }
    }
}

fn entry_width(trace: &Trace) -> f64 {
    LEGEND_SIGN + 22.0 + width_of(name(trace), 12.0)
}

/// The traces that the legend names, in rows as wide as there is room.
fn legend_rows<'a>(drawn: &[&'a Trace], room: f64) -> Vec<Vec<&'a Trace>> {
    let (mut rows, mut used) = (Vec::<Vec<&Trace>>::new(), f64::INFINITY);
    let listed = |trace: &&&Trace| trace.get("showlegend") != false && trace.kind != TraceKind::HeatMap;
    for &trace in drawn.iter().filter(listed) {
        let width = entry_width(trace);
        if used + width > room {
            rows.push(Vec::new());
            used = 0.0;
        }
        used += width;
        if let Some(row) = rows.last_mut() {
            row.push(trace);
        }
    }
    rows
}
