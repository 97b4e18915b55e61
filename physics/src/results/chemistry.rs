//! Wear law and temperatures of the contact in `summary.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::PerGear;

pub use crate::thermal::settings::{HeatPartition, HeatVelocity, TemperatureMethod};
pub use crate::wear::regime::Regime;

/// The wear law and where it stands.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WearLawSummary {
    /// Name of the law.
    pub law: String,
    /// The coefficient as given: k of the generalised Archard law, k_r of the others.
    pub coefficient_mm3_per_Nm: f64,
    /// Depth of mild wear per pressure and sliding distance on average over a mesh, weighted by the sliding work, new.
    pub effective_coefficient_new_mm3_per_Nm: f64,
    /// Effective coefficient, worn.
    pub effective_coefficient_worn_mm3_per_Nm: f64,
    /// Regime of the IRG transition diagram that the effective coefficient, new, is in.
    pub irg_regime: Regime,
    /// The effective coefficient, new, times the severe factor; `None` without a transition.
    pub severe_coefficient_mm3_per_Nm: Option<f64>,
    /// Regime that the severe coefficient is in.
    pub irg_regime_severe: Option<Regime>,
    /// Names of the law's constants that are typical values of the program: orders of magnitude, not measured ones.
    pub typical_constants: Vec<String>,
    /// Contact temperatures between which the law holds; `None` where it names none.
    pub valid_temperature_C: Option<[f64; 2]>,
    /// Part of the sliding work of a mesh that is done outside them, new.
    pub work_outside_validity_new: Option<f64>,
    /// Part of the work outside the validity, worn.
    pub work_outside_validity_worn: Option<f64>,
}

/// The temperatures of the contact.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TemperatureSummary {
    /// How they are found.
    pub method: TemperatureMethod,
    /// With which velocity heat moves over the bodies.
    pub velocity: HeatVelocity,
    /// How both share the heat.
    pub partition: HeatPartition,
    /// μ.
    pub friction_coefficient: f64,
    /// Of the gears away from the contact.
    pub bulk_temperature_C: f64,
    /// Of the teeth of each gear by VDI 2736-2; `None` where nobody asks for them, and of a metal gear beside a plastic one.
    pub tooth: Option<PerGear<Option<ToothTemperatureSummary>>>,
    /// Why a gear has none although it is asked for.
    #[serde(default)]
    pub tooth_null_because: Option<PerGear<Option<String>>>,
    /// Maximum rise above it over a mesh, new.
    pub greatest_rise_new_K: f64,
    /// Greatest rise, worn.
    pub greatest_rise_worn_K: f64,
    /// Least Peclet number of either surface where the pair carries load, new.
    pub peclet_min: f64,
    /// Greatest.
    pub peclet_max: f64,
    /// Maximum rise by every method.
    pub by_method: RisesByMethod,
}

/// Temperature of the teeth of a plastic gear.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ToothTemperatureSummary {
    /// At the flank.
    pub flank_C: f64,
    /// At the root.
    pub root_C: f64,
    /// Young's modulus that the gear has in the run.
    #[serde(default)]
    pub young_modulus_GPa: Option<f64>,
    /// Factor of that temperature on its wear coefficient; `None` where wear does not follow it.
    #[serde(default)]
    pub wear_factor: Option<f64>,
}

/// Maximum rise over a mesh by every method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RisesByMethod {
    /// The transient heat equation.
    pub heat_equation: GreatestRise,
    /// Williams.
    pub williams: GreatestRise,
    /// Tian and Kennedy.
    pub tian_kennedy: GreatestRise,
}

/// Maximum rise over a mesh.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GreatestRise {
    /// New.
    pub greatest_rise_new_K: f64,
    /// Worn.
    pub greatest_rise_worn_K: f64,
}
