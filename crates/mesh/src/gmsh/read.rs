//! Reading of Gmsh files.

use std::collections::{BTreeMap, BTreeSet};

use super::GmshVersion;
use super::cell_types;
use super::content::{GmshContent, RawData};
use super::keep;
use super::scanner::{Encoding, Scanner};
use crate::error::{FileFault, FileProblem};
use crate::numbering::{CellList, Numbering};
use crate::{CellKind, Mesh};

pub(crate) fn read(bytes: &[u8]) -> Result<Mesh, FileFault> {
    let mut file = Scanner::new(bytes);
    let mut content = GmshContent::default();
    let mut version = None;
    while let Some(section) = file.next_section()? {
        match (section.as_str(), version) {
            ("MeshFormat", _) => version = Some(mesh_format(&mut file)?),
            ("PhysicalNames", Some(_)) => physical_names(&mut file, &mut content)?,
            ("Entities", Some(GmshVersion::V4)) => entities(&mut file, &mut content)?,
            ("Nodes" | "ParametricNodes", Some(GmshVersion::V2)) => {
                nodes_2(&mut file, &mut content, section == "ParametricNodes")?;
            }
            ("Nodes", Some(GmshVersion::V4)) => nodes_4(&mut file, &mut content)?,
            ("Elements", Some(GmshVersion::V2)) => elements_2(&mut file, &mut content)?,
            ("Elements", Some(GmshVersion::V4)) => elements_4(&mut file, &mut content)?,
            ("NodeData", Some(_)) => {
                let (name, data) =
                    data(&mut file, content.points.len(), content.nodes.as_ref(), FileProblem::no_such_node)?;
                content.node_data.insert(name, data);
            }
            ("ElementData", Some(_)) => {
                let (name, data) =
                    data(&mut file, content.cells.len(), content.elements.as_ref(), FileProblem::no_such_element)?;
                content.element_data.insert(name, data);
            }
            (keep::SECTION, Some(_)) => kept(&mut file, &mut content)?,
            ("PartitionedEntities", _) => {
                let what = "a mesh divided into partitions".into();
                return Err(file.fault(FileProblem::Unsupported { what, allowed: "a mesh saved as a whole".into() }));
            }
            ("Nodes" | "Elements", None) => {
                return Err(file.fault(FileProblem::unexpected(&section, "`$MeshFormat` first")));
            }
            _ => {
                file.skip_section()?;
                continue;
            }
        }
        file.end_section()?;
    }
    if version.is_none() {
        return Err(FileFault::anywhere("", FileProblem::Ended { expected: "`$MeshFormat`".into() }));
    }
    if content.nodes.is_none() {
        return Err(FileFault::anywhere("", FileProblem::Ended { expected: "`$Nodes`".into() }));
    }
    content.into_mesh(file.allowance)
}

/// Reads version (2.0 to 2.2 alike), encoding and size of numbers.
fn mesh_format(file: &mut Scanner) -> Result<GmshVersion, FileFault> {
    const EXPECTED: &str = "version (2.2 or 4.1), file type (0 or 1) and data size (4 or 8)";
    file.encoding = Encoding::Ascii;
    let line = file.line(EXPECTED)?;
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    let (version, size_bytes) = match words[..] {
        ["2" | "2.0" | "2.1" | "2.2", _, "8"] => (GmshVersion::V2, 8),
        ["4.1", _, "8"] => (GmshVersion::V4, 8),
        ["4.1", _, "4"] => (GmshVersion::V4, 4),
        [other, _, _] if other.parse::<f64>().is_ok() && !["2", "2.0", "2.1", "2.2", "4.1"].contains(&other) => {
            let what = format!("version {other} of the format");
            return Err(file.fault(FileProblem::Unsupported { what, allowed: "2.2 and 4.1".into() }));
        }
        _ => return Err(file.fault(FileProblem::unexpected(line, EXPECTED))),
    };
    match words[1] {
        "0" => {}
        "1" => {
            file.encoding = Encoding::Binary { big_endian: false, size_bytes };
            match file.int("the number 1, to tell the order of bytes")? {
                1 => {}
                0x0100_0000 => file.encoding = Encoding::Binary { big_endian: true, size_bytes },
                other => return Err(file.fault(FileProblem::unexpected(&other.to_string(), "the number 1"))),
            }
        }
        _ => return Err(file.fault(FileProblem::unexpected(line, EXPECTED))),
    }
    Ok(version)
}

