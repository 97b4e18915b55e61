//! Charts as data: traces and a layout in the words of plotly.js, which draws them in the page.
//!
//! Each structure holds those attributes of plotly.js that the reports use, serialised under plotly's names and left out where
//! they are not set; a method of the same name sets each. What they mean is in plotly's reference,
//! <https://plotly.com/javascript/reference/>. The script itself is in `assets`, with its licence, and goes into every page.

use std::io::Read;

use flate2::read::GzDecoder;
use serde::{Serialize, Serializer};
use serde_json::Value;

/// plotly.js 3.0.1, compressed.
const SCRIPT: &[u8] = include_bytes!("assets/plotly.min.js.gz");

/// plotly.js.
pub fn script() -> String {
    let mut script = String::new();
    let read = GzDecoder::new(SCRIPT).read_to_string(&mut script);
    read.expect("the script is part of the program");
    script
}

/// A structure of attributes that may be set, with a method for each; `name "key": type` where plotly's name is another.
macro_rules! attributes {
    ($($(#[$doc:meta])* $name:ident { $($field:ident $key:literal: $kind:ty),* $(,)? })*) => { $(
        $(#[$doc])*
        #[derive(Debug, Clone, Default, Serialize)]
        pub struct $name {
            $(#[serde(rename = $key, skip_serializing_if = "Option::is_none")] $field: Option<$kind>,)*
        }

        #[allow(missing_docs)]
        impl $name {
            pub fn new() -> Self {
                Self::default()
            }

            $(pub fn $field(mut self, $field: impl Into<$kind>) -> Self {
                self.$field = Some($field.into());
                self
            })*
        }
    )* };
}

/// What an attribute may say, and plotly's word for it.
macro_rules! words {
    ($($(#[$doc:meta])* $name:ident { $($variant:ident $word:literal),* $(,)? })*) => { $(
        $(#[$doc])*
        #[allow(missing_docs)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
        pub enum $name {
            $(#[serde(rename = $word)] $variant,)*
        }
    )* };
}

/// A chart: what is drawn, and how it is laid out.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Plot {
    data: Vec<Trace>,
    layout: Layout,
}

impl Plot {
    /// Without traces.
    pub fn new() -> Self {
        Self::default()
    }

    /// Draws `trace` over those before it.
    pub fn add_trace(&mut self, trace: Trace) {
        self.data.push(trace);
    }

    /// Lays the chart out.
    pub fn set_layout(&mut self, layout: Layout) {
        self.layout = layout;
    }

    /// As plotly.js takes it; a number that is none becomes `null`, a gap.
    pub fn to_json(&self) -> String {
        #[derive(Serialize)]
        struct WithConfiguration<'a> {
            #[serde(flatten)]
            plot: &'a Plot,
            config: Configuration,
        }
        let whole = WithConfiguration { plot: self, config: Configuration::default() };
        serde_json::to_string(&whole).expect("numbers and texts are JSON")
    }
}

/// How the reader may handle a chart.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Configuration {
    typeset_math: bool,
    #[serde(rename = "displaylogo")]
    display_logo: bool,
    display_mode_bar: &'static str,
    double_click: &'static str,
    mode_bar_buttons_to_remove: [&'static str; 4],
}

impl Default for Configuration {
    fn default() -> Self {
        Self {
            typeset_math: false,
            display_logo: false,
            display_mode_bar: "hover",
            double_click: "reset+autosize",
            mode_bar_buttons_to_remove: ["select2d", "lasso2d", "autoScale2d", "toggleSpikelines"],
        }
    }
}

/// What stands along an axis or at the points of a trace.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Data {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Numbers with gaps.
    WithGaps(Vec<Option<f64>>),
    /// Texts.
    Texts(Vec<String>),
    /// Rows of numbers, from below.
    Rows(Vec<Vec<f64>>),
    /// Rows of numbers with gaps, from below.
    RowsWithGaps(Vec<Vec<Option<f64>>>),
}

macro_rules! data_from {
    ($($kind:ty => $variant:ident),*) => { $(
        impl From<$kind> for Data {
            fn from(values: $kind) -> Self {
                Self::$variant(values)
            }
        }
    )* };
}

data_from!(Vec<f64> => Numbers, Vec<Option<f64>> => WithGaps, Vec<String> => Texts, Vec<Vec<f64>> => Rows, Vec<Vec<Option<f64>>> => RowsWithGaps);

/// One number for all points, or one for each.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Size {
    /// For all.
    All(i32),
    /// For each.
    Each(Vec<usize>),
}

impl From<i32> for Size {
    fn from(size: i32) -> Self {
        Self::All(size)
    }
}

impl From<Vec<usize>> for Size {
    fn from(sizes: Vec<usize>) -> Self {
        Self::Each(sizes)
    }
}

/// Whether a trace is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Visible {
    /// From the beginning.
    True,
    /// Not before a button asks for it.
    False,
    /// Not before its entry in the legend is chosen.
    LegendOnly,
}

impl Serialize for Visible {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::LegendOnly => serializer.serialize_str("legendonly"),
            shown => serializer.serialize_bool(*shown == Self::True),
        }
    }
}

