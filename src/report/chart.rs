//! Charts: what is drawn, as data. `figure` draws them, in pages and in files.
//!
//! A [`Chart`] is built line by line. Numbers are in the unit that the axis names; what is no number is a gap.
//!
//! Colours are tokens, `var(--name)` or `mix(--from,--to,share)`, of the custom properties of `page.css`: one place holds the palette, and
//! charts follow the light, dark or printed page.

pub use super::colour::{INK, MUTED, NEW, PATH, WORN, gear_colour, gear_colour_at, gear_fill};
use super::control::Control;
pub use super::trace::{
    BarPlaces, Bars, ColourScale, Curve, Dash, Drawn, Field, Line, Rows, Signs, Surface, Trace, View,
};
use gearwear_physics::results::run::PathPoints;

/// Colour between those of the gears.
pub fn colour_between_gears(share: f64) -> String {
    format!("mix(--pinion,--wheel,{share:.3})")
}

/// An axis: its words, range and ticks.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Unit included.
    pub title: String,
    /// Values at its beginning and its end; otherwise they follow from the traces.
    pub range: Option<[f64; 2]>,
    pub is_logarithmic: bool,
    pub has_grid: bool,
    /// How its values are read at a point, a format of d3.
    pub format: Option<&'static str>,
    /// Values with their words, where they are not those of round numbers.
    pub ticks: Vec<(f64, String)>,
}

impl Default for Axis {
    fn default() -> Self {
        Self {
            title: String::new(),
            range: None,
            is_logarithmic: false,
            has_grid: true,
            format: None,
            ticks: Vec::new(),
        }
    }
}

/// A vertical line with its name above it.
#[derive(Debug, Clone)]
pub struct Mark {
    pub name: String,
    pub x: f64,
    pub is_strong: bool,
}

/// A name beside something.
#[derive(Debug, Clone)]
pub enum Label {
    /// At the right of the plot, at this height.
    Beside { name: String, y: f64 },
    /// Just above a point.
    Above { name: String, at: [f64; 2] },
}

/// A chart with its words.
#[derive(Debug, Clone)]
pub struct Chart {
    /// Identifier in the page, letters and hyphens.
    pub id: String,
    pub title: String,
    /// One sentence that says what the chart shows, with its numbers.
    pub reading: String,
    /// Over the whole width of the page, or beside the next one where there is room.
    pub is_wide: bool,
    pub height_px: usize,
    /// What the reader may move.
    pub control: Option<Control>,
    pub x: Axis,
    pub y: Axis,
    /// A length is the same on both axes.
    pub is_to_scale: bool,
    /// The reader drags the drawing, rather than a frame to be enlarged.
    pub is_dragged: bool,
    /// Traces are named below it.
    pub has_legend: bool,
    /// The nearest point is read, not all above one another.
    pub reads_nearest: bool,
    /// Its axis upwards leaves the greatest values out, which the reading tells.
    pub is_cut: bool,
    pub marks: Vec<Mark>,
    pub labels: Vec<Label>,
    pub traces: Vec<Trace>,
}

