//! Content of a Gmsh file, read section by section, and the mesh made of it.

use std::collections::{BTreeMap, BTreeSet};

use super::keep::{DataForm, Keep, SECTION};
use crate::error::{FileFault, FileProblem};
use crate::numbering::{Allowance, CellList, Numbering, OpenSets, close_cell_sets, close_point_sets};
use crate::{DataArray, Mesh, PhysicalTag, Values};

/// Dimension and tag of a physical group.
pub(super) type GroupKey = (u8, i64);

#[derive(Debug, Default)]
pub(super) struct GmshContent {
    /// Names of physical groups in the order of the file.
    pub names: Vec<(GroupKey, String)>,
    /// Groups of each entity of version 4.1, by dimension and tag.
    pub entities: BTreeMap<(i64, i64), Vec<i64>>,
    pub points: Vec<[f64; 3]>,
    /// Numbers of the nodes, after `$Nodes`.
    pub nodes: Option<Numbering>,
    pub cells: CellList,
    /// Numbers of the cells, after `$Elements`; several may refer to the same cell.
    pub elements: Option<Numbering>,
    pub groups: BTreeMap<GroupKey, Vec<usize>>,
    pub node_data: BTreeMap<String, RawData>,
    pub element_data: BTreeMap<String, RawData>,
    pub keep: Keep,
}

/// Data at all nodes or cells.
#[derive(Debug)]
pub(super) struct RawData {
    /// Number of components in the file.
    pub components: usize,
    /// Values, NaN where the file has none.
    pub values: Vec<f64>,
}

/// Suffixes of groups by dimension, where several have the same tag.
const DIMENSION_NAMES: [&str; 4] = ["points", "lines", "surfaces", "volumes"];

impl GmshContent {
    pub(super) fn into_mesh(mut self, mut allowance: Allowance) -> Result<Mesh, FileFault> {
        let (cell_sets, field_data) = self.named_sets();
        if let Some(blocks) = &self.keep.blocks
            && !self.cells.divide(blocks)
        {
            return Err(in_keep(FileProblem::unexpected("blocks", "kinds and numbers of the cells of `$Elements`")));
        }
        for (&block, &formulation) in &self.keep.formulations {
            let block = self.cells.blocks.get_mut(block);
            let expected = || in_keep(FileProblem::unexpected("formulations", "numbers of the blocks of cells"));
            block.ok_or_else(expected)?.formulation = Some(formulation);
        }
        let cell_sets = close_cell_sets(cell_sets, &self.cells, &mut allowance).map_err(in_elements)?;
        let point_data = self.node_data.into_iter().map(|(name, data)| {
            let form = self.keep.point_data.get(&name);
            Ok((name, data.take_form(form).map_err(in_keep)?))
        });
        let point_data = point_data.collect::<Result<_, FileFault>>()?;
        let mut cell_data = BTreeMap::new();
        for (name, data) in self.element_data {
            allowance.take(self.cells.blocks.len()).map_err(in_elements)?;
            let array = data.take_form(self.keep.cell_data.get(&name)).map_err(in_keep)?;
            cell_data.insert(name, self.cells.split(&array));
        }
        Ok(Mesh {
            points: self.points,
            cells: self.cells.blocks,
            point_data,
            cell_data,
            point_sets: close_point_sets(self.keep.point_sets),
            cell_sets,
            field_data,
            left_out: Vec::new(),
        })
    }

    /// Sets and tags by name; of several groups of one name the first in the file has the tag.
    fn named_sets(&mut self) -> (OpenSets, BTreeMap<String, PhysicalTag>) {
        let (mut sets, mut tags) = (OpenSets::new(), BTreeMap::new());
        let mut named = BTreeSet::new();
        for (key, name) in &self.names {
            named.insert(*key);
            sets.entry(name.clone()).or_default().extend(self.groups.get(key).into_iter().flatten());
            tags.entry(name.clone()).or_insert(PhysicalTag { tag: key.1, dimension: key.0 });
        }
        self.groups.retain(|key, _| !named.contains(key));
        for (key, cells) in &self.groups {
            let shared = (0..4).any(|dimension| dimension != key.0 && self.groups.contains_key(&(dimension, key.1)));
            let mut name = key.1.to_string();
            while shared && name == key.1.to_string() || sets.contains_key(&name) {
                name = format!("{name}-{}", DIMENSION_NAMES[usize::from(key.0)]);
            }
            sets.insert(name.clone(), cells.clone());
            tags.insert(name, PhysicalTag { tag: key.1, dimension: key.0 });
        }
        for name in &self.keep.untagged {
            tags.remove(name);
        }
        (sets, tags)
    }
}

/// Fault of the section `$Gearwear`.
fn in_keep(problem: FileProblem) -> FileFault {
    FileFault::anywhere(format!("${SECTION}"), problem)
}

/// Fault of the section `$Elements`.
fn in_elements(problem: FileProblem) -> FileFault {
    FileFault::anywhere("$Elements", problem)
}

impl RawData {
    /// Data in the form that the written mesh had.
    fn take_form(self, form: Option<&DataForm>) -> Result<DataArray, FileProblem> {
        let Some(&DataForm { components, integers }) = form else {
            return Ok(DataArray { components: self.components, values: Values::Reals(self.values) });
        };
        if components == 0 || components > self.components {
            let expected = format!("1 to {} components", self.components);
            return Err(FileProblem::unexpected(&components.to_string(), expected));
        }
        let kept = self.values.chunks_exact(self.components).flat_map(|values| &values[..components]).copied();
        let values = if integers {
            let integers = kept.map(|value| match value {
                value if value.fract() == 0.0 && value.abs() <= super::write::LARGEST_INTEGER as f64 => {
                    Ok(value as i64)
                }
                value => Err(FileProblem::unexpected(&value.to_string(), "an integer")),
            });
            Values::Integers(integers.collect::<Result<_, _>>()?)
        } else {
            Values::Reals(kept.collect())
        };
        Ok(DataArray { components, values })
    }
}
