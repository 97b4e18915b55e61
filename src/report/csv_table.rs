//! How the CSV files are written: any record is a row.
//!
//! A file begins with lines that start with `#`: program version and scene hash, then what every column holds. Columns are
//! named as the fields of their record, and the documentation of a field is what the file says of its column. Numbers are
//! the shortest decimals that read back as the same bits; a value that was not computed is an empty field.

use std::io::{self, Write};

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::Value;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Provenance<'a> {
    program_version: &'a str,
    /// What kind of input it was: `scene`, `problem`.
    input: &'a str,
    hash: &'a str,
}

impl<'a> Provenance<'a> {
    pub(crate) fn of_scene(program_version: &'a str, hash: &'a str) -> Self {
        Self { program_version, input: "scene", hash }
    }

    pub(crate) fn of_problem(program_version: &'a str, hash: &'a str) -> Self {
        Self { program_version, input: "problem", hash }
    }
}

pub(crate) type Column = (String, String);

/// The columns of a record, in the order of its fields.
pub(crate) fn columns<R: JsonSchema>() -> Vec<Column> {
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
pub(crate) fn variants<E: JsonSchema>() -> Vec<Column> {
    let schema = schemars::schema_for!(E);
    let all = schema.as_value()["oneOf"].as_array().into_iter().flatten();
    all.map(|one| ["const", "description"].map(|key| one[key].as_str().unwrap_or_default().to_owned()).into()).collect()
}

pub(crate) fn table<R: Serialize + JsonSchema>(
    out: &mut dyn Write,
    provenance: Provenance,
    rows: impl IntoIterator<Item = R>,
) -> io::Result<()> {
    table_of(out, provenance, &columns::<R>(), rows)
}

/// Writes a table whose columns are not known before the program runs.
pub(crate) fn table_of(
    out: &mut dyn Write,
    provenance: Provenance,
    columns: &[Column],
    rows: impl IntoIterator<Item = impl Serialize>,
) -> io::Result<()> {
    writeln!(out, "# gearwear {}, {} {}", provenance.program_version, provenance.input, provenance.hash)?;
    for (name, meaning) in columns {
        writeln!(out, "# {name}: {meaning}")?;
    }
    let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    csv.write_record(columns.iter().map(|(name, _)| name))?;
    for row in rows {
        csv.serialize(row)?;
    }
    csv.flush()
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
    fn a_record_says_what_its_columns_hold() {
        let mut text = Vec::new();
        let rows = [Row { width_mm: 1.0, depth: None, _own: () }, Row { width_mm: 0.1, depth: Some(1e-7), _own: () }];
        table(&mut text, Provenance::of_scene("1.2.3", "abc"), rows).unwrap();
        let wanted = "# gearwear 1.2.3, scene abc\n# width_mm: place on the flank\n# depth_um: of it; empty where not known\n\
                      width_mm,depth_um\n1.0,\n0.1,1e-7\n";
        assert_eq!(String::from_utf8(text).unwrap(), wanted);
    }

    #[test]
    fn a_table_without_rows_has_its_columns() {
        let mut text = Vec::new();
        table(&mut text, Provenance::of_problem("1.2.3", "abc"), Vec::<Row>::new()).unwrap();
        assert!(String::from_utf8(text).unwrap().ends_with("\nwidth_mm,depth_um\n"));
    }
}
