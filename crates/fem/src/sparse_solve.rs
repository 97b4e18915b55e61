//! Compliance of a surface, from many right-hand sides with few entries each.
//!
//! In L y = P b a force on few degrees of freedom reaches only their supernodes and the ancestors of these in the
//! elimination tree, a small part of L for forces along a surface. The compliance of the
//! forces B is symmetric and needs the forward substitution only,
//!
//! ```text
//! C = Bᵀ K⁻¹ B = Yᵀ Y        L Y = P B
//! ```
//!
//! Y is stored by supernodes, each with the columns that reach it; successive supernodes with the same columns
//! share one dense block. The product is the sum of few large symmetric products.
//!
//! Source: J. R. Gilbert and T. Peierls, *SIAM Journal on Scientific and Statistical Computing* 9 (1988) 862–874 (reach);
//! P. R. Amestoy, I. S. Duff, Y. Robert, F.-H. Rouet and B. Uçar, same journal 34 (2012) A1975–A1999 (entries of an inverse).

use faer::linalg::matmul::{matmul, triangular};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::{Accum, Mat, MatMut, Par};

use super::factor::{Factor, HELD};

/// Elimination tree of supernodes: the parent holds the first row below the diagonal block.
struct Tree {
    of_place: Vec<u32>,
    parent: Vec<Option<u32>>,
}

impl Tree {
    fn new(supernodes: &SymbolicSupernodalCholesky<u32>) -> Self {
        let mut of_place = Vec::with_capacity(supernodes.nrows());
        for (s, end) in (0..).zip(supernodes.supernode_end()) {
            of_place.resize(*end as usize, s);
        }
        let parent = (0..supernodes.n_supernodes())
            .map(|s| supernodes.supernode(s).pattern().first().map(|place| of_place[*place as usize]))
            .collect();
        Self { of_place, parent }
    }
}

impl Factor {
    /// Compliance C = Bᵀ K⁻¹ B of the forces B given by `columns`, each a list of (degree of freedom, force) whose repeated ones are added;
    /// forces on held degrees of freedom are ignored. Symmetric to the last bit.
    ///
    /// # Panics
    /// Where a degree of freedom is not of this mesh.
    pub fn compliance(&self, columns: &[Vec<(u32, f64)>]) -> Mat<f64> {
        let order = self.by_first_place(columns);
        let product = Fronts::new(self, columns, &order).product(columns.len());
        let mut out = Mat::zeros(columns.len(), columns.len());
        for (j, q) in order.iter().enumerate() {
            for (i, p) in order.iter().enumerate().skip(j) {
                out[(*p as usize, *q as usize)] = product[(i, j)];
                out[(*q as usize, *p as usize)] = product[(i, j)];
            }
        }
        out
    }

    /// Place of a degree of freedom in the order of elimination.
    fn place(&self, dof: u32) -> Option<u32> {
        let place = self.place_of_dof()[dof as usize];
        (place != HELD).then_some(place)
    }

    /// Columns in the order of their first place, so that neighbours reach the same supernodes.
    fn by_first_place(&self, columns: &[Vec<(u32, f64)>]) -> Vec<u32> {
        let first = columns.iter().map(|column| column.iter().filter_map(|(dof, _)| self.place(*dof)).min());
        let mut order: Vec<(Option<u32>, u32)> = first.zip(0..).collect();
        order.sort_unstable();
        order.into_iter().map(|(_, column)| column).collect()
    }
}

/// Y = L⁻¹ P B by supernodes.
struct Fronts {
    tree: Tree,
    /// Columns that reach each supernode, as places in the given order.
    active: Vec<Vec<u32>>,
    /// Group of each supernode, and its first row there.
    home: Vec<(usize, usize)>,
    /// Columns that reach a group of supernodes, in rising order, and the rows of Y there.
    groups: Vec<(Vec<u32>, Mat<f64>)>,
}

impl Fronts {
    fn new(factor: &Factor, columns: &[Vec<(u32, f64)>], order: &[u32]) -> Self {
        let mut fronts = Self::reached(factor, columns, order);
        for (sequence, column) in (0u32..).zip(order) {
            for (dof, force) in &columns[*column as usize] {
                if let Some(place) = factor.place(*dof) {
                    let s = fronts.tree.of_place[place as usize] as usize;
                    let (group, row) = fronts.home[s];
                    let (active, y) = &mut fronts.groups[group];
                    let k = active.partition_point(|other| *other < sequence);
                    y[(row + place as usize - factor.llt().supernode(s).start(), k)] += force;
                }
            }
        }
        for s in 0..fronts.active.len() {
            if !fronts.active[s].is_empty() {
                fronts.substitute(factor, s);
            }
        }
        fronts
    }

