//! Reading of Abaqus files.

use std::collections::BTreeMap;

use super::elements;
use super::keywords::{Keyword, Name, keywords, split};
use super::sets::{Sets, Targets, members, refer};
use crate::error::{FileFault, FilePosition, FileProblem};
use crate::numbering::{Allowance, CellList, Numbering, close_cell_sets, close_point_sets};
use crate::{CellKind, Mesh};

/// Keywords that include or generate nodes or elements, without which part of the mesh would be missing.
const REFUSED: [&str; 12] = [
    "INCLUDE",
    "NGEN",
    "NFILL",
    "NCOPY",
    "NMAP",
    "ELGEN",
    "ELCOPY",
    "SYSTEM",
    "SUBMODEL",
    "IMPORT",
    "SUPER ELEMENT",
    "SYMMETRIC MODEL GENERATION",
];

/// Kind and nodes of a line on a side of an element.
type Line = (CellKind, Vec<usize>);

#[derive(Debug, Default)]
struct AbaqusContent {
    points: Vec<[f64; 3]>,
    node_numbers: Vec<(u64, usize)>,
    cells: CellList,
    element_numbers: Vec<(u64, usize)>,
    nodes: Numbering,
    elements: Numbering,
    node_sets: Sets,
    element_sets: Sets,
    /// Lines of each surface.
    surfaces: Vec<(Name, Vec<Line>)>,
    instance: Option<String>,
}

pub(crate) fn read(bytes: &[u8]) -> Result<Mesh, FileFault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        let problem = FileProblem::unexpected("other bytes", "text in UTF-8");
        FileFault { place: Some(FilePosition::Line(line)), section: String::new(), problem }
    })?;
    let keywords = keywords(text)?;
    let mut allowance = Allowance::of(bytes.len());
    let mut content = AbaqusContent::default();
    content.check_parts(&keywords)?;
    // Sets and surfaces may come before the elements they refer to, so that nodes are read first, then elements, then these.
    for keyword in &keywords {
        if keyword.name == "NODE" {
            content.read_nodes(keyword)?;
        } else if REFUSED.contains(&keyword.name.as_str()) {
            return Err(keyword.unsupported(format!("*{}", keyword.name), "*NODE and *ELEMENT with all their lines"));
        }
    }
    content.nodes = Numbering::new(std::mem::take(&mut content.node_numbers), "node")
        .map_err(|problem| FileFault::anywhere("*NODE", problem))?;
    for keyword in keywords.iter().filter(|keyword| keyword.name == "ELEMENT") {
        content.read_elements(keyword)?;
    }
    content.elements = Numbering::new(std::mem::take(&mut content.element_numbers), "element")
        .map_err(|problem| FileFault::anywhere("*ELEMENT", problem))?;
    for keyword in &keywords {
        match keyword.name.as_str() {
            "NSET" => content.read_node_set(keyword, &mut allowance)?,
            "ELSET" => content.read_element_set(keyword, &mut allowance)?,
            "SURFACE" => content.read_surface(keyword, &mut allowance)?,
            _ => {}
        }
    }
    content.into_mesh(&mut allowance)
}

impl AbaqusContent {
    /// Refuses more than one part and more than one untransformed instance.
    fn check_parts(&mut self, keywords: &[Keyword]) -> Result<(), FileFault> {
        let mut part = false;
        for keyword in keywords {
            match keyword.name.as_str() {
                "PART" if part => return Err(keyword.unsupported("a second part", "one part, or a file without parts")),
                "PART" => part = true,
                "INSTANCE" if self.instance.is_some() => {
                    return Err(keyword.unsupported("a second instance", "one instance of one part"));
                }
                "INSTANCE" if !keyword.data.is_empty() => {
                    return Err(keyword.unsupported("an instance moved from its place", "an instance in its place"));
                }
                "INSTANCE" => self.instance = Some(keyword.required("NAME")?.text.clone()),
                _ => {}
            }
        }
        Ok(())
    }

