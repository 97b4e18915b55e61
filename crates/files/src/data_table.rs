//! Tables of users: comma-separated values under a line of column names, with further data in lines `# key = value`.
//!
//! Other lines that begin with `#` are remarks, and empty lines are ignored. Errors tell the line, what was found and what is allowed.

/// Error in a table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DataTableError {
    /// A value or a header is not allowed.
    #[error("line {line}: {column}: found {found}; allowed: {allowed}")]
    NotAllowed {
        /// Line of the file, from 1.
        line: usize,
        /// Column, or key of a header line.
        column: String,
        /// Text of the file.
        found: String,
        /// Allowed values.
        allowed: String,
    },
    /// A required line or key is missing.
    #[error("{what} is missing; allowed: {allowed}")]
    Missing {
        /// Name of the missing part.
        what: String,
        /// Allowed form.
        allowed: String,
    },
}

/// Number of a line, from 1, and its fields.
pub type Line<'a> = (usize, Vec<&'a str>);

/// Table divided into fields.
#[derive(Debug, Clone, PartialEq)]
pub struct DataTable<'a> {
    /// Line, key and value of each `# key = value`.
    pub keys: Vec<(usize, &'a str, &'a str)>,
    /// Names of the columns.
    pub names: Line<'a>,
    /// Rows below the names.
    pub rows: Vec<Line<'a>>,
}

impl<'a> DataTable<'a> {
    /// Divides `text` into fields; an error names the columns of `names_allowed` where the line of column names is missing.
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

/// Finite number in a field.
pub fn finite(line: usize, column: &str, text: &str) -> Result<f64, DataTableError> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(not_allowed(line, column, or_nothing(text), "a finite number".to_owned())),
    }
}

/// Finite number greater than 0 in a field.
pub fn positive(line: usize, column: &str, text: &str) -> Result<f64, DataTableError> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err(not_allowed(line, column, or_nothing(text), "a number greater than 0".to_owned())),
    }
}

fn or_nothing(text: &str) -> &str {
    if text.is_empty() { "nothing" } else { text }
}

/// Error for a value that is not allowed.
pub fn not_allowed(line: usize, column: &str, found: impl ToString, allowed: String) -> DataTableError {
    DataTableError::NotAllowed { line, column: column.to_owned(), found: found.to_string(), allowed }
}

/// Error for a missing line or key.
pub fn missing(what: &str, allowed: String) -> DataTableError {
    DataTableError::Missing { what: what.to_owned(), allowed }
}
