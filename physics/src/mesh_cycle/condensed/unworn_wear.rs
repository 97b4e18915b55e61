//! Wear of unworn flanks in one mesh.

use rayon::prelude::*;

use super::stretches::BasePitch;
use super::{CondensedGroup, CondensedPosition, WearEvaluation};
use crate::mesh_cycle::GROUPS;
use crate::mesh_cycle::collected::Collected;
use crate::mesh_cycle::load_sharing::EquilibriumError;
use crate::wear::WearModel;
use gearwear_bodies::gear::PerGear;
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::tilted::Worn;

/// Depth that unworn flanks lose in one mesh at each of their nodes, mm: as by a cycle, with each position in memory
/// only while it is evaluated.
///
/// # Errors
/// The first position without an equilibrium, or the interruption.
pub fn unworn_wear_mm(
    model: &CondensedPair<'_>,
    positions: usize,
    line_load_n_per_mm: f64,
    wear: &WearModel<'_>,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Result<PerGear<Vec<f64>>, EquilibriumError> {
    let nodes = model.flank_nodes();
    let nodes = nodes.as_ref();
    let unworn = nodes.map(|nodes| vec![0.0; nodes.len()]);
    let worn = Worn { depth_mm: unworn.as_ref().map(Vec::as_slice), tilt_rad: &unworn };
    let step = WearEvaluation { model, worn, nodes, wear, stopped };
    let stretches = BasePitch::of(model, positions, line_load_n_per_mm).stretches_mm();
    let collected: Vec<Collected> = stretches
        .par_chunks(stretches.len().div_ceil(GROUPS))
        .map(|stretches| {
            let mut group = CondensedGroup::new(nodes);
            for &stretch in stretches {
                if stopped() {
                    group.collected.take(Err(EquilibriumError::Interrupted));
                    break;
                }
                group.loaded_positions = vec![CondensedPosition::new(model, stretch, line_load_n_per_mm, nodes)];
                if !group.evaluate_those(|_| true, CondensedPosition::solve, &step) {
                    break;
                }
            }
            group.collected
        })
        .collect();
    let mut depth_mm = unworn.clone();
    Collected::sum(collected.iter(), &mut depth_mm)?;
    Ok(depth_mm)
}
