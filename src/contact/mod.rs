//! Contact surfaces.

pub mod settings;
