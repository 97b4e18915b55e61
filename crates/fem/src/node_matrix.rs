//! Sparse symmetric matrix over the degrees of freedom of nodes, which are coupled where they share an element.
//!
//! The **lower triangle** is stored, diagonal included, by columns (CSC, rows rising, 32-bit indices). The pattern is that of the
//! graph of the nodes: each coupling of two nodes is a block of d × d, d being the degrees of freedom of a node, 2 or 3. The columns
//! of a node have the same nodes below them, and the place of a block follows from the place of one node in
//! the list of the other; no triplets are sorted.

use sprs::CsMatI;

use super::incidence::Incidence;

/// Sparse symmetric matrix; degrees of freedom are numbered `d · node + component`.
#[derive(Debug, Clone)]
pub struct NodeMatrix {
    lower: CsMatI<f64, u32>,
    /// Beginning of each node's list in `above`.
    start: Vec<usize>,
    /// Coupled nodes with a higher number for each node, in rising order.
    above: Vec<u32>,
    per_node: usize,
}

impl NodeMatrix {
    /// Zero matrix of `nodes` with `per_node` degrees of freedom, where the nodes of each of `groups` are coupled.
    pub(super) fn new<'a, I: Iterator<Item = &'a [u32]>>(
        per_node: usize,
        nodes: usize,
        groups: impl Fn() -> I,
    ) -> Self {
        let incidence = Incidence::new(nodes, &groups);
        let groups: Vec<&[u32]> = groups().collect();
        let mut seen = vec![u32::MAX; nodes];
        let mut start = Vec::with_capacity(nodes + 1);
        start.push(0);
        let mut above: Vec<u32> = Vec::new();
        for j in 0..nodes {
            let first = above.len();
            for group in incidence.of(j) {
                for i in groups[*group as usize] {
                    if *i as usize > j && seen[*i as usize] != j as u32 {
                        seen[*i as usize] = j as u32;
                        above.push(*i);
                    }
                }
            }
            above[first..].sort_unstable();
            start.push(above.len());
        }
        Self { lower: zeros(per_node, &start, &above), start, above, per_node }
    }

    /// Lower triangle, CSC.
    pub fn lower(&self) -> &CsMatI<f64, u32> {
        &self.lower
    }

    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        self.lower.cols()
    }

    /// Degrees of freedom of a node.
    pub(crate) fn per_node(&self) -> usize {
        self.per_node
    }

    /// Product with `x`.
    ///
    /// # Panics
    /// Where there is not one entry for each degree of freedom.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        assert_eq!(x.len(), self.dofs(), "one entry for each degree of freedom");
        let mut product = vec![0.0; self.dofs()];
        let (columns, rows, values) = (self.lower.indptr(), self.lower.indices(), self.lower.data());
        for (j, ends) in columns.raw_storage().windows(2).enumerate() {
            let (start, end) = (ends[0] as usize, ends[1] as usize);
            let x_j = x[j];
            let mut own = 0.0;
            for (row, value) in rows[start..end].iter().zip(&values[start..end]) {
                let i = *row as usize;
                if i == j {
                    own += value * x_j;
                } else {
                    own += value * x[i];
                    product[i] += value * x_j;
                }
            }
            product[j] += own;
        }
        product
    }

    /// Columns (or rows) of `dofs` with entries (degree of freedom, value).
    pub fn columns(&self, dofs: &[u32]) -> Vec<Vec<(u32, f64)>> {
        let mut place = vec![u32::MAX; self.dofs()];
        (0..).zip(dofs).for_each(|(k, dof)| place[*dof as usize] = k);
        let mut found: Vec<Vec<(u32, f64)>> = vec![Vec::new(); dofs.len()];
        for (j, column) in self.lower.outer_iterator().enumerate() {
            for (i, value) in column.iter() {
                // Of both triangles, the diagonal once.
                for (own, other) in [(j, i), (i, j)].into_iter().take(if i == j { 1 } else { 2 }) {
                    if let Some(column) = found.get_mut(place[own] as usize) {
                        column.push((other as u32, *value));
                    }
                }
            }
        }
        found
    }

    /// Adds the block of rows of node i and columns of node j ≤ i, which are coupled.
    pub(super) fn add<const D: usize>(&mut self, i: u32, j: u32, block: [[f64; D]; D]) {
        debug_assert_eq!(D, self.per_node);
        let j = j as usize;
        let columns = self.lower.indptr();
        let first = columns.raw_storage()[D * j] as usize;
        let below = D * (self.start[j + 1] - self.start[j]);
        let place = if i as usize == j { 0 } else { D * self.place(j, i) };
        for c in 0..D {
            // Column c begins with the rows c to D of its own node.
            let column = first + c * (D + below) - c * c.saturating_sub(1) / 2;
            let column = &mut self.lower.data_mut()[column..column + D - c + below];
            if i as usize == j {
                column.iter_mut().zip(&block[c..]).for_each(|(entry, row)| *entry += row[c]);
            } else {
                column[D - c + place..].iter_mut().zip(&block).for_each(|(entry, row)| *entry += row[c]);
            }
        }
    }

    /// Place of the coupled node i > j in the list of node j.
    fn place(&self, j: usize, i: u32) -> usize {
        let above = &self.above[self.start[j]..self.start[j + 1]];
        let place = above.partition_point(|&other| other < i);
        debug_assert_eq!(above.get(place), Some(&i), "the pattern is of these elements");
        place
    }
}

/// Lower triangle with zeros in its pattern.
fn zeros(per_node: usize, start: &[usize], above: &[u32]) -> CsMatI<f64, u32> {
    let (d, nodes) = (per_node as u32, start.len() - 1);
    let entries = per_node * (per_node + 1) / 2 * nodes + per_node * per_node * above.len();
    let mut columns: Vec<u32> = Vec::with_capacity(per_node * nodes + 1);
    let mut rows: Vec<u32> = Vec::with_capacity(entries);
    columns.push(0);
    for j in 0..nodes {
        let above = &above[start[j]..start[j + 1]];
        for c in 0..d {
            rows.extend((c..d).map(|r| d * j as u32 + r));
            rows.extend(above.iter().flat_map(|i| (0..d).map(move |r| d * i + r)));
            columns.push(rows.len() as u32);
        }
    }
    CsMatI::new_csc((per_node * nodes, per_node * nodes), columns, rows, vec![0.0; entries])
}
