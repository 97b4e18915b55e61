//! Tables that users bring: comma-separated values under a line of column names, and lines `# key = value` that say more of them.
//!
//! Other lines that begin with `#` are remarks, and empty lines are nothing. What the keys and columns mean is the reader's matter; what
//! is wrong is said with its line, what was found and what is allowed.

/// What is wrong with a table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DataTableError {
    /// A value, or a header, that is not allowed.
    #[error("line {line}: {column}: found {found}; allowed: {allowed}")]
    NotAllowed {
        /// Line of the file, from 1.
        line: usize,
        /// Column, or key of a header line.
        column: String,
        /// What stands there.
        found: String,
        /// What may stand there.
        allowed: String,
    },
    /// Something that must be there is not.
    #[error("{what} is missing; allowed: {allowed}")]
    Missing {
        /// What.
        what: String,
        /// How it looks.
        allowed: String,
    },
}

/// Fields of a line, with its number from 1.
pub type Line<'a> = (usize, Vec<&'a str>);

/// A table, cut into fields.
#[derive(Debug, Clone, PartialEq)]
pub struct DataTable<'a> {
    /// Line, key and value of each `# key = value`.
    pub keys: Vec<(usize, &'a str, &'a str)>,
    /// Names of the columns.
    pub names: Line<'a>,
    /// The rows below.
    pub rows: Vec<Line<'a>>,
}

impl<'a> DataTable<'a> {
    /// Cuts up `text`; without a line of column names it is refused, and told `names_allowed`.
    pub fn read(text: &'a str, names_allowed: impl FnOnce() -> String) -> Result<Self, DataTableError> {
        let (mut keys, mut rows) = (Vec::new(), Vec::new());
        for (line, content) in (1..).zip(text.trim_start_matches('\u{feff}').lines().map(str::trim)) {
            match content.strip_prefix('#') {
                Some(remark) => {
                    keys.extend(remark.split_once('=').map(|(key, value)| (line, key.trim(), value.trim())));
                }
                None if content.is_empty() => {}
                None => rows.push((line, content.split(',').map(str::trim).collect())),
            }
        }
        let mut rows = rows.into_iter();
        let names = rows.next().ok_or_else(|| missing("the line of column names", names_allowed()))?;
        Ok(Self { keys, names, rows: rows.collect() })
    }
}

/// A finite number.
pub fn finite(line: usize, column: &str, text: &str) -> Result<f64, DataTableError> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(not_allowed(line, column, or_nothing(text), "a finite number".to_owned())),
    }
}

/// A finite number greater than 0.
pub fn positive(line: usize, column: &str, text: &str) -> Result<f64, DataTableError> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err(not_allowed(line, column, or_nothing(text), "a number greater than 0".to_owned())),
    }
}

fn or_nothing(text: &str) -> &str {
    if text.is_empty() { "nothing" } else { text }
}

/// A value that is not allowed.
pub fn not_allowed(line: usize, column: &str, found: impl ToString, allowed: String) -> DataTableError {
    DataTableError::NotAllowed { line, column: column.to_owned(), found: found.to_string(), allowed }
}

/// Something that is missing.
pub fn missing(what: &str, allowed: String) -> DataTableError {
    DataTableError::Missing { what: what.to_owned(), allowed }
}
