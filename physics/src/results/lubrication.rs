//! Films, friction and losses in `summary.json` and `film.csv`.

#![allow(non_snake_case, reason = "names that end in their unit, and symbols of the standards")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::PerGear;

/// Films, friction and losses under the load of the reference phase.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LubricationSummary {
    /// The oil; `None` where only a constant friction is asked for.
    pub oil: Option<OilSummary>,
    /// Films of the run's own contact.
    pub film: Option<FilmSummary>,
    /// ISO/TS 6336-22 Method B, without a contact analysis; `None` without oil and for the reason in `method_b_null_because`.
    pub method_b: Option<MethodBSummary>,
    /// Why there is no Method B although there is an oil.
    #[serde(default)]
    pub method_b_null_because: Option<String>,
    /// Scuffing temperatures.
    pub scuffing: Option<ScuffingSummary>,
    /// Friction.
    pub friction: FrictionSummary,
    /// Losses.
    pub losses: LossSummary,
}

/// The oil where it comes into the mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OilSummary {
    /// Temperature of the oil.
    pub temperature_C: f64,
    /// ν.
    pub kinematic_viscosity_mm2_per_s: f64,
    /// ρ.
    pub density_kg_per_m3: f64,
    /// η.
    pub dynamic_viscosity_mPas: f64,
    /// α.
    pub pressure_viscosity_per_GPa: f64,
    /// θ_M, of the teeth.
    pub bulk_temperature_C: f64,
    /// η at θ_M.
    pub dynamic_viscosity_at_bulk_mPas: f64,
}

/// Extremes and mean along the path of contact, where the pair carries load; between the tip-edge zones where the contact surface sees tip edges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AlongPath {
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Mean over the path.
    pub mean: f64,
}

/// Films of the run's own contact, new and worn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmSummary {
    /// In the middle of the contact, new, with the oil as it comes into the mesh.
    pub central_film_new_um: AlongPath,
    /// Central film, worn.
    pub central_film_worn_um: AlongPath,
    /// The least in the contact, new.
    pub minimum_film_new_um: AlongPath,
    /// Minimum film, worn.
    pub minimum_film_worn_um: AlongPath,
    /// The local film of ISO/TS 6336-22 over Ra, λ_GF, new.
    pub lambda_new: AlongPath,
    /// λ, worn, over the roughness of worn flanks.
    pub lambda_worn: AlongPath,
    /// Position of the least λ, new.
    pub least_lambda_new_position_mm: f64,
    /// Position of the least λ, worn.
    pub least_lambda_worn_position_mm: f64,
    /// Safety against micropitting S_λ by Method A, the least λ over that which the oil permits, new; `None` where that is not given.
    #[serde(default)]
    pub micropitting_safety_new: Option<f64>,
    /// Safety, worn.
    #[serde(default)]
    pub micropitting_safety_worn: Option<f64>,
    /// Least λ of the tip-edge zones, new; `None` where they carry no load, or the contact surface does not see tip edges.
    #[serde(default)]
    pub tip_edge_lambda_new: Option<f64>,
    /// Least λ of the tip edges, worn.
    #[serde(default)]
    pub tip_edge_lambda_worn: Option<f64>,
    /// Maximum flash temperature, new, tip edges included.
    pub greatest_flash_new_K: f64,
    /// Greatest flash temperature, worn.
    pub greatest_flash_worn_K: f64,
    /// The least film, of oil as warm as the teeth, over √(Rq₁² + Rq₂²), new.
    #[serde(default)]
    pub composite_lambda_new: Option<AlongPath>,
    /// λ over the composite roughness, worn, of flanks that are run in.
    #[serde(default)]
    pub composite_lambda_worn: Option<AlongPath>,
    /// Factor of the film on the wear coefficient of each gear, the mean over the sliding work from A to E, new; `None` where wear does not follow it.
    #[serde(default)]
    pub wear_factor_new: Option<PerGear<f64>>,
    /// Factor, worn.
    #[serde(default)]
    pub wear_factor_worn: Option<PerGear<f64>>,
}

/// ISO/TS 6336-22 Method B.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MethodBSummary {
    /// At A, AB, B, C, D, DE and E.
    pub points: Vec<MethodBPoint>,
    /// μ_m.
    pub mean_friction: f64,
    /// Name of the point of least λ.
    pub least_lambda_at: String,
    /// λ_GF,min.
    pub least_lambda: f64,
    /// S_λ = λ_GF,min/λ_GFP; `None` where λ_GFP is not given.
    #[serde(default)]
    pub micropitting_safety: Option<f64>,
}

/// A point of Method B.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MethodBPoint {
    /// A, AB, B, C, D, DE or E.
    pub name: String,
    /// The pinion's radius of curvature.
    pub position_mm: f64,
    /// X_Y.
    pub load_sharing_factor: f64,
    /// ρ_n.
    pub relative_radius_mm: f64,
    /// p_H.
    pub nominal_pressure_MPa: f64,
    /// p_dyn.
    pub pressure_MPa: f64,
    /// Hertz's half-width under p_dyn.
    #[serde(default)]
    pub half_width_mm: f64,
    /// θ_B.
    pub contact_temperature_C: f64,
    /// h.
    pub film_um: f64,
    /// λ_GF.
    pub lambda: f64,
}

