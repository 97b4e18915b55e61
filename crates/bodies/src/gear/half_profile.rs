//! Half-thickness of a tooth over the height of its centre line, for beam and plate models.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Rotation2, Vector2};

use super::tooth::Tooth;

/// Point of the space's frame (space centre line +y, clockwise side) in the tooth's: (half-thickness, height from the axis).
pub fn in_tooth_frame(tooth: &Tooth, point: Vector2<f64>) -> Vector2<f64> {
    let turned = Rotation2::new(PI / tooth.z()) * point;
    Vector2::new(-turned.x, turned.y)
}

/// Half-thickness and increasing height of the profile (negative on an internal gear, whose axis is above its teeth) from the root circle to the tip, with `samples` on fillet and flank each; mm.
pub fn half_profile(tooth: &Tooth, samples: usize) -> Vec<Vector2<f64>> {
    let fillet = (0..=samples).map(|k| {
        let t = FRAC_PI_2 + (tooth.fillet_end_angle_rad - FRAC_PI_2) * k as f64 / samples as f64;
        in_tooth_frame(tooth, tooth.trochoid.point_mm(t))
    });
    let (form, tip) = (tooth.root_form_radius_mm, tooth.tip_radius_mm);
    let flank = (1..=samples).map(|k| {
        let radius = form + (tip - form) * k as f64 / samples as f64;
        let half_angle = tooth.half_angle_rad(radius);
        Vector2::new(radius * half_angle.sin(), radius * half_angle.cos())
    });
    let mut profile: Vec<Vector2<f64>> = Vec::with_capacity(2 * samples + 1);
    for point in fillet.chain(flank) {
        if profile.last().is_none_or(|before| point.y > before.y) {
            profile.push(point);
        }
    }
    profile
}
