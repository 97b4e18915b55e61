//! Writing of VTU files.

use std::fmt::Write as _;
use std::io::Write as _;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use quick_xml::escape::escape;

use super::{BLOCKS, FORMULATIONS, SET, TAG, VtuEncoding};
use crate::error::Unwritable;
use crate::{DataArray, Mesh, Values};

const FORMAT: &str = "a VTU file";

pub(crate) fn write(mesh: &Mesh, encoding: VtuEncoding) -> Result<Vec<u8>, Unwritable> {
    check_names(mesh)?;
    let mut out = VtuOutput { text: String::new(), encoding };
    let compressor = match encoding {
        VtuEncoding::Zlib => " compressor=\"vtkZLibDataCompressor\"",
        VtuEncoding::Base64 | VtuEncoding::Ascii => "",
    };
    out.line(format_args!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\"{compressor}>\n<UnstructuredGrid>"
    ));
    field_data(&mut out, mesh);
    let cell_count: usize = mesh.cells.iter().map(|block| block.len()).sum();
    let point_count = mesh.points.len();
    out.line(format_args!("<Piece NumberOfPoints=\"{point_count}\" NumberOfCells=\"{cell_count}\">\n<Points>"));
    let coordinates = mesh.points.iter().flatten().copied();
    out.array("Points", 3, "Float64", coordinates.map(Number::Real));
    out.line("</Points>\n<Cells>");
    let nodes = mesh.cells.iter().flat_map(|block| &block.nodes);
    out.array("connectivity", 1, "Int64", nodes.map(|&node| Number::Integer(node as i64)));
    let mut end = 0;
    let ends = mesh.cells.iter().flat_map(|block| std::iter::repeat_n(block.kind.node_count() as i64, block.len()));
    let ends = ends.map(|nodes| {
        end += nodes;
        Number::Integer(end)
    });
    out.array("offsets", 1, "Int64", ends);
    let types = mesh.cells.iter().flat_map(|block| std::iter::repeat_n(block.kind as u8, block.len()));
    out.array("types", 1, "UInt8", types.map(Number::Byte));
    out.line("</Cells>\n<PointData>");
    for (name, array) in &mesh.point_data {
        out.data(name, std::slice::from_ref(array));
    }
    for (name, set) in &mesh.point_sets {
        out.set(name, point_count, set.iter().copied());
    }
    out.line("</PointData>\n<CellData>");
    for (name, arrays) in &mesh.cell_data {
        out.data(name, arrays);
    }
    for (name, lists) in &mesh.cell_sets {
        out.set(name, cell_count, mesh.over_all(lists));
    }
    out.line("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>");
    Ok(out.text.into_bytes())
}

/// Refuses names with control characters that XML 1.0 does not allow.
fn check_names(mesh: &Mesh) -> Result<(), Unwritable> {
    let data = mesh.point_data.keys().chain(mesh.cell_data.keys());
    let sets = mesh.point_sets.keys().chain(mesh.cell_sets.keys()).chain(mesh.field_data.keys());
    match data.chain(sets).find(|name| name.contains(is_impossible)) {
        Some(name) => {
            let rule = "names have no control characters other than tabs and line breaks";
            Err(Unwritable::Name { format: FORMAT, name: name.clone(), rule })
        }
        None => Ok(()),
    }
}

