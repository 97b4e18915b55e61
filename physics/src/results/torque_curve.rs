//! Transmission error over torque, as plain data.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A row of `torque_curve.csv`: the new and the worn pair under one torque. Without a value where there is no equilibrium under it.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TorqueCurveRow {
    /// torque on the pinion
    pub pinion_torque_Nm: f64,
    /// transmission error along the line of action, greatest less least over the mesh, new
    pub transmission_error_peak_to_peak_new_um: Option<f64>,
    /// the same, worn
    pub transmission_error_peak_to_peak_worn_um: Option<f64>,
    /// amplitude of the transmission error at the tooth-mesh frequency, new
    pub mesh_order_1_new_um: Option<f64>,
    /// the same, worn
    pub mesh_order_1_worn_um: Option<f64>,
    /// amplitude at twice the tooth-mesh frequency, new
    pub mesh_order_2_new_um: Option<f64>,
    /// the same, worn
    pub mesh_order_2_worn_um: Option<f64>,
    /// amplitude at three times the tooth-mesh frequency, new
    pub mesh_order_3_new_um: Option<f64>,
    /// the same, worn
    pub mesh_order_3_worn_um: Option<f64>,
    /// maximum pressure between the tip-edge zones of both flanks, new
    pub flank_pressure_new_MPa: Option<f64>,
    /// the same, worn
    pub flank_pressure_worn_MPa: Option<f64>,
}

/// Transmission error over torque.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TorqueCurveSummary {
    /// Torques on the pinion, rising: those of `operation.torque_curve_Nm`.
    pub pinion_torque_Nm: Vec<f64>,
    /// The unworn pair.
    pub new: TorqueCurveState,
    /// The pair at the end of the run.
    pub worn: TorqueCurveState,
}

/// Peak-to-peak transmission errors under the torques.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct TorqueCurveState {
    /// Under each torque; null where there is no equilibrium under it.
    pub peak_to_peak_um: Vec<Option<f64>>,
    /// Mean of the torques; null where one has no value.
    pub mean_um: Option<f64>,
    /// Maximum of the torques; null where one has no value.
    pub max_um: Option<f64>,
}
