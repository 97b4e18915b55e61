//! Material removed from the nominal involute along its normal.
//!
//! Modifications and wear are one field over the flank, from which all contact models calculate. By radius of curvature ρ, in roll length along
//! the path of contact:
//!
//! ```text
//! relief        C (u/L)ⁿ       u: roll length from its beginning, L: its whole length, n = 1 linear, 2 parabolic
//! crowning      C_α (2v)²      v: roll length from the middle of the active profile over its whole length
//! profile slope f (½ − v)      f > 0; |f| (½ + v) where f < 0; constant beyond the ends
//! tip rounding  ρ_k − √(ρ_k² − d²)   d: distance along the flank from the beginning of the rounding of radius ρ_k
//! tip chamfer   ρ_k (1 − cos γ) + (d − ρ_k sin γ) tan γ      beyond d = ρ_k sin γ; γ: turn at its edge ([`super::tip_chamfer`])
//! ```
//!
//! and by z over the face width b:
//!
//! ```text
//! lead crowning  C_β (2z/b − 1)²
//! end relief     C (u/L)ⁿ         u: distance from its beginning, towards either end face
//! helix slope    f z/b            f > 0; |f| (1 − z/b) where f < 0: removed material is not negative
//! ```
//!
//! Amounts are those of a drawing, along the transverse line of action (ISO 1328-1:2013); along the normal of a helical flank
//! they are multiplied by cos β_b ([`super::normal_section`]).
//!
//! Axes that are not parallel are a helix slope of the pinion, f_Σδ sin α_wt + f_Σβ cos α_wt.
//!
//! Source: ISO 21771-1, profile and helix modifications; ISO/TR 10064-3 for the axes; the rounding is the circle tangent to flank and
//! tip circle or chamfer, with the flank straight next to the edge.

use super::{
    Gear, GearPair,
    flank::FlankGrid,
    modification::{Modification, Relief, ReliefShape},
    slices::Slices,
    tooth::Tooth,
};

/// Number of places over the face width for a mean.
const PLACES_OVER_WIDTH: usize = 100;

/// Material removed by modifications at the points of a gear's flank, normal to it, slice by slice, mm.
pub fn modifications_mm(pair: &GearPair, gear: Gear, grid: &FlankGrid, slices: &Slices) -> Vec<f64> {
    let modification = with_axes(pair, gear);
    let profile: Vec<f64> = grid.coordinate_mm.iter().map(|&rho| whole_profile_mm(pair, gear, rho)).collect();
    let over_width = slices.width_mm.iter().map(|&z| lead_removed_mm(&modification, pair.spec.face_width_mm, z));
    let obliquity = pair.obliquity();
    over_width.flat_map(|lead| profile.iter().map(move |removed| obliquity.normal_mm(removed + lead))).collect()
}

/// Material missing at these radii by what a measured flank deviates from its design profile, normal to it, mm.
pub fn measured_flank_mm(pair: &GearPair, gear: Gear, radii_mm: impl Iterator<Item = f64>) -> Vec<f64> {
    let (involute, obliquity) = (pair.teeth[gear].involute, pair.obliquity());
    radii_mm
        .map(|radius| obliquity.normal_mm(of_measurement_mm(pair, gear, involute.curvature_radius_mm(radius))))
        .collect()
}

/// Modification of a gear's flank with the helix slope of axes that are not parallel.
fn with_axes(pair: &GearPair, gear: Gear) -> Modification {
    let own = pair.spec.gears[gear].modification;
    let of_axes_mm = if gear == Gear::Pinion { pair.slope_of_axes_mm() } else { 0.0 };
    Modification { helix_slope_mm: own.helix_slope_mm + of_axes_mm, ..own }
}

/// Material removed at radius of curvature `rho_mm` and `width_mm` by all modifications except rounding and chamfer of the tip edge, along the
/// transverse line of action, mm.
pub fn without_tip_edge_mm(pair: &GearPair, gear: Gear, width_mm: f64, rho_mm: f64) -> f64 {
    of_profile_mm(pair, gear, rho_mm) + lead_removed_mm(&with_axes(pair, gear), pair.spec.face_width_mm, width_mm)
}

/// Material removed from the profile except at the tip edge, along the transverse line of action, mm.
pub(crate) fn of_profile_mm(pair: &GearPair, gear: Gear, rho_mm: f64) -> f64 {
    let modification = &pair.spec.gears[gear].modification;
    let removed_mm = removed_mm(modification, &pair.teeth[gear], pair.active_start_rho_mm(gear), rho_mm);
    removed_mm + of_measurement_mm(pair, gear, rho_mm)
}

