//! Rows into columns, through their serialisation: the way of the CSV files, without the text.

use std::fmt;

use serde::ser::{Error as _, Impossible, SerializeStruct, Serializer};
use serde::{Serialize, ser};

use super::Values;

/// The values of each of `count` columns over all `rows`.
pub(super) fn columns<R: Serialize>(rows: impl IntoIterator<Item = R>, count: usize) -> Vec<Values> {
    let mut columns: Vec<Values> = (0..count).map(|_| Values::Numbers(Vec::new())).collect();
    for row in rows {
        row.serialize(Row(&mut columns)).expect("rows are structures of numbers, flags and names");
    }
    columns
}

/// One field of a row.
enum Field {
    Number(f64),
    Count(i64),
    Flag(bool),
    Word(String),
    Empty,
}

impl Values {
    /// Adds a row; its field decides of what kind the column is.
    fn push(&mut self, field: Field) {
        if let Values::Numbers(none) = self
            && none.is_empty()
        {
            *self = match field {
                Field::Number(_) | Field::Empty => Values::Numbers(Vec::new()),
                Field::Count(_) => Values::Counts(Vec::new()),
                Field::Flag(_) => Values::Flags(Vec::new()),
                Field::Word(_) => Values::Words(Vec::new()),
            };
        }
        match (self, field) {
            (Values::Numbers(values), Field::Number(value)) => values.push(value),
            (Values::Numbers(values), Field::Empty) => values.push(f64::NAN),
            (Values::Counts(values), Field::Count(value)) => values.push(value),
            (Values::Flags(values), Field::Flag(value)) => values.push(value),
            (Values::Words(values), Field::Word(value)) => values.push(value),
            (Values::Words(values), Field::Empty) => values.push(String::new()),
            _ => unreachable!("the fields of a column are of one type, and numbers alone may be left out"),
        }
    }
}

/// A row that is something else than a structure of such fields.
#[derive(Debug)]
struct NoField(String);

impl fmt::Display for NoField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NoField {}

impl ser::Error for NoField {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

fn no_field<T>(what: &str) -> Result<T, NoField> {
    Err(NoField::custom(format!("{what} in a table")))
}

/// Takes a structure apart into columns.
struct Row<'a>(&'a mut [Values]);

/// The columns that are still without the field of a row.
struct Fields<'a>(std::slice::IterMut<'a, Values>);

impl SerializeStruct for Fields<'_> {
    type Ok = ();
    type Error = NoField;

    fn serialize_field<T: ?Sized + Serialize>(&mut self, name: &'static str, value: &T) -> Result<(), NoField> {
        let column = self.0.next().ok_or_else(|| NoField::custom(format!("no column for {name}")))?;
        column.push(value.serialize(Scalar)?);
        Ok(())
    }

    fn end(self) -> Result<(), NoField> {
        Ok(())
    }
}

/// Takes the value of a field.
struct Scalar;

/// What neither a row nor a field is.
macro_rules! refuse {
    () => {
        fn serialize_bytes(self, _: &[u8]) -> Result<Self::Ok, NoField> {
            no_field("bytes")
        }
        fn serialize_unit(self) -> Result<Self::Ok, NoField> {
            no_field("nothing")
        }
        fn serialize_unit_struct(self, name: &'static str) -> Result<Self::Ok, NoField> {
            no_field(name)
        }
        fn serialize_newtype_variant<T: ?Sized + Serialize>(
            self,
            name: &'static str,
            _: u32,
            _: &'static str,
            _: &T,
        ) -> Result<Self::Ok, NoField> {
            no_field(name)
        }
        fn serialize_seq(self, _: Option<usize>) -> Result<Self::SerializeSeq, NoField> {
            no_field("a list")
        }
        fn serialize_tuple(self, _: usize) -> Result<Self::SerializeTuple, NoField> {
            no_field("a list")
        }
        fn serialize_tuple_struct(self, name: &'static str, _: usize) -> Result<Self::SerializeTupleStruct, NoField> {
            no_field(name)
        }
        fn serialize_tuple_variant(
            self,
            name: &'static str,
            _: u32,
            _: &'static str,
            _: usize,
        ) -> Result<Self::SerializeTupleVariant, NoField> {
            no_field(name)
        }
        fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, NoField> {
            no_field("a map")
        }
        fn serialize_struct_variant(
            self,
            name: &'static str,
            _: u32,
            _: &'static str,
            _: usize,
        ) -> Result<Self::SerializeStructVariant, NoField> {
            no_field(name)
        }
    };
}

