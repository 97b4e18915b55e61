//! An axis of a figure: from values to places on the drawing, and where its ticks are.

use serde_json::Value;

use crate::reference::statistics::extent;
use crate::report::html::number::{superscript, to_digits};

/// Of a range that follows from the values, the part that is added on either side.
const ROOM: f64 = 0.05;

pub(super) struct Axis {
    /// Values at both ends; of a logarithmic axis their exponents.
    range: [f64; 2],
    is_logarithmic: bool,
    /// Names at 0, 1, 2 … where the axis has no numbers.
    pub categories: Vec<String>,
    /// Where the ends are on the drawing.
    place: [f64; 2],
    pub title: String,
    pub has_grid: bool,
}

impl Axis {
    /// The axis that `layout` describes; where it gives no range, around `values`, to their ends if `tight`.
    pub(super) fn new(layout: &Value, values: impl Iterator<Item = f64>, categories: Vec<String>, tight: bool) -> Self {
        let is_logarithmic = layout["type"] == "log";
        let given = || Some([layout["range"].get(0)?.as_f64()?, layout["range"].get(1)?.as_f64()?]);
        let exponent = |value: f64| if is_logarithmic { value.log10() } else { value };
        let [low, high] = extent(values.map(exponent).filter(|value| value.is_finite()));
        let room = if tight { 0.0 } else { ROOM * (high - low) };
        let around = match (categories.len(), high - low) {
            (1.., _) => [-0.5, categories.len() as f64 - 0.5],
            // Bars stand on the axis.
            (0, width) if width > 0.0 && width.is_finite() && low == 0.0 => [0.0, high + room],
            (0, width) if width > 0.0 && width.is_finite() => [low - room, high + room],
            _ if low.is_finite() && high.is_finite() => [low - 0.5, high + 0.5],
            _ => [0.0, 1.0],
        };
        let is_range = |range: &[f64; 2]| range.iter().all(|end| end.is_finite()) && range[0] != range[1];
        Self {
            range: given().filter(is_range).unwrap_or(around),
            is_logarithmic,
            categories,
            place: [0.0, 1.0],
            title: layout["title"]["text"].as_str().unwrap_or_default().to_owned(),
            has_grid: layout["showgrid"] != false,
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

    /// Where `value` is on the drawing.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.at_exponent(if self.is_logarithmic { value.log10() } else { value })
    }

    /// The same of a value that is already the exponent where the axis is logarithmic.
    pub(super) fn at_exponent(&self, value: f64) -> f64 {
        self.at_share((value - self.range[0]) / (self.range[1] - self.range[0]))
    }

    pub(super) fn at_share(&self, share: f64) -> f64 {
        self.place[0] + share * (self.place[1] - self.place[0])
    }

    /// Places on the drawing with their labels, about as many as there is room for with one every `spacing_px`.
    pub(super) fn ticks(&self, spacing_px: f64) -> Vec<(f64, String)> {
        if !self.categories.is_empty() {
            return self
                .categories
                .iter()
                .enumerate()
                .map(|(i, name)| (self.at_exponent(i as f64), name.clone()))
                .collect();
        }
        let [low, high] = [self.range[0].min(self.range[1]), self.range[0].max(self.range[1])];
        let most = ((self.place[1] - self.place[0]).abs() / spacing_px).max(1.0);
        let mut step = round_step((high - low) / most);
        if self.is_logarithmic && high - low >= 1.0 {
            step = step.ceil().max(1.0);
        }
        let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
        (first..=last)
            .map(|i| i as f64 * step)
            .map(|value| (self.at_exponent(value), self.label(value, step)))
            .collect()
    }

    fn label(&self, value: f64, step: f64) -> String {
        if self.is_logarithmic && value.fract() == 0.0 {
            return format!("10{}", superscript(value as i32));
        }
        let value = if self.is_logarithmic { 10f64.powf(value) } else { value };
        if self.is_logarithmic {
            return format!("{value:.2e}");
        }
        label(value, step)
    }
}

/// A number of a scale whose numbers are `step` apart.
fn label(value: f64, step: f64) -> String {
    let text = if (1e-4..1e6).contains(&step) {
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else if value == 0.0 {
        "0".to_owned()
    } else {
        format!("{:e}", to_digits(value, 6))
    };
    text.replace('-', "−")
}

/// The least of 1, 2 and 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn labels(layout: &Value, values: &[f64]) -> Vec<String> {
        let axis = Axis::new(layout, values.iter().copied(), Vec::new(), true).placed(0.0, 500.0);
        axis.ticks(100.0).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_numbers_within_the_range() {
        assert_eq!(labels(&json!({ "range": [-1.0, 1.0] }), &[]), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels(&json!({ "range": [8.5, -0.2] }), &[]), ["0", "2", "4", "6", "8"]);
        assert_eq!(labels(&json!({ "type": "log" }), &[1e-2, 1e1]), ["10⁻²", "10⁻¹", "10⁰", "10¹"]);
        assert_eq!(labels(&json!({ "range": [0.0, 5e-5] }), &[]), ["0", "1e−5", "2e−5", "3e−5", "4e−5", "5e−5"]);
        assert_eq!(labels(&json!({}), &[]).len(), 6);
        assert_eq!(labels(&json!({}), &[3.0]).first().unwrap(), "2.6");
    }

    #[test]
    fn ranges_may_run_downwards() {
        let axis =
            Axis::new(&json!({ "range": [10.0, 0.0] }), std::iter::empty(), Vec::new(), false).placed(100.0, 0.0);
        assert_eq!([axis.at(10.0), axis.at(5.0), axis.at(0.0), axis.at_share(1.0)], [100.0, 50.0, 0.0, 0.0]);
    }
}
