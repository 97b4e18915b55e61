//! `accuracy.csv`, `wear_profiles.csv` and, of pairs with slices, `over_width.csv`; the profiles are those of the reference and of
//! every run of the finest resolution, of slices over the face width the first, the middle and the last.

#![allow(non_snake_case, reason = "column names end in their unit as engineers write it")]

use std::io::{self, Write};

use schemars::JsonSchema;
use serde::Serialize;

use crate::accuracy::record::{AccuracyRecord, ComparedQuantity, ReferenceFlank, VariantRecord};
use gearwear::report::csv_table::{Column, table, table_of, variants};
use gearwear_bodies::gear::{Gear, PerGear};

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
struct WearProfileRow<'a> {
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

/// Column, meaning and cell of a run, empty where there is none.
type RunColumn = (&'static str, &'static str, fn(&VariantRecord) -> Option<String>);

/// Beside these columns every quantity has its error and whether the run is on its Pareto front.
const RUN_COLUMNS: [RunColumn; 23] = [
    ("name", "of the run: contact surface · tooth stiffness · slices · what is coarser than in the scene", |v| {
        Some(v.name.clone())
    }),
    ("surface", "contact surface", |v| Some(v.settings.surface.clone())),
    ("match", "what K/H shares with Hertz or the calibration; empty where the surface has no K/H", |v| {
        v.settings.match_criterion.clone()
    }),
    ("calibrated", "whether K/H is the calibration's, for every position and load", |v| {
        text(Some(v.settings.calibrated))
    }),
    ("tip_contact", "whether a tip edge is followed into contact before A and after E", |v| {
        text(Some(v.settings.tip_contact))
    }),
    ("stiffness", "tooth stiffness; empty for finite elements, which bring their own", |v| {
        v.settings.stiffness.clone()
    }),
    ("elements_per_half_width", "of surface fem", |v| text(v.settings.elements_per_half_width)),
    ("slices", "over the face width; empty where all sections are alike", |v| text(v.settings.slices)),
    ("coupling", "of the slices", |v| v.settings.coupling.clone()),
    ("flank_points", "intervals of a flank", |v| text(Some(v.settings.flank_points))),
    ("positions", "loading positions from A to E", |v| text(Some(v.settings.positions))),
    ("step_revolutions", "pinion revolutions a wear step", |v| text(Some(v.settings.step_revolutions))),
    ("simulation_s", "wall time of the wear run alone, the shortest of the repeats", |v| text(v.simulation_s)),
    (
        "setup_s",
        "wall time of everything before it; finite elements are those of the run before where they are the same",
        |v| text(v.setup_s),
    ),
    ("repeats", "how often it was run for its time", |v| text(Some(v.repeats))),
    ("wear_steps", "wear steps taken", |v| text(v.work.map(|work| work.wear_steps))),
    ("equilibria", "equilibria solved", |v| text(v.work.map(|work| work.equilibria))),
    ("newton_iterations", "iterations in all of them", |v| text(v.work.map(|work| work.newton_iterations))),
    ("pair_evaluations", "evaluations of a tooth pair's contact", |v| text(v.work.map(|work| work.pair_evaluations))),
    ("pinion_peak_wear_um", "maximum wear depth on the pinion's active profile, its tip edge apart", |v| {
        text(v.peak_wear_um.map(|wear| wear.pinion))
    }),
    ("wheel_peak_wear_um", "the same of the wheel", |v| text(v.peak_wear_um.map(|wear| wear.wheel))),
    ("part_of_reference", "whether the reference was extrapolated from it", |v| text(Some(v.part_of_reference))),
    ("failure", "why there is no result, where there is none", |v| v.failure.clone()),
];

/// A number as it is, without the decimal point of a whole one.
fn text(value: Option<impl ToString>) -> Option<String> {
    value.map(|value| value.to_string())
}

pub fn runs(out: &mut dyn Write, record: &AccuracyRecord) -> io::Result<Vec<Column>> {
    let mut columns = RUN_COLUMNS.map(|(name, meaning, _)| (name.to_owned(), meaning.to_owned())).to_vec();
    for (name, meaning) in variants::<ComparedQuantity>() {
        let on_front = "whether no faster run has a smaller one".to_owned();
        columns.extend([(format!("{name}_error"), meaning), (format!("{name}_on_front"), on_front)]);
    }
    let rows = record.variants.iter().map(|variant| {
        let errors = ComparedQuantity::ALL.map(|quantity| variant.errors.get(&quantity));
        let cells = errors.map(|error| (text(error.map(|error| error.relative)), error.map(|error| error.on_front)));
        (RUN_COLUMNS.map(|(_, _, cell)| cell(variant)), cells)
    });
    table_of(out, columns, rows)
}

pub fn profiles(out: &mut dyn Write, record: &AccuracyRecord) -> io::Result<Vec<Column>> {
    let all = reference_and_runs(record, |flank| &flank.wear_um, |run| run.wear_um.as_ref());
    let rows = all.flat_map(|(name, gear, wear_um)| {
        let flank = &record.reference.flanks[gear];
        flank.shown_slices().into_iter().flat_map(move |slice| {
            let values = flank.slice(wear_um, slice).iter().zip(flank.slice(&flank.wear_um, slice));
            flank.radius_mm.iter().zip(values).map(move |(&radius_mm, (&wear_um, &reference))| WearProfileRow {
                name,
                gear,
                radius_mm,
                width_mm: flank.width_mm[slice],
                wear_um,
                difference_um: wear_um - reference,
            })
        })
    });
    table(out, rows)
}

pub fn over_width(out: &mut dyn Write, record: &AccuracyRecord) -> io::Result<Vec<Column>> {
    let all = reference_and_runs(record, |flank| &flank.root_wear_um, |run| run.root_wear_um.as_ref());
    let rows = all.flat_map(|(name, gear, root_wear_um)| {
        let values = record.reference.flanks[gear].width_mm.iter().zip(root_wear_um);
        values.map(move |(&width_mm, &root_wear_um)| OverWidthRow { name, gear, width_mm, root_wear_um })
    });
    table(out, rows)
}

/// A depth of the reference, then of every run that keeps it, of both gears.
fn reference_and_runs(
    record: &AccuracyRecord,
    of_reference: fn(&ReferenceFlank) -> &Vec<f64>,
    of_run: fn(&VariantRecord) -> Option<&PerGear<Vec<f64>>>,
) -> impl Iterator<Item = (&str, Gear, &Vec<f64>)> {
    let reference = Gear::BOTH.map(|gear| ("reference", gear, of_reference(&record.reference.flanks[gear])));
    let runs = record.variants.iter().flat_map(move |variant| {
        let depths = of_run(variant);
        Gear::BOTH.into_iter().filter_map(move |gear| Some((variant.name.as_str(), gear, &depths?[gear])))
    });
    reference.into_iter().chain(runs)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The columns of errors stand in the order of the quantities.
    #[test]
    fn quantities_are_named_as_their_errors_are_written() {
        let names: Vec<String> = variants::<ComparedQuantity>().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ComparedQuantity::ALL.map(|quantity| quantity.to_string()));
    }
}
