//! The commands about one pair, from the outside.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

mod bad_input;
mod calibrate;
mod explore;
mod fem_pair;
mod fem_problem;
mod helical_output;
mod init;
mod initial_flank;
mod internal_gears;
mod limits;
mod mesh;
mod phases;
mod plan;
mod planetary;
#[path = "../program/mod.rs"]
mod program;
mod resume;
mod rexs;
mod run;
mod stiffness_curve;
