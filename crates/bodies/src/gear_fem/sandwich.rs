//! Products of compliances with the rows of multipliers on both sides.

use faer::Mat;
use sprs::CsMat;

use super::ring::Between;

/// Copies the entries below the diagonal to above it.
pub(super) fn mirror_below(matrix: &mut Mat<f64>) {
    for i in 0..matrix.nrows() {
        for j in i + 1..matrix.ncols() {
            matrix[(i, j)] = matrix[(j, i)];
        }
    }
}

/// Adds `left · Cᵀ · rightᵀ`, or with `half` its entries on and below the diagonal, at `places` of `sum`; `compliance` is C, with a row for each
/// column of `right`.
pub(super) fn add_sandwich(
    sum: &mut Mat<f64>,
    places: (usize, usize),
    left: &CsMat<f64>,
    compliance: Between<'_>,
    right: &CsMat<f64>,
    half: bool,
) {
    let (left_columns, left_place) = used_columns(left);
    let (right_columns, right_place) = used_columns(right);
    // Entries of C are gathered once into contiguous columns, as are those of the right.
    let width = right_columns.len();
    let gathered = compliance.gathered(&right_columns, &left_columns);
    let right_entries: Vec<(usize, f64)> =
        right.indices().iter().zip(right.data()).map(|(&column, &value)| (right_place[column], value)).collect();
    let right_rows = right.indptr();
    let mut carried = vec![0.0; width];
    for (i, row) in left.outer_iterator().enumerate() {
        carried.fill(0.0);
        for (k, value) in row.iter() {
            let column = &gathered[left_place[k] * width..][..width];
            for (sum, c) in carried.iter_mut().zip(column) {
                *sum += value * c;
            }
        }
        let count = if half { i + 1 } else { right.rows() };
        for (j, row) in right_rows.iter_outer_sz().take(count).enumerate() {
            let product: f64 = right_entries[row].iter().map(|&(place, value)| value * carried[place]).sum();
            sum[(places.0 + i, places.1 + j)] += product;
        }
    }
}

/// Columns with entries, and the place of each among them.
fn used_columns(operator: &CsMat<f64>) -> (Vec<usize>, Vec<usize>) {
    let mut used = operator.indices().to_vec();
    used.sort_unstable();
    used.dedup();
    let mut place = vec![usize::MAX; operator.cols()];
    for (k, &column) in used.iter().enumerate() {
        place[column] = k;
    }
    (used, place)
}
