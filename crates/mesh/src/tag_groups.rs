//! Groups that integers at the cells stand for.
//!
//! Programs without named sets number the parts of a mesh: `gmsh:physical` of meshio holds the tags of physical groups, `medit:ref`,
//! `CellEntityIds`, `MaterialIds` … the same under other names. Every value of such an array is a group of the cells that have it:
//!
//! | array | group |
//! |---|---|
//! | `gmsh:physical` | the name that `field_data` gives the tag in the dimension of the cells, or the tag: `7`; 0 is none |
//! | another `NAME` | `NAME=7` |
//!
//! Sets that the mesh has already keep their names, and arrays with very many values are no groups.

use std::collections::{BTreeMap, BTreeSet};

use crate::{Mesh, PhysicalTag, Values};

/// Name of the tags of physical groups in cell data.
pub(crate) const PHYSICAL: &str = "gmsh:physical";
/// Greatest number of groups of one array: more are numbers of the cells, not of groups.
const MOST_GROUPS: usize = 1000;

/// Cells with the same integer.
#[derive(Debug, Clone, PartialEq)]
pub struct TagGroup {
    /// Name of the group.
    pub name: String,
    /// Name of the cell data.
    pub data: String,
    /// Tag and dimension of a physical group whose cells are of one dimension.
    pub tag: Option<PhysicalTag>,
    /// Numbers within each block of cells.
    pub lists: Vec<Vec<usize>>,
}

/// Groups of all integer data of one component at the cells of a mesh, without those whose name is that of a set.
pub fn tag_groups(mesh: &Mesh) -> Vec<TagGroup> {
    let mut groups: BTreeMap<String, TagGroup> = BTreeMap::new();
    for (data, arrays) in &mesh.cell_data {
        let integers = arrays.iter().map(|array| match &array.values {
            Values::Integers(values) if array.components == 1 => Some(values.as_slice()),
            _ => None,
        });
        let Some(integers) = integers.collect::<Option<Vec<&[i64]>>>() else { continue };
        let by_value = integers.iter().map(|values| {
            let mut cells: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
            (0..).zip(*values).for_each(|(cell, value)| cells.entry(*value).or_default().push(cell));
            cells
        });
        let by_value: Vec<BTreeMap<i64, Vec<usize>>> = by_value.collect();
        let values: BTreeSet<i64> = by_value.iter().flat_map(BTreeMap::keys).copied().collect();
        // Entities of the geometry say nothing beside the groups made of them.
        if values.len() > MOST_GROUPS || data == "gmsh:geometrical" {
            continue;
        }
        for (number, (block, cells)) in mesh.cells.iter().zip(by_value).enumerate() {
            for (tag, cells) in cells {
                let own = PhysicalTag { tag, dimension: block.kind.dimension() };
                let name = name(mesh, data, own);
                let is_none = data == PHYSICAL && tag == 0;
                if is_none || mesh.cell_sets.contains_key(&name) || mesh.point_sets.contains_key(&name) {
                    continue;
                }
                let group = groups.entry(name.clone()).or_insert_with(|| TagGroup {
                    name,
                    data: data.clone(),
                    tag: (data == PHYSICAL && tag > 0).then_some(own),
                    lists: vec![Vec::new(); mesh.cells.len()],
                });
                group.tag = group.tag.filter(|tag| tag.dimension == own.dimension);
                if group.data == *data {
                    group.lists[number] = cells;
                }
            }
        }
    }
    groups.into_values().collect()
}

/// Name of the group of cells with a tag.
fn name(mesh: &Mesh, data: &str, own: PhysicalTag) -> String {
    if data != PHYSICAL {
        return format!("{data}={}", own.tag);
    }
    let named = mesh.field_data.iter().find(|(_, tag)| **tag == own);
    named.map_or_else(|| own.tag.to_string(), |(name, _)| name.clone())
}
