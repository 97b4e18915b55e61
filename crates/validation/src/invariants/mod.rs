//! Statements that hold for every scene, tested on random scenes over the whole schema.
//!
//! A scene is drawn from a seed and its number ([`scene_generator`]) and run. Its own invariants are judged first (`summary.invariants`, and what
//! every record must be). Then [`relations`] make other scenes of it of which physics says how their results follow from each other: roles exchanged,
//! sizes scaled, coefficients against duration, neutral keys. Every fourth relation is tried on a scene, another fourth on the next.
//!
//! The result is a table of relation, count and worst deviation with the number of the scene ([`record`]); scenes that violate
//! one are written beside it ([`report`]).

pub mod carried_out;
pub mod comparison;
pub mod record;
pub mod relation;
mod relations;
pub mod report;
pub mod scene_generator;
mod scene_table;
pub mod study;
mod traits_of_scene;
