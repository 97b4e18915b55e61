//! Measured flanks: traces of gear measuring machines and styluses, and their place on the flank of a gear.
//!
//! | module | what it does |
//! |---|---|
//! | [`mod@file`] | the file with its header, in the formats `table` and `mka` |
//! | [`teeth`] | mean of the profiles of some teeth |
//! | [`profile`] | points on the flank of a gear |
//! | [`mka_export`] | a profile as such an export |
//! | [`initial`] | the flank with which a run begins |

pub mod file;
pub mod initial;
mod mka;
pub mod mka_export;
pub mod profile;
mod table;
pub mod teeth;
mod undefined;
