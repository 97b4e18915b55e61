//! Williams's temperature of a fast band of heat.
//!
//! Where the band moves so fast that heat flows only perpendicular to the surface, the surface of a half-space under the constant
//! flux q is at 2 q/K √(κ t/π) after the time t. A point at x, with the band from −a (where it enters) to a, has been under it for
//! t = (x + a)/U:
//!
//! ```text
//! T(x) = 2 q/K · √(κ (x + a)/(π U))
//! ```
//!
//! Equation 27 of the thesis prints this garbled: its factor a in front has the wrong dimension, and the root has lost its 2
//! and part of its denominator. The form above is the limit of Jaeger's band for Pe → ∞, which is what the thesis says its
//! equation is; Williams gives it for Pe above 5.
//!
//! Source: J. A. Williams, *Engineering Tribology* (1994), p. 126–129; the thesis, equation 27.

use super::settings::ThermalMaterial;

/// Rise of the surface at `from_inlet_mm` (x + a) under the flux q in N/(mm·s) (MPa·mm/s), K.
pub fn rise_k(flux: f64, from_inlet_mm: f64, velocity_mm_per_s: f64, material: &ThermalMaterial) -> f64 {
    let under_it_s = from_inlet_mm / velocity_mm_per_s;
    2.0 * flux / material.conductivity_n_per_s_k
        * (material.diffusivity_mm2_per_s * under_it_s / std::f64::consts::PI).sqrt()
}
