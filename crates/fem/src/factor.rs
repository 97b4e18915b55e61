//! Sparse Cholesky factorisation of a supported stiffness.
//!
//! Without the held degrees of freedom h, the free ones f satisfy
//!
//! ```text
//! K_ff u_f = F_f − K_fh u_h          K_ff = Pᵀ L Lᵀ P
//! ```
//!
//! P is the approximate-minimum-degree ordering, L is stored by faer as dense blocks of columns (supernodes). Everything
//! runs on one thread, so that solutions are the same bit for bit on every machine.
//!
//! Nodes without elements are left out too; their displacement is zero.
//!
//! Source: Y. Chen, T. A. Davis, W. W. Hager and S. Rajamanickam, *ACM Transactions on Mathematical Software* 35 (2008)
//! article 22 (supernodal Cholesky); the implementation is faer's.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::solvers::LltError;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLltRef, SymbolicSupernodalCholesky};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::node_matrix::NodeMatrix;
use super::stiffness::Stiffness;
use super::support::Loose;

/// Number of right-hand sides solved together: enough to reuse each block of L in the cache, few enough
/// for their own rows to stay there too.
pub const COLUMNS_AT_ONCE: usize = 32;

/// Mark of a held degree of freedom.
pub(super) const HELD: u32 = u32::MAX;

/// Reason why a stiffness cannot be factorised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FactorError {
    /// A body can move without strain.
    #[error(
        "the body with node {node} can move as a rigid body: {held} fixed degrees of freedom do not prevent translation or rotation"
    )]
    Unsupported {
        /// Lowest node of the body.
        node: u32,
        /// Number of held degrees of freedom of the body.
        held: usize,
    },
    /// A pivot is not positive: the stiffness has values that are not finite, or is badly scaled.
    #[error("the stiffness is not positive definite at degree of freedom {dof} (node {node})")]
    NotPositive {
        /// Degree of freedom of the pivot.
        dof: usize,
        /// Node of the degree of freedom.
        node: usize,
    },
    /// The factorisation does not fit into memory.
    #[error("the factorisation needs more memory than there is; a coarser mesh needs less")]
    OutOfMemory,
}

/// Factorised stiffness with its supports.
pub struct Factor {
    /// Place of each degree of freedom in the order of elimination, or [`HELD`].
    place_of_dof: Vec<u32>,
    /// Degree of freedom at each place.
    dof_of_place: Vec<u32>,
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

/// Lower triangle of K_ff by columns.
struct Reduced {
    columns: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

/// Order of elimination of the free degrees of freedom by that of their nodes.
struct NodeOrder {
    free_of_place: Vec<u32>,
    place_of_free: Vec<u32>,
}

impl NodeOrder {
    fn new(nodes: &[u32], per_node: usize, free_of_dof: &[u32]) -> Self {
        let dofs = nodes.iter().flat_map(|node| (0..per_node).map(|k| per_node * *node as usize + k));
        let free_of_place: Vec<u32> = dofs.map(|dof| free_of_dof[dof]).filter(|free| *free != HELD).collect();
        let mut place_of_free = vec![0; free_of_place.len()];
        (0..).zip(&free_of_place).for_each(|(place, free)| place_of_free[*free as usize] = place);
        Self { free_of_place, place_of_free }
    }

    fn dofs(&self) -> PermRef<'_, u32> {
        PermRef::new_checked(&self.free_of_place, &self.place_of_free, self.free_of_place.len())
    }
}

/// Symbolic factorisation of a stiffness, whose memory is known before the numeric one.
pub struct SymbolicFactor {
    reduced: Reduced,
    dofs: usize,
    per_node: usize,
    dof_of_free: Vec<u32>,
    symbolic: SymbolicCholesky<u32>,
}

impl SymbolicFactor {
    /// Symbolic factorisation of `matrix` without the degrees of freedom that `is_held`, which must prevent all rigid motions.
    pub fn new(matrix: &NodeMatrix, is_held: impl Fn(usize) -> bool) -> Result<Self, FactorError> {
        Self::of_nodes(matrix, is_held, None)
    }

