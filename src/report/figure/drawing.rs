//! A chart as a drawing: frame, grid, traces, marks, colour scale and legend.

use super::axis::PlacedAxis;
use super::picture::{Anchor, Group, Medium, Moves, Node, Path, Picture, Step, Words, rectangle};
use super::sign;
use crate::report::chart::{BarPlaces, Chart, Dash, Drawn, Field, INK, Label, Line, MUTED, Trace};
use gearwear_bodies::reference::statistics::extent;

const GRID: &str = "var(--grid)";
const RULE: &str = "var(--rule)";

/// Widths of drawings in files: over half of a page, over a whole one.
const FILE_WIDTH_PX: [f64; 2] = [640.0, 1080.0];
/// The same in a page on a wide screen, beside one another and alone.
const PAGE_WIDTH_PX: [f64; 2] = [532.0, 1104.0];
/// Above the plot, for the names of marks; in a file for the title too.
const ABOVE: [f64; 2] = [62.0, 24.0];
/// Below the plot, for ticks and the axis's name.
const BELOW: f64 = 54.0;
/// Left of the plot: the axis's name and the longest of its ticks.
const AXIS_NAME: f64 = 34.0;
const RIGHT: f64 = 18.0;
/// With a scale of colours.
const RIGHT_OF_FIELD: f64 = 96.0;
const TICK_SIZE: f64 = 12.0;
const LEGEND_ROW: f64 = 20.0;
const LEGEND_SIGN: f64 = 30.0;
/// Mean width of a character over the size of the font.
const CHARACTER: f64 = 0.6;
/// Least distances of ticks across and upwards, px.
pub(super) const TICK_SPACING: [f64; 2] = [64.0, 42.0];

pub(super) struct Drawing<'a> {
    pub chart: &'a Chart,
    pub x: PlacedAxis<'a>,
    pub y: PlacedAxis<'a>,
    pub picture: Picture,
    /// Traces that are drawn as charts are first shown.
    drawn: Vec<&'a Trace>,
    below: f64,
}

pub(super) fn is_shown(trace: &Trace) -> bool {
    trace.is_shown
}

/// The bars of a chart are across or upwards, all of them.
fn names_of_bars(drawn: &[&Trace], is_horizontal: bool) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for trace in drawn {
        let Drawn::Bars(bars) = &trace.drawn else { continue };
        let BarPlaces::Named(names) = &bars.places else { continue };
        for name in names.iter().filter(|_| bars.is_horizontal == is_horizontal) {
            if !all.contains(name) {
                all.push(name.clone());
            }
        }
    }
    all
}

/// Values of a trace along an axis, 0 across and 1 upwards.
fn values(trace: &Trace, axis: usize) -> Vec<f64> {
    match &trace.drawn {
        Drawn::Curve(curve) if axis == 0 => curve.x.clone(),
        Drawn::Curve(curve) if curve.uncertainty.is_empty() => curve.y.clone(),
        Drawn::Curve(curve) => {
            let ends = curve.y.iter().zip(&curve.uncertainty).flat_map(|(y, half)| [y - half, y + half]);
            ends.collect()
        }
        Drawn::Bars(bars) => match (&bars.places, (axis == 1) != bars.is_horizontal) {
            (_, true) => bars.ends().chain([0.0]).collect(),
            (BarPlaces::Named(_), false) => Vec::new(),
            (BarPlaces::At { middles, width }, false) => {
                middles.iter().flat_map(|middle| [middle - 0.5 * width, middle + 0.5 * width]).collect()
            }
        },
        Drawn::Cells(field) | Drawn::Contours(field) => [&field.x, &field.y][axis].clone(),
        Drawn::Surface(_) => Vec::new(),
    }
}

