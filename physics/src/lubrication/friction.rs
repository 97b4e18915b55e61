//! Coefficient of friction of the mesh, as a mean value or at every point.
//!
//! Mean values, from load and speeds at C under the whole load (F_bt and F_t at base and reference circle, N; ρ_C in mm, v_ΣC in m/s, η at
//! the temperature of the oil in mPa·s, Ra the mean of both gears in µm):
//!
//! ```text
//! Schlenk          μ = 0.048 (K_A F_bt/b / (v_ΣC ρ_C))^0.2 η^−0.05 Ra^0.25 X_L
//! ISO/TS 6336-22   μ = 0.045 (K K_Bγ F_bt/b / (v_ΣC ρ_C))^0.2 η^−0.05 · 2.2 (Ra/ρ_C)^0.25 X_L
//! ISO/TS 6336-21   the same with F_t
//! ISO/TS 6336-20   μ = 0.060 (K F_t/b / (v_ΣC ρ_C))^0.2 η^−0.05 ((1 − 0.4 φ_E) Ra)^0.25 X_L        flanks run in to 0.6 Ra at φ_E = 1
//! ```
//!
//! At every point (w in N per mm of line of contact, v_g in m/s):
//!
//! ```text
//! Benedict and Kelley   μ = 0.0127 · 1.27/(1.27 − Ra) · lg(29660 w / (η v_g v_Σ²))
//! Xu                    μ = exp f · P_h^1.03303 |SR|^1.036077 V_e^−0.100601 η^0.752755 R^−0.390958
//!                       f = −8.916465 − 0.354068 |SR| P_h lg η + 2.812084 exp(−|SR| P_h lg η) + 0.620305 exp S
//! ```
//!
//! with P_h the greatest pressure in GPa, SR = v_g/V_e, V_e = v_Σ/2 in m/s, R = ρ in m, S = √(Rq₁² + Rq₂²) in µm. X_L is 1 for mineral
//! oil, 0.8 for polyalphaolefin and 0.7 for polyglycol unless it is given.
//!
//! Sources: G. Niemann and H. Winter, *Maschinenelemente* II, 21.10, after Schlenk; ISO/TS 6336-22 (ISO/TR 15144-1:2014), 7.5; ISO/TS
//! 6336-20 (ISO/TR 13989-1:2000), 9.2; G. H. Benedict and B. W. Kelley, ASLE Trans. 4 (1961), in metric units; H. Xu, A. Kahraman,
//! N. E. Anderson and D. G. Maddock, J. Mech. Des. 129 (2007), regression of a thermal EHL model.
//!
//! Limits: Benedict and Kelley's diverges where sliding stops, where it is cut off at 0.2; Xu's is for full and mixed films of a
//! gear oil up to 2.5 GPa, and goes to zero with the sliding.

use super::rolling_contact::RollingContact;
use super::settings::{BaseOil, FrictionModel, FrictionTable};
use gearwear_bodies::reference::linear_means::value_at;

/// Greatest μ of a lubricated mesh; formulas with a logarithm exceed it where sliding stops.
const GREATEST: f64 = 0.2;
/// Ra of flanks that are run in over that of new ones, ISO/TS 6336-20.
const RUN_IN_ROUGHNESS: f64 = 0.6;

/// Conditions that mean values depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanConditions {
    /// F_bt/b, N/mm.
    pub line_load_n_per_mm: f64,
    /// F_t/F_bt = cos α_t.
    pub tangential_over_base: f64,
    /// K = K_A K_V K_Hα K_Hβ.
    pub load_factor: f64,
    /// K_Bγ.
    pub helical_factor: f64,
    /// K_A.
    pub application_factor: f64,
    /// v_ΣC, m/s.
    pub sum_speed_m_per_s: f64,
    /// ρ_C, mm.
    pub relative_radius_mm: f64,
    /// η at the temperature of the oil, mPa·s.
    pub viscosity_milli_pa_s: f64,
    /// Ra, µm.
    pub ra_um: f64,
    /// φ_E of the integral temperature: 0 for new flanks, 1 for run-in flanks.
    pub relative_run_in: f64,
    /// X_L.
    pub lubricant_factor: f64,
}

