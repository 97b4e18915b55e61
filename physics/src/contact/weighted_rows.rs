//! Rows of a matrix with few weights each, on consecutive values.
//!
//! Packed weights are of double or of single precision. Those in mean pressures are single: they are most of what a sliced pair holds in memory, reading them
//! takes most of the time of a product, and rounding changes a pressure by 6e-8 of it. Those of removed material are double: 6e-8 of deep wear can be more
//! than the depth to which a light load presses flanks together.

/// Lengths of rows for which there is a product of its own.
const UNROLLED: [usize; 7] = [2, 4, 6, 8, 10, 12, 16];

/// A packed weight.
pub(super) trait Weight: Copy + Default + Into<f64> {
    /// Nearest to this one.
    fn of(weight: f64) -> Self;
}

impl Weight for f64 {
    fn of(weight: f64) -> Self {
        weight
    }
}

impl Weight for f32 {
    fn of(weight: f64) -> Self {
        weight as Self
    }
}

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
    /// No rows yet, with room for so many of the usual length.
    pub(super) fn of_about(rows: usize) -> Self {
        let usual = UNROLLED[UNROLLED.len() / 2];
        Self {
            first: Vec::with_capacity(rows),
            ends: Vec::with_capacity(rows),
            weights: Vec::with_capacity(usual * rows),
        }
    }

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
    pub(super) fn packed<W: Weight>(&self, values: usize) -> WeightedRows<W> {
        let count = self.first.len();
        let widest = (0..count).map(|k| self.row(k).1.len()).max().unwrap_or_default();
        let width = UNROLLED.into_iter().find(|width| (widest..=values).contains(width)).unwrap_or(widest);
        let (mut first, mut packed) = (Vec::with_capacity(count), vec![W::default(); count * width]);
        for (k, to) in (0..count).zip(packed.chunks_exact_mut(width.max(1))) {
            let (from, weights) = self.row(k);
            let begin = from.min(values - width);
            to[from - begin..].iter_mut().zip(weights).for_each(|(to, weight)| *to = W::of(*weight));
            first.push(begin as u32);
        }
        WeightedRows { width, first, weights: packed }
    }
}

/// Rows of one length, zeros included, whose products take no branches that depend on the row.
#[derive(Debug, Clone)]
pub(super) struct WeightedRows<W> {
    /// Weights of a row.
    width: usize,
    /// Place of the first value of each row.
    first: Vec<u32>,
    weights: Vec<W>,
}

impl<W: Weight> WeightedRows<W> {
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
    pub(super) fn row(&self, k: usize) -> (usize, &[W]) {
        (self.first[k] as usize, &self.weights[k * self.width..(k + 1) * self.width])
    }

    /// Adds the products of the rows from `from` on with `values` to as many `sums`.
    pub(super) fn add_products(&self, from: usize, values: &[f64], sums: &mut [f64]) {
        match self.width {
            2 => self.add_unrolled::<2>(from, values, sums),
            4 => self.add_unrolled::<4>(from, values, sums),
            6 => self.add_unrolled::<6>(from, values, sums),
            8 => self.add_unrolled::<8>(from, values, sums),
            10 => self.add_unrolled::<10>(from, values, sums),
            12 => self.add_unrolled::<12>(from, values, sums),
            16 => self.add_unrolled::<16>(from, values, sums),
            _ => {
                for (k, sum) in (from..).zip(sums) {
                    let (first, weights) = self.row(k);
                    let products = weights.iter().zip(&values[first..]).map(|(weight, value)| (*weight).into() * value);
                    *sum += products.sum::<f64>();
                }
            }
        }
    }

    fn add_unrolled<const WIDTH: usize>(&self, from: usize, values: &[f64], sums: &mut [f64]) {
        let rows = self.weights.as_chunks::<WIDTH>().0;
        for ((first, weights), sum) in self.first[from..].iter().zip(&rows[from..]).zip(sums) {
            let values = values[*first as usize..].first_chunk::<WIDTH>().expect("rows end with the values");
            let (mut even, mut odd) = (0.0, 0.0);
            for pair in 0..WIDTH / 2 {
                even += weights[2 * pair].into() * values[2 * pair];
                odd += weights[2 * pair + 1].into() * values[2 * pair + 1];
            }
            *sum += even + odd;
        }
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
        products_are_those_of(&rows.packed::<f64>(values.len()), &of_rows, &values);
        products_are_those_of(&rows.packed::<f32>(values.len()), &of_rows, &values);
    }

    fn products_are_those_of<W: Weight>(packed: &WeightedRows<W>, of_rows: &[(usize, &[f64]); 5], values: &[f64]) {
        assert_eq!((packed.count(), packed.width()), (5, 4));
        for from in 0..5 {
            let mut products = vec![0.0; 5 - from];
            packed.add_products(from, values, &mut products);
            let expected = of_rows[from..].iter().map(|(first, weights)| -> f64 {
                weights.iter().zip(&values[*first..]).map(|(weight, value)| weight * value).sum()
            });
            // Of these weights nothing is rounded.
            assert_eq!(products, expected.collect::<Vec<f64>>());
        }
    }
}
