//! The XML of a REXS file as plain data: components, relations, and what each load case says of components.

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::{RexsError, VERSIONS};

#[derive(Debug, Default)]
pub(super) struct RexsDocument {
    pub version: String,
    /// Name and version of the program that wrote the file.
    pub application: String,
    pub components: Vec<RexsComponent>,
    pub relations: Vec<RexsRelation>,
    /// Components as each load case has them, in the order of the file.
    pub load_cases: Vec<Vec<RexsComponent>>,
}

#[derive(Debug, Clone)]
pub(super) struct RexsComponent {
    pub id: String,
    /// Type, as `cylindrical_gear`.
    pub kind: String,
    pub name: String,
    /// Line of its tag, from 1.
    pub line: usize,
    attributes: Vec<Attribute>,
}

#[derive(Debug, Clone)]
struct Attribute {
    id: String,
    unit: String,
    /// Scalar; that of arrays and matrices is empty.
    text: String,
    line: usize,
}

/// Components that belong together, by their roles.
#[derive(Debug, Default)]
pub(super) struct RexsRelation {
    pub kind: String,
    /// Role and id.
    pub members: Vec<(String, String)>,
}

/// Units that a number may stand in, spaces left out, and the factor to the unit wanted.
pub(super) type Units = &'static [(&'static str, f64)];
pub(super) const MM: Units = &[("mm", 1.0), ("m", 1e3)];
pub(super) const UM: Units = &[("mum", 1.0), ("mm", 1e3)];
/// Lengths that the format gives in mm, wanted in µm.
pub(super) const MM_AS_UM: Units = &[("mm", 1e3), ("mum", 1.0)];
pub(super) const DEG: Units = &[("deg", 1.0), ("rad", 180.0 / std::f64::consts::PI)];
pub(super) const NONE: Units = &[("none", 1.0), ("", 1.0)];
pub(super) const PERCENT: Units = &[("%", 0.01), ("none", 1.0), ("", 1.0)];
pub(super) const GPA: Units = &[("N/mm^2", 1e-3), ("MPa", 1e-3)];
pub(super) const KG_PER_M3: Units = &[("kg/dm^3", 1e3), ("kg/m^3", 1.0)];
pub(super) const W_PER_MK: Units = &[("W/(mK)", 1.0)];
pub(super) const J_PER_KGK: Units = &[("J/(kgK)", 1.0)];
pub(super) const MM2_PER_S: Units = &[("mm^2/s", 1.0)];
pub(super) const CELSIUS: Units = &[("C", 1.0)];
pub(super) const NM: Units = &[("Nm", 1.0)];
pub(super) const RPM: Units = &[("1/min", 1.0)];
pub(super) const HOURS: Units = &[("h", 1.0)];

impl RexsComponent {
    /// Name in messages.
    pub(super) fn label(&self) -> String {
        let name = if self.name.is_empty() { &self.kind } else { &self.name };
        format!("{name} (id {})", self.id)
    }

    fn attribute(&self, id: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| attribute.id == id)
    }

    /// A word or text; None where it is not there or empty.
    pub(super) fn text(&self, id: &str) -> Option<&str> {
        self.attribute(id).map(|attribute| attribute.text.as_str()).filter(|text| !text.is_empty())
    }

    /// The first of these attributes that it has.
    pub(super) fn first_of<'b>(&self, ids: &[&'b str]) -> Option<&'b str> {
        ids.iter().copied().find(|id| self.attribute(id).is_some())
    }

    /// A number, in the unit that `units` convert to; None where it is not there.
    pub(super) fn number(&self, id: &str, units: Units) -> Result<Option<f64>, RexsError> {
        let Some(attribute) = self.attribute(id) else { return Ok(None) };
        let unit: String = attribute.unit.chars().filter(|c| !c.is_whitespace()).collect();
        let factor = units.iter().find(|(name, _)| *name == unit).ok_or_else(|| {
            let names: Vec<String> = units.iter().map(|(name, _)| format!("{name:?}")).collect();
            self.wrong(id, format!("the unit {:?}", attribute.unit), names.join(", "))
        })?;
        let value: f64 = attribute
            .text
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| self.wrong(id, format!("{:?}", attribute.text), "a number".to_owned()))?;
        Ok(Some(value * factor.1))
    }

    /// A number that the scene needs.
    pub(super) fn needed(&self, id: &'static str, units: Units) -> Result<f64, RexsError> {
        self.number(id, units)?.ok_or_else(|| self.missing(id))
    }

    pub(super) fn missing(&self, attribute: &'static str) -> RexsError {
        RexsError::Missing { line: self.line, component: self.label(), attribute }
    }

    /// Error that the value of an attribute will not do.
    pub(super) fn wrong(&self, id: &str, found: String, allowed: String) -> RexsError {
        let line = self.attribute(id).map_or(self.line, |attribute| attribute.line);
        RexsError::Value { line, component: self.label(), attribute: id.to_owned(), found, allowed }
    }
}

