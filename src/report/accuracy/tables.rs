//! `accuracy.csv` and `wear_profiles.csv`.

#![allow(non_snake_case, reason = "column names end in their unit as engineers write it")]

use std::io::{self, Write};

use serde::Serialize;

use crate::gear::Gear;
use crate::report::tables::{Column, Provenance, table};
use crate::simulation::accuracy_record::{AccuracyRecord, Quantity, VariantRecord};

/// Columns of `accuracy.csv`; one row per run. Every quantity has its error and whether the run is on its Pareto front.
pub const RUNS: [Column; 45] = [
    ("name", "of the run: surface · stiffness · resolution"),
    ("surface", "contact surface"),
    ("match", "what K/H shares with Hertz or the calibration; empty where the surface has no K/H"),
    ("calibrated", "whether K/H is the calibration's, for every position and load"),
    ("tip_contact", "whether a tip edge is followed into contact before A and after E"),
    ("stiffness", "tooth stiffness; empty for finite elements, which bring their own"),
    ("elements_per_half_width", "of surface fem"),
    ("flank_points", "intervals of a flank"),
    ("positions", "loading positions from A to E"),
    ("step_revolutions", "pinion revolutions a wear step"),
    ("simulation_s", "wall time of the wear run alone, the least of the repeats"),
    ("setup_s", "wall time of everything before it"),
    ("repeats", "how often it was run for its time"),
    ("wear_steps", "wear steps taken"),
    ("equilibria", "equilibria solved"),
    ("newton_iterations", "iterations in all of them"),
    ("pair_evaluations", "evaluations of a tooth pair's contact"),
    ("pinion_peak_wear_um", "greatest wear depth of the pinion's flank"),
    ("wheel_peak_wear_um", "greatest wear depth of the wheel's flank"),
    ("part_of_reference", "whether the reference was extrapolated from it"),
    ("failure", "why there is no result, where there is none"),
    ("wear_profile_error", "relative L2 error of the depth over the flank, the larger of both gears'"),
    ("wear_profile_on_front", "whether no faster run has a smaller one"),
    ("pinion_wear_profile_error", "relative L2 error of the depth over the pinion's flank"),
    ("pinion_wear_profile_on_front", "whether no faster run has a smaller one"),
    ("wheel_wear_profile_error", "relative L2 error of the depth over the wheel's flank"),
    ("wheel_wear_profile_on_front", "whether no faster run has a smaller one"),
    ("pinion_peak_wear_error", "relative difference of the pinion's greatest depth"),
    ("pinion_peak_wear_on_front", "whether no faster run has a smaller one"),
    ("wheel_peak_wear_error", "relative difference of the wheel's greatest depth"),
    ("wheel_peak_wear_on_front", "whether no faster run has a smaller one"),
    ("peak_pressure_error", "relative difference of the greatest pressure, new, away from sharp tip edges"),
    ("peak_pressure_on_front", "whether no faster run has a smaller one"),
    ("flank_pressure_error", "relative difference of the greatest pressure, new, away from all tip edges"),
    ("flank_pressure_on_front", "whether no faster run has a smaller one"),
    ("half_width_error", "relative L2 error of the half-width in single contact, new"),
    ("half_width_on_front", "whether no faster run has a smaller one"),
    ("transmission_error_error", "relative L2 error of the transmission error, new"),
    ("transmission_error_on_front", "whether no faster run has a smaller one"),
    ("transmission_error_peak_to_peak_error", "relative difference of its peak-to-peak value, new"),
    ("transmission_error_peak_to_peak_on_front", "whether no faster run has a smaller one"),
    ("worn_transmission_error_error", "relative L2 error of the transmission error, worn"),
    ("worn_transmission_error_on_front", "whether no faster run has a smaller one"),
    ("worn_transmission_error_peak_to_peak_error", "relative difference of its peak-to-peak value, worn"),
    ("worn_transmission_error_peak_to_peak_on_front", "whether no faster run has a smaller one"),
];

