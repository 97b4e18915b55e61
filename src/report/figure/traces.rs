//! The traces of a chart on its drawing, and the scale of colours beside it.

use super::contours;
use super::drawing::{Drawing, range_of_colours};
use super::palette::{hex, of_scale};
use super::picture::{Anchor, FieldOfColour, Group, Medium, Moves, Node, Path, Step, polygon, rectangle};
use super::png::{LEVELS, NO_LEVEL};
use super::sign;
use super::{axis::PlacedAxis, drawing::TICK_SPACING};
use crate::report::chart::{Axis, BarPlaces, Bars, Curve, Dash, Drawn, Field, INK, Line, Trace};
use crate::report::control::{Change, Control};

/// Part of the room of a category that its bars fill.
const FILLED: f64 = 0.8;
/// Cells for a pixel where those of a field have several sizes.
const CELLS_PER_PX: f64 = 2.0;
/// Distance that a drawn line may have from its points, px: a fifth of what is seen, so that parts can be enlarged.
const THINNED_PX: f64 = 0.02;
/// Half the width of the ends of a bar of uncertainty, px.
const END_PX: f64 = 4.0;

impl Bars {
    /// Values at their free ends, intervals included.
    pub(super) fn ends(&self) -> impl Iterator<Item = f64> + '_ {
        let intervals = self.interval.iter().flat_map(|[below, above]| {
            let both = self.length.iter().zip(below.iter().zip(above));
            both.flat_map(|(end, (below, above))| [end - below, end + above])
        });
        self.length.iter().copied().chain(intervals)
    }
}

