//! Fields over the face width of a pair with slices, and how different numbers of slices are brought together.
//!
//! The value of a slice stands at its middle, z_i = (i + 1/2) b/m. Between the middles a field is linear in z; over the outer
//! half of the first and the last slice it goes on as straight lines, since a slice does not know where on it the tooth ends:
//! holding the values there would leave an error of first order in the slices' width at both ends of the tooth. Depths are
//! never negative.

use gearwear_bodies::gear::PerGear;
use gearwear_bodies::reference::linear_means::value_at;
use gearwear_physics::results::run::{RunRecord, SliceRecord};

/// Curves over the face width.
#[derive(Debug, Clone, PartialEq)]
pub struct OverWidth {
    pub width_mm: Vec<f64>,
    /// Greatest depth in the root zone of each slice.
    pub root_wear_um: PerGear<Vec<f64>>,
    /// Face load factor K_Hβ, new.
    pub face_load_factor: f64,
    /// Face load factor, worn.
    pub worn_face_load_factor: f64,
}

impl OverWidth {
    /// The curves of a run; none where all sections are alike.
    pub fn of(record: &RunRecord) -> Option<Self> {
        let helical = record.summary.helical.as_ref()?;
        Some(Self {
            width_mm: helical.width_mm.clone(),
            root_wear_um: PerGear::from_fn(|gear| helical.wear[gear].root_wear_um.clone()),
            face_load_factor: helical.K_Hbeta_new,
            worn_face_load_factor: helical.K_Hbeta_worn,
        })
    }

    /// Curves at other places over the face width.
    pub fn at_widths(&self, width_mm: &[f64]) -> Self {
        let root_wear_um = PerGear::from_fn(|gear| {
            let own: Vec<&[f64]> = self.root_wear_um[gear].chunks_exact(1).collect();
            depths_at_widths(&self.width_mm, &own, width_mm)
        });
        Self { width_mm: width_mm.to_vec(), root_wear_um, ..*self }
    }

    /// self + factor · (fine − coarse), value by value; all three at the same places.
    pub fn corrected(&self, factor: f64, fine: &Self, coarse: &Self) -> Self {
        let new = fine.face_load_factor - coarse.face_load_factor;
        let worn = fine.worn_face_load_factor - coarse.worn_face_load_factor;
        Self {
            width_mm: self.width_mm.clone(),
            root_wear_um: PerGear::from_fn(|gear| {
                let [own, fine, coarse] = [self, fine, coarse].map(|of| &of.root_wear_um[gear][..]);
                corrected(factor, own, fine, coarse).map(|depth| depth.max(0.0)).collect()
            }),
            face_load_factor: self.face_load_factor + factor * new,
            worn_face_load_factor: self.worn_face_load_factor + factor * worn,
        }
    }
}

/// Depths of slices at increasing `width_mm` (`slices`: one row of points each, all of the same length), at other widths, row
/// after row; one slice stands for all widths.
pub fn depths_at_widths(width_mm: &[f64], slices: &[&[f64]], at_mm: &[f64]) -> Vec<f64> {
    let depths = at_mm.iter().flat_map(|&place| {
        let (before, after, weight) = neighbours(width_mm, place);
        slices[before].iter().zip(slices[after]).map(move |(a, b)| (a + weight * (b - a)).max(0.0))
    });
    depths.collect()
}

/// The two neighbouring places for the linear interpolation at `at`, and its weight.
fn neighbours(places: &[f64], at: f64) -> (usize, usize, f64) {
    if places.len() < 2 {
        return (0, 0, 0.0);
    }
    let after = places.partition_point(|&known| known <= at).clamp(1, places.len() - 1);
    (after - 1, after, (at - places[after - 1]) / (places[after] - places[after - 1]))
}

