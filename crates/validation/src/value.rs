//! Results of a run as a tree of names: groups, numbers, texts, and columns of numbers.
//!
//! The names are those of the output files, since the tree is read from them: `summary.json` as JSON, the tables as CSV. An
//! expression of a case thus says what a user would look up in the files of `gearwear run`.

use std::collections::BTreeMap;
use std::sync::Arc;

/// Node of the tree; copies share its contents.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number; NaN where the output has none.
    Number(f64),
    /// A truth value.
    Truth(bool),
    /// A text.
    Text(String),
    /// A column of a table, or a list of numbers.
    Column(Arc<[f64]>),
    /// Any other list.
    List(Arc<[Value]>),
    /// Names with their values.
    Group(Arc<BTreeMap<String, Value>>),
}

impl Value {
    pub fn column(numbers: impl IntoIterator<Item = f64>) -> Self {
        Self::Column(numbers.into_iter().collect())
    }

    pub fn group<N: Into<String>>(entries: impl IntoIterator<Item = (N, Value)>) -> Self {
        Self::Group(Arc::new(entries.into_iter().map(|(name, value)| (name.into(), value)).collect()))
    }

    /// Adds a name to a group; other values are left as they are.
    pub fn add(&mut self, name: &str, value: Value) {
        if let Self::Group(entries) = self {
            Arc::make_mut(entries).insert(name.to_owned(), value);
        }
    }

    /// From JSON; `null` is no number.
    pub fn of_json(json: serde_json::Value) -> Self {
        use serde_json::Value as Json;
        match json {
            Json::Null => Self::Number(f64::NAN),
            Json::Bool(truth) => Self::Truth(truth),
            Json::Number(number) => Self::Number(number.as_f64().unwrap_or(f64::NAN)),
            Json::String(text) => Self::Text(text),
            Json::Array(items) if !items.is_empty() && items.iter().all(|item| item.is_number() || item.is_null()) => {
                Self::column(items.iter().map(|item| item.as_f64().unwrap_or(f64::NAN)))
            }
            Json::Array(items) => Self::List(items.into_iter().map(Self::of_json).collect()),
            Json::Object(entries) => Self::group(entries.into_iter().map(|(name, json)| (name, Self::of_json(json)))),
        }
    }

    /// From one of the program's own tables: lines with `#`, a line of names, rows.
    pub fn of_csv(bytes: &[u8]) -> Result<Self, csv::Error> {
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(bytes);
        let names: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
        let mut columns: Vec<Vec<String>> = vec![Vec::new(); names.len()];
        for row in reader.records() {
            for (column, field) in columns.iter_mut().zip(row?.iter()) {
                column.push(field.to_owned());
            }
        }
        Ok(Self::group(names.into_iter().zip(columns.into_iter().map(Self::of_fields))))
    }

    fn of_fields(fields: Vec<String>) -> Self {
        match fields.iter().map(|field| number_of_field(field)).collect::<Option<Arc<[f64]>>>() {
            Some(numbers) => Self::Column(numbers),
            None => Self::List(fields.into_iter().map(Self::Text).collect()),
        }
    }

    pub fn of_toml(value: &toml::Value) -> Self {
        match value {
            toml::Value::Integer(whole) => Self::Number(*whole as f64),
            toml::Value::Float(number) => Self::Number(*number),
            toml::Value::Boolean(truth) => Self::Truth(*truth),
            toml::Value::String(text) => Self::Text(text.clone()),
            other => Self::Text(other.to_string()),
        }
    }
}

/// Number of a cell; NaN where it is empty, 1 or 0 of a truth value.
fn number_of_field(field: &str) -> Option<f64> {
    match field {
        "" => Some(f64::NAN),
        "true" => Some(1.0),
        "false" => Some(0.0),
        text => text.parse().ok(),
    }
}

/// Why a function of columns has no value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ColumnError {
    #[error("columns of {0} and {1} points do not go together")]
    Lengths(usize, usize),
    #[error("lists of different lengths, {0} and {1}")]
    ListLengths(usize, usize),
    #[error("the column has no points")]
    Empty,
    #[error("{place} lies outside the column, {from} to {to}")]
    Outside { place: f64, from: f64, to: f64 },
    #[error("the column never passes {0}")]
    NeverPasses(f64),
    #[error("a column is made of numbers")]
    NotNumbers,
    #[error("the places of a profile must rise")]
    NotRising,
    #[error("a profile of {0} points has no cubic form")]
    NoForm(usize),
}

pub(crate) fn same_length(x: &[f64], y: &[f64]) -> Result<(), ColumnError> {
    if x.len() == y.len() { Ok(()) } else { Err(ColumnError::Lengths(x.len(), y.len())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_and_json_keep_their_names() {
        let table = Value::of_csv(b"# a remark\nx_mm,gear,at_edge,rise\n1.5,pinion,true,\n2,wheel,false,3\n").unwrap();
        let Value::Group(columns) = &table else { panic!("{table:?}") };
        assert_eq!(columns["x_mm"], Value::column([1.5, 2.0]));
        assert_eq!(columns["at_edge"], Value::column([1.0, 0.0]));
        assert_eq!(columns["gear"], Value::List([Value::Text("pinion".into()), Value::Text("wheel".into())].into()));
        let Value::Column(rise) = &columns["rise"] else { panic!("{:?}", columns["rise"]) };
        assert!(rise[0].is_nan() && rise[1] == 3.0);

        let json = serde_json::json!({ "a": { "b": [1, 2.5], "c": null, "d": "t", "e": [] } });
        let Value::Group(top) = Value::of_json(json) else { panic!() };
        let Value::Group(a) = &top["a"] else { panic!() };
        assert_eq!(a["b"], Value::column([1.0, 2.5]));
        assert!(matches!(a["c"], Value::Number(x) if x.is_nan()));
        assert_eq!(a["e"], Value::List([].into()));
    }
}
