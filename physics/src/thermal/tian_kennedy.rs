//! Tian and Kennedy's greatest temperature under an even band of heat.
//!
//! ```text
//! T_max = 2 a q/(K √(π (1 + Pe)))        Pe = a U/(2κ)
//! ```
//!
//! For Pe → ∞ this is Williams's temperature at the rear of the band. For slow bands it stays finite, where the steady state of an
//! endless band grows as −ln Pe: it is a fit between both that is meant for Peclet numbers of contacts.
//!
//! Source: X. Tian and F. E. Kennedy, *J. Tribology* 116 (1994) 167; the thesis, equation 29.

use super::peclet::peclet;
use super::settings::ThermalMaterial;

/// Greatest rise under the flux q in N/(mm·s) (MPa·mm/s), K.
pub fn greatest_rise_k(flux: f64, half_width_mm: f64, velocity_mm_per_s: f64, material: &ThermalMaterial) -> f64 {
    let pe = peclet(half_width_mm, velocity_mm_per_s, material.diffusivity_mm2_per_s);
    2.0 * half_width_mm * flux / (material.conductivity_n_per_s_k * (std::f64::consts::PI * (1.0 + pe)).sqrt())
}
