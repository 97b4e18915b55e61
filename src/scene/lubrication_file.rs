//! What a user may write of oil, friction and the load factors of standards: `[lubricant]`, `[friction]` and `[load_factors]` of the scene
//! file.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_physics::lubrication::film::CentralFilm;
use gearwear_physics::lubrication::settings::{BaseOil, FrictionModel, OilSupply, PressureViscosityFit, ViscosityFit};

/// The oil, by its class or its viscosities.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LubricantFile {
    /// Viscosity class ISO VG; the viscosity at 100 °C is that of a mineral oil of viscosity index 95 unless it is given. Required, or
    /// viscosity_40C_mm2_per_s.
    #[schemars(extend("enum" = [10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000]))]
    pub viscosity_class: Option<u32>,
    /// Kinematic viscosity at 40 °C in mm²/s (cSt), 2 to 100000. Required, or viscosity_class.
    #[schemars(range(min = 2, max = 100000))]
    pub viscosity_40C_mm2_per_s: Option<f64>,
    /// Kinematic viscosity at 100 °C in mm²/s (cSt), 1 to 10000, below that at 40 °C. Required, or viscosity_class.
    #[schemars(range(min = 1, max = 10000))]
    pub viscosity_100C_mm2_per_s: Option<f64>,
    /// Viscosity over temperature. Default: astm-d341.
    pub viscosity_fit: Option<ViscosityFit>,
    /// Base oil: decides pressure–viscosity coefficient, density and factor X_L. Default: mineral.
    pub base: Option<BaseOil>,
    /// Density at 15 °C in kg/m³, 500 to 2000. Default: 890 of mineral oil, 850 of polyalphaolefin, 1050 of polyglycol.
    #[schemars(range(min = 500, max = 2000))]
    pub density_15C_kg_per_m3: Option<f64>,
    /// Fit of the pressure–viscosity coefficient. Default: iso-6336-22.
    pub pressure_viscosity: Option<PressureViscosityFit>,
    /// Pressure–viscosity coefficient α in 1/GPa, > 0 to 200, at every temperature, instead of a fit.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 200))]
    pub pressure_viscosity_per_GPa: Option<f64>,
    /// Temperature of the oil at the mesh in °C, −60 to 250. Required.
    #[schemars(range(min = -60, max = 250))]
    pub temperature_C: Option<f64>,
    /// Temperature of the teeth in °C, −60 to 400. Default: that of ISO/TS 6336-22 from oil and loss.
    #[schemars(range(min = -60, max = 400))]
    pub bulk_temperature_C: Option<f64>,
    /// Supply of the oil, factor X_S of the temperature of the teeth. Default: dip.
    pub supply: Option<OilSupply>,
    /// Factor X_L of friction, > 0 to 2. Default: 1 of mineral oil, 0.8 of polyalphaolefin, 0.7 of polyglycol.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
    pub lubricant_factor: Option<f64>,
    /// Formula of the central film. Default: hamrock.
    pub central_film: Option<CentralFilm>,
    /// Permissible specific film thickness λ_GFP of ISO/TS 6336-22, > 0 to 10; gives the safety against micropitting. Default: none.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10))]
    pub permissible_lambda: Option<f64>,
    /// Failure load stage in the FZG scuffing test A/8.3/90, 1 to 14; gives the safeties S_B and S_intS against scuffing. Default: none.
    #[schemars(range(min = 1, max = 14))]
    pub fzg_scuffing_load_stage: Option<u32>,
    /// Structural factor X_W of the flanks, 0.2 to 3: 1 for case-hardened and through-hardened steel, 1.5 nitrided, 1.25 phosphated, 0.45
    /// stainless. Default 1.
    #[schemars(range(min = 0.2, max = 3))]
    pub structural_factor: Option<f64>,
    /// Running-in φ_E of the scuffing temperatures, 0 to 1: 0 new, 1 run in. Default 1.
    #[schemars(range(min = 0, max = 1))]
    pub relative_run_in: Option<f64>,
}

/// Friction of the mesh: losses, and the heat of the films.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionFile {
    /// Friction model; all but constant and table need [lubricant]. Default: table with friction.table, otherwise iso-6336-22.
    pub model: Option<FrictionModel>,
    /// Coefficient of friction μ, > 0 to 2. Required with model = "constant".
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
    pub coefficient: Option<f64>,
    /// A measured traction curve, for model = "table".
    pub table: Option<FrictionTableFile>,
}

/// A measured traction curve: straight between its points, and level beyond the first and the last.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionTableFile {
    /// Sliding speed over the mean speed of both surfaces, 0 to 2, rising. Required.
    #[schemars(length(min = 2), inner(range(min = 0, max = 2)))]
    pub slide_to_roll_ratio: Option<Vec<f64>>,
    /// Coefficient of friction at each, 0 to 2. Required.
    #[schemars(length(min = 2), inner(range(min = 0, max = 2)))]
    pub coefficient: Option<Vec<f64>>,
}

/// Load factors of ISO 6336-1, read by the figures of standards, and the first two by the films of the run's own contact.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadFactorsFile {
    /// Application factor K_A (times K_γ of uneven planets), 0.1 to 20. Default 1.
    #[schemars(range(min = 0.1, max = 20))]
    pub application: Option<f64>,
    /// Dynamic factor K_V, 1 to 20. Default 1.
    #[schemars(range(min = 1, max = 20))]
    pub dynamic: Option<f64>,
    /// Transverse load factor K_Hα, 1 to 20. Default 1.
    #[schemars(range(min = 1, max = 20))]
    pub transverse: Option<f64>,
    /// Face load factor K_Hβ, 1 to 20. Default 1.
    #[schemars(range(min = 1, max = 20))]
    pub face: Option<f64>,
}
