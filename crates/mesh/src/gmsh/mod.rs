//! Gmsh's `.msh` files, versions 2.2 and 4.1, ASCII and binary.
//!
//! Source: C. Geuzaine and J.-F. Remacle, *Gmsh Reference Manual*, "MSH file format" (4.1) and "MSH file format version 2
//! (Legacy)"; the order of nodes in cells from "Node ordering" there and from VTK's cell classes.
//!
//! | in the file | in the mesh |
//! |---|---|
//! | `$Nodes`, in the order of the file, numbers with gaps or not | `points` |
//! | `$Elements`: a block for each run of one kind | `cells` |
//! | a physical group: its name, or its tag where it has none (`7`; `7-lines`, `7-surfaces`, … where groups of several dimensions share the tag) | `cell_sets`, `field_data` |
//! | `$NodeData`, `$ElementData`: the last one of a name; NaN where nothing is given | `point_data`, `cell_data` |
//! | `$Gearwear` (below) | what Gmsh has no place for |
//!
//! In 4.1 a cell is in all groups of its entity. In 2.2 Gmsh writes a cell once for each of its groups; such copies (same
//! nodes, same entity, another group) become one cell again. Parameters of nodes on curves and surfaces are read over, as are
//! `$Periodic` and all sections unknown; `$PartitionedEntities` is refused.
//!
//! Gmsh knows neither node sets, nor integers in data, nor blocks of cells, and ignores sections it does not know. So
//! `$Gearwear`, one line of JSON (`keep::Keep`), holds what is left of a mesh; it is written only where something is.
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

/// How a Gmsh file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GmshStyle {
    /// The version of the format.
    pub version: GmshVersion,
    /// Numbers as text or as they are in memory.
    pub encoding: GmshEncoding,
}

/// A version of Gmsh's format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GmshVersion {
    /// 2.2, which other programs like to write.
    V2,
    /// 4.1.
    #[default]
    V4,
}

/// How numbers stand in a Gmsh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GmshEncoding {
    /// As the shortest decimals that read back as the same bits.
    Ascii,
    /// As bytes, little end first.
    #[default]
    Binary,
}
