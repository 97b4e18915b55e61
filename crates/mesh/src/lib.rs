//! Finite-element meshes as plain data, structured like those of Python's meshio: points, cells by type, data at points and
//! cells, named sets.
//!
//! A mesh has no materials or loads. Coordinates are in mm. Node numbers count from 0. Order and names of a file are
//! kept, so that a mesh that is written and read is the same bit for bit. Sets are ascending without repetition
//! ([`Mesh::check`]).
//!
//! [`read`] and [`write()`] take files of the formats that [`mod@file`] lists.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub mod abaqus;
mod cell_kind;
pub mod check;
pub mod error;
pub mod file;
mod formulation;
pub mod gmsh;
mod json;
mod numbering;
pub mod quality;
mod tag_groups;
pub mod vtu;

pub use cell_kind::CellKind;
pub use error::MeshFileError;
pub use file::{Format, from_bytes, read, read_with_content, to_bytes, write, write_as};
pub use formulation::Formulation;
pub use tag_groups::tag_groups;

/// Finite-element mesh.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// Coordinates of the nodes, mm; plane meshes have z = 0.
    pub points: Vec<[f64; 3]>,
    /// Cells in blocks of one kind each.
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
    /// Named sets of cells: numbers within the block for each block of [`Self::cells`].
    #[serde(default)]
    pub cell_sets: BTreeMap<String, Vec<Vec<usize>>>,
    /// Tag and dimension of the named sets that come from physical groups.
    #[serde(default)]
    pub field_data: BTreeMap<String, PhysicalTag>,
    /// Elements of the file without a kind of cell, which are not part of the mesh.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOut>,
}

/// Elements of one type that a mesh cannot hold: springs, couplings, user elements …
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeftOut {
    /// Type as the file names it.
    pub element_type: String,
    /// Number of elements.
    pub count: usize,
    /// Line of the file with the first of them, from 1.
    pub line: usize,
    /// Cell sets that they would be in.
    pub sets: Vec<String>,
}

/// Cells of one kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellBlock {
    /// Kind of the cells.
    #[serde(rename = "type")]
    pub kind: CellKind,
    /// Node numbers cell by cell, [`CellKind::node_count`] each.
    pub nodes: Vec<usize>,
    /// What the element type of the file stands for, where it says more than the nodes do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub formulation: Option<Formulation>,
}

/// Numbers at nodes or cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DataArray {
    /// Number of components: 1 for a scalar, 2 or 3 for a vector …
    pub components: usize,
    /// Values of all components, owner by owner.
    pub values: Values,
}

/// Numbers with their type.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Values {
    /// Integers.
    Integers(Vec<i64>),
    /// Floating-point numbers.
    Reals(#[serde(with = "json::reals")] Vec<f64>),
}

/// Tag of a physical group, unique within its dimension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PhysicalTag {
    /// Number of the group.
    pub tag: i64,
    /// Dimension: 0 points, 1 lines, 2 surfaces, 3 volumes.
    pub dimension: u8,
}

impl Mesh {
    /// Adds point data of `components` numbers each.
    pub fn add_point_data(&mut self, name: &str, components: usize, values: Vec<f64>) {
        self.point_data.insert(name.to_owned(), DataArray { components, values: Values::Reals(values) });
    }

    /// Numbers over all blocks of cells given by `lists` of their numbers within each block.
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
    /// Cells of a kind on their nodes, without a formulation.
    pub fn new(kind: CellKind, nodes: Vec<usize>) -> Self {
        Self { kind, nodes, formulation: None }
    }

    /// Nodes of each cell.
    pub fn iter(&self) -> std::slice::ChunksExact<'_, usize> {
        self.nodes.chunks_exact(self.kind.node_count())
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.nodes.len() / self.kind.node_count()
    }

    /// Element type of an Abaqus file that stands for the cells, if there is one.
    pub fn element_type(&self) -> Option<String> {
        abaqus::element_type(self.kind, self.formulation)
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}
