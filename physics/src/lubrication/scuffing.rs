//! Scuffing: flash temperature and integral temperature, as figures.
//!
//! With w_Bt = K F_t/b, Γ the place on the line of action from C in units of T₁C, X_M = E_r^¼ √1000/B_M and
//! X_αβ = 1.22 sin^¼ α_wt cos^¼ α_wn / √(cos α_wt cos α_t),
//!
//! ```text
//! flash      θ_fl = μ X_M X_J X_G X_αβ (X_Γ w_Bt)^¾ √v / a^¼
//!            X_G  = 0.51 √(u+1) |√(1+Γ) − √(1−Γ/u)| / [(1+Γ)^¼ (u−Γ)^¼]
//!            θ_M  = θ_oil + 0.47 X_S mean θ_fl          θ_B = θ_M + greatest θ_fl
//!
//! integral   θ_flaE = μ X_M X_BE X_αβ (K_Bγ w_Bt)^¾ √v / a^¼ · X_E/(X_Q X_Ca)
//!            X_BE = 0.51 √(u+1) (√ρ_E1 − √(ρ_E2/u)) / (ρ_E1 ρ_E2)^¼
//!            θ_int = θ_oil + 0.7 X_S θ_flaE X_ε + 1.5 θ_flaE X_ε
//! ```
//!
//! The flash temperature has no K_Bγ, nor has its friction. μ is the mean value of each standard, X_ε a sum
//! over ε₁ and ε₂ ([`contact_ratio_factor`]), X_Q = 1 up to ε before C of 1.5 times that after it, falling to 0.6 at 3 times, and
//! with C_a of the relief in µm and C_eff = K_A F_t/(b c), c = c' of spur and c_γα of helical gears,
//!
//! ```text
//! X_J  = 1 + (C_eff − C_a2)/50 · (−Γ/(Γ_E − Γ_A))³       before C, at least 1; C_a2 of the driven gear, whose tip enters at A
//! X_Ca = 1 + (0.06 + 0.18 C_a/C_eff) ε_max + (0.02 + 0.69 C_a/C_eff) ε_max²        C_a ≤ C_eff
//! X_E  = 1 + (1 − φ_E) 30 Ra/ρ_C                          φ_E = 0 new, 1 run in; Ra in µm, ρ_C in mm
//! ```
//!
//! Scuffing is held against temperatures at which the oil scuffed in the FZG test A/8.3/90, in its load stage S of torque T_1T (N·m), with X_L of
//! the oil (η^−0.05 X_L of friction in -20, the factor of its base in -21) and X_W of the flanks over that of the test gears:
//!
//! ```text
//! flash      θ_S = 80 + (0.85 + 1.4 X_W) X_L S²                                        S_B    = (θ_S − θ_oil)/(θ_B − θ_oil)
//! integral   θ_intS = 80 + 0.23 T_1T X_L + 1.5 X_W · 0.2 T_1T (100/ν₄₀)^0.02 X_L       S_intS = θ_intS/θ_int
//! ```
//!
//! T_1T is the torque of the stage; beyond stage 12, where the test has none, 3.726 S².
//!
//! Sources: ISO/TS 6336-20 and -21 (first ISO/TR 13989-1 and -2:2000), clauses 8 to 11; torques of ISO 14635-1. X_J, X_E and both scuffing
//! temperatures are held against printed reports of two programs (`validation/printed-scuffing`, `micropitting-method-b`).

/// Conditions that both temperatures depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScuffingConditions {
    /// E_r, MPa.
    pub reduced_modulus_mpa: f64,
    /// Mean B_M of both gears, W·√s/(m²·K).
    pub thermal_contact_w_s05_per_m2_k: f64,
    /// α_wt, rad.
    pub working_transverse_angle_rad: f64,
    /// α_wn, rad.
    pub working_normal_angle_rad: f64,
    /// α_t, rad.
    pub transverse_angle_rad: f64,
    /// w_Bt, N/mm.
    pub tangential_load_n_per_mm: f64,
    /// K_Bγ.
    pub helical_load_factor: f64,
    /// v, circumferential speed at the reference circle, m/s.
    pub circumferential_speed_m_per_s: f64,
    /// a, mm.
    pub centre_distance_mm: f64,
    /// u = z₂/z₁.
    pub gear_ratio: f64,
}

impl ScuffingConditions {
    /// X_M X_αβ w_Bt^¾ √v / a^¼, K.
    fn common_k(&self) -> f64 {
        let (wt, wn, t) = (self.working_transverse_angle_rad, self.working_normal_angle_rad, self.transverse_angle_rad);
        let x_m = self.reduced_modulus_mpa.powf(0.25) * 1e3f64.sqrt() / (1e-3 * self.thermal_contact_w_s05_per_m2_k);
        let x_alpha_beta = 1.22 * (wt.sin() * wn.cos()).powf(0.25) / (wt.cos() * t.cos()).sqrt();
        x_m * x_alpha_beta * self.tangential_load_n_per_mm.powf(0.75) * self.circumferential_speed_m_per_s.sqrt()
            / self.centre_distance_mm.powf(0.25)
    }

    /// θ_fl at Γ with the part X_Γ of the load, K.
    pub fn flash_k(&self, gamma: f64, load_sharing_factor: f64, friction_coefficient: f64) -> f64 {
        let u = self.gear_ratio;
        let x_g = 0.51 * (u + 1.0).sqrt() * ((1.0 + gamma).sqrt() - (1.0 - gamma / u).sqrt()).abs()
            / ((1.0 + gamma) * (u - gamma)).powf(0.25);
        friction_coefficient * self.common_k() * x_g * load_sharing_factor.powf(0.75)
    }

