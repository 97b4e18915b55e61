//! What a chart shows: curves, bars, fields of values and surfaces, each a [`Trace`] with its name and what is read at its points.

use serde::Serialize;

use super::colour::INK;
use super::html::number::plotted;

/// How a line is dashed.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Dash {
    Solid,
    #[serde(rename = "dash")]
    Dashed,
    Dot,
    #[serde(rename = "dashdot")]
    Mixed,
}

/// Values of a field, row by row upwards.
pub type Rows = Vec<Vec<f64>>;

/// Lines and points.
#[derive(Debug, Clone, Default)]
pub struct Curve {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub line: Option<Line>,
    pub signs: Option<Signs>,
    /// Colour of the area within the line.
    pub fill: Option<String>,
    /// Whether the texts of its points stand above them.
    pub is_lettered: bool,
    /// Half the length of a bar through each point; empty where there is none.
    pub uncertainty: Vec<f64>,
}

#[derive(Debug, Clone)]
pub struct Line {
    pub colour: String,
    pub width_px: f64,
    pub dash: Dash,
}

/// The signs of points.
#[derive(Debug, Clone)]
pub struct Signs {
    pub colour: String,
    /// `circle`, `square`, `diamond`, `triangle-up`, `-down` or `-right`, `cross`, `x` or `star`; with `-open` an outline, with `-dot` a dot in
    /// its middle.
    pub symbol: String,
    /// One for all points, or one for each.
    pub size_px: Vec<f64>,
}

#[derive(Debug, Clone)]
pub struct Bars {
    pub places: BarPlaces,
    pub length: Vec<f64>,
    pub colour: String,
    /// Bars go from left to right.
    pub is_horizontal: bool,
    /// Reach below and above the end of each bar.
    pub interval: Option<[Vec<f64>; 2]>,
}

/// Where bars stand on their axis.
#[derive(Debug, Clone)]
pub enum BarPlaces {
    Named(Vec<String>),
    At { middles: Vec<f64>, width: f64 },
}

/// Values over cells or points of a raster, as colours.
#[derive(Debug, Clone)]
pub struct Field {
    /// Edges of the cells, or their middles; of contours the places of the values.
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub values: Rows,
    pub scale: ColourScale,
}

/// Colours of values, beside the chart.
#[derive(Debug, Clone)]
pub struct ColourScale {
    pub unit: String,
    /// Values of the first and the last colour; otherwise the least and the greatest.
    pub range: Option<[f64; 2]>,
}

/// A field as heights over a plane, to be turned.
#[derive(Debug, Clone)]
pub struct Surface {
    pub field: Field,
    /// Height of a value of 1: negative where values are depths.
    pub rise: f64,
    pub view: View,
}

/// How a surface is chosen and what its heights are.
#[derive(Debug, Clone, Serialize)]
pub struct View {
    /// On its button.
    pub label: &'static str,
    pub height_title: &'static str,
    pub height_range: [f64; 2],
    /// Lengths of width, depth and height as drawn.
    pub drawn: [f64; 3],
}

#[derive(Debug, Clone)]
pub enum Drawn {
    Curve(Curve),
    Bars(Bars),
    /// One colour for each cell.
    Cells(Field),
    Contours(Field),
    Surface(Surface),
}

/// One of the things that a chart shows.
#[derive(Debug, Clone)]
pub struct Trace {
    pub drawn: Drawn,
    pub name: String,
    /// What is read at a point, with `%{x}`, `%{y:.3f}` …: values in a format of d3.
    pub hover: Option<String>,
    /// A text for each point, `%{text}`.
    pub texts: Vec<String>,
    /// A further number for each point, `%{customdata}`.
    pub further: Vec<f64>,
    pub is_listed: bool,
    /// Shown and hidden with the others of this group.
    pub group: Option<String>,
    /// Whether it is drawn before the reader chooses its entry in the legend, or its view.
    pub is_shown: bool,
    pub opacity: f64,
}

/// Numbers rounded to what a chart needs; what is none is a gap.
fn rounded(values: impl IntoIterator<Item = impl Into<Option<f64>>>) -> Vec<f64> {
    values.into_iter().map(|value| value.into().map_or(f64::NAN, plotted)).collect()
}

impl Curve {
    /// That of its line, or of its points.
    pub fn colour(&self) -> &str {
        let line = self.line.as_ref().filter(|line| line.width_px > 0.0).map(|line| &line.colour);
        line.or(self.signs.as_ref().map(|signs| &signs.colour)).map_or(INK, |colour| colour)
    }
}

impl Trace {
    pub fn new(drawn: Drawn, name: impl Into<String>) -> Self {
        Self {
            drawn,
            name: name.into(),
            hover: None,
            texts: Vec::new(),
            further: Vec::new(),
            is_listed: true,
            group: None,
            is_shown: true,
            opacity: 1.0,
        }
    }

