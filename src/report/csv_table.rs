//! How the CSV files are written: any record is a row, and the first line names the columns.
//!
//! Columns are named as the fields of their record, and the documentation of a field is what `columns.json` beside the files says of its
//! column. Numbers are the shortest decimals that read back as the same bits; a value that was not computed is an empty field.

use crate::report::output_files;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use serde_json::Value;

use super::files::{ReportError, place, write_json};

/// The name of a column and what it holds.
pub type Column = (String, String);

/// What was computed: the kind of its input, `scene` or `problem`, with its hash, and by which version of the program.
#[derive(Debug, Clone, Copy)]
pub struct Provenance<'a> {
    /// Key of the hash.
    input: &'a str,
    hash: &'a str,
    program_version: &'a str,
}

impl<'a> Provenance<'a> {
    pub fn of_scene(program_version: &'a str, hash: &'a str) -> Self {
        Self { program_version, input: "scene_hash", hash }
    }

    pub fn of_problem(program_version: &'a str, hash: &'a str) -> Self {
        Self { program_version, input: "problem_hash", hash }
    }
}

/// The CSV files of a folder as they are written.
pub struct CsvFiles<'a> {
    dir: &'a Path,
    provenance: Provenance<'a>,
    /// By file.
    columns: Vec<(String, InOrder<String>)>,
}

/// A JSON object whose keys stand in this order.
struct InOrder<V>(Vec<(String, V)>);

impl<V: Serialize> Serialize for InOrder<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        self.0.iter().try_for_each(|(key, value)| map.serialize_entry(key, value))?;
        map.end()
    }
}

impl<'a> CsvFiles<'a> {
    pub fn new(dir: &'a Path, provenance: Provenance<'a>) -> Self {
        Self { dir, provenance, columns: Vec::new() }
    }

    /// Writes a file with `fill`, which says what its columns hold.
    pub fn place(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<Vec<Column>>,
    ) -> Result<PathBuf, ReportError> {
        let mut columns = Vec::new();
        let path = place(self.dir, name, |out| {
            columns = fill(out)?;
            Ok(())
        })?;
        self.columns.push((name.to_owned(), InOrder(columns)));
        Ok(path)
    }

    /// Writes what the columns of all files hold.
    pub fn finish(self) -> Result<PathBuf, ReportError> {
        #[derive(Serialize)]
        struct Columns<'a> {
            program_version: &'a str,
            #[serde(flatten)]
            input: InOrder<&'a str>,
            files: InOrder<InOrder<String>>,
        }
        let Provenance { program_version, input, hash } = self.provenance;
        let input = InOrder(vec![(input.to_owned(), hash)]);
        let columns = Columns { program_version, input, files: InOrder(self.columns) };
        place(self.dir, output_files::COLUMNS, |out| write_json(out, &columns))
    }
}

/// The columns of a record, in the order of its fields.
pub fn columns<R: JsonSchema>() -> Vec<Column> {
    let schema = SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<R>();
    let schema = schema.as_value();
    // Properties stand by name; what is required, which is all that is written, stands in the order of the fields.
    let names = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    names
        .map(|name| {
            let meaning = schema["properties"][name]["description"].as_str().unwrap_or_default();
            (name.to_owned(), meaning.replace('\n', " "))
        })
        .collect()
}

/// The variants of an enumeration with what their documentation says, in their order.
pub fn variants<E: JsonSchema>() -> Vec<Column> {
    let schema = schemars::schema_for!(E);
    let all = schema.as_value()["oneOf"].as_array().into_iter().flatten();
    all.map(|one| ["const", "description"].map(|key| one[key].as_str().unwrap_or_default().to_owned()).into()).collect()
}

/// Writes records as a table; what its columns hold.
pub fn table<R: Serialize + JsonSchema>(
    out: &mut dyn Write,
    rows: impl IntoIterator<Item = R>,
) -> io::Result<Vec<Column>> {
    table_of(out, columns::<R>(), rows)
}

/// Writes a table whose columns are not known before the program runs.
pub fn table_of(
    out: &mut dyn Write,
    columns: Vec<Column>,
    rows: impl IntoIterator<Item = impl Serialize>,
) -> io::Result<Vec<Column>> {
    let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    csv.write_record(columns.iter().map(|(name, _)| name))?;
    for row in rows {
        csv.serialize(row)?;
    }
    csv.flush()?;
    Ok(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize, JsonSchema)]
    struct Row {
        /// place on
        /// the flank
        width_mm: f64,
        /// of it; empty where not known
        #[serde(rename = "depth_um")]
        depth: Option<f64>,
        #[serde(skip)]
        _own: (),
    }

    #[test]
    fn a_record_is_a_row_and_says_what_its_columns_hold() {
        let dir = tempfile::tempdir().unwrap();
        let mut files = CsvFiles::new(dir.path(), Provenance::of_scene("1.2.3", "abc"));
        let rows = [Row { width_mm: 1.0, depth: None, _own: () }, Row { width_mm: 0.1, depth: Some(1e-7), _own: () }];
        let path = files.place("rows.csv", |out| table(out, rows)).unwrap();
        assert_eq!(std::fs::read_to_string(path).unwrap(), "width_mm,depth_um\n1.0,\n0.1,1e-7\n");
        let text = std::fs::read_to_string(files.finish().unwrap()).unwrap();
        let columns: Value = serde_json::from_str(&text).unwrap();
        assert_eq!([&columns["program_version"], &columns["scene_hash"]], ["1.2.3", "abc"]);
        assert_eq!(columns["files"]["rows.csv"]["depth_um"], "of it; empty where not known");
        assert!(text.find("width_mm") < text.find("depth_um"), "in the order of the file: {text}");
    }

    #[test]
    fn a_table_without_rows_has_its_columns() {
        let mut text = Vec::new();
        table(&mut text, Vec::<Row>::new()).unwrap();
        assert_eq!(text, b"width_mm,depth_um\n");
    }
}
