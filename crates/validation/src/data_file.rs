//! Files of numbers beside a case: CSV with lines of `#` remarks and a line of column names. Columns whose name begins with
//! `uncertainty` hold positive numbers.

use std::io;
use std::path::Path;

use super::case_file::DataSpec;
use super::value::Value;
use gearwear_files::data_table::{DataTable, finite, positive};
use gearwear_files::size_limit::SizeLimit;

/// Size of a file of numbers.
const MOST: SizeLimit = SizeLimit { of: "a file of numbers", megabytes: 64 };

/// Columns of the file, as a group; `None` where it is missing and may be.
///
/// # Errors
/// The fault of the file, with its name.
pub(super) fn read(spec: &DataSpec, folder: &Path) -> Result<Option<Value>, String> {
    let path = folder.join(&spec.file);
    let text = match MOST.read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound && spec.missing.is_some() => return Ok(None),
        Err(error) => return Err(format!("{}: cannot be read: {error}", spec.file)),
    };
    columns(spec, &text).map(Some).map_err(|fault| format!("{}: {fault}", spec.file))
}

fn columns(spec: &DataSpec, text: &str) -> Result<Value, String> {
    let table = DataTable::read(text, || spec.columns.join(", ")).map_err(|error| error.to_string())?;
    let (line, names) = &table.names;
    let mut columns = Vec::new();
    for wanted in &spec.columns {
        let Some(place) = names.iter().position(|name| name == wanted) else {
            return Err(format!("line {line}: found columns {}; allowed: {wanted} among them", names.join(", ")));
        };
        let read = if wanted.starts_with("uncertainty") { positive } else { finite };
        let fields = table.rows.iter().map(|(line, fields)| (*line, fields.get(place).copied().unwrap_or_default()));
        let numbers: Result<Vec<f64>, _> = fields.map(|(line, field)| read(line, wanted, field)).collect();
        let numbers = numbers.map_err(|error| error.to_string())?;
        if numbers.is_empty() {
            return Err("found no row; allowed: at least one".to_owned());
        }
        columns.push((wanted.clone(), Value::column(numbers)));
    }
    Ok(Value::group(columns))
}
