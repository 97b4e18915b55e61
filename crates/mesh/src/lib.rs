//! Finite-element meshes as plain data, shaped like those of Python's meshio: points, cells by type, data at points and
//! cells, named sets.
//!
//! A mesh says nothing of materials or loads. Coordinates are in mm. Node numbers count from 0. Everything is kept in the
//! order read, names included, so that reading what was written gives the same mesh bit for bit. Sets are ascending and
//! name nothing twice ([`Mesh::check`]).
//!
//! [`read`] and [`write()`] take files of the formats that [`mod@file`] lists.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub mod abaqus;
mod cell_kind;
pub mod check;
pub mod error;
pub mod file;
pub mod gmsh;
mod json;
mod numbering;
pub mod quality;
pub mod vtu;

pub use cell_kind::CellKind;
pub use error::MeshFileError;
pub use file::{Format, from_bytes, read, to_bytes, write, write_as};

/// A mesh.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// Coordinates of the nodes, mm; plane meshes have z = 0.
    pub points: Vec<[f64; 3]>,
    /// The cells, in blocks of one kind each.
    pub cells: Vec<CellBlock>,
    /// Values at the nodes, by name.
    #[serde(default)]
    pub point_data: BTreeMap<String, DataArray>,
    /// Values of the cells, by name: one array for each block of [`Self::cells`].
    #[serde(default)]
    pub cell_data: BTreeMap<String, Vec<DataArray>>,
    /// Named sets of nodes.
    #[serde(default)]
    pub point_sets: BTreeMap<String, Vec<usize>>,
    /// Named sets of cells: for each block of [`Self::cells`] the numbers of its cells within the block.
    #[serde(default)]
    pub cell_sets: BTreeMap<String, Vec<Vec<usize>>>,
    /// Tag and dimension of the named sets that come from physical groups.
    #[serde(default)]
    pub field_data: BTreeMap<String, PhysicalTag>,
}

/// Cells of one kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellBlock {
    /// What they are.
    #[serde(rename = "type")]
    pub kind: CellKind,
    /// Node numbers, [`CellKind::node_count`] for each cell, one cell after the other.
    pub nodes: Vec<usize>,
}

/// Numbers at nodes or cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DataArray {
    /// Numbers for each node or cell: 1 a scalar, 2 or 3 a vector …
    pub components: usize,
    /// The numbers.
    pub values: Values,
}

/// Numbers with their type, so that integers stay integers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Values {
    /// Integers.
    Integers(Vec<i64>),
    /// Floating-point numbers.
    Reals(#[serde(with = "json::reals")] Vec<f64>),
}

/// The tag of a physical group, unique within its dimension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PhysicalTag {
    /// Its number.
    pub tag: i64,
    /// 0 points, 1 lines, 2 surfaces, 3 volumes.
    pub dimension: u8,
}

impl Mesh {
    /// Adds numbers at the points, so many `components` of each.
    pub fn add_point_data(&mut self, name: &str, components: usize, values: Vec<f64>) {
        self.point_data.insert(name.to_owned(), DataArray { components, values: Values::Reals(values) });
    }

    /// Cells counted over all blocks, from `lists` of their numbers within each.
    fn over_all<'m>(&'m self, lists: &'m [Vec<usize>]) -> impl Iterator<Item = usize> + 'm {
        let mut start = 0;
        self.cells.iter().zip(lists).flat_map(move |(block, list)| {
            let first = start;
            start += block.len();
            list.iter().map(move |cell| first + cell)
        })
    }
}

impl CellBlock {
    /// The cells' nodes, cell by cell.
    pub fn iter(&self) -> std::slice::ChunksExact<'_, usize> {
        self.nodes.chunks_exact(self.kind.node_count())
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.nodes.len() / self.kind.node_count()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}