    fn read_nodes(&mut self, keyword: &Keyword) -> Result<(), FileFault> {
        keyword.refuse_input("nodes in this file")?;
        if keyword.value("SYSTEM").is_some_and(|system| !system.text.eq_ignore_ascii_case("R")) {
            return Err(keyword.unsupported("a cylindrical or spherical system", "SYSTEM=R"));
        }
        let first = self.points.len();
        for &(line, text) in &keyword.data {
            let fields: Vec<&str> = split(text).into_iter().map(str::trim).collect();
            let wrong =
                || keyword.fault(line, FileProblem::unexpected(text, "a node's number and up to three coordinates"));
            let number = fields[0].parse::<u64>().map_err(|_| wrong())?;
            let mut point = [0.0; 3];
            // Direction cosines of a normal may follow the coordinates.
            for (x, field) in point.iter_mut().zip(&fields[1..]).filter(|(_, field)| !field.is_empty()) {
                *x = real(field).ok_or_else(wrong)?;
            }
            self.node_numbers.push((number, self.points.len()));
            self.points.push(point);
        }
        if let Some(name) = keyword.value("NSET") {
            let members = first..self.points.len();
            self.node_sets.open(name).extend(members);
        }
        Ok(())
    }

    fn read_elements(&mut self, keyword: &Keyword) -> Result<(), FileFault> {
        keyword.refuse_input("elements in this file")?;
        let type_name = &keyword.required("TYPE")?.text;
        let kind = elements::kind(type_name)
            .ok_or_else(|| keyword.unsupported(format!("element type {type_name}"), elements::ALLOWED))?;
        let first = self.cells.len();
        self.cells.begin(kind);
        let mut numbers: Vec<u64> = Vec::new();
        let mut nodes: Vec<usize> = Vec::new();
        let expected = format!(
            "an element's number and its {} nodes, with a comma where the line is continued",
            kind.node_count()
        );
        for &(line, text) in &keyword.data {
            let wrong = || keyword.fault(line, FileProblem::unexpected(text, expected.clone()));
            for (place, field) in split(text).into_iter().map(str::trim).filter(|field| !field.is_empty()).enumerate() {
                let number: u64 = field.parse().map_err(|_| wrong())?;
                if numbers.len() == self.cells.len() - first {
                    // Each element begins on a new line.
                    if place > 0 {
                        return Err(wrong());
                    }
                    numbers.push(number);
                    continue;
                }
                let node = self.nodes.index(number);
                nodes.push(node.ok_or_else(|| keyword.fault(line, FileProblem::NoSuchNode { number }))?);
                if nodes.len() == kind.node_count() {
                    self.cells.push(kind, elements::reorder(kind, &nodes).iter().copied());
                    nodes.clear();
                }
            }
            if numbers.len() != self.cells.len() - first && !text.ends_with(',') {
                return Err(wrong());
            }
        }
        if numbers.len() != self.cells.len() - first {
            return Err(keyword.fault(keyword.line, FileProblem::Ended { expected }));
        }
        if let Some(name) = keyword.value("ELSET") {
            let members = first..self.cells.len();
            self.element_sets.open(name).extend(members);
        }
        self.element_numbers.extend(numbers.into_iter().zip(first..));
        Ok(())
    }

