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
//! | `*SURFACE, TYPE=ELEMENT`: sides `S1` … of plane elements and solids, `SPOS`, `SNEG`, `E1` … of shells | a block of line cells or faces and the set of that name |
//! | `*SURFACE, TYPE=NODE` | `point_sets` |
//! | `*PART`, `*INSTANCE` | every instance in its place; sets under `INSTANCE.NAME` and, all instances together, `NAME`; elements of an instance as a set of its name |
//! | `*INCLUDE`, `INPUT=` | the lines of that file |
//! | what the element type says beyond its nodes: `CPS4` plane stress, `CAX4` axisymmetric, `S4` shell … | `formulation` of the block |
//! | elements without a kind of cell: springs, dashpots, gaps, couplings, user elements … | `left_out`: their type and number |
//!
//! Keywords and unquoted names are case-insensitive, quoted names case-sensitive. Comments begin with `**` (or `>**`). A keyword line and
//! the nodes of an element continue after a comma at the end of the line. A surface and an element set of one name become one set. Of a single
//! part or instance names need no prefix. Refused are keywords that generate nodes or elements (`*NGEN`, `*SYSTEM` …) and surfaces
//! without sides. Everything else, materials and steps for example, is skipped. A `MASS` is its point: at rest it does nothing.
//!
//! In writing, cells of sets that lie on sides of elements only become `*SURFACE` and an `*NSET` of the same
//! name, without elements; they are read back in the direction of the element's side, the element on the left of lines, normals of
//! faces outwards. Other line cells become trusses. Plane elements without a formulation are written for plane strain (`CPE4` …). Data, for which the file has no place,
//! are refused, and tags of groups are left out.

mod assembly;
mod elements;
mod keywords;
mod read;
mod sets;
mod sources;
mod write;

pub(super) use elements::name as element_type;
pub(super) use read::read;
pub(super) use write::write;