words! {
    /// What kind of trace it is.
    TraceType { Scatter "scatter", Bar "bar", HeatMap "heatmap", Contour "contour", Surface "surface" }
    /// How points are shown.
    Mode { Lines "lines", Markers "markers", LinesMarkers "lines+markers", LinesMarkersText "lines+markers+text" }
    /// Of a line.
    DashType { Solid "solid", Dash "dash", Dot "dot", DashDot "dashdot" }
    /// Of a point.
    MarkerSymbol {
        Circle "circle", CircleOpen "circle-open", Cross "cross", CrossOpen "cross-open", Diamond "diamond",
        DiamondOpen "diamond-open", Square "square", SquareOpen "square-open", Star "star", TriangleDown "triangle-down",
        TriangleDownOpen "triangle-down-open", TriangleRightOpen "triangle-right-open", TriangleUp "triangle-up",
        TriangleUpOpen "triangle-up-open", X "x",
    }
    /// What of an area is filled.
    Fill { ToSelf "toself" }
    /// What is read at a point.
    HoverInfo { Skip "skip" }
    /// How points are found that are read.
    HoverMode { Closest "closest", XUnified "x unified" }
    /// What dragging does.
    DragMode { Zoom "zoom", Pan "pan", Turntable "turntable" }
    /// Where a text stands.
    Position { TopCenter "top center" }
    /// The side of a box that is placed.
    Anchor { Left "left", Bottom "bottom" }
    /// Of the legend's entries.
    Orientation { Horizontal "h" }
    /// Of an axis.
    AxisType { Log "log" }
    /// What of an axis gives way where a scale is fixed.
    AxisConstrain { Range "range" }
    /// How powers of ten are written.
    ExponentFormat { Power "power" }
    /// Where ticks point.
    TicksDirection { Outside "outside" }
    /// How bars of one place stand.
    BarMode { Group "group" }
    /// From low to high.
    ColorScale { Viridis "Viridis" }
    /// Of a shape.
    ShapeType { Line "line" }
    /// What a shape is drawn over or under.
    ShapeLayer { Below "below" }
    /// How the proportions of a space are fixed.
    AspectMode { Manual "manual" }
    /// Of the choice of what is shown.
    UpdateMenuType { Buttons "buttons" }
    /// In which buttons follow each other.
    UpdateMenuDirection { Right "right" }
    /// What a button does.
    ButtonMethod { Update "update" }
}

