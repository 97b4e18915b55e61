//! Rows of a matrix with few weights each, on consecutive values.

use gearwear_bodies::reference::linear_means::weighted_sum;

/// Rows, each as long as it is.
#[derive(Debug, Clone, Default)]
pub(super) struct RowsOfAnyLength {
    /// Place of the first value of each row.
    first: Vec<usize>,
    /// End of each row in `weights`.
    ends: Vec<usize>,
    weights: Vec<f64>,
}

impl RowsOfAnyLength {
    /// Appends a row on the values from `first` on.
    pub(super) fn push(&mut self, first: usize, weights: &[f64]) {
        let zeros = weights.iter().take_while(|weight| **weight == 0.0).count().min(weights.len().saturating_sub(1));
        let end = weights.iter().rposition(|weight| *weight != 0.0).map_or(zeros, |last| last + 1);
        self.first.push(first + zeros);
        self.weights.extend_from_slice(&weights[zeros..end]);
        self.ends.push(self.weights.len());
    }

    fn row(&self, k: usize) -> (usize, &[f64]) {
        let begin = if k == 0 { 0 } else { self.ends[k - 1] };
        (self.first[k], &self.weights[begin..self.ends[k]])
    }

    /// The rows on so many values, all of one length.
    pub(super) fn packed(&self, values: usize) -> WeightedRows {
        let count = self.first.len();
        let width = (0..count).map(|k| self.row(k).1.len()).max().unwrap_or_default();
        let (mut first, mut packed) = (Vec::with_capacity(count), vec![0.0; count * width]);
        for (k, to) in (0..count).zip(packed.chunks_exact_mut(width.max(1))) {
            let (from, weights) = self.row(k);
            let begin = from.min(values - width);
            to[from - begin..][..weights.len()].copy_from_slice(weights);
            first.push(begin as u32);
        }
        WeightedRows { width, first, weights: packed }
    }
}

/// Rows of one length, zeros included, whose products take no branches that depend on the row.
#[derive(Debug, Clone)]
pub(super) struct WeightedRows {
    /// Weights of a row.
    width: usize,
    /// Place of the first value of each row.
    first: Vec<u32>,
    weights: Vec<f64>,
}

impl WeightedRows {
    /// Number of rows.
    pub(super) fn count(&self) -> usize {
        self.first.len()
    }

    /// Number of weights of a row.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Place of the first value of each row.
    pub(super) fn first(&self) -> &[u32] {
        &self.first
    }

    /// Place of the first value of a row, and its weights.
    pub(super) fn row(&self, k: usize) -> (usize, &[f64]) {
        (self.first[k] as usize, &self.weights[k * self.width..(k + 1) * self.width])
    }

    /// Products of the rows from `from` on with `values`.
    pub(super) fn times_from<'a>(&'a self, from: usize, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let rows = self.weights[from * self.width..].chunks_exact(self.width.max(1));
        self.first[from..]
            .iter()
            .zip(rows)
            .map(move |(&first, weights)| weighted_sum(weights, &values[first as usize..]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of packed rows are those of the rows, also where rows end with the values.
    #[test]
    fn ver_packed_rows_have_the_same_products() {
        let mut rows = RowsOfAnyLength::default();
        let of_rows: [(usize, &[f64]); 5] =
            [(0, &[1.0, 2.0]), (3, &[0.0, -1.0, 0.5, 0.25]), (6, &[4.0]), (2, &[0.0, 0.0]), (5, &[3.0, 1.0, 0.0])];
        of_rows.iter().for_each(|(first, weights)| rows.push(*first, weights));
        let values: Vec<f64> = (0..8).map(|i| 1.0 + f64::from(i * i)).collect();
        let packed = rows.packed(values.len());
        assert_eq!((packed.count(), packed.width()), (5, 3));
        for from in 0..5 {
            let products: Vec<f64> = packed.times_from(from, &values).collect();
            let expected = of_rows[from..].iter().map(|(first, weights)| -> f64 {
                weights.iter().zip(&values[*first..]).map(|(weight, value)| weight * value).sum()
            });
            assert_eq!(products, expected.collect::<Vec<f64>>());
        }
    }
}
