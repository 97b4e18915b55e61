//! Values of the arrays of a VTU file.
//!
//! Binary values follow a header of integers of the file's header type:
//!
//! ```text
//! uncompressed  bytes, values
//! compressed    blocks n, bytes of a block, bytes of the last block (0: a whole one), compressed bytes of each of the n; blocks
//! ```
//!
//! In base64 the header may be encoded separately, with its own padding, before the values.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

use super::document::{Array, VtuDocument, fault};
use crate::Values;
use crate::error::{FileFault, FileProblem};
use crate::numbering::Allowance;

/// Decoder of the values of a file.
#[derive(Debug)]
pub(super) struct Decoder<'d, 'a> {
    document: &'d VtuDocument<'a>,
    big_endian: bool,
    header_bytes: usize,
    compressed: bool,
    /// Offsets of all appended arrays, ascending; each ends where the next begins.
    offsets: Vec<usize>,
}

/// Type of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ScalarType {
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

impl ScalarType {
    /// Unsigned byte, the type of sets.
    pub(super) const BYTE: ScalarType = ScalarType { bytes: 1, family: Family::Unsigned };

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

    pub(super) fn fault(&self, problem: impl Into<FileProblem>) -> FileFault {
        fault(self.byte, &format!("DataArray {:?}", self.name()), problem.into())
    }

    pub(super) fn scalar(&self) -> Result<ScalarType, FileFault> {
        let name = self.attributes.get("type").map_or("", String::as_str);
        ScalarType::named(name).ok_or_else(|| {
            let allowed = "Int8 to Int64, UInt8 to UInt64, Float32 and Float64".into();
            self.fault(FileProblem::Unsupported { what: format!("type {name:?}"), allowed })
        })
    }

    /// Number of components.
    pub(super) fn components(&self) -> Result<usize, FileFault> {
        let Some(text) = self.attributes.get("NumberOfComponents") else { return Ok(1) };
        let components = text.trim().parse().ok().filter(|&components| components > 0);
        components.ok_or_else(|| self.fault(FileProblem::unexpected(text, "a number of components")))
    }
}

impl<'d, 'a> Decoder<'d, 'a> {
    pub(super) fn new(document: &'d VtuDocument<'a>) -> Result<Self, FileFault> {
        let [grid, byte_order, header_type, compressor] = ["type", "byte_order", "header_type", "compressor"]
            .map(|name| (name, document.file.get(name).map(String::as_str)));
        match grid.1 {
            Some("UnstructuredGrid") => {}
            _ => return Err(unsupported(grid, "UnstructuredGrid")),
        }
        let big_endian = match byte_order.1 {
            Some("LittleEndian") | None => false,
            Some("BigEndian") => true,
            _ => return Err(unsupported(byte_order, "LittleEndian and BigEndian")),
        };
        let header_bytes = match header_type.1 {
            Some("UInt32" | "Int32") | None => 4,
            Some("UInt64" | "Int64") => 8,
            _ => return Err(unsupported(header_type, "UInt32 and UInt64")),
        };
        let compressed = match compressor.1 {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            _ => return Err(unsupported(compressor, "vtkZLibDataCompressor")),
        };
        let arrays =
            [&document.field_data, &document.points, &document.cells, &document.point_data, &document.cell_data];
        let offsets = arrays.into_iter().flatten().filter_map(|array| array.attributes.get("offset"));
        let mut offsets: Vec<usize> = offsets.filter_map(|text| text.trim().parse().ok()).collect();
        offsets.sort_unstable();
        Ok(Self { document, big_endian, header_bytes, compressed, offsets })
    }

