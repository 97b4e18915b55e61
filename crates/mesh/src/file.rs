//! Reading and writing of mesh files, in the format of their ending.
//!
//! | ending | format | module |
//! |---|---|---|
//! | `.msh` | Gmsh 2.2 and 4.1, ASCII and binary | [`super::gmsh`] |
//! | `.vtu` | VTK unstructured grid | [`super::vtu`] |
//! | `.inp` | Abaqus (CalculiX) input | [`super::abaqus`] |
//! | `.json` | JSON of [`Mesh`] | `json` |
//!
//! Every mesh read passes [`Mesh::check`]. Files may be hostile: no content makes a reader panic, counts are
//! checked against the rest of the file, and sets and data, which can be given in a few bytes for a
//! whole mesh, have at most [`super::error::LARGEST_EXPANSION`] entries for each byte of the file.

use std::fs;
use std::path::Path;

use super::error::{FileFault, MeshFileError, Unwritable};
use super::gmsh::{self, GmshStyle};
use super::vtu::{self, VtuEncoding};
use super::{Mesh, abaqus, json};
use gearwear_files::whole_file;

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
}

/// Reads the mesh file `path` in the format of its ending.
pub fn read(path: impl AsRef<Path>) -> Result<Mesh, MeshFileError> {
    let path = path.as_ref();
    let format = Format::of_path(path)?;
    let bytes = fs::read(path).map_err(|source| MeshFileError::Read { path: path.into(), source })?;
    from_bytes(format, &bytes).map_err(|fault| MeshFileError::Content { path: path.into(), fault: Box::new(fault) })
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

/// Reads a mesh from the content of a file.
pub fn from_bytes(format: Format, bytes: &[u8]) -> Result<Mesh, FileFault> {
    let mesh = match format {
        Format::Gmsh(_) => gmsh::read(bytes),
        Format::Vtu(_) => vtu::read(bytes),
        Format::Abaqus => abaqus::read(bytes),
        Format::Json => json::read(bytes),
    }?;
    mesh.check().map_err(|inconsistency| FileFault::anywhere("", inconsistency))?;
    Ok(mesh)
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
