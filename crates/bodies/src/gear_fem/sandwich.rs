//! Products of compliances with the rows of multipliers on both sides.

use std::ops::Range;

use faer::{ColRef, Mat};
use sprs::CsMat;

use super::ring::GearCompliance;
use gearwear_fem::weighted_sum::weighted_sum;

/// Rows B of multipliers, apart from the teeth of the gear that they are on.
pub(super) struct CarriedRows {
    rows: Vec<ToothRow>,
    /// Displacement of each row, in a column, by the shapes that cuts carry.
    carried: Mat<f64>,
}

/// Rows B of multipliers on a tooth of a gear.
pub(super) struct ToothRows<'a> {
    gear: &'a GearCompliance,
    tooth: usize,
    first_row: usize,
    of_gear: &'a CarriedRows,
}

/// Consecutive entries of a row.
struct ToothRow {
    first_column: usize,
    entries: Vec<f64>,
}

impl CarriedRows {
    /// Rows of `operator`, whose columns are those of the candidates of a tooth.
    pub(super) fn new(gear: &GearCompliance, operator: &CsMat<f64>) -> Self {
        let shapes = gear.shapes();
        let mut carried = Mat::zeros(shapes.nrows(), operator.rows());
        let rows = operator.outer_iterator().enumerate().map(|(k, row)| {
            let (first, last) = (row.indices().iter().min(), row.indices().iter().max());
            let (first, end) = (first.copied().unwrap_or(0), last.map_or(0, |last| last + 1));
            let mut entries = vec![0.0; end - first];
            for (column, &b) in row.iter() {
                entries[column - first] = b;
                let moved = carried.col_mut(k).iter_mut().zip(shapes.col(column).iter());
                moved.for_each(|(sum, shape)| *sum += b * shape);
            }
            ToothRow { first_column: first, entries }
        });
        Self { rows: rows.collect(), carried }
    }
}

impl<'a> ToothRows<'a> {
    /// Rows on `tooth` of the `gear`, from `first_row` on.
    pub(super) fn new(gear: &'a GearCompliance, tooth: usize, first_row: usize, of_gear: &'a CarriedRows) -> Self {
        Self { gear, tooth, first_row, of_gear }
    }

    fn rows(&self) -> &'a [ToothRow] {
        &self.of_gear.rows
    }

    /// Adds the product B C B'ᵀ with the rows B' of `right`, of which there are more, to `sum`.
    pub(super) fn add_product(&self, right: &ToothRows<'_>, sum: &mut Mat<f64>) {
        self.add_carried_product(right, sum);
        if self.tooth != right.tooth {
            return;
        }
        // C is symmetric: the displacements are found for the rows of the shorter side.
        let columns = used_columns(right.rows());
        for (i, row) in self.rows().iter().enumerate() {
            let moved = row.moved(self.gear, &columns);
            for (j, row) in right.rows().iter().enumerate() {
                sum[(self.first_row + i, right.first_row + j)] += row.along(&moved, columns.start);
            }
        }
    }

    /// Adds the part of the product B C B'ᵀ that the cuts carry.
    pub(super) fn add_carried_product(&self, right: &ToothRows<'_>, sum: &mut Mat<f64>) {
        let between = self.gear.between_cuts(self.tooth, right.tooth);
        let (own, others) = (&self.of_gear.carried, &right.of_gear.carried);
        let product = match own.ncols() < others.ncols() {
            true => (own.transpose() * between) * others,
            false => own.transpose() * (between * others),
        };
        for j in 0..product.ncols() {
            for i in 0..product.nrows() {
                sum[(self.first_row + i, right.first_row + j)] += self.gear.softness() * product[(i, j)];
            }
        }
    }

    /// Entries on and below the diagonal of the products B C B'ᵀ with held cuts, for B and B' each of the `kinds` of rows of the same multipliers on a
    /// tooth: numbers of both kinds, row, column and entry to `take`.
    pub(super) fn held_products(kinds: &[&ToothRows<'_>], take: &mut dyn FnMut([usize; 2], [usize; 2], f64)) {
        let count = kinds.first().map_or(0, |kind| kind.rows().len());
        let mut of_later_rows: Option<Range<usize>> = None;
        let columns = (0..count).rev().map(|j| {
            let own = kinds.iter().map(|kind| used_columns(&kind.rows()[j..=j]));
            of_later_rows = own.chain(of_later_rows.clone()).reduce(joined);
            of_later_rows.clone().unwrap_or_default()
        });
        let columns: Vec<Range<usize>> = columns.collect();
        for (j, columns) in columns.iter().rev().enumerate() {
            for (b, right) in kinds.iter().enumerate() {
                let moved = right.rows()[j].moved(right.gear, columns);
                for (a, left) in kinds.iter().enumerate() {
                    for (i, row) in left.rows().iter().enumerate().skip(j) {
                        let places = [left.first_row + i, right.first_row + j];
                        take([a, b], places, row.along(&moved, columns.start));
                    }
                }
            }
        }
    }
}

impl ToothRow {
    fn entries(&self) -> ColRef<'_, f64> {
        ColRef::from_slice(&self.entries)
    }

    /// Displacements of these candidate columns by the row's force, with held cuts.
    fn moved(&self, gear: &GearCompliance, columns: &Range<usize>) -> Vec<f64> {
        let by_force = gear.held().subcols(self.first_column, self.entries.len());
        let moved = by_force.subrows(columns.start, columns.len()) * self.entries();
        moved.iter().map(|moved| gear.softness() * moved).collect()
    }

    /// Displacement of the row where the candidate columns from `first` on move by `moved`.
    fn along(&self, moved: &[f64], first: usize) -> f64 {
        weighted_sum(&self.entries, &moved[self.first_column - first..])
    }
}

/// Range of the columns with entries.
fn used_columns(rows: &[ToothRow]) -> Range<usize> {
    rows.iter().map(|row| row.first_column..row.first_column + row.entries.len()).reduce(joined).unwrap_or_default()
}

/// Range over both.
fn joined(one: Range<usize>, other: Range<usize>) -> Range<usize> {
    one.start.min(other.start)..one.end.max(other.end)
}

/// Copies the entries below the diagonal to above it.
pub(super) fn mirror_below(matrix: &mut Mat<f64>) {
    for j in 0..matrix.ncols() {
        for i in 0..j {
            matrix[(i, j)] = matrix[(j, i)];
        }
    }
}
