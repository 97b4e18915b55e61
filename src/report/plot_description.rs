//! A [`Chart`] in the words of plotly.js, the plot script of the pages: <https://plotly.com/javascript/reference/>.

use serde_json::{Value, json};

use super::chart::{
    Axis, BarPlaces, Bars, Chart, ColourScale, Curve, Drawn, Field, INK, Label, MUTED, Mark, Shown, Surface, Trace,
};

const RULE: &str = "var(--rule)";
const PAPER: &str = "var(--paper)";
const NOTHING: &str = "rgba(0,0,0,0)";
/// Numbers at an axis are written out up to this power of ten: 10000, not 10k.
const LARGEST_PLAIN_EXPONENT: i32 = 5;

/// What the page's script draws; a number that is none is `null`, a gap.
pub(super) fn of(chart: &Chart) -> Value {
    let mut whole = json!({
        "data": chart.traces.iter().map(trace).collect::<Vec<_>>(),
        "layout": layout(chart),
        "config": {
            "typesetMath": false,
            "displaylogo": false,
            "displayModeBar": "hover",
            "doubleClick": "reset+autosize",
            "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d", "toggleSpikelines"],
        },
    });
    if let Some(control) = &chart.control {
        whole["control"] = serde_json::to_value(control).expect("numbers and texts are JSON");
    }
    whole
}

/// `into` with all of `more` that is not null.
fn with(mut into: Value, more: Value) -> Value {
    if let (Value::Object(into), Value::Object(more)) = (&mut into, more) {
        into.extend(more.into_iter().filter(|(_, value)| !value.is_null()));
    }
    into
}

fn trace(trace: &Trace) -> Value {
    let common = json!({
        "name": (!trace.name.is_empty()).then_some(&trace.name),
        "hovertemplate": trace.hover,
        "hoverinfo": trace.is_silent.then_some("skip"),
        "text": (!trace.texts.is_empty()).then_some(&trace.texts),
        "customdata": (!trace.further.is_empty()).then_some(&trace.further),
        "showlegend": (!trace.is_listed).then_some(false),
        "legendgroup": trace.group,
        "visible": match trace.shown {
            Shown::FromTheBeginning => json!(true),
            Shown::OnRequest => json!("legendonly"),
            Shown::Hidden => json!(false),
        },
        "opacity": trace.opacity,
    });
    with(
        match &trace.drawn {
            Drawn::Curve(of) => curve(of),
            Drawn::Bars(of) => bars(of),
            Drawn::Cells(of) => with(field(of), json!({ "type": "heatmap" })),
            Drawn::Contours(of) => with(
                field(of),
                json!({
                    "type": "contour", "ncontours": 16, "connectgaps": false,
                    "contours": { "showlabels": true, "labelfont": { "size": 11, "color": "#ffffff" } },
                }),
            ),
            Drawn::Surface(of) => surface(of),
        },
        common,
    )
}

fn curve(of: &Curve) -> Value {
    let modes = [
        of.line.is_some().then_some("lines"),
        of.signs.is_some().then_some("markers"),
        of.is_lettered.then_some("text"),
    ];
    let mode = modes.into_iter().flatten().collect::<Vec<_>>().join("+");
    let mut trace = json!({ "type": "scatter", "x": of.x, "y": of.y, "mode": mode });
    if let Some(line) = &of.line {
        // Through all its points: plotly would leave some out, which puts corners into smooth curves.
        trace["line"] = json!({ "color": line.colour, "width": line.width_px, "dash": line.dash, "simplify": false });
    }
    if let Some(signs) = &of.signs {
        trace["marker"] = json!({ "color": signs.colour, "symbol": signs.symbol, "size": signs.size_px });
        if let [size] = signs.size_px[..] {
            trace["marker"]["size"] = size.into();
        }
    }
    if let Some(colour) = &of.fill {
        trace = with(trace, json!({ "fill": "toself", "fillcolor": colour }));
    }
    if of.is_lettered {
        let colour = of.line.as_ref().map(|line| &line.colour);
        trace = with(trace, json!({ "textposition": "top center", "textfont": { "size": 15, "color": colour } }));
    }
    if !of.uncertainty.is_empty() {
        let colour = of.signs.as_ref().map(|signs| &signs.colour);
        let bars = json!({ "type": "data", "array": of.uncertainty, "color": colour, "thickness": 1.2, "width": 4.0 });
        trace["error_y"] = bars;
    }
    trace
}

