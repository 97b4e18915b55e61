//! Wear laws and stepping.

pub mod settings;