/// The greatest pressure that any slice has with its own theoretical contact point at `position_mm`, new.
///
/// A slice that touches at a tip edge does so at A or E of its own, wherever the middle of the face width is by then.
pub fn pressure_along_path_mpa(slices: &SliceRecord, position_mm: &[f64]) -> Vec<f64> {
    let count = slices.width_mm.len();
    let mut greatest = vec![0.0; position_mm.len()];
    for (slice, ahead) in slices.ahead_mm.iter().enumerate() {
        let own: Vec<f64> = slices.peak_pressure_new_MPa.iter().skip(slice).step_by(count).copied().collect();
        let middle: Vec<f64> = position_mm.iter().map(|at| at - ahead).collect();
        let there = interpolated(&slices.position_mm, &own, &middle);
        greatest.iter_mut().zip(there).for_each(|(greatest, pressure)| *greatest = f64::max(*greatest, pressure));
    }
    greatest
}

/// Values given at increasing `x`, at other places; beyond the ends the value there, 0 where there is none at all.
pub fn interpolated(x: &[f64], values: &[f64], at: &[f64]) -> Vec<f64> {
    at.iter()
        .map(|&place| match (x.len(), values) {
            (0, _) => 0.0,
            (1, values) => values[0],
            (_, values) => value_at(x, values, place),
        })
        .collect()
}

/// own + factor · (fine − coarse), value by value.
pub(super) fn corrected<'a>(
    factor: f64,
    own: &'a [f64],
    fine: &'a [f64],
    coarse: &'a [f64],
) -> impl Iterator<Item = f64> + 'a {
    own.iter().zip(fine.iter().zip(coarse)).map(move |(x, (f, c))| x + factor * (f - c))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two points a slice, straight over the width: met exactly between the middles and over the outer halves, and never below
    /// zero; a single slice stands for all.
    #[test]
    fn ver_straight_fields_are_exact_to_the_ends_of_the_tooth() {
        let width: Vec<f64> = (0..4).map(|i| 2.5 + 5.0 * f64::from(i)).collect();
        let field: Vec<[f64; 2]> = width.iter().map(|z| [1.0 + 0.1 * z, 1.0 - 0.1 * z]).collect();
        let rows: Vec<&[f64]> = field.iter().map(|row| &row[..]).collect();
        let found = depths_at_widths(&width, &rows, &[0.0, 9.0, 20.0]);
        for (value, expected) in found.iter().zip([1.0, 1.0, 1.9, 0.1, 3.0, 0.0]) {
            assert!((value - expected).abs() < 1e-14, "{value} {expected}");
        }
        assert_eq!(depths_at_widths(&[10.0], &rows[..1], &[1.0, 19.0]), [1.25, 0.75, 1.25, 0.75]);
    }

    /// Two slices 2 mm apart along the path: the pressure of each is read where its own contact point is.
    #[test]
    fn pressures_are_told_by_the_slices_own_position() {
        let slices = SliceRecord {
            width_mm: vec![5.0, 15.0],
            ahead_mm: vec![1.0, -1.0],
            position_mm: vec![4.0, 5.0, 6.0, 7.0],
            line_load_new_N_per_mm: vec![0.0; 8],
            line_load_worn_N_per_mm: vec![0.0; 8],
            // The first slice at 5, 6, 7, 8 of its own path, the second at 3, 4, 5, 6.
            peak_pressure_new_MPa: vec![900.0, 0.0, 100.0, 0.0, 100.0, 200.0, 0.0, 300.0],
            peak_pressure_worn_MPa: vec![0.0; 8],
            at_sharp_edge_new: vec![false; 8],
            at_sharp_edge_worn: vec![false; 8],
        };
        assert_eq!(pressure_along_path_mpa(&slices, &[5.0, 6.0, 7.0]), [900.0, 300.0, 300.0]);
    }

    /// A straight line is met exactly between its points, and held beyond them.
    #[test]
    fn ver_interpolation_is_exact_for_straight_lines() {
        let found = interpolated(&[0.0, 1.0, 3.0], &[1.0, 3.0, 7.0], &[-1.0, 0.5, 2.0, 3.0, 9.0]);
        assert_eq!(found, [1.0, 2.0, 5.0, 7.0, 7.0]);
        assert_eq!(interpolated(&[], &[], &[1.0]), [0.0]);
        assert_eq!(interpolated(&[2.0], &[5.0], &[1.0, 3.0]), [5.0, 5.0]);
    }
}
