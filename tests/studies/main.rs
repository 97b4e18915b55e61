//! The commands that run many scenes, from the outside.

mod accuracy;
mod accuracy_helical;
mod compare;
#[path = "../program/mod.rs"]
mod program;
mod sweep;
mod validate;
