//! Writing of Abaqus files.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::elements;
use crate::error::Unwritable;
use crate::{CellBlock, CellKind, Mesh};

const FORMAT: &str = "an Abaqus file";

/// Element (counted over all cells) and side of a line or face.
type Side = (usize, usize);

pub(crate) fn write(mesh: &Mesh) -> Result<Vec<u8>, Unwritable> {
    check(mesh)?;
    let surfaces = Surfaces::of(mesh);
    let mut text = String::from("*HEADING\nmesh\n");
    nodes(&mut text, mesh);
    let numbers = write_elements(&mut text, mesh, &surfaces);
    for (name, set) in &mesh.point_sets {
        keyword(&mut text, "*NSET, NSET=", name, mesh);
        list(&mut text, set.iter().map(|node| node + 1));
    }
    for (name, lists) in &mesh.cell_sets {
        match surfaces.sides.get(name) {
            None => {
                keyword(&mut text, "*ELSET, ELSET=", name, mesh);
                list(&mut text, mesh.over_all(lists).filter_map(|cell| numbers[cell]));
            }
            Some(sides) => {
                keyword(&mut text, "*SURFACE, TYPE=ELEMENT, NAME=", name, mesh);
                for &(cell, side) in sides {
                    let label = elements::label(surfaces.block_of[cell], side);
                    line(&mut text, format_args!("{}, {label}", numbers[cell].unwrap_or(0)));
                }
                if !mesh.point_sets.contains_key(name) {
                    keyword(&mut text, "*NSET, NSET=", name, mesh);
                    let cells = mesh.cells.iter().zip(lists);
                    let mut nodes: Vec<usize> = cells
                        .flat_map(|(block, list)| {
                            let per_cell = block.kind.node_count();
                            list.iter().flat_map(move |cell| &block.nodes[cell * per_cell..(cell + 1) * per_cell])
                        })
                        .map(|node| node + 1)
                        .collect();
                    nodes.sort_unstable();
                    nodes.dedup();
                    list(&mut text, nodes.into_iter());
                }
            }
        }
    }
    Ok(text.into_bytes())
}

fn check(mesh: &Mesh) -> Result<(), Unwritable> {
    let no_data = "nodes, elements, sets and surfaces; write .vtu or .msh";
    if let Some(name) = mesh.point_data.keys().next() {
        return Err(Unwritable::data(FORMAT, "point data", name, no_data));
    }
    if let Some(name) = mesh.cell_data.keys().next() {
        return Err(Unwritable::data(FORMAT, "cell data", name, no_data));
    }
    if let Some(block) = mesh.cells.iter().find(|block| elements::name(block.kind, block.formulation).is_none()) {
        return Err(Unwritable::data(FORMAT, "cells", &in_words(block), elements::ALLOWED));
    }
    let mut names = mesh.point_sets.keys().chain(mesh.cell_sets.keys());
    if let Some(name) = names.find(|name| name.contains(|c: char| c == '"' || c.is_control())) {
        let rule = "names have neither quotes nor control characters";
        return Err(Unwritable::Name { format: FORMAT, name: name.clone(), rule });
    }
    Ok(())
}

/// Kind and formulation of cells, for messages.
fn in_words(block: &CellBlock) -> String {
    match block.formulation {
        Some(formulation) => format!("{:?}, {formulation}", block.kind),
        None => format!("{:?}", block.kind),
    }
}

/// Sets of cells on sides of elements: lines of plane elements, faces of solids.
struct Surfaces<'a> {
    /// Sides of each set in the order of its cells.
    sides: BTreeMap<String, Vec<Side>>,
    /// Whether each cell is such a side, which is not written as an element.
    is_side: Vec<bool>,
    /// Block of each cell.
    block_of: Vec<&'a CellBlock>,
}

