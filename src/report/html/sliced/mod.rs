//! The plots of a pair whose sections differ: everything over the flank's length and over the face width.

mod film_maps;
mod flank_maps;
mod load_maps;
mod over_width;
mod profiles;
pub(super) mod raster;
pub(super) mod sliced_run;
mod surfaces;
pub(super) mod tables;
mod tooth_cycle;

use self::sliced_run::SlicedRun;
use super::run_page::RunPlots;
use super::{cycle_plots, drawing_plot, film_plot, history_plot, mesh_orders, temperature_plot, torque_curve_plot};
use crate::report::chart::Chart;
use gearwear_bodies::gear::Gear;

/// All of them by their subjects.
pub(super) fn plots(run: SlicedRun<'_>) -> RunPlots {
    let of_both = |plot: fn(SlicedRun<'_>, Gear) -> Chart| Gear::BOTH.map(|gear| plot(run, gear));
    let mut over_width = [of_both(flank_maps::pressure_new), of_both(flank_maps::sliding)].concat();
    over_width.extend(of_both(surfaces::wear_and_pressure));
    over_width.extend(of_both(over_width::root_and_tip));
    over_width.extend(profiles::wear(run));
    over_width.extend(profiles::pressure(run));
    let mut mesh_cycle = load_maps::new_and_worn(run);
    mesh_cycle.extend([tooth_cycle::load_share(run), tooth_cycle::pressure(run)]);
    mesh_cycle.push(cycle_plots::transmission_error(run.record));
    mesh_cycle.extend(mesh_orders::new_and_worn(&run.record.summary));
    mesh_cycle.extend(torque_curve_plot::all(run.record));
    mesh_cycle.extend(cycle_plots::mesh_stiffness(run.record));
    let mut pair = vec![drawing_plot::pair(run.record)];
    pair.extend(Gear::BOTH.into_iter().filter_map(|gear| flank_maps::modifications(run, gear)));
    RunPlots {
        first: [of_both(flank_maps::wear), of_both(flank_maps::pressure_worn)].concat(),
        over_width,
        mesh_cycle,
        over_time: vec![history_plot::wear_against_time(run.record)],
        temperatures: temperature_plot::all(run.record),
        films: [film_maps::new_and_worn(run), film_plot::all(run.record)].concat(),
        pair,
    }
}
