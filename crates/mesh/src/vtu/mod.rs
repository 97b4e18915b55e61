//! VTK files of unstructured grids, `.vtu`, as ParaView reads and writes them.
//!
//! Source: Kitware, *The VTK User's Guide*, "VTK File Formats" (XML file formats), and for compressed and appended data VTK's
//! `vtkXMLDataReader`.
//!
//! Read are ASCII, base64 and appended arrays (base64 or raw), uncompressed or compressed with zlib, of either byte
//! order with headers of 32 or 64 bits; integers of all sizes become `i64`, floating-point numbers `f64`. A file has one piece.
//! Written are base64 compressed with zlib, or another [`VtuEncoding`], in little-endian order with 64-bit headers.
//!
//! Sets, tags and blocks of cells, which VTK does not have, are arrays too:
//!
//! | array | in the mesh |
//! |---|---|
//! | `set:NAME` of the points or cells, `UInt8`, all 0 or 1 | set `NAME` of those with a 1 |
//! | `tag:NAME` of the file (`FieldData`), two integers | tag and dimension of set `NAME` |
//! | `gmsh:physical` of the cells, integers, as meshio and Gmsh's users write physical groups | sets named after the tag, or after the name that a `tag:NAME` gives it; [`crate::tag_groups()`] |
//! | `gearwear:formulations` of the file | formulation of each block, 0 for none |
//! | `gearwear:blocks` of the file, pairs of VTK cell type and number of cells | blocks, where they are not runs of one type |
//!
//! The crate vtkio, with which tests read these files, is not used as it does not check what it reads (short
//! base64 ends in a panic, arrays of the wrong length are dropped).

mod array;
mod document;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;

/// Encoding of the arrays of a VTU file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VtuEncoding {
    /// Base64, compressed with zlib.
    #[default]
    Zlib,
    /// Base64.
    Base64,
    /// Shortest decimals that read back as the same bits.
    Ascii,
}

/// Kinds of cells, for messages.
const ALLOWED: &str = "points, lines, triangles, quadrilaterals, tetrahedra, hexahedra, wedges and pyramids, linear or quadratic \
                       (VTK's types 1, 3, 5, 9, 10, 12, 13, 14 and 21 to 29)";
const SET: &str = "set:";
const TAG: &str = "tag:";
const BLOCKS: &str = "gearwear:blocks";
const FORMULATIONS: &str = "gearwear:formulations";
