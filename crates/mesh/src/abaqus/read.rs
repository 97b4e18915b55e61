//! Reading of Abaqus files.

use std::collections::BTreeMap;
use std::path::Path;

use super::assembly::{Placement, Scope, scopes};
use super::elements;
use super::keywords::{Keyword, Name, split};
use super::sets::{Named, Targets, joined};
use super::sources::{At, Sources};
use crate::error::{FileFault, FileProblem};
use crate::numbering::{Allowance, CellList, Numbering, OpenSets, close_cell_sets, close_point_sets};
use crate::{CellKind, LeftOut, Mesh};

/// Keywords that generate nodes or elements, without which part of the mesh would be missing.
const REFUSED: [&str; 10] = [
    "NGEN",
    "NFILL",
    "NCOPY",
    "NMAP",
    "ELGEN",
    "ELCOPY",
    "SYSTEM",
    "IMPORT",
    "SUPER ELEMENT",
    "SYMMETRIC MODEL GENERATION",
];

/// Kind and nodes of a line or face on a side of an element.
type Side = (CellKind, Vec<usize>);

/// Element of the file: a cell of the mesh, or one of those left out.
#[derive(Debug, Clone, Copy)]
enum Element {
    Cell(usize),
    LeftOut(usize),
}

#[derive(Debug, Default)]
struct AbaqusContent {
    points: Vec<[f64; 3]>,
    cells: CellList,
    /// Elements in the order of the file, which sets of elements refer to.
    elements: Vec<Element>,
    left_out: Vec<LeftOut>,
    /// Nodes of the assembly and of each instance, and their sets.
    nodes: Vec<Named>,
    /// Elements of the same.
    element_names: Vec<Named>,
    /// Sides of each surface, by the number of its instance and its name.
    surfaces: Vec<(usize, Name, Vec<Side>)>,
}

/// Mesh in `bytes`, of `file` if they are of a file, and the content of all files that it includes.
pub(crate) fn read(bytes: &[u8], file: Option<&Path>) -> Result<(Mesh, Vec<u8>), FileFault> {
    let sources = Sources::load(bytes, file)?;
    let keywords = sources.keywords()?;
    if let Some(keyword) = keywords.iter().find(|keyword| REFUSED.contains(&keyword.name.as_str())) {
        return Err(keyword.unsupported(format!("*{}", keyword.name), "*NODE and *ELEMENT with all their lines"));
    }
    let mut allowance = Allowance::of(sources.len());
    let mut content = AbaqusContent::default();
    let scopes = scopes(&keywords)?;
    // Sets and surfaces may come before the elements they refer to, so that nodes are read first, then elements, then these; sets of the
    // assembly, which refer to instances, are the last.
    for scope in &scopes {
        content.read_all_nodes(scope, &sources, &mut allowance)?;
    }
    for (number, scope) in scopes.iter().enumerate() {
        content.read_all_elements(number, scope, &sources, &mut allowance)?;
    }
    for (number, scope) in scopes.iter().enumerate().skip(1).chain(scopes.iter().enumerate().take(1)) {
        for keyword in &scope.keywords {
            match keyword.name.as_str() {
                "NSET" => content.read_node_set(number, keyword, &mut allowance)?,
                "ELSET" => content.read_element_set(number, keyword, &mut allowance)?,
                "SURFACE" => content.read_surface(number, keyword, &mut allowance)?,
                _ => {}
            }
        }
    }
    let mesh = content.into_mesh(&mut allowance).map_err(|limit| FileFault::anywhere("*ELSET", limit))?;
    Ok((mesh, sources.included_bytes()))
}

/// Number of a node or an element, and its line.
type NumberAt = (u64, At);

/// Numbering of nodes or elements from the index `first` on; of a number that is there twice, the fault at the line of the second.
fn numbering(
    numbers: &[NumberAt],
    first: usize,
    what: &'static str,
    sources: &Sources,
) -> Result<Numbering, FileFault> {
    let pairs = numbers.iter().map(|&(number, _)| number).zip(first..).collect();
    Numbering::new(pairs, what).map_err(|problem| {
        let twice = |number: u64| numbers.iter().filter(move |own| own.0 == number).nth(1);
        let second = if let FileProblem::Twice { number, .. } = problem { twice(number) } else { None };
        let section = format!("*{}", what.to_ascii_uppercase());
        match second {
            Some(&(_, at)) => sources.fault(at, &section, problem),
            None => FileFault::anywhere(section, problem),
        }
    })
}