    /// θ_flaE X_Q X_Ca/X_E, at the pinion's tip under the whole load, K; ρ_E1 and ρ_E2 in mm.
    pub fn flash_at_tip_k(&self, radii_mm: [f64; 2], friction_coefficient: f64) -> f64 {
        let (u, [rho_1, rho_2]) = (self.gear_ratio, radii_mm);
        let x_be = 0.51 * (u + 1.0).sqrt() * (rho_1.sqrt() - (rho_2 / u).sqrt()).abs() / (rho_1 * rho_2).powf(0.25);
        let helical = self.helical_load_factor.powf(0.75);
        friction_coefficient * self.common_k() * helical * x_be
    }
}

/// Torque on the pinion in the load stages 1 to 12 of the FZG test, N·m (ISO 14635-1).
const FZG_TORQUE_N_M: [f64; 12] = [3.3, 13.7, 35.3, 60.8, 94.1, 135.3, 183.4, 239.3, 302.0, 372.6, 450.1, 534.5];
/// T_1T/S² beyond the last stage, N·m.
const FZG_TORQUE_PER_STAGE_SQUARED_N_M: f64 = 3.726;

/// T_1T of a load stage, N·m.
fn fzg_torque_n_m(load_stage: u32) -> f64 {
    let listed = usize::try_from(load_stage).ok().and_then(|stage| FZG_TORQUE_N_M.get(stage.checked_sub(1)?));
    listed.copied().unwrap_or(FZG_TORQUE_PER_STAGE_SQUARED_N_M * f64::from(load_stage).powi(2))
}

/// θ_S of ISO/TS 6336-20, °C.
pub fn scuffing_temperature_c(load_stage: u32, structural_factor: f64, lubricant_factor: f64) -> f64 {
    80.0 + (0.85 + 1.4 * structural_factor) * lubricant_factor * f64::from(load_stage).powi(2)
}

/// θ_intS of ISO/TS 6336-21, °C; ν₄₀ in mm²/s.
pub fn integral_scuffing_temperature_c(
    load_stage: u32,
    structural_factor: f64,
    lubricant_factor: f64,
    viscosity_40c_mm2_per_s: f64,
) -> f64 {
    let torque = fzg_torque_n_m(load_stage) * lubricant_factor;
    let flash_k = 0.2 * torque * (100.0 / viscosity_40c_mm2_per_s).powf(0.02);
    80.0 + 0.23 * torque + 1.5 * structural_factor * flash_k
}

/// X_J at Γ between Γ_A and Γ_E, where C_eff − C_a of the driven gear is `deflection_um`.
pub fn flash_approach_factor(deflection_um: f64, gamma: f64, [gamma_a, gamma_e]: [f64; 2]) -> f64 {
    let before = (-gamma / (gamma_e - gamma_a)).max(0.0);
    1.0 + (deflection_um / 50.0 * before.powi(3)).max(0.0)
}

/// X_E of flanks with φ_E, Ra in µm, ρ_C in mm.
pub fn run_in_factor(relative_run_in: f64, ra_um: f64, relative_radius_mm: f64) -> f64 {
    1.0 + (1.0 - relative_run_in) * 30.0 * ra_um / relative_radius_mm
}

/// X_ε for the contact ratios after and before C, ε₁ and ε₂; ε_α from 1 to 3.
pub fn contact_ratio_factor(after: f64, before: f64) -> f64 {
    let (e1, e2) = (after, before);
    let e = e1 + e2;
    let squares = e1 * e1 + e2 * e2;
    let bracket = if e < 1.0 {
        return squares / (2.0 * e1 * e);
    } else if e < 2.0 {
        match (e1 < 1.0, e2 < 1.0) {
            (true, true) => 0.70 * squares - 0.22 * e + 0.52 - 0.60 * e1 * e2,
            (false, _) => 0.18 * e1 * e1 + 0.70 * e2 * e2 + 0.82 * e1 - 0.52 * e2 - 0.30 * e1 * e2,
            (true, false) => 0.70 * e1 * e1 + 0.18 * e2 * e2 - 0.52 * e1 + 0.82 * e2 - 0.30 * e1 * e2,
        }
    } else if e1 >= e2 {
        return (0.44 * e1 * e1 + 0.59 * e2 * e2 + 0.30 * e1 - 0.30 * e2 - 0.15 * e1 * e2) / (2.0 * e * e1);
    } else {
        return (0.59 * e1 * e1 + 0.44 * e2 * e2 - 0.30 * e1 + 0.30 * e2 - 0.15 * e1 * e2) / (2.0 * e * e1);
    };
    bracket / (2.0 * e * e1)
}

/// X_Ca for a relief C_a over C_eff and the greater of ε₁ and ε₂.
pub fn tip_relief_factor(relief_over_effective: f64, greater_contact_ratio: f64) -> f64 {
    let (c, e) = (relief_over_effective.clamp(0.0, 1.0), greater_contact_ratio);
    1.0 + (0.06 + 0.18 * c) * e + (0.02 + 0.69 * c) * e * e
}

/// X_Q: the part of the path before C over that after it, from which side the teeth approach.
pub fn approach_factor(before: f64, after: f64) -> f64 {
    let ratio = before / after;
    if ratio <= 1.5 {
        1.0
    } else if ratio < 3.0 {
        1.4 - 4.0 / 15.0 * ratio
    } else {
        0.6
    }
}

/// K_Bγ: load that friction of helical gears takes up, of ε_γ.
pub fn helical_load_factor(total_contact_ratio: f64) -> f64 {
    let e = total_contact_ratio;
    if e <= 2.0 {
        1.0
    } else if e < 3.5 {
        1.0 + 0.2 * ((e - 2.0) * (5.0 - e)).sqrt()
    } else {
        1.3
    }
}
