//! `sweep.parquet`: the table of a sweep for programs that read columns.
//!
//! Columns are those of `sweep.csv`: whole numbers as INT64, numbers as DOUBLE, texts as UTF-8, each nullable. Program
//! version, scene hash and the meaning of every column (`column:NAME`) are in the metadata of the file. One row group, plain
//! encoding or dictionaries as the library chooses, not compressed.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;

use super::tables::{SweepColumn, columns};
use crate::report::columns::Cell;
use crate::sweep::record::SweepRecord;

/// The whole file.
pub fn bytes(record: &SweepRecord) -> Result<Vec<u8>, ParquetError> {
    let columns = columns(record);
    let kinds: Vec<PhysicalType> = columns.iter().map(|column| kind(column, record)).collect();
    let fields = columns.iter().zip(&kinds).map(|(column, &kind)| field(&column.name, kind));
    let schema = Type::group_type_builder("sweep").with_fields(fields.collect::<Result<_, _>>()?).build()?;
    let mut about = vec![
        metadata("gearwear_version", &record.identity.program_version),
        metadata("scene_hash", &record.identity.scene_hash),
    ];
    about.extend(columns.iter().map(|column| metadata(&format!("column:{}", column.name), &column.meaning)));
    let properties = WriterProperties::builder().set_key_value_metadata(Some(about)).build();

    let mut file = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    for (column, kind) in columns.iter().zip(kinds) {
        let Some(mut writer) = group.next_column()? else { break };
        let cells = record.rows.iter().map(|row| column.cell(row));
        match kind {
            PhysicalType::INT64 => write::<Int64Type>(
                &mut writer,
                cells.map(|cell| if let Cell::Whole(value) = cell { value } else { None }),
            )?,
            PhysicalType::DOUBLE => write::<DoubleType>(
                &mut writer,
                cells.map(|cell| if let Cell::Number(value) = cell { value } else { None }),
            )?,
            _ => write::<ByteArrayType>(
                &mut writer,
                cells.map(
                    |cell| if let Cell::Text(text) = cell { text.map(|text| ByteArray::from(&*text)) } else { None },
                ),
            )?,
        }
        writer.close()?;
    }
    group.close()?;
    file.into_inner()
}

fn metadata(key: &str, value: &str) -> KeyValue {
    KeyValue::new(key.to_owned(), value.to_owned())
}

/// Type of a column's cells; a table without rows has numbers.
fn kind(column: &SweepColumn, record: &SweepRecord) -> PhysicalType {
    match record.rows.first().map(|row| column.cell(row)) {
        Some(Cell::Whole(_)) => PhysicalType::INT64,
        Some(Cell::Number(_)) | None => PhysicalType::DOUBLE,
        Some(Cell::Text(_)) => PhysicalType::BYTE_ARRAY,
    }
}

fn field(name: &str, kind: PhysicalType) -> Result<Arc<Type>, ParquetError> {
    let text = (kind == PhysicalType::BYTE_ARRAY).then_some(LogicalType::String);
    let built = Type::primitive_type_builder(name, kind).with_repetition(Repetition::OPTIONAL);
    built.with_logical_type(text).build().map(Arc::new)
}

/// Writes whether there is a value, row by row, and the values that there are.
fn write<T: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    for cell in cells {
        levels.push(i16::from(cell.is_some()));
        values.extend(cell);
    }
    writer.typed::<T>().write_batch(&values, Some(&levels), None).map(drop)
}
