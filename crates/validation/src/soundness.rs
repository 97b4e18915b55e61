//! Conditions of every wear run, whatever its scene: finite numbers, no negative wear or pressure, forces in
//! equilibrium at every position.

use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::results::run::{CycleSummary, FlankRecord, RunRecord};

/// Greatest relative difference between the loads of the pairs together and the load to carry.
pub(super) const MOST_IMBALANCE: f64 = 1e-6;

/// First violated condition; `None` where the run is sound.
pub fn fault(record: &RunRecord) -> Option<String> {
    of_equilibria("new", &record.summary.new)
        .or_else(|| of_equilibria("worn", &record.summary.worn))
        .or_else(|| Gear::BOTH.into_iter().find_map(|gear| of_flank(gear, &record.flanks)))
        .or_else(|| of_cycle(record))
        .or_else(|| of_history(record))
}

fn of_equilibria(when: &str, cycle: &CycleSummary) -> Option<String> {
    let imbalance = cycle.load_imbalance;
    // NaN is a fault too.
    let balanced = imbalance <= MOST_IMBALANCE;
    (!balanced)
        .then(|| format!("{when}: loads of the tooth pairs differ from the transmitted load by {imbalance:e} of it"))
}

/// The first of `numbers` that is not finite or negative.
fn negative(name: &str, numbers: &[f64]) -> Option<String> {
    let index = numbers.iter().position(|x| !(x.is_finite() && *x >= 0.0))?;
    Some(format!("{name}: {} at point {index}", numbers[index]))
}

/// The first of `numbers` that is not finite.
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
        let mut changes = flank.snapshot_wear_um.windows(2);
        let snapshot = changes.position(|two| !two[0].iter().zip(&two[1]).all(|(before, after)| after >= before))?;
        Some(format!("{name} wear becomes less after snapshot {}", snapshot + 1))
    })
}

fn of_cycle(record: &RunRecord) -> Option<String> {
    let rows = &record.mesh_cycle;
    let shares_new: Vec<f64> = rows.iter().map(|row| row.load_share_new).collect();
    let shares_worn: Vec<f64> = rows.iter().map(|row| row.load_share_worn).collect();
    negative("load share, new", &shares_new)
        .or_else(|| negative("load share, worn", &shares_worn))
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