impl<'a> Surfaces<'a> {
    fn of(mesh: &'a Mesh) -> Self {
        let cells: Vec<(CellKind, &[usize])> =
            mesh.cells.iter().flat_map(|block| block.iter().map(|nodes| (block.kind, nodes))).collect();
        let block_of: Vec<&CellBlock> =
            mesh.cells.iter().flat_map(|block| std::iter::repeat_n(block, block.len())).collect();
        let mut sides_by_nodes: BTreeMap<(CellKind, Vec<usize>), Side> = BTreeMap::new();
        for (number, &(kind, nodes)) in cells.iter().enumerate() {
            for (side, corners) in elements::sides(kind).iter().enumerate() {
                let (side_kind, own) = elements::side(kind, nodes, corners);
                sides_by_nodes.entry((side_kind, unturned(own, corners.len()))).or_insert((number, side));
            }
        }
        let mut sides = BTreeMap::new();
        let mut is_side = vec![false; cells.len()];
        for (name, lists) in &mesh.cell_sets {
            let on_sides = mesh.over_all(lists).map(|cell| {
                let (kind, nodes) = cells[cell];
                // Shells and the like are elements of their own, also on a face.
                let corners = corners_of_side(kind).filter(|_| block_of[cell].formulation.is_none())?;
                sides_by_nodes.get(&(kind, unturned(nodes.to_vec(), corners))).copied()
            });
            let found: Option<Vec<Side>> = on_sides.collect();
            if let Some(found) = found.filter(|found| !found.is_empty()) {
                mesh.over_all(lists).for_each(|cell| is_side[cell] = true);
                sides.insert(name.clone(), found);
            }
        }
        // A line in another set as well is written as an element.
        for (name, lists) in &mesh.cell_sets {
            if !sides.contains_key(name) {
                mesh.over_all(lists).for_each(|cell| is_side[cell] = false);
            }
        }
        Self { sides, is_side, block_of }
    }
}

/// Number of corners of cells that may be sides: lines, triangles and quadrilaterals without a node in the middle.
fn corners_of_side(kind: CellKind) -> Option<usize> {
    match kind {
        CellKind::Line | CellKind::Line3 => Some(2),
        CellKind::Triangle | CellKind::Triangle6 => Some(3),
        CellKind::Quad | CellKind::Quad8 => Some(4),
        _ => None,
    }
}

/// Nodes of a side in an order that does not depend on its direction: corners, then middles.
fn unturned(mut side: Vec<usize>, corners: usize) -> Vec<usize> {
    side[..corners].sort_unstable();
    side[corners..].sort_unstable();
    side
}

/// Writes a line; writing into memory does not fail.
fn line(text: &mut String, line: impl std::fmt::Display) {
    let _ = writeln!(text, "{line}");
}

/// Writes a keyword line that ends in a name of `mesh`, in quotes where case, blanks or signs matter.
fn keyword(text: &mut String, start: &str, name: &str, mesh: &Mesh) {
    let plain = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let mut others = mesh.point_sets.keys().chain(mesh.cell_sets.keys());
    let alone = others.all(|other| other == name || !other.eq_ignore_ascii_case(name));
    match plain && alone {
        true => line(text, format_args!("{start}{name}")),
        false => line(text, format_args!("{start}\"{name}\"")),
    }
}

/// Writes numbers, sixteen to a line.
fn list(text: &mut String, numbers: impl Iterator<Item = usize>) {
    let numbers: Vec<String> = numbers.map(|number| number.to_string()).collect();
    numbers.chunks(16).for_each(|chunk| line(text, chunk.join(", ")));
}

fn nodes(text: &mut String, mesh: &Mesh) {
    line(text, "*NODE");
    let plane = mesh.points.iter().all(|point| point[2].to_bits() == 0);
    for (number, [x, y, z]) in (1..).zip(&mesh.points) {
        match plane {
            true => line(text, format_args!("{number}, {x:?}, {y:?}")),
            false => line(text, format_args!("{number}, {x:?}, {y:?}, {z:?}")),
        }
    }
}

/// Writes the elements; returns the number of every cell.
fn write_elements(text: &mut String, mesh: &Mesh, surfaces: &Surfaces<'_>) -> Vec<Option<usize>> {
    let mut numbers = vec![None; surfaces.is_side.len()];
    let (mut cell, mut last) = (0, 0);
    for block in &mesh.cells {
        let own = cell..cell + block.len();
        cell = own.end;
        if !own.is_empty() && own.clone().all(|cell| surfaces.is_side[cell]) {
            continue;
        }
        let name = elements::name(block.kind, block.formulation).unwrap_or_default();
        line(text, format_args!("*ELEMENT, TYPE={name}"));
        for (cell, nodes) in own.zip(block.iter()).filter(|&(cell, _)| !surfaces.is_side[cell]) {
            last += 1;
            numbers[cell] = Some(last);
            let nodes = elements::reorder(block.kind, nodes);
            let nodes: Vec<String> = nodes.iter().map(|node| (node + 1).to_string()).collect();
            // At most sixteen numbers on a line.
            let lines: Vec<String> = nodes.chunks(15).map(|chunk| chunk.join(", ")).collect();
            line(text, format_args!("{last}, {}", lines.join(",\n")));
        }
    }
    numbers
}