/// Scuffing temperatures, and the safeties against scuffing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ScuffingSummary {
    /// μ_m of the flash temperature; `None` of it, and of what follows from it, for the reason in `flash_null_because`.
    pub flash_friction: Option<f64>,
    /// Mean of θ_fl over the path.
    pub mean_flash_K: Option<f64>,
    /// Greatest θ_fl.
    pub greatest_flash_K: Option<f64>,
    /// θ_M of ISO/TS 6336-20.
    #[serde(default)]
    pub flash_bulk_temperature_C: Option<f64>,
    /// θ_B: bulk and maximum flash temperature, ISO/TS 6336-20.
    pub contact_temperature_C: Option<f64>,
    /// θ_S of ISO/TS 6336-20.
    #[serde(default)]
    pub scuffing_temperature_C: Option<f64>,
    /// S_B, safety against scuffing by ISO/TS 6336-20.
    #[serde(default)]
    pub scuffing_safety: Option<f64>,
    /// θ_fl at A, B, C, D and E.
    #[serde(default)]
    pub flash_points: Vec<FlashPoint>,
    /// Why there is no flash temperature.
    #[serde(default)]
    pub flash_null_because: Option<String>,
    /// X_E of the integral temperature.
    #[serde(default)]
    pub run_in_factor: Option<f64>,
    /// μ_m of the integral temperature; `None` of it, and of what follows from it, for the reason in `integral_null_because`.
    pub integral_friction: Option<f64>,
    /// θ_flaint.
    pub integral_flash_K: Option<f64>,
    /// θ_M of ISO/TS 6336-21.
    #[serde(default)]
    pub integral_bulk_temperature_C: Option<f64>,
    /// θ_int, ISO/TS 6336-21.
    pub integral_temperature_C: Option<f64>,
    /// θ_intS of ISO/TS 6336-21.
    #[serde(default)]
    pub integral_scuffing_temperature_C: Option<f64>,
    /// S_intS, safety against scuffing by ISO/TS 6336-21.
    #[serde(default)]
    pub integral_scuffing_safety: Option<f64>,
    /// Why there is no integral temperature.
    #[serde(default)]
    pub integral_null_because: Option<String>,
    /// Why there are no safeties.
    #[serde(default)]
    pub safeties_null_because: Option<String>,
}

/// Flash temperature at a point of the path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FlashPoint {
    /// A, B, C, D or E.
    pub name: String,
    /// Radius of curvature of the pinion there.
    pub position_mm: f64,
    /// θ_fl.
    pub flash_K: f64,
}

/// Friction of the mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrictionSummary {
    /// Name of the model.
    pub model: String,
    /// Mean over the work of sliding, new.
    pub mean_new: f64,
    /// Mean, worn.
    pub mean_worn: f64,
}

/// Losses of the mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LossSummary {
    /// H_V.
    pub loss_factor_ohlendorf: f64,
    /// H_VL, from the run's own loads, new.
    pub loss_factor_local_new: f64,
    /// Local loss factor, worn.
    pub loss_factor_local_worn: f64,
    /// P, through the pinion.
    pub power_W: f64,
    /// P_VZ, from the run's own loads, new.
    pub mesh_power_loss_new_W: f64,
    /// Mesh power loss, worn.
    pub mesh_power_loss_worn_W: f64,
    /// 1 − P_VZ/P, new; bearings, seals and churning are not in it.
    pub efficiency_new: f64,
    /// Efficiency, worn.
    pub efficiency_worn: f64,
}

/// A row of `film.csv`: the contact of one slice at a position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmRow {
    /// radius of curvature of the pinion's flank at the theoretical contact point of the slice
    pub position_mm: f64,
    /// number of the slice over the face width, 0 at width 0
    pub slice: usize,
    /// place over the face width
    pub width_mm: f64,
    /// relative radius of curvature across the line of contact
    pub relative_radius_mm: f64,
    /// sum of the speeds of both surfaces through the contact
    pub sum_speed_m_per_s: f64,
    /// speed of the surfaces against each other
    pub sliding_speed_m_per_s: f64,
    /// normal load per mm of face width, new: 1/cos β_b of the transverse one
    pub line_load_new_N_per_mm: f64,
    /// the same, worn
    pub line_load_worn_N_per_mm: f64,
    /// film in the middle of the contact, new; empty without oil or load
    pub central_film_new_um: Option<f64>,
    /// the same, worn
    pub central_film_worn_um: Option<f64>,
    /// least film in the contact, new
    pub minimum_film_new_um: Option<f64>,
    /// the same, worn
    pub minimum_film_worn_um: Option<f64>,
    /// local film of ISO/TS 6336-22, new
    pub local_film_new_um: Option<f64>,
    /// the same, worn
    pub local_film_worn_um: Option<f64>,
    /// local film over roughness, new
    pub lambda_new: Option<f64>,
    /// the same, worn
    pub lambda_worn: Option<f64>,
    /// contact above the temperature of the teeth, new
    pub flash_new_K: Option<f64>,
    /// the same, worn
    pub flash_worn_K: Option<f64>,
    /// coefficient of friction, new; empty without load
    pub friction_new: Option<f64>,
    /// the same, worn
    pub friction_worn: Option<f64>,
    /// least film, of oil as warm as the teeth, over the composite roughness √(Rq₁² + Rq₂²), new; empty without load
    pub composite_lambda_new: Option<f64>,
    /// the same, worn, over the roughness of flanks that are run in
    pub composite_lambda_worn: Option<f64>,
}
