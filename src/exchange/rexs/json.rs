//! The JSON form. Components are read one after the other out of the text, so that each has its line.

use serde::Deserialize;
use serde_json::value::RawValue;

use super::RexsError;
use super::document::{Attribute, Lines, RexsComponent, RexsDocument, RexsRelation, kind_of_today, on_one_line};

#[derive(Deserialize)]
struct JsonFile<'a> {
    #[serde(borrow)]
    model: JsonModel<'a>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct JsonModel<'a> {
    version: Option<Scalar>,
    application_id: Option<Scalar>,
    application_version: Option<Scalar>,
    relations: Option<Vec<JsonRelation>>,
    #[serde(borrow)]
    components: Option<Vec<&'a RawValue>>,
    #[serde(borrow, rename = "load_spectrum")]
    load_spectrum: Option<JsonSpectrum<'a>>,
}

#[derive(Deserialize)]
struct JsonSpectrum<'a> {
    #[serde(borrow)]
    load_cases: Option<Vec<JsonLoadCase<'a>>>,
}

#[derive(Deserialize)]
struct JsonLoadCase<'a> {
    #[serde(borrow)]
    components: Option<Vec<&'a RawValue>>,
}

#[derive(Deserialize)]
struct JsonRelation {
    #[serde(rename = "type")]
    kind: Option<Scalar>,
    refs: Option<Vec<JsonMember>>,
}

#[derive(Deserialize)]
struct JsonMember {
    role: Option<Scalar>,
    id: Option<Scalar>,
}

#[derive(Deserialize)]
struct JsonComponent<'a> {
    id: Option<Scalar>,
    #[serde(rename = "type")]
    kind: Option<Scalar>,
    name: Option<Scalar>,
    #[serde(borrow)]
    attributes: Option<Vec<&'a RawValue>>,
}

/// An attribute with its value under the name of its type. Programs differ in which type they choose.
#[derive(Deserialize)]
struct JsonAttribute {
    id: Option<Scalar>,
    unit: Option<Scalar>,
    floating_point: Option<Scalar>,
    integer: Option<Scalar>,
    boolean: Option<Scalar>,
    string: Option<Scalar>,
    #[serde(rename = "enum")]
    word: Option<Scalar>,
    floating_point_array: Option<Vec<Option<f64>>>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Scalar {
    Truth(bool),
    Number(serde_json::Number),
    Text(String),
}

impl Scalar {
    fn into_text(self) -> String {
        match self {
            Self::Truth(truth) => truth.to_string(),
            Self::Number(number) => number.to_string(),
            Self::Text(text) => on_one_line(&text),
        }
    }
}

fn text(scalar: Option<Scalar>) -> String {
    scalar.map(Scalar::into_text).unwrap_or_default()
}

/// Whether a file is in this form, by how it begins.
pub(super) fn is_json(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim_start().starts_with('{')
}

/// The model of a file in JSON.
pub(super) fn parse(whole: &str) -> Result<RexsDocument, RexsError> {
    let whole = whole.trim_start_matches('\u{feff}');
    let file: JsonFile = serde_json::from_str(whole).map_err(|error| unreadable(1, &error))?;
    let JsonModel { version, application_id, application_version, relations, components, load_spectrum } = file.model;
    let mut reader = Reader { text: whole, lines: Lines::of(whole) };
    let mut found = RexsDocument {
        version: text(version),
        version_line: whole.find("\"version\"").map_or(1, |at| Lines::of(whole).at(at as u64)),
        application: format!("{} {}", text(application_id), text(application_version)).trim().to_owned(),
        relations: relations.unwrap_or_default().into_iter().map(relation).collect(),
        ..RexsDocument::default()
    };
    for raw in components.unwrap_or_default() {
        found.add(reader.component(raw)?, None);
    }
    for case in load_spectrum.and_then(|spectrum| spectrum.load_cases).unwrap_or_default() {
        found.load_cases.push(Vec::new());
        for raw in case.components.unwrap_or_default() {
            found.add(reader.component(raw)?, Some(found.load_cases.len() - 1));
        }
    }
    Ok(found)
}

fn relation(JsonRelation { kind, refs }: JsonRelation) -> RexsRelation {
    let members = refs.unwrap_or_default().into_iter().map(|member| (text(member.role), text(member.id)));
    RexsRelation { kind: text(kind), members: members.collect() }
}

/// The text that parts are read out of.
struct Reader<'a> {
    text: &'a str,
    lines: Lines<'a>,
}

impl<'a> Reader<'a> {
    /// The line that a part of the text begins on.
    fn line(&mut self, part: &RawValue) -> usize {
        let at = (part.get().as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        if at < self.lines.byte() {
            self.lines = Lines::of(self.text);
        }
        self.lines.at(at as u64)
    }

    fn component(&mut self, raw: &'a RawValue) -> Result<RexsComponent, RexsError> {
        let line = self.line(raw);
        let JsonComponent { id, kind, name, attributes } =
            serde_json::from_str(raw.get()).map_err(|error| unreadable(line, &error))?;
        let attributes = attributes.unwrap_or_default().into_iter().map(|raw| self.attribute(raw));
        let attributes = attributes.collect::<Result<_, _>>()?;
        Ok(RexsComponent { id: text(id), kind: kind_of_today(&text(kind)), name: text(name), line, attributes })
    }

    fn attribute(&mut self, raw: &RawValue) -> Result<Attribute, RexsError> {
        let line = self.line(raw);
        let given: JsonAttribute = serde_json::from_str(raw.get()).map_err(|error| unreadable(line, &error))?;
        let scalar = given.floating_point.or(given.integer).or(given.boolean).or(given.word).or(given.string);
        let numbers = given.floating_point_array.unwrap_or_default().into_iter().collect::<Option<_>>();
        Ok(Attribute {
            id: text(given.id),
            unit: text(given.unit),
            text: text(scalar),
            numbers: numbers.unwrap_or_default(),
            line,
        })
    }
}

/// The error of a part that begins on `line`.
fn unreadable(line: usize, error: &serde_json::Error) -> RexsError {
    RexsError::NoModel {
        line: line + error.line().saturating_sub(1),
        found: format!("JSON that cannot be read ({error})"),
    }
}
