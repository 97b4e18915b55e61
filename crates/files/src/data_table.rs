//! Tables of users: values under a line of column names, with further data in lines `# key = value`.
//!
//! Columns are apart by semicolons, tabs or commas, whichever of them, in this order, the line of names has. Fields may stand in double
//! quotes, and numbers may have a decimal comma; where columns are apart by commas only in quotes. Other lines that begin with `#` are
//! remarks, and empty lines are ignored. Errors tell the line, what was found and what is allowed.

/// Separators of columns, the first that a line of names has before the others.
const SEPARATORS: [char; 3] = [';', '\t', ','];

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
        let lines = (1..).zip(text.trim_start_matches('\u{feff}').lines());
        let (mut keys, mut separator, mut names, mut rows) = (Vec::new(), ',', None, Vec::new());
        for (line, content) in lines {
            if let Some(remark) = content.trim_start().strip_prefix('#') {
                keys.extend(remark.split_once('=').map(|(key, value)| (line, key.trim(), value.trim())));
            } else if content.trim().is_empty() {
            } else if names.is_none() {
                separator = SEPARATORS.into_iter().find(|&one| fields(content, one).len() > 1).unwrap_or(separator);
                names = Some((line, fields(content, separator)));
            } else {
                rows.push((line, fields(content, separator)));
            }
        }
        let names = names.ok_or_else(|| missing("the line of column names", names_allowed()))?;
        Ok(Self { keys, names, rows })
    }
}

/// Fields of a line, without the quotes around them.
fn fields(line: &str, separator: char) -> Vec<&str> {
    let (mut fields, mut start, mut is_quoted) = (Vec::new(), 0, false);
    for (at, letter) in line.char_indices() {
        if letter == '"' {
            is_quoted = !is_quoted;
        } else if letter == separator && !is_quoted {
            fields.push(&line[start..at]);
            start = at + letter.len_utf8();
        }
    }
    fields.push(&line[start..]);
    fields.into_iter().map(without_quotes).collect()
}

fn without_quotes(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').and_then(|field| field.strip_suffix('"')).map_or(field, str::trim)
}

/// The finite number that `text` is, with a decimal point or comma.
pub fn number(text: &str) -> Option<f64> {
    let with_point;
    let text = match text.split_once(',') {
        Some((whole, decimals)) if !text.contains('.') => {
            with_point = format!("{whole}.{decimals}");
            &with_point
        }
        _ => text,
    };
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Finite number in a field.
pub fn finite(line: usize, column: &str, text: &str) -> Result<f64, DataTableError> {
    number(text).ok_or_else(|| not_allowed(line, column, or_nothing(text), "a finite number".to_owned()))
}

/// Finite number greater than 0 in a field.
pub fn positive(line: usize, column: &str, text: &str) -> Result<f64, DataTableError> {
    let positive = number(text).filter(|&value| value > 0.0);
    positive.ok_or_else(|| not_allowed(line, column, or_nothing(text), "a number greater than 0".to_owned()))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_quotes_and_decimal_commas() {
        for (text, row) in [
            ("a,b\n1.5,2\n", ["1.5", "2"]),
            ("# k = v\na;b\n1,5;2\n", ["1,5", "2"]),
            ("a\tb\n\t2\n", ["", "2"]),
            ("\"a, x\";\"b\"\r\n\"1,5\";2\r\n", ["1,5", "2"]),
            ("\"a\",\"b\"\n\"1,5\",\"2\"\n", ["1,5", "2"]),
        ] {
            let table = DataTable::read(text, String::new).unwrap();
            assert_eq!((table.names.1.len(), &table.rows[0].1[..]), (2, &row[..]), "{text}");
        }
        let numbers = ["1,5", "1.5", "-,5e1", "1,000.5", "1,2,3", "inf", ""].map(number);
        assert_eq!(numbers, [Some(1.5), Some(1.5), Some(-5.0), None, None, None, None]);
    }
}