    /// Values of `array`, with `count` of them if given.
    pub(super) fn values(
        &self,
        array: &Array,
        count: Option<usize>,
        allowance: &mut Allowance,
    ) -> Result<Values, FileFault> {
        let scalar = array.scalar()?;
        if let Some(count) = count {
            allowance.take(count).map_err(|limit| array.fault(limit))?;
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
            Some(other) => return Err(array.fault(FileProblem::unexpected(other, "format ascii, binary or appended"))),
        };
        let found = match &values {
            Values::Integers(values) => values.len(),
            Values::Reals(values) => values.len(),
        };
        match count {
            Some(count) if count != found => {
                Err(array.fault(FileProblem::unexpected(&format!("{found} values"), format!("{count} values"))))
            }
            _ => Ok(values),
        }
    }

    /// Appended bytes of `array`, up to the next array, and whether they are base64.
    fn appended(&self, array: &Array) -> Result<(&'a [u8], bool), FileFault> {
        let Some(appended) = self.document.appended else {
            return Err(array.fault(FileProblem::Ended { expected: "`<AppendedData>`".into() }));
        };
        let text = array.attributes.get("offset").map_or("", String::as_str);
        let length = appended.bytes.len();
        let offset = text.trim().parse().ok().filter(|&offset: &usize| offset <= length);
        let Some(offset) = offset else {
            return Err(array.fault(FileProblem::unexpected(text, format!("an offset up to {length}"))));
        };
        let next = self.offsets.iter().copied().find(|&other| other > offset);
        Ok((&appended.bytes[offset..next.unwrap_or(length).min(length)], appended.base64))
    }

    /// Values from their bytes with the header before them.
    fn unpack(
        &self,
        array: &Array,
        bytes: &[u8],
        scalar: ScalarType,
        count: Option<usize>,
        allowance: &mut Allowance,
    ) -> Result<Values, FileFault> {
        // VTK sometimes writes empty arrays without a header.
        if bytes.is_empty() {
            return self.numbers(&[], scalar, array);
        }
        if self.compressed {
            return self.numbers(&self.expanded(array, bytes, scalar, count, allowance)?, scalar, array);
        }
        let mut rest = bytes;
        let length = self.header(array, &mut rest, "the number of bytes")?;
        let values = announced(array, rest, length, "bytes")?;
        if count.is_none() {
            allowance.take(length / scalar.bytes).map_err(|limit| array.fault(limit))?;
        }
        self.numbers(values, scalar, array)
    }

    /// Integer of the header at the beginning of `rest`, which is shortened.
    fn header(&self, array: &Array, rest: &mut &[u8], what: &str) -> Result<usize, FileFault> {
        let value = self.unsigned(rest.get(..self.header_bytes));
        *rest = rest.get(self.header_bytes..).unwrap_or_default();
        let value = value.ok_or_else(|| array.fault(FileProblem::Ended { expected: what.into() }))?;
        usize::try_from(value).map_err(|_| array.fault(FileProblem::unexpected(&value.to_string(), what)))
    }

