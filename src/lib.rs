//! **gearwear** predicts how the flanks of a gear pair wear, and what the wear does to pressure, load sharing and
//! transmission error.
//!
//! Everything flows one way, and the modules stand in that order:
//!
//! ```text
//! scene (what is asked) → plan (which stages it needs) → gear geometry → stiffness and contact
//!       → mesh cycle (who carries how much, where) → wear law and stepping → results → report
//! ```
//!
//! Inside the program one consistent system of units is used: mm, N, MPa, s, K; angles are in radians. Public names
//! carry their unit (`centre_distance_mm`), and quantities of helical gears say *normal* or *transverse*.
//!
//! `ARCHITECTURE.md` is the map of the code, `docs/theory.md` the derivations that the modules cite.

// The program, the tests and the examples name the library alike.
extern crate self as gearwear;

pub mod calibration;
#[cfg(feature = "program")]
pub mod cli;
pub mod contact;
pub mod data_table;
pub mod fem;
pub mod gear;
pub mod gear_mesh;
pub mod measurement;
pub mod mesh;
pub mod mesh_cycle;
pub mod observer;
pub mod pipeline;
pub mod plan;
pub mod reference;
pub mod report;
pub mod results;
pub mod resume;
pub mod scene;
pub mod simulation;
pub mod stiffness;
pub mod studies;
pub mod thermal;
pub mod wear;
mod whole_file;

#[cfg(test)]
#[path = "../tests/inside/mod.rs"]
mod inside;
