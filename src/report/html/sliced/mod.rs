//! The plots of a pair whose sections differ: everything over the flank's length and over the face width.

mod flank_maps;
mod load_maps;
mod mesh_orders;
mod over_width;
mod profiles;
pub mod raster;
mod surfaces;
pub mod tables;
mod tooth_cycle;

use super::number::given;
use super::theme::Figure;
use super::{cycle_plots, drawing_plot, history_plot, temperature_plot};
use crate::gear::Gear;
use crate::results::run::{FlankRecord, HelicalSummary, RunRecord, SliceRecord};

/// A run with slices: the whole record, and the parts of it that are there.
#[derive(Clone, Copy)]
pub struct SlicedRun<'a> {
    /// Everything.
    pub record: &'a RunRecord,
    /// The mesh of one tooth slice by slice.
    pub slices: &'a SliceRecord,
    /// The figures of the slices.
    pub helical: &'a HelicalSummary,
}

impl<'a> SlicedRun<'a> {
    /// None where all sections of `record` are alike.
    pub fn of(record: &'a RunRecord) -> Option<Self> {
        let (slices, helical) = (record.slices.as_ref()?, record.summary.helical.as_ref()?);
        Some(Self { record, slices, helical })
    }
}

/// All of them, in the order of the page.
pub fn figures(run: SlicedRun<'_>) -> Vec<Figure> {
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
    figures.extend(temperature_plot::all(run.record));
    figures.push(history_plot::wear_against_time(run.record));
    figures
}

/// "slice 3 (2.5 mm)": its number from 1 on and its place over the face width.
fn slice_name(flank: &FlankRecord, slice: usize) -> String {
    format!("slice {} ({} mm)", slice + 1, given((flank.width_mm[slice] * 1e3).round() / 1e3))
}