impl Drawing<'_> {
    /// Draws `trace`; of bars side by side, `before` have been drawn before it.
    pub(super) fn trace(&mut self, trace: &Trace, before: &mut usize) {
        match &trace.drawn {
            Drawn::Curve(curve) => self.curve(curve, &trace.texts),
            Drawn::Bars(bars) => {
                self.bars(bars, *before);
                *before += 1;
            }
            Drawn::Cells(field) => self.cells(field),
            Drawn::Contours(field) => self.contours(field),
            Drawn::Surface(_) => {}
        }
    }

    fn curve(&mut self, curve: &Curve, texts: &[String]) {
        let places = curve.x.iter().zip(&curve.y).map(|(x, y)| [self.x.at(*x), self.y.at(*y)]);
        let places: Vec<[f64; 2]> = places.collect();
        let is_gap = |place: &[f64; 2]| !place.iter().all(|value| value.is_finite());
        if let Some(line) = &curve.line {
            let pieces = places.split(is_gap).filter(|piece| !piece.is_empty());
            let steps: Vec<Step> = pieces
                .flat_map(|piece| {
                    let mut places = thinned(piece).into_iter();
                    let first = places.next().map(Step::Move);
                    first.into_iter().chain(places.map(Step::Line))
                })
                .collect();
            let (fill, line) = (curve.fill.clone(), (line.width_px > 0.0).then(|| line.clone()));
            let path = Path { at: [0.0; 2], moves: Moves::No, steps, fill, line };
            self.picture.nodes.push(Node::Path(path));
        }
        let colour = curve.signs.as_ref().map_or(INK, |signs| &signs.colour);
        for ((x, y), half) in curve.x.iter().zip(&curve.y).zip(&curve.uncertainty) {
            let [x, ends] = [[self.x.at(*x); 2], [y - half, y + half].map(|end| self.y.at(end))];
            self.interval([x[0], ends[0]], [x[0], ends[1]], colour);
        }
        let Some(signs) = &curve.signs else { return };
        for (number, place) in places.iter().enumerate().filter(|(_, place)| !is_gap(place)) {
            self.picture.nodes.push(sign::of_point(signs, number, *place, Moves::BothWays));
            if let Some(text) = texts.get(number).filter(|_| curve.is_lettered) {
                self.words(text, [place[0], place[1] - 8.0], (Anchor::Middle, 15.0, &signs.colour), Moves::BothWays);
            }
        }
    }

    /// A line with ends across it.
    fn interval(&mut self, from: [f64; 2], to: [f64; 2], colour: &str) {
        if !from.iter().chain(&to).all(|value| value.is_finite()) {
            return;
        }
        let across = if from[0] == to[0] { [END_PX, 0.0] } else { [0.0, END_PX] };
        let end =
            |[x, y]: [f64; 2]| [Step::Move([x - across[0], y - across[1]]), Step::Line([x + across[0], y + across[1]])];
        let steps = [Step::Move(from), Step::Line(to)].into_iter().chain(end(from)).chain(end(to));
        self.stroked(steps.collect(), (colour, 1.2, Dash::Solid));
    }

    /// Bars, of one category side by side.
    fn bars(&mut self, bars: &Bars, before: usize) {
        let all = self.chart.traces.iter().filter(|trace| matches!(trace.drawn, Drawn::Bars(_))).count();
        for (number, &end) in bars.length.iter().enumerate() {
            let along = if bars.is_horizontal { &self.y } else { &self.x };
            let Some([from, to]) = span(along, bars, number, (before, all)).filter(|_| end.is_finite()) else {
                continue;
            };
            let [zero, end_px] =
                [0.0, end].map(|value| if bars.is_horizontal { self.x.at(value) } else { self.y.at(value) });
            let frame = if bars.is_horizontal { [zero, from, end_px, to] } else { [from, end_px, to, zero] };
            self.filled(rectangle(frame), &bars.colour);
            if let Some([below, above]) = &bars.interval {
                let ends = [end - below[number], end + above[number]];
                let middle = from.midpoint(to);
                let ends =
                    ends.map(
                        |value| {
                            if bars.is_horizontal { [self.x.at(value), middle] } else { [middle, self.y.at(value)] }
                        },
                    );
                self.interval(ends[0], ends[1], INK);
            }
        }
    }

    /// The cells as they are first shown, and hidden those of the other states of a slider.
    fn cells(&mut self, field: &Field) {
        let range = range_of_colours(field);
        let states: Vec<_> = match (&self.chart.control, self.picture.medium) {
            (Some(Control::Steps { steps, .. }), Medium::Page) => steps
                .iter()
                .filter_map(|step| if let Change::Cells(values) = &step.change { Some(values) } else { None })
                .collect(),
            _ => Vec::new(),
        };
        if states.is_empty() {
            self.state(field, &field.values, range, (None, false));
        }
        for (number, values) in states.iter().enumerate() {
            self.state(field, values, range, (Some(number), number + 1 < states.len()));
        }
    }

    fn state(
        &mut self,
        field: &Field,
        values: &[Vec<f64>],
        [low, high]: [f64; 2],
        (state, is_hidden): (Option<usize>, bool),
    ) {
        let (Some(x), Some(y)) = (edges(&field.x, values.first().map_or(0, Vec::len)), edges(&field.y, values.len()))
        else {
            return;
        };
        let frame = [self.x.at(x[0]), self.y.at(y[y.len() - 1]), self.x.at(x[x.len() - 1]), self.y.at(y[0])];
        let columns = sampled(&x, frame[2] - frame[0]);
        let mut rows = sampled(&y, frame[3] - frame[1]);
        rows.reverse();
        let level = |value: f64| match high > low {
            _ if !value.is_finite() => NO_LEVEL,
            true => (((value - low) / (high - low)).clamp(0.0, 1.0) * (LEVELS - 1) as f64).round() as u8,
            false => 0,
        };
        let levels = rows.iter().flat_map(|row| columns.iter().map(|column| level(values[*row][*column]))).collect();
        self.picture.nodes.push(Node::Field(FieldOfColour { frame, columns: columns.len(), levels, state, is_hidden }));
    }

    /// Areas between levels, and lines at the levels with their values.
    fn contours(&mut self, field: &Field) {
        let [low, high] = range_of_colours(field);
        let places =
            |axis: &PlacedAxis<'_>, values: &[f64]| values.iter().map(|value| axis.at(*value)).collect::<Vec<_>>();
        let (x, y) = (places(&self.x, &field.x), places(&self.y, &field.y));
        let levels = contours::levels(low, high);
        for (number, area) in contours::bands(&x, &y, &field.values, &levels).into_iter().enumerate() {
            let level = levels[number].midpoint(levels[number + 1]);
            let colour = hex(of_scale((level - low) / (high - low)));
            let line = Some(Line { colour: colour.clone(), width_px: 0.6, dash: Dash::Solid });
            let steps = area.iter().flat_map(|corners| polygon(corners)).collect();
            let path = Path { at: [0.0; 2], moves: Moves::No, steps, fill: Some(colour), line };
            self.picture.nodes.push(Node::Path(path));
        }
        let triangles = contours::triangles(&x, &y, &field.values);
        let mut labels: Vec<[f64; 2]> = Vec::new();
        for &level in &levels[1..levels.len() - 1] {
            let lines = contours::lines(&triangles, level);
            let steps = lines.iter().flat_map(|[from, to]| [Step::Move(*from), Step::Line(*to)]).collect();
            self.stroked(steps, ("rgba(255,255,255,0.45)", 1.0, Dash::Solid));
            // Near the middle of the line, where no other label is.
            let middles = lines.iter().map(|[from, to]| [from[0].midpoint(to[0]), from[1].midpoint(to[1])]);
            let sum = middles.clone().fold([0.0; 2], |sum, place| [sum[0] + place[0], sum[1] + place[1]]);
            let middle = sum.map(|sum| sum / lines.len() as f64);
            let [left, top, right, bottom] = self.picture.frame;
            let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(2.0 * (a[1] - b[1]));
            let free = middles.filter(|place| {
                labels.iter().all(|label| distance(label, place) > 44.0)
                    && (left + 24.0..=right - 24.0).contains(&place[0])
                    && (top + 12.0..=bottom - 12.0).contains(&place[1])
            });
            if let Some(place) = free.min_by(|a, b| distance(a, &middle).total_cmp(&distance(b, &middle))) {
                labels.push(place);
                let text = contours::label(level, &levels);
                self.words(&text, [place[0], place[1] + 4.0], (Anchor::Middle, 11.0, "#ffffff"), Moves::BothWays);
            }
        }
    }

    pub(super) fn colour_scale(&mut self, field: &Field) {
        let [_, top, right, bottom] = self.picture.frame;
        let range = range_of_colours(field);
        let (left, width) = (right + 26.0, 14.0);
        let words = Axis { range: Some(range), ..Axis::default() };
        let ticks =
            PlacedAxis::new(&words, std::iter::empty(), Vec::new(), true).placed(bottom, top).ticks(TICK_SPACING[1]);
        let levels = (0..LEVELS).rev().map(|level| level as u8).collect();
        self.group(Group::named("scale"), |drawing| {
            let frame = [left, top, left + width, bottom];
            drawing.picture.nodes.push(Node::Field(FieldOfColour {
                frame,
                columns: 1,
                levels,
                state: None,
                is_hidden: false,
            }));
            for (y, label) in ticks {
                drawing.words(&label, [left + width + 5.0, y + 4.0], (Anchor::Start, 12.0, INK), Moves::No);
            }
            drawing.words(&field.scale.unit, [left, top - 8.0], (Anchor::Start, 12.0, INK), Moves::No);
        });
    }
}

