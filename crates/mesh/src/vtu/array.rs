//! The values of a VTU file's arrays.
//!
//! Binary values follow a header of integers of the file's header type:
//!
//! ```text
//! as they are   bytes, values
//! compressed    blocks n, bytes of a block, bytes of the last block (0: a whole one), compressed bytes of each of the n; blocks
//! ```
//!
//! In base64 the header may be encoded for itself, with padding of its own, in front of the values.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

use super::document::{Array, Document, fault};
use crate::Values;
use crate::error::{Fault, Problem};
use crate::numbering::Allowance;

/// How binary values of a file are written.
#[derive(Debug)]
pub(super) struct Decoder<'d, 'a> {
    document: &'d Document<'a>,
    big_endian: bool,
    header_bytes: usize,
    compressed: bool,
    /// Offsets of all appended arrays, ascending: each ends where the next begins.
    offsets: Vec<usize>,
}

/// The type of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Scalar {
    pub bytes: usize,
    /// Floating point, signed or unsigned.
    family: Family,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Family {
    Float,
    Signed,
    Unsigned,
}

impl Scalar {
    /// One byte without sign: what sets are written in.
    pub(super) const BYTE: Scalar = Scalar { bytes: 1, family: Family::Unsigned };

    fn named(name: &str) -> Option<Self> {
        let (family, bits) = match name.split_at_checked(name.find(|c: char| c.is_ascii_digit())?)? {
            ("Float", bits @ ("32" | "64")) => (Family::Float, bits),
            ("Int", bits @ ("8" | "16" | "32" | "64")) => (Family::Signed, bits),
            ("UInt", bits @ ("8" | "16" | "32" | "64")) => (Family::Unsigned, bits),
            _ => return None,
        };
        Some(Self { bytes: bits.parse::<usize>().ok()? / 8, family })
    }
}

impl Array<'_> {
    pub(super) fn name(&self) -> &str {
        self.attributes.get("Name").map_or("", String::as_str)
    }

    pub(super) fn fault(&self, problem: impl Into<Problem>) -> Fault {
        fault(self.byte, &format!("DataArray {:?}", self.name()), problem.into())
    }

    pub(super) fn scalar(&self) -> Result<Scalar, Fault> {
        let name = self.attributes.get("type").map_or("", String::as_str);
        Scalar::named(name).ok_or_else(|| {
            let allowed = "Int8 to Int64, UInt8 to UInt64, Float32 and Float64".into();
            self.fault(Problem::Unsupported { what: format!("type {name:?}"), allowed })
        })
    }

    /// How many values go together.
    pub(super) fn components(&self) -> Result<usize, Fault> {
        let Some(text) = self.attributes.get("NumberOfComponents") else { return Ok(1) };
        let components = text.trim().parse().ok().filter(|&components| components > 0);
        components.ok_or_else(|| self.fault(Problem::unexpected(text, "a number of components")))
    }
}

impl<'d, 'a> Decoder<'d, 'a> {
    pub(super) fn new(document: &'d Document<'a>) -> Result<Self, Fault> {
        let attribute = |name: &str| document.file.get(name).map(String::as_str);
        let wrong = |name: &str, found: Option<&str>, allowed: &str| {
            let what = format!("{name} {:?}", found.unwrap_or_default());
            Err(Fault::anywhere("VTKFile", Problem::Unsupported { what, allowed: allowed.into() }))
        };
        match attribute("type") {
            Some("UnstructuredGrid") => {}
            other => return wrong("type", other, "UnstructuredGrid"),
        }
        let big_endian = match attribute("byte_order") {
            Some("LittleEndian") | None => false,
            Some("BigEndian") => true,
            other => return wrong("byte_order", other, "LittleEndian and BigEndian"),
        };
        let header_bytes = match attribute("header_type") {
            Some("UInt32" | "Int32") | None => 4,
            Some("UInt64" | "Int64") => 8,
            other => return wrong("header_type", other, "UInt32 and UInt64"),
        };
        let compressed = match attribute("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            other => return wrong("compressor", other, "vtkZLibDataCompressor"),
        };
        let arrays =
            [&document.field_data, &document.points, &document.cells, &document.point_data, &document.cell_data];
        let offset = |array: &Array| array.attributes.get("offset").and_then(|text| text.trim().parse().ok());
        let mut offsets: Vec<usize> = arrays.into_iter().flatten().filter_map(offset).collect();
        offsets.sort_unstable();
        Ok(Self { document, big_endian, header_bytes, compressed, offsets })
    }

