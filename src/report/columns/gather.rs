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
    /// Adds a row; the first field that is there decides of what kind the column is.
    fn push(&mut self, field: Field) {
        if let Values::Numbers(none) = self
            && none.iter().all(|value| value.is_nan())
        {
            match field {
                Field::Count(_) if none.is_empty() => *self = Values::Counts(Vec::new()),
                Field::Flag(_) if none.is_empty() => *self = Values::Flags(Vec::new()),
                Field::Word(_) => *self = Values::Words(vec![String::new(); none.len()]),
                _ => {}
            }
        }
        match (self, field) {
            (Values::Numbers(values), Field::Number(value)) => values.push(value),
            (Values::Numbers(values), Field::Empty) => values.push(f64::NAN),
            (Values::Counts(values), Field::Count(value)) => values.push(value),
            (Values::Flags(values), Field::Flag(value)) => values.push(value),
            (Values::Words(values), Field::Word(value)) => values.push(value),
            (Values::Words(values), Field::Empty) => values.push(String::new()),
            _ => unreachable!("the fields of a column are of one type, and numbers and names alone may be left out"),
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

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::Gear;

    #[derive(Serialize)]
    struct Row {
        number: Option<f64>,
        count: usize,
        flag: bool,
        gear: Gear,
        name: Option<&'static str>,
    }

    #[test]
    fn fields_are_gathered_by_their_kind() {
        let row = |number, name| Row { number, count: 3, flag: true, gear: Gear::Wheel, name };
        let found = columns([row(None, None), row(Some(-0.0), Some("A")), row(Some(2.0), None)], 5);
        let Values::Numbers(numbers) = &found[0] else { panic!("{found:?}") };
        assert!(numbers[0].is_nan() && numbers[1].to_bits() == (-0.0_f64).to_bits() && numbers[2] == 2.0);
        let words = |words: [&str; 3]| Values::Words(words.map(str::to_owned).into());
        let expected =
            [Values::Counts(vec![3; 3]), Values::Flags(vec![true; 3]), words(["wheel"; 3]), words(["", "A", ""])];
        assert_eq!(found[1..], expected);
    }

    #[test]
    fn columns_of_no_rows_are_empty() {
        assert_eq!(columns(Vec::<Row>::new(), 2), vec![Values::Numbers(Vec::new()); 2]);
    }
}
