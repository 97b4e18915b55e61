//! Tooth-stiffness curves.

pub mod settings;