impl AbaqusContent {
    fn read_all_nodes(&mut self, scope: &Scope, sources: &Sources, allowance: &mut Allowance) -> Result<(), FileFault> {
        let mut own = Named { instance: scope.instance.cloned(), ..Named::default() };
        let mut numbers = Vec::new();
        let before = self.points.len();
        for keyword in scope.keywords.iter().filter(|keyword| keyword.name == "NODE") {
            // Copies of a part are paid for as sets are.
            let entries = 3 * keyword.data.len();
            allowance.take(entries).map_err(|limit| keyword.fault(keyword.at, limit))?;
            let first = self.points.len();
            self.read_nodes(keyword, scope.placement, &mut numbers)?;
            if let Some(name) = keyword.value("NSET") {
                own.sets.open(name).extend(first..self.points.len());
            }
        }
        own.numbers = numbering(&numbers, before, "node", sources)?;
        self.nodes.push(own);
        Ok(())
    }

    fn read_nodes(
        &mut self,
        keyword: &Keyword,
        placement: Placement,
        numbers: &mut Vec<NumberAt>,
    ) -> Result<(), FileFault> {
        if keyword.value("SYSTEM").is_some_and(|system| !system.text.eq_ignore_ascii_case("R")) {
            return Err(keyword.unsupported("a cylindrical or spherical system", "SYSTEM=R"));
        }
        for &(at, text) in &keyword.data {
            let fields: Vec<&str> = split(text).into_iter().map(str::trim).collect();
            let wrong =
                || keyword.fault(at, FileProblem::unexpected(text, "a node's number and up to three coordinates"));
            let number = fields[0].parse::<u64>().map_err(|_| wrong())?;
            let mut point = [0.0; 3];
            // Direction cosines of a normal may follow the coordinates.
            for (x, field) in point.iter_mut().zip(&fields[1..]).filter(|(_, field)| !field.is_empty()) {
                *x = real(field).ok_or_else(wrong)?;
            }
            let point = placement.of(point);
            if !point.iter().all(|x| x.is_finite()) {
                return Err(wrong());
            }
            numbers.push((number, at));
            self.points.push(point);
        }
        Ok(())
    }

    fn read_all_elements(
        &mut self,
        scope_number: usize,
        scope: &Scope,
        sources: &Sources,
        allowance: &mut Allowance,
    ) -> Result<(), FileFault> {
        let mut own = Named { instance: scope.instance.cloned(), ..Named::default() };
        let mut numbers = Vec::new();
        let before = self.elements.len();
        for keyword in scope.keywords.iter().filter(|keyword| keyword.name == "ELEMENT") {
            let entries = keyword.data.iter().map(|(_, text)| 1 + text.matches(',').count()).sum();
            allowance.take(entries).map_err(|limit| keyword.fault(keyword.at, limit))?;
            let first = self.elements.len();
            let type_name = &keyword.required("TYPE")?.text;
            let found = match elements::kind(type_name) {
                Some((kind, formulation)) => {
                    self.cells.begin(kind, formulation);
                    self.read_cells(scope_number, keyword, kind)?
                }
                None => self.leave_out(keyword, type_name)?,
            };
            numbers.extend(found);
            if let Some(name) = keyword.value("ELSET") {
                own.sets.open(name).extend(first..self.elements.len());
            }
        }
        own.numbers = numbering(&numbers, before, "element", sources)?;
        if let Some(name) = &own.instance
            && own.sets.find(name).is_none()
            && self.nodes.len() > 2
        {
            self.instance_set(name.clone(), before..self.elements.len(), allowance)
                .map_err(|limit| FileFault::anywhere("*INSTANCE", limit))?;
        }
        self.element_names.push(own);
        Ok(())
    }

    /// All elements of an instance as a set of its name, which belongs to the assembly.
    fn instance_set(
        &mut self,
        name: Name,
        elements: std::ops::Range<usize>,
        allowance: &mut Allowance,
    ) -> Result<(), FileProblem> {
        allowance.take(elements.len())?;
        if let Some(assembly) = self.element_names.first_mut() {
            assembly.sets.open(&name).extend(elements);
        }
        Ok(())
    }

