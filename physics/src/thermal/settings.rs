//! What is asked of contact temperatures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tooth::ToothHeatSettings;
use crate::gear::PerGear;

/// 0 K in °C.
pub const ABSOLUTE_ZERO_C: f64 = -273.15;

/// How contact temperatures are found.
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

    /// Its place in [`Self::ALL`].
    pub fn index(self) -> usize {
        match self {
            Self::HeatEquation => 0,
            Self::Williams => 1,
            Self::TianKennedy => 2,
        }
    }

    /// As reports name it.
    pub fn title(self) -> &'static str {
        match self {
            Self::HeatEquation => "heat equation",
            Self::Williams => "Williams",
            Self::TianKennedy => "Tian and Kennedy",
        }
    }
}

/// With which velocity heat moves over a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum HeatVelocity {
    /// The sliding velocity of the flanks, on both bodies, as in the thesis.
    #[default]
    Sliding,
    /// Each body's own surface velocity.
    Surface,
}

/// Which part of the friction heat each body takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum HeatPartition {
    /// Such that both surfaces get equally hot, after Archard and Rowntree.
    #[default]
    ArchardRowntree,
    /// Half of it.
    Equal,
}

/// Heat in a body.
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
    /// How temperatures are found.
    pub method: TemperatureMethod,
    /// With which velocity heat moves over the bodies.
    pub velocity: HeatVelocity,
    /// How both share it.
    pub partition: HeatPartition,
    /// μ; none where it is that of the mesh.
    pub friction_coefficient: Option<f64>,
    /// Temperature of the bodies away from the contact, K; where `tooth` or the mesh is the bulk, that of the surroundings or of the oil, above
    /// which it is found for each load and speed.
    pub bulk_temperature_k: f64,
    /// Whether it is that of the teeth in their oil, θ_M of ISO/TS 6336-22.
    pub is_bulk_of_mesh: bool,
    /// Temperature of the teeth of plastic gears, where asked for.
    pub tooth: Option<ToothHeatSettings>,
    /// Of each gear.
    pub material: PerGear<ThermalMaterial>,
}
