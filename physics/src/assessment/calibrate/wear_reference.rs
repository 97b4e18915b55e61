//! Wear of unworn flanks in one mesh by finite-element contact.

use super::CalibrateError;
use crate::calibration::wear_reference::{FLANK_POINTS, LOADS, POSITIONS, ReferenceDepth, WearReference};
use crate::mesh_cycle::condensed::{at_radii, nominal_radii_mm, unworn_wear_mm};
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
    let wear = WearModel::cold(law.as_ref());
    let depth = match unworn_wear_mm(condensed, POSITIONS, line_load_n_per_mm, &wear, stopped) {
        Ok(depth) => depth,
        Err(EquilibriumError::Interrupted) => return Err(CalibrateError::Interrupted),
        Err(source) => return Err(CalibrateError::Cycle { line_load_n_per_mm, source }),
    };
    let nodes = condensed.flank_nodes();
    let node_radius_mm = nominal_radii_mm(condensed, nodes.as_ref());
    let flanks = PerGear::from_fn(|gear: Gear| {
        let grid = FlankGrid::new(pair, gear, FLANK_POINTS, PointSpacing::Even);
        let radius_mm: Vec<f64> =
            grid.coordinate_mm.iter().map(|&rho| pair.teeth[gear].involute.radius_mm(rho)).collect();
        let depth_per_coefficient_n_per_mm = at_radii(&node_radius_mm[gear], &depth[gear], radius_mm.iter().copied());
        ReferenceDepth { radius_mm, depth_per_coefficient_n_per_mm }
    });
    Ok(WearReference { line_load_n_per_mm, flanks })
}
