//! Cells of a Gmsh file: entities for each combination of groups, and elements.

use std::collections::BTreeMap;

use super::cell_types;
use super::output::GmshOutput;
use crate::{CellKind, Mesh, PhysicalTag};

/// Physical group to be written.
#[derive(Debug, Clone)]
pub(super) struct PhysicalGroup<'a> {
    pub name: &'a str,
    pub tag: PhysicalTag,
}

/// Cells divided into entities by dimension and by the groups they are in.
#[derive(Debug)]
pub(super) struct Entities {
    /// Groups (indices of the list of groups) of the entities of each dimension; entity `i` has tag `i + 1`.
    by_dimension: [Vec<Vec<usize>>; 4],
    /// Entity within its dimension of each cell.
    of_cell: Vec<usize>,
    dimensions: Vec<u8>,
}

impl Entities {
    pub(super) fn new(mesh: &Mesh, groups: &[PhysicalGroup]) -> Self {
        let dimensions: Vec<u8> =
            mesh.cells.iter().flat_map(|block| std::iter::repeat_n(block.kind.dimension(), block.len())).collect();
        let mut groups_of_cell: Vec<Vec<usize>> = vec![Vec::new(); dimensions.len()];
        for (number, group) in groups.iter().enumerate() {
            let mut start = 0;
            let lists = mesh.cell_sets.get(group.name).map_or(&[][..], Vec::as_slice);
            for (list, block) in lists.iter().zip(&mesh.cells) {
                if block.kind.dimension() == group.tag.dimension {
                    list.iter().for_each(|cell| groups_of_cell[start + cell].push(number));
                }
                start += block.len();
            }
        }
        let mut by_dimension = [const { Vec::new() }; 4];
        let mut known = BTreeMap::new();
        let of_cell = std::iter::zip(&dimensions, groups_of_cell).map(|(&dimension, groups)| {
            let entities: &mut Vec<Vec<usize>> = &mut by_dimension[usize::from(dimension)];
            *known.entry((dimension, groups.clone())).or_insert_with(|| {
                entities.push(groups);
                entities.len() - 1
            })
        });
        let of_cell = of_cell.collect();
        Self { by_dimension, of_cell, dimensions }
    }

    /// Highest dimension of a cell; 0 without cells.
    pub(super) fn highest_dimension(&self) -> u8 {
        self.dimensions.iter().copied().max().unwrap_or(0)
    }

    fn groups(&self, cell: usize) -> &[usize] {
        &self.by_dimension[usize::from(self.dimensions[cell])][self.of_cell[cell]]
    }

    /// Cells that version 2 writes again, once for each group after their first.
    pub(super) fn copies(&self) -> Vec<usize> {
        let cells = 0..self.of_cell.len();
        cells.flat_map(|cell| std::iter::repeat_n(cell, self.groups(cell).len().saturating_sub(1))).collect()
    }
}

/// Writes the section `$Entities` of version 4.1.
pub(super) fn write_entities(out: &mut GmshOutput, mesh: &Mesh, groups: &[PhysicalGroup], entities: &Entities) {
    if entities.of_cell.is_empty() {
        return;
    }
    let boxes = boxes(mesh, entities);
    out.line("$Entities");
    entities.by_dimension.iter().for_each(|own| out.size(own.len()));
    out.end_line();
    for (dimension, own) in entities.by_dimension.iter().enumerate() {
        for (number, members) in own.iter().enumerate() {
            out.int(number as i64 + 1);
            let [low, high] = boxes[dimension][number];
            low.iter().for_each(|&x| out.real(x));
            if dimension > 0 {
                high.iter().for_each(|&x| out.real(x));
            }
            out.size(members.len());
            members.iter().for_each(|&group| out.int(groups[group].tag.tag));
            if dimension > 0 {
                out.size(0);
            }
            out.end_line();
        }
    }
    out.end_section("Entities");
}