    /// Numbers of the elements of a keyword, whose cells are added.
    fn read_cells(&mut self, scope: usize, keyword: &Keyword, kind: CellKind) -> Result<Vec<NumberAt>, FileFault> {
        let first = self.cells.len();
        let mut numbers: Vec<NumberAt> = Vec::new();
        let mut nodes: Vec<usize> = Vec::new();
        let expected = format!(
            "an element's number and its {} nodes, with a comma where the line is continued",
            kind.node_count()
        );
        let targets = Targets { all: &self.nodes, own: scope, missing: FileProblem::no_such_node };
        for &(at, text) in &keyword.data {
            let wrong = || keyword.fault(at, FileProblem::unexpected(text, expected.clone()));
            for (place, field) in split(text).into_iter().map(str::trim).filter(|field| !field.is_empty()).enumerate() {
                if numbers.len() == self.cells.len() - first {
                    // Each element begins on a new line.
                    if place > 0 {
                        return Err(wrong());
                    }
                    numbers.push((field.parse().map_err(|_| wrong())?, at));
                    continue;
                }
                nodes.push(targets.node(field).ok_or_else(wrong)?.map_err(|problem| keyword.fault(at, problem))?);
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
            return Err(keyword.fault(keyword.at, FileProblem::Ended { expected }));
        }
        self.elements.extend((first..self.cells.len()).map(Element::Cell));
        Ok(numbers)
    }

    /// Numbers of elements of a type without a kind of cell, of which they alone are kept.
    fn leave_out(&mut self, keyword: &Keyword, type_name: &str) -> Result<Vec<NumberAt>, FileFault> {
        let known = self.left_out.iter().position(|own| own.element_type.eq_ignore_ascii_case(type_name));
        let kept = known.unwrap_or_else(|| {
            let (element_type, line) = (type_name.to_owned(), keyword.at.line);
            self.left_out.push(LeftOut { element_type, count: 0, line, sets: Vec::new() });
            self.left_out.len() - 1
        });
        let mut numbers = Vec::new();
        let mut continued = false;
        for &(at, text) in &keyword.data {
            if !continued {
                let number = split(text)[0].trim().parse();
                let wrong = |_| keyword.fault(at, FileProblem::unexpected(text, "an element's number and its nodes"));
                numbers.push((number.map_err(wrong)?, at));
            }
            continued = text.ends_with(',');
        }
        self.left_out[kept].count += numbers.len();
        self.elements.extend(std::iter::repeat_n(Element::LeftOut(kept), numbers.len()));
        Ok(numbers)
    }

    /// Number of the instance whose nodes or elements a set or a surface refers to without a prefix.
    fn own(&self, scope: usize, keyword: &Keyword) -> Result<usize, FileFault> {
        let Some(name) = keyword.value("INSTANCE") else { return Ok(scope) };
        let mut instances = self.nodes.iter().map(|own| own.instance.as_ref());
        if instances.clone().all(|own| own.is_none()) {
            return Ok(scope);
        }
        instances
            .position(|own| own.is_some_and(|own| own.is(name)))
            .ok_or_else(|| keyword.fault(keyword.at, FileProblem::unexpected(&name.text, "the name of an instance")))
    }

    fn read_node_set(&mut self, scope: usize, keyword: &Keyword, allowance: &mut Allowance) -> Result<(), FileFault> {
        let own = self.own(scope, keyword)?;
        let targets = Targets { all: &self.nodes, own, missing: FileProblem::no_such_node };
        let mut found = targets.members(keyword, allowance)?;
        if let Some(name) = keyword.value("ELSET") {
            let targets = Targets { all: &self.element_names, own, missing: FileProblem::no_such_element };
            let Some(elements) = targets.set(name) else {
                let problem = FileProblem::unexpected(&name.text, "the name of an element set defined before");
                return Err(keyword.fault(keyword.at, problem));
            };
            for &element in elements {
                let Element::Cell(cell) = self.elements[element] else { continue };
                let (_, nodes) = self.cells.cell(cell);
                allowance.take(nodes.len()).map_err(|limit| keyword.fault(keyword.at, limit))?;
                found.extend(nodes);
            }
        }
        self.nodes[scope].sets.open(keyword.required("NSET")?).append(&mut found);
        Ok(())
    }

    fn read_element_set(
        &mut self,
        scope: usize,
        keyword: &Keyword,
        allowance: &mut Allowance,
    ) -> Result<(), FileFault> {
        let own = self.own(scope, keyword)?;
        let targets = Targets { all: &self.element_names, own, missing: FileProblem::no_such_element };
        let mut found = targets.members(keyword, allowance)?;
        self.element_names[scope].sets.open(keyword.required("ELSET")?).append(&mut found);
        Ok(())
    }

    fn read_surface(&mut self, scope: usize, keyword: &Keyword, allowance: &mut Allowance) -> Result<(), FileFault> {
        let name = keyword.required("NAME")?;
        let own = self.own(scope, keyword)?;
        if let Some(how) = ["COMBINE", "CROP"].into_iter().find(|how| keyword.has(how)) {
            return Err(keyword.unsupported(format!("a surface with {how}"), "surfaces of sides and of nodes"));
        }
        match keyword.value("TYPE").map(|value| value.text.to_ascii_uppercase()).as_deref() {
            None | Some("ELEMENT") => {}
            Some("NODE") => {
                let targets = Targets { all: &self.nodes, own, missing: FileProblem::no_such_node };
                let mut found = Vec::new();
                for &(at, text) in &keyword.data {
                    // A weight may follow the node.
                    let field = split(text)[0].trim();
                    targets.refer(field, allowance, &mut found).map_err(|problem| keyword.fault(at, problem))?;
                }
                self.nodes[scope].sets.open(name).append(&mut found);
                return Ok(());
            }
            Some(other) => return Err(keyword.unsupported(format!("a surface of type {other}"), "ELEMENT and NODE")),
        }
        let targets = Targets { all: &self.element_names, own, missing: FileProblem::no_such_element };
        let mut sides = Vec::new();
        for &(at, text) in &keyword.data {
            let fields = split(text);
            let mut found = Vec::new();
            targets.refer(fields[0].trim(), allowance, &mut found).map_err(|problem| keyword.fault(at, problem))?;
            let label = fields.get(1).map_or("", |label| label.trim());
            for element in found {
                let Element::Cell(cell) = self.elements[element] else { continue };
                let (block, nodes) = self.cells.cell(cell);
                sides.push(elements::labelled(block, nodes, label).ok_or_else(|| {
                    let what = format!("side {label:?} of an element with {} nodes", nodes.len());
                    let allowed =
                        "sides S1 to S3 or S4 of plane elements, S1 to S6 of solids, SPOS, SNEG and E1 to E4 of shells";
                    keyword.fault(at, FileProblem::Unsupported { what, allowed: allowed.into() })
                })?);
            }
        }
        self.surfaces.push((scope, name.clone(), sides));
        Ok(())
    }

    fn into_mesh(mut self, allowance: &mut Allowance) -> Result<Mesh, FileProblem> {
        // Several definitions of one surface are joined; each surface has separate blocks.
        let mut order: Vec<(usize, String)> = Vec::new();
        let mut sides: BTreeMap<(usize, String), Vec<Side>> = BTreeMap::new();
        for (scope, name, own) in std::mem::take(&mut self.surfaces) {
            self.element_names[scope].sets.open(&name);
            let key = (scope, self.element_names[scope].sets.key(&name));
            if !sides.contains_key(&key) {
                order.push(key.clone());
            }
            sides.entry(key).or_default().extend(own);
        }
        for key in order {
            let mut own = sides.remove(&key).unwrap_or_default();
            own.sort_by_key(|(kind, _)| *kind);
            let (scope, name) = key;
            let mut last = None;
            for (kind, nodes) in own {
                if last != Some(kind) {
                    self.cells.begin(kind, None);
                    last = Some(kind);
                }
                let cell = self.cells.push(kind, nodes);
                self.elements.push(Element::Cell(cell));
                let set = self.element_names[scope].sets.members.entry(name.clone()).or_default();
                set.push(self.elements.len() - 1);
            }
        }
        let mut cell_sets = OpenSets::new();
        for (name, members) in joined(self.element_names, allowance)?.members {
            let set: &mut Vec<usize> = cell_sets.entry(name.clone()).or_default();
            for element in members {
                match self.elements[element] {
                    Element::Cell(cell) => set.push(cell),
                    Element::LeftOut(kept) if self.left_out[kept].sets.last() == Some(&name) => {}
                    Element::LeftOut(kept) => self.left_out[kept].sets.push(name.clone()),
                }
            }
        }
        Ok(Mesh {
            points: self.points,
            cell_sets: close_cell_sets(cell_sets, &self.cells, allowance)?,
            cells: self.cells.blocks,
            point_sets: close_point_sets(joined(self.nodes, allowance)?.members),
            left_out: self.left_out,
            ..Mesh::default()
        })
    }
}

/// Finite number, whose exponent may be marked by `D` as in Fortran.
pub(super) fn real(text: &str) -> Option<f64> {
    let value: f64 = text.parse().or_else(|_| text.replace(['d', 'D'], "e").parse()).ok()?;
    value.is_finite().then_some(value)
}
