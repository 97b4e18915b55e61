//! Closed forms, interpolation and statistics with their sources, shared by code, tests and validation.

pub mod cantilever;
pub mod flattening;
pub(crate) mod half_plane;
pub mod hertz_line;
pub mod lame_cylinder;
pub mod linear_means;
pub(crate) mod monotone_cubic;
pub mod moving_heat_band;
pub mod persson;
pub mod separate_peaks;
pub mod sobol_indices;
pub mod statistics;
pub mod steel_yield;
pub mod worn_cylinder;
