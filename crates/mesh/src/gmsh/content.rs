//! The content of a Gmsh file, gathered section by section, and the mesh it makes.

use std::collections::{BTreeMap, BTreeSet};

use super::keep::{DataForm, Keep, SECTION};
use crate::error::{Fault, Problem};
use crate::numbering::{Allowance, CellList, Numbering, OpenSets, close_cell_sets, close_point_sets};
use crate::{DataArray, Mesh, PhysicalTag, Values};

/// Dimension and tag of a physical group.
pub(super) type GroupKey = (u8, i64);

#[derive(Debug, Default)]
pub(super) struct Content {
    /// Names of physical groups in the order of the file.
    pub names: Vec<(GroupKey, String)>,
    /// Version 4.1: the groups of each entity, by its dimension and tag.
    pub entities: BTreeMap<(i64, i64), Vec<i64>>,
    pub points: Vec<[f64; 3]>,
    /// Numbers of the nodes, once they are read.
    pub nodes: Option<Numbering>,
    pub cells: CellList,
    /// Numbers of the cells, once they are read; several may mean the same.
    pub elements: Option<Numbering>,
    pub groups: BTreeMap<GroupKey, Vec<usize>>,
    pub node_data: BTreeMap<String, RawData>,
    pub element_data: BTreeMap<String, RawData>,
    pub keep: Keep,
}

/// Data at all nodes or cells.
#[derive(Debug)]
pub(super) struct RawData {
    /// Components in the file.
    pub components: usize,
    /// Values, NaN where the file gives none.
    pub values: Vec<f64>,
}

/// What a group is called by its dimension, where its tag alone does not tell.
const DIMENSION_NAMES: [&str; 4] = ["points", "lines", "surfaces", "volumes"];

impl Content {
    pub(super) fn into_mesh(mut self, mut allowance: Allowance) -> Result<Mesh, Fault> {
        let (cell_sets, field_data) = self.named_sets();
        let kept = |problem: Problem| Fault::anywhere(format!("${SECTION}"), problem);
        if let Some(blocks) = &self.keep.blocks
            && !self.cells.divide(blocks)
        {
            return Err(kept(Problem::unexpected("blocks", "blocks that the cells of `$Elements` make")));
        }
        let allowed = |problem: Problem| Fault::anywhere("$Elements", problem);
        let cell_sets = close_cell_sets(cell_sets, &self.cells, &mut allowance).map_err(allowed)?;
        let point_data = self.node_data.into_iter().map(|(name, data)| {
            let form = self.keep.point_data.get(&name);
            Ok((name, data.take_form(form).map_err(kept)?))
        });
        let point_data = point_data.collect::<Result<_, Fault>>()?;
        let mut cell_data = BTreeMap::new();
        for (name, data) in self.element_data {
            allowance.take(self.cells.blocks.len()).map_err(allowed)?;
            let array = data.take_form(self.keep.cell_data.get(&name)).map_err(kept)?;
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
        })
    }

    /// Sets under their names with their tags; of several groups of one name the first in the file gives the tag.
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

impl RawData {
    /// In the form that the mesh had.
    fn take_form(self, form: Option<&DataForm>) -> Result<DataArray, Problem> {
        let Some(&DataForm { components, integers }) = form else {
            return Ok(DataArray { components: self.components, values: Values::Reals(self.values) });
        };
        if components == 0 || components > self.components {
            let expected = format!("1 to {} components", self.components);
            return Err(Problem::unexpected(&components.to_string(), expected));
        }
        let kept = self.values.chunks_exact(self.components).flat_map(|values| &values[..components]).copied();
        let values = if integers {
            let integer = |value: f64| match value {
                value if value.fract() == 0.0 && value.abs() <= super::write::LARGEST_INTEGER as f64 => {
                    Ok(value as i64)
                }
                value => Err(Problem::unexpected(&value.to_string(), "an integer")),
            };
            Values::Integers(kept.map(integer).collect::<Result<_, _>>()?)
        } else {
            Values::Reals(kept.collect())
        };
        Ok(DataArray { components, values })
    }
}
