//! An axis of a figure: from values to places on the drawing, and where its ticks are.

use crate::report::chart::Axis;
use crate::report::html::number::{superscript, to_digits};
use gearwear_bodies::reference::statistics::extent;

/// Of a range that follows from the values, the part that is added on either side.
const ROOM: f64 = 0.05;
/// Decades of a logarithmic axis up to which it has ticks at 2 and 5 as well.
const FEW_DECADES: f64 = 2.5;
/// Decades below which there may be less than two of these: from just above 2 to just below 10.
const LEAST_DECADES: f64 = 0.7;

/// An axis with its range in coordinates (of a logarithmic axis exponents) and its ends on the drawing.
pub(super) struct PlacedAxis<'a> {
    pub words: &'a Axis,
    pub range: [f64; 2],
    /// The range before it was widened to draw to scale.
    pub asked: [f64; 2],
    /// Names at 0, 1, 2 … where the axis has no numbers.
    pub categories: Vec<String>,
    place: [f64; 2],
}

impl<'a> PlacedAxis<'a> {
    /// Where `words` gives no range, around `values`, to their ends if `tight`.
    pub(super) fn new(
        words: &'a Axis,
        values: impl Iterator<Item = f64>,
        categories: Vec<String>,
        tight: bool,
    ) -> Self {
        let mut axis = Self { words, range: [0.0, 1.0], asked: [0.0, 1.0], categories, place: [0.0, 1.0] };
        let given = words.range.map(|range| range.map(|value| axis.coordinate(value)));
        let is_range = |range: &[f64; 2]| range.iter().all(|end| end.is_finite()) && range[0] != range[1];
        axis.asked = given.filter(is_range).unwrap_or_else(|| axis.around(values, tight));
        axis.range = axis.asked;
        axis
    }

    /// The range around `values`.
    pub(super) fn around(&self, values: impl Iterator<Item = f64>, tight: bool) -> [f64; 2] {
        let [low, high] = extent(values.map(|value| self.coordinate(value)).filter(|value| value.is_finite()));
        let room = if tight { 0.0 } else { ROOM * (high - low) };
        match (self.categories.len(), high - low) {
            (1.., _) => [-0.5, self.categories.len() as f64 - 0.5],
            // Bars stand on the axis.
            (0, width) if width > 0.0 && width.is_finite() && low == 0.0 && !self.words.is_logarithmic => {
                [0.0, high + room]
            }
            (0, width) if width > 0.0 && width.is_finite() => [low - room, high + room],
            _ if low.is_finite() && high.is_finite() => [low - 0.5, high + 0.5],
            _ => [0.0, 1.0],
        }
    }

    pub(super) fn placed(mut self, from: f64, to: f64) -> Self {
        self.place = [from, to];
        self
    }

    /// Widens the range about its middle until a unit is as long as `unit_px`.
    pub(super) fn with_unit(mut self, unit_px: f64) -> Self {
        let half = 0.5 * (self.place[1] - self.place[0]).abs() / unit_px;
        let middle = self.range[0].midpoint(self.range[1]);
        self.range = [middle - half, middle + half];
        self
    }

    /// Length of a unit on the drawing.
    pub(super) fn unit_px(&self) -> f64 {
        ((self.place[1] - self.place[0]) / (self.range[1] - self.range[0])).abs()
    }

    fn coordinate(&self, value: f64) -> f64 {
        if self.words.is_logarithmic { value.log10() } else { value }
    }

    /// Where `value` is on the drawing.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.at_coordinate(self.coordinate(value))
    }

    fn at_coordinate(&self, value: f64) -> f64 {
        let share = (value - self.range[0]) / (self.range[1] - self.range[0]);
        self.place[0] + share * (self.place[1] - self.place[0])
    }

    /// Places on the drawing with their labels, about as many as there is room for with one every `spacing_px`.
    pub(super) fn ticks(&self, spacing_px: f64) -> Vec<(f64, String)> {
        let most = ((self.place[1] - self.place[0]).abs() / spacing_px).max(1.0);
        let [low, high] = [self.range[0].min(self.range[1]), self.range[0].max(self.range[1])];
        let inside = |place: f64| low - 1e-9 * (high - low) <= place && place <= high + 1e-9 * (high - low);
        let ticks: Vec<(f64, String)> = match (&self.categories[..], &self.words.ticks[..]) {
            ([], []) if self.words.is_logarithmic && high - low < LEAST_DECADES => {
                let ticks = evenly(10f64.powf(low), 10f64.powf(high), most).into_iter();
                ticks.map(|(value, word)| (value.log10(), word)).collect()
            }
            ([], []) if self.words.is_logarithmic && high - low < FEW_DECADES => within_decades(low, high),
            ([], []) if self.words.is_logarithmic => decades(low, high, most),
            ([], []) => evenly(low, high, most),
            ([], given) => given.iter().map(|(value, word)| (self.coordinate(*value), word.clone())).collect(),
            (names, _) => names.iter().enumerate().map(|(i, name)| (i as f64, name.clone())).collect(),
        };
        let ticks = ticks.into_iter().filter(|(place, _)| inside(*place));
        ticks.map(|(place, word)| (self.at_coordinate(place), word)).collect()
    }
}