fn bars(of: &Bars) -> Value {
    let (places, width) = match &of.places {
        BarPlaces::Named(names) => (json!(names), Value::Null),
        BarPlaces::At { middles, width } => (json!(middles), json!(width)),
    };
    let (along, across, error) = if of.is_horizontal { ("y", "x", "error_x") } else { ("x", "y", "error_y") };
    let intervals = of.interval.as_ref().map(|[below, above]| {
        json!({ "type": "data", "symmetric": false, "array": above, "arrayminus": below, "thickness": 1, "color": INK })
    });
    let trace = json!({ "type": "bar", along: places, across: of.length, "marker": { "color": of.colour } });
    let orientation = of.is_horizontal.then_some("h");
    with(trace, json!({ "width": width, error: intervals, "orientation": orientation }))
}

fn field(of: &Field) -> Value {
    let [low, high] = of.scale.range.map_or([None; 2], |range| range.map(Some));
    let trace = json!({ "x": of.x, "y": of.y, "z": of.values, "hoverongaps": false });
    with(with(trace, colours(&of.scale)), json!({ "zmin": low, "zmax": high }))
}

fn colours(scale: &ColourScale) -> Value {
    // With empty lines below, so that the unit stands clear of a number at the very top.
    let title = json!({ "text": format!("{}<br>\u{a0}<br>\u{a0}", scale.unit), "font": { "size": 12 } });
    let bar = json!({
        "title": title,
        "thickness": 12,
        "exponentformat": "power",
        "minexponent": LARGEST_PLAIN_EXPONENT,
    });
    json!({ "colorscale": "Viridis", "colorbar": with(bar, json!({ "x": scale.at })) })
}

fn surface(of: &Surface) -> Value {
    let [low, high] = of.field.scale.range.map_or([None; 2], |range| range.map(Some));
    let trace = json!({
        "type": "surface", "x": of.field.x, "y": of.field.y, "z": of.height, "surfacecolor": of.field.values,
    });
    with(with(trace, colours(&of.field.scale)), json!({ "cmin": low, "cmax": high }))
}

fn layout(chart: &Chart) -> Value {
    let layout = json!({
        "height": chart.height_px,
        "paper_bgcolor": PAPER,
        "plot_bgcolor": PAPER,
        "font": { "family": "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif", "size": 13, "color": INK },
        "margin": { "l": 56, "r": 12, "t": 28, "b": 48 },
        "separators": ".\u{202f}",
        "hovermode": if chart.reads_nearest { "closest" } else { "x unified" },
        "hoverlabel": { "bgcolor": PAPER, "bordercolor": RULE },
        "modebar": { "bgcolor": NOTHING, "color": MUTED, "activecolor": INK },
        "showlegend": chart.has_legend,
        "legend": {
            "orientation": "h", "x": 0.0, "xanchor": "left", "itemwidth": 34, "bgcolor": NOTHING, "font": { "size": 12 },
        },
    });
    if chart.traces.iter().any(Trace::is_surface) {
        return with(layout, scene(chart));
    }
    let marks = || chart.marks.iter().filter(|mark| mark.x.is_finite() && (!chart.x.is_logarithmic || mark.x > 0.0));
    let names = marks().map(|mark| mark_name(mark, &chart.x)).chain(chart.labels.iter().map(label));
    with(
        layout,
        json!({
            "xaxis": axis(&chart.x, chart.is_to_scale, None),
            "yaxis": axis(&chart.y, chart.is_to_scale, Some("x")),
            "dragmode": chart.is_dragged.then_some("pan"),
            "shapes": marks().map(mark_line).collect::<Vec<_>>(),
            "annotations": names.collect::<Vec<_>>(),
        }),
    )
}