    /// The same in an order of `nodes`, all with free degrees of freedom.
    pub fn in_order(matrix: &NodeMatrix, is_held: impl Fn(usize) -> bool, nodes: &[u32]) -> Result<Self, FactorError> {
        Self::of_nodes(matrix, is_held, Some(nodes))
    }

    fn of_nodes(
        matrix: &NodeMatrix,
        is_held: impl Fn(usize) -> bool,
        nodes: Option<&[u32]>,
    ) -> Result<Self, FactorError> {
        let dofs = matrix.dofs();
        let mut free_of_dof = vec![HELD; dofs];
        let mut dof_of_free = Vec::with_capacity(dofs);
        for (dof, free) in free_of_dof.iter_mut().enumerate() {
            if !is_held(dof) {
                *free = dof_of_free.len() as u32;
                dof_of_free.push(dof as u32);
            }
        }
        let order = nodes.map(|nodes| NodeOrder::new(nodes, matrix.per_node(), &free_of_dof));
        let ordering = order.as_ref().map_or(SymmetricOrdering::Amd, |order| SymmetricOrdering::Custom(order.dofs()));
        let reduced = Reduced::new(matrix, &free_of_dof, &dof_of_free);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let pattern = reduced.matrix();
        let symbolic = factorize_symbolic_cholesky(pattern.symbolic(), Side::Lower, ordering, params)
            .map_err(|_| FactorError::OutOfMemory)?;
        Ok(Self { reduced, dofs, per_node: matrix.per_node(), dof_of_free, symbolic })
    }

    /// Memory of the factor, GB.
    pub(crate) fn factor_gb(&self) -> f64 {
        const BYTES: f64 = size_of::<f64>() as f64;
        1e-9 * BYTES * self.symbolic.len_val() as f64
    }

    /// Numeric factorisation.
    pub fn factorised(self) -> Result<Factor, FactorError> {
        let Self { reduced, dofs, per_node, dof_of_free, symbolic } = self;
        let matrix = reduced.matrix();
        let needed = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut scratch = MemBuffer::try_new(needed).map_err(|_| FactorError::OutOfMemory)?;
        let mut place_of_dof = vec![HELD; dofs];
        let dof_of_place: Vec<u32> = match symbolic.perm() {
            Some(order) => order.arrays().0.iter().map(|free| dof_of_free[*free as usize]).collect(),
            None => dof_of_free,
        };
        for (place, dof) in (0..).zip(&dof_of_place) {
            place_of_dof[*dof as usize] = place;
        }
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| FactorError::OutOfMemory)?;
        values.resize(symbolic.len_val(), 0.0);
        let (regularization, params) = (Default::default(), Default::default());
        let stack = MemStack::new(&mut scratch);
        symbolic
            .factorize_numeric_llt(&mut values, matrix, Side::Lower, regularization, Par::Seq, stack, params)
            .map_err(|LltError::NonPositivePivot { index }| {
                let dof = dof_of_place[index] as usize;
                FactorError::NotPositive { dof, node: dof / per_node }
            })?;
        Ok(Factor { place_of_dof, dof_of_place, symbolic, values })
    }
}

impl Factor {
    /// Factorises `stiffness` without the degrees of freedom whose displacement is given (`held[dof]`).
    ///
    /// # Panics
    /// Where `held` does not have an entry for each degree of freedom.
    pub fn new(stiffness: &Stiffness, held: &[bool]) -> Result<Self, FactorError> {
        assert_eq!(held.len(), stiffness.matrix().dofs(), "one entry for each degree of freedom");
        let parts = stiffness.parts();
        if let Some(Loose { node, held }) = parts.loose(held) {
            return Err(FactorError::Unsupported { node, held });
        }
        Self::of_held(stiffness.matrix(), |dof| held[dof] || !parts.has(dof / 2))
    }

    /// Factorises `matrix` without the degrees of freedom that `is_held`, which must prevent all rigid motions.
    pub fn of_held(matrix: &NodeMatrix, is_held: impl Fn(usize) -> bool) -> Result<Self, FactorError> {
        SymbolicFactor::new(matrix, is_held)?.factorised()
    }