impl<'a> Drawing<'a> {
    pub(super) fn new(chart: &'a Chart, medium: Medium) -> Self {
        let drawn: Vec<&Trace> = chart.traces.iter().filter(|trace| is_shown(trace)).collect();
        let is_field = |trace: &&Trace| matches!(trace.drawn, Drawn::Cells(_) | Drawn::Contours(_));
        let has_field = drawn.iter().any(is_field);
        let (widths, above, legend_height) = match medium {
            Medium::File => (FILE_WIDTH_PX, ABOVE[0], 0.0),
            // In a page the legend takes a part of the height.
            Medium::Page => (PAGE_WIDTH_PX, ABOVE[1], if chart.has_legend { 24.0 } else { 0.0 }),
        };
        let width = widths[usize::from(chart.is_wide)];
        let bottom = chart.height_px as f64 - BELOW + if medium == Medium::File { 20.0 } else { -legend_height };
        let along = |axis: usize| drawn.iter().flat_map(move |trace| values(trace, axis));
        let y = PlacedAxis::new(&chart.y, along(1), names_of_bars(&drawn, true), has_field).placed(bottom, above);
        let longest =
            y.ticks(TICK_SPACING[1]).iter().flat_map(|(_, label)| label.lines().map(width_of)).fold(0.0, f64::max);
        let name = if chart.y.title.is_empty() { 14.0 } else { AXIS_NAME };
        let left = (name + longest).max(62.0);
        let right = width - if has_field { RIGHT_OF_FIELD } else { RIGHT };
        let x = PlacedAxis::new(&chart.x, along(0), names_of_bars(&drawn, false), has_field).placed(left, right);
        let (x, y) = match chart.is_to_scale {
            true => {
                let unit = x.unit_px().min(y.unit_px());
                (x.with_unit(unit), y.with_unit(unit))
            }
            false => (x, y),
        };
        let picture = Picture {
            id: chart.id.clone(),
            title: chart.title.clone(),
            medium,
            size: [width, bottom + BELOW],
            frame: [left, above, right, bottom],
            nodes: Vec::new(),
        };
        Self { chart, x, y, picture, drawn, below: bottom + BELOW }
    }

    /// Ranges of both axes around all that is shown.
    pub(super) fn whole(&self) -> [[f64; 2]; 2] {
        let tight = self.drawn.iter().any(|trace| matches!(trace.drawn, Drawn::Cells(_) | Drawn::Contours(_)));
        let along = |axis: usize| self.drawn.iter().flat_map(move |trace| values(trace, axis));
        [self.x.around(along(0), tight), self.y.around(along(1), tight)]
    }

    /// Draws everything.
    pub(super) fn finished(mut self) -> Self {
        if self.picture.medium == Medium::File {
            let [width, legend] = [self.picture.size[0], self.legend_rows().len() as f64 * LEGEND_ROW];
            self.picture.size[1] += legend;
            let [left, ..] = self.picture.frame;
            let paper = rectangle([0.0, 0.0, width, self.picture.size[1]]);
            self.filled(paper, "var(--paper)");
            self.words(&self.chart.title.clone(), [left, 24.0], (Anchor::Start, 16.0, INK), Moves::No);
        }
        self.axes();
        self.titles();
        self.marks();
        self.group(Group { is_clipped: true, ..Group::named("area") }, Self::traces);
        for trace in self.drawn.clone() {
            if let Drawn::Cells(field) | Drawn::Contours(field) = &trace.drawn {
                self.colour_scale(field);
            }
        }
        let [left, top, right, bottom] = self.picture.frame;
        let corner = vec![Step::Move([left, top]), Step::Line([left, bottom]), Step::Line([right, bottom])];
        self.group(Group::named("corner"), |drawing| drawing.stroked(corner, (RULE, 1.0, Dash::Solid)));
        self.labels();
        if self.picture.medium == Medium::File {
            self.legend();
        }
        self
    }

    fn traces(&mut self) {
        let mut bars_drawn = 0;
        for (number, trace) in self.chart.traces.iter().enumerate() {
            if self.picture.medium == Medium::File && !is_shown(trace) {
                continue;
            }
            let (opacity, is_hidden) = (trace.opacity, !is_shown(trace));
            let group = Group { trace: Some(number), is_hidden, opacity, ..Group::named("trace") };
            self.group(group, |drawing| drawing.trace(trace, &mut bars_drawn));
        }
    }

