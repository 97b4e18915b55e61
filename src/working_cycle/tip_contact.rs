//! How far before A and after E a tooth pair may touch.
//!
//! Under load the pairs in mesh yield, the gears approach each other by the transmission error δ, and the next pair touches
//! before its theoretical contact point has reached A: at its mate's tip edge, beside the line of action. After E the same
//! happens at the pinion's tip edge. With the theoretical contact point a distance s before A, the tangent frame of that
//! place still holds both involutes; only the wheel's flank begins at its tip edge, at
//!
//! ```text
//! along  ≈ s ρ₂/r_b2          gap there ≈ along²/(2R)          contact where the gap < δ
//! ```
//!
//! so that contact at a tip edge needs no model of its own: it is contact at the end of the strip, with the true gap, tip
//! rounding, relief and wear included. The contact's normal is taken to be the line of action, which it leaves by the angle
//! along/ρ (0.1 rad at 1 mm of path before A of an FZG pair). For the load that counts with the cosine and with the lever
//! r_b + along instead of r_b, some hundredths at most; for sliding, the component along the tangent is (ω₁ + ω₂)(C − ξ) at
//! every place of the frame, and that along the turned flank differs from it by along²/(ρ (C − ξ)) − ½ (along/ρ)², less than
//! one hundredth.
//!
//! Source: R. G. Munro, L. Morrish and D. Palmer, "Gear transmission error outside the normal path of contact due to corner
//! and top contact", *Proc. Inst. Mech. Eng. C* 213 (1999) 389–400, for the phenomenon.

use crate::gear::{Gear, GearPair, conjugate::ConjugateFlanks};

/// Greatest part of a base pitch looked at on either side.
const MOST_BASE_PITCHES: f64 = 0.3;
/// Least distance from T1 and T2, as part of the curvature at A and E.
const LEAST_CURVATURE: f64 = 0.05;
/// Steps in which the path is walked, per base pitch.
const STEPS_IN_PITCH: f64 = 1000.0;

/// How far before A and after E the tip edges of unworn, unmodified flanks are nearer to the mate than `approach_mm`, mm of
/// path.
pub fn reach_mm(pair: &GearPair, approach_mm: f64) -> [f64; 2] {
    let path = &pair.path;
    let most = MOST_BASE_PITCHES * path.base_pitch_mm;
    let ends = [(Gear::Wheel, path.start_mm, -1.0), (Gear::Pinion, path.end_mm, 1.0)];
    ends.map(|(tip_of, end_mm, outwards)| {
        let room = (1.0 - LEAST_CURVATURE) * path.rho_mm(tip_of.mate(), end_mm);
        let step = path.base_pitch_mm / STEPS_IN_PITCH;
        let steps = (most.min(room) / step) as usize;
        let touches = |k: &usize| tip_gap_mm(pair, tip_of, end_mm + outwards * *k as f64 * step) <= approach_mm;
        (1..=steps).take_while(touches).last().unwrap_or(0) as f64 * step
    })
}

/// Gap between the tip edge of a gear and its mate's flank, along the line of action, with the theoretical contact point at
/// `position_mm`.
fn tip_gap_mm(pair: &GearPair, tip_of: Gear, position_mm: f64) -> f64 {
    let (_, tip_rho) = pair.flank_limits_mm(tip_of);
    let edge = pair.in_tangent_frame(tip_of, tip_rho, position_mm);
    edge.drop_mm + pair.at_along(tip_of.mate(), -edge.along_mm, position_mm).1
}
