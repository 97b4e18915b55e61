//! Files of users and of runs: written whole or not at all ([`whole_file`]), known by their content ([`content_hash`]), text
//! in the encodings of other programs ([`text`]), no longer than their kind may be ([`size_limit`]), in memory that can be had ([`memory`]), tables
//! with the line of every fault ([`data_table`]).

pub mod content_hash;
pub mod data_table;
pub mod memory;
pub mod size_limit;
pub mod text;
pub mod whole_file;
