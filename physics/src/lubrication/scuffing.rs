//! Scuffing: flash temperature and integral temperature, as figures.
//!
//! With w_Bt = K F_t/b, Γ the place on the line of action from C in units of T₁C, X_M = E_r^¼ √1000/B_M and
//! X_αβ = 1.22 sin^¼ α_wt cos^¼ α_wn / √(cos α_wt cos α_t),
//!
//! ```text
//! flash      θ_fl = μ X_M X_G X_αβ (X_Γ w_Bt)^¾ √v / a^¼
//!            X_G  = 0.51 √(u+1) |√(1+Γ) − √(1−Γ/u)| / [(1+Γ)^¼ (u−Γ)^¼]
//!            θ_M  = θ_oil + 0.47 X_S mean θ_fl          θ_B = θ_M + greatest θ_fl
//!
//! integral   θ_flaE = μ X_M X_BE X_αβ (K_Bγ w_Bt)^¾ √v / a^¼ · 1/(X_Q X_Ca)
//!            X_BE = 0.51 √(u+1) (√ρ_E1 − √(ρ_E2/u)) / (ρ_E1 ρ_E2)^¼
//!            θ_int = θ_oil + 0.7 X_S θ_flaE X_ε + 1.5 θ_flaE X_ε
//! ```
//!
//! The flash temperature has no K_Bγ, nor has its friction; its approach factor X_J is left at 1. μ is the mean value of each standard, X_ε a sum
//! over ε₁ and ε₂ ([`contact_ratio_factor`]), X_Q = 1 up to ε before C of 1.5 times that after it, falling to 0.6 at 3 times, and
//! with C_a of the relief and C_eff = K_A F_t/(b c_γα)
//!
//! ```text
//! X_Ca = 1 + (0.06 + 0.18 C_a/C_eff) ε_max + (0.02 + 0.69 C_a/C_eff) ε_max²        C_a ≤ C_eff
//! ```
//!
//! The safeties of the standards also need the oil's scuffing temperature of a test, which is no part of a
//! scene; figures here are temperatures.
//!
//! Sources: ISO/TS 6336-20 and -21 (first ISO/TR 13989-1 and -2:2000), clauses 8 to 10.

/// What both temperatures are made of.
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

    /// θ_flaE, at the pinion's tip under the whole load, K; ρ_E1 and ρ_E2 in mm, X_Q X_Ca.
    pub fn flash_at_tip_k(&self, radii_mm: [f64; 2], relief_and_approach: f64, friction_coefficient: f64) -> f64 {
        let (u, [rho_1, rho_2]) = (self.gear_ratio, radii_mm);
        let x_be = 0.51 * (u + 1.0).sqrt() * (rho_1.sqrt() - (rho_2 / u).sqrt()).abs() / (rho_1 * rho_2).powf(0.25);
        let helical = self.helical_load_factor.powf(0.75);
        friction_coefficient * self.common_k() * helical * x_be / relief_and_approach
    }
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
