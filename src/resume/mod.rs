//! Runs that go on where they were broken off: what lies in the folder of a run for that.
//!
//! | file | what |
//! |---|---|
//! | `scene.toml` | the resolved scene, written before the run begins |
//! | `inputs/` | copies of the files that the scene names; `scene.toml` names these |
//! | `checkpoint.bin` | the last checkpoint ([`mod@file`]), until the run has ended |
//! | `record.bin` | the whole result ([`result`]), after the other files |
//! | `summary.json` | written last of all: the run has ended |
//!
//! So a folder that a run began can be run again from what lies in it, wherever it is moved to. A checkpoint says of which scene, input
//! files and version of the program it is ([`identity`]): results are the same bits only where all of these are the same.

pub mod file;
pub mod folder;
pub mod identity;
pub mod keeper;
pub mod kept_run;
pub mod result;
