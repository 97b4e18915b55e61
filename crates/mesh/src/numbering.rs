//! Numbers of nodes and elements in files, the bound on entries, and blocks and sets under construction, for all readers.

use std::collections::BTreeMap;

use super::error::{FileProblem, LARGEST_EXPANSION};
use super::{CellBlock, CellKind, DataArray, Formulation, Values};

/// Map from the numbers of a file, in any order and with gaps, to indices from 0.
#[derive(Debug, Default)]
pub(super) struct Numbering {
    /// Pairs (number in the file, index), ascending.
    pairs: Vec<(u64, usize)>,
}

impl Numbering {
    /// Numbering of pairs in any order; no number may occur twice.
    pub(super) fn new(mut pairs: Vec<(u64, usize)>, what: &'static str) -> Result<Self, FileProblem> {
        if !pairs.is_sorted() {
            pairs.sort_unstable();
        }
        match pairs.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(FileProblem::Twice { what, number: pair[0].0 }),
            None => Ok(Self { pairs }),
        }
    }

    /// Index of `number` of the file.
    pub(super) fn index(&self, number: u64) -> Option<usize> {
        let (first, _) = *self.pairs.first()?;
        // Without gaps, which is usual, the place follows from the number.
        let guess = usize::try_from(number.checked_sub(first)?).ok()?;
        if let Some(&(found, index)) = self.pairs.get(guess)
            && found == number
        {
            return Some(index);
        }
        let at = self.pairs.binary_search_by_key(&number, |pair| pair.0).ok()?;
        Some(self.pairs[at].1)
    }

    /// Pairs with numbers in `first ..= last`, ascending.
    pub(super) fn range(&self, first: u64, last: u64) -> &[(u64, usize)] {
        let from = self.pairs.partition_point(|pair| pair.0 < first);
        let to = self.pairs.partition_point(|pair| pair.0 <= last);
        self.pairs.get(from..to).unwrap_or_default()
    }
}

/// Number of entries of sets and data that a file may still have.
#[derive(Debug)]
pub(super) struct Allowance {
    left: u64,
    limit: u64,
}

impl Allowance {
    /// Allowance for a file of so many `bytes`, with a minimum for small files.
    pub(super) fn of(bytes: usize) -> Self {
        const LEAST: u64 = 10_000;
        let limit = (bytes as u64).saturating_mul(LARGEST_EXPANSION).max(LEAST);
        Self { left: limit, limit }
    }

    /// Subtracts `entries`, if they are still allowed.
    pub(super) fn take(&mut self, entries: usize) -> Result<(), FileProblem> {
        self.left = self.left.checked_sub(entries as u64).ok_or(FileProblem::TooLarge { limit: self.limit })?;
        Ok(())
    }
}

/// Blocks of cells under construction, in the order of the file, with a new block wherever the kind changes.
#[derive(Debug, Default)]
pub(super) struct CellList {
    pub blocks: Vec<CellBlock>,
    /// Number of the first cell of each block, counted over all blocks.
    starts: Vec<usize>,
    count: usize,
}

impl CellList {
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Begins a new block, also of the same kind.
    pub(super) fn begin(&mut self, kind: CellKind, formulation: Option<Formulation>) {
        self.starts.push(self.count);
        self.blocks.push(CellBlock { kind, nodes: Vec::new(), formulation });
    }

    /// Adds a cell, in a new block if its kind is not that of the last; returns its number over all blocks.
    pub(super) fn push(&mut self, kind: CellKind, nodes: impl IntoIterator<Item = usize>) -> usize {
        if self.blocks.last().is_none_or(|block| block.kind != kind) {
            self.begin(kind, None);
        }
        if let Some(block) = self.blocks.last_mut() {
            block.nodes.extend(nodes);
        }
        self.count += 1;
        self.count - 1
    }

    /// Block of a cell, and its nodes, by its number over all blocks.
    pub(super) fn cell(&self, number: usize) -> (&CellBlock, &[usize]) {
        let block = self.starts.partition_point(|&start| start <= number) - 1;
        let (block, within) = (&self.blocks[block], number - self.starts[block]);
        let per_cell = block.kind.node_count();
        (block, &block.nodes[within * per_cell..(within + 1) * per_cell])
    }

    /// Divides the cells into blocks of given kinds and lengths, empty ones included; does nothing and returns false if the
    /// cells do not match.
    pub(super) fn divide(&mut self, lengths: &[(CellKind, usize)]) -> bool {
        let total = lengths.iter().try_fold(0_usize, |sum, &(_, length)| sum.checked_add(length));
        if total != Some(self.count) {
            return false;
        }
        let mut kinds = self.blocks.iter().flat_map(|block| std::iter::repeat_n(block.kind, block.len()));
        if !lengths.iter().all(|&(kind, length)| kinds.by_ref().take(length).all(|own| own == kind)) {
            return false;
        }
        let mut nodes = std::mem::take(&mut self.blocks).into_iter().flat_map(|block| block.nodes);
        self.starts.clear();
        let mut start = 0;
        for &(kind, length) in lengths {
            self.starts.push(start);
            start += length;
            self.blocks.push(CellBlock::new(kind, nodes.by_ref().take(length * kind.node_count()).collect()));
        }
        true
    }

    /// Data of all cells, divided into blocks.
    pub(super) fn split(&self, array: &DataArray) -> Vec<DataArray> {
        let components = array.components;
        let parts = self.blocks.iter().zip(&self.starts).map(|(block, &start)| {
            let range = start * components..(start + block.len()) * components;
            let values = match &array.values {
                Values::Integers(values) => Values::Integers(values[range].to_vec()),
                Values::Reals(values) => Values::Reals(values[range].to_vec()),
            };
            DataArray { components, values }
        });
        parts.collect()
    }

    /// Ascending lists for each block of cells that are numbered over all blocks in any order.
    pub(super) fn by_block(
        &self,
        mut cells: Vec<usize>,
        allowance: &mut Allowance,
    ) -> Result<Vec<Vec<usize>>, FileProblem> {
        allowance.take(self.blocks.len())?;
        cells.sort_unstable();
        cells.dedup();
        let mut rest = cells.as_slice();
        let mut lists = Vec::with_capacity(self.blocks.len());
        for (block, &start) in self.blocks.iter().zip(&self.starts) {
            let (own, after) = rest.split_at(rest.partition_point(|&cell| cell < start + block.len()));
            lists.push(own.iter().map(|cell| cell - start).collect());
            rest = after;
        }
        Ok(lists)
    }
}

/// Sets under construction by name, with the numbers of nodes or cells in any order.
pub(super) type OpenSets = BTreeMap<String, Vec<usize>>;

/// Node sets in their final form, ascending without repetition.
pub(super) fn close_point_sets(mut sets: OpenSets) -> BTreeMap<String, Vec<usize>> {
    for set in sets.values_mut() {
        set.sort_unstable();
        set.dedup();
    }
    sets
}

/// Cell sets in their final form.
pub(super) fn close_cell_sets(
    sets: OpenSets,
    cells: &CellList,
    allowance: &mut Allowance,
) -> Result<BTreeMap<String, Vec<Vec<usize>>>, FileProblem> {
    sets.into_iter().map(|(name, set)| Ok((name, cells.by_block(set, allowance)?))).collect()
}
