//! Input files of Abaqus (and CalculiX), `.inp`: the mesh in them.
//!
//! Source: Dassault Systèmes, *Abaqus Keywords Reference Guide*; the order of the three nodes of a quadratic line (end, middle,
//! end) from G. Dhondt, *CalculiX CrunchiX USER'S MANUAL*, "Three-node beam element".
//!
//! | in the file | in the mesh |
//! |---|---|
//! | `*NODE`, `NSET=` | `points`, `point_sets` |
//! | `*ELEMENT, TYPE=`, `ELSET=`: a block for each keyword | `cells`, `cell_sets` |
//! | `*NSET`, `*ELSET`, `GENERATE`, names of other sets, `*NSET, ELSET=` | `point_sets`, `cell_sets` |
//! | `*SURFACE, TYPE=ELEMENT`: sides `S1` … of plane elements | a block of line cells and the set of that name |
//! | `*SURFACE, TYPE=NODE` | `point_sets` |
//!
//! Keywords and unquoted names are compared without regard to case, quoted names with it. A keyword line and an element's
//! nodes may go on after a comma at the end of the line. A surface and an element set of one name become one set. One part is read, alone or with one instance that stays in its
//! place, and `INSTANCE.` in front of a name or number is dropped; a file of several parts is refused, because their node
//! numbers overlap (Abaqus writes a flat file where the model says so). Refused are also keywords that bring or make nodes
//! elsewhere (`*INCLUDE`, `INPUT=`, `*NGEN`, `*SYSTEM` …), surfaces of solids, and surfaces without sides. Everything else,
//! materials and steps for example, is skipped with its data.
//!
//! Writing: line cells of sets that lie altogether on sides of plane elements become `*SURFACE` and an `*NSET` of the same
//! name again, and need no elements of their own; they come back turned as the element's side is, the element on their left.
//! Other line cells become trusses. Plane elements are written for plane strain (`CPE4` …). The file has no place for data,
//! which are refused, nor for tags of groups, which are left out.

mod elements;
mod keywords;
mod read;
mod sets;
mod write;

pub(super) use read::read;
pub(super) use write::write;