    /// Zero fronts on the supernodes that the columns reach.
    fn reached(factor: &Factor, columns: &[Vec<(u32, f64)>], order: &[u32]) -> Self {
        let (llt, tree) = (factor.llt(), Tree::new(factor.supernodes()));
        let supernodes = factor.supernodes().n_supernodes();
        let mut active: Vec<Vec<u32>> = vec![Vec::new(); supernodes];
        for (sequence, column) in (0..).zip(order) {
            for (dof, _) in &columns[*column as usize] {
                let mut at = factor.place(*dof).map(|place| tree.of_place[place as usize]);
                while let Some(s) = at.filter(|s| active[*s as usize].last() != Some(&sequence)) {
                    active[s as usize].push(sequence);
                    at = tree.parent[s as usize];
                }
            }
        }
        // The columns of a supernode are among those of its parent: the same where their number is.
        let mut home = vec![(0, 0); supernodes];
        let mut sizes: Vec<(Vec<u32>, usize)> = Vec::new();
        for s in (0..supernodes).rev().filter(|s| !active[*s].is_empty()) {
            let same = tree.parent[s].map(|p| p as usize).filter(|p| active[*p].len() == active[s].len());
            let group = same.map_or(sizes.len(), |p| home[p].0);
            if same.is_none() {
                sizes.push((active[s].clone(), 0));
            }
            home[s] = (group, sizes[group].1);
            sizes[group].1 += llt.supernode(s).val().ncols();
        }
        let groups = sizes
            .into_iter()
            .map(|(columns, rows)| {
                let y = Mat::zeros(rows, columns.len());
                (columns, y)
            })
            .collect();
        Self { tree, active, home, groups }
    }

    /// Forward substitution of supernode `s`.
    fn substitute(&mut self, factor: &Factor, s: usize) {
        let (llt, active, of_place) = (factor.llt(), &self.active[s], &self.tree.of_place);
        let node = llt.supernode(s);
        let width = node.val().ncols();
        let (diagonal, below) = node.val().split_at_row(width);
        let (group, row) = self.home[s];
        let mut own = self.groups[group].1.as_mut().subrows_mut(row, width);
        solve_lower_triangular_in_place(diagonal, own.as_mut(), Par::Seq);
        let mut push = Mat::<f64>::zeros(below.nrows(), active.len());
        matmul(push.as_mut(), Accum::Replace, below, own.as_ref(), 1.0, Par::Seq);
        let mut done = 0;
        for same in node.pattern().chunk_by(|p, q| of_place[*p as usize] == of_place[*q as usize]) {
            let above = of_place[same[0] as usize] as usize;
            let (group, row) = self.home[above];
            let (columns, y) = &mut self.groups[group];
            let first = row as isize - llt.supernode(above).start() as isize;
            let mut target = 0;
            for (k, sequence) in active.iter().enumerate() {
                target += columns[target..].partition_point(|other| other < sequence);
                for (i, place) in (done..).zip(same) {
                    y[((first + *place as isize) as usize, target)] -= push[(i, k)];
                }
            }
            done += same.len();
        }
    }

    /// Lower half of Yᵀ Y.
    fn product(&self, columns: usize) -> Mat<f64> {
        let mut product = Mat::<f64>::zeros(columns, columns);
        for (active, y) in &self.groups {
            let (first, count) = (active[0] as usize, active.len());
            if active[count - 1] as usize - first + 1 == count {
                add_square(product.as_mut().submatrix_mut(first, first, count, count), y);
            } else {
                let mut part = Mat::zeros(count, count);
                add_square(part.as_mut(), y);
                for k in 0..count {
                    for i in k..count {
                        product[(active[i] as usize, active[k] as usize)] += part[(i, k)];
                    }
                }
            }
        }
        product
    }
}

/// Adds the lower half of Yᵀ Y to `target`.
fn add_square(target: MatMut<'_, f64>, y: &Mat<f64>) {
    let (lower, whole) = (triangular::BlockStructure::TriangularLower, triangular::BlockStructure::Rectangular);
    triangular::matmul(target, lower, Accum::Add, y.transpose(), whole, y, whole, 1.0, Par::Seq);
}
