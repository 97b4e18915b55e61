//! Settings of films, friction and losses.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::film::CentralFilm;
use gearwear_bodies::gear::PerGear;

/// Viscosity over temperature, from the two values that are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ViscosityFit {
    /// ASTM D341, Walther's equation with 0.7 mm²/s.
    #[default]
    AstmD341,
    /// DIN 51563, Ubbelohde and Walther's with 0.8 mm²/s.
    Din51563,
}

/// Base oil.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BaseOil {
    /// Mineral oil.
    #[default]
    Mineral,
    /// Polyalphaolefin (PAO).
    Polyalphaolefin,
    /// Polyglycol (PAG) that water does not dissolve.
    Polyglycol,
}

/// Viscosity over pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PressureViscosityFit {
    /// The fit of ISO/TS 6336-22, from the viscosity at 38 °C.
    #[default]
    #[serde(rename = "iso-6336-22")]
    Iso633622,
    /// Gold's fit, from the viscosity at the temperature itself.
    Gold,
}

/// The pressure–viscosity coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PressureViscosity {
    /// By a fit.
    Fit(PressureViscosityFit),
    /// Given, 1/GPa, at every temperature.
    Given {
        /// α, 1/GPa.
        per_gpa: f64,
    },
}

/// Oil supply of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OilSupply {
    /// Gears that dip into it: lubrication factor X_S = 1.0.
    #[default]
    Dip,
    /// Injected: X_S = 1.2.
    Injection,
    /// Gears under it: X_S = 0.2.
    Submerged,
}

impl OilSupply {
    /// X_S of ISO/TS 6336-22.
    pub fn factor(self) -> f64 {
        match self {
            Self::Dip => 1.0,
            Self::Injection => 1.2,
            Self::Submerged => 0.2,
        }
    }
}

/// An oil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OilSettings {
    /// ν₄₀, mm²/s.
    pub viscosity_40c_mm2_per_s: f64,
    /// ν₁₀₀, mm²/s.
    pub viscosity_100c_mm2_per_s: f64,
    /// Viscosity at other temperatures.
    pub fit: ViscosityFit,
    /// Base oil.
    pub base: BaseOil,
    /// ρ₁₅, kg/m³.
    pub density_15c_kg_per_m3: f64,
    /// α.
    pub pressure_viscosity: PressureViscosity,
}

/// Oil, and the flanks that it wets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LubricantSettings {
    /// The oil.
    pub oil: OilSettings,
    /// Temperature of the oil at the inlet of the mesh, °C.
    pub temperature_c: f64,
    /// Temperature of the teeth where it is given, °C; otherwise that of ISO/TS 6336-22.
    pub bulk_temperature_c: Option<f64>,
    /// X_S.
    pub supply: OilSupply,
    /// Formula of the central film.
    pub central_film: CentralFilm,
    /// X_L where it is given; otherwise that of the base oil by each method.
    pub lubricant_factor: Option<f64>,
    /// λ_GFP, from a test of the oil.
    pub permissible_lambda: Option<f64>,
    /// Scuffing.
    pub scuffing: ScuffingSettings,
    /// Roughness of both flanks.
    pub roughness: PerGear<Roughness>,
    /// Thermal contact coefficient B_M = √(λ ρ c) of each gear, W·√s/(m²·K).
    pub thermal_contact_w_s05_per_m2_k: PerGear<f64>,
}

/// Settings of scuffing beyond the oil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScuffingSettings {
    /// Failure load stage of the oil in the FZG test A/8.3/90; none where it is not given.
    pub fzg_load_stage: Option<u32>,
    /// X_W over that of the test gears.
    pub structural_factor: f64,
    /// φ_E: 0 for new flanks, 1 for run-in flanks.
    pub relative_run_in: f64,
}

/// Roughness of a flank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// Arithmetic mean Ra, µm.
    pub ra_um: f64,
    /// Ra of the run-in flank, µm.
    pub run_in_ra_um: f64,
    /// Root mean square Rq, µm.
    pub rq_um: f64,
}

/// Coefficient of friction of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionModel {
    /// The value of friction.coefficient.
    Constant,
    /// Niemann's mean value after Schlenk.
    Schlenk,
    /// The mean value of ISO/TS 6336-22.
    #[default]
    #[serde(rename = "iso-6336-22")]
    Iso633622,
    /// The mean value of the integral temperature, ISO/TS 6336-21.
    #[serde(rename = "iso-6336-21")]
    Iso633621,
    /// The mean value of the flash temperature, ISO/TS 6336-20.
    #[serde(rename = "iso-6336-20")]
    Iso633620,
    /// Benedict and Kelley's, at every point.
    BenedictKelley,
    /// Xu's, at every point.
    Xu,
    /// By the slide-to-roll ratio at every point, as friction.table has it.
    Table,
}

impl FrictionModel {
    /// Name in scenes and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Schlenk => "schlenk",
            Self::Iso633622 => "iso-6336-22",
            Self::Iso633621 => "iso-6336-21",
            Self::Iso633620 => "iso-6336-20",
            Self::BenedictKelley => "benedict-kelley",
            Self::Xu => "xu",
            Self::Table => "table",
        }
    }
}

/// Friction of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionSettings {
    /// The model.
    pub model: FrictionModel,
    /// μ of [`FrictionModel::Constant`].
    pub coefficient: Option<f64>,
    /// μ of [`FrictionModel::Table`].
    pub table: Option<FrictionTable>,
}

/// A measured traction curve: linear between its points, constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionTable {
    /// v_g/(v_Σ/2), rising; two at least.
    pub slide_to_roll_ratio: Vec<f64>,
    /// μ at each.
    pub coefficient: Vec<f64>,
}

/// λ: the ratio of a film to a roughness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum FilmRatio {
    /// λ_GF of ISO/TS 6336-22: its local film over the mean Ra of both flanks.
    #[serde(rename = "iso-6336-22")]
    Iso633622,
    /// Dowson and Higginson's least film, of oil as warm as the teeth, over √(Rq₁² + Rq₂²).
    #[serde(rename = "composite")]
    Composite,
}

/// Load factors of ISO 6336-1; 1 leaves the nominal load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadFactors {
    /// K_A, that of uneven planets included.
    pub application: f64,
    /// K_V.
    pub dynamic: f64,
    /// K_Hα.
    pub transverse: f64,
    /// K_Hβ.
    pub face: f64,
}

impl LoadFactors {
    /// K_A K_V K_Hα K_Hβ.
    pub fn product(&self) -> f64 {
        self.application * self.dynamic * self.transverse * self.face
    }
}

/// Settings of films, friction and losses.
#[derive(Debug, Clone, PartialEq)]
pub struct LubricationSettings {
    /// Lubricant; none where the scene has only a constant friction.
    pub lubricant: Option<LubricantSettings>,
    /// Coefficient of friction.
    pub friction: FrictionSettings,
    /// Load factors of the standards.
    pub load_factors: LoadFactors,
}
