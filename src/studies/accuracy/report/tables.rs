//! `accuracy.csv`, `wear_profiles.csv` and, of pairs with slices, `over_width.csv`; the profiles are those of the reference and of
//! every run of the finest resolution, of slices over the face width the first, the middle and the last.

#![allow(non_snake_case, reason = "column names end in their unit as engineers write it")]

use std::io::{self, Write};

use schemars::JsonSchema;
use serde::Serialize;

use crate::gear::Gear;
use crate::report::csv_table::{Provenance, columns, table, table_of, variants};
use crate::studies::accuracy::record::{AccuracyRecord, Quantity, VariantRecord};

#[derive(Serialize, JsonSchema)]
struct OverWidthRow<'a> {
    /// of the run; reference for the reference
    name: &'a str,
    /// pinion or wheel
    gear: Gear,
    /// place over the face width
    width_mm: f64,
    /// greatest wear depth within 2 mm of radius above the start of active profile
    root_wear_um: f64,
}

#[derive(Serialize, JsonSchema)]
struct ProfileRow<'a> {
    /// of the run; reference for the reference
    name: &'a str,
    /// pinion or wheel
    gear: Gear,
    /// distance from the gear's axis
    radius_mm: f64,
    /// place over the face width
    width_mm: f64,
    /// wear depth, normal to the flank
    wear_um: f64,
    /// wear depth less the reference's
    difference_um: f64,
}

/// A run; beside these columns every quantity has its error and whether the run is on its Pareto front.
#[derive(Serialize, JsonSchema)]
struct RunRow<'a> {
    /// of the run: surface · stiffness · resolution
    name: &'a str,
    /// contact surface
    surface: &'a str,
    /// what K/H shares with Hertz or the calibration; empty where the surface has no K/H
    #[serde(rename = "match")]
    match_criterion: Option<&'a str>,
    /// whether K/H is the calibration's, for every position and load
    calibrated: bool,
    /// whether a tip edge is followed into contact before A and after E
    tip_contact: bool,
    /// tooth stiffness; empty for finite elements, which bring their own
    stiffness: Option<&'a str>,
    /// of surface fem
    elements_per_half_width: Option<String>,
    /// over the face width; empty where all sections are alike
    slices: Option<usize>,
    /// of the slices
    coupling: Option<&'a str>,
    /// intervals of a flank
    flank_points: usize,
    /// loading positions from A to E
    positions: usize,
    /// pinion revolutions a wear step
    step_revolutions: String,
    /// wall time of the wear run alone, the least of the repeats
    simulation_s: Option<String>,
    /// wall time of everything before it
    setup_s: Option<String>,
    /// how often it was run for its time
    repeats: u32,
    /// wear steps taken
    wear_steps: Option<u64>,
    /// equilibria solved
    equilibria: Option<u64>,
    /// iterations in all of them
    newton_iterations: Option<u64>,
    /// evaluations of a tooth pair's contact
    pair_evaluations: Option<u64>,
    /// greatest wear depth on the pinion's active profile, its tip edge apart
    pinion_peak_wear_um: Option<String>,
    /// the same of the wheel
    wheel_peak_wear_um: Option<String>,
    /// whether the reference was extrapolated from it
    part_of_reference: bool,
    /// why there is no result, where there is none
    failure: Option<&'a str>,
}

impl<'a> RunRow<'a> {
    fn of(variant: &'a VariantRecord) -> Self {
        let s = &variant.settings;
        let (work, wear) = (variant.work, variant.peak_wear_um);
        Self {
            name: &variant.name,
            surface: &s.surface,
            match_criterion: s.match_criterion.as_deref(),
            calibrated: s.calibrated,
            tip_contact: s.tip_contact,
            stiffness: s.stiffness.as_deref(),
            elements_per_half_width: text(s.elements_per_half_width),
            slices: s.slices,
            coupling: s.coupling.as_deref(),
            flank_points: s.flank_points,
            positions: s.positions,
            step_revolutions: s.step_revolutions.to_string(),
            simulation_s: text(variant.simulation_s),
            setup_s: text(variant.setup_s),
            repeats: variant.repeats,
            wear_steps: work.map(|work| work.wear_steps),
            equilibria: work.map(|work| work.equilibria),
            newton_iterations: work.map(|work| work.newton_iterations),
            pair_evaluations: work.map(|work| work.pair_evaluations),
            pinion_peak_wear_um: text(wear.map(|wear| wear.pinion)),
            wheel_peak_wear_um: text(wear.map(|wear| wear.wheel)),
            part_of_reference: variant.part_of_reference,
            failure: variant.failure.as_deref(),
        }
    }
}