    /// The values of `array`, of which there must be `count` if it is given.
    pub(super) fn values(
        &self,
        array: &Array,
        count: Option<usize>,
        allowance: &mut Allowance,
    ) -> Result<Values, Fault> {
        let scalar = array.scalar()?;
        let take = |count: usize, allowance: &mut Allowance| allowance.take(count).map_err(|limit| array.fault(limit));
        if let Some(count) = count {
            take(count, allowance)?;
        }
        let values = match array.attributes.get("format").map(String::as_str) {
            Some("ascii") | None => ascii(array, scalar)?,
            Some("binary") => {
                let bytes = decode_base64(array.text.as_bytes()).map_err(|problem| array.fault(problem))?;
                self.unpack(array, &bytes, scalar, count, allowance)?
            }
            Some("appended") => {
                let (bytes, base64) = self.appended(array)?;
                if base64 {
                    let bytes = decode_base64(bytes).map_err(|problem| array.fault(problem))?;
                    self.unpack(array, &bytes, scalar, count, allowance)?
                } else {
                    self.unpack(array, bytes, scalar, count, allowance)?
                }
            }
            Some(other) => return Err(array.fault(Problem::unexpected(other, "format ascii, binary or appended"))),
        };
        let found = match &values {
            Values::Integers(values) => values.len(),
            Values::Reals(values) => values.len(),
        };
        match count {
            Some(count) if count != found => {
                Err(array.fault(Problem::unexpected(&format!("{found} values"), format!("{count} values"))))
            }
            _ => Ok(values),
        }
    }

    /// The appended bytes of `array`, at least, and whether they are base64.
    fn appended(&self, array: &Array) -> Result<(&'a [u8], bool), Fault> {
        let Some(appended) = self.document.appended else {
            return Err(array.fault(Problem::Ended { expected: "`<AppendedData>`".into() }));
        };
        let text = array.attributes.get("offset").map_or("", String::as_str);
        let length = appended.bytes.len();
        let offset = text.trim().parse().ok().filter(|&offset: &usize| offset <= length);
        let Some(offset) = offset else {
            return Err(array.fault(Problem::unexpected(text, format!("an offset up to {length}"))));
        };
        let next = self.offsets.iter().copied().find(|&other| other > offset);
        Ok((&appended.bytes[offset..next.unwrap_or(length).min(length)], appended.base64))
    }

    /// Values from their bytes with the header in front.
    fn unpack(
        &self,
        array: &Array,
        bytes: &[u8],
        scalar: Scalar,
        count: Option<usize>,
        allowance: &mut Allowance,
    ) -> Result<Values, Fault> {
        // VTK writes arrays without values without any header at times.
        if bytes.is_empty() {
            return self.numbers(&[], scalar, array);
        }
        let mut rest = bytes;
        let mut header = |what: &str| -> Result<usize, Fault> {
            let value = self.unsigned(rest.get(..self.header_bytes));
            rest = rest.get(self.header_bytes..).unwrap_or_default();
            let value = value.ok_or_else(|| array.fault(Problem::Ended { expected: what.into() }))?;
            usize::try_from(value).map_err(|_| array.fault(Problem::unexpected(&value.to_string(), what)))
        };
        if !self.compressed {
            let length = header("the number of bytes")?;
            let values = rest.get(..length).ok_or_else(|| {
                let (count, possible) = (length as u64, rest.len() as u64);
                array.fault(Problem::Count { what: "bytes", count, possible })
            })?;
            if count.is_none() {
                allowance.take(length / scalar.bytes).map_err(|limit| array.fault(limit))?;
            }
            return self.numbers(values, scalar, array);
        }
        let blocks = header("the number of blocks")?;
        let block_bytes = header("the bytes of a block")?;
        let last_bytes = header("the bytes of the last block")?;
        let possible = bytes.len() / self.header_bytes;
        if blocks > possible {
            let (count, possible) = (blocks as u64, possible as u64);
            return Err(array.fault(Problem::Count { what: "blocks", count, possible }));
        }
        let lengths = (0..blocks).map(|_| header("the bytes of a compressed block")).collect::<Result<Vec<_>, _>>()?;
        let whole = blocks.saturating_sub(1).saturating_mul(block_bytes);
        let total = match last_bytes {
            _ if blocks == 0 => 0,
            0 => whole.saturating_add(block_bytes),
            last => whole.saturating_add(last),
        };
        match count {
            Some(count) if count.checked_mul(scalar.bytes) != Some(total) => {
                let (found, expected) = (format!("{total} bytes"), format!("{count} values of {} bytes", scalar.bytes));
                return Err(array.fault(Problem::unexpected(&found, expected)));
            }
            Some(_) => {}
            None => allowance.take(total / scalar.bytes).map_err(|limit| array.fault(limit))?,
        }
        let mut values = Vec::new();
        for length in lengths {
            let block = rest.get(..length).ok_or_else(|| {
                let (count, possible) = (length as u64, rest.len() as u64);
                array.fault(Problem::Count { what: "compressed bytes", count, possible })
            })?;
            rest = &rest[length..];
            // Never more than announced, which the allowance has passed.
            let left = (total - values.len()) as u64 + 1;
            ZlibDecoder::new(block)
                .take(left)
                .read_to_end(&mut values)
                .map_err(|error| array.fault(Problem::unexpected(&error.to_string(), "data compressed with zlib")))?;
            if values.len() > total {
                break;
            }
        }
        if values.len() != total {
            let found = format!("{} bytes", values.len());
            return Err(array.fault(Problem::unexpected(&found, format!("{total} bytes once expanded"))));
        }
        self.numbers(&values, scalar, array)
    }