attributes! {
    /// Points, bars, colours or a surface from numbers.
    Trace {
        type_ "type": TraceType, name "name": String, x "x": Data, y "y": Data, z "z": Data, mode "mode": Mode, line "line": Line,
        marker "marker": Marker, error_y "error_y": ErrorBars, fill "fill": Fill, fill_color "fillcolor": String,
        opacity "opacity": f64, visible "visible": Visible, show_legend "showlegend": bool, legend_group "legendgroup": String,
        text_array "text": Vec<String>, text_position "textposition": Position, text_font "textfont": Font,
        custom_data "customdata": Data, hover_info "hoverinfo": HoverInfo, hover_template "hovertemplate": String,
        hover_text_array "hovertext": Vec<String>, hover_on_gaps "hoverongaps": bool, connect_gaps "connectgaps": bool,
        color_scale "colorscale": ColorScale, color_bar "colorbar": ColorBar, zmin "zmin": f64, zmax "zmax": f64, cmin "cmin": f64,
        cmax "cmax": f64, contours "contours": Contours, n_contours "ncontours": i32,
    }
    /// Of a trace.
    Line { color "color": String, width "width": f64, dash "dash": DashType, simplify "simplify": bool }
    /// Points of a trace.
    Marker { color "color": String, size "size": Size, symbol "symbol": MarkerSymbol }
    /// Half heights of error bars.
    ErrorBars { type_ "type": String, array "array": Vec<f64>, color "color": String, thickness "thickness": f64, width "width": f64 }
    /// Of a text.
    Font { family "family": String, size "size": i32, color "color": String }
    /// Of an axis or a colour bar.
    Title { text "text": String, font "font": Font }
    /// The scale of colours.
    ColorBar { title "title": Title, thickness "thickness": i32, x "x": f64 }
    /// Lines of equal values.
    Contours { show_labels "showlabels": bool, label_font "labelfont": Font }
    /// Everything about a chart but its traces.
    Layout {
        height "height": usize, margin "margin": Margin, font "font": Font, paper_background_color "paper_bgcolor": String,
        plot_background_color "plot_bgcolor": String, show_legend "showlegend": bool, legend "legend": Legend,
        hover_mode "hovermode": HoverMode, hover_label "hoverlabel": Label, drag_mode "dragmode": DragMode, mode_bar "modebar": ModeBar,
        bar_mode "barmode": BarMode, x_axis "xaxis": Axis, y_axis "yaxis": Axis, scene "scene": LayoutScene, shapes "shapes": Vec<Shape>,
        annotations "annotations": Vec<Annotation>, update_menus "updatemenus": Vec<UpdateMenu>,
    }
    /// Room around a chart, pixels.
    Margin { left "l": i32, right "r": i32, top "t": i32, bottom "b": i32 }
    /// Names of traces.
    Legend {
        orientation "orientation": Orientation, x "x": f64, x_anchor "xanchor": Anchor, item_width "itemwidth": i32,
        background_color "bgcolor": String, font "font": Font,
    }
    /// What is read at a point.
    Label { background_color "bgcolor": String, border_color "bordercolor": String }
    /// The buttons at the top.
    ModeBar { background_color "bgcolor": String, color "color": String, active_color "activecolor": String }
    /// An axis.
    Axis {
        title "title": Title, type_ "type": AxisType, range "range": Vec<f64>, auto_margin "automargin": bool, constrain "constrain": AxisConstrain,
        scale_anchor "scaleanchor": String, scale_ratio "scaleratio": f64, show_grid "showgrid": bool, grid_color "gridcolor": String,
        zero_line "zeroline": bool, show_line "showline": bool, line_color "linecolor": String, ticks "ticks": TicksDirection,
        tick_color "tickcolor": String, tick_length "ticklen": i32, tick_values "tickvals": Vec<f64>, tick_text "ticktext": Vec<String>,
        exponent_format "exponentformat": ExponentFormat, hover_format "hoverformat": String,
    }
    /// A line over the chart.
    Shape {
        shape_type "type": ShapeType, layer "layer": ShapeLayer, x_ref "xref": String, y_ref "yref": String, x0 "x0": f64, x1 "x1": f64,
        y0 "y0": f64, y1 "y1": f64, line "line": Line,
    }
    /// A text over the chart.
    Annotation {
        x_ref "xref": String, y_ref "yref": String, x "x": f64, y "y": f64, x_anchor "xanchor": Anchor, y_anchor "yanchor": Anchor,
        show_arrow "showarrow": bool, text "text": String, font "font": Font,
    }
    /// A space with three axes.
    LayoutScene {
        x_axis "xaxis": Axis, y_axis "yaxis": Axis, z_axis "zaxis": Axis, aspect_mode "aspectmode": AspectMode,
        aspect_ratio "aspectratio": Place, camera "camera": Camera, drag_mode "dragmode": DragMode,
    }
    /// From where a space is seen.
    Camera { center "center": Place, eye "eye": Place }
    /// A choice of what is shown.
    UpdateMenu {
        type_ "type": UpdateMenuType, direction "direction": UpdateMenuDirection, buttons "buttons": Vec<Button>,
        background_color "bgcolor": String, border_color "bordercolor": String, font "font": Font, pad "pad": Pad, x "x": f64,
        x_anchor "xanchor": Anchor, y "y": f64, y_anchor "yanchor": Anchor,
    }
    /// Room around buttons, pixels.
    Pad { top "t": i32, bottom "b": i32, left "l": i32 }
    /// One of them.
    Button { label "label": String, method "method": ButtonMethod, args "args": Value }
}

