//! A REXS file as plain data, whatever its form: components, relations, and what each load case says of components.
//!
//! Names are those of version 2.0. What older versions call otherwise is found under both names, and messages say that of the file.

use std::collections::HashMap;

use super::{RexsError, VERSIONS, json, xml};

/// Components of a file, and relations, at most: what belongs together is looked for among all of them.
const MOST_PARTS: usize = 50_000;
/// Stages at most.
const MOST_STAGES: usize = 200;
/// Load cases at most.
const MOST_LOAD_CASES: usize = 1000;

#[derive(Debug, Default)]
pub(super) struct RexsDocument {
    pub version: String,
    /// Line that says it, from 1.
    pub version_line: usize,
    /// Name and version of the program that wrote the file.
    pub application: String,
    pub components: Vec<RexsComponent>,
    /// Index of the first component of each id.
    pub by_id: HashMap<String, usize>,
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
    pub attributes: Vec<Attribute>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Attribute {
    /// As the file has it.
    pub id: String,
    pub unit: String,
    /// Scalar; that of arrays and matrices is empty.
    pub text: String,
    /// Numbers of an array; empty of anything else.
    pub numbers: Vec<f64>,
    pub line: usize,
}

/// Names of components in older versions, and those of today.
const OLDER_KINDS: [(&str, &str); 2] =
    [("flank_geometry", "cylindrical_gear_flank"), ("stage_gear_data", "cylindrical_stage_gear_data")];
/// Names of attributes in older versions, and those of today. Some programs write an older one in a newer version too.
const OLDER_IDS: [(&str, &str); 3] = [
    ("load_duration", "operating_time"),
    ("load_duration_fraction", "operating_time_fraction"),
    ("arithmetic_average_roughness_flank", "arithmetic_mean_roughness_flank_iso_4287_1997"),
];

/// The name of today for `name`.
fn newest<'a>(older: &[(&'static str, &'static str)], name: &'a str) -> &'a str {
    older.iter().find(|(old, _)| *old == name).map_or(name, |(_, new)| new)
}

/// The kind of a component by its name of today.
pub(super) fn kind_of_today(kind: &str) -> String {
    newest(&OLDER_KINDS, kind).to_owned()
}

/// A name or word on one line: it stands in remarks, which end with theirs.
pub(super) fn on_one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>().trim().to_owned()
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
pub(super) const DEG: Units = &[("deg", 1.0), ("°", 1.0), ("rad", 180.0 / std::f64::consts::PI)];
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
pub(super) const KW: Units = &[("kW", 1.0), ("W", 1e-3)];

impl RexsComponent {
    /// Name in messages.
    pub(super) fn label(&self) -> String {
        let name = if self.name.is_empty() { &self.kind } else { &self.name };
        format!("{name} (id {})", self.id)
    }

    fn attribute(&self, id: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| newest(&OLDER_IDS, &attribute.id) == id)
    }

    pub(super) fn is_stage(&self) -> bool {
        self.kind.ends_with("_stage")
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

    /// A vector of three numbers in mm; None where it is not there, or of another length or unit.
    pub(super) fn vector_mm(&self, id: &str) -> Option<[f64; 3]> {
        let attribute = self.attribute(id)?;
        let (_, factor) = MM.iter().find(|(name, _)| *name == attribute.unit)?;
        let vector: [f64; 3] = attribute.numbers.as_slice().try_into().ok()?;
        Some(vector.map(|number| factor * number)).filter(|vector| vector.iter().all(|number| number.is_finite()))
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
        let (line, id) = self.attribute(id).map_or((self.line, id), |attribute| (attribute.line, &attribute.id));
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
        self.by_id.get(id).map(|&index| &self.components[index])
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
        let mut parts = self.related("assembly", ("part", &gear.id), "assembly");
        parts.find(|component| component.kind == "shaft").or_else(|| {
            let joints = self.relations.iter().filter(|relation| relation.kind == "side" && self.is_joint(relation));
            let mut mates = joints.filter_map(|relation| {
                let sides = [relation.member("inner_part")?, relation.member("outer_part")?];
                let own = sides.iter().position(|id| *id == gear.id)?;
                self.component(sides[1 - own])
            });
            mates.find(|mate| mate.kind == "shaft")
        })
    }

    /// Whether what joins both sides of a relation turns with them: an engaged coupling, a key, spline or interference fit.
    pub(super) fn is_joint(&self, relation: &RexsRelation) -> bool {
        let Some(joint) = relation.member("assembly").and_then(|id| self.component(id)) else { return false };
        let kind = joint.kind.as_str();
        let holds = ["coupling", "_connection", "_fit"].iter().any(|ending| kind.ends_with(ending));
        holds && joint.text("is_engaged") != Some("false")
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

    /// Adds a component of the model, or of the load case of this index.
    pub(super) fn add(&mut self, component: RexsComponent, case: Option<usize>) {
        match case.and_then(|index| self.load_cases.get_mut(index)) {
            Some(of_case) => of_case.push(component),
            None => {
                self.by_id.entry(component.id.clone()).or_insert(self.components.len());
                self.components.push(component);
            }
        }
    }

    /// The model in its XML or its JSON form.
    pub(super) fn parse(text: &str) -> Result<Self, RexsError> {
        let document = if json::is_json(text) { json::parse(text) } else { xml::parse(text) }?;
        let line = document.version_line;
        if !VERSIONS.contains(&document.version.as_str()) {
            return Err(RexsError::Version { line, found: document.version, allowed: "1.0 to 1.7 and 2.0" });
        }
        let stages = document.components.iter().filter(|component| component.is_stage()).count();
        for (what, count, most) in [
            ("components", document.components.len(), MOST_PARTS),
            ("relations", document.relations.len(), MOST_PARTS),
            ("stages", stages, MOST_STAGES),
            ("load cases", document.load_cases.len(), MOST_LOAD_CASES),
        ] {
            if count > most {
                return Err(RexsError::NoModel { line, found: format!("more than {most} {what}") });
            }
        }
        Ok(document)
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

    /// The place it is at.
    pub(super) fn byte(&self) -> usize {
        self.byte
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
