//! Ohlendorf's loss factor of a pair.
//!
//! With x the distance of the contact from C in transverse base pitches and n(x) the number of pairs in mesh, which share the load evenly,
//!
//! ```text
//! H_V = 2π (u + 1) / (z₁ u cos β_b) · ∫ |x|/n(x) dx        from −ε₂ to ε₁
//!     = π (u + 1) / (z₁ u cos β_b) · (1 − ε_α + ε₁² + ε₂²)   for ε₁ ≤ 1, ε₂ ≤ 1, ε_α from 1 to 2, Ohlendorf's
//! ```
//!
//! ε₁ and ε₂ are the parts of the transverse contact ratio after and before C. Ohlendorf's closed form is that of C between B and D; the
//! integral holds for any contact ratio, and is what is computed. With the same coefficient of friction everywhere the mean loss is P μ H_V. With
//! the loads F of a contact analysis it is
//!
//! ```text
//! H_VL = 1/p_bt ∫ F/F_bt · v_g/(r_b ω) dx        over A–E
//! ```
//!
//! (Wimmer), which an assessment sums up over the run's own loads.
//!
//! Sources: H. Ohlendorf, dissertation, Munich 1958, as in ISO/TR 14179-2; A. Wimmer, dissertation, Munich 2006.

use std::f64::consts::PI;

use gearwear_bodies::gear::{Gear, GearPair};

/// H_V of a pair.
pub fn of_pair(pair: &GearPair) -> f64 {
    let teeth = Gear::BOTH.map(|gear| pair.spec.gears[gear].z());
    ohlendorf(teeth, pair.base_helix_angle_rad(), contact_ratios(pair))
}

/// ε₁ after C and ε₂ before it.
pub fn contact_ratios(pair: &GearPair) -> [f64; 2] {
    let path = &pair.path;
    [path.end_mm - path.pitch_point_mm, path.pitch_point_mm - path.start_mm].map(|length| length / path.base_pitch_mm)
}

/// H_V.
fn ohlendorf([z1, z2]: [f64; 2], base_helix_angle_rad: f64, after_and_before_pitch_point: [f64; 2]) -> f64 {
    // (u + 1)/(z₁ u) is 1/z₁ + 1/z₂, with z₂ < 0 of an internal pair.
    2.0 * PI * (1.0 / z1 + 1.0 / z2) / base_helix_angle_rad.cos() * evenly_shared_sliding(after_and_before_pitch_point)
}

/// Pairs in mesh where one of them is `from_pitch_point` base pitches after C.
pub(super) fn pairs_in_mesh([after, before]: [f64; 2], from_pitch_point: f64) -> f64 {
    (after - from_pitch_point).floor() + (from_pitch_point + before).floor() + 1.0
}

/// ∫ |x|/n(x) dx.
fn evenly_shared_sliding(after_and_before: [f64; 2]) -> f64 {
    let [after, before] = after_and_before;
    // n changes where another pair enters at A or leaves at E, the sign of x at C.
    let mut ends = vec![-before, after, 0.0_f64.clamp(-before, after)];
    let whole = (after + before).floor() as u32;
    ends.extend((1..=whole).flat_map(|pitches| [after - f64::from(pitches), f64::from(pitches) - before]));
    ends.sort_by(f64::total_cmp);
    ends.windows(2)
        .map(|two| {
            let (low, high) = (two[0], two[1]);
            let middle = 0.5 * (low + high);
            (high - low) * middle.abs() / pairs_in_mesh(after_and_before, middle)
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ohlendorf's closed form from ε_α = 1 to 2 with C between B and D.
    #[test]
    fn ver_the_integral_is_ohlendorfs_closed_form() {
        for [after, before] in [[0.72, 0.71], [0.9, 0.35], [0.31, 0.99], [0.5, 0.5]] {
            let closed = 0.5 * (1.0 - after - before + after * after + before * before);
            assert!((evenly_shared_sliding([after, before]) - closed).abs() < 1e-14, "{after} {before}");
        }
    }

    /// By hand: ε₁ = 1.3, ε₂ = 1.1: three pairs from −1.1 to −0.7, −0.1 to 0.3 and 0.9 to 1.3, two between.
    #[test]
    fn ver_three_pairs_share_the_load() {
        let three = (1.1 * 1.1 - 0.7 * 0.7 + 0.1 * 0.1 + 0.3 * 0.3 + 1.3 * 1.3 - 0.9 * 0.9) / 2.0 / 3.0;
        let two = (0.7 * 0.7 - 0.1 * 0.1 + 0.9 * 0.9 - 0.3 * 0.3) / 2.0 / 2.0;
        assert!((evenly_shared_sliding([1.3, 1.1]) - (three + two)).abs() < 1e-14);
        // By hand: ε₁ = 1.2, ε₂ = 0.2, C beside the stretch of a single pair from 0.2 to 0.8.
        let one = (0.8 * 0.8 - 0.2 * 0.2) / 2.0;
        let halves = (0.2 * 0.2 + 0.2 * 0.2 + 1.2 * 1.2 - 0.8 * 0.8) / 2.0 / 2.0;
        assert!((evenly_shared_sliding([1.2, 0.2]) - (one + halves)).abs() < 1e-14);
    }
}
