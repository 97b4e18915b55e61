//! `accuracy.csv`, `wear_profiles.csv` and, of pairs with slices, `over_width.csv`.

#![allow(non_snake_case, reason = "column names end in their unit as engineers write it")]

use std::io::{self, Write};

use serde::Serialize;

use crate::gear::Gear;
use crate::report::tables::{Column, Provenance, table};
use crate::studies::accuracy::record::{AccuracyRecord, Quantity, VariantRecord};

/// Columns of `accuracy.csv`; one row per run. Every quantity has its error and whether the run is on its Pareto front.
pub const RUNS: [Column; 53] = [
    ("name", "of the run: surface · stiffness · resolution"),
    ("surface", "contact surface"),
    ("match", "what K/H shares with Hertz or the calibration; empty where the surface has no K/H"),
    ("calibrated", "whether K/H is the calibration's, for every position and load"),
    ("tip_contact", "whether a tip edge is followed into contact before A and after E"),
    ("stiffness", "tooth stiffness; empty for finite elements, which bring their own"),
    ("elements_per_half_width", "of surface fem"),
    ("slices", "over the face width; empty where all sections are alike"),
    ("coupling", "of the slices"),
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
    ("pinion_peak_wear_um", "greatest wear depth on the pinion's active profile, its tip edge apart"),
    ("wheel_peak_wear_um", "the same of the wheel"),
    ("part_of_reference", "whether the reference was extrapolated from it"),
    ("failure", "why there is no result, where there is none"),
    ("wear_profile_error", "relative L2 error of the depth over the whole flank, the larger of both gears'"),
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
    ("half_width_error", "relative L2 error of the half-width in single contact, new; without slices"),
    ("half_width_on_front", "whether no faster run has a smaller one"),
    ("transmission_error_error", "relative L2 error of the transmission error, new"),
    ("transmission_error_on_front", "whether no faster run has a smaller one"),
    ("transmission_error_peak_to_peak_error", "relative difference of its peak-to-peak value, new"),
    ("transmission_error_peak_to_peak_on_front", "whether no faster run has a smaller one"),
    ("worn_transmission_error_error", "relative L2 error of the transmission error, worn"),
    ("worn_transmission_error_on_front", "whether no faster run has a smaller one"),
    ("worn_transmission_error_peak_to_peak_error", "relative difference of its peak-to-peak value, worn"),
    ("worn_transmission_error_peak_to_peak_on_front", "whether no faster run has a smaller one"),
    (
        "root_wear_error",
        "relative L2 error of the root wear over the face width, the larger of both gears'; with slices",
    ),
    ("root_wear_on_front", "whether no faster run has a smaller one"),
    ("K_Hbeta_error", "relative difference of the face load factor, new; with slices"),
    ("K_Hbeta_on_front", "whether no faster run has a smaller one"),
    ("worn_K_Hbeta_error", "relative difference of the face load factor, worn; with slices"),
    ("worn_K_Hbeta_on_front", "whether no faster run has a smaller one"),
];

/// Columns of `wear_profiles.csv`; the reference and every run of the finest resolution. Of slices over the face width the first,
/// the middle and the last.
pub const PROFILES: [Column; 6] = [
    ("name", "of the run; reference for the reference"),
    ("gear", "pinion or wheel"),
    ("radius_mm", "distance from the gear's axis"),
    ("width_mm", "place over the face width"),
    ("wear_um", "wear depth, normal to the flank"),
    ("difference_um", "wear depth less the reference's"),
];

/// Columns of `over_width.csv`; the reference and every run of the finest resolution.
pub const OVER_WIDTH: [Column; 4] = [
    ("name", "of the run; reference for the reference"),
    ("gear", "pinion or wheel"),
    ("width_mm", "place over the face width"),
    ("root_wear_um", "greatest wear depth within 2 mm of radius above the start of active profile"),
];

#[derive(Serialize)]
struct OverWidthRow<'a> {
    name: &'a str,
    gear: Gear,
    width_mm: f64,
    root_wear_um: f64,
}

#[derive(Serialize)]
struct ProfileRow<'a> {
    name: &'a str,
    gear: Gear,
    radius_mm: f64,
    width_mm: f64,
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
        text(&s.slices),
        text(&s.coupling),
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
    table(out, provenance, &PROFILES, rows)
}

/// Writes `over_width.csv`.
pub fn over_width(out: &mut dyn Write, provenance: Provenance, record: &AccuracyRecord) -> io::Result<()> {
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
    table(out, provenance, &OVER_WIDTH, rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::accuracy::record::VariantSettings;

    /// The columns of errors stand in the order of the quantities.
    #[test]
    fn columns_are_named_as_their_cells_are_written() {
        let settings = RUNS.len() - 2 * Quantity::ALL.len();
        for (k, quantity) in Quantity::ALL.into_iter().enumerate() {
            assert_eq!(RUNS[settings + 2 * k].0, format!("{}_error", quantity.name()));
            assert_eq!(RUNS[settings + 2 * k + 1].0, format!("{}_on_front", quantity.name()));
        }
    }

    /// A run's cells are as many as the columns.
    #[test]
    fn every_column_has_its_cell() {
        let variant = VariantRecord {
            name: "half-space".to_owned(),
            settings: VariantSettings {
                surface: "half-space".to_owned(),
                match_criterion: None,
                calibrated: false,
                tip_contact: true,
                stiffness: None,
                elements_per_half_width: None,
                slices: Some(20),
                coupling: Some("slicing".to_owned()),
                flank_points: 750,
                positions: 400,
                step_revolutions: 1000.0,
                spacing_coarsening: 1,
                step_coarsening: 1,
            },
            simulation_s: None,
            setup_s: None,
            repeats: 0,
            work: None,
            peak_wear_um: None,
            errors: Default::default(),
            failure: None,
            part_of_reference: false,
            wear_um: None,
            root_wear_um: None,
        };
        let cells = cells(&variant);
        assert_eq!(cells.len(), RUNS.len());
        let column = |name: &str| RUNS.iter().position(|column| column.0 == name).unwrap();
        assert_eq!((&*cells[column("slices")], &*cells[column("coupling")]), ("20", "slicing"));
        assert_eq!(cells[column("flank_points")], "750");
    }
}
