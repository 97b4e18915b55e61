//! Meshes in input files of Abaqus (and CalculiX), `.inp`.
//!
//! Source: Dassault Systèmes, *Abaqus Keywords Reference Guide*; the order of the three nodes of a quadratic line (end, middle,
//! end) from G. Dhondt, *CalculiX CrunchiX USER'S MANUAL*, "Three-node beam element".
//!
//! | in the file | in the mesh |
//! |---|---|
//! | `*NODE`, `NSET=` | `points`, `point_sets` |
//! | `*ELEMENT, TYPE=`, `ELSET=` | `cells`, a block for each keyword, `cell_sets` |
//! | `*NSET`, `*ELSET`, `GENERATE`, names of other sets, `*NSET, ELSET=` | `point_sets`, `cell_sets` |
//! | `*SURFACE, TYPE=ELEMENT`: sides `S1` … of plane elements | a block of line cells and the set of that name |
//! | `*SURFACE, TYPE=NODE` | `point_sets` |
//!
//! Keywords and unquoted names are case-insensitive, quoted names case-sensitive. A keyword line and the nodes of an element
//! continue after a comma at the end of the line. A surface and an element set of one name become one set. One part is read, alone or with one
//! untransformed instance, and the prefix `INSTANCE.` of a name or number is dropped; a file of several parts is refused, because their node
//! numbers overlap (Abaqus can write a flat file instead). Refused are also keywords that include or generate nodes
//! (`*INCLUDE`, `INPUT=`, `*NGEN`, `*SYSTEM` …), surfaces of solids, and surfaces without sides. Everything else,
//! materials and steps for example, is skipped.
//!
//! In writing, line cells of sets that lie on sides of plane elements only become `*SURFACE` and an `*NSET` of the same
//! name, without elements; they are read back in the direction of the element's side, the element on their left.
//! Other line cells become trusses. Plane elements are written for plane strain (`CPE4` …). Data, for which the file has no place,
//! are refused, and tags of groups are left out.

mod elements;
mod keywords;
mod read;
mod sets;
mod write;

pub(super) use read::read;
pub(super) use write::write;
