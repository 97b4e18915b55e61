//! The commands that run many scenes, from the outside.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

mod accuracy;
mod accuracy_helical;
mod coarse_run;
mod compare;
mod improve;
mod planetary;
#[path = "../program/mod.rs"]
mod program;
mod remaining_life;
mod sweep;
mod tutorials;
mod uncertainty;
mod validate;
mod variants;