    pub(super) fn group(&mut self, group: Group, draw: impl FnOnce(&mut Self)) {
        self.picture.nodes.push(Node::Group(group));
        draw(self);
        self.picture.nodes.push(Node::End);
    }

    pub(super) fn words(
        &mut self,
        text: &str,
        at: [f64; 2],
        (anchor, size, colour): (Anchor, f64, &str),
        moves: Moves,
    ) {
        let (text, colour) = (text.to_owned(), colour.to_owned());
        self.picture.nodes.push(Node::Words(Words { at, moves, text, anchor, size, colour, is_upright: false }));
    }

    pub(super) fn stroked(&mut self, steps: Vec<Step>, (colour, width_px, dash): (&str, f64, Dash)) {
        let line = Some(Line { colour: colour.to_owned(), width_px, dash });
        self.picture.nodes.push(Node::Path(Path { at: [0.0; 2], moves: Moves::No, steps, fill: None, line }));
    }

    pub(super) fn filled(&mut self, steps: Vec<Step>, colour: &str) {
        let fill = Some(colour.to_owned());
        self.picture.nodes.push(Node::Path(Path { at: [0.0; 2], moves: Moves::No, steps, fill, line: None }));
    }

    /// Grid, ticks and their labels.
    fn axes(&mut self) {
        let [left, top, right, bottom] = self.picture.frame;
        let (across, upwards) = (self.x.ticks(TICK_SPACING[0]), self.y.ticks(TICK_SPACING[1]));
        let has_grid = [&self.x, &self.y].map(|axis| axis.words.has_grid && axis.categories.is_empty());
        let draw = |drawing: &mut Self| {
            for (x, label) in across {
                if has_grid[0] {
                    drawing.stroked(vec![Step::Move([x, top]), Step::Line([x, bottom])], (GRID, 1.0, Dash::Solid));
                }
                drawing.stroked(vec![Step::Move([x, bottom]), Step::Line([x, bottom + 4.0])], (RULE, 1.0, Dash::Solid));
                drawing.words(&label, [x, bottom + 18.0], (Anchor::Middle, TICK_SIZE, INK), Moves::No);
            }
            for (y, label) in upwards {
                if has_grid[1] {
                    drawing.stroked(vec![Step::Move([left, y]), Step::Line([right, y])], (GRID, 1.0, Dash::Solid));
                }
                drawing.stroked(vec![Step::Move([left, y]), Step::Line([left - 4.0, y])], (RULE, 1.0, Dash::Solid));
                let lines = label.lines().count() as f64;
                for (number, line) in label.lines().enumerate() {
                    let below = 4.0 + 14.0 * (number as f64 - 0.5 * (lines - 1.0));
                    drawing.words(line, [left - 8.0, y + below], (Anchor::End, TICK_SIZE, INK), Moves::No);
                }
            }
        };
        self.group(Group::named("axes"), draw);
    }

    fn titles(&mut self) {
        let [left, top, right, bottom] = self.picture.frame;
        let [x, y] = [&self.x, &self.y].map(|axis| axis.words.title.clone());
        let draw = |drawing: &mut Self| {
            drawing.words(&x, [left.midpoint(right), bottom + 40.0], (Anchor::Middle, 13.0, INK), Moves::No);
            let (at, anchor, colour) = ([15.0, top.midpoint(bottom)], Anchor::Middle, INK.to_owned());
            let title = Words { at, moves: Moves::No, text: y, anchor, size: 13.0, colour, is_upright: true };
            drawing.picture.nodes.push(Node::Words(title));
        };
        self.group(Group::named("titles"), draw);
    }

