//! The contact of a tooth pair as a source of heat, for wear laws that read what it does to the flank points in it.

use crate::contact::{Flanks, PairContact, PositionCell, Sweep};
use crate::gear::{Gear, PerGear};
use crate::thermal::{ContactHeat, SpeedRatios};
use crate::wear::{
    ContactConditions, WearModel,
    heated_row::{HeatedContact, HeatedRow, RowOfPoints},
};

/// What heat needs to know of the place of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeatedPlace {
    ratios: SpeedRatios,
    /// Distance of each flank's points there, mm.
    spacing_mm: PerGear<f64>,
}

/// A contact under its load, and where it is.
pub(super) struct HeatedPair<'a> {
    contact: HeatedContact<'a>,
    spacing_mm: PerGear<f64>,
    /// Whether rows of points run across it.
    across: bool,
}

impl HeatedPlace {
    /// The stretch of the path that a loading position stands for.
    pub(super) fn new(flanks: Flanks<'_>, cell: PositionCell) -> Self {
        let spacing = |gear: Gear| {
            let grid = flanks.grid[gear];
            let here = grid.place(flanks.geometry.contact_coordinate_mm(gear, cell.position_mm)).index;
            grid.arc_mm[here + 1] - grid.arc_mm[here]
        };
        Self {
            ratios: SpeedRatios::over(flanks.geometry, cell.lower_mm, cell.upper_mm),
            spacing_mm: PerGear::from_fn(spacing),
        }
    }

    /// A pair that is pressed together here; none where the law does not read what heat does.
    pub(super) fn under<'a>(
        &self,
        wear: &WearModel<'a>,
        pair: &dyn PairContact,
        line_load_n_per_mm: f64,
    ) -> Option<HeatedPair<'a>> {
        let heated = |heat: &'a ContactHeat| HeatedPair {
            contact: HeatedContact {
                heat,
                ratios: self.ratios,
                line_load_n_per_mm,
                half_width_mm: pair.footprint().half_width_mm,
            },
            spacing_mm: self.spacing_mm,
            across: pair.sweeps_across(),
        };
        wear.heat_of_law().map(heated)
    }
}

impl HeatedPair<'_> {
    /// The conditions of the points of `gear`'s flank in a sweep.
    pub(super) fn conditions<'r>(&self, row: &'r mut HeatedRow, gear: Gear, sweep: &Sweep) -> &'r [ContactConditions] {
        if self.across {
            let points = RowOfPoints { gear, spacing_mm: self.spacing_mm[gear], pressure_mpa: &sweep.pressure_mpa };
            row.across(&self.contact, points)
        } else {
            row.even(&self.contact, gear, sweep.pressure_mpa.len())
        }
    }
}
