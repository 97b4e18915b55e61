//! Files of numbers beside a case: CSV with lines of `#` remarks and a line of column names. Columns whose name begins with
//! `uncertainty` hold positive numbers.

use std::fs;
use std::io;
use std::path::Path;

use super::case_file::DataSpec;
use super::value::Value;
use crate::data_table::{DataTable, finite, positive};

/// The columns of the file, as a group; `None` where it is missing and may be.
///
/// # Errors
/// In words: what is wrong with it.
pub(super) fn read(spec: &DataSpec, folder: &Path) -> Result<Option<Value>, String> {
    let path = folder.join(&spec.file);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound && spec.missing.is_some() => return Ok(None),
        Err(error) => return Err(format!("{}: cannot be read: {error}", spec.file)),
    };
    let said = |error: crate::data_table::DataTableError| format!("{}: {error}", spec.file);
    let table = DataTable::read(&text, || spec.columns.join(", ")).map_err(said)?;
    let (line, names) = &table.names;
    let mut columns = Vec::new();
    for wanted in &spec.columns {
        let Some(place) = names.iter().position(|name| name == wanted) else {
            return Err(format!(
                "{}: line {line}: found columns {}; allowed: {wanted} among them",
                spec.file,
                names.join(", ")
            ));
        };
        let read = if wanted.starts_with("uncertainty") { positive } else { finite };
        let number = |(line, fields): &(usize, Vec<&str>)| {
            read(*line, wanted, fields.get(place).copied().unwrap_or_default()).map_err(said)
        };
        let numbers = table.rows.iter().map(number).collect::<Result<Vec<f64>, _>>()?;
        if numbers.is_empty() {
            return Err(format!("{}: found no row; allowed: at least one", spec.file));
        }
        columns.push((wanted.clone(), Value::column(numbers)));
    }
    Ok(Some(Value::group(columns)))
}
