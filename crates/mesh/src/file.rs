//! Reading and writing of mesh files. What is written has the format of its ending; what is read says its format itself, by how it begins,
//! and the ending counts where it does not.
//!
//! | ending | begins with | format | module |
//! |---|---|---|---|
//! | `.msh` | `$MeshFormat`, `$Comments` | Gmsh 2.2 and 4.1, ASCII and binary | [`super::gmsh`] |
//! | `.vtu` | `<` | VTK unstructured grid | [`super::vtu`] |
//! | `.inp` | `*`, `>**` | Abaqus (CalculiX) input | [`super::abaqus`] |
//! | `.json` | `{` | JSON of [`Mesh`] | `json` |
//!
//! Every mesh read passes [`Mesh::check`]. Files may be hostile: no content makes a reader panic, counts are
//! checked against the rest of the file, and sets and data, which can be given in a few bytes for a
//! whole mesh, have at most [`super::error::LARGEST_EXPANSION`] entries for each byte of the file.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use super::error::{FileFault, MeshFileError, Unwritable};
use super::gmsh::{self, GmshStyle};
use super::vtu::{self, VtuEncoding};
use super::{Mesh, abaqus, json};
use gearwear_files::memory;
use gearwear_files::size_limit::SizeLimit;
use gearwear_files::whole_file;

/// Size of a mesh file, and of all that it includes.
pub(crate) const MESH_SIZE: SizeLimit = SizeLimit { of: "a mesh file", megabytes: 1024 };
/// Memory that reading takes for each byte of a file: text takes seven, of 160,000 quadrilaterals.
const MEMORY_PER_BYTE: u64 = 8;
/// Endings of mesh files.
pub(crate) const ALLOWED_ENDINGS: &str = ".msh (Gmsh 2.2 or 4.1), .vtu (VTK), .inp (Abaqus) or .json";

/// Mesh format; its options apply to writing only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Gmsh.
    Gmsh(GmshStyle),
    /// VTK unstructured grid.
    Vtu(VtuEncoding),
    /// Abaqus input.
    Abaqus,
    /// Serde form of [`Mesh`].
    Json,
}

impl Format {
    /// Format of the ending of `path`, upper or lower case, with default options.
    pub fn of_path(path: &Path) -> Result<Self, MeshFileError> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("msh") => Ok(Format::Gmsh(GmshStyle::default())),
            Some("vtu") => Ok(Format::Vtu(VtuEncoding::default())),
            Some("inp") => Ok(Format::Abaqus),
            Some("json") => Ok(Format::Json),
            _ => Err(MeshFileError::Extension { path: path.into(), allowed: ALLOWED_ENDINGS }),
        }
    }

    /// Format that the beginning of a file's content tells, if any.
    pub fn of_content(bytes: &[u8]) -> Option<Self> {
        let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes).trim_ascii_start();
        let begins = |with: &[&[u8]]| with.iter().any(|start| bytes.starts_with(start));
        match () {
            () if begins(&[b"$MeshFormat", b"$Comments"]) => Some(Format::Gmsh(GmshStyle::default())),
            () if begins(&[b"<"]) => Some(Format::Vtu(VtuEncoding::default())),
            () if begins(&[b"*", b">**"]) => Some(Format::Abaqus),
            () if begins(&[b"{"]) => Some(Format::Json),
            () => None,
        }
    }
}

/// Mark of UTF-8 that some programs put before text.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Reads the mesh file `path`.
pub fn read(path: impl AsRef<Path>) -> Result<Mesh, MeshFileError> {
    read_with_content(path).map(|(mesh, _)| mesh)
}

/// Reads the mesh file `path`; with it the content of the file and of all that it includes, one after the other.
pub fn read_with_content(path: impl AsRef<Path>) -> Result<(Mesh, Vec<u8>), MeshFileError> {
    let path = path.as_ref();
    let mut bytes = match MESH_SIZE.read(path) {
        Ok(bytes) => bytes,
        Err(source) if source.kind() == ErrorKind::OutOfMemory => {
            let bytes = fs::metadata(path).map_or(0, |found| found.len());
            return Err(MeshFileError::Memory { path: path.into(), megabytes: (MEMORY_PER_BYTE * bytes) >> 20 });
        }
        Err(source) => {
            // Of a name without a known ending the ending is the likely slip.
            Format::of_path(path)?;
            return Err(MeshFileError::Read { path: path.into(), source });
        }
    };
    let needed = MEMORY_PER_BYTE * bytes.len() as u64;
    if !memory::can_be_had(needed) {
        return Err(MeshFileError::Memory { path: path.into(), megabytes: needed >> 20 });
    }
    let format = match Format::of_content(&bytes) {
        Some(format) => format,
        None => Format::of_path(path)?,
    };
    let (mesh, mut included) = checked(format, &bytes, Some(path))
        .map_err(|fault| MeshFileError::Content { path: path.into(), fault: Box::new(fault) })?;
    bytes.append(&mut included);
    Ok((mesh, bytes))
}

/// Writes `mesh` to `path` in the format of its ending, completely or not at all.
pub fn write(mesh: &Mesh, path: impl AsRef<Path>) -> Result<(), MeshFileError> {
    let format = Format::of_path(path.as_ref())?;
    write_as(mesh, path, format)
}

/// Writes `mesh` to `path` in `format`, completely or not at all.
pub fn write_as(mesh: &Mesh, path: impl AsRef<Path>, format: Format) -> Result<(), MeshFileError> {
    let path = path.as_ref();
    let bytes = to_bytes(mesh, format)
        .map_err(|reason| MeshFileError::CannotHold { path: path.into(), reason: Box::new(reason) })?;
    whole_file::write(path, |out| out.write_all(&bytes))
        .map_err(|source| MeshFileError::Write { path: path.into(), source })
}

/// Reads a mesh from the content of a file that includes no other.
pub fn from_bytes(format: Format, bytes: &[u8]) -> Result<Mesh, FileFault> {
    checked(format, bytes, None).map(|(mesh, _)| mesh)
}

/// Mesh in `bytes`, of `file` if they are of a file, and the content of files that it includes.
fn checked(format: Format, bytes: &[u8], file: Option<&Path>) -> Result<(Mesh, Vec<u8>), FileFault> {
    let alone = |mesh| (mesh, Vec::new());
    let (mesh, included) = match format {
        Format::Gmsh(_) => gmsh::read(bytes).map(alone),
        Format::Vtu(_) => vtu::read(bytes).map(alone),
        Format::Abaqus => abaqus::read(bytes, file),
        Format::Json => json::read(bytes).map(alone),
    }?;
    mesh.check().map_err(|inconsistency| FileFault::anywhere("", inconsistency))?;
    Ok((mesh, included))
}

/// Content of a file with `mesh`.
pub fn to_bytes(mesh: &Mesh, format: Format) -> Result<Vec<u8>, Unwritable> {
    mesh.check()?;
    match format {
        Format::Gmsh(style) => gmsh::write(mesh, style),
        Format::Vtu(encoding) => vtu::write(mesh, encoding),
        Format::Abaqus => abaqus::write(mesh),
        Format::Json => Ok(json::write(mesh)),
    }
}