impl MeanConditions {
    fn with(&self, constant: f64, factor: f64, roughness: f64) -> f64 {
        let load = factor * self.line_load_n_per_mm / (self.sum_speed_m_per_s * self.relative_radius_mm);
        constant * load.powf(0.2) * self.viscosity_milli_pa_s.powf(-0.05) * roughness * self.lubricant_factor
    }

    /// μ of Schlenk.
    pub fn schlenk(&self) -> f64 {
        self.with(0.048, self.application_factor, self.ra_um.powf(0.25))
    }

    /// μ_m of ISO/TS 6336-22.
    pub fn iso_6336_22(&self) -> f64 {
        self.iso_with_roughness_over_radius(1.0)
    }

    /// μ_m of the integral temperature.
    pub fn iso_6336_21(&self) -> f64 {
        self.iso_with_roughness_over_radius(self.tangential_over_base)
    }

    fn iso_with_roughness_over_radius(&self, of_base_load: f64) -> f64 {
        let roughness = 2.2 * (self.ra_um / self.relative_radius_mm).powf(0.25);
        self.with(0.045, self.load_factor * self.helical_factor * of_base_load, roughness)
    }

    /// μ_m of the flash temperature.
    pub fn iso_6336_20(&self) -> f64 {
        let smoothed = 1.0 - (1.0 - RUN_IN_ROUGHNESS) * self.relative_run_in;
        let roughness = (smoothed * self.ra_um).powf(0.25);
        self.with(0.060, self.load_factor * self.tangential_over_base, roughness)
    }

    /// Mean value by `model`; none where the model is local, or μ given.
    pub fn mean(&self, model: FrictionModel) -> Option<f64> {
        match model {
            FrictionModel::Schlenk => Some(self.schlenk()),
            FrictionModel::Iso633622 => Some(self.iso_6336_22()),
            FrictionModel::Iso633621 => Some(self.iso_6336_21()),
            FrictionModel::Iso633620 => Some(self.iso_6336_20()),
            FrictionModel::Constant | FrictionModel::BenedictKelley | FrictionModel::Xu | FrictionModel::Table => None,
        }
    }
}

/// X_L of the standards.
pub fn lubricant_factor(base: BaseOil) -> f64 {
    match base {
        BaseOil::Mineral => 1.0,
        BaseOil::Polyalphaolefin => 0.8,
        BaseOil::Polyglycol => 0.7,
    }
}

impl FrictionTable {
    /// μ at a point.
    pub fn at(&self, contact: &RollingContact) -> f64 {
        value_at(&self.slide_to_roll_ratio, &self.coefficient, contact.slide_to_roll_ratio())
    }
}

/// Benedict and Kelley's μ at a point; Ra below 1.27 µm.
pub fn benedict_kelley(contact: &RollingContact, viscosity_milli_pa_s: f64, ra_um: f64) -> f64 {
    let speeds = contact.sliding_speed_m_per_s() * contact.sum_speed_m_per_s().powi(2);
    let argument = 29_660.0 * contact.line_load_n_per_mm / (viscosity_milli_pa_s * speeds);
    let rough = 1.27 / (1.27 - ra_um);
    (0.0127 * rough * argument.log10()).clamp(0.0, GREATEST)
}

/// Xu's μ at a point.
pub fn xu(contact: &RollingContact, viscosity_milli_pa_s: f64, rq_um: f64) -> f64 {
    let entrainment = 0.5 * contact.sum_speed_m_per_s();
    let slide_to_roll = contact.slide_to_roll_ratio();
    if slide_to_roll == 0.0 {
        return 0.0;
    }
    let pressure_gpa = 1e-3 * contact.peak_pressure_mpa;
    let heat = slide_to_roll * pressure_gpa * viscosity_milli_pa_s.log10();
    let f = -8.916_465 - 0.354_068 * heat + 2.812_084 * (-heat).exp() + 0.620_305 * rq_um.exp();
    f.exp()
        * pressure_gpa.powf(1.033_03)
        * slide_to_roll.powf(1.036_077)
        * entrainment.powf(-0.100_601)
        * viscosity_milli_pa_s.powf(0.752_755)
        * (1e-3 * contact.relative_radius_mm).powf(-0.390_958)
}
