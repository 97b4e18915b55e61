//! Conditions of every wear run, whatever its scene: finite numbers, no negative wear or pressure, forces in
//! equilibrium at every position.

use crate::gear::{Gear, PerGear};
use crate::results::run::{CycleSummary, FlankRecord, RunRecord};

/// Greatest relative difference between the loads of the pairs together and the load to carry.
pub(super) const MOST_IMBALANCE: f64 = 1e-6;

/// The first thing about the run that cannot be; `None` where all is well.
pub(crate) fn fault(record: &RunRecord) -> Option<String> {
    let summary = &record.summary;
    let imbalance = |(when, cycle): (&str, &CycleSummary)| {
        // Written so that a number that is none is a fault too.
        let balanced = cycle.load_imbalance <= MOST_IMBALANCE;
        (!balanced)
            .then(|| format!("{when}: loads of the pairs differ from the load by {:e} of it", cycle.load_imbalance))
    };
    let cycles = [("new", &summary.new), ("worn", &summary.worn)];
    cycles
        .into_iter()
        .find_map(imbalance)
        .or_else(|| Gear::BOTH.into_iter().find_map(|gear| of_flank(gear, &record.flanks)))
        .or_else(|| of_cycle(record))
        .or_else(|| of_history(record))
}

/// The first of `numbers` that is none or negative.
fn negative(name: &str, numbers: &[f64]) -> Option<String> {
    let index = numbers.iter().position(|x| !(x.is_finite() && *x >= 0.0))?;
    Some(format!("{name}: {} at point {index}", numbers[index]))
}

/// The first of `numbers` that is none.
fn not_finite(name: &str, numbers: impl IntoIterator<Item = f64>) -> Option<String> {
    let (index, found) = numbers.into_iter().enumerate().find(|(_, x)| !x.is_finite())?;
    Some(format!("{name}: {found} at point {index}"))
}

fn of_flank(gear: Gear, flanks: &PerGear<FlankRecord>) -> Option<String> {
    let (name, flank) = (gear.name(), &flanks[gear]);
    let columns = [
        ("wear", &flank.wear_um),
        ("pressure, new", &flank.pressure_new_MPa),
        ("pressure, worn", &flank.pressure_worn_MPa),
        ("sliding", &flank.sliding_mm_per_mesh),
    ];
    columns.into_iter().find_map(|(what, column)| negative(&format!("{name} {what}"), column)).or_else(|| {
        let grows = |two: &[Vec<f64>]| two[0].iter().zip(&two[1]).all(|(before, after)| after >= before);
        let snapshot = flank.snapshot_wear_um.windows(2).position(|two| !grows(two))?;
        Some(format!("{name} wear becomes less after snapshot {}", snapshot + 1))
    })
}

fn of_cycle(record: &RunRecord) -> Option<String> {
    let rows = &record.mesh_cycle;
    let shares = |of: fn(&crate::results::run::MeshCycleRow) -> f64| rows.iter().map(of).collect::<Vec<_>>();
    negative("load share, new", &shares(|row| row.load_share_new))
        .or_else(|| negative("load share, worn", &shares(|row| row.load_share_worn)))
        .or_else(|| not_finite("transmission error, new", rows.iter().map(|row| row.transmission_error_new_um)))
        .or_else(|| not_finite("transmission error, worn", rows.iter().map(|row| row.transmission_error_worn_um)))
}

fn of_history(record: &RunRecord) -> Option<String> {
    let rows = &record.history;
    not_finite("history, peak wear", rows.iter().flat_map(|row| [row.pinion_peak_wear_um, row.wheel_peak_wear_um]))
        .or_else(|| not_finite("history, pressure", rows.iter().map(|row| row.peak_pressure_MPa)))
        .or_else(|| {
            not_finite("history, transmission error", rows.iter().map(|row| row.transmission_error_peak_to_peak_um))
        })
}
