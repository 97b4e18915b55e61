//! Thin transverse slices of the face width.
//!
//! A helical tooth is a stack of thin spur teeth, each turned relative to the one before. In the transverse section of
//! slice i at z_i the theoretical contact point moves along the same path A–E as in every other, but
//! earlier or later: with ξ the position in the middle of the face width,
//!
//! ```text
//! ξ_i = ξ + (b/2 − z_i) tan β_b        tan β_b = tan β cos α_t        b tan β_b = ε_β p_bt
//! ```
//!
//! so that for a positive helix angle the slice at z = 0 enters the mesh first. At any moment the contact points of one tooth
//! lie on a straight line at the angle β_b, its line of contact, whose length over a width l is l / cos β_b.
//!
//! All quantities of a slice are transverse ones.
//!
//! Greatest values over the face width are read at the same outermost places for any number of slices, z₀ = b/40 from either end
//! face, where the outermost of 20 slices have their middles. With the value of a slice in its middle, and linear interpolation between
//! neighbours,
//!
//! ```text
//! max { v(z₀), v(b − z₀), v(z_i) for all z_i between }
//! ```
//!
//! In the middle of the outermost slice, a value that rises towards an end face would grow with the number of slices. Nearer to the end face
//! the plane contact of a slice is not valid, and chamfers are not modelled.
//!
//! Source: ISO 21771, sections 5.4 and 5.5.

use super::GearPair;

/// Ratio of the face width to the distance of the outermost readings from the end faces.
const PARTS: f64 = 40.0;

/// Slices of equal width, from z = 0 to z = b.
#[derive(Debug, Clone, PartialEq)]
pub struct Slices {
    /// Middle z_i of each slice.
    pub width_mm: Vec<f64>,
    /// Distance along the path of contact by which the theoretical contact point of each slice is ahead of that in the middle of the face width.
    pub ahead_mm: Vec<f64>,
    /// Width of a slice.
    pub slice_width_mm: f64,
    /// Difference of that distance between both sides of a slice.
    pub ahead_varies_mm: f64,
}

impl Slices {
    /// `count` (≥ 1) slices over the face width of `pair`.
    pub fn new(pair: &GearPair, count: usize) -> Self {
        let face_width = pair.spec.face_width_mm;
        let slice_width_mm = face_width / count as f64;
        let width_mm: Vec<f64> = (0..count).map(|i| (i as f64 + 0.5) * slice_width_mm).collect();
        let tan_beta_b = pair.base_helix_angle_rad().tan();
        let ahead_mm = width_mm.iter().map(|z| (0.5 * face_width - z) * tan_beta_b).collect();
        Self { width_mm, ahead_mm, slice_width_mm, ahead_varies_mm: slice_width_mm * tan_beta_b.abs() }
    }

    /// Number of slices.
    pub fn count(&self) -> usize {
        self.width_mm.len()
    }
}

/// Readings over the face width of slices with `values` (at least one), each with the nearest slice: the values of slices no nearer to an end
/// face than the outermost readings, then these.
pub fn readings_over_width(values: &[f64]) -> impl Iterator<Item = (usize, f64)> + '_ {
    let last = values.len() - 1;
    // Distance of the outermost reading from the middle of the outermost slice, inwards, in slice widths.
    let place = values.len() as f64 / PARTS - 0.5;
    let outermost = place.ceil().max(0.0) as usize;
    let before = (place.max(0.0) as usize).min(last.saturating_sub(1));
    let beside = (before + 1).min(last);
    let weight = place - before as f64;
    let nearest = if weight < 0.5 { before } else { beside };
    let ends = [(nearest, before, beside), (last - nearest, last - before, last - beside)]
        .map(|(slice, from, to)| (slice, values[from] + weight * (values[to] - values[from])));
    (outermost..=last - outermost).map(|slice| (slice, values[slice])).chain(ends)
}

/// Greatest value over the face width of slices with `values` (≥ 0, at least one).
pub fn greatest_over_width(values: &[f64]) -> f64 {
    readings_over_width(values).map(|(_, value)| value).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear function over the face width has the same greatest value with any number of slices, 1/40 of the width from the end face; 20 slices
    /// are read in their middles, and a single one gives its value.
    #[test]
    fn ver_greatest_values_are_read_at_the_same_places() {
        for count in [2, 7, 19, 21, 40, 41, 80, 200] {
            let rising: Vec<f64> = (0..count).map(|i| 1.0 + (f64::from(i) + 0.5) / f64::from(count)).collect();
            let falling: Vec<f64> = rising.iter().rev().copied().collect();
            for values in [rising, falling] {
                let found = greatest_over_width(&values);
                assert!((found - (2.0 - 1.0 / PARTS)).abs() < 1e-14, "{count}: {found}");
            }
        }
        let twenty: Vec<f64> = (0..20).map(|i| f64::from((7 * i + 3) % 20)).collect();
        assert_eq!(greatest_over_width(&twenty), 19.0);
        let steep: Vec<f64> = (0..20).map(|i| f64::from(i * i)).collect();
        assert_eq!(greatest_over_width(&steep), 361.0);
        assert_eq!(greatest_over_width(&[3.0]), 3.0);
    }

    /// A maximum between the outermost readings is read in its slice.
    #[test]
    fn greatest_values_in_the_middle_are_those_of_their_slices() {
        for count in [5, 20, 60] {
            let mut values = vec![1.0; count];
            values[count / 2] = 4.0;
            let deepest = readings_over_width(&values).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            assert_eq!(deepest, (count / 2, 4.0));
        }
    }
}
