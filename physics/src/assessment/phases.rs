//! Summary of each phase of a run: its conditions and its wear.

use super::temperature;
use super::{RunModel, UM_PER_MM};
use crate::contact::hertz;
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::results::run::{PhaseSummary, PhaseWear};
use crate::simulation::figures::WearFigures;
use crate::simulation::wear_run::Outcome;
use gearwear_bodies::gear::Gear;

/// 1 m²/N in mm²/N.
const MM2_PER_N: f64 = 1e6;

/// Every phase that the run came to; the last may not be finished.
pub(super) fn summaries(model: &RunModel<'_>, outcome: &Outcome) -> Vec<PhaseSummary> {
    let operation = &model.scene.operation;
    let reached = outcome.worn.revolutions;
    let (mut begin, mut before) = (0.0, &outcome.new);
    let mut summaries = Vec::with_capacity(operation.phases.len());
    for (index, (phase, run)) in operation.phases.iter().zip(&model.phases).enumerate() {
        if index > 0 && begin >= reached {
            break;
        }
        let end = phase.end_revolutions.min(reached);
        // The ends of phases are among the snapshots.
        let after = outcome.snapshots.iter().rfind(|snapshot| snapshot.revolutions <= end).unwrap_or(before);
        let load = run.line_load_n_per_mm;
        let at_pitch = hertz::flattening(
            &model.pair.normal_section(),
            &model.scene.material_in(phase),
            model.pair.path.pitch_point_mm,
        );
        let coefficient = model.scene.wear_in(phase).map(|own| own.coefficient_mm2_per_n / MM2_PER_N);
        let heat =
            model.scene.heat.and_then(|asked| Some((asked, temperature::observe_at(model, outcome, after, index)?)));
        summaries.push(PhaseSummary {
            number: index + 1,
            hours: phase.pinion_speed_rpm.map(|rpm| (end - begin) / (60.0 * rpm)),
            revolutions: end - begin,
            pinion_torque_Nm: 1e-3 * phase.pinion_torque_n_mm,
            pinion_speed_rpm: phase.pinion_speed_rpm,
            line_load_N_per_mm: load,
            foundation_MPa_per_mm: model.foundations_mpa_per_mm[index],
            hertz_peak_pressure_MPa: at_pitch.contact.loaded(load).peak_pressure_mpa,
            coefficient_m2_per_N: (coefficient.pinion == coefficient.wheel).then_some(coefficient.pinion),
            greatest_rise_K: heat.as_ref().map(|(asked, found)| found.greatest_rise_k()[asked.method.index()]),
            work_outside_validity: heat.and_then(|(_, found)| found.law.both.work_outside_validity),
            pinion: wear(model, outcome, (Gear::Pinion, coefficient.pinion), [before, after]),
            wheel: wear(model, outcome, (Gear::Wheel, coefficient.wheel), [before, after]),
        });
        (begin, before) = (end, after);
    }
    summaries
}

/// Wear of a gear from one state to another.
fn wear(
    model: &RunModel<'_>,
    outcome: &Outcome,
    (gear, coefficient_m2_per_n): (Gear, f64),
    [before, after]: [&Snapshot; 2],
) -> PhaseWear {
    let lost_mm = after.lost_since_mm(before, gear);
    let lost = WearFigures::new(model.pair, gear, &outcome.grid[gear], &outcome.zones[gear], &lost_mm);
    let area_mm2 = match (&after.lost_at_nodes, &before.lost_at_nodes) {
        (Some(after), Some(before)) => after[gear].wear_mm2 - before[gear].wear_mm2,
        _ => lost.area_mm2,
    };
    PhaseWear {
        coefficient_m2_per_N: coefficient_m2_per_n,
        greatest_depth_um: lost.peak_mm * UM_PER_MM,
        tip_edge_depth_um: lost.tip_edge.depth_mm * UM_PER_MM,
        below_sap_depth_um: lost.below_active.depth_mm * UM_PER_MM,
        worn_volume_mm3: model.pair.over_all_flanks(gear, area_mm2),
    }
}

/// Number of the phase that `snapshot` was taken in, from 1; at the end of a phase, that one.
pub(super) fn number_at(model: &RunModel<'_>, snapshot: &Snapshot) -> usize {
    model.scene.operation.phase_at(snapshot.revolutions) + 1
}
