//! Settings of contact temperatures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tooth::ToothHeatSettings;
use gearwear_bodies::gear::PerGear;

/// 0 K in °C.
pub const ABSOLUTE_ZERO_C: f64 = -273.15;

/// Method of contact temperatures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TemperatureMethod {
    /// The transient heat equation perpendicular to the surface, while a point passes through the contact (thesis eq 28).
    HeatEquation,
    /// Williams's limit of a fast band of heat (thesis eq 27).
    Williams,
    /// Tian and Kennedy's maximum temperature under a band of heat of any speed (thesis eq 29).
    #[default]
    TianKennedy,
}

impl TemperatureMethod {
    /// All methods.
    pub const ALL: [Self; 3] = [Self::HeatEquation, Self::Williams, Self::TianKennedy];

    /// Place in [`Self::ALL`].
    pub fn index(self) -> usize {
        match self {
            Self::HeatEquation => 0,
            Self::Williams => 1,
            Self::TianKennedy => 2,
        }
    }

    /// Name in reports.
    pub fn title(self) -> &'static str {
        match self {
            Self::HeatEquation => "heat equation",
            Self::Williams => "Williams",
            Self::TianKennedy => "Tian and Kennedy",
        }
    }
}

/// Velocity of the heat over a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum HeatVelocity {
    /// The sliding velocity of the flanks, on both bodies, as in the thesis.
    #[default]
    Sliding,
    /// Each body's own surface velocity.
    Surface,
}

/// Partition of the friction heat between both bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum HeatPartition {
    /// Both surfaces get equally hot, after Archard and Rowntree.
    #[default]
    ArchardRowntree,
    /// Half to each body.
    Equal,
}

/// Thermal properties of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermalMaterial {
    /// Conductivity K, W/(m·K), which is N/(s·K).
    pub conductivity_n_per_s_k: f64,
    /// Diffusivity κ, mm²/s.
    pub diffusivity_mm2_per_s: f64,
}

/// Friction heat of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatSettings {
    /// Method.
    pub method: TemperatureMethod,
    /// Velocity of the heat over the bodies.
    pub velocity: HeatVelocity,
    /// Partition between both bodies.
    pub partition: HeatPartition,
    /// μ; none where it is that of the mesh.
    pub friction_coefficient: Option<f64>,
    /// Temperature of the bodies away from the contact, K; where that is found for each load and speed, by `tooth` or for the mesh, the temperature
    /// of the surroundings or of the oil.
    pub bulk_temperature_k: f64,
    /// Whether that is the temperature of the teeth in their oil, θ_M of ISO/TS 6336-22.
    pub is_bulk_of_mesh: bool,
    /// Temperature of the teeth of plastic gears, where asked for.
    pub tooth: Option<ToothHeatSettings>,
    /// Material of each gear.
    pub material: PerGear<ThermalMaterial>,
}
