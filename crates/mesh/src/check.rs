//! Check of the consistency of a mesh.

use super::{DataArray, Mesh, Values};

/// Inconsistency of a mesh. Nodes, cells and blocks count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Inconsistency {
    /// A coordinate is infinite or not a number.
    #[error("node {node} (counted from 0) has a coordinate that is not finite")]
    NotFinite {
        /// Number of the node.
        node: usize,
    },
    /// The number of nodes of a block is not a multiple of that of a cell.
    #[error("block {block} of cells ends within a cell: it lists {nodes} nodes, {per_cell} for each cell")]
    PartCell {
        /// Number of the block.
        block: usize,
        /// Number of nodes listed.
        nodes: usize,
        /// Number of nodes of a cell.
        per_cell: usize,
    },
    /// A cell or a set refers to a node that does not exist.
    #[error("{owner} refers to node {node} (counted from 0) of {nodes}")]
    NoSuchNode {
        /// Cell or set.
        owner: String,
        /// Number of the node.
        node: usize,
        /// Number of nodes of the mesh.
        nodes: usize,
    },
    /// A set refers to a cell that does not exist.
    #[error("set {set:?} refers to cell {cell} of block {block} (counted from 0), which has {cells}")]
    NoSuchCell {
        /// Name of the set.
        set: String,
        /// Number of the block.
        block: usize,
        /// Number of the cell.
        cell: usize,
        /// Number of cells of the block.
        cells: usize,
    },
    /// There is not one list for each block of cells.
    #[error("{what} {name:?} has {lists} lists for {blocks} blocks of cells")]
    Blocks {
        /// Set or data.
        what: &'static str,
        /// Name of the set or data.
        name: String,
        /// Number of lists.
        lists: usize,
        /// Number of blocks.
        blocks: usize,
    },
    /// A data array has the wrong length.
    #[error("data {name:?} has {values} values for {owners} of {components} components")]
    DataLength {
        /// Name of the data.
        name: String,
        /// Number of values.
        values: usize,
        /// Number of nodes, or of cells of the block.
        owners: usize,
        /// Number of components.
        components: usize,
    },
    /// Two arrays of the same data differ in their components or type.
    #[error("data {name:?} changes its type or its number of components from block to block")]
    DataKind {
        /// Name of the data.
        name: String,
    },
    /// A set is not in ascending order, or has repetitions.
    #[error("set {name:?} is not in ascending order without repetition")]
    NotAscending {
        /// Name of the set.
        name: String,
    },
    /// Two names have the same tag.
    #[error("names {first:?} and {second:?} have the same tag {tag} of dimension {dimension}")]
    TagTwice {
        /// First name.
        first: String,
        /// Second name.
        second: String,
        /// Tag of both.
        tag: i64,
        /// Dimension of the tag.
        dimension: u8,
    },
    /// A dimension is above 3.
    #[error("the tag of {name:?} has dimension {dimension}; allowed: 0 to 3")]
    Dimension {
        /// Name of the tag.
        name: String,
        /// Dimension of the tag.
        dimension: u8,
    },
}

impl DataArray {
    /// Number of values.
    pub fn value_count(&self) -> usize {
        match &self.values {
            Values::Integers(values) => values.len(),
            Values::Reals(values) => values.len(),
        }
    }

    fn check(&self, name: &str, owners: usize) -> Result<(), Inconsistency> {
        let values = self.value_count();
        if self.components == 0 || Some(values) != owners.checked_mul(self.components) {
            let (name, components) = (name.to_owned(), self.components);
            return Err(Inconsistency::DataLength { name, values, owners, components });
        }
        Ok(())
    }

    fn is_like(&self, other: &Self) -> bool {
        self.components == other.components
            && matches!(self.values, Values::Reals(_)) == matches!(other.values, Values::Reals(_))
    }
}

impl Mesh {
    /// Checks the consistency of the mesh: finite coordinates, existing nodes and cells, lengths of data, ascending sets and
    /// different tags. Every mesh is checked when it is read or written.
    pub fn check(&self) -> Result<(), Inconsistency> {
        self.check_cells()?;
        self.check_data()?;
        self.check_sets()?;
        self.check_tags()
    }

    fn check_cells(&self) -> Result<(), Inconsistency> {
        let nodes = self.points.len();
        if let Some(node) = self.points.iter().position(|point| !point.iter().all(|x| x.is_finite())) {
            return Err(Inconsistency::NotFinite { node });
        }
        for (number, block) in self.cells.iter().enumerate() {
            let per_cell = block.kind.node_count();
            if !block.nodes.len().is_multiple_of(per_cell) {
                return Err(Inconsistency::PartCell { block: number, nodes: block.nodes.len(), per_cell });
            }
            if let Some(at) = block.nodes.iter().position(|&node| node >= nodes) {
                let owner = format!("cell {} of block {number}", at / per_cell);
                return Err(Inconsistency::NoSuchNode { owner, node: block.nodes[at], nodes });
            }
        }
        Ok(())
    }

    fn check_data(&self) -> Result<(), Inconsistency> {
        for (name, data) in &self.point_data {
            data.check(name, self.points.len())?;
        }
        for (name, arrays) in &self.cell_data {
            self.check_blocks("data", name, arrays.len())?;
            for (array, block) in arrays.iter().zip(&self.cells) {
                array.check(name, block.len())?;
                if !array.is_like(&arrays[0]) {
                    return Err(Inconsistency::DataKind { name: name.clone() });
                }
            }
        }
        Ok(())
    }

    fn check_sets(&self) -> Result<(), Inconsistency> {
        let nodes = self.points.len();
        for (name, set) in &self.point_sets {
            if let Some(&node) = set.iter().find(|&&node| node >= nodes) {
                return Err(Inconsistency::NoSuchNode { owner: format!("set {name:?}"), node, nodes });
            }
            check_ascending(name, set)?;
        }
        for (name, lists) in &self.cell_sets {
            self.check_blocks("set", name, lists.len())?;
            for (number, (list, block)) in lists.iter().zip(&self.cells).enumerate() {
                if let Some(&cell) = list.iter().find(|&&cell| cell >= block.len()) {
                    let (set, cells) = (name.clone(), block.len());
                    return Err(Inconsistency::NoSuchCell { set, block: number, cell, cells });
                }
                check_ascending(name, list)?;
            }
        }
        Ok(())
    }

    fn check_blocks(&self, what: &'static str, name: &str, lists: usize) -> Result<(), Inconsistency> {
        let blocks = self.cells.len();
        if lists == blocks {
            return Ok(());
        }
        Err(Inconsistency::Blocks { what, name: name.to_owned(), lists, blocks })
    }

    fn check_tags(&self) -> Result<(), Inconsistency> {
        let mut seen = std::collections::BTreeMap::new();
        for (name, group) in &self.field_data {
            if group.dimension > 3 {
                return Err(Inconsistency::Dimension { name: name.clone(), dimension: group.dimension });
            }
            if let Some(first) = seen.insert((group.dimension, group.tag), name) {
                let (tag, dimension) = (group.tag, group.dimension);
                return Err(Inconsistency::TagTwice { first: first.clone(), second: name.clone(), tag, dimension });
            }
        }
        Ok(())
    }
}

fn check_ascending(name: &str, set: &[usize]) -> Result<(), Inconsistency> {
    if set.windows(2).all(|pair| pair[0] < pair[1]) {
        return Ok(());
    }
    Err(Inconsistency::NotAscending { name: name.to_owned() })
}
