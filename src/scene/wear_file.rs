//! What a user may write of wear laws and of heat, which some of them read: `[wear]` and `[temperature]` of the scene file.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_physics::lubrication::settings::FilmRatio;
use gearwear_physics::thermal::settings::{HeatPartition, HeatVelocity, TemperatureMethod};
use gearwear_physics::wear::oxidation::MassRatio;

/// Friction heat of the contact.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TemperatureFile {
    /// Method of the contact temperatures. Default: tian-kennedy.
    pub method: Option<TemperatureMethod>,
    /// Velocity with which heat moves over the bodies. Default: sliding, as in the thesis.
    pub velocity: Option<HeatVelocity>,
    /// Partition of the heat between the bodies. Default: archard-rowntree.
    pub partition: Option<HeatPartition>,
    /// Coefficient of friction μ, > 0 to 2. Default: that of the mesh with [friction] or [lubricant], otherwise 0.1.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
    pub friction_coefficient: Option<f64>,
    /// Bulk temperature of the gears in °C, > −273.15 to 1500. Default: the plastic gear's flanks with [temperature.tooth], θ_M of ISO/TS
    /// 6336-22 with [lubricant], otherwise 90.
    #[schemars(extend("exclusiveMinimum" = -273.15, "maximum" = 1500))]
    pub bulk_temperature_C: Option<f64>,
    /// Temperature of the teeth of plastic gears by VDI 2736-2; needs a coefficient of friction. Default: not computed.
    pub tooth: Option<ToothTemperatureFile>,
}

/// Temperature of the teeth of plastic gears by VDI 2736-2, from power, friction and loss factor. Needs a coefficient of friction:
/// temperature.friction_coefficient, [friction] or [lubricant].
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToothTemperatureFile {
    /// Ambient temperature θ_0 in °C, −60 to 250; of gears in oil, that of the oil. Required.
    #[schemars(range(min = -60, max = 250))]
    pub ambient_temperature_C: Option<f64>,
    /// Lubrication of the teeth, from which the coefficients k_θ follow. Required, or flank_heat_coefficient and root_heat_coefficient.
    pub lubrication: Option<ToothLubrication>,
    /// k_θ of the flank in K·(m/s)^0.75·mm^1.75/W, 0 to 50000, for grease and other lubrication.
    #[schemars(range(min = 0, max = 50000))]
    pub flank_heat_coefficient: Option<f64>,
    /// k_θ of the root in the same unit, 0 to 50000.
    #[schemars(range(min = 0, max = 50000))]
    pub root_heat_coefficient: Option<f64>,
    /// Heat resistance R_λG of the housing in K·m²/W, 0 to 1: 0.015 to 0.045 where it is partly open, 0.06 where it is closed. Default 0: gears
    /// in the open.
    #[schemars(range(min = 0, max = 1))]
    pub housing_resistance_K_m2_per_W: Option<f64>,
    /// Surface A_G of the housing in m², > 0 to 100. Required with a resistance.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub housing_area_m2: Option<f64>,
    /// Duty cycle ED, the time under load over the whole, > 0 to 1. Default 1.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub duty_cycle: Option<f64>,
}

/// How the teeth of plastic gears are lubricated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToothLubrication {
    /// Not at all: k_θ 6300 (flank) and 895 (root) of plastic on metal, 9000 and 2148 of plastic on plastic.
    Dry,
    /// In oil: k_θ 0.
    Oil,
}

/// The wear law: one of the two coefficients must be given. What stands here holds for both gears, unless `[wear.pinion]` or
/// `[wear.wheel]` says otherwise for one of them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WearFile {
    /// Wear law. Required, here or for each gear.
    pub law: Option<WearLaw>,
    /// Wear coefficient k in m²/N, > 0: depth per pressure and sliding distance. Mild wear of steel: 1e-19 to 1e-16. Required, here or for
    /// each gear, or coefficient_mm3_per_Nm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub coefficient_m2_per_N: Option<f64>,
    /// The same as volume per force and sliding distance in mm³/(N·m), > 0: 1e-8 is 1e-17 m²/N. Required, or coefficient_m2_per_N.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub coefficient_mm3_per_Nm: Option<f64>,
    /// Transition from mild to severe wear. Default: none.
    pub severe: Option<SevereFile>,
    /// Factor of the oil film on wear; needs [lubricant]. Default: none.
    pub film: Option<FilmFile>,
    /// Factor on the wear coefficient over the temperature of the flanks; needs [temperature.tooth]. Default: none.
    pub warm: Option<WarmFile>,
    /// Constants of law = "adsorption". Default: typical orders of magnitude, which the run names.
    pub adsorption: Option<AdsorptionFile>,
    /// Constants of law = "oxidation". Default: typical orders of magnitude, which the run names.
    pub oxidation: Option<OxidationFile>,
    /// Wear law of the pinion alone. Default: as for both.
    pub pinion: Option<GearWearFile>,
    /// Wear law of the wheel alone. Default: as for both.
    pub wheel: Option<GearWearFile>,
}

