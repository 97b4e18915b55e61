//! Measurements of wear: rows of one gear, time and kind together.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::wear_table::{WearKind, WearRow, WearValue};
use crate::compare::asked::PreparedComparison;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::HALF_WIDTH_95;
use gearwear_bodies::reference::statistics::mean;

/// Relative difference up to which times are equal: hours and revolutions round differently.
const SAME_TIME: f64 = 1e-9;

/// Profile whose comparison with the run gives a wear coefficient.
#[derive(Debug)]
pub struct ProfileToFit {
    pub file: String,
    pub comparison: PreparedComparison,
}

/// A measurement: the mean of its teeth, or repetitions.
#[derive(Debug)]
pub struct WearMeasurement {
    pub gear: Gear,
    /// Of the pinion.
    pub revolutions: f64,
    pub kind: WearKind,
    /// Lines of the table.
    pub lines: Vec<usize>,
    /// Values of the teeth, mg or µm; none of profiles.
    pub values: Vec<f64>,
    /// Standard deviation of each value, as given.
    pub sigmas: Vec<Option<f64>>,
    pub profiles: Vec<ProfileToFit>,
}

impl WearMeasurement {
    /// Of one row; a profile with its comparison.
    pub fn new(row: &WearRow, gear: Gear, revolutions: f64, comparison: Option<PreparedComparison>) -> Self {
        let values = match row.value {
            WearValue::MassMg(value) | WearValue::DepthUm(value) => vec![value],
            WearValue::Profile(_) => Vec::new(),
        };
        let file = if let WearValue::Profile(file) = &row.value { file.clone() } else { String::new() };
        Self {
            gear,
            revolutions,
            kind: row.value.kind(),
            lines: vec![row.line],
            values,
            sigmas: vec![row.sigma],
            profiles: comparison.map(|comparison| ProfileToFit { file, comparison }).into_iter().collect(),
        }
    }

    fn is_with(&self, other: &Self) -> bool {
        let same_time = (self.revolutions / other.revolutions - 1.0).abs() <= SAME_TIME;
        (self.gear, self.kind) == (other.gear, other.kind) && same_time
    }
}

/// Measurements by gear and time, rows that belong together in one.
pub fn in_order(mut rows: Vec<WearMeasurement>) -> Vec<WearMeasurement> {
    rows.sort_by(|a, b| (a.gear, a.kind).cmp(&(b.gear, b.kind)).then(a.revolutions.total_cmp(&b.revolutions)));
    let mut measurements: Vec<WearMeasurement> = Vec::new();
    for row in rows {
        match measurements.last_mut().filter(|last| last.is_with(&row)) {
            Some(last) => {
                last.lines.extend(row.lines);
                last.values.extend(row.values);
                last.sigmas.extend(row.sigmas);
                last.profiles.extend(row.profiles);
            }
            None => measurements.push(row),
        }
    }
    measurements.sort_by(|a, b| a.gear.cmp(&b.gear).then(a.revolutions.total_cmp(&b.revolutions)));
    measurements
}

/// Values of a measurement in one unit, each with what is known of its relative standard deviation.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothValues {
    pub values: Vec<f64>,
    pub relative_sigmas: Vec<f64>,
}

impl ToothValues {
    pub fn mean(&self) -> f64 {
        mean(self.values.iter().copied())
    }

    /// Sum of the squares of the relative deviations from the mean.
    fn squares(&self) -> f64 {
        let mean = self.mean();
        self.values.iter().map(|value| (value / mean - 1.0).powi(2)).sum()
    }
}

/// Known relative standard deviation of the mean of each of `measurements`: as given, and the scatter of teeth about their means, which is one for all
/// of them.
///
/// The scatter has Σ (m − 1) degrees of freedom, few of which widen it by the ratio of the quantiles of Student's t and of the normal distribution.
pub fn relative_sigmas(measurements: &[ToothValues]) -> Vec<f64> {
    let freedom: usize = measurements.iter().map(|of| of.values.len() - 1).sum();
    let squares: f64 = measurements.iter().map(ToothValues::squares).sum();
    let of_tooth = match StudentsT::new(0.0, 1.0, freedom as f64) {
        Ok(t) if freedom > 0 => (squares / freedom as f64).sqrt() * t.inverse_cdf(0.975) / HALF_WIDTH_95,
        _ => 0.0,
    };
    let of_mean = |of: &ToothValues| {
        let count = of.values.len() as f64;
        let given = of.relative_sigmas.iter().map(|sigma| sigma * sigma).sum::<f64>() / (count * count);
        // One tooth scatters about the gear's mean as others do, where others tell how.
        (given + of_tooth * of_tooth / count).sqrt()
    };
    measurements.iter().map(of_mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two times of three teeth, ±10 % and ±20 % about their means: (0.02 + 0.08)/4 is the pooled variance; t(0.975, 4) = 2.7764 (tables).
    #[test]
    fn ver_scatter_of_teeth_is_pooled() {
        let teeth = |values: [f64; 3]| ToothValues { values: values.to_vec(), relative_sigmas: vec![0.0; 3] };
        let sigmas = relative_sigmas(&[teeth([0.9, 1.0, 1.1]), teeth([8.0, 10.0, 12.0])]);
        let expected = (0.025f64).sqrt() * 2.7764 / 1.959964 / 3f64.sqrt();
        assert!(sigmas.iter().all(|sigma| (sigma / expected - 1.0).abs() < 1e-4), "{sigmas:?} {expected}");
        let single = ToothValues { values: vec![2.0], relative_sigmas: vec![0.05] };
        assert_eq!(relative_sigmas(&[single]), [0.05]);
    }
}
