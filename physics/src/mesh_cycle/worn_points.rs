//! Wear of the flank points in a contact of a tooth pair, with the heat and the film of the contact for laws that read them.

use super::load_sharing::MeshedPair;
use crate::contact::{Flanks, Footprint, PositionCell, Sweep};
use crate::lubrication::running_pair::LoadedPlace;
use crate::thermal::{HeatedStrip, SpeedRatios};
use crate::wear::{
    ContactConditions, SlidingRow, WearModel,
    heated_row::{HeatedContact, HeatedRow, RowOfPoints},
};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::reference::hertz_line::PEAK_OVER_MEAN;

/// Place of a contact on the path, for heat and film.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactOnPath<'a> {
    position_mm: f64,
    ratios: SpeedRatios,
    /// Places of the points of each flank along it, mm.
    arc_mm: PerGear<&'a [f64]>,
    /// Part of the width that is in contact, and carries all of the load.
    part: f64,
}

/// A contact that heats the points of both flanks.
struct HeatedPair<'a> {
    contact: HeatedContact<'a>,
    arc_mm: PerGear<&'a [f64]>,
    /// Whether rows of points run across it.
    across: bool,
}

impl<'p> ContactOnPath<'p> {
    /// Place of a loading position.
    pub(super) fn new(flanks: Flanks<'p>, cell: PositionCell) -> Self {
        Self {
            position_mm: cell.position_mm,
            ratios: SpeedRatios::over(&flanks.geometry, cell.lower_mm, cell.upper_mm),
            arc_mm: flanks.grid.map(|grid| grid.arc_mm.as_slice()),
            part: 1.0,
        }
    }

    /// The place where only this part of the width is in contact.
    pub(super) fn of_part(self, part: f64) -> Self {
        Self { part, ..self }
    }

    /// Contact of a pair under load here; none where neither law reads contact conditions.
    fn under<'a>(
        &self,
        wear: &WearModel<'a>,
        loaded: &LoadedPlace,
        (half_width_mm, across): (f64, bool),
    ) -> Option<HeatedPair<'a>>
    where
        'p: 'a,
    {
        wear.heat_of_laws().map(|heat| HeatedPair {
            contact: HeatedContact {
                heat,
                strip: HeatedStrip {
                    ratios: self.ratios,
                    line_load_n_per_mm: loaded.line_load_n_per_mm,
                    half_width_mm,
                    friction_coefficient: wear.friction(heat, loaded),
                },
            },
            arc_mm: self.arc_mm,
            across,
        })
    }
}

impl HeatedPair<'_> {
    /// Conditions of the points of `gear`'s flank in a sweep.
    fn conditions<'r>(&self, row: &'r mut HeatedRow, gear: Gear, sweep: &Sweep) -> &'r [ContactConditions] {
        if self.across {
            let along_mm = &self.arc_mm[gear][sweep.first_point..sweep.first_point + sweep.pressure_mpa.len()];
            let points = RowOfPoints { gear, along_mm, pressure_mpa: &sweep.pressure_mpa };
            row.across(&self.contact, points)
        } else {
            row.even(&self.contact, gear, sweep.pressure_mpa.len())
        }
    }
}

/// Buffers for the points of one contact.
#[derive(Default)]
pub(super) struct WornPoints {
    sweep: Sweep,
    heated: HeatedRow,
}

impl WornPoints {
    /// Adds the wear of the points of both flanks, which have lost `removed_mm`, in the contact of `pair` at `place` to `depth_mm`, in which the
    /// points begin at `first`.
    pub(super) fn wear(
        &mut self,
        wear: &WearModel<'_>,
        (pair, place): (&MeshedPair<'_>, &ContactOnPath<'_>),
        removed_mm: PerGear<&[f64]>,
        first: PerGear<usize>,
        depth_mm: &mut PerGear<Vec<f64>>,
    ) {
        let Self { sweep, heated } = self;
        // A surface whose points pass through all of the contact has its mean pressure.
        let greatest = if pair.contact.sweeps_across() { 1.0 } else { PEAK_OVER_MEAN };
        let Footprint { peak_pressure_mpa, half_width_mm, equivalent_half_width_mm, .. } = pair.contact.footprint();
        let loaded = LoadedPlace {
            position_mm: place.position_mm,
            line_load_n_per_mm: pair.response.line_load_n_per_mm / place.part,
            peak_pressure_mpa: greatest * peak_pressure_mpa,
            half_width_mm,
        };
        let source = place.under(wear, &loaded, (equivalent_half_width_mm, pair.contact.sweeps_across()));
        let lambdas = wear.lambdas(&loaded);
        for gear in Gear::BOTH {
            pair.contact.sweep(gear, removed_mm, sweep);
            let points = first[gear] + sweep.first_point..first[gear] + sweep.first_point + sweep.sliding_mm.len();
            let source = source.as_ref().filter(|_| wear.laws[gear].reads_conditions());
            let conditions = source.map(|source| source.conditions(heated, gear, sweep));
            let row = SlidingRow {
                pressure_mpa: &sweep.pressure_mpa,
                sliding_mm: &sweep.sliding_mm,
                conditions,
                lambda: lambdas[gear],
                is_continuous: false,
            };
            wear.laws[gear].add_depth(&row, &mut depth_mm[gear][points]);
        }
    }
}
