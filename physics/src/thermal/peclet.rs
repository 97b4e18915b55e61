//! The Peclet number: how fast a band of heat moves against how fast heat spreads.
//!
//! ```text
//! Pe = a U/(2κ)
//! ```
//!
//! with the half-width a of the band. Above about 5 heat has no time to flow sideways, below about 0.1 it has no time to be left
//! behind.
//!
//! Source: the thesis, section 3.6; K. L. Johnson, *Contact Mechanics* (1985), section 12.2.

/// Pe.
pub(crate) fn peclet(half_width_mm: f64, velocity_mm_per_s: f64, diffusivity_mm2_per_s: f64) -> f64 {
    half_width_mm * velocity_mm_per_s / (2.0 * diffusivity_mm2_per_s)
}
