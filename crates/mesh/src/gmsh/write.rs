//! Writing of Gmsh files.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::keep::{self, DataForm, Keep};
use super::output::GmshOutput;
use super::write_cells::{Entities, PhysicalGroup, write_elements_2, write_elements_4, write_entities};
use super::{GmshEncoding, GmshStyle, GmshVersion};
use crate::error::Unwritable;
use crate::{DataArray, Mesh, PhysicalTag, Values};

/// Largest integer up to which all have an exact `double`, the type of data in Gmsh.
pub(super) const LARGEST_INTEGER: i64 = 1 << 53;

const FORMAT: &str = "a Gmsh file";

pub(crate) fn write(mesh: &Mesh, style: GmshStyle) -> Result<Vec<u8>, Unwritable> {
    check(mesh)?;
    let groups = groups(mesh);
    let entities = Entities::new(mesh, &groups);
    let mut out = GmshOutput::new(style.encoding);
    mesh_format(&mut out, style);
    if !groups.is_empty() {
        out.line("$PhysicalNames");
        out.line(groups.len());
        for group in &groups {
            out.line(format_args!("{} {} \"{}\"", group.tag.dimension, group.tag.tag, group.name));
        }
        out.line("$EndPhysicalNames");
    }
    let keep = kept(mesh, style.version, &entities);
    if keep != Keep::default() {
        let json = serde_json::to_string(&keep).expect("numbers, lists and maps keyed by strings always serialise");
        out.line(format_args!("${}\n{json}\n$End{}", keep::SECTION, keep::SECTION));
    }
    match style.version {
        GmshVersion::V2 => {
            nodes_2(&mut out, mesh);
            write_elements_2(&mut out, mesh, &groups, &entities);
        }
        GmshVersion::V4 => {
            write_entities(&mut out, mesh, &groups, &entities);
            nodes_4(&mut out, mesh, &entities);
            write_elements_4(&mut out, mesh, &entities);
        }
    }
    for (name, array) in &mesh.point_data {
        data(&mut out, "NodeData", name, array.components, std::slice::from_ref(array));
    }
    for (name, arrays) in &mesh.cell_data {
        data(&mut out, "ElementData", name, arrays.first().map_or(1, |array| array.components), arrays);
    }
    Ok(out.bytes)
}

/// Checks that the format can represent the mesh.
fn check(mesh: &Mesh) -> Result<(), Unwritable> {
    let cells: usize = mesh.cells.iter().map(|block| block.len()).sum();
    for (what, count) in [("number of nodes", mesh.points.len()), ("number of cells", cells)] {
        // Every further group of a cell may need a copy of it.
        let sets = mesh.cell_sets.len().max(1);
        if count.checked_mul(sets).is_none_or(|count| count >= i32::MAX as usize) {
            return Err(Unwritable::data(FORMAT, what, &count.to_string(), "numbers are ints of four bytes"));
        }
    }
    let named_data = mesh.point_data.keys().chain(mesh.cell_data.keys());
    for name in named_data.chain(mesh.cell_sets.keys()).chain(mesh.field_data.keys()) {
        if name.contains(|c: char| c == '"' || c.is_control()) {
            let rule = "names have neither quotes nor line breaks nor other control characters";
            return Err(Unwritable::Name { format: FORMAT, name: name.clone(), rule });
        }
    }
    for (name, tag) in &mesh.field_data {
        if !(1..=i64::from(i32::MAX)).contains(&tag.tag) {
            return Err(Unwritable::data(FORMAT, "tag of", name, "tags are from 1 to 2147483647"));
        }
    }
    let cell_arrays = mesh.cell_data.iter().flat_map(|(name, arrays)| arrays.iter().map(move |array| (name, array)));
    for (name, array) in mesh.point_data.iter().chain(cell_arrays) {
        if array.components > 9 {
            return Err(Unwritable::data(FORMAT, "data", name, "at most nine components"));
        }
        if let Values::Integers(values) = &array.values
            && values.iter().any(|value| value.unsigned_abs() > LARGEST_INTEGER.unsigned_abs())
        {
            let rule = "data are doubles, which hold integers up to 2^53";
            return Err(Unwritable::data(FORMAT, "integer data", name, rule));
        }
    }
    Ok(())
}

