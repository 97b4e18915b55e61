//! `report.html`: one page that holds everything it needs, and asks the network for nothing.
//!
//! The page is its words and tables in plain HTML, its plots as SVG in the colours of the style sheet (`page.css`) for light, dark and paper,
//! and a script (`page.js`) that enlarges the plots, reads their points as JSON and moves their sliders. Surfaces in space are drawn by
//! `surface.js`.

pub mod active_flank;
mod cycle_plots;
mod drawing_plot;
pub mod field_plot;
pub mod figures_table;
mod film_plot;
mod film_table;
mod flank_plots;
mod history_plot;
pub mod law_table;
mod mesh_orders;
pub mod number;
pub mod page;
pub mod reading;
pub mod root_stress_table;
pub mod run_page;
mod sliced;
pub mod table;
mod temperature_plot;
mod terms;
mod torque_curve_plot;
