//! Wear of unworn flanks in one mesh by finite-element contact.

use super::CalibrateError;
use crate::calibration::wear_reference::{FLANK_POINTS, LOADS, POSITIONS, ReferenceDepth, WearReference};
use crate::mesh_cycle::MeshCycle;
use crate::mesh_cycle::condensed::CondensedCycle;
use crate::mesh_cycle::load_sharing::EquilibriumError;
use crate::wear::{self, WearModel, settings::WearSettings};
use gearwear_bodies::gear::{
    Gear, PerGear,
    flank::{FlankGrid, PointSpacing},
};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;

/// Wear references of all loads, each a multiple of `line_load_n_per_mm`.
pub(super) fn references(
    condensed: &CondensedPair<'_>,
    line_load_n_per_mm: f64,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<WearReference>, CalibrateError> {
    LOADS.into_iter().map(|load| reference(condensed, load * line_load_n_per_mm, stopped)).collect()
}

/// Wear reference of one load.
fn reference(
    condensed: &CondensedPair<'_>,
    line_load_n_per_mm: f64,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<WearReference, CalibrateError> {
    let pair = condensed.pair;
    // Wear per coefficient is the wear by a coefficient of 1.
    let law = wear::of(&WearSettings::archard(1.0));
    let mut cycle = CondensedCycle::new(condensed, POSITIONS, line_load_n_per_mm);
    let mut depth = cycle.nodes().map(|nodes| vec![0.0; nodes.len()]);
    let unworn = depth.clone();
    let zeros = unworn.as_ref().map(Vec::as_slice);
    match cycle.evaluate(zeros, &WearModel::cold(law.as_ref()), &mut depth, stopped) {
        Ok(_) => {}
        Err(EquilibriumError::Interrupted) => return Err(CalibrateError::Interrupted),
        Err(source) => return Err(CalibrateError::Cycle { line_load_n_per_mm, source }),
    }
    let flanks = PerGear::from_fn(|gear: Gear| {
        let grid = FlankGrid::new(pair, gear, FLANK_POINTS, PointSpacing::Even);
        let radius_mm: Vec<f64> =
            grid.coordinate_mm.iter().map(|&rho| pair.teeth[gear].involute.radius_mm(rho)).collect();
        let depth_per_coefficient_n_per_mm = cycle.at_radii(gear, &depth[gear], radius_mm.iter().copied());
        ReferenceDepth { radius_mm, depth_per_coefficient_n_per_mm }
    });
    Ok(WearReference { line_load_n_per_mm, flanks })
}
