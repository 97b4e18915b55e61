//! Ohlendorf's loss factor of a pair, and what it means.
//!
//! ```text
//! H_V = π (u + 1) / (z₁ u cos β_b) · (1 − ε_α + ε₁² + ε₂²)
//! ```
//!
//! ε₁ and ε₂ are the parts of the transverse contact ratio after and before C. With the same coefficient of friction everywhere and the
//! load shared by halves where two pairs are in mesh, the mean loss is P μ H_V. With the loads F of a contact analysis it is
//!
//! ```text
//! H_VL = 1/p_bt ∫ F/F_bt · v_g/(r_b ω) dx        over A–E
//! ```
//!
//! (Wimmer), which the pipeline sums up over the run's own loads.
//!
//! Sources: H. Ohlendorf, dissertation, Munich 1958, as in ISO/TR 14179-2; A. Wimmer, dissertation, Munich 2006.

use std::f64::consts::PI;

use crate::gear::{Gear, GearPair};

/// H_V of a pair.
pub fn of_pair(pair: &GearPair) -> f64 {
    let teeth = Gear::BOTH.map(|gear| pair.spec.gears[gear].teeth);
    ohlendorf(teeth, pair.base_helix_angle_rad(), contact_ratios(pair))
}

/// ε₁ after C and ε₂ before it.
pub fn contact_ratios(pair: &GearPair) -> [f64; 2] {
    let path = &pair.path;
    [path.end_mm - path.pitch_point_mm, path.pitch_point_mm - path.start_mm].map(|length| length / path.base_pitch_mm)
}

/// H_V.
fn ohlendorf(teeth: [u32; 2], base_helix_angle_rad: f64, after_and_before_pitch_point: [f64; 2]) -> f64 {
    let [z1, z2] = teeth.map(f64::from);
    let [after, before] = after_and_before_pitch_point;
    // (u + 1)/(z₁ u) is 1/z₁ + 1/z₂.
    PI * (1.0 / z1 + 1.0 / z2) / base_helix_angle_rad.cos() * (1.0 - before - after + before.powi(2) + after.powi(2))
}
