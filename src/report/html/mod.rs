//! `report.html`: one page that holds everything it needs, and asks the network for nothing.
//!
//! The page is its words and tables in plain HTML, its plots as SVG in the colours of the style sheet (`page.css`) for light, dark and paper,
//! and a script (`page.js`) that enlarges the plots, reads their points as JSON and moves their sliders. Surfaces in space are drawn by
//! `surface.js`.

pub(crate) mod active_flank;
mod cycle_plots;
mod drawing_plot;
pub(crate) mod field_plot;
pub(crate) mod figures_table;
mod film_plot;
mod film_table;
mod flank_plots;
mod history_plot;
pub(crate) mod law_table;
pub(crate) mod number;
pub(crate) mod page;
pub(crate) mod reading;
pub(crate) mod root_stress_table;
pub(crate) mod run_page;
mod sliced;
pub(crate) mod table;
mod temperature_plot;
mod terms;
