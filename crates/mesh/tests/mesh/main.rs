//! Mesh files of every format, written and read back.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

mod abaqus;
mod common;
mod files;
mod fuzz;