    fn node_targets(&self) -> Targets<'_> {
        Targets { numbering: &self.nodes, missing: FileProblem::no_such_node, instance: self.instance.as_deref() }
    }

    fn element_targets(&self) -> Targets<'_> {
        Targets { numbering: &self.elements, missing: FileProblem::no_such_element, instance: self.instance.as_deref() }
    }

    fn read_node_set(&mut self, keyword: &Keyword, allowance: &mut Allowance) -> Result<(), FileFault> {
        keyword.refuse_input("sets in this file")?;
        let mut found = members(keyword, &self.node_sets, &self.node_targets(), allowance)?;
        if let Some(elements) = keyword.value("ELSET") {
            let Some(cells) = self.element_sets.find(elements) else {
                let problem = FileProblem::unexpected(&elements.text, "the name of an element set defined before");
                return Err(keyword.fault(keyword.line, problem));
            };
            for &cell in cells {
                let (_, nodes) = self.cells.cell(cell);
                allowance.take(nodes.len()).map_err(|limit| keyword.fault(keyword.line, limit))?;
                found.extend(nodes);
            }
        }
        self.node_sets.open(keyword.required("NSET")?).append(&mut found);
        Ok(())
    }

    fn read_element_set(&mut self, keyword: &Keyword, allowance: &mut Allowance) -> Result<(), FileFault> {
        keyword.refuse_input("sets in this file")?;
        let mut found = members(keyword, &self.element_sets, &self.element_targets(), allowance)?;
        self.element_sets.open(keyword.required("ELSET")?).append(&mut found);
        Ok(())
    }

    fn read_surface(&mut self, keyword: &Keyword, allowance: &mut Allowance) -> Result<(), FileFault> {
        let name = keyword.required("NAME")?;
        match keyword.value("TYPE").map(|value| value.text.to_ascii_uppercase()).as_deref() {
            None | Some("ELEMENT") => {}
            Some("NODE") => {
                let mut found = Vec::new();
                for &(line, text) in &keyword.data {
                    // A weight may follow the node.
                    let field = split(text)[0].trim();
                    refer(field, &self.node_sets, &self.node_targets(), allowance, &mut found)
                        .map_err(|problem| keyword.fault(line, problem))?;
                }
                self.node_sets.open(name).append(&mut found);
                return Ok(());
            }
            Some(other) => return Err(keyword.unsupported(format!("a surface of type {other}"), "ELEMENT and NODE")),
        }
        let mut lines = Vec::new();
        for &(line, text) in &keyword.data {
            let fields = split(text);
            let mut found = Vec::new();
            refer(fields[0].trim(), &self.element_sets, &self.element_targets(), allowance, &mut found)
                .map_err(|problem| keyword.fault(line, problem))?;
            let face = fields.get(1).map_or("", |face| face.trim());
            let side = face.strip_prefix(['S', 's']).and_then(|side| side.parse::<usize>().ok());
            for cell in found {
                let (kind, nodes) = self.cells.cell(cell);
                match side {
                    Some(side) if (1..=elements::side_count(kind)).contains(&side) => {
                        lines.push(elements::side(kind, nodes, side - 1));
                    }
                    _ => {
                        let what = format!("side {face:?} of an element with {} nodes", nodes.len());
                        let allowed = "sides S1 to S3 or S4 of plane elements".into();
                        return Err(keyword.fault(line, FileProblem::Unsupported { what, allowed }));
                    }
                }
            }
        }
        self.surfaces.push((name.clone(), lines));
        Ok(())
    }

    fn into_mesh(mut self, allowance: &mut Allowance) -> Result<Mesh, FileFault> {
        // Several definitions of one surface are joined; each surface has separate blocks.
        let mut surfaces: BTreeMap<String, Vec<Line>> = BTreeMap::new();
        let mut names = Vec::new();
        for (name, lines) in self.surfaces {
            let key = self.element_sets.key(&name);
            self.element_sets.open(&name);
            if !surfaces.contains_key(&key) {
                names.push(key.clone());
            }
            surfaces.entry(key).or_default().extend(lines);
        }
        for name in names {
            let mut lines = surfaces.remove(&name).unwrap_or_default();
            lines.sort_by_key(|(kind, _)| *kind);
            let set = self.element_sets.members.entry(name).or_default();
            let mut last = None;
            for (kind, nodes) in lines {
                if last != Some(kind) {
                    self.cells.begin(kind);
                    last = Some(kind);
                }
                set.push(self.cells.push(kind, nodes));
            }
        }
        let cell_sets = close_cell_sets(self.element_sets.members, &self.cells, allowance)
            .map_err(|limit| FileFault::anywhere("*ELSET", limit))?;
        Ok(Mesh {
            points: self.points,
            cells: self.cells.blocks,
            point_sets: close_point_sets(self.node_sets.members),
            cell_sets,
            ..Mesh::default()
        })
    }
}

/// Finite number, whose exponent may be marked by `D` as in Fortran.
fn real(text: &str) -> Option<f64> {
    let value: f64 = text.parse().or_else(|_| text.replace(['d', 'D'], "e").parse()).ok()?;
    value.is_finite().then_some(value)
}
