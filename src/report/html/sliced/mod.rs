//! The plots of a pair whose sections differ: everything over the flank's length and over the face width.

mod film_maps;
mod flank_maps;
mod load_maps;
mod mesh_orders;
mod over_width;
mod profiles;
pub(super) mod raster;
pub(super) mod sliced_run;
mod surfaces;
pub(super) mod tables;
mod tooth_cycle;

use self::sliced_run::SlicedRun;
use super::{cycle_plots, drawing_plot, film_plot, history_plot, temperature_plot};
use crate::report::chart::Chart;
use gearwear_bodies::gear::Gear;

/// All of them, in the order of the page.
pub(super) fn figures(run: SlicedRun<'_>) -> Vec<Chart> {
    let mut figures = vec![drawing_plot::pair(run.record)];
    for gear in Gear::BOTH {
        figures.extend(flank_maps::all(run, gear));
        figures.push(surfaces::wear_and_pressure(run, gear));
    }
    figures.extend(Gear::BOTH.map(|gear| over_width::root_and_tip(run, gear)));
    figures.extend(profiles::wear(run));
    figures.extend(profiles::pressure(run));
    figures.extend(load_maps::new_and_worn(run));
    figures.extend([tooth_cycle::load_share(run), tooth_cycle::pressure(run)]);
    figures.extend([cycle_plots::transmission_error(run.record), mesh_orders::new_and_worn(run)]);
    figures.extend(cycle_plots::mesh_stiffness(run.record));
    figures.extend(temperature_plot::all(run.record));
    figures.extend(film_maps::new_and_worn(run));
    figures.extend(film_plot::all(run.record));
    figures.push(history_plot::wear_against_time(run.record));
    figures
}