/// Columns of `wear_profiles.csv`; the reference and every run of the finest resolution.
pub const PROFILES: [Column; 5] = [
    ("name", "of the run; reference for the reference"),
    ("gear", "pinion or wheel"),
    ("radius_mm", "distance from the gear's axis"),
    ("wear_um", "wear depth, normal to the flank"),
    ("difference_um", "wear depth less the reference's"),
];

#[derive(Serialize)]
struct ProfileRow<'a> {
    name: &'a str,
    gear: Gear,
    radius_mm: f64,
    wear_um: f64,
    difference_um: f64,
}

/// Writes `accuracy.csv`.
pub fn runs(out: &mut dyn Write, provenance: Provenance, record: &AccuracyRecord) -> io::Result<()> {
    table(out, provenance, &RUNS, record.variants.iter().map(cells))
}

/// The cells of a run, in the order of [`RUNS`].
fn cells(variant: &VariantRecord) -> Vec<String> {
    let s = &variant.settings;
    let (work, wear) = (variant.work, variant.peak_wear_um);
    let mut cells = vec![
        variant.name.clone(),
        s.surface.clone(),
        text(&s.match_criterion),
        s.calibrated.to_string(),
        s.tip_contact.to_string(),
        text(&s.stiffness),
        text(&s.elements_per_half_width),
        s.flank_points.to_string(),
        s.positions.to_string(),
        s.step_revolutions.to_string(),
        text(&variant.simulation_s),
        text(&variant.setup_s),
        variant.repeats.to_string(),
        text(&work.map(|work| work.wear_steps)),
        text(&work.map(|work| work.equilibria)),
        text(&work.map(|work| work.newton_iterations)),
        text(&work.map(|work| work.pair_evaluations)),
        text(&wear.map(|wear| wear.pinion)),
        text(&wear.map(|wear| wear.wheel)),
        variant.part_of_reference.to_string(),
        text(&variant.failure),
    ];
    for quantity in Quantity::ALL {
        let error = variant.errors.get(&quantity);
        cells.push(text(&error.map(|error| error.relative)));
        cells.push(text(&error.map(|error| error.on_front)));
    }
    cells
}

fn text(value: &Option<impl ToString>) -> String {
    value.as_ref().map_or_else(String::new, ToString::to_string)
}

/// Writes `wear_profiles.csv`.
pub fn profiles(out: &mut dyn Write, provenance: Provenance, record: &AccuracyRecord) -> io::Result<()> {
    let reference = Gear::BOTH.map(|gear| ("reference", gear, &record.reference.flanks[gear].wear_um));
    let runs = record.variants.iter().flat_map(|variant| {
        let wear = variant.wear_um.as_ref();
        Gear::BOTH.into_iter().filter_map(move |gear| Some((variant.name.as_str(), gear, &wear?[gear])))
    });
    let rows = reference.into_iter().chain(runs).flat_map(|(name, gear, wear_um)| {
        let flank = &record.reference.flanks[gear];
        flank.radius_mm.iter().zip(wear_um.iter().zip(&flank.wear_um)).map(
            move |(&radius_mm, (&wear_um, &reference))| ProfileRow {
                name,
                gear,
                radius_mm,
                wear_um,
                difference_um: wear_um - reference,
            },
        )
    });
    table(out, provenance, &PROFILES, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The columns of errors stand in the order of the quantities.
    #[test]
    fn columns_are_named_as_their_cells_are_written() {
        let settings = RUNS.len() - 2 * Quantity::ALL.len();
        for (k, quantity) in Quantity::ALL.into_iter().enumerate() {
            assert_eq!(RUNS[settings + 2 * k].0, format!("{}_error", quantity.name()));
            assert_eq!(RUNS[settings + 2 * k + 1].0, format!("{}_on_front", quantity.name()));
        }
    }
}
