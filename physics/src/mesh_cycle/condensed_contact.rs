//! A contact of the condensed pair for laws of wear: its place on the path, and the conditions of its rows in its own heat.

use crate::contact::PressedCell;
use crate::contact::flank_pressure::ContactParts;
use crate::contact::standard_deviation::{HALF_WIDTH_OF_ELLIPSE, standard_deviation_mm};
use crate::thermal::{ContactHeat, HeatedStrip, SpeedRatios};
use crate::wear::{
    ContactConditions,
    heated_row::{HeatedContact, HeatedRow, RowOfPoints},
};
use gearwear_bodies::gear::{
    Gear, PerGear,
    conjugate::ConjugateFlanks,
    flank_zones::{FlankZone, FlankZones},
};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::flank_nodes::Weights;
use gearwear_bodies::gear_fem::load_transfer::LoadTransfer;
use gearwear_fem::weighted_sum::weighted_sum;

/// A contact as a source of heat and a place of films.
#[derive(Clone, Copy)]
pub(super) struct CondensedContactPlace<'a> {
    pub model: &'a CondensedPair<'a>,
    pub contact: &'a LoadTransfer,
    pub stretch_mm: (f64, f64),
}

impl CondensedContactPlace<'_> {
    /// Position on the path; before A and after E that of A and E, where surfaces roll about as fast.
    pub(super) fn position_mm(&self) -> f64 {
        let path = &self.model.pair.path;
        let own_mm = self.stretch_mm.0.midpoint(self.stretch_mm.1) + f64::from(self.contact.pair) * path.base_pitch_mm;
        own_mm.clamp(path.start_mm, path.end_mm)
    }
}

/// Cells of a contact under `force` on its rows, and the zones of the flanks along it; nodes of the flanks have the nominal radii `radius_mm`.
///
/// Cells reach from the middle of a row to that of the next: multipliers at the corners and in the middle of quadratic elements lie to
/// opposite sides of the pressure, and together they carry its load.
pub(super) fn parts_of_rows(
    contact: &LoadTransfer,
    force: &[f64],
    radius_mm: PerGear<&[f64]>,
    zones: &PerGear<FlankZones>,
) -> (ContactParts, Vec<PressedCell>) {
    let mut order: Vec<usize> = (0..contact.len()).collect();
    order.sort_by(|&a, &b| contact.along_mm[a].total_cmp(&contact.along_mm[b]));
    let mut cells = Vec::with_capacity(order.len() + 1);
    let (mut flank_mm, mut edges_mm) = ([f64::INFINITY, f64::NEG_INFINITY], [f64::NEG_INFINITY, f64::INFINITY]);
    let (mut lower_mm, mut half_row_mm, mut half_force) = (0.0, 0.0, 0.0);
    let mut middle_mm = 0.0;
    for i in order {
        let next_half_mm = 0.5 * contact.weight_mm[i];
        middle_mm += half_row_mm + next_half_mm;
        cells.push(cell(lower_mm, middle_mm, half_force + 0.5 * force[i]));
        lower_mm = middle_mm;
        (half_row_mm, half_force) = (next_half_mm, 0.5 * force[i]);
        let at = PerGear::from_fn(|gear| weighted_mean(contact.means[gear].row(i), radius_mm[gear]));
        if Gear::BOTH.into_iter().all(|gear| zones[gear].at(at[gear]) == FlankZone::Active) {
            flank_mm = [flank_mm[0].min(middle_mm), flank_mm[1].max(middle_mm)];
        }
        let [pinion_at_tip, wheel_at_tip] =
            Gear::BOTH.map(|gear| at[gear] + next_half_mm >= zones[gear].tip_end_radius_mm);
        if force[i] > 0.0 && wheel_at_tip {
            edges_mm[0] = edges_mm[0].max(middle_mm);
        }
        if force[i] > 0.0 && pinion_at_tip {
            edges_mm[1] = edges_mm[1].min(middle_mm);
        }
    }
    if half_row_mm > 0.0 {
        cells.push(cell(lower_mm, middle_mm + half_row_mm, half_force));
    }
    if flank_mm[0] > flank_mm[1] {
        flank_mm = [0.0; 2];
    }
    (ContactParts { flank_mm, edges_mm, flank_mean_over_mm: zones.pinion.pressure_length_mm }, cells)
}

/// A cell under a load, N/mm.
fn cell(lower_mm: f64, upper_mm: f64, load: f64) -> PressedCell {
    PressedCell { lower_mm, upper_mm, pressure_mpa: load / (upper_mm - lower_mm) }
}