impl RexsRelation {
    /// The id of the member in this role.
    pub(super) fn member(&self, role: &str) -> Option<&str> {
        self.members.iter().find(|(member, _)| member == role).map(|(_, id)| id.as_str())
    }
}

impl RexsDocument {
    pub(super) fn component(&self, id: &str) -> Option<&RexsComponent> {
        self.components.iter().find(|component| component.id == id)
    }

    /// The first relation of `kind` in which each `(role, id)` of `members` stands.
    pub(super) fn relation(&self, kind: &str, members: &[(&str, &str)]) -> Option<&RexsRelation> {
        self.relations.iter().find(|relation| {
            relation.kind == kind && members.iter().all(|(role, id)| relation.member(role) == Some(id))
        })
    }

    /// The members in role `wanted` of the relations of `kind` in which `id` has `role`.
    pub(super) fn related<'a>(
        &'a self,
        kind: &'a str,
        (role, id): (&'a str, &'a str),
        wanted: &'a str,
    ) -> impl Iterator<Item = &'a RexsComponent> {
        self.relations
            .iter()
            .filter(move |relation| relation.kind == kind && relation.member(role) == Some(id))
            .filter_map(move |relation| self.component(relation.member(wanted)?))
    }

    /// The shaft that carries a gear.
    pub(super) fn shaft_of<'a>(&'a self, gear: &'a RexsComponent) -> Option<&'a RexsComponent> {
        self.related("assembly", ("part", &gear.id), "assembly").find(|component| component.kind == "shaft")
    }

    /// The material that a component refers to.
    pub(super) fn material_of<'a>(&'a self, component: &'a RexsComponent) -> Option<&'a RexsComponent> {
        self.related("reference", ("origin", &component.id), "referenced").find(|found| found.kind == "material")
    }

    /// Word that the first load case that speaks of it, or the component itself, has.
    pub(super) fn word<'a>(&'a self, component: &'a RexsComponent, id: &str) -> Option<&'a str> {
        let cases = self.load_cases.iter().flatten().filter(|said| said.id == component.id);
        cases.chain([component]).find_map(|said| said.text(id))
    }

    pub(super) fn parse(text: &str) -> Result<Self, RexsError> {
        if let Some(found) = other_form(text) {
            return Err(RexsError::NoXml { line: 1, found: found.to_owned() });
        }
        let mut reader = Reader::from_str(text);
        let mut lines = Lines::of(text);
        let mut path: Vec<String> = Vec::new();
        let mut document = RexsDocument::default();
        let mut model_seen = false;
        loop {
            let line = lines.at(reader.buffer_position());
            let event = reader
                .read_event()
                .map_err(|error| RexsError::unreadable(lines.at(reader.error_position()), &error))?;
            match event {
                Event::Start(tag) => {
                    model_seen |= tag.name().as_ref() == "model";
                    document.enter(&tag, line, &path)?;
                    path.push(tag.name().as_ref().to_owned());
                }
                Event::Empty(tag) => document.enter(&tag, line, &path)?,
                Event::Text(more) if path.last().is_some_and(|name| name == "attribute") => {
                    if let Some(attribute) = document.open_attribute(&path) {
                        attribute.text.push_str(more.trim());
                    }
                }
                Event::End(_) => {
                    path.pop();
                }
                Event::Eof => break,
                _ => {}
            }
        }
        let line = lines.at(text.len() as u64);
        if let Some(open) = path.last() {
            return Err(RexsError::NoXml { line, found: format!("the end of the file before </{open}>") });
        }
        if !model_seen {
            return Err(RexsError::NoXml { line, found: "no element <model>".to_owned() });
        }
        Ok(document)
    }

    /// Takes in an element within the elements `path`.
    fn enter(&mut self, tag: &BytesStart, line: usize, path: &[String]) -> Result<(), RexsError> {
        let value = |name: &str| xml_attribute(tag, name, line);
        match tag.name().as_ref() {
            "model" => {
                self.version = value("version")?;
                if !VERSIONS.contains(&self.version.as_str()) {
                    return Err(RexsError::Version { line, found: self.version.clone() });
                }
                self.application =
                    format!("{} {}", value("applicationId")?, value("applicationVersion")?).trim().to_owned();
            }
            "relation" => self.relations.push(RexsRelation { kind: value("type")?, members: Vec::new() }),
            "ref" => {
                let member = (value("role")?, value("id")?);
                if let Some(relation) = self.relations.last_mut() {
                    relation.members.push(member);
                }
            }
            "load_case" => self.load_cases.push(Vec::new()),
            "component" => {
                let component = RexsComponent {
                    id: value("id")?,
                    kind: value("type")?,
                    name: value("name")?,
                    line,
                    attributes: Vec::new(),
                };
                if let Some(components) = self.components_of(path) {
                    components.push(component);
                }
            }
            "attribute" => {
                let attribute = Attribute { id: value("id")?, unit: value("unit")?, text: String::new(), line };
                if let Some(component) = self.components_of(path).and_then(|components| components.last_mut()) {
                    component.attributes.push(attribute);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Where components within the elements `path` belong; None of sums over the load spectrum, which nothing reads.
    fn components_of(&mut self, path: &[String]) -> Option<&mut Vec<RexsComponent>> {
        if path.iter().any(|element| element == "accumulation") {
            None
        } else if path.iter().any(|element| element == "load_case") {
            self.load_cases.last_mut()
        } else {
            Some(&mut self.components)
        }
    }

    fn open_attribute(&mut self, path: &[String]) -> Option<&mut Attribute> {
        self.components_of(path)?.last_mut()?.attributes.last_mut()
    }
}

/// An attribute of an element on `line`; empty where it is not there.
pub(super) fn xml_attribute(tag: &BytesStart, name: &str, line: usize) -> Result<String, RexsError> {
    match tag.try_get_attribute(name).map_err(|error| unreadable_attribute(line, error))? {
        None => Ok(String::new()),
        Some(found) => {
            let value =
                found.normalized_value(XmlVersion::Implicit1_0).map_err(|error| unreadable_attribute(line, error))?;
            // Names stand in remarks, which end with their line.
            Ok(value.chars().map(|c| if c.is_control() { ' ' } else { c }).collect())
        }
    }
}

fn unreadable_attribute(line: usize, error: impl std::fmt::Display) -> RexsError {
    RexsError::NoXml { line, found: format!("an attribute that cannot be read ({error})") }
}

/// Kind of a file that is no XML, by how it begins.
fn other_form(text: &str) -> Option<&'static str> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.is_empty() {
        Some("an empty file")
    } else if text.starts_with('{') {
        Some("the JSON form of REXS (.rexsj)")
    } else if text.starts_with("PK") {
        Some("a compressed file (.rexsz)")
    } else if !text.starts_with('<') {
        Some("text that is no XML")
    } else {
        None
    }
}

/// Lines of places that only grow.
pub(super) struct Lines<'a> {
    text: &'a str,
    byte: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        Self { text, byte: 0, line: 1 }
    }

    pub(super) fn at(&mut self, byte: u64) -> usize {
        let byte = usize::try_from(byte).unwrap_or(usize::MAX).min(self.text.len());
        if byte > self.byte {
            self.line += self.text.as_bytes()[self.byte..byte].iter().filter(|&&byte| byte == b'\n').count();
            self.byte = byte;
        }
        self.line
    }
}
