//! Gmsh files, `.msh`, versions 2.2 and 4.1, ASCII and binary.
//!
//! Source: C. Geuzaine and J.-F. Remacle, *Gmsh Reference Manual*, "MSH file format" (4.1) and "MSH file format version 2
//! (Legacy)"; the order of nodes in cells from "Node ordering" there and from VTK's cell classes.
//!
//! | in the file | in the mesh |
//! |---|---|
//! | `$Nodes`, in the order of the file, numbers with gaps or not | `points` |
//! | `$Elements` | `cells`, a block for each run of one kind |
//! | physical group with its name, or without a name its tag (`7`; `7-lines`, `7-surfaces`, … where groups of several dimensions share the tag) | `cell_sets`, `field_data` |
//! | `$NodeData`, `$ElementData`, the last of each name; NaN for missing values | `point_data`, `cell_data` |
//! | `$Gearwear` (below) | parts that Gmsh has no place for |
//!
//! In 4.1 a cell is in all groups of its entity. In 2.2 Gmsh writes a cell once for each of its groups; such copies (same
//! nodes, same entity, another group) become one cell again. Parameters of nodes on curves and surfaces,
//! `$Periodic` and unknown sections are skipped; `$PartitionedEntities` is refused.
//!
//! Gmsh has no node sets, integers in data or blocks of cells, and ignores unknown sections. Such parts of a mesh are therefore written to
//! `$Gearwear`, one line of JSON (`keep::Keep`), where there are any.
//! Names with quotes or control characters cannot be written, nor data of more than nine components, nor integers beyond 2⁵³.

mod cell_types;
mod content;
mod keep;
mod output;
mod read;
mod scanner;
mod write;
mod write_cells;

pub(super) use read::read;
pub(super) use write::write;

/// Options of a written Gmsh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GmshStyle {
    /// Version of the format.
    pub version: GmshVersion,
    /// Text or binary numbers.
    pub encoding: GmshEncoding,
}

/// Version of the Gmsh format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GmshVersion {
    /// Version 2.2, common in other programs.
    V2,
    /// Version 4.1.
    #[default]
    V4,
}

/// Encoding of numbers in a Gmsh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GmshEncoding {
    /// Shortest decimals that read back as the same bits.
    Ascii,
    /// Little-endian bytes.
    #[default]
    Binary,
}