/// A point in space, or lengths along its axes.
#[derive(Debug, Clone, Serialize)]
pub struct Place {
    x: f64,
    y: f64,
    z: f64,
}

impl From<[f64; 3]> for Place {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

impl Trace {
    fn of(kind: TraceType, x: impl Into<Data>, y: impl Into<Data>) -> Self {
        Self::new().type_(kind).x(x).y(y)
    }

    /// Points.
    pub fn scatter(x: Vec<f64>, y: Vec<f64>) -> Self {
        Self::of(TraceType::Scatter, x, y)
    }

    /// A line with gaps where there is no number.
    pub fn lines_with_gaps(x: impl Into<Data>, y: Vec<Option<f64>>) -> Self {
        Self::of(TraceType::Scatter, x, y).mode(Mode::Lines)
    }

    /// Bars.
    pub fn bar(names: Vec<String>, heights: Vec<f64>) -> Self {
        Self::of(TraceType::Bar, names, heights)
    }

    /// Colours.
    pub fn heat_map(x: Vec<f64>, y: Vec<f64>, z: impl Into<Data>) -> Self {
        Self::of(TraceType::HeatMap, x, y).z(z)
    }

    /// Lines of equal values.
    pub fn contour(x: Vec<f64>, y: Vec<f64>, z: impl Into<Data>) -> Self {
        Self::of(TraceType::Contour, x, y).z(z)
    }

    /// A surface.
    pub fn surface(x: Vec<f64>, y: Vec<f64>, z: Vec<Vec<f64>>) -> Self {
        Self::of(TraceType::Surface, x, y).z(z)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn the_script_is_whole() {
        let script = script();
        assert!(script.contains("plotly.js v3.0.1") && script.trim_end().ends_with([';', '}']), "cut short");
        assert!(!script.contains("<script"));
    }

    #[test]
    fn charts_are_in_the_words_of_the_script() {
        let mut plot = Plot::new();
        let dots = Marker::new().size(5).symbol(MarkerSymbol::CircleOpen);
        plot.add_trace(Trace::scatter(vec![1.0, f64::NAN], vec![0.5, 2.0]).marker(dots).visible(Visible::LegendOnly));
        plot.set_layout(Layout::new().height(300_usize).x_axis(Axis::new().range([0.0, 1.0])));
        let json: Value = serde_json::from_str(&plot.to_json()).unwrap();
        let trace = json!({ "type": "scatter", "x": [1.0, null], "y": [0.5, 2.0], "visible": "legendonly",
            "marker": { "size": 5, "symbol": "circle-open" } });
        assert_eq!(json["data"][0], trace);
        assert_eq!(json["layout"], json!({ "height": 300, "xaxis": { "range": [0.0, 1.0] } }));
        assert_eq!(json["config"]["doubleClick"], "reset+autosize");
    }
}