/// Middles of bars on their axis, in coordinates; `before` bars of a category stand before each.
pub(super) fn bar_middles(drawing: &Drawing<'_>, bars: &Bars, before: usize) -> Vec<f64> {
    let all = drawing.chart.traces.iter().filter(|trace| matches!(trace.drawn, Drawn::Bars(_))).count();
    let along = if bars.is_horizontal { &drawing.y } else { &drawing.x };
    let middle = |number| place_of_bar(along, bars, number, (before, all)).map_or(f64::NAN, |(middle, _)| middle);
    (0..bars.length.len()).map(middle).collect()
}

/// From one side of the bar of that number to the other, px; `before` of `all` bars of a category stand before it.
fn span(along: &PlacedAxis<'_>, bars: &Bars, number: usize, among: (usize, usize)) -> Option<[f64; 2]> {
    let (middle, width) = place_of_bar(along, bars, number, among)?;
    Some([middle - 0.5 * width, middle + 0.5 * width].map(|side| along.at(side)))
}

/// Middle and width of a bar.
fn place_of_bar(
    along: &PlacedAxis<'_>,
    bars: &Bars,
    number: usize,
    (before, all): (usize, usize),
) -> Option<(f64, f64)> {
    match &bars.places {
        BarPlaces::Named(names) => {
            let category = along.categories.iter().position(|known| Some(known) == names.get(number))?;
            let width = FILLED / all as f64;
            Some((category as f64 + (before as f64 + 0.5 - 0.5 * all as f64) * width, width))
        }
        BarPlaces::At { middles, width } => Some((*middles.get(number)?, *width)),
    }
}

