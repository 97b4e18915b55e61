//! Checks a file, key by key, against its schema: names, types and ranges.
//!
//! Nothing stops at the first problem. What is wrong is reported and taken out, or replaced where the file cannot do
//! without it, so that the rest can be checked further; what came of such a file is never used.

use toml::{Table, Value};

use super::decimal_comma;
use super::findings::Findings;
use super::locate::join;
use super::nearest::nearest;
use super::outside_model;
use super::problem::{ProblemKind, number, words};
use super::schema::Node;

/// Keys and tables that a file may hold.
#[derive(Debug, Clone, Copy)]
pub(super) struct FileShape {
    /// Schema of the file.
    pub root: Node<'static>,
    /// Keys of other files, each with what to do instead.
    pub of_other_files: &'static [(&'static str, &'static str)],
}

/// The part of `table` that has the right shape; the rest is reported.
pub(super) fn check(format: FileShape, table: &Table, findings: &mut Findings) -> Table {
    check_table(format, format.root, table, "", findings)
}

fn check_table(format: FileShape, node: Node<'_>, table: &Table, path: &str, findings: &mut Findings) -> Table {
    let mut sound = Table::new();
    for (name, value) in table {
        let key = join(path, name);
        match node.child(name) {
            Some(child) => {
                if let Some(value) = check_value(format, child, value, &key, findings) {
                    sound.insert(name.clone(), value);
                }
            }
            None => unknown_key(format, node, (name, value), &key, path, findings),
        }
    }
    for name in node.required() {
        let Some(child) = node.child(name) else { continue };
        if !table.contains_key(name) {
            findings.missing(&[&join(path, name)], &child.allowed());
        }
        // The key is reported; a stand-in lets the rest of the file be checked.
        sound.entry(name).or_insert_with(|| stand_in(child));
    }
    sound
}

/// Any value of the right shape.
fn stand_in(node: Node<'_>) -> Value {
    match (node.type_name(), node.choices().first()) {
        (_, Some(&choice)) => Value::String(choice.to_owned()),
        ("object", _) => {
            let required = node.required().into_iter();
            let table = required.filter_map(|name| Some((name.to_owned(), stand_in(node.child(name)?))));
            Value::Table(table.collect())
        }
        ("array", _) => Value::Array(Vec::new()),
        ("string", _) => Value::String(String::new()),
        ("integer", _) => Value::Integer(1),
        _ => Value::Float(1.0),
    }
}

fn check_value(format: FileShape, node: Node<'_>, value: &Value, key: &str, findings: &mut Findings) -> Option<Value> {
    let node = node.variant(value);
    match (node.type_name(), value) {
        ("object", Value::Table(table)) => Some(Value::Table(check_table(format, node, table, key, findings))),
        ("array", Value::Array(items)) => check_items(format, node, items, key, findings),
        ("boolean", Value::Boolean(_)) => Some(value.clone()),
        ("string", Value::String(text)) => check_text(node, text, key, findings),
        ("integer", Value::Integer(n)) => check_number(node, *n as f64, value, key, findings),
        ("number", Value::Integer(n)) => check_number(node, *n as f64, value, key, findings),
        ("number", Value::Float(x)) => check_number(node, *x, value, key, findings),
        _ => {
            findings.problem(ProblemKind::WrongType, key, words(value), node.allowed());
            if value.is_table() && node.items().is_some_and(|item| item.type_name() == "object") {
                findings.help(format!("there may be several: write [[{key}]] for each"));
            }
            let number = value.as_str().filter(|_| matches!(node.type_name(), "number" | "integer"));
            if let Some(help) = number.and_then(decimal_comma::help) {
                findings.help(format!("{help}, without quotes"));
            }
            None
        }
    }
}

fn check_items(
    format: FileShape,
    node: Node<'_>,
    items: &[Value],
    key: &str,
    findings: &mut Findings,
) -> Option<Value> {
    let item_node = node.items()?;
    if node.length().is_some_and(|length| length != items.len()) {
        findings.problem(ProblemKind::WrongType, key, format!("a list of {}", items.len()), node.allowed());
        return None;
    }
    let checked: Vec<Value> = items
        .iter()
        .enumerate()
        .filter_map(|(index, item)| check_value(format, item_node, item, &format!("{key}[{index}]"), findings))
        .collect();
    if checked.len() == items.len() {
        Some(Value::Array(checked))
    } else {
        findings.spoil(key);
        None
    }
}

fn check_text(node: Node<'_>, text: &str, key: &str, findings: &mut Findings) -> Option<Value> {
    let choices = node.choices();
    if choices.is_empty() || choices.contains(&text) {
        return Some(Value::String(text.to_owned()));
    }
    findings.not_allowed(key, format!("{text:?}"), node.allowed());
    if let Some(near) = nearest(text, &choices) {
        findings.help(format!("did you mean {near:?}?"));
    }
    None
}

fn check_number(node: Node<'_>, x: f64, value: &Value, key: &str, findings: &mut Findings) -> Option<Value> {
    if node.holds(x) {
        return Some(value.clone());
    }
    findings.not_allowed(key, number(x), node.allowed());
    if let Some(reason) = outside_model::reason(key, x) {
        findings.help(reason);
    }
    None
}

fn unknown_key(
    format: FileShape,
    node: Node<'_>,
    (name, value): (&str, &Value),
    key: &str,
    path: &str,
    findings: &mut Findings,
) {
    if let Some((_, instead)) = format.of_other_files.iter().find(|(other, _)| *other == key) {
        return findings.problem(ProblemKind::NotAvailable, key, "this key", *instead);
    }
    let known = node.keys();
    findings.problem(ProblemKind::UnknownKey, key, name, known.join(", "));
    let elsewhere = tables_with(format.root, name, "");
    let given = value.as_float().or_else(|| value.as_integer().map(|n| n as f64));
    if let Some(reason) = outside_model::reason_of_key(name) {
        findings.help(reason);
    } else if let Some(converted) = outside_model::converted(name, given).filter(|to| known.contains(&&*to.name)) {
        findings.help(converted.sentence);
        findings.spoil(&join(path, &converted.name));
    } else if !elsewhere.is_empty() {
        findings.help(format!("{name} belongs in {}", elsewhere.join(" or ")));
    } else if let Some(near) = nearest(name, &known) {
        findings.help(format!("did you mean {near}?"));
        findings.spoil(&join(path, near));
    }
}

/// Headers of the tables that have a key called `name`.
fn tables_with(node: Node<'_>, name: &str, path: &str) -> Vec<String> {
    let mut found = Vec::new();
    for key in node.keys() {
        let Some(child) = node.child(key) else { continue };
        let path = join(path, key);
        let (table, header) = match child.items() {
            Some(item) => (item, format!("[[{path}]]")),
            None => (child, format!("[{path}]")),
        };
        if table.child(name).is_some() {
            found.push(header);
        }
        found.extend(tables_with(table, name, &path));
    }
    found
}