/// Whether XML 1.0 has no way to write a character.
fn is_impossible(c: char) -> bool {
    (c < ' ' && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{FFFE}' | '\u{FFFF}')
}

fn field_data(out: &mut VtuOutput, mesh: &Mesh) {
    let runs = mesh.cells.windows(2).all(|pair| pair[0].kind != pair[1].kind);
    let plain = runs && mesh.cells.iter().all(|block| !block.is_empty());
    let formulated = mesh.cells.iter().any(|block| block.formulation.is_some());
    if plain && !formulated && mesh.field_data.is_empty() {
        return;
    }
    out.line("<FieldData>");
    if !plain {
        let pairs = mesh.cells.iter().flat_map(|block| [block.kind as i64, block.len() as i64]);
        out.array_of(BLOCKS, 2, "Int64", Some(mesh.cells.len()), pairs.map(Number::Integer));
    }
    if formulated {
        let numbers = mesh.cells.iter().map(|block| block.formulation.map_or(0, |own| own as i64));
        out.array_of(FORMULATIONS, 1, "Int64", Some(mesh.cells.len()), numbers.map(Number::Integer));
    }
    for (name, tag) in &mesh.field_data {
        let values = [tag.tag, tag.dimension.into()].map(Number::Integer);
        out.array_of(&format!("{TAG}{name}"), 2, "Int64", Some(1), values.into_iter());
    }
    out.line("</FieldData>");
}

/// Value of one of the written types.
#[derive(Debug, Clone, Copy)]
enum Number {
    Real(f64),
    Integer(i64),
    Byte(u8),
}

#[derive(Debug)]
struct VtuOutput {
    text: String,
    encoding: VtuEncoding,
}

impl VtuOutput {
    fn line(&mut self, line: impl std::fmt::Display) {
        // Writing into memory does not fail.
        let _ = writeln!(self.text, "{line}");
    }

    fn data(&mut self, name: &str, arrays: &[DataArray]) {
        let components = arrays.first().map_or(1, |array| array.components);
        let integers = arrays.first().is_some_and(|array| matches!(array.values, Values::Integers(_)));
        let numbers = arrays.iter().flat_map(|array| -> Box<dyn Iterator<Item = Number>> {
            match &array.values {
                Values::Integers(values) => Box::new(values.iter().map(|&value| Number::Integer(value))),
                Values::Reals(values) => Box::new(values.iter().map(|&value| Number::Real(value))),
            }
        });
        self.array(name, components, if integers { "Int64" } else { "Float64" }, numbers);
    }

    fn set(&mut self, name: &str, owners: usize, members: impl Iterator<Item = usize>) {
        let mut member = vec![Number::Byte(0); owners];
        members.for_each(|own| member[own] = Number::Byte(1));
        self.array(&format!("{SET}{name}"), 1, "UInt8", member.into_iter());
    }

    fn array(&mut self, name: &str, components: usize, scalar: &str, numbers: impl Iterator<Item = Number>) {
        self.array_of(name, components, scalar, None, numbers);
    }

    fn array_of(
        &mut self,
        name: &str,
        components: usize,
        scalar: &str,
        tuples: Option<usize>,
        numbers: impl Iterator<Item = Number>,
    ) {
        let name = escape(name).replace('\n', "&#10;").replace('\r', "&#13;").replace('\t', "&#9;");
        let tuples = tuples.map_or_else(String::new, |tuples| format!(" NumberOfTuples=\"{tuples}\""));
        // One component is the default; meshio makes columns of scalars where it is given.
        let together = match components {
            1 => String::new(),
            components => format!(" NumberOfComponents=\"{components}\""),
        };
        let format = if self.encoding == VtuEncoding::Ascii { "ascii" } else { "binary" };
        self.line(format_args!("<DataArray type=\"{scalar}\" Name=\"{name}\"{together}{tuples} format=\"{format}\">"));
        self.numbers(components, numbers);
        self.line("\n</DataArray>");
    }

    fn numbers(&mut self, components: usize, numbers: impl Iterator<Item = Number>) {
        if self.encoding == VtuEncoding::Ascii {
            for (place, number) in numbers.enumerate() {
                let separator = match place {
                    0 => "",
                    place if place.is_multiple_of(components) => "\n",
                    _ => " ",
                };
                let _ = match number {
                    Number::Real(value) => write!(self.text, "{separator}{value:?}"),
                    Number::Integer(value) => write!(self.text, "{separator}{value}"),
                    Number::Byte(value) => write!(self.text, "{separator}{value}"),
                };
            }
            return;
        }
        let mut bytes = Vec::new();
        for number in numbers {
            match number {
                Number::Real(value) => bytes.extend(value.to_le_bytes()),
                Number::Integer(value) => bytes.extend(value.to_le_bytes()),
                Number::Byte(value) => bytes.push(value),
            }
        }
        if self.encoding == VtuEncoding::Base64 {
            let mut all = (bytes.len() as u64).to_le_bytes().to_vec();
            all.append(&mut bytes);
            STANDARD.encode_string(all, &mut self.text);
            return;
        }
        let blocks: Vec<Vec<u8>> = bytes.chunks(BLOCK_BYTES).map(compress).collect();
        let last = if bytes.len().is_multiple_of(BLOCK_BYTES) { 0 } else { bytes.len() % BLOCK_BYTES };
        let sizes = blocks.iter().map(Vec::len);
        let header: Vec<u8> =
            [blocks.len(), BLOCK_BYTES, last].into_iter().chain(sizes).flat_map(|n| (n as u64).to_le_bytes()).collect();
        STANDARD.encode_string(header, &mut self.text);
        STANDARD.encode_string(blocks.concat(), &mut self.text);
    }
}

/// Bytes of a compressed block, as usual in VTK.
const BLOCK_BYTES: usize = 1 << 15;

fn compress(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    // Writing into memory does not fail.
    encoder.write_all(block).and_then(|()| encoder.finish()).unwrap_or_default()
}
