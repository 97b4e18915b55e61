//! What all plots have in common: axes, lines and colours.
//!
//! Colours are tokens, `var(--name)` or `mix(--from,--to,share)`. The page's script replaces them by the custom
//! properties of `page.css` in force, so that one place holds the palette and plots follow the light, dark or printed
//! page.

use crate::report::chart::{
    Anchor, Annotation, Axis, DashType, Font, HoverMode, Label, Layout, Legend, Line, Margin, Mode, ModeBar,
    Orientation, Plot, Shape, ShapeLayer, ShapeType, TicksDirection, Title, Trace,
};

use super::number::plotted;
use crate::gear::Gear;
use crate::results::run::PathPoints;

/// Unworn.
pub const NEW: &str = "var(--new)";
/// Worn.
pub const WORN: &str = "var(--worn)";
/// Secondary lines and labels.
pub const MUTED: &str = "var(--muted)";
/// The path of contact.
pub const PATH: &str = "var(--path)";

pub(crate) const INK: &str = "var(--ink)";
const PAPER: &str = "var(--paper)";
const GRID: &str = "var(--grid)";
const RULE: &str = "var(--rule)";

/// A plot with its words.
pub struct Figure {
    /// Identifier in the page, letters and hyphens.
    pub id: String,
    /// Heading.
    pub title: String,
    /// One sentence that says what the plot shows, with its numbers.
    pub reading: String,
    /// The plot.
    pub plot: Plot,
    /// Over the whole width of the page, or beside the next one where there is room.
    pub wide: bool,
}

/// Colour of a gear.
pub fn gear_colour(gear: Gear) -> &'static str {
    match gear {
        Gear::Pinion => "var(--pinion)",
        Gear::Wheel => "var(--wheel)",
    }
}

/// Colour of a gear at `share` of its life: from pale to full.
pub fn gear_colour_at(gear: Gear, share: f64) -> String {
    format!("mix(--{0}-early,--{0},{share:.3})", gear.name())
}

/// The common layout; `height_px` over all, axes still to be added. Width and the legend's height follow from the room
/// there is, in the page's script.
pub fn layout(height_px: usize) -> Layout {
    Layout::new()
        .height(height_px)
        .paper_background_color(PAPER)
        .plot_background_color(PAPER)
        .font(Font::new().family("system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif").size(13).color(INK))
        .margin(Margin::new().left(56).right(12).top(28).bottom(48))
        .hover_mode(HoverMode::XUnified)
        .hover_label(Label::new().background_color(PAPER).border_color(RULE))
        .mode_bar(ModeBar::new().background_color("rgba(0,0,0,0)").color(MUTED).active_color(INK))
        .legend(
            Legend::new()
                .orientation(Orientation::Horizontal)
                .x(0.0)
                .x_anchor(Anchor::Left)
                .item_width(34)
                .background_color("rgba(0,0,0,0)")
                .font(Font::new().size(12)),
        )
}

/// An axis named `title`, unit included.
pub fn axis(title: &str) -> Axis {
    Axis::new()
        .title(Title::new().text(title).font(Font::new().size(13)))
        .auto_margin(true)
        .grid_color(GRID)
        .zero_line(false)
        .show_line(true)
        .line_color(RULE)
        .ticks(TicksDirection::Outside)
        .tick_color(RULE)
        .tick_length(4)
}

/// A line, through all its points: plotly would leave some out, which puts corners into smooth curves.
pub fn line(colour: impl Into<String>, width_px: f64, dash: DashType) -> Line {
    Line::new().color(colour).width(width_px).dash(dash).simplify(false)
}

/// A curve through the points, its values rounded to what a plot needs.
pub fn curve(name: &str, x: impl IntoIterator<Item = f64>, y: impl IntoIterator<Item = f64>, line: Line) -> Trace {
    Trace::scatter(x.into_iter().map(plotted).collect(), y.into_iter().map(plotted).collect())
        .name(name)
        .mode(Mode::Lines)
        .line(line)
}

/// The curves of a quantity new (dashed, grey) and worn (full), against `x`.
pub fn new_and_worn(plot: &mut Plot, x: &[f64], new: Vec<f64>, worn: Vec<f64>, hover: &str) {
    for (name, y, line) in
        [("new", new, line(NEW, 2.0, DashType::Dash)), ("worn", worn, line(WORN, 2.2, DashType::Solid))]
    {
        plot.add_trace(curve(name, x.iter().copied(), y, line).hover_template(hover));
    }
}

/// Names and places of the points A–E, in the order of contact.
pub fn named(points: &PathPoints) -> [(&'static str, f64); 5] {
    [("A", points.A), ("B", points.B), ("C", points.C), ("D", points.D), ("E", points.E)]
}

/// Adds a vertical line with its letter at each of the points A–E; the pitch point C is the stronger one.
pub fn mark_path_points(layout: Layout, points: &PathPoints) -> Layout {
    mark(layout, named(points).into_iter().map(|(name, x)| (name.to_owned(), x)), "C")
}

/// Adds a vertical line with its name at each place; that of the name `strongest` is the stronger one.
pub fn mark(layout: Layout, places: impl IntoIterator<Item = (String, f64)>, strongest: &str) -> Layout {
    mark_with(layout, places, strongest, |x| x)
}

/// The same on a logarithmic axis, where plotly takes the place of a line as it is and that of its name as a logarithm.
pub fn mark_logarithmic(layout: Layout, places: impl IntoIterator<Item = (String, f64)>) -> Layout {
    mark_with(layout, places.into_iter().filter(|(_, x)| *x > 0.0), "", f64::log10)
}

fn mark_with(
    layout: Layout,
    places: impl IntoIterator<Item = (String, f64)>,
    strongest: &str,
    name_at: fn(f64) -> f64,
) -> Layout {
    let (mut shapes, mut letters) = (Vec::new(), Vec::new());
    for (name, x) in places.into_iter().filter(|(_, x)| x.is_finite()) {
        let (width, dash) = if name == strongest { (1.4, DashType::DashDot) } else { (1.0, DashType::Dot) };
        shapes.push(
            Shape::new()
                .shape_type(ShapeType::Line)
                .layer(ShapeLayer::Below)
                .x_ref("x")
                .y_ref("paper")
                .x0(x)
                .x1(x)
                .y0(0.0)
                .y1(1.0)
                .line(Line::new().color(MUTED).width(width).dash(dash)),
        );
        letters.push(
            Annotation::new()
                .x_ref("x")
                .y_ref("paper")
                .x(name_at(x))
                .y(1.0)
                .y_anchor(Anchor::Bottom)
                .show_arrow(false)
                .text(name)
                .font(Font::new().size(12).color(MUTED)),
        );
    }
    layout.shapes(shapes).annotations(letters)
}

/// Range from 0 to somewhat above `greatest`; from 0 to 1 where nothing is above zero.
pub fn from_zero(greatest: f64) -> [f64; 2] {
    if greatest > 0.0 && greatest.is_finite() { [0.0, greatest * 1.06] } else { [0.0, 1.0] }
}

/// The range from `low` to `high` and a little more on either side.
pub fn padded(low: f64, high: f64) -> Vec<f64> {
    let pad = 0.025 * (high - low).abs();
    vec![low - pad, high + pad]
}
