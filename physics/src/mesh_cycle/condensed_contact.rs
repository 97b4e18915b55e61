//! A contact of the condensed pair as laws of wear see it: where it is on the path, and the conditions of its rows in its own heat.

use crate::fem::gear::condensed_pair::CondensedPair;
use crate::fem::gear::load_transfer::LoadTransfer;
use crate::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use crate::thermal::{ContactHeat, HeatedStrip, SpeedRatios};
use crate::wear::{
    ContactConditions,
    heated_row::{HeatedContact, HeatedRow, RowOfPoints},
};

/// A contact as a source of heat and a place of films.
#[derive(Clone, Copy)]
pub(super) struct ContactPlace<'a> {
    pub model: &'a CondensedPair<'a>,
    pub contact: &'a LoadTransfer,
    pub stretch_mm: (f64, f64),
}

impl ContactPlace<'_> {
    /// On the path; before A and after E, surfaces roll about as fast as there.
    pub(super) fn position_mm(&self) -> f64 {
        let path = &self.model.pair.path;
        let own_mm = self.stretch_mm.0.midpoint(self.stretch_mm.1) + f64::from(self.contact.pair) * path.base_pitch_mm;
        own_mm.clamp(path.start_mm, path.end_mm)
    }
}

/// The rows of a contact, whose multipliers stand for stretches of different lengths, as evenly spaced ones and back.
#[derive(Default)]
pub(super) struct HeatedContactRows {
    even_mpa: Vec<f64>,
    even_along_mm: Vec<f64>,
    even_sliding_mm: Vec<f64>,
    row: HeatedRow,
    conditions: Vec<ContactConditions>,
}

impl HeatedContactRows {
    /// The conditions of each row of a contact under `pressure_mpa`. The strip is as wide as Hertz's ellipse with the same second moment.
    pub(super) fn conditions(
        &mut self,
        heat: &ContactHeat,
        place: ContactPlace<'_>,
        gear: Gear,
        pressure_mpa: &[f64],
        friction_coefficient: f64,
    ) -> &[ContactConditions] {
        let ContactPlace { model, contact, stretch_mm } = place;
        let length_mm = stretch_mm.1 - stretch_mm.0;
        let rolling = PerGear::from_fn(|gear| model.pair.rolling_ratio(gear, place.position_mm()));
        let loads = pressure_mpa.iter().zip(&contact.weight_mm).map(|(pressure, weight)| pressure * weight);
        let (mut sum, mut first, mut second, mut slid) = (0.0, 0.0, 0.0, 0.0);
        for (i, load) in loads.enumerate() {
            let at = contact.along_mm[i];
            sum += load;
            first += load * at;
            second += load * (at * at + contact.weight_mm[i].powi(2) / 12.0);
            slid += load * contact.sliding_mm[i];
        }
        let variance = (second / sum - (first / sum).powi(2)).max(0.0);
        let strip = HeatedStrip {
            ratios: SpeedRatios { sliding: slid / sum / length_mm, rolling },
            line_load_n_per_mm: sum,
            half_width_mm: 2.0 * variance.sqrt(),
            friction_coefficient,
        };
        let heated = HeatedContact { heat, strip };
        let greatest = contact.along_mm.iter().copied().fold(0.0, f64::max);
        let count = (2 * contact.len()).max(2);
        let spacing_mm = greatest / (count - 1) as f64;
        // Along the profile from root to tip, which the wheel's runs the other way.
        let cell_of = |at: f64| {
            let at = if gear == Gear::Pinion { at } else { greatest - at };
            ((at / spacing_mm).round() as usize).min(count - 1)
        };
        self.even_along_mm.clear();
        self.even_along_mm.extend((0..count).map(|k| k as f64 * spacing_mm));
        for row in [&mut self.even_mpa, &mut self.even_sliding_mm] {
            row.clear();
            row.resize(count, 0.0);
        }
        for (i, &at) in contact.along_mm.iter().enumerate() {
            let half = 0.5 * contact.weight_mm[i];
            let (a, b) = (cell_of((at - half).max(0.0)), cell_of((at + half).min(greatest)));
            for k in a.min(b)..=a.max(b) {
                self.even_mpa[k] = pressure_mpa[i];
                self.even_sliding_mm[k] = contact.sliding_mm[i];
            }
        }
        let points = RowOfPoints { gear, along_mm: &self.even_along_mm, pressure_mpa: &self.even_mpa };
        let time_s = length_mm / heat.speed_mm_per_s;
        let even = self.row.across_sliding(&heated, points, &self.even_sliding_mm, time_s);
        self.conditions.clear();
        self.conditions.extend(contact.along_mm.iter().map(|&at| even[cell_of(at)]));
        &self.conditions
    }
}