    /// Vertical lines at named places, with their names above.
    fn marks(&mut self) {
        let [left, top, right, bottom] = self.picture.frame;
        let chart = self.chart;
        let draw = |drawing: &mut Self| {
            for mark in &chart.marks {
                let x = drawing.x.at(mark.x);
                if !(left - 0.5..=right + 0.5).contains(&x) {
                    continue;
                }
                let (width_px, dash) = if mark.is_strong { (1.4, Dash::Mixed) } else { (1.0, Dash::Dot) };
                let line = Some(Line { colour: MUTED.to_owned(), width_px, dash });
                let steps = vec![Step::Move([0.0, top]), Step::Line([0.0, bottom])];
                let path = Path { at: [x, 0.0], moves: Moves::Across, steps, fill: None, line };
                drawing.picture.nodes.push(Node::Path(path));
                drawing.words(&mark.name, [x, top - 5.0], (Anchor::Middle, TICK_SIZE, MUTED), Moves::Across);
            }
        };
        self.group(Group::named("marks"), draw);
    }

    fn labels(&mut self) {
        let [left, top, right, bottom] = self.picture.frame;
        for label in &self.chart.labels {
            match label {
                Label::Beside { name, y } => {
                    let y = self.y.at(*y);
                    if (top - 1.0..=bottom + 1.0).contains(&y) {
                        let style = (Anchor::Start, TICK_SIZE, MUTED);
                        self.group(Group::named("beside"), |drawing| {
                            drawing.words(name, [right + 5.0, y + 4.0], style, Moves::Upwards);
                        });
                    }
                }
                Label::Above { name, at } => {
                    let (x, y) = (self.x.at(at[0]), self.y.at(at[1]));
                    let is_inside = (left..=right).contains(&x) && (top..=bottom).contains(&y);
                    let is_somewhere = self.picture.medium == Medium::Page && x.is_finite() && y.is_finite();
                    if is_inside || is_somewhere {
                        let group = Group { is_clipped: true, ..Group::named("above") };
                        let style = (Anchor::Middle, TICK_SIZE, MUTED);
                        self.group(group, |drawing| drawing.words(name, [x, y - 5.0], style, Moves::BothWays));
                    }
                }
            }
        }
    }

    /// The traces that the legend names, in rows as wide as there is room.
    fn legend_rows(&self) -> Vec<Vec<&'a Trace>> {
        let (mut rows, mut used) = (Vec::<Vec<&Trace>>::new(), f64::INFINITY);
        let room = self.picture.size[0] - self.picture.frame[0] - RIGHT;
        for &trace in self.drawn.iter().filter(|trace| self.chart.has_legend && sign::is_listed(trace)) {
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

    fn legend(&mut self) {
        for (row, entries) in self.legend_rows().into_iter().enumerate() {
            let y = self.below + row as f64 * LEGEND_ROW + 4.0;
            let mut x = self.picture.frame[0];
            for trace in entries {
                self.picture.nodes.extend(sign::of_legend(trace, [x, y], LEGEND_SIGN));
                self.words(&trace.name, [x + LEGEND_SIGN + 4.0, y + 4.0], (Anchor::Start, TICK_SIZE, INK), Moves::No);
                x += entry_width(trace);
            }
        }
    }
}

fn width_of(text: &str) -> f64 {
    text.chars().count() as f64 * CHARACTER * TICK_SIZE
}

fn entry_width(trace: &Trace) -> f64 {
    LEGEND_SIGN + 22.0 + width_of(&trace.name)
}

/// With left, top, right and bottom.
/// The range of the colours of a field: about its value where it has but one, and 0 to 1 where it has none.
pub(super) fn range_of_colours(field: &Field) -> [f64; 2] {
    let finite = field.values.iter().flatten().copied().filter(|value| value.is_finite());
    match field.scale.range.unwrap_or_else(|| extent(finite)) {
        [low, high] if low < high => [low, high],
        [low, _] if low.is_finite() => [low - 0.5, low + 0.5],
        _ => [0.0, 1.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::ColourScale;

    #[test]
    fn colours_of_one_value_lie_about_it() {
        let of = |values: [f64; 2]| {
            range_of_colours(&Field {
                x: vec![],
                y: vec![],
                values: vec![values.into()],
                scale: ColourScale::of("MPa"),
            })
        };
        assert_eq!([of([62.0; 2]), of([f64::NAN; 2]), of([1.0, 3.0])], [[61.5, 62.5], [0.0, 1.0], [1.0, 3.0]]);
    }
}