/// Mean of the values at the nodes of a row; NaN for a row that faces none.
fn weighted_mean(Weights { first, weights }: Weights<'_>, at_nodes: &[f64]) -> f64 {
    weighted_sum(weights, &at_nodes[first..]) / weights.iter().sum::<f64>()
}

/// Buffers that bring the rows of a contact, of different lengths, onto evenly spaced ones and back.
#[derive(Default)]
pub(super) struct HeatedContactRows {
    even_mpa: Vec<f64>,
    even_along_mm: Vec<f64>,
    even_sliding_mm: Vec<f64>,
    row: HeatedRow,
    conditions: Vec<ContactConditions>,
}

impl HeatedContactRows {
    /// Conditions of each row of a contact under `pressure_mpa`, in a strip as wide as Hertz's ellipse with the same second moment.
    pub(super) fn conditions(
        &mut self,
        heat: &ContactHeat,
        place: CondensedContactPlace<'_>,
        gear: Gear,
        pressure_mpa: &[f64],
        friction_coefficient: f64,
    ) -> &[ContactConditions] {
        let CondensedContactPlace { model, contact, stretch_mm } = place;
        let length_mm = stretch_mm.1 - stretch_mm.0;
        let rolling = PerGear::from_fn(|gear| model.pair.rolling_ratio(gear, place.position_mm()));
        let loads = pressure_mpa.iter().zip(&contact.weight_mm).map(|(pressure, weight)| pressure * weight);
        let half_width_mm = equivalent_half_width_mm(contact, loads.clone());
        let sum: f64 = loads.clone().sum();
        let slid: f64 = loads.zip(&contact.sliding_mm).map(|(load, sliding_mm)| load * sliding_mm).sum();
        let strip = HeatedStrip {
            ratios: SpeedRatios { sliding: slid / sum / length_mm, rolling },
            line_load_n_per_mm: sum,
            half_width_mm,
            friction_coefficient,
        };
        let heated = HeatedContact { heat, strip };
        let greatest = contact.along_mm.iter().copied().fold(0.0, f64::max);
        let count = (2 * contact.len()).max(2);
        let spacing_mm = greatest / (count - 1) as f64;
        let even_rows = EvenRows { gear, length_mm: greatest, spacing_mm, count };
        self.even_along_mm.clear();
        self.even_along_mm.extend((0..count).map(|k| k as f64 * spacing_mm));
        for row in [&mut self.even_mpa, &mut self.even_sliding_mm] {
            row.clear();
            row.resize(count, 0.0);
        }
        for (i, &at) in contact.along_mm.iter().enumerate() {
            let half = 0.5 * contact.weight_mm[i];
            let (a, b) = (even_rows.at((at - half).max(0.0)), even_rows.at((at + half).min(greatest)));
            for k in a.min(b)..=a.max(b) {
                self.even_mpa[k] = pressure_mpa[i];
                self.even_sliding_mm[k] = contact.sliding_mm[i];
            }
        }
        let points = RowOfPoints { gear, along_mm: &self.even_along_mm, pressure_mpa: &self.even_mpa };
        let time_s = length_mm / heat.speed_mm_per_s;
        let even = self.row.across_sliding(&heated, points, &self.even_sliding_mm, time_s);
        self.conditions.clear();
        self.conditions.extend(contact.along_mm.iter().map(|&at| even[even_rows.at(at)]));
        &self.conditions
    }
}

/// Half-width of Hertz's ellipse with the same second moment as the loads of the rows of a contact, mm.
pub(super) fn equivalent_half_width_mm(contact: &LoadTransfer, loads: impl Iterator<Item = f64>) -> f64 {
    let cells = loads.zip(contact.along_mm.iter().zip(&contact.weight_mm));
    let cells = cells.map(|(load, (at_mm, weight_mm))| cell(at_mm - 0.5 * weight_mm, at_mm + 0.5 * weight_mm, load));
    HALF_WIDTH_OF_ELLIPSE * standard_deviation_mm(cells)
}

/// Evenly spaced rows of a contact along the profile of a gear, from root to tip.
struct EvenRows {
    gear: Gear,
    length_mm: f64,
    spacing_mm: f64,
    count: usize,
}

impl EvenRows {
    /// Row nearest to a place along the contact, towards the pinion's tip.
    fn at(&self, along_mm: f64) -> usize {
        let at = if self.gear == Gear::Pinion { along_mm } else { self.length_mm - along_mm };
        ((at / self.spacing_mm).round() as usize).min(self.count - 1)
    }
}