/// A number as it is, without the decimal point of a whole one.
fn text(value: Option<f64>) -> Option<String> {
    value.as_ref().map(ToString::to_string)
}

/// Writes `accuracy.csv`.
pub(crate) fn runs(out: &mut dyn Write, provenance: Provenance, record: &AccuracyRecord) -> io::Result<()> {
    let mut columns = columns::<RunRow>();
    for (name, meaning) in variants::<Quantity>() {
        let on_front = "whether no faster run has a smaller one".to_owned();
        columns.extend([(format!("{name}_error"), meaning), (format!("{name}_on_front"), on_front)]);
    }
    let rows = record.variants.iter().map(|variant| {
        let errors = Quantity::ALL.map(|quantity| variant.errors.get(&quantity));
        let cells = errors.map(|error| (text(error.map(|error| error.relative)), error.map(|error| error.on_front)));
        (RunRow::of(variant), cells)
    });
    table_of(out, provenance, &columns, rows)
}

/// Writes `wear_profiles.csv`.
pub(crate) fn profiles(out: &mut dyn Write, provenance: Provenance, record: &AccuracyRecord) -> io::Result<()> {
    let reference = Gear::BOTH.map(|gear| ("reference", gear, &record.reference.flanks[gear].wear_um));
    let runs = record.variants.iter().flat_map(|variant| {
        let wear = variant.wear_um.as_ref();
        Gear::BOTH.into_iter().filter_map(move |gear| Some((variant.name.as_str(), gear, &wear?[gear])))
    });
    let rows = reference.into_iter().chain(runs).flat_map(|(name, gear, wear_um)| {
        let flank = &record.reference.flanks[gear];
        flank.shown_slices().into_iter().flat_map(move |slice| {
            let values = flank.slice(wear_um, slice).iter().zip(flank.slice(&flank.wear_um, slice));
            flank.radius_mm.iter().zip(values).map(move |(&radius_mm, (&wear_um, &reference))| ProfileRow {
                name,
                gear,
                radius_mm,
                width_mm: flank.width_mm[slice],
                wear_um,
                difference_um: wear_um - reference,
            })
        })
    });
    table(out, provenance, rows)
}

/// Writes `over_width.csv`.
pub(crate) fn over_width(out: &mut dyn Write, provenance: Provenance, record: &AccuracyRecord) -> io::Result<()> {
    let reference = Gear::BOTH.map(|gear| ("reference", gear, &record.reference.flanks[gear].root_wear_um));
    let runs = record.variants.iter().flat_map(|variant| {
        let root = variant.root_wear_um.as_ref();
        Gear::BOTH.into_iter().filter_map(move |gear| Some((variant.name.as_str(), gear, &root?[gear])))
    });
    let rows = reference.into_iter().chain(runs).flat_map(|(name, gear, root_wear_um)| {
        let widths = &record.reference.flanks[gear].width_mm;
        let values = widths.iter().zip(root_wear_um);
        values.map(move |(&width_mm, &root_wear_um)| OverWidthRow { name, gear, width_mm, root_wear_um })
    });
    table(out, provenance, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The columns of errors stand in the order of the quantities.
    #[test]
    fn quantities_are_named_as_their_errors_are_written() {
        let names: Vec<String> = variants::<Quantity>().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, Quantity::ALL.map(|quantity| quantity.to_string()));
    }
}
