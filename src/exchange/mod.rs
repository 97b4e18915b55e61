//! Gear pairs out of the files of other programs, as the text of a scene.

pub mod rexs;
