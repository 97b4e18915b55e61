//! The local lubricant film thickness of ISO/TS 6336-22, and its flash temperature.
//!
//! At a point of the path with the greatest pressure p (load factors included), ρ_n and v_Σ,
//!
//! ```text
//! θ_fl = √π/2 · μ p |v₁ − v₂| / (B₁ √v₁ + B₂ √v₂) · √(8 ρ_n p / E_r)          θ_B = θ_M + θ_fl
//! G = α(θ_M) E_r    U = η(θ_M) v_Σ / (2 E_r ρ_n)    W = 2π p² / E_r²    S = α(θ_B) η(θ_B) / (α(θ_M) η(θ_M))
//! h = 1.6 ρ_n G^0.6 U^0.7 W^−0.13 S^0.22
//! λ_GF = h / Ra,     Ra = (Ra₁ + Ra₂)/2
//! ```
//!
//! with the temperature of the teeth
//!
//! ```text
//! θ_M = θ_oil + 7400 (P_VZ/(a b))^0.72 X_S/1.2        P_VZ = P μ_m H_V in kW, a and b in mm; gears without tip relief
//! ```
//!
//! Source: ISO/TS 6336-22 (first ISO/TR 15144-1:2014), clauses 6 and 7; Method B takes p from a load sharing factor
//! ([`super::load_sharing_factor`]), Method A from a contact analysis, which here is the contact of the run. p has no cos β_b in its
//! load: what reports of commercial programs print is reproduced so.

use std::f64::consts::PI;

use super::oil::Oil;
use super::rolling_contact::{RollingBodies, RollingContact};

/// Film and temperature at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalFilm {
    /// θ_fl, K.
    pub flash_k: f64,
    /// h, µm.
    pub thickness_um: f64,
}

/// Bulk temperature of the teeth θ_M, °C.
pub fn bulk_temperature_c(
    oil_temperature_c: f64,
    loss_kw: f64,
    centre_distance_mm: f64,
    face_width_mm: f64,
    supply_factor: f64,
) -> f64 {
    oil_temperature_c + 7400.0 * (loss_kw / (centre_distance_mm * face_width_mm)).powf(0.72) * supply_factor / 1.2
}

/// Flash temperature and film where teeth of θ_M touch with the coefficient of friction μ; none where they carry no load.
pub fn local_film(
    contact: &RollingContact,
    bodies: &RollingBodies,
    oil: &Oil,
    bulk_temperature_c: f64,
    friction_coefficient: f64,
) -> Option<LocalFilm> {
    if contact.peak_pressure_mpa <= 0.0 {
        return None;
    }
    let (p, e_r, rho) = (contact.peak_pressure_mpa, bodies.reduced_modulus_mpa, contact.relative_radius_mm);
    let (v, b_m) = (contact.surface_speeds_m_per_s, bodies.thermal_contact_w_s05_per_m2_k);
    // The width 8 ρ p/E_r is in mm, the speeds are in m/s.
    let flash_k = 0.5 * PI.sqrt() * friction_coefficient * p * 1e6 * contact.sliding_speed_m_per_s()
        / (b_m.pinion * v.pinion.sqrt() + b_m.wheel * v.wheel.sqrt())
        * (8.0 * rho * p / (1e3 * e_r)).sqrt();
    let [(eta, alpha), (contact_eta, contact_alpha)] = [bulk_temperature_c, bulk_temperature_c + flash_k]
        .map(|celsius| (oil.viscosity_milli_pa_s(celsius), oil.pressure_viscosity_per_gpa(celsius)));
    let material = 1e-3 * alpha * e_r;
    let speed = 1e-6 * eta * contact.sum_speed_m_per_s() / (2.0 * e_r * rho);
    let load = 2.0 * PI * (p / e_r).powi(2);
    let at_bulk = alpha * eta;
    if at_bulk <= 0.0 {
        return Some(LocalFilm { flash_k, thickness_um: 0.0 });
    }
    let sliding = contact_alpha * contact_eta / at_bulk;
    let thickness_um = 1600.0 * rho * material.powf(0.6) * speed.powf(0.7) * load.powf(-0.13) * sliding.powf(0.22);
    Some(LocalFilm { flash_k, thickness_um })
}
