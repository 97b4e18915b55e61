//! Finite-element contact of a gear pair: each gear condensed once, every position a small contact problem.

pub mod flank_surface;
pub mod position;
pub mod ring;
pub mod sector;
