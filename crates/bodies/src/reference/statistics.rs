//! Extent, mean, standard deviation and quantiles of samples.

/// Standard deviations between the middle and an end of a 95 % interval of a normal distribution.
pub const HALF_WIDTH_95: f64 = 1.959_963_984_540_054;
/// Probabilities of the quantiles.
pub const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Least and greatest of `values`; +∞ and −∞ without values.
pub fn extent(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// Mean Σ x / n.
pub fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count();
    values.sum::<f64>() / count as f64
}

/// Standard deviation √(Σ (x − x̄)² / (n − 1)); `None` for fewer than two values.
pub fn standard_deviation(values: &[f64]) -> Option<f64> {
    let middle = mean(values.iter().copied());
    let squares: f64 = values.iter().map(|value| (value - middle) * (value - middle)).sum();
    (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt())
}

/// Quantile of `sorted` values with linear interpolation between the probabilities i/(n − 1); `None` without values, or where it is infinite.
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * (sorted.len().checked_sub(1)? as f64);
    let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    let value = if below == above { below } else { below + (above - below) * place.fract() };
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ver_of_a_few_numbers() {
        let sorted = [1.0, 2.0, 4.0, 8.0, f64::INFINITY];
        assert_eq!(SHARES.map(|share| quantile(&sorted, share)), [Some(1.2), Some(2.0), Some(4.0), Some(8.0), None]);
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!((standard_deviation(&[1.0, 3.0]), standard_deviation(&[1.0])), (Some(2.0_f64.sqrt()), None));
    }
}