    fn unsigned(&self, bytes: Option<&[u8]>) -> Option<u64> {
        let mut raw = [0; 8];
        let bytes = bytes?;
        for (place, &byte) in raw.iter_mut().zip(bytes) {
            *place = byte;
        }
        if self.big_endian {
            raw[..bytes.len()].reverse();
        }
        Some(u64::from_le_bytes(raw))
    }

    fn numbers(&self, bytes: &[u8], scalar: Scalar, array: &Array) -> Result<Values, Fault> {
        if !bytes.len().is_multiple_of(scalar.bytes) {
            let found = format!("{} bytes", bytes.len());
            return Err(array.fault(Problem::unexpected(&found, format!("values of {} bytes", scalar.bytes))));
        }
        let raw = bytes.chunks_exact(scalar.bytes).filter_map(|bytes| self.unsigned(Some(bytes)));
        let unused_bits = 64 - 8 * scalar.bytes as u32;
        Ok(match (scalar.family, scalar.bytes) {
            (Family::Float, 4) => Values::Reals(raw.map(|bits| f32::from_bits(bits as u32).into()).collect()),
            (Family::Float, _) => Values::Reals(raw.map(f64::from_bits).collect()),
            (Family::Signed, _) => {
                Values::Integers(raw.map(|bits| ((bits << unused_bits) as i64) >> unused_bits).collect())
            }
            (Family::Unsigned, _) => {
                let fits = |bits: u64| i64::try_from(bits).map_err(|_| array.fault(too_large(bits)));
                Values::Integers(raw.map(fits).collect::<Result<_, _>>()?)
            }
        })
    }
}

fn too_large(value: impl std::fmt::Display) -> Problem {
    Problem::unexpected(&value.to_string(), "an integer of at most 2^63 - 1")
}

/// Values as text; their number is bounded by that of the bytes.
fn ascii(array: &Array, scalar: Scalar) -> Result<Values, Fault> {
    let words = array.text.split_ascii_whitespace();
    let wrong = |word: &str, expected: &str| array.fault(Problem::unexpected(word, expected));
    Ok(if scalar.family == Family::Float {
        let real = |word: &str| word.parse().map_err(|_| wrong(word, "a number"));
        Values::Reals(words.map(real).collect::<Result<_, _>>()?)
    } else {
        let integer = |word: &str| word.parse().map_err(|_| wrong(word, "an integer"));
        Values::Integers(words.map(integer).collect::<Result<_, _>>()?)
    })
}

/// Bytes from base64, which may be several encodings one after the other, each padded, with white space anywhere.
fn decode_base64(text: &[u8]) -> Result<Vec<u8>, Problem> {
    let mut symbols: Vec<u8> = text.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let mut bytes = Vec::with_capacity(symbols.len() / 4 * 3);
    let mut rest = symbols.as_mut_slice();
    while !rest.is_empty() {
        let padding = rest.iter().position(|&symbol| symbol == b'=').unwrap_or(rest.len());
        let end = padding + rest[padding..].iter().take_while(|&&symbol| symbol == b'=').count();
        STANDARD
            .decode_vec(&rest[..end], &mut bytes)
            .map_err(|error| Problem::unexpected(&error.to_string(), "base64"))?;
        rest = &mut rest[end..];
    }
    Ok(bytes)
}
