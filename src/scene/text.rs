//! From a file's text to a table with the places of its keys, and from a sound table to the file's structure.

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::findings::Findings;
use super::locate::Locator;
use super::problem::{Problem, ProblemKind};

/// The file as a table, and findings that know where each key stands.
pub(super) fn parse(text: &str) -> Result<(Table, Findings), Vec<Problem>> {
    let read = || -> Result<(Table, Locator), toml::de::Error> { Ok((text.parse()?, Locator::new(text)?)) };
    let (table, locator) = read().map_err(|error| vec![syntax(&error, text)])?;
    Ok((table, Findings::new(locator)))
}

fn syntax(error: &toml::de::Error, text: &str) -> Problem {
    let span = error.span().unwrap_or(text.len()..text.len());
    let help = match has_decimal_comma(text, span.start) {
        true => "decimals stand after a point: 30.5, not 30,5",
        false => "is the file complete? texts need quotes, lists need both brackets, a key stands once",
    };
    Problem {
        kind: ProblemKind::Syntax,
        key: String::new(),
        found: error.message().replace('\n', ", "),
        allowed: "TOML: [table] headers and lines of key = value".to_owned(),
        help: Some(help.to_owned()),
        span: Some(span),
    }
}

/// Whether a comma between digits stands at `at`.
fn has_decimal_comma(text: &str, at: usize) -> bool {
    let bytes = text.as_bytes();
    let is_digit = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_digit);
    bytes.get(at) == Some(&b',') && is_digit(at.checked_sub(1)) && is_digit(Some(at + 1))
}

/// A table whose shape was checked, as the structure `F` it was checked for.
pub(super) fn typed<F: DeserializeOwned>(sound: Table, findings: &mut Findings) -> Option<F> {
    match serde_path_to_error::deserialize(Value::Table(sound)) {
        Ok(file) => Some(file),
        Err(error) => {
            // The shape was checked against the schema of this same structure; should the two differ, this tells.
            let key = error.path().to_string();
            let found = error.into_inner().message().to_owned();
            findings.problem(ProblemKind::WrongType, &key, found, "what gearwear schema says");
            None
        }
    }
}
