//! Transmission error over torque, of the new and the worn flanks.

use super::slices::MESH_ORDERS;
use super::{RunModel, UM_PER_MM};
use crate::mesh_cycle::CycleObservation;
use crate::observer::Observer;
use crate::results::torque_curve::{TorqueCurveRow, TorqueCurveState, TorqueCurveSummary};
use crate::simulation::torque_curve::CyclesUnderLoad;
use crate::simulation::wear_run::Outcome;

/// Figures of a mesh cycle that the curve has.
#[derive(Default)]
struct Figures {
    peak_to_peak_um: Option<f64>,
    orders_um: [Option<f64>; 3],
    flank_pressure_mpa: Option<f64>,
}

impl Figures {
    fn of(model: &RunModel<'_>, cycle: Option<&CycleObservation>) -> Self {
        let Some(cycle) = cycle else { return Self::default() };
        let orders_mm = cycle.mesh_orders_mm(model.pair.path.base_pitch_mm, MESH_ORDERS);
        Self {
            peak_to_peak_um: Some(cycle.peak_to_peak_mm() * UM_PER_MM),
            orders_um: [0, 1, 2].map(|order| orders_mm.get(order).map(|mm| mm * UM_PER_MM)),
            flank_pressure_mpa: Some(cycle.pressure_figures.flank_mpa),
        }
    }
}

/// The curve, torque by torque: at the torque of the reference phase from what the run itself has found, at others from mesh cycles of their own.
pub(super) fn observe(model: &RunModel<'_>, outcome: &Outcome, observer: &dyn Observer) -> Vec<TorqueCurveRow> {
    let run = model.wear_run();
    let reference_n_per_mm = model.reference().line_load_n_per_mm;
    let rows = model.torque_curve.iter().map_while(|(torque_n_mm, phase)| {
        if observer.interrupted() {
            return None;
        }
        let is_reference = phase.line_load_n_per_mm.total_cmp(&reference_n_per_mm).is_eq();
        let found = match is_reference {
            true => CyclesUnderLoad::default(),
            // A load under which the springs of the teeth do not hold has no figures.
            false => run.cycles_under(phase, outcome, &|| observer.gives_up()).unwrap_or_default(),
        };
        let [new, worn] = match is_reference {
            true => [Some(&outcome.new.cycle), Some(&outcome.worn.cycle)],
            false => [found.new.as_ref(), found.worn.as_ref()],
        };
        let [new, worn] = [new, worn].map(|cycle| Figures::of(model, cycle));
        Some(TorqueCurveRow {
            pinion_torque_Nm: 1e-3 * torque_n_mm,
            transmission_error_peak_to_peak_new_um: new.peak_to_peak_um,
            transmission_error_peak_to_peak_worn_um: worn.peak_to_peak_um,
            mesh_order_1_new_um: new.orders_um[0],
            mesh_order_1_worn_um: worn.orders_um[0],
            mesh_order_2_new_um: new.orders_um[1],
            mesh_order_2_worn_um: worn.orders_um[1],
            mesh_order_3_new_um: new.orders_um[2],
            mesh_order_3_worn_um: worn.orders_um[2],
            flank_pressure_new_MPa: new.flank_pressure_mpa,
            flank_pressure_worn_MPa: worn.flank_pressure_mpa,
        })
    });
    rows.collect()
}

/// Figures of the curve; none of one without torques.
pub(super) fn summary(rows: &[TorqueCurveRow]) -> Option<TorqueCurveSummary> {
    if rows.is_empty() {
        return None;
    }
    let of = |value: fn(&TorqueCurveRow) -> Option<f64>| rows.iter().map(value).collect::<Vec<_>>();
    Some(TorqueCurveSummary {
        pinion_torque_Nm: rows.iter().map(|row| row.pinion_torque_Nm).collect(),
        new: state(of(|row| row.transmission_error_peak_to_peak_new_um)),
        worn: state(of(|row| row.transmission_error_peak_to_peak_worn_um)),
    })
}

fn state(peak_to_peak_um: Vec<Option<f64>>) -> TorqueCurveState {
    let all: Option<Vec<f64>> = peak_to_peak_um.iter().copied().collect();
    let mean_um = all.as_ref().map(|all| all.iter().sum::<f64>() / all.len() as f64);
    let max_um = all.as_ref().and_then(|all| all.iter().copied().reduce(f64::max));
    TorqueCurveState { peak_to_peak_um, mean_um, max_um }
}
