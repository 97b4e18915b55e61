//! Two surfaces that roll and slide on each other along a line: the contact of film and friction formulas.
//!
//! ```text
//! E_r = 2 / [(1−ν₁²)/E₁ + (1−ν₂²)/E₂]      v_Σ = v₁ + v₂      v_g = |v₁ − v₂|
//! ```
//!
//! The relative radius of curvature and the load are those of the section perpendicular to the line of contact: ρ_n = ρ_t/cos β_b, and
//! the load per mm of that line.

use std::f64::consts::PI;

use gearwear_bodies::gear::PerGear;

/// A contact along a line under load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingContact {
    /// w, N per mm of the line of contact.
    pub line_load_n_per_mm: f64,
    /// ρ_n, mm.
    pub relative_radius_mm: f64,
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Speed of each surface through the contact, m/s.
    pub surface_speeds_m_per_s: PerGear<f64>,
}

impl RollingContact {
    /// v_Σ, m/s.
    pub fn sum_speed_m_per_s(&self) -> f64 {
        self.surface_speeds_m_per_s.sum()
    }

    /// v_g/(v_Σ/2).
    pub fn slide_to_roll_ratio(&self) -> f64 {
        self.sliding_speed_m_per_s() / (0.5 * self.sum_speed_m_per_s())
    }

    /// v_g, m/s.
    pub fn sliding_speed_m_per_s(&self) -> f64 {
        (self.surface_speeds_m_per_s.pinion - self.surface_speeds_m_per_s.wheel).abs()
    }
}

/// The bodies behind the surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingBodies {
    /// E_r, MPa.
    pub reduced_modulus_mpa: f64,
    /// B_M of each, W·√s/(m²·K).
    pub thermal_contact_w_s05_per_m2_k: PerGear<f64>,
}

impl RollingBodies {
    /// Hertz's greatest pressure under the load of a contact, MPa.
    pub fn peak_pressure_mpa(&self, contact: &RollingContact) -> f64 {
        let radius_mm = contact.relative_radius_mm;
        (self.reduced_modulus_mpa * contact.line_load_n_per_mm / (2.0 * PI * radius_mm)).sqrt()
    }
}
