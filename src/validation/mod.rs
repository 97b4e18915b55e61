//! The validation suite.

pub mod against;