/// The wear law of one gear: each key in place of that of `[wear]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GearWearFile {
    /// Wear law. Default: wear.law.
    pub law: Option<WearLaw>,
    /// Wear coefficient in m²/N, 0 or more; with 0 the gear does not wear, not 0 for both. Default: that of `[wear]`.
    #[schemars(range(min = 0))]
    pub coefficient_m2_per_N: Option<f64>,
    /// The same in mm³/(N·m), 0 or more.
    #[schemars(range(min = 0))]
    pub coefficient_mm3_per_Nm: Option<f64>,
    /// Transition to severe wear, in place of the whole of wear.severe; a factor of 1 is none. Default: wear.severe.
    pub severe: Option<SevereFile>,
    /// Factor of the oil film, in place of the whole of wear.film. Default: wear.film.
    pub film: Option<FilmFile>,
    /// Factor over the temperature, in place of the whole of wear.warm. Default: wear.warm.
    pub warm: Option<WarmFile>,
    /// Constants of law = "adsorption", each in place of that of wear.adsorption.
    pub adsorption: Option<AdsorptionFile>,
    /// Constants of law = "oxidation", each in place of that of wear.oxidation.
    pub oxidation: Option<OxidationFile>,
}

/// Name of a wear law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WearLaw {
    /// Depth = k · pressure · sliding distance.
    Archard,
    /// Archard's law where an adsorbed film leaves the surface bare. The coefficient is that of the bare surface, 1e-13 to 1e-12 m²/N.
    Adsorption,
    /// Sliding removes an oxide that grows linearly with time, for contact temperatures of about 200 to 400 °C. The coefficient is about one
    /// over the hardness, 1e-10 m²/N.
    Oxidation,
}

/// Constants of an adsorbed film.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AdsorptionFile {
    /// Diameter X of a molecule in nm, > 0. Default 0.3 (typical).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub molecule_diameter_nm: Option<f64>,
    /// Fundamental time of vibration t₀ of a molecule in ps, > 0. Default 3 (typical).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub vibration_time_ps: Option<f64>,
    /// Heat of adsorption E in kJ/mol, 0 or more; typically 40 to 55. Default 48 (typical).
    #[schemars(range(min = 0))]
    pub heat_of_adsorption_kJ_per_mol: Option<f64>,
}

/// Constants of the oxidation of iron.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OxidationFile {
    /// Arrhenius constant A_l of linear oxidation in kg/(m²·s), > 0: oxygen taken up. Default 1000 (typical).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub arrhenius_constant_kg_per_m2s: Option<f64>,
    /// Activation energy Q_l in kJ/mol, 0 or more. Default 100 (typical).
    #[schemars(range(min = 0))]
    pub activation_energy_kJ_per_mol: Option<f64>,
    /// Density of the iron in kg/m³, > 0. Default 7870.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_per_m3: Option<f64>,
    /// Mass of iron from that of oxygen. Default: stoichiometric.
    pub mass_ratio: Option<MassRatio>,
}

/// A factor on the wear coefficient that follows λ, the film of oil over the roughness of both flanks, at every point of the new and of the worn
/// flank. Flanks are taken as run in: their roughness is roughness_run_in_Ra_um where that is given.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FilmFile {
    /// Factor over λ. Required, or lambda and factor, which make it a table.
    pub law: Option<FilmLaw>,
    /// λ of law = "table", 0 to 1000, rising.
    #[schemars(length(min = 2), inner(range(min = 0, max = 1000)))]
    pub lambda: Option<Vec<f64>>,
    /// Factor on the wear coefficient at each λ, 0 to 1000: linear between them, constant beyond.
    #[schemars(length(min = 2), inner(range(min = 0, max = 1000)))]
    pub factor: Option<Vec<f64>>,
    /// Definition of λ, of run-in flanks. Default: composite.
    pub ratio: Option<FilmRatio>,
}

/// A factor on the wear coefficient over the temperature of the flanks, by VDI 2736-2: straight between its points, and level beyond the first and the last.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WarmFile {
    /// Temperatures in °C, −273 to 1000, rising. Required.
    #[schemars(length(min = 2), inner(range(min = -273, max = 1000)))]
    pub temperature_C: Option<Vec<f64>>,
    /// Factor at each, > 0 to 1000. Required.
    #[schemars(length(min = 2), inner(range(min = 0.000001, max = 1000)))]
    pub factor: Option<Vec<f64>>,
}

/// How wear follows λ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FilmLaw {
    /// Not at all.
    None,
    /// Priest and Taylor's: 1 below λ = 0.5, (2/7)(4 − λ) up to 4, no wear above.
    PriestTaylor,
    /// As lambda and factor say.
    Table,
}

/// Transition from mild to severe wear.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SevereFile {
    /// Local pressure above which wear is severe in MPa, > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub above_MPa: f64,
    /// Factor on the wear coefficient there, > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub factor: f64,
    /// Range of pressure around above_MPa over which the factor rises in MPa, 0 or more; 0: at once, as in the thesis, though adaptive steps follow no
    /// less than 2 % of above_MPa. Default: 5 % of above_MPa.
    #[schemars(range(min = 0))]
    pub band_MPa: Option<f64>,
}