/// Material removed from the profile at radius of curvature `rho_mm`: by its modifications, at its tip edge, and what a measured flank deviates
/// from them, along the transverse line of action, mm.
pub fn whole_profile_mm(pair: &GearPair, gear: Gear, rho_mm: f64) -> f64 {
    let rounding_mm = pair.spec.gears[gear].modification.tip_rounding_mm;
    of_profile_mm(pair, gear, rho_mm) + tip_edge_mm(rounding_mm, &pair.teeth[gear], rho_mm)
}

fn of_measurement_mm(pair: &GearPair, gear: Gear, rho_mm: f64) -> f64 {
    pair.spec.gears[gear].measured_flank.as_ref().map_or(0.0, |flank| flank.removed_mm(rho_mm))
}

/// Mean over the face width of the material removed by helix modifications, along the transverse line of action, mm.
pub(crate) fn mean_over_width_mm(pair: &GearPair, gear: Gear) -> f64 {
    let (modification, face_width_mm) = (with_axes(pair, gear), pair.spec.face_width_mm);
    let places_mm = (0..PLACES_OVER_WIDTH).map(|k| (k as f64 + 0.5) / PLACES_OVER_WIDTH as f64 * face_width_mm);
    let removed = places_mm.map(|width_mm| lead_removed_mm(&modification, face_width_mm, width_mm));
    removed.sum::<f64>() / PLACES_OVER_WIDTH as f64
}

/// Material removed at `width_mm` of the face width by helix modifications alone.
pub fn lead_removed_mm(modification: &Modification, face_width_mm: f64, width_mm: f64) -> f64 {
    let along = width_mm / face_width_mm;
    let crowning = modification.lead_crowning_mm * (2.0 * along - 1.0).powi(2);
    let end = modification.end_relief.map_or(0.0, |end| {
        let from_end_mm = width_mm.min(face_width_mm - width_mm);
        let relief = Relief { amount_mm: end.amount_mm, length_mm: end.length_mm, shape: end.shape };
        relief_mm(relief, end.length_mm - from_end_mm)
    });
    let slope = modification.helix_slope_mm;
    crowning + end + if slope >= 0.0 { slope * along } else { -slope * (1.0 - along) }
}

/// Material removed by profile modifications at radius of curvature `rho_mm` of `tooth`, whose active profile begins at `active_start_rho_mm`;
/// without rounding and chamfer of the tip edge.
pub fn removed_mm(modification: &Modification, tooth: &Tooth, active_start_rho_mm: f64, rho_mm: f64) -> f64 {
    let edge_rho = tooth.edge_rho_mm();
    let tip = modification.tip_relief.map_or(0.0, |r| relief_mm(r, rho_mm - (edge_rho - r.length_mm)));
    let root = modification.root_relief.map_or(0.0, |r| relief_mm(r, active_start_rho_mm + r.length_mm - rho_mm));
    let across = (2.0 * (rho_mm - active_start_rho_mm) / (edge_rho - active_start_rho_mm) - 1.0).clamp(-1.0, 1.0);
    let sloped = modification.profile_slope_mm;
    let slope = 0.5 * (sloped.abs() - sloped * across);
    let crowning = modification.profile_crowning_mm * across * across;
    tip + root + crowning + slope
}

/// Material removed by a relief at the roll length `from_start_mm` from its beginning; 0 before, its amount after its end.
fn relief_mm(relief: Relief, from_start_mm: f64) -> f64 {
    let fraction = (from_start_mm / relief.length_mm).clamp(0.0, 1.0);
    relief.amount_mm
        * match relief.shape {
            ReliefShape::Linear => fraction,
            ReliefShape::Parabolic => fraction * fraction,
        }
}

/// Material removed at radius of curvature `rho_mm` of `tooth` at its tip edge, by a rounding of radius `rounding_mm` and its chamfer.
pub fn tip_edge_mm(rounding_mm: f64, tooth: &Tooth, rho_mm: f64) -> f64 {
    let begins_mm = tooth.involute.arc_mm(tooth.edge_rho_mm()) - tooth.tip_rounding_length_mm(rounding_mm);
    let into_mm = tooth.involute.arc_mm(rho_mm) - begins_mm;
    if into_mm <= 0.0 {
        return 0.0;
    }
    if tooth.tip_chamfer.is_some() {
        let (sin, cos) = tooth.edge_turn_rad().sin_cos();
        let on_chamfer_mm = into_mm - rounding_mm * sin;
        if on_chamfer_mm > 0.0 {
            return rounding_mm * (1.0 - cos) + on_chamfer_mm * sin / cos;
        }
    } else if rounding_mm <= 0.0 {
        return 0.0;
    }
    // ρ − √(ρ² − d²) without cancellation.
    into_mm * into_mm / (rounding_mm + ((rounding_mm - into_mm) * (rounding_mm + into_mm)).max(0.0).sqrt())
}