/// Round numbers.
fn evenly(low: f64, high: f64, most: f64) -> Vec<(f64, String)> {
    let step = round_step((high - low) / most);
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last).map(|i| i as f64 * step).map(|value| (value, label(value, step))).collect()
}

/// Powers of ten.
fn decades(low: f64, high: f64, most: f64) -> Vec<(f64, String)> {
    let step = ((high - low) / most).ceil().max(1.0);
    let (first, last) = ((low / step - 1e-9).ceil() as i32, (high / step + 1e-9).floor() as i32);
    let exponents = (first..=last).map(|i| i * step as i32);
    exponents.map(|exponent| (f64::from(exponent), format!("10{}", superscript(exponent)))).collect()
}

/// 1, 2 and 5 times powers of ten.
fn within_decades(low: f64, high: f64) -> Vec<(f64, String)> {
    let exponents = low.floor() as i32..=high.floor() as i32;
    let values = exponents.flat_map(|exponent| [1.0, 2.0, 5.0].map(|factor| factor * 10f64.powi(exponent)));
    values.map(|value| (value.log10(), plain(to_digits(value, 3)))).collect()
}

/// A number of a scale whose numbers are `step` apart.
fn label(value: f64, step: f64) -> String {
    if value != 0.0 && !(1e-4..1e6).contains(&step) {
        let digits = order(value) - order(step) + 1.0;
        return plain(to_digits(value, digits.clamp(1.0, 15.0) as usize));
    }
    let decimals = if (1e-4..1e6).contains(&step) { (-order(step)).max(0.0) as usize } else { 0 };
    format!("{value:.decimals$}").replace('-', "−")
}

/// Exponent of the power of ten at or below `value`.
fn order(value: f64) -> f64 {
    (value.abs().log10() + 1e-9).floor()
}

/// As it is, or with a power of ten where that is shorter.
fn plain(value: f64) -> String {
    if (1e-3..1e6).contains(&value.abs()) {
        return value.to_string().replace('-', "−");
    }
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{mantissa}·10{}", superscript(exponent.parse().unwrap_or(0))).replace('-', "−")
}

/// The least of 1, 2 and 5 times a power of ten that is not below `least`.
pub(super) fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::Chart;

    fn labels(chart: &Chart, values: &[f64]) -> Vec<String> {
        let axis = PlacedAxis::new(&chart.x, values.iter().copied(), Vec::new(), true).placed(0.0, 500.0);
        axis.ticks(100.0).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_numbers_within_the_range() {
        let within = |low, high| labels(&Chart::new("", "").x_range([low, high]), &[]);
        assert_eq!(within(-1.0, 1.0), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(within(8.5, -0.2), ["0", "2", "4", "6", "8"]);
        assert_eq!(within(0.0, 5e-5), ["0", "1·10⁻⁵", "2·10⁻⁵", "3·10⁻⁵", "4·10⁻⁵", "5·10⁻⁵"]);
        let logarithmic = Chart::new("", "").x_logarithmic();
        assert_eq!(labels(&logarithmic, &[1e-2, 1e1]), ["10⁻²", "10⁻¹", "10⁰", "10¹"]);
        assert_eq!(labels(&logarithmic, &[0.15, 2.5]), ["0.2", "0.5", "1", "2"]);
        assert_eq!(labels(&logarithmic, &[2.1, 4.9]), ["3", "4"]);
        assert_eq!(within(34.1234, 34.12355), ["34.1234", "34.12345", "34.1235", "34.12355"]);
        assert_eq!(labels(&Chart::new("", ""), &[]).len(), 6);
        assert_eq!(labels(&Chart::new("", ""), &[3.0]).first().unwrap(), "2.6");
    }

    #[test]
    fn ranges_may_run_downwards() {
        let chart = Chart::new("", "").x_range([10.0, 0.0]);
        let axis = PlacedAxis::new(&chart.x, std::iter::empty(), Vec::new(), false).placed(100.0, 0.0);
        assert_eq!([axis.at(10.0), axis.at(5.0), axis.at(0.0)], [100.0, 50.0, 0.0]);
    }
}