fn axis(of: &Axis, is_to_scale: bool, anchor: Option<&str>) -> Value {
    let exponent = |value: f64| if of.is_logarithmic { value.log10() } else { value };
    let (values, words): (Vec<f64>, Vec<&str>) = of.ticks.iter().map(|(value, word)| (*value, word.as_str())).unzip();
    let axis = json!({
        "title": { "text": of.title, "font": { "size": 13 } },
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
    });
    with(
        axis,
        json!({
            "range": of.range.map(|range| range.map(exponent)),
            "type": of.is_logarithmic.then_some("log"),
            "showgrid": (!of.has_grid).then_some(false),
            "hoverformat": of.format,
            "tickvals": (!values.is_empty()).then_some(values),
            "ticktext": (!words.is_empty()).then_some(words),
            "constrain": is_to_scale.then_some("range"),
            "scaleanchor": anchor.filter(|_| is_to_scale),
            "scaleratio": anchor.filter(|_| is_to_scale).map(|_| 1.0),
        }),
    )
}

fn mark_line(mark: &Mark) -> Value {
    let (width, dash) = if mark.is_strong { (1.4, "dashdot") } else { (1.0, "dot") };
    json!({
        "type": "line", "layer": "below", "xref": "x", "yref": "paper", "x0": mark.x, "x1": mark.x, "y0": 0.0, "y1": 1.0,
        "line": { "color": MUTED, "width": width, "dash": dash },
    })
}

/// On a logarithmic axis plotly takes the place of a line as it is and that of its name as a logarithm.
fn mark_name(mark: &Mark, axis: &Axis) -> Value {
    let at = if axis.is_logarithmic { mark.x.log10() } else { mark.x };
    named(&mark.name, json!({ "xref": "x", "yref": "paper", "x": at, "y": 1.0, "yanchor": "bottom" }))
}

fn label(of: &Label) -> Value {
    match of {
        Label::Beside { name, y } => {
            named(name, json!({ "xref": "paper", "yref": "y", "x": 1.005, "y": y, "xanchor": "left" }))
        }
        Label::Above { name, at: [x, y] } => {
            named(name, json!({ "xref": "x", "yref": "y", "x": x, "y": y, "yanchor": "bottom" }))
        }
    }
}

fn named(name: &str, place: Value) -> Value {
    with(json!({ "showarrow": false, "text": name, "font": { "size": 12, "color": MUTED } }), place)
}

/// Surfaces in space, of which buttons choose one.
fn scene(chart: &Chart) -> Value {
    let surfaces = chart.traces.iter().filter_map(|trace| match &trace.drawn {
        Drawn::Surface(surface) => Some(&surface.view),
        _ => None,
    });
    let views: Vec<_> = surfaces.collect();
    let axis = |title: &str| json!({ "title": { "text": title, "font": { "size": 12 } }, "gridcolor": RULE, "zeroline": false });
    let [x, y, z] = views[0].drawn;
    let buttons = views.iter().enumerate().map(|(chosen, view)| {
        let visible: Vec<bool> = (0..views.len()).map(|i| i == chosen).collect();
        let layout = json!({ "scene.zaxis.title.text": view.height_title, "scene.zaxis.range": view.height_range });
        json!({ "label": view.label, "method": "update", "args": [{ "visible": visible }, layout] })
    });
    let height = json!({ "range": views[0].height_range, "nticks": 4 });
    json!({
        "margin": { "l": 4, "r": 4, "t": 36, "b": 8 },
        "scene": {
            "xaxis": axis(&chart.x.title),
            "yaxis": axis(&chart.y.title),
            "zaxis": with(axis(views[0].height_title), height),
            "aspectmode": "manual",
            "aspectratio": { "x": x, "y": y, "z": z },
            "camera": { "center": { "x": 0.0, "y": 0.0, "z": -0.15 }, "eye": { "x": -0.95, "y": -1.55, "z": 1.5 } },
            "dragmode": "turntable",
        },
        "updatemenus": [{
            "type": "buttons",
            "direction": "right",
            "buttons": buttons.collect::<Vec<_>>(),
            "bgcolor": "var(--panel)",
            "bordercolor": RULE,
            "font": { "size": 12, "color": INK },
            "pad": { "t": 0, "b": 0, "l": 0 },
            "x": 0.0,
            "xanchor": "left",
            "y": 1.0,
            "yanchor": "bottom",
        }],
    })
}
