//! A symmetric matrix over the degrees of freedom of nodes that couple where they share an element.
//!
//! Its **lower triangle** is kept, diagonal included, column by column (CSC, rows rising, 32-bit indices). The pattern comes from the
//! graph of the nodes: each coupling of two nodes is a block of d × d, d being the degrees of freedom of a node, 2 in the plane and 3 in
//! space. The columns of a node therefore have the same nodes below them, and the place of a block follows from the place of one node in
//! the list of the other; no triplets are sorted.

use sprs::CsMatI;

/// The matrix; degrees of freedom are numbered `d · node + component`.
#[derive(Debug, Clone)]
pub struct NodeMatrix {
    lower: CsMatI<f64, u32>,
    /// For each node where its list begins in `above`.
    start: Vec<usize>,
    /// For each node the nodes with a higher number that it couples with, in rising order.
    above: Vec<u32>,
    per_node: usize,
}

impl NodeMatrix {
    /// Zeros for so many `nodes` of `per_node` degrees of freedom, where the nodes of each of `groups` couple with each other.
    pub(super) fn new<'a, I: Iterator<Item = &'a [u32]>>(
        per_node: usize,
        nodes: usize,
        groups: impl Fn() -> I,
    ) -> Self {
        // For each node the groups it is in.
        let mut group_start = vec![0usize; nodes + 1];
        for node in groups().flatten() {
            group_start[*node as usize + 1] += 1;
        }
        for node in 0..nodes {
            group_start[node + 1] += group_start[node];
        }
        let mut members: Vec<&[u32]> = vec![&[]; group_start[nodes]];
        let mut next = group_start.clone();
        for group in groups() {
            for node in group {
                members[next[*node as usize]] = group;
                next[*node as usize] += 1;
            }
        }
        let mut seen = vec![u32::MAX; nodes];
        let mut start = Vec::with_capacity(nodes + 1);
        start.push(0);
        let mut above: Vec<u32> = Vec::new();
        for j in 0..nodes {
            let first = above.len();
            for group in &members[group_start[j]..group_start[j + 1]] {
                for i in *group {
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

    /// The lower triangle, CSC.
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

    /// The matrix times `x`.
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

    /// The columns of `dofs`, which are also the rows: their entries as (degree of freedom, value).
    pub fn columns(&self, dofs: &[u32]) -> Vec<Vec<(u32, f64)>> {
        let mut place = vec![u32::MAX; self.dofs()];
        (0..).zip(dofs).for_each(|(k, dof)| place[*dof as usize] = k);
        let mut found = vec![Vec::new(); dofs.len()];
        let mut note = |dof: u32, other: u32, value: f64| {
            if let Some(column) = found.get_mut(place[dof as usize] as usize) {
                column.push((other, value));
            }
        };
        for (j, column) in (0..).zip(self.lower.outer_iterator()) {
            for (i, value) in column.iter() {
                note(j, i as u32, *value);
                if i as u32 != j {
                    note(i as u32, j, *value);
                }
            }
        }
        found
    }

    /// Adds the block of rows of node i and columns of node j ≤ i, which couple.
    pub(super) fn add<const D: usize>(&mut self, i: u32, j: u32, block: [[f64; D]; D]) {
        debug_assert_eq!(D, self.per_node);
        let j = j as usize;
        let columns = self.lower.indptr();
        let first = columns.raw_storage()[D * j] as usize;
        let below = D * (self.start[j + 1] - self.start[j]);
        // Column c begins with the rows c to D of its own node.
        let column = |c: usize| first + c * (D + below) - c * c.saturating_sub(1) / 2;
        let data = |c: usize, row: usize| column(c) + row;
        if i as usize == j {
            for (r, row) in block.iter().enumerate() {
                for (c, value) in row.iter().enumerate().take(r + 1) {
                    self.lower.data_mut()[data(c, r - c)] += value;
                }
            }
        } else {
            let place = D * self.place(j, i);
            for c in 0..D {
                for (r, row) in block.iter().enumerate() {
                    self.lower.data_mut()[data(c, D - c + place + r)] += row[c];
                }
            }
        }
    }

    /// Place of node i > j, which couples with it, in the list of node j.
    fn place(&self, j: usize, i: u32) -> usize {
        let above = &self.above[self.start[j]..self.start[j + 1]];
        let place = above.partition_point(|&other| other < i);
        debug_assert_eq!(above.get(place), Some(&i), "the pattern is of these elements");
        place
    }
}

/// The pattern of the lower triangle with zeros in it.
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