/// Reads lines `dimension tag "name"`.
fn physical_names(file: &mut Scanner, content: &mut GmshContent) -> Result<(), FileFault> {
    const EXPECTED: &str = "dimension, tag and name in quotes, `1 7 \"base\"` for example";
    let count = file.number_line("the number of names")?;
    for _ in 0..file.count("names", count, [0, 0, 0])? {
        let line = file.line(EXPECTED)?;
        let parsed = line.split_once(char::is_whitespace).and_then(|(dimension, rest)| {
            let (tag, name) = rest.trim_start().split_once(char::is_whitespace)?;
            let name = name.trim_start().strip_prefix('"')?.strip_suffix('"')?;
            let dimension = dimension.parse::<u8>().ok().filter(|&dimension| dimension <= 3)?;
            Some(((dimension, tag.parse::<i64>().ok()?), name.to_owned()))
        });
        match parsed {
            Some(name) => content.names.push(name),
            None => return Err(file.fault(FileProblem::unexpected(line, EXPECTED))),
        }
    }
    Ok(())
}

/// Reads the groups of the entities of version 4.1; boxes and boundaries are skipped.
fn entities(file: &mut Scanner, content: &mut GmshContent) -> Result<(), FileFault> {
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = file.size("a number of entities")?;
    }
    for (dimension, count) in (0..).zip(counts) {
        let corners = if dimension == 0 { 3 } else { 6 };
        for _ in 0..file.count("entities", count, [1, 1, corners])? {
            let tag = file.int("the tag of an entity")?;
            for _ in 0..corners {
                file.real("a corner of the box of an entity")?;
            }
            let groups = file.size("the number of groups")?;
            let groups = file.count("groups", groups, [0, 1, 0])?;
            // A negative tag means reversed orientation of the entity in its group.
            let groups =
                (0..groups).map(|_| Ok(file.int("the tag of a group")?.abs())).collect::<Result<_, FileFault>>()?;
            content.entities.insert((dimension, tag), groups);
            if dimension > 0 {
                let bounds = file.size("the number of bounding entities")?;
                for _ in 0..file.count("bounding entities", bounds, [0, 1, 0])? {
                    file.int("the tag of a bounding entity")?;
                }
            }
        }
    }
    Ok(())
}

/// Reads the nodes of version 2: number and coordinates, with dimension, entity and parameters if `parametric`.
fn nodes_2(file: &mut Scanner, content: &mut GmshContent, parametric: bool) -> Result<(), FileFault> {
    let count = file.number_line("the number of nodes")?;
    let count = file.count("nodes", count, [0, 1, 3])?;
    let mut numbers = Vec::with_capacity(count);
    for _ in 0..count {
        numbers.push(file.positive_int("the number of a node")?);
        content.points.push(file.point()?);
        if parametric {
            let dimension = file.int("the dimension of an entity")?;
            file.int("the tag of an entity")?;
            // One parameter on a curve, two on a surface.
            for _ in 0..if (1..=2).contains(&dimension) { dimension } else { 0 } {
                file.real("a parameter")?;
            }
        }
    }
    number_nodes(file, content, numbers)
}

/// Reads the nodes of version 4.1 by entity, first numbers, then coordinates.
fn nodes_4(file: &mut Scanner, content: &mut GmshContent) -> Result<(), FileFault> {
    let blocks = file.size("the number of blocks")?;
    let announced = file.size("the number of nodes")?;
    file.size("the least number of a node")?;
    file.size("the greatest number of a node")?;
    let mut numbers = Vec::new();
    for _ in 0..file.count("blocks of nodes", blocks, [1, 3, 0])? {
        let dimension = file.positive_int("the dimension of an entity, 0 to 3")?.min(3);
        file.int("the tag of an entity")?;
        let parametric = file.int("whether nodes have parameters, 0 or 1")?;
        let parameters = if parametric == 0 { 0 } else { dimension };
        let count = file.size("the number of nodes in the block")?;
        let count = file.count("nodes in the block", count, [1, 0, 3 + parameters])?;
        for _ in 0..count {
            numbers.push(file.size("the number of a node")?);
        }
        for _ in 0..count {
            content.points.push(file.point()?);
            for _ in 0..parameters {
                file.real("a parameter")?;
            }
        }
    }
    check_total(file, "nodes", announced, numbers.len())?;
    number_nodes(file, content, numbers)
}

fn number_nodes(file: &Scanner, content: &mut GmshContent, numbers: Vec<u64>) -> Result<(), FileFault> {
    if content.nodes.is_some() {
        return Err(file.fault(FileProblem::unexpected("a second section of nodes", "one")));
    }
    let pairs = numbers.into_iter().zip(0..).collect();
    content.nodes = Some(Numbering::new(pairs, "node").map_err(|problem| file.fault(problem))?);
    Ok(())
}

