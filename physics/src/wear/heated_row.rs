//! Conditions of flank points in a heated contact, in rows that are filled anew for every contact.

use super::ContactConditions;
use crate::thermal::{ContactHeat, HeatedStrip, band::Spread};
use gearwear_bodies::gear::Gear;

/// A contact heated by friction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeatedContact<'a> {
    /// Friction heat of the pair.
    pub heat: &'a ContactHeat,
    /// Heated strip.
    pub strip: HeatedStrip,
}

impl HeatedContact<'_> {
    fn at(&self, rise_k: f64) -> ContactConditions {
        self.sliding_at(self.heat.sliding_speed_mm_per_s(&self.strip.ratios), rise_k)
    }

    fn sliding_at(&self, sliding_speed_mm_per_s: f64, rise_k: f64) -> ContactConditions {
        ContactConditions { sliding_speed_mm_per_s, temperature_k: self.heat.settings.bulk_temperature_k + rise_k }
    }

    /// Conditions where `gear`'s surface is hottest.
    pub(crate) fn at_hottest(&self, gear: Gear, spread: Spread) -> ContactConditions {
        let band = self.heat.band(&self.strip);
        self.at(band.greatest_rise_k(gear, spread))
    }
}

/// Consecutive points of a gear's flank, from root to tip, that run across a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowOfPoints<'a> {
    /// Gear of the flank.
    pub gear: Gear,
    /// Place of each along the flank, rising, mm.
    pub along_mm: &'a [f64],
    /// Pressure on each, MPa.
    pub pressure_mpa: &'a [f64],
}

/// A row of conditions.
#[derive(Debug, Clone, Default)]
pub(crate) struct HeatedRow {
    rise_k: Vec<f64>,
    conditions: Vec<ContactConditions>,
}

impl HeatedRow {
    /// Conditions of points across the contact.
    pub(crate) fn across(&mut self, contact: &HeatedContact<'_>, points: RowOfPoints<'_>) -> &[ContactConditions] {
        self.heat_up(contact, points);
        self.conditions.clear();
        self.conditions.extend(self.rise_k.iter().map(|&rise| contact.at(rise)));
        &self.conditions
    }

    /// Conditions of points across the contact that each slide by `sliding_mm` in the time `time_s`.
    pub(crate) fn across_sliding(
        &mut self,
        contact: &HeatedContact<'_>,
        points: RowOfPoints<'_>,
        sliding_mm: &[f64],
        time_s: f64,
    ) -> &[ContactConditions] {
        self.heat_up(contact, points);
        self.conditions.clear();
        let points = self.rise_k.iter().zip(sliding_mm);
        self.conditions.extend(points.map(|(&rise, sliding)| contact.sliding_at(sliding / time_s, rise)));
        &self.conditions
    }

    fn heat_up(&mut self, contact: &HeatedContact<'_>, points: RowOfPoints<'_>) {
        self.rise_k.resize(points.pressure_mpa.len(), 0.0);
        let band = contact.heat.band(&contact.strip);
        band.rises_k(points.gear, points.along_mm, points.pressure_mpa, &mut self.rise_k);
    }

    /// Conditions of `points` of `gear`'s flank at the hottest place of an evenly heated contact.
    pub(crate) fn even(&mut self, contact: &HeatedContact<'_>, gear: Gear, points: usize) -> &[ContactConditions] {
        self.conditions.clear();
        self.conditions.resize(points, contact.at_hottest(gear, Spread::Even));
        &self.conditions
    }
}
