//! Whether the parts of a mesh fit together.

use super::{DataArray, Mesh, Values};

/// A contradiction within a mesh. Nodes, cells and blocks count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Inconsistency {
    /// A coordinate is infinite or not a number.
    #[error("node {node} (counted from 0) has a coordinate that is not finite")]
    NotFinite {
        /// The node.
        node: usize,
    },
    /// A block's nodes do not come out even.
    #[error("block {block} of cells ends within a cell: it lists {nodes} nodes, {per_cell} for each cell")]
    PartCell {
        /// The block.
        block: usize,
        /// Nodes listed.
        nodes: usize,
        /// Nodes of a cell of its kind.
        per_cell: usize,
    },
    /// A cell or a set refers to a node that is not there.
    #[error("{owner} refers to node {node} (counted from 0) of {nodes}")]
    NoSuchNode {
        /// Which cell or set.
        owner: String,
        /// The node.
        node: usize,
        /// Nodes of the mesh.
        nodes: usize,
    },
    /// A set refers to a cell that is not there.
    #[error("set {set:?} refers to cell {cell} of block {block} (counted from 0), which has {cells}")]
    NoSuchCell {
        /// The set.
        set: String,
        /// The block.
        block: usize,
        /// The cell.
        cell: usize,
        /// Cells of the block.
        cells: usize,
    },
    /// Not one list for each block of cells.
    #[error("{what} {name:?} has {lists} lists for {blocks} blocks of cells")]
    Blocks {
        /// Set or data.
        what: &'static str,
        /// Its name.
        name: String,
        /// Lists given.
        lists: usize,
        /// Blocks of the mesh.
        blocks: usize,
    },
    /// A data array of the wrong length.
    #[error("data {name:?} has {values} values for {owners} of {components} components")]
    DataLength {
        /// Its name.
        name: String,
        /// Values given.
        values: usize,
        /// Nodes, or cells of the block.
        owners: usize,
        /// Components said to be given.
        components: usize,
    },
    /// Two arrays of the same data differ in their components or type.
    #[error("data {name:?} changes its type or its number of components from block to block")]
    DataKind {
        /// Its name.
        name: String,
    },
    /// A set that is not in ascending order or names something twice.
    #[error("set {name:?} is not in ascending order without repetition")]
    NotAscending {
        /// Its name.
        name: String,
    },
    /// Two names with the same tag, or a dimension above 3.
    #[error("names {first:?} and {second:?} have the same tag {tag} of dimension {dimension}")]
    TagTwice {
        /// One name.
        first: String,
        /// The other name.
        second: String,
        /// The tag.
        tag: i64,
        /// Its dimension.
        dimension: u8,
    },
    /// A dimension above 3.
    #[error("the tag of {name:?} has dimension {dimension}; allowed: 0 to 3")]
    Dimension {
        /// The name.
        name: String,
        /// The dimension.
        dimension: u8,
    },
}

impl DataArray {
    /// How many numbers there are.
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
    /// Checks that the mesh does not contradict itself: coordinates are finite, every node and cell referred to exists, data
    /// have the length they should have, sets are ascending, tags differ. Every mesh that is read has passed this; every mesh
    /// to be written must.
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
