//! Finite-element contact of a gear pair: each gear is condensed once, and every position is a small contact problem.

mod beside_window;
pub mod condensed_pair;
pub mod cycle;
mod facing_teeth;
pub mod flank_nodes;
pub mod flank_surface;
pub mod full;
mod half_turn;
pub mod in_space;
mod kinks;
pub mod load_transfer;
pub mod model;
pub mod placement;
pub mod position;
pub mod prepared;
pub mod ring;
mod sandwich;
pub mod sector;
pub mod tilted;
