//! The face width cut into thin transverse slices.
//!
//! A helical tooth is a stack of thin spur teeth, each turned a little against the one before. In the transverse section of
//! slice i at the axial place z_i the theoretical contact point runs along the same path A–E as in every other, but is there
//! earlier or later: with ξ the position in the middle of the face width,
//!
//! ```text
//! ξ_i = ξ + (b/2 − z_i) tan β_b        tan β_b = tan β cos α_t        b tan β_b = ε_β p_bt
//! ```
//!
//! so that for a positive helix angle the slice at z = 0 enters the mesh first. At any moment the contact points of one tooth
//! lie on a straight line, oblique on the flank by β_b: its line of contact, l / cos β_b long where it spans the width l.
//!
//! All quantities of a slice are transverse ones.
//!
//! What is greatest over the face width is read at fixed places, whatever the number of slices: the outermost ones lie z₀ = b/40 from either end
//! face, where the outermost of 20 slices have their middles. With the value of a slice in its middle, and straight lines through the middles of
//! neighbours,
//!
//! ```text
//! max { v(z₀), v(b − z₀), v(z_i) for all z_i between }
//! ```
//!
//! Read in the outermost slice, wherever its middle is, a value that rises towards an end face would grow with the number of slices. Nearer to it
//! the plane contact of a slice does not hold, and end faces have chamfers that no slice knows.
//!
//! Source: ISO 21771, sections 5.4 and 5.5.

use super::GearPair;

/// Parts of the face width, one of which at either end face is left out where a greatest value is read.
const PARTS: f64 = 40.0;

/// Slices of the same width, from z = 0 to z = b.
#[derive(Debug, Clone, PartialEq)]
pub struct Slices {
    /// Place of each over the face width: its middle.
    pub width_mm: Vec<f64>,
    /// How far its theoretical contact point is ahead of that in the middle of the face width, along the path of contact.
    pub ahead_mm: Vec<f64>,
    /// Width of each.
    pub slice_width_mm: f64,
    /// By how much the theoretical contact point of a section is further ahead at one side of a slice than at the other.
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

    /// How many.
    pub fn count(&self) -> usize {
        self.width_mm.len()
    }
}

/// Where a greatest value over the face width is read, with the slice that has its middle nearest there, of slices with these `values` (at
/// least one): theirs, the outermost ones but for what is nearer to an end face than any reading, then the readings next to the end faces.
pub(crate) fn readings_over_width(values: &[f64]) -> impl Iterator<Item = (usize, f64)> + '_ {
    let last = values.len() - 1;
    // The outermost reading in widths of a slice from the middle of the outermost slice, inwards.
    let place = values.len() as f64 / PARTS - 0.5;
    let outermost = place.ceil().max(0.0) as usize;
    let before = (place.max(0.0) as usize).min(last.saturating_sub(1));
    let beside = (before + 1).min(last);
    let weight = place - before as f64;
    let nearest = if weight < 0.5 { before } else { beside };
    let between = move |from: usize, to: usize| values[from] + weight * (values[to] - values[from]);
    let ends = [(nearest, between(before, beside)), (last - nearest, between(last - before, last - beside))];
    (outermost..=last - outermost).map(|slice| (slice, values[slice])).chain(ends)
}

/// The greatest of these `values` (≥ 0, at least one) of slices, over the face width.
pub fn greatest_over_width(values: &[f64]) -> f64 {
    readings_over_width(values).map(|(_, value)| value).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line over the face width has the same greatest value with any number of slices, 1/40 of the width from the end face; 20 slices
    /// are read as they are, and one stands for all.
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

    /// What is greatest between the outermost readings is read in the slice that has it.
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
