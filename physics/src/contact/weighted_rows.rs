//! Rows of a matrix with few weights each, on consecutive values.

/// The rows, one after the other.
#[derive(Debug, Clone, Default)]
pub(super) struct WeightedRows {
    /// Place of the first value of each row.
    first: Vec<u32>,
    /// End of each row in `weights`.
    ends: Vec<u32>,
    weights: Vec<f64>,
}

impl WeightedRows {
    /// Appends a row on the values from `first` on.
    pub(super) fn push(&mut self, first: usize, weights: impl IntoIterator<Item = f64>) {
        self.first.push(first as u32);
        self.weights.extend(weights);
        self.ends.push(self.weights.len() as u32);
    }

    /// Returns what it holds of memory beyond its rows.
    pub(super) fn shrink(&mut self) {
        self.first.shrink_to_fit();
        self.ends.shrink_to_fit();
        self.weights.shrink_to_fit();
    }

    /// Number of rows.
    pub(super) fn count(&self) -> usize {
        self.first.len()
    }

    /// Place of the first value of a row, and its weights.
    pub(super) fn row(&self, k: usize) -> (usize, &[f64]) {
        let begin = if k == 0 { 0 } else { self.ends[k - 1] as usize };
        (self.first[k] as usize, &self.weights[begin..self.ends[k] as usize])
    }

    /// Products of the rows from `from` on with `values`.
    pub(super) fn times_from<'a>(&'a self, from: usize, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let mut begin = if from == 0 { 0 } else { self.ends[from - 1] };
        self.first[from..].iter().zip(&self.ends[from..]).map(move |(&first, &end)| {
            let weights = &self.weights[begin as usize..end as usize];
            begin = end;
            let values = &values[first as usize..][..weights.len()];
            weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
        })
    }
}