/// Physical groups: for each set the group with its tag, then groups for its cells of other dimensions.
fn groups(mesh: &Mesh) -> Vec<PhysicalGroup<'_>> {
    let mut taken: BTreeMap<(u8, i64), ()> =
        mesh.field_data.values().map(|tag| ((tag.dimension, tag.tag), ())).collect();
    let mut groups = Vec::new();
    let names = mesh.cell_sets.keys().chain(mesh.field_data.keys().filter(|&name| !mesh.cell_sets.contains_key(name)));
    for name in names {
        let own = mesh.field_data.get(name).copied();
        groups.extend(own.map(|tag| PhysicalGroup { name, tag }));
        let mut dimensions: Vec<u8> = mesh.cell_sets.get(name).map_or_else(Vec::new, |lists| {
            let filled = lists.iter().zip(&mesh.cells).filter(|(list, _)| !list.is_empty());
            filled.map(|(_, block)| block.kind.dimension()).collect()
        });
        dimensions.sort_unstable();
        dimensions.dedup();
        if dimensions.is_empty() && own.is_none() {
            dimensions.push(2);
        }
        for dimension in dimensions {
            if own.is_some_and(|own| own.dimension == dimension) {
                continue;
            }
            let first_free = (1..).find(|&tag| !taken.contains_key(&(dimension, tag))).unwrap_or(1);
            let tag =
                own.map(|own| own.tag).filter(|&tag| !taken.contains_key(&(dimension, tag))).unwrap_or(first_free);
            taken.insert((dimension, tag), ());
            groups.push(PhysicalGroup { name, tag: PhysicalTag { tag, dimension } });
        }
    }
    groups
}

/// Parts of the mesh that Gmsh has no place for.
fn kept(mesh: &Mesh, version: GmshVersion, entities: &Entities) -> Keep {
    let blocks: Vec<_> = mesh.cells.iter().map(|block| (block.kind, block.len())).collect();
    let formulations = mesh.cells.iter().enumerate().filter_map(|(block, own)| Some((block, own.formulation?)));
    let runs = blocks.windows(2).all(|pair| pair[0].0 != pair[1].0) && blocks.iter().all(|&(_, length)| length > 0);
    let copies = entities.copies();
    Keep {
        blocks: (!runs).then_some(blocks),
        formulations: formulations.collect(),
        point_sets: mesh.point_sets.clone(),
        untagged: mesh.cell_sets.keys().filter(|&name| !mesh.field_data.contains_key(name)).cloned().collect(),
        point_data: mesh.point_data.iter().filter_map(|(name, array)| Some((name.clone(), form(array)?))).collect(),
        cell_data: (mesh.cell_data.iter())
            .filter_map(|(name, arrays)| Some((name.clone(), form(arrays.first()?)?)))
            .collect(),
        copies: (version == GmshVersion::V2 && !copies.is_empty()).then_some(copies),
    }
}

/// Form of data other than real numbers of 1, 3 or 9 components.
fn form(array: &DataArray) -> Option<DataForm> {
    let form = DataForm { components: array.components, integers: matches!(array.values, Values::Integers(_)) };
    (form.integers || form.components != filled_up(form.components)).then_some(form)
}

fn mesh_format(out: &mut GmshOutput, style: GmshStyle) {
    let version = match style.version {
        GmshVersion::V2 => "2.2",
        GmshVersion::V4 => "4.1",
    };
    out.line("$MeshFormat");
    out.line(format_args!("{version} {} 8", u8::from(style.encoding == GmshEncoding::Binary)));
    if out.binary {
        out.int(1);
    }
    out.end_section("MeshFormat");
}

fn nodes_2(out: &mut GmshOutput, mesh: &Mesh) {
    out.line("$Nodes");
    out.line(mesh.points.len());
    for (number, point) in (1..).zip(&mesh.points) {
        out.int(number);
        point.iter().for_each(|&x| out.real(x));
        out.end_line();
    }
    out.end_section("Nodes");
}

/// Writes all nodes in one block, in their order, on an entity of the highest dimension.
fn nodes_4(out: &mut GmshOutput, mesh: &Mesh, entities: &Entities) {
    let count = mesh.points.len();
    out.line("$Nodes");
    for value in [usize::from(count > 0), count, usize::from(count > 0), count] {
        out.size(value);
    }
    out.end_line();
    if count > 0 {
        for value in [i64::from(entities.highest_dimension()), 1, 0] {
            out.int(value);
        }
        out.size(count);
        out.end_line();
        for number in 1..=count {
            out.size(number);
            out.end_line();
        }
        for point in &mesh.points {
            point.iter().for_each(|&x| out.real(x));
            out.end_line();
        }
    }
    out.end_section("Nodes");
}

/// Number of components of the smallest Gmsh type: scalar, vector or tensor.
fn filled_up(components: usize) -> usize {
    match components {
        0 | 1 => 1,
        2 | 3 => 3,
        _ => 9,
    }
}

fn data(out: &mut GmshOutput, section: &str, name: &str, components: usize, arrays: &[DataArray]) {
    let count: usize = arrays.iter().map(|array| array.value_count() / components).sum();
    let written = filled_up(components);
    out.line(format_args!("${section}\n1\n\"{name}\"\n1\n0.0\n3\n0\n{written}\n{count}"));
    let mut owners = 1..;
    for array in arrays {
        let reals = match &array.values {
            Values::Integers(values) => Cow::Owned(values.iter().map(|&value| value as f64).collect()),
            Values::Reals(values) => Cow::Borrowed(values),
        };
        for (values, owner) in reals.chunks(components).zip(&mut owners) {
            out.int(owner);
            values.iter().copied().chain(std::iter::repeat(0.0)).take(written).for_each(|value| out.real(value));
            out.end_line();
        }
    }
    out.end_section(section);
}
