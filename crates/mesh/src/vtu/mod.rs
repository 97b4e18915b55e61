//! VTK's files of unstructured grids, `.vtu`, as ParaView reads and writes them.
//!
//! Source: Kitware, *The VTK User's Guide*, "VTK File Formats" (XML file formats), and for compressed and appended data VTK's
//! `vtkXMLDataReader`.
//!
//! Read are arrays as ASCII, base64 or appended (base64 or raw), as they are or compressed with zlib, with either order of
//! bytes and headers of 32 or 64 bits; integers of all sizes become `i64`, floating-point numbers `f64`. One piece for each
//! file. Written are base64 compressed with zlib, or what else [`VtuEncoding`] names, little end first, with 64-bit headers.
//!
//! VTK knows neither sets nor tags nor blocks of cells. They are arrays too:
//!
//! | array | in the mesh |
//! |---|---|
//! | `set:NAME` of the points or cells, `UInt8`, all 0 or 1 | set `NAME`: those that have a 1 |
//! | `tag:NAME` of the file (`FieldData`), two integers | tag and dimension of set `NAME` |
//! | `gearwear:blocks` of the file, pairs of VTK cell type and number of cells | blocks, where they are not just runs of one type |
//!
//! The crate vtkio reads such files too, and our tests check that it reads ours; but it takes what it reads on trust (short
//! base64 ends in a panic, arrays of the wrong length vanish), which does not do for files of unknown origin.

mod array;
mod document;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;

/// How the arrays of a VTU file are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VtuEncoding {
    /// Compressed with zlib, as base64.
    #[default]
    Zlib,
    /// As base64.
    Base64,
    /// As the shortest decimals that read back as the same bits.
    Ascii,
}

/// The kinds of cells, for messages.
const ALLOWED: &str = "points, lines, triangles, quadrilaterals, tetrahedra, hexahedra, wedges and pyramids, linear or quadratic \
                       (VTK's types 1, 3, 5, 9, 10, 12, 13, 14 and 21 to 29)";
const SET: &str = "set:";
const TAG: &str = "tag:";
const BLOCKS: &str = "gearwear:blocks";
