//! Reading of VTU files.

use std::collections::BTreeMap;

use super::array::{Decoder, ScalarType};
use super::document::{Array, VtuDocument};
use super::{ALLOWED, BLOCKS, FORMULATIONS, SET, TAG};
use crate::error::{FileFault, FileProblem};
use crate::numbering::{Allowance, CellList, OpenSets, close_cell_sets, close_point_sets};
use crate::tag_groups::{PHYSICAL, tag_groups};
use crate::{CellKind, DataArray, Formulation, Mesh, PhysicalTag, Values};

pub(crate) fn read(bytes: &[u8]) -> Result<Mesh, FileFault> {
    let document = VtuDocument::parse(bytes)?;
    let decoder = Decoder::new(&document)?;
    let mut allowance = Allowance::of(bytes.len());
    let Some(piece) = &document.piece else {
        return Err(FileFault::anywhere("VTKFile", FileProblem::Ended { expected: "`<Piece>`".into() }));
    };
    let [point_count, cell_count] = ["NumberOfPoints", "NumberOfCells"].map(|name| {
        let text = piece.get(name).map_or("", String::as_str);
        let parsed = text.trim().parse::<usize>();
        parsed.map_err(|_| FileFault::anywhere(format!("Piece {name}"), FileProblem::unexpected(text, "a number")))
    });
    let (point_count, cell_count) = (point_count?, cell_count?);
    let points = points(&decoder, &document, point_count, &mut allowance)?;
    let mut cells = cells(&decoder, &document, point_count, cell_count, &mut allowance)?;
    let mut field_data = BTreeMap::new();
    for array in &document.field_data {
        if array.name() == BLOCKS {
            divide(&mut cells, array, &decoder.values(array, None, &mut allowance)?)?;
        } else if let Some(name) = array.name().strip_prefix(TAG) {
            field_data.insert(name.to_owned(), physical_tag(array, &decoder.values(array, Some(2), &mut allowance)?)?);
        }
    }
    // After the blocks, which may follow in the file.
    for array in document.field_data.iter().filter(|array| array.name() == FORMULATIONS) {
        formulate(&mut cells, array, &decoder.values(array, None, &mut allowance)?)?;
    }
    let (point_data, point_sets) = data(&decoder, &document.point_data, point_count, &mut allowance)?;
    let (all_cell_data, cell_sets) = data(&decoder, &document.cell_data, cell_count, &mut allowance)?;
    let cell_sets =
        close_cell_sets(cell_sets, &cells, &mut allowance).map_err(|limit| FileFault::anywhere("CellData", limit))?;
    let mut cell_data = BTreeMap::new();
    for (name, array) in all_cell_data {
        allowance.take(cells.blocks.len()).map_err(|limit| FileFault::anywhere("CellData", limit))?;
        cell_data.insert(name, cells.split(&array));
    }
    let mut mesh = Mesh {
        points,
        cells: cells.blocks,
        point_data,
        cell_data,
        point_sets: close_point_sets(point_sets),
        cell_sets,
        field_data,
        left_out: Vec::new(),
    };
    for group in tag_groups(&mesh).into_iter().filter(|group| group.data == PHYSICAL) {
        let entries = group.lists.iter().map(Vec::len).sum::<usize>() + group.lists.len();
        allowance.take(entries).map_err(|limit| FileFault::anywhere("CellData", limit))?;
        mesh.field_data.extend(group.tag.map(|tag| (group.name.clone(), tag)));
        mesh.cell_sets.insert(group.name, group.lists);
    }
    Ok(mesh)
}

fn points(
    decoder: &Decoder,
    document: &VtuDocument,
    count: usize,
    allowance: &mut Allowance,
) -> Result<Vec<[f64; 3]>, FileFault> {
    let Some(array) = document.points.first() else {
        return match count {
            0 => Ok(Vec::new()),
            _ => Err(FileFault::anywhere("Points", FileProblem::Ended { expected: "a `DataArray`".into() })),
        };
    };
    let components = array.components()?;
    if components != 3 {
        return Err(array.fault(FileProblem::unexpected(&components.to_string(), "three components")));
    }
    let reals = match decoder.values(array, Some(count.saturating_mul(3)), allowance)? {
        Values::Reals(values) => values,
        Values::Integers(values) => values.into_iter().map(|value| value as f64).collect(),
    };
    if let Some(wrong) = reals.iter().find(|x| !x.is_finite()) {
        return Err(array.fault(FileProblem::unexpected(&wrong.to_string(), "coordinates that are finite")));
    }
    Ok(reals.as_chunks::<3>().0.to_vec())
}