    /// A line through points, of a colour, a width in pixels and a dash.
    pub fn line(
        name: impl Into<String>,
        x: impl IntoIterator<Item = impl Into<Option<f64>>>,
        y: impl IntoIterator<Item = impl Into<Option<f64>>>,
        (colour, width_px, dash): (impl Into<String>, f64, Dash),
    ) -> Self {
        let line = Some(Line { colour: colour.into(), width_px, dash });
        Self::new(Drawn::Curve(Curve { x: rounded(x), y: rounded(y), line, ..Curve::default() }), name)
    }

    /// Points, each a sign of [`Signs::symbol`].
    pub fn points(
        name: impl Into<String>,
        x: impl IntoIterator<Item = impl Into<Option<f64>>>,
        y: impl IntoIterator<Item = impl Into<Option<f64>>>,
        (colour, symbol, size_px): (&str, &str, i32),
    ) -> Self {
        let curve = Curve { x: rounded(x), y: rounded(y), ..Curve::default() };
        Self::new(Drawn::Curve(curve), name).signs(colour, symbol, vec![size_px.into()])
    }

    /// Bars upwards.
    pub fn bars(name: &str, places: BarPlaces, length: Vec<f64>, colour: &str) -> Self {
        let colour = colour.to_owned();
        Self::new(Drawn::Bars(Bars { places, length, colour, is_horizontal: false, interval: None }), name)
    }

    /// Colours over cells with these edges (or middles, one fewer).
    pub fn heat_map(unit: &str, x: &[f64], y: &[f64], values: Rows) -> Self {
        let [x, y] = [x, y].map(|places| rounded(places.iter().copied()));
        Self::new(Drawn::Cells(Field { x, y, values, scale: ColourScale::of(unit) }), "")
    }

    fn signs(mut self, colour: &str, symbol: &str, size_px: Vec<f64>) -> Self {
        if let Drawn::Curve(curve) = &mut self.drawn {
            curve.signs = Some(Signs { colour: colour.to_owned(), symbol: symbol.to_owned(), size_px });
        }
        self
    }

    /// The signs of a line's points too.
    pub fn with_points(self, symbol: &str, size_px: i32) -> Self {
        let Drawn::Curve(Curve { line: Some(line), .. }) = &self.drawn else { return self };
        let colour = line.colour.clone();
        self.signs(&colour, symbol, vec![size_px.into()])
    }

    /// A size for each point.
    pub fn sizes(mut self, px: Vec<f64>) -> Self {
        if let Drawn::Curve(Curve { signs: Some(signs), .. }) = &mut self.drawn {
            signs.size_px = px;
        }
        self
    }

    /// A bar of half this length on either side of each point.
    pub fn uncertain_by(mut self, half: &[f64]) -> Self {
        if let Drawn::Curve(curve) = &mut self.drawn {
            curve.uncertainty = rounded(half.iter().copied());
        }
        self
    }

    /// An area instead of a line.
    pub fn filled(mut self, colour: impl Into<String>) -> Self {
        if let Drawn::Curve(curve) = &mut self.drawn {
            curve.fill = Some(colour.into());
        }
        self
    }

    /// A text above each point.
    pub fn lettered(mut self, texts: Vec<String>) -> Self {
        if let Drawn::Curve(curve) = &mut self.drawn {
            curve.is_lettered = true;
        }
        self.texts(texts)
    }

    /// Colours from 0 to `greatest`; to 1 where nothing is above zero.
    pub fn colours_up_to(mut self, greatest: f64) -> Self {
        if let Drawn::Cells(field) = &mut self.drawn {
            field.scale.range = Some([0.0, if greatest > 0.0 { greatest } else { 1.0 }]);
        }
        self
    }

    /// What is read at a point: [`Trace::hover`].
    pub fn hover(mut self, template: impl Into<String>) -> Self {
        self.hover = Some(template.into());
        self
    }

    /// A text of its own to be read at each point.
    pub fn hover_texts(self, texts: Vec<String>) -> Self {
        self.texts(texts).hover("%{text}<extra></extra>")
    }

    pub fn texts(mut self, texts: Vec<String>) -> Self {
        self.texts = texts;
        self
    }

    /// A further number to be read at each point.
    pub fn further(mut self, values: Vec<f64>) -> Self {
        self.further = rounded(values);
        self
    }

    pub fn unlisted(self) -> Self {
        self.listed(false)
    }

    /// Named in the legend, or not.
    pub fn listed(mut self, is_listed: bool) -> Self {
        self.is_listed = is_listed;
        self
    }

    /// Shown and hidden with the others of the group.
    pub fn group(mut self, name: &str) -> Self {
        self.group = Some(name.to_owned());
        self
    }

    /// Drawn from the beginning, or not before its entry in the legend is chosen.
    pub fn at_once(mut self, at_once: bool) -> Self {
        self.is_shown = at_once;
        self
    }

    pub fn opacity(mut self, opacity: f64) -> Self {
        self.opacity = opacity;
        self
    }

    pub fn is_surface(&self) -> bool {
        matches!(self.drawn, Drawn::Surface(_))
    }
}

impl ColourScale {
    pub fn of(unit: &str) -> Self {
        Self { unit: unit.to_owned(), range: None }
    }
}
