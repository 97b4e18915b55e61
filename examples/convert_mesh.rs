//! Converts a mesh file into another format: `cargo run --example convert_mesh -- IN OUT [STYLE]`.
//!
//! The endings of the names say the formats (`.msh`, `.vtu`, `.inp`, `.json`); STYLE chooses among those of one format:
//! `2.2`, `2.2-binary`, `4.1`, `4.1-binary` (Gmsh), `ascii`, `base64`, `zlib` (VTU).

use std::path::Path;
use std::process::ExitCode;

use gearwear_mesh::gmsh::{GmshEncoding, GmshStyle, GmshVersion};
use gearwear_mesh::vtu::VtuEncoding;
use gearwear_mesh::{self as mesh, Format};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (from, to, style) = match arguments.as_slice() {
        [from, to] => (from, to, None),
        [from, to, style] => (from, to, Some(style.as_str())),
        _ => {
            eprintln!("usage: convert_mesh IN OUT [2.2 | 2.2-binary | 4.1 | 4.1-binary | ascii | base64 | zlib]");
            return ExitCode::from(2);
        }
    };
    match convert(Path::new(from), Path::new(to), style) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn convert(from: &Path, to: &Path, style: Option<&str>) -> Result<(), Box<dyn std::error::Error>> {
    let gmsh = |version, encoding| Format::Gmsh(GmshStyle { version, encoding });
    let format = match style {
        None => Format::of_path(to)?,
        Some("2.2") => gmsh(GmshVersion::V2, GmshEncoding::Ascii),
        Some("2.2-binary") => gmsh(GmshVersion::V2, GmshEncoding::Binary),
        Some("4.1") => gmsh(GmshVersion::V4, GmshEncoding::Ascii),
        Some("4.1-binary") => gmsh(GmshVersion::V4, GmshEncoding::Binary),
        Some("ascii") => Format::Vtu(VtuEncoding::Ascii),
        Some("base64") => Format::Vtu(VtuEncoding::Base64),
        Some("zlib") => Format::Vtu(VtuEncoding::Zlib),
        Some(other) => return Err(format!("no style {other:?}").into()),
    };
    mesh::write_as(&mesh::read(from)?, to, format)?;
    Ok(())
}
