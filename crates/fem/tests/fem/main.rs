//! Elements and solvers without a gear.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

#[path = "../common/mod.rs"]
mod common;

mod active_set;
mod axisymmetric;
mod hexahedra;
