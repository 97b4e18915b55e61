//! The compliance of a surface: many right-hand sides with few entries each.
//!
//! A force on few degrees of freedom reaches, in L y = P b, only the supernodes of those and their ancestors in the
//! elimination tree. That is little where the forces lie along a surface, and everything else is left out. The compliance of the
//! forces B among themselves is symmetric and needs the forward half only,
//!
//! ```text
//! C = Bᵀ K⁻¹ B = Yᵀ Y        L Y = P B
//! ```
//!
//! Y is kept by supernodes, each with those columns only that reach it; supernodes one above the other with the same columns
//! share one dense block. The product is then made of few large symmetric products.
//!
//! Source: J. R. Gilbert and T. Peierls, *SIAM Journal on Scientific and Statistical Computing* 9 (1988) 862–874 (reach);
//! P. R. Amestoy, I. S. Duff, Y. Robert, F.-H. Rouet and B. Uçar, same journal 34 (2012) A1975–A1999 (entries of an inverse).

use faer::linalg::matmul::{matmul, triangular};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::{Accum, Mat, Par};

use super::factor::{Factor, HELD};

/// Supernodes as a tree: each hangs on the one that holds the first row below it.
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
        let above = |s: usize| supernodes.supernode(s).pattern().first().map(|place| of_place[*place as usize]);
        let parent = (0..supernodes.n_supernodes()).map(above).collect();
        Self { of_place, parent }
    }
}

impl Factor {
    /// C = Bᵀ K⁻¹ B for the forces B given by `columns`, each a list of (degree of freedom, force) with repeated ones added up; forces
    /// on held degrees of freedom are ignored. What each does along every other.
    /// Symmetric to the last bit.
    ///
    /// # Panics
    /// Where a degree of freedom is not of this mesh.
    pub fn compliance(&self, columns: &[Vec<(u32, f64)>]) -> Mat<f64> {
        let order = self.by_first_place(columns);
        let fronts = Fronts::new(self, columns, &order);
        let product = fronts.product(columns.len());
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

    /// The columns in the order of their first place: neighbours then reach the same supernodes.
    fn by_first_place(&self, columns: &[Vec<(u32, f64)>]) -> Vec<u32> {
        let first = |column: &Vec<(u32, f64)>| column.iter().filter_map(|(dof, _)| self.place(*dof)).min();
        let mut order: Vec<(Option<u32>, u32)> = columns.iter().map(first).zip(0..).collect();
        order.sort_unstable();
        order.into_iter().map(|(_, column)| column).collect()
    }
}

/// Y = L⁻¹ P B by supernodes.
struct Fronts {
    /// Columns that reach a group of supernodes, in rising order, and the rows of Y there.
    groups: Vec<(Vec<u32>, Mat<f64>)>,
}

impl Fronts {
    fn new(factor: &Factor, columns: &[Vec<(u32, f64)>], order: &[u32]) -> Self {
        let (llt, tree) = (factor.llt(), Tree::new(factor.supernodes()));
        let supernodes = factor.supernodes().n_supernodes();
        // Columns that reach each supernode, as places in `order`.
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
        // The columns of a supernode are among those of its parent: equal in number means the same.
        let mut home = vec![(0, 0); supernodes];
        let mut rows_of_group: Vec<usize> = Vec::new();
        let mut columns_of_group: Vec<Vec<u32>> = Vec::new();
        for s in (0..supernodes).rev().filter(|s| !active[*s].is_empty()) {
            let same = tree.parent[s].map(|p| p as usize).filter(|p| active[*p].len() == active[s].len());
            let group = same.map_or(rows_of_group.len(), |p| home[p].0);
            if same.is_none() {
                rows_of_group.push(0);
                columns_of_group.push(active[s].clone());
            }
            home[s] = (group, rows_of_group[group]);
            rows_of_group[group] += llt.supernode(s).val().ncols();
        }
        let sized = |(columns, rows): (Vec<u32>, usize)| (Mat::zeros(rows, columns.len()), columns);
        let mut groups: Vec<(Vec<u32>, Mat<f64>)> =
            columns_of_group.into_iter().zip(rows_of_group).map(sized).map(|(y, columns)| (columns, y)).collect();
        for (sequence, column) in (0u32..).zip(order) {
            for (dof, force) in &columns[*column as usize] {
                if let Some(place) = factor.place(*dof) {
                    let s = tree.of_place[place as usize] as usize;
                    let (group, row) = home[s];
                    let (active, y) = &mut groups[group];
                    let k = active.partition_point(|other| *other < sequence);
                    y[(row + place as usize - llt.supernode(s).start(), k)] += force;
                }
            }
        }
        for s in (0..supernodes).filter(|s| !active[*s].is_empty()) {
            let node = llt.supernode(s);
            let width = node.val().ncols();
            let (diagonal, below) = node.val().split_at_row(width);
            let (group, row) = home[s];
            let mut own = groups[group].1.as_mut().subrows_mut(row, width);
            solve_lower_triangular_in_place(diagonal, own.as_mut(), Par::Seq);
            let mut push = Mat::<f64>::zeros(below.nrows(), active[s].len());
            matmul(push.as_mut(), Accum::Replace, below, own.as_ref(), 1.0, Par::Seq);
            let mut done = 0;
            for same in node.pattern().chunk_by(|p, q| tree.of_place[*p as usize] == tree.of_place[*q as usize]) {
                let above = tree.of_place[same[0] as usize] as usize;
                let (group, row) = home[above];
                let (columns, y) = &mut groups[group];
                let first = row as isize - llt.supernode(above).start() as isize;
                let mut target = 0;
                for (k, sequence) in active[s].iter().enumerate() {
                    target += columns[target..].partition_point(|other| other < sequence);
                    for (i, place) in (done..).zip(same) {
                        y[((first + *place as isize) as usize, target)] -= push[(i, k)];
                    }
                }
                done += same.len();
            }
        }
        Self { groups }
    }

    /// The lower half of Yᵀ Y.
    fn product(&self, columns: usize) -> Mat<f64> {
        let mut product = Mat::<f64>::zeros(columns, columns);
        let square = |target: faer::MatMut<'_, f64>, y: &Mat<f64>| {
            let (lower, whole) = (triangular::BlockStructure::TriangularLower, triangular::BlockStructure::Rectangular);
            triangular::matmul(target, lower, Accum::Add, y.transpose(), whole, y, whole, 1.0, Par::Seq);
        };
        for (active, y) in &self.groups {
            let (first, count) = (active[0] as usize, active.len());
            if active[count - 1] as usize - first + 1 == count {
                square(product.as_mut().submatrix_mut(first, first, count, count), y);
            } else {
                let mut part = Mat::zeros(count, count);
                square(part.as_mut(), y);
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