fn check_total(file: &Scanner, what: &str, announced: u64, found: usize) -> Result<(), FileFault> {
    if announced == found as u64 {
        return Ok(());
    }
    Err(file.fault(FileProblem::unexpected(&format!("{found} {what}"), format!("{announced}, as announced"))))
}

/// Reads the nodes of a cell into `nodes`, as indices in the order of the mesh.
fn cell_nodes(
    file: &mut Scanner,
    content: &GmshContent,
    kind: CellKind,
    nodes: &mut Vec<usize>,
    mut number: impl FnMut(&mut Scanner) -> Result<u64, FileFault>,
) -> Result<(), FileFault> {
    nodes.clear();
    for _ in 0..kind.node_count() {
        let number = number(file)?;
        match content.nodes.as_ref().and_then(|numbering| numbering.index(number)) {
            Some(node) => nodes.push(node),
            None => return Err(file.fault(FileProblem::NoSuchNode { number })),
        }
    }
    cell_types::from_gmsh(kind, nodes, &mut Vec::new());
    Ok(())
}

fn cell_kind(file: &mut Scanner) -> Result<CellKind, FileFault> {
    let number = file.int("the type of an element")?;
    cell_types::kind(number).ok_or_else(|| {
        let what = format!("element type {number}");
        file.fault(FileProblem::Unsupported { what, allowed: cell_types::ALLOWED.into() })
    })
}

/// Entity, kind and nodes, which identify a cell of version 2.
type CellIdentity = (i64, CellKind, Vec<usize>);

/// Cells of version 2, which are written once for each of their groups.
#[derive(Default)]
struct Copies {
    /// Originals of the last elements, from the section `$Gearwear`.
    kept: Option<Vec<usize>>,
    /// Number of elements before these.
    first: usize,
    originals: BTreeMap<CellIdentity, usize>,
    /// Cells with their groups.
    joined: BTreeSet<(usize, i64)>,
}

impl Copies {
    /// Cell of element `number` in a `group`, which is added unless the element is a copy.
    fn cell(
        &mut self,
        cells: &mut CellList,
        number: usize,
        identity: CellIdentity,
        group: i64,
    ) -> Result<usize, FileProblem> {
        let (kind, nodes) = (identity.1, identity.2.as_slice());
        let cell = match &self.kept {
            Some(kept) if number >= self.first => {
                let wanted = || FileProblem::unexpected("an element more", "as many as announced");
                let original = *kept.get(number - self.first).ok_or_else(wanted)?;
                if original >= cells.len() || (cells.cell(original).0.kind, cells.cell(original).1) != (kind, nodes) {
                    return Err(FileProblem::unexpected("a new element", "a copy, as `$Gearwear` says"));
                }
                original
            }
            None if group != 0 => {
                // The same cell in the same group twice is two cells.
                let known = self.originals.get(&identity).copied();
                match known.filter(|&cell| !self.joined.contains(&(cell, group))) {
                    Some(cell) => cell,
                    None => {
                        let cell = cells.push(kind, nodes.iter().copied());
                        self.originals.insert(identity, cell);
                        cell
                    }
                }
            }
            _ => cells.push(kind, nodes.iter().copied()),
        };
        if group != 0 {
            self.joined.insert((cell, group));
        }
        Ok(cell)
    }
}

/// Physical group and entity of an element of version 2, the first two of its `tags`.
fn group_and_entity(file: &mut Scanner, tags: u64) -> Result<(i64, i64), FileFault> {
    let (mut group, mut entity) = (0, 0);
    for tag in 0..file.count("tags", tags, [0, 1, 0])? {
        let value = file.int("a tag")?;
        match tag {
            0 => group = value.abs(),
            1 => entity = value,
            _ => {}
        }
    }
    Ok((group, entity))
}

/// Reads the elements of version 2.
fn elements_2(file: &mut Scanner, content: &mut GmshContent) -> Result<(), FileFault> {
    if content.elements.is_some() {
        return Err(file.fault(FileProblem::unexpected("a second section of elements", "one")));
    }
    let total = file.number_line("the number of elements")?;
    let total = file.count("elements", total, [0, 3, 0])?;
    let kept = content.keep.copies.take();
    let first = total.saturating_sub(kept.as_ref().map_or(0, Vec::len));
    let mut copies = Copies { kept, first, ..Copies::default() };
    let mut numbers = Vec::new();
    let mut nodes = Vec::new();
    while numbers.len() < total {
        let header = match file.encoding {
            Encoding::Ascii => None,
            Encoding::Binary { .. } => {
                let kind = cell_kind(file)?;
                let count = file.positive_int("the number of elements of this type that follow")?;
                let tags = file.positive_int("the number of tags")?;
                Some((kind, file.count("elements that follow", count, [0, 2, 0])?, tags))
            }
        };
        for _ in 0..header.map_or(1, |(_, count, _)| count) {
            let number = file.positive_int("the number of an element")?;
            let (kind, tags) = match header {
                Some((kind, _, tags)) => (kind, tags),
                None => (cell_kind(file)?, file.positive_int("the number of tags")?),
            };
            let (group, entity) = group_and_entity(file, tags)?;
            cell_nodes(file, content, kind, &mut nodes, |file| file.positive_int("the number of a node"))?;
            let cell = copies
                .cell(&mut content.cells, numbers.len(), (entity, kind, nodes.clone()), group)
                .map_err(|problem| file.fault(problem))?;
            if group != 0 {
                file.allow(1)?;
                content.groups.entry((kind.dimension(), group)).or_default().push(cell);
            }
            numbers.push((number, cell));
        }
    }
    check_total(file, "elements", total as u64, numbers.len())?;
    content.elements = Some(Numbering::new(numbers, "element").map_err(|problem| file.fault(problem))?);
    Ok(())
}