    /// Solves K u = F in place for `columns` consecutive right-hand sides in `x`, each with an entry for every
    /// degree of freedom: forces in (ignored on held ones), displacements out (zero on held ones).
    ///
    /// # Panics
    /// Where `x` is not as long as `columns` times the degrees of freedom.
    pub fn solve(&self, columns: usize, x: &mut [f64]) {
        let (dofs, free) = (self.dofs(), self.dof_of_place.len());
        assert_eq!(x.len(), columns * dofs, "one entry for each degree of freedom and column");
        if free == 0 {
            return x.fill(0.0);
        }
        let at_once = columns.min(COLUMNS_AT_ONCE);
        let mut block = vec![0.0; at_once * free];
        let mut scratch = MemBuffer::new(self.supernodes().solve_in_place_scratch::<f64>(at_once, Par::Seq));
        let llt = self.llt();
        for given in x.chunks_mut(COLUMNS_AT_ONCE * dofs.max(1)) {
            let columns = given.len() / dofs;
            let block = &mut block[..columns * free];
            for (column, own) in given.chunks(dofs).zip(block.chunks_mut(free.max(1))) {
                for (value, dof) in own.iter_mut().zip(&self.dof_of_place) {
                    *value = column[*dof as usize];
                }
            }
            let rows = MatMut::from_column_major_slice_mut(block, free, columns);
            llt.solve_in_place_with_conj(Conj::No, rows, Par::Seq, MemStack::new(&mut scratch));
            given.fill(0.0);
            for (column, own) in given.chunks_mut(dofs).zip(block.chunks(free.max(1))) {
                for (value, dof) in own.iter().zip(&self.dof_of_place) {
                    column[*dof as usize] = *value;
                }
            }
        }
    }

    /// Subtracts K_fh u_h of given displacements (dof, mm) of held degrees of freedom from the forces.
    pub fn subtract_held(&self, stiffness: &NodeMatrix, held_mm: &[(u32, f64)], force_n_per_mm: &mut [f64]) {
        let mut displacement_mm = vec![0.0; self.dofs()];
        for (dof, value) in held_mm {
            displacement_mm[*dof as usize] = *value;
        }
        for (force, reaction) in force_n_per_mm.iter_mut().zip(stiffness.multiply(&displacement_mm)) {
            *force -= reaction;
        }
    }

    /// Number of degrees of freedom, supports included.
    pub fn dofs(&self) -> usize {
        self.place_of_dof.len()
    }

    /// L as dense blocks of columns.
    pub(super) fn llt(&self) -> SupernodalLltRef<'_, u32, f64> {
        SupernodalLltRef::new(self.supernodes(), &self.values)
    }

    /// Place of each degree of freedom in the order of elimination, or [`HELD`].
    pub(super) fn place_of_dof(&self) -> &[u32] {
        &self.place_of_dof
    }

    /// Pattern of L.
    pub(super) fn supernodes(&self) -> &SymbolicSupernodalCholesky<u32> {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(supernodes) => supernodes,
            SymbolicCholeskyRaw::Simplicial(_) => unreachable!("the symbolic factorisation is supernodal"),
        }
    }
}

impl Reduced {
    fn new(matrix: &NodeMatrix, free_of_dof: &[u32], dof_of_free: &[u32]) -> Self {
        let lower = matrix.lower();
        let start = lower.indptr();
        let start = start.raw_storage();
        let mut columns = Vec::with_capacity(dof_of_free.len() + 1);
        columns.push(0);
        let mut rows = Vec::with_capacity(lower.nnz());
        let mut values = Vec::with_capacity(lower.nnz());
        for dof in dof_of_free {
            for entry in start[*dof as usize]..start[*dof as usize + 1] {
                let row = free_of_dof[lower.indices()[entry as usize] as usize];
                if row != HELD {
                    rows.push(row);
                    values.push(lower.data()[entry as usize]);
                }
            }
            columns.push(rows.len() as u32);
        }
        Self { columns, rows, values }
    }

    fn matrix(&self) -> SparseColMatRef<'_, u32, f64> {
        let free = self.columns.len() - 1;
        let pattern = SymbolicSparseColMatRef::new_checked(free, free, &self.columns, None, &self.rows);
        SparseColMatRef::new(pattern, &self.values)
    }
}
