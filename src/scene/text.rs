//! From a file's text to a table with the places of its keys, and from a sound table to the file's structure.

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::decimal_comma;
use super::findings::Findings;
use super::locate::Locator;
use super::problem::{Problem, ProblemKind};

/// The file as a table, and findings that know where each key stands.
pub(super) fn parse(text: &str) -> Result<(Table, Findings), Vec<Problem>> {
    let table = text.parse().map_err(|error| syntax(&error, text))?;
    let locator = Locator::new(text).map_err(|error| syntax(&error, text))?;
    Ok((table, Findings::new(locator)))
}

fn syntax(error: &toml::de::Error, text: &str) -> Vec<Problem> {
    let span = error.span().unwrap_or(text.len()..text.len());
    let commas = decimal_comma::problems(text, span.start);
    if !commas.is_empty() {
        return commas;
    }
    let help = "is the file complete? texts need quotes, lists need both brackets, a key stands once";
    vec![Problem {
        kind: ProblemKind::Syntax,
        key: String::new(),
        found: error.message().replace('\n', ", "),
        allowed: "TOML: [table] headers and lines of key = value".to_owned(),
        help: Some(help.to_owned()),
        span: Some(span),
    }]
}

/// A table whose shape was checked, as the structure `F` it was checked for.
pub(super) fn typed<F: DeserializeOwned>(sound: Table, findings: &mut Findings) -> Option<F> {
    match serde_path_to_error::deserialize(Value::Table(sound)) {
        Ok(file) => Some(file),
        Err(error) => {
            // The table was checked against the schema of this structure; an error here shows that the two differ.
            let key = error.path().to_string();
            let found = error.into_inner().message().to_owned();
            findings.problem(ProblemKind::WrongType, &key, found, "what gearwear schema says");
            None
        }
    }
}
