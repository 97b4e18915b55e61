//! Places of the teeth at a position.
//!
//! The pinion's axis is the origin and the wheel's lies on +y at the centre distance. With the theoretical contact point of
//! the reference pair at ξ (ρ1 = ξ, ρ2 = T1T2 − ξ), tooth j stands at the angle, from +y anticlockwise,
//!
//! ```text
//! pinion   ξ/r_b1 − ψ_b1 − α_w + 2πj/z1            wheel   π + ρ2/r_b2 − ψ_b2 − α_w − 2πj/z2
//! ```
//!
//! with negative a, r_b2, ρ2, ψ_b2 and z2 of an internal wheel. ψ_b: half the tooth's angle on the base circle. Pair j = +1 is a base pitch ahead of the reference pair.

use std::f64::consts::{PI, TAU};

use nalgebra::{Rotation2, Vector2};

use crate::gear::{Gear, GearPair};
use crate::gear_mesh::turn_rad;

/// Angle of the centre line of tooth `tooth` of a gear from +y, anticlockwise.
pub fn tooth_angle_rad(pair: &GearPair, gear: Gear, position_mm: f64, tooth: i32) -> f64 {
    let pitches = TAU * f64::from(tooth) / pair.teeth[gear].z();
    let angle = turn_rad(pair, gear, position_mm);
    match gear {
        Gear::Pinion => angle + pitches,
        Gear::Wheel => PI + angle - pitches,
    }
}

/// Axis of a gear.
pub fn axis_mm(pair: &GearPair, gear: Gear) -> Vector2<f64> {
    match gear {
        Gear::Pinion => Vector2::zeros(),
        Gear::Wheel => Vector2::new(0.0, pair.spec.centre_distance_mm),
    }
}

/// Place at `position_mm` of a point given in the own frame of tooth `tooth`.
pub fn in_place_mm(pair: &GearPair, gear: Gear, position_mm: f64, tooth: i32, point_mm: Vector2<f64>) -> Vector2<f64> {
    Rotation2::new(tooth_angle_rad(pair, gear, position_mm, tooth)) * point_mm + axis_mm(pair, gear)
}