/// Kinds of values, each with the field that it is.
macro_rules! scalars {
    ($($method:ident($type:ty) => $field:expr;)*) => {
        $(fn $method(self, value: $type) -> Result<Field, NoField> {
            $field(value)
        })*
    };
}

/// A whole number that a column can hold.
fn count<N: TryInto<i64>>(value: N) -> Result<Field, NoField> {
    value.try_into().map(Field::Count).or_else(|_| no_field("too great a number"))
}

impl Serializer for Scalar {
    type Ok = Field;
    type Error = NoField;
    type SerializeSeq = Impossible<Field, NoField>;
    type SerializeTuple = Impossible<Field, NoField>;
    type SerializeTupleStruct = Impossible<Field, NoField>;
    type SerializeTupleVariant = Impossible<Field, NoField>;
    type SerializeMap = Impossible<Field, NoField>;
    type SerializeStruct = Impossible<Field, NoField>;
    type SerializeStructVariant = Impossible<Field, NoField>;

    scalars! {
        serialize_bool(bool) => |value| Ok(Field::Flag(value));
        serialize_i8(i8) => count;
        serialize_i16(i16) => count;
        serialize_i32(i32) => count;
        serialize_i64(i64) => count;
        serialize_u8(u8) => count;
        serialize_u16(u16) => count;
        serialize_u32(u32) => count;
        serialize_u64(u64) => count;
        serialize_f32(f32) => |value| Ok(Field::Number(f64::from(value)));
        serialize_f64(f64) => |value| Ok(Field::Number(value));
        serialize_char(char) => |value: char| Ok(Field::Word(value.to_string()));
        serialize_str(&str) => |value: &str| Ok(Field::Word(value.to_owned()));
    }

    fn serialize_none(self) -> Result<Field, NoField> {
        Ok(Field::Empty)
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Result<Field, NoField> {
        value.serialize(self)
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Result<Field, NoField> {
        Ok(Field::Word(variant.to_owned()))
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(self, _: &'static str, value: &T) -> Result<Field, NoField> {
        value.serialize(self)
    }

    fn serialize_struct(self, name: &'static str, _: usize) -> Result<Self::SerializeStruct, NoField> {
        no_field(name)
    }

    refuse!();
}

/// A row is a structure and nothing else.
macro_rules! no_rows {
    ($($method:ident($type:ty);)*) => {
        $(fn $method(self, _: $type) -> Result<(), NoField> {
            no_field("a row that is one value")
        })*
    };
}

impl<'a> Serializer for Row<'a> {
    type Ok = ();
    type Error = NoField;
    type SerializeSeq = Impossible<(), NoField>;
    type SerializeTuple = Impossible<(), NoField>;
    type SerializeTupleStruct = Impossible<(), NoField>;
    type SerializeTupleVariant = Impossible<(), NoField>;
    type SerializeMap = Impossible<(), NoField>;
    type SerializeStruct = Fields<'a>;
    type SerializeStructVariant = Impossible<(), NoField>;

    no_rows! {
        serialize_bool(bool);
        serialize_i8(i8);
        serialize_i16(i16);
        serialize_i32(i32);
        serialize_i64(i64);
        serialize_u8(u8);
        serialize_u16(u16);
        serialize_u32(u32);
        serialize_u64(u64);
        serialize_f32(f32);
        serialize_f64(f64);
        serialize_char(char);
        serialize_str(&str);
    }

    fn serialize_none(self) -> Result<(), NoField> {
        no_field("a row that is left out")
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Result<(), NoField> {
        value.serialize(self)
    }

    fn serialize_unit_variant(self, name: &'static str, _: u32, _: &'static str) -> Result<(), NoField> {
        no_field(name)
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(self, _: &'static str, value: &T) -> Result<(), NoField> {
        value.serialize(self)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Fields<'a>, NoField> {
        Ok(Fields(self.0.iter_mut()))
    }

    refuse!();
}