/// Edges of `count` cells, of which the edges or the middles are given.
pub(super) fn edges(places: &[f64], count: usize) -> Option<Vec<f64>> {
    if count == 0 || places.len() == count + 1 {
        return (count > 0).then(|| places.to_vec());
    }
    let half = if count > 1 { 0.5 * (places[1] - places[0]) } else { 0.5 };
    let between = places.windows(2).map(|pair| pair[0].midpoint(pair[1]));
    Some([places[0] - half].into_iter().chain(between).chain([places[count - 1] + half]).collect())
}

/// Numbers of cells at even steps over all of them: each once where they are of one size.
fn sampled(edges: &[f64], length_px: f64) -> Vec<usize> {
    let count = edges.len() - 1;
    let (first, whole) = (edges[0], edges[count] - edges[0]);
    let is_even = edges.windows(2).all(|cell| ((cell[1] - cell[0]) / whole * count as f64 - 1.0).abs() < 1e-3);
    if is_even {
        return (0..count).collect();
    }
    let samples = (CELLS_PER_PX * length_px.abs()).ceil().max(1.0) as usize;
    let place = |sample: usize| first + (sample as f64 + 0.5) / samples as f64 * whole;
    (0..samples).map(|sample| edges.partition_point(|edge| *edge <= place(sample)).clamp(1, count) - 1).collect()
}

/// The places that a line through all of them needs, by the algorithm of Ramer, Douglas and Peucker: the others are within
/// [`THINNED_PX`] of the line.
fn thinned(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some(last) = places.len().checked_sub(1) else { return Vec::new() };
    let mut is_kept = vec![false; places.len()];
    (is_kept[0], is_kept[last]) = (true, true);
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let distances = (from + 1..to).map(|at| (at, distance_to_segment(places[at], places[from], places[to])));
        let farthest = distances.max_by(|(_, one), (_, other)| one.total_cmp(other));
        if let Some((at, _)) = farthest.filter(|(_, distance)| *distance > THINNED_PX) {
            is_kept[at] = true;
            spans.extend([(from, at), (at, to)]);
        }
    }
    places.iter().zip(is_kept).filter_map(|(place, is_kept)| is_kept.then_some(*place)).collect()
}

fn distance_to_segment([x, y]: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let [along, across] = [to[0] - from[0], to[1] - from[1]];
    let squared = along * along + across * across;
    let part = if squared > 0.0 { ((x - from[0]) * along + (y - from[1]) * across) / squared } else { 0.0 };
    let part = part.clamp(0.0, 1.0);
    (x - from[0] - part * along).hypot(y - from[1] - part * across)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_needs_its_ends_and_a_curve_what_is_seen() {
        let line: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
        assert_eq!(thinned(&line), [[0.0, 0.0], [99.0, 198.0]]);
        let wave: Vec<[f64; 2]> = (0..=500).map(|i| [f64::from(i), 50.0 * (f64::from(i) / 40.0).sin()]).collect();
        let few = thinned(&wave);
        assert!((40..250).contains(&few.len()), "{}", few.len());
        for place in wave {
            let nearest =
                few.windows(2).map(|ends| distance_to_segment(place, ends[0], ends[1])).fold(f64::MAX, f64::min);
            assert!(nearest <= THINNED_PX, "{nearest} at {place:?}");
        }
        assert_eq!(thinned(&[[1.0, 2.0], [1.0, 2.0]]).len(), 2);
        assert!(thinned(&[]).is_empty());
    }
}
