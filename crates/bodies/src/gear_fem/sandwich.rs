//! Products of compliances with the rows of multipliers on both sides.

use faer::Mat;
use sprs::CsMat;

use super::ring::GearCompliance;

/// Rows of multipliers on a tooth of a gear.
pub(super) struct ToothRows<'a> {
    gear: &'a GearCompliance,
    tooth: usize,
    first_row: usize,
    operator: &'a CsMat<f64>,
    /// Displacement of each row, in a column, by the shapes that cuts carry.
    carried: Mat<f64>,
}

impl<'a> ToothRows<'a> {
    /// Rows of `operator` from `first_row` on; its columns are those of the candidates of `tooth`.
    pub(super) fn new(gear: &'a GearCompliance, tooth: usize, first_row: usize, operator: &'a CsMat<f64>) -> Self {
        let shapes = gear.shapes();
        let mut carried = Mat::zeros(shapes.nrows(), operator.rows());
        for (row, entries) in operator.outer_iterator().enumerate() {
            let mut sum = carried.col_mut(row);
            entries.iter().for_each(|(column, b)| sum += shapes.col(column) * faer::Scale(*b));
        }
        Self { gear, tooth, first_row, operator, carried }
    }

    /// Adds the product B C B'ᵀ with the rows B' of `right` to `sum`, or with `half` its entries on and below the diagonal.
    pub(super) fn add_product(&self, right: &ToothRows<'_>, half: bool, sum: &mut Mat<f64>) {
        let softness = self.gear.softness();
        let by_shape = self.gear.between_cuts(self.tooth, right.tooth) * &right.carried;
        let product = self.carried.transpose() * by_shape;
        for j in 0..product.ncols() {
            let first = if half { j } else { 0 };
            for i in first..product.nrows() {
                sum[(self.first_row + i, right.first_row + j)] += softness * product[(i, j)];
            }
        }
        if self.tooth == right.tooth {
            self.add_held_product(right, half, sum);
        }
    }

    /// Adds the part of the product with held cuts.
    fn add_held_product(&self, right: &ToothRows<'_>, half: bool, sum: &mut Mat<f64>) {
        let (held, softness) = (self.gear.held(), self.gear.softness());
        let used = used_columns(self.operator);
        let mut moved = vec![0.0; used.len()];
        for (j, row) in right.operator.outer_iterator().enumerate() {
            moved.fill(0.0);
            for (column, b) in row.iter() {
                let by_force = held.col(column).try_as_col_major().map_or(&[][..], |column| column.as_slice());
                moved.iter_mut().zip(&by_force[used.clone()]).for_each(|(sum, c)| *sum += b * c);
            }
            let first = if half { j } else { 0 };
            for (i, row) in self.operator.outer_iterator().enumerate().skip(first) {
                let product: f64 = row.iter().map(|(column, b)| b * moved[column - used.start]).sum();
                sum[(self.first_row + i, right.first_row + j)] += softness * product;
            }
        }
    }
}

/// Copies the entries below the diagonal to above it.
pub(super) fn mirror_below(matrix: &mut Mat<f64>) {
    for j in 0..matrix.ncols() {
        for i in 0..j {
            matrix[(i, j)] = matrix[(j, i)];
        }
    }
}

/// Range of the columns with entries.
fn used_columns(operator: &CsMat<f64>) -> std::ops::Range<usize> {
    let first = operator.indices().iter().copied().min().unwrap_or(0);
    first..operator.indices().iter().map(|column| column + 1).max().unwrap_or(first)
}