/// Reads the elements of version 4.1 by entity.
fn elements_4(file: &mut Scanner, content: &mut GmshContent) -> Result<(), FileFault> {
    if content.elements.is_some() {
        return Err(file.fault(FileProblem::unexpected("a second section of elements", "one")));
    }
    let blocks = file.size("the number of blocks")?;
    let announced = file.size("the number of elements")?;
    file.size("the least number of an element")?;
    file.size("the greatest number of an element")?;
    let mut numbers = Vec::new();
    let mut nodes = Vec::new();
    for _ in 0..file.count("blocks of elements", blocks, [1, 3, 0])? {
        let dimension = file.int("the dimension of an entity")?;
        let entity = file.int("the tag of an entity")?;
        let kind = cell_kind(file)?;
        let count = file.size("the number of elements in the block")?;
        let count = file.count("elements in the block", count, [1 + kind.node_count() as u64, 0, 0])?;
        let first = content.cells.len();
        for _ in 0..count {
            let number = file.size("the number of an element")?;
            cell_nodes(file, content, kind, &mut nodes, |file| file.size("the number of a node"))?;
            numbers.push((number, content.cells.push(kind, nodes.iter().copied())));
        }
        for &group in content.entities.get(&(dimension, entity)).into_iter().flatten() {
            file.allow(count)?;
            content.groups.entry((kind.dimension(), group)).or_default().extend(first..first + count);
        }
    }
    check_total(file, "elements", announced, numbers.len())?;
    content.elements = Some(Numbering::new(numbers, "element").map_err(|problem| file.fault(problem))?);
    Ok(())
}

/// Reads a data section: lines of tags, then the number and the values of each owner.
fn data(
    file: &mut Scanner,
    owners: usize,
    numbers: Option<&Numbering>,
    missing: fn(u64) -> FileProblem,
) -> Result<(String, RawData), FileFault> {
    let mut tags = [Vec::new(), Vec::new(), Vec::new()];
    for (what, tags) in ["string tags", "real tags", "integer tags"].into_iter().zip(&mut tags) {
        let count = file.number_line("a number of tags")?;
        for _ in 0..file.count(what, count, [0, 0, 0])? {
            tags.push(file.line("a tag")?);
        }
    }
    let [names, _, integers] = tags;
    let Some(name) = names.first().map(|name| name.trim_matches('"').to_owned()) else {
        return Err(file.fault(FileProblem::unexpected("no string tag", "the name of the data")));
    };
    let [components, count] = [1, 2].map(|at| integers.get(at).and_then(|text| text.parse::<u64>().ok()));
    let (Some(components @ 1..=9), Some(count)) = (components, count) else {
        let expected = "integer tags: time step, number of components (1 to 9), number of values";
        return Err(file.fault(FileProblem::unexpected(&integers.join(" "), expected)));
    };
    let count = file.count("values", count, [0, 1, components])?;
    let components = components as usize;
    file.allow(owners.saturating_mul(components))?;
    let mut values = vec![f64::NAN; owners * components];
    for _ in 0..count {
        let number = file.positive_int("the number of a node or element")?;
        let owner = numbers.and_then(|all| all.index(number)).ok_or_else(|| file.fault(missing(number)))?;
        for value in &mut values[owner * components..(owner + 1) * components] {
            *value = file.real("a value")?;
        }
    }
    Ok((name, RawData { components, values }))
}

fn kept(file: &mut Scanner, content: &mut GmshContent) -> Result<(), FileFault> {
    let line = file.line("one line of JSON")?;
    content.keep = serde_json::from_str(line)
        .map_err(|error| file.fault(FileProblem::unexpected(&error.to_string(), "what gearwear writes here")))?;
    Ok(())
}
