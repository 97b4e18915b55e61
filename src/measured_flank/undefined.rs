//! Points of a trace that have no height: machines write a number of their own for them.
//!
//! A height is none where it is the number that the file names, where no flank is so far from its nominal one, and where it stands apart from all
//! others: the same number again and again, ten times as far from 0 as any other and at least 0.9 mm; or once, a hundred times as far as half of all
//! points.

/// Height that no flank has, µm.
const ABSURD_UM: f64 = 1e5;
/// Least size of a number that is repeated in place of heights, µm.
const LEAST_REPEATED_UM: f64 = 900.0;
/// Ratio of such a number to all other heights.
const REPEATED_APART: f64 = 10.0;
/// Ratio of a single height to the median that it cannot have.
const SINGLE_APART: f64 = 100.0;
/// Least median for that, µm.
const LEAST_MEDIAN_UM: f64 = 10.0;

/// Whether each of `values_um` is no height; `named` is the number the file names for it, as written in it.
pub(super) fn undefined(values_um: &[f64], named: Option<f64>) -> Vec<bool> {
    let is_named = |value: f64| named.is_some_and(|named| (value - named).abs() <= 1e-6 * named.abs());
    let absurd = |value: f64| is_named(value) || value.abs() >= ABSURD_UM;
    let mut sizes: Vec<f64> = values_um.iter().filter(|&&value| !absurd(value)).map(|value| value.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let most = SINGLE_APART * median.max(LEAST_MEDIAN_UM);
    let greatest = sizes.last().copied().unwrap_or(0.0);
    let next = sizes.iter().rev().find(|&&size| size < greatest).copied().unwrap_or(greatest);
    let times = sizes.iter().filter(|&&size| size == greatest).count();
    let is_repeated = times > 1 && greatest >= LEAST_REPEATED_UM && greatest >= REPEATED_APART * next;
    let undefined = |&value: &f64| absurd(value) || value.abs() > most || is_repeated && value.abs() == greatest;
    values_um.iter().map(undefined).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_stay_and_sentinels_go() {
        let wear: Vec<f64> = (0..50).map(|i| -0.4 * f64::from(i)).collect();
        assert!(undefined(&wear, None).iter().all(|gone| !gone));
        // A stylus trace of a large tooth: its curvature, in mm.
        let curved: Vec<f64> = (0..50).map(|i| -(f64::from(i) - 25.0).powi(2) * 8.0).collect();
        assert!(undefined(&curved, None).iter().all(|gone| !gone));
        let gone =
            |more: &[f64], named| undefined(&[more, &wear[..]].concat(), named).iter().filter(|&&gone| gone).count();
        assert_eq!(gone(&[-2147483.648], None), 1);
        assert_eq!(gone(&[-9999.0; 200], None), 200);
        assert_eq!(gone(&[-77.5; 3], Some(-77.5)), 3);
        assert_eq!(gone(&[], Some(-77.5)), 0);
        assert!(undefined(&[], None).is_empty());
    }
}
