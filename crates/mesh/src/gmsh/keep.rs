//! Section `$Gearwear` with the parts of a mesh that Gmsh has no place for.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{CellKind, Formulation};

pub(super) const SECTION: &str = "Gearwear";

/// Content of the section. Parts left out are as in the other sections.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Keep {
    /// Kind and number of cells of each block, where blocks are not runs of one kind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blocks: Option<Vec<(CellKind, usize)>>,
    /// Formulations of blocks by their number, from 0.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub formulations: BTreeMap<usize, Formulation>,
    /// Node sets, with nodes by their index in the file.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub point_sets: BTreeMap<String, Vec<usize>>,
    /// Cell sets without a tag.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub untagged: Vec<String>,
    /// Form of node data other than real numbers of 1, 3 or 9 components.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub point_data: BTreeMap<String, DataForm>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub cell_data: BTreeMap<String, DataForm>,
    /// Cells (from 0) of which the last elements of version 2.2 are copies for further groups.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copies: Option<Vec<usize>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DataForm {
    /// Number of components in the mesh; in the file they are padded with zeros.
    pub components: usize,
    pub integers: bool,
}