fn cells(
    decoder: &Decoder,
    document: &VtuDocument,
    points: usize,
    count: usize,
    allowance: &mut Allowance,
) -> Result<CellList, FileFault> {
    let mut cells = CellList::default();
    if count == 0 {
        return Ok(cells);
    }
    let [types, offsets, connectivity] = ["types", "offsets", "connectivity"].map(|name| {
        let found = document.cells.iter().find(|array| array.name() == name);
        found.ok_or_else(|| {
            FileFault::anywhere("Cells", FileProblem::Ended { expected: format!("a `DataArray` {name:?}") })
        })
    });
    let (types, offsets, connectivity) = (types?, offsets?, connectivity?);
    let type_numbers = integers(decoder, types, Some(count), allowance)?;
    let ends = integers(decoder, offsets, Some(count), allowance)?;
    let total = ends.last().and_then(|&end| usize::try_from(end).ok()).unwrap_or(0);
    let nodes = integers(decoder, connectivity, Some(total), allowance)?;
    let mut start = 0;
    for (&number, &end) in type_numbers.iter().zip(&ends) {
        let Some(kind) = cell_kind(number) else {
            let what = format!("cell type {number}");
            return Err(types.fault(FileProblem::Unsupported { what, allowed: ALLOWED.into() }));
        };
        let own = usize::try_from(end).ok().and_then(|end| nodes.get(start..end));
        let Some(own) = own.filter(|own| own.len() == kind.node_count()) else {
            let expected =
                format!("{}: a cell of type {number} has {} nodes", start + kind.node_count(), kind.node_count());
            return Err(offsets.fault(FileProblem::unexpected(&end.to_string(), expected)));
        };
        start += own.len();
        let mut numbers = Vec::with_capacity(own.len());
        for &node in own {
            match usize::try_from(node).ok().filter(|&node| node < points) {
                Some(node) => numbers.push(node),
                None => {
                    let expected = format!("a node from 0 to {}", points as i64 - 1);
                    return Err(connectivity.fault(FileProblem::unexpected(&node.to_string(), expected)));
                }
            }
        }
        cells.push(kind, numbers);
    }
    Ok(cells)
}

fn cell_kind(number: i64) -> Option<CellKind> {
    CellKind::ALL.into_iter().find(|kind| *kind as i64 == number)
}

fn integers(
    decoder: &Decoder,
    array: &Array,
    count: Option<usize>,
    allowance: &mut Allowance,
) -> Result<Vec<i64>, FileFault> {
    match decoder.values(array, count, allowance)? {
        Values::Integers(values) => Ok(values),
        Values::Reals(_) => Err(array.fault(FileProblem::unexpected("floating-point numbers", "integers"))),
    }
}

/// Data and sets by name.
fn data(
    decoder: &Decoder,
    arrays: &[Array],
    owners: usize,
    allowance: &mut Allowance,
) -> Result<(BTreeMap<String, DataArray>, OpenSets), FileFault> {
    let (mut data, mut sets) = (BTreeMap::new(), OpenSets::new());
    for array in arrays {
        let components = array.components()?;
        let values = decoder.values(array, Some(owners.saturating_mul(components)), allowance)?;
        let set = array.name().strip_prefix(SET).filter(|_| array.scalar() == Ok(ScalarType::BYTE) && components == 1);
        match (set, values) {
            (Some(name), Values::Integers(values)) if values.iter().all(|value| (0..=1).contains(value)) => {
                let members = (0..owners).zip(values).filter(|&(_, value)| value == 1).map(|(owner, _)| owner);
                sets.insert(name.to_owned(), members.collect());
            }
            (_, values) => {
                data.insert(array.name().to_owned(), DataArray { components, values });
            }
        }
    }
    Ok((data, sets))
}

fn physical_tag(array: &Array, values: &Values) -> Result<PhysicalTag, FileFault> {
    let found = match values {
        Values::Integers(values) => values.as_slice(),
        Values::Reals(_) => &[],
    };
    match *found {
        [tag, dimension @ 0..=3] => Ok(PhysicalTag { tag, dimension: dimension as u8 }),
        _ => Err(array.fault(FileProblem::unexpected(&format!("{values:?}"), "tag and dimension, two integers"))),
    }
}

fn divide(cells: &mut CellList, array: &Array, values: &Values) -> Result<(), FileFault> {
    let pairs = match values {
        Values::Integers(values) => values.as_chunks::<2>().0,
        Values::Reals(_) => &[],
    };
    let blocks = pairs.iter().map(|&[number, length]| Some((cell_kind(number)?, usize::try_from(length).ok()?)));
    if blocks.collect::<Option<Vec<_>>>().is_some_and(|blocks| cells.divide(&blocks)) {
        return Ok(());
    }
    Err(array.fault(FileProblem::unexpected("blocks", "types and numbers of the file's cells in their order")))
}

fn formulate(cells: &mut CellList, array: &Array, values: &Values) -> Result<(), FileFault> {
    let numbers = match values {
        Values::Integers(values) if values.len() == cells.blocks.len() => values.as_slice(),
        _ => return Err(array.fault(FileProblem::unexpected("formulations", "an integer for each block of cells"))),
    };
    for (block, &number) in cells.blocks.iter_mut().zip(numbers) {
        block.formulation = Formulation::numbered(number);
    }
    Ok(())
}