impl Chart {
    /// An empty chart. Its width follows from the room there is.
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            id: id.into(),
            title: title.into(),
            reading: String::new(),
            is_wide: false,
            height_px: 380,
            control: None,
            x: Axis::default(),
            y: Axis::default(),
            is_to_scale: false,
            is_dragged: false,
            has_legend: true,
            reads_nearest: false,
            is_cut: false,
            marks: Vec::new(),
            labels: Vec::new(),
            traces: Vec::new(),
        }
    }

    pub fn reading(mut self, text: impl Into<String>) -> Self {
        self.reading = text.into();
        self
    }

    /// Over the whole width of the page.
    pub fn wide(self) -> Self {
        self.wide_if(true)
    }

    pub fn wide_if(mut self, is_wide: bool) -> Self {
        self.is_wide = is_wide;
        self
    }

    /// With a slider below it; states of which there is only one need none.
    pub fn movable(mut self, control: Control) -> Self {
        let moves = !matches!(&control, Control::Steps { steps, .. } if steps.len() < 2);
        self.control = moves.then_some(control);
        self
    }

    pub fn height(mut self, px: usize) -> Self {
        self.height_px = px;
        self
    }

    /// A length is the same on both axes.
    pub fn drawn_to_scale(mut self) -> Self {
        self.is_to_scale = true;
        self
    }

    /// The reader drags the drawing, rather than a frame to be enlarged.
    pub fn dragged(mut self) -> Self {
        self.is_dragged = true;
        self
    }

    /// Whether traces are named below it.
    pub fn legend(mut self, is_shown: bool) -> Self {
        self.has_legend = is_shown;
        self
    }

    /// The nearest point is read, not all above one another.
    pub fn read_nearest(mut self) -> Self {
        self.reads_nearest = true;
        self
    }

    /// Names the axis across, unit included.
    pub fn x(mut self, title: &str) -> Self {
        self.x.title = title.to_owned();
        self
    }

    /// Names the axis upwards, unit included.
    pub fn y(mut self, title: &str) -> Self {
        self.y.title = title.to_owned();
        self
    }

    pub fn x_range(mut self, range: [f64; 2]) -> Self {
        self.x.range = Some(range);
        self
    }

    pub fn y_range(mut self, range: [f64; 2]) -> Self {
        self.y.range = Some(range);
        self
    }

    /// The axis upwards from 0 to somewhat above `greatest`.
    pub fn y_up_to(self, greatest: f64) -> Self {
        self.y_range(from_zero(greatest))
    }

    /// The axis upwards from 0 to somewhat above `shown`, where values reach `greatest`.
    pub fn y_cut_above(self, shown: f64, greatest: f64) -> Self {
        Self { is_cut: shown < greatest, ..self.y_up_to(shown) }
    }

    /// The axis upwards as a depth: from somewhat below `greatest` up to 0.
    pub fn y_down_to(self, greatest: f64) -> Self {
        let [_, bottom] = from_zero(greatest);
        self.y_range([bottom, -0.02 * bottom])
    }

    /// How places across are read, a format of d3.
    pub fn x_format(mut self, format: &'static str) -> Self {
        self.x.format = Some(format);
        self
    }

    /// Powers of ten evenly spaced, across.
    pub fn x_logarithmic(mut self) -> Self {
        self.x.is_logarithmic = true;
        self
    }

    pub fn y_logarithmic(mut self) -> Self {
        self.y.is_logarithmic = true;
        self
    }

    /// Values across with words of their own.
    pub fn x_ticks(mut self, ticks: impl IntoIterator<Item = (f64, impl Into<String>)>) -> Self {
        self.x.ticks = ticks.into_iter().map(|(value, word)| (value, word.into())).collect();
        self
    }

    pub fn y_ticks(mut self, ticks: impl IntoIterator<Item = (f64, impl Into<String>)>) -> Self {
        self.y.ticks = ticks.into_iter().map(|(value, word)| (value, word.into())).collect();
        self
    }

    pub fn without_grid(mut self) -> Self {
        (self.x.has_grid, self.y.has_grid) = (false, false);
        self
    }

    /// The axis across as the path of contact, with its points.
    pub fn over_path(self, points: &PathPoints) -> Self {
        self.x("contact position, mm").x_range(padded(points.A, points.E)).x_format(".3f").mark_path_points(points)
    }

    #[allow(clippy::should_implement_trait, reason = "a chart is built of traces, one after the other")]
    pub fn add(mut self, trace: Trace) -> Self {
        self.traces.push(trace);
        self
    }

    /// Draws all of `traces`, one over the other.
    pub fn add_all(self, traces: impl IntoIterator<Item = Trace>) -> Self {
        traces.into_iter().fold(self, Self::add)
    }

    /// Draws a line, read at its points by the template `hover`.
    pub fn line(
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
    pub fn new_and_worn(self, x: &[f64], new: Vec<f64>, worn: Vec<f64>, hover: &str) -> Self {
        let x = || x.iter().copied();
        let chart = self.line("new", x(), new, (NEW, 2.0, Dash::Dashed), hover);
        chart.line("worn", x(), worn, (WORN, 2.2, Dash::Solid), hover)
    }

    /// A vertical line with its letter at each of the points A–E; the pitch point C is the stronger one.
    pub fn mark_path_points(self, points: &PathPoints) -> Self {
        self.mark(points.named(), "C")
    }

    /// A vertical line with its name at each place; that of the name `strongest` is the stronger one.
    pub fn mark(mut self, places: impl IntoIterator<Item = (impl Into<String>, f64)>, strongest: &str) -> Self {
        let marks = places.into_iter().map(|(name, x)| (name.into(), x));
        self.marks = marks.map(|(name, x)| Mark { is_strong: name == strongest, name, x }).collect();
        self
    }

    pub fn label(mut self, labels: impl IntoIterator<Item = Label>) -> Self {
        self.labels.extend(labels);
        self
    }
}

/// Range from 0 to somewhat above `greatest`; from 0 to 1 where nothing is above zero.
pub fn from_zero(greatest: f64) -> [f64; 2] {
    if greatest > 0.0 && greatest.is_finite() { [0.0, greatest * 1.06] } else { [0.0, 1.0] }
}

/// The range from `low` to `high` and a little more on either side.
pub fn padded(low: f64, high: f64) -> [f64; 2] {
    let pad = 0.025 * (high - low).abs();
    [low - pad, high + pad]
}
