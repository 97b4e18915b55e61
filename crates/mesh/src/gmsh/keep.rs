//! The section `$Gearwear`: what a mesh has and Gmsh has no place for.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::CellKind;

pub(super) const SECTION: &str = "Gearwear";

/// Its content. What is left out is as Gmsh has it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Keep {
    /// Kind and number of cells of each block, where blocks are not just runs of one kind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blocks: Option<Vec<(CellKind, usize)>>,
    /// Node sets; nodes by their place in the file, from 0.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub point_sets: BTreeMap<String, Vec<usize>>,
    /// Cell sets that have no tag of their own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub untagged: Vec<String>,
    /// Type of node data, where it is not real numbers of 1, 3 or 9 components.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub point_data: BTreeMap<String, DataForm>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub cell_data: BTreeMap<String, DataForm>,
    /// Version 2.2: the last elements are copies, for their further groups, of these cells (numbers from 0).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copies: Option<Vec<usize>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DataForm {
    /// Components in the mesh; Gmsh's are filled up with zeros.
    pub components: usize,
    pub integers: bool,
}