    /// Bytes of compressed values with the header before them.
    fn expanded(
        &self,
        array: &Array,
        bytes: &[u8],
        scalar: ScalarType,
        count: Option<usize>,
        allowance: &mut Allowance,
    ) -> Result<Vec<u8>, FileFault> {
        let mut rest = bytes;
        let blocks = self.header(array, &mut rest, "the number of blocks")?;
        let block_bytes = self.header(array, &mut rest, "the bytes of a block")?;
        let last_bytes = self.header(array, &mut rest, "the bytes of the last block")?;
        let possible = bytes.len() / self.header_bytes;
        if blocks > possible {
            let (count, possible) = (blocks as u64, possible as u64);
            return Err(array.fault(FileProblem::Count { what: "blocks", count, possible }));
        }
        let lengths = (0..blocks).map(|_| self.header(array, &mut rest, "the bytes of a compressed block"));
        let lengths = lengths.collect::<Result<Vec<_>, _>>()?;
        let whole = blocks.saturating_sub(1).saturating_mul(block_bytes);
        let total = match last_bytes {
            _ if blocks == 0 => 0,
            0 => whole.saturating_add(block_bytes),
            last => whole.saturating_add(last),
        };
        match count {
            Some(count) if count.checked_mul(scalar.bytes) != Some(total) => {
                let (found, expected) = (format!("{total} bytes"), format!("{count} values of {} bytes", scalar.bytes));
                return Err(array.fault(FileProblem::unexpected(&found, expected)));
            }
            Some(_) => {}
            None => allowance.take(total / scalar.bytes).map_err(|limit| array.fault(limit))?,
        }
        let mut values = Vec::new();
        for length in lengths {
            let block = announced(array, rest, length, "compressed bytes")?;
            rest = &rest[length..];
            // At most one byte more than announced, which is allowed.
            let left = (total - values.len()) as u64 + 1;
            ZlibDecoder::new(block).take(left).read_to_end(&mut values).map_err(|error| {
                array.fault(FileProblem::unexpected(&error.to_string(), "data compressed with zlib"))
            })?;
            if values.len() > total {
                break;
            }
        }
        if values.len() != total {
            let found = format!("{} bytes", values.len());
            return Err(array.fault(FileProblem::unexpected(&found, format!("{total} bytes once expanded"))));
        }
        Ok(values)
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

    fn numbers(&self, bytes: &[u8], scalar: ScalarType, array: &Array) -> Result<Values, FileFault> {
        if !bytes.len().is_multiple_of(scalar.bytes) {
            let found = format!("{} bytes", bytes.len());
            return Err(array.fault(FileProblem::unexpected(&found, format!("values of {} bytes", scalar.bytes))));
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
                let integers = raw.map(|bits| {
                    let too_large = || FileProblem::unexpected(&bits.to_string(), "an integer of at most 2^63 - 1");
                    i64::try_from(bits).map_err(|_| array.fault(too_large()))
                });
                Values::Integers(integers.collect::<Result<_, _>>()?)
            }
        })
    }
}

/// Error for an attribute of the file, with its name and value, that is not supported.
fn unsupported((name, found): (&str, Option<&str>), allowed: &str) -> FileFault {
    let what = format!("{name} {:?}", found.unwrap_or_default());
    FileFault::anywhere("VTKFile", FileProblem::Unsupported { what, allowed: allowed.into() })
}

/// First `length` bytes of `rest`, which the header announces.
fn announced<'b>(array: &Array, rest: &'b [u8], length: usize, what: &'static str) -> Result<&'b [u8], FileFault> {
    rest.get(..length)
        .ok_or_else(|| array.fault(FileProblem::Count { what, count: length as u64, possible: rest.len() as u64 }))
}

/// Values as text, whose number is bounded by that of the bytes.
fn ascii(array: &Array, scalar: ScalarType) -> Result<Values, FileFault> {
    if scalar.family == Family::Float {
        words(array, "a number").map(Values::Reals)
    } else {
        words(array, "an integer").map(Values::Integers)
    }
}

/// Parsed words of an array.
fn words<T: std::str::FromStr>(array: &Array, expected: &str) -> Result<Vec<T>, FileFault> {
    let words = array.text.split_ascii_whitespace();
    words.map(|word| word.parse().map_err(|_| array.fault(FileProblem::unexpected(word, expected)))).collect()
}

/// Bytes from base64, which may be several padded encodings in succession, with white space anywhere.
fn decode_base64(text: &[u8]) -> Result<Vec<u8>, FileProblem> {
    let mut symbols: Vec<u8> = text.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
    let mut bytes = Vec::with_capacity(symbols.len() / 4 * 3);
    let mut rest = symbols.as_mut_slice();
    while !rest.is_empty() {
        let padding = rest.iter().position(|&symbol| symbol == b'=').unwrap_or(rest.len());
        let end = padding + rest[padding..].iter().take_while(|&&symbol| symbol == b'=').count();
        STANDARD
            .decode_vec(&rest[..end], &mut bytes)
            .map_err(|error| FileProblem::unexpected(&error.to_string(), "base64"))?;
        rest = &mut rest[end..];
    }
    Ok(bytes)
}
