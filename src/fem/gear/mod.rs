//! Finite-element contact of a gear pair: each gear condensed once, every position a small contact problem.

pub(crate) mod condensed_pair;
pub(crate) mod cycle;
mod facing_teeth;
pub(crate) mod flank_nodes;
pub(crate) mod flank_surface;
pub(crate) mod full;
pub(crate) mod in_space;
pub(crate) mod load_transfer;
pub(crate) mod model;
pub(crate) mod placement;
pub(crate) mod position;
pub(crate) mod prepared;
pub(crate) mod ring;
pub(crate) mod sector;
pub(crate) mod tilted;