/// Bounding box of the nodes of each entity.
fn boxes(mesh: &Mesh, entities: &Entities) -> [Vec<[[f64; 3]; 2]>; 4] {
    let mut boxes =
        entities.by_dimension.each_ref().map(|own| vec![[[f64::INFINITY; 3], [-f64::INFINITY; 3]]; own.len()]);
    let cells = mesh.cells.iter().flat_map(|block| block.iter());
    for ((nodes, &dimension), &entity) in cells.zip(&entities.dimensions).zip(&entities.of_cell) {
        let [low, high] = &mut boxes[usize::from(dimension)][entity];
        for &node in nodes {
            for (axis, &x) in mesh.points[node].iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
    }
    boxes
}

/// Writes the elements of version 4.1, a block for each run of cells of one kind and entity.
pub(super) fn write_elements_4(out: &mut GmshOutput, mesh: &Mesh, entities: &Entities) {
    let cells: Vec<(CellKind, &[usize])> =
        mesh.cells.iter().flat_map(|block| block.iter().map(|nodes| (block.kind, nodes))).collect();
    let numbered: Vec<usize> = (0..cells.len()).collect();
    let runs: Vec<&[usize]> =
        numbered.chunk_by(|&a, &b| cells[a].0 == cells[b].0 && entities.of_cell[a] == entities.of_cell[b]).collect();
    out.line("$Elements");
    for value in [runs.len(), cells.len(), usize::from(!cells.is_empty()), cells.len()] {
        out.size(value);
    }
    out.end_line();
    let (mut own, mut scratch) = (Vec::new(), Vec::new());
    for run in runs {
        let (kind, first) = (cells[run[0]].0, run[0]);
        out.int(kind.dimension().into());
        out.int(entities.of_cell[first] as i64 + 1);
        out.int(cell_types::number(kind).into());
        out.size(run.len());
        out.end_line();
        for &cell in run {
            out.size(cell + 1);
            own.clear();
            own.extend_from_slice(cells[cell].1);
            cell_types::to_gmsh(kind, &mut own, &mut scratch);
            own.iter().for_each(|node| out.size(node + 1));
            out.end_line();
        }
    }
    out.end_section("Elements");
}

/// Writes the elements of version 2.2: every cell with its first group, then the copies for further groups.
pub(super) fn write_elements_2(out: &mut GmshOutput, mesh: &Mesh, groups: &[PhysicalGroup], entities: &Entities) {
    let cells: Vec<(CellKind, &[usize])> =
        mesh.cells.iter().flat_map(|block| block.iter().map(|nodes| (block.kind, nodes))).collect();
    let mut elements: Vec<(usize, Option<usize>)> =
        (0..cells.len()).map(|cell| (cell, entities.groups(cell).first().copied())).collect();
    for cell in 0..cells.len() {
        elements.extend(entities.groups(cell).iter().skip(1).map(|&group| (cell, Some(group))));
    }
    out.line("$Elements");
    out.line(elements.len());
    let (mut own, mut scratch) = (Vec::new(), Vec::new());
    let mut number = 0;
    for run in elements.chunk_by(|a, b| cells[a.0].0 == cells[b.0].0) {
        let kind = cells[run[0].0].0;
        let element_type = i64::from(cell_types::number(kind));
        if out.binary {
            [element_type, run.len() as i64, 2].into_iter().for_each(|value| out.int(value));
        }
        for &(cell, group) in run {
            number += 1;
            out.int(number);
            if !out.binary {
                out.int(element_type);
                out.int(2);
            }
            out.int(group.map_or(0, |group| groups[group].tag.tag));
            out.int(entities.of_cell[cell] as i64 + 1);
            own.clear();
            own.extend_from_slice(cells[cell].1);
            cell_types::to_gmsh(kind, &mut own, &mut scratch);
            own.iter().for_each(|&node| out.int(node as i64 + 1));
            out.end_line();
        }
    }
    out.end_section("Elements");
}
