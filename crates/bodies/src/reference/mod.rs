//! Closed forms, rules of interpolation, least squares and statistics with their sources, shared by the code, the tests and the validation.

pub mod cantilever;
pub mod flattening;
pub mod half_plane;
pub mod hertz_line;
pub mod lame_cylinder;
pub mod levenberg_marquardt;
pub mod linear_means;
pub mod monotone_cubic;
pub mod moving_heat_band;
pub mod persson;
pub mod radial_basis;
pub mod response_surface;
pub mod separate_peaks;
pub mod sobol_indices;
pub mod statistics;
pub mod steel_yield;
pub mod worn_cylinder;
