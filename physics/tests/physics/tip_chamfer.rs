//! Tip chamfers: circles, contact ratio and area against closed forms, and edges of contact.

use std::f64::consts::PI;

use gearwear_bodies::gear::{
    Gear, GearPair, PairError, outline::polyline, removed_material::tip_edge_mm, spec::PairSpec,
    tip_chamfer::TipChamfer,
};

use super::common::{assert_close, fzg_c, pair};

const HEIGHT_MM: f64 = 0.5;

fn chamfered(height_mm: f64, angle_deg: f64) -> PairSpec {
    let mut spec = fzg_c();
    for gear in Gear::BOTH {
        spec.gears[gear].tip_chamfer = Some(TipChamfer { height_mm, angle_rad: angle_deg.to_radians() });
    }
    spec
}

/// Area within a closed polyline.
fn area_mm2(points: &[[f64; 2]]) -> f64 {
    let sides = points.iter().zip(points.iter().cycle().skip(1));
    0.5 * sides.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
}

/// ε_α = (√(r_Fa1² − r_b1²) + √(r_Fa2² − r_b2²) − a sin α_wt)/p_bt with the tip form circles (ISO 21771, section 5).
#[test]
fn ver_contact_ratio_is_that_of_the_tip_form_circles() {
    let pair = pair(&chamfered(HEIGHT_MM, 45.0));
    let form = [(16.0, 82.46), (24.0, 118.36)].map(|(z, tip): (f64, f64)| {
        let (base, form) = (0.5 * 4.5 * z * 20f64.to_radians().cos(), 0.5 * tip - HEIGHT_MM);
        (form * form - base * base).sqrt()
    });
    let alpha_wt = (90.0 * 20f64.to_radians().cos() / 91.5).acos();
    let expected = (form[0] + form[1] - 91.5 * alpha_wt.sin()) / (PI * 4.5 * 20f64.to_radians().cos());
    assert_close("ε_α", pair.path.contact_ratio(), expected, 1e-12);
    assert_close("d_Fa", 2.0 * pair.tip_form_radius_mm(Gear::Pinion), 81.46, 1e-12);
    assert_close("d_Na", 2.0 * pair.active_end_radius_mm(Gear::Wheel), 117.36, 1e-12);
    // Contact leaves the flank for the edge at the form circle.
    let beyond = pair.touch(pair.path.end_mm + 1e-6);
    assert_eq!((beyond.edge_of, pair.touch(pair.path.end_mm - 1e-6).edge_of), (Some(Gear::Pinion), None));
    assert!(beyond.gap_mm.abs() < 1e-9, "{}", beyond.gap_mm);
}

/// Both chamfers of a tooth take 2 ∫ r (ψ(r) − ψ_K(r)) dr from r_Fa to r_a, with ψ_K = ψ(r_Fa) − δ + asin(r_Fa sin δ/r) by the law of sines.
#[test]
fn ver_area_of_the_outline_lacks_the_chamfers() {
    let [plain, cut] = [pair(&fzg_c()), pair(&chamfered(HEIGHT_MM, 50.0))];
    for gear in Gear::BOTH {
        let tooth = &plain.teeth[gear];
        let (tip, delta) = (tooth.tip_radius_mm, 50f64.to_radians());
        let form = tip - HEIGHT_MM;
        let steps = 2000;
        let removed: f64 = (0..steps)
            .map(|k| {
                let r = form + HEIGHT_MM * (f64::from(k) + 0.5) / f64::from(steps);
                let on_chamfer = tooth.half_angle_rad(form) - delta + (form * delta.sin() / r).asin();
                2.0 * r * (tooth.half_angle_rad(r) - on_chamfer) * HEIGHT_MM / f64::from(steps)
            })
            .sum();
        // Four chords stand for the tip arc: the segments beyond them are added.
        let [whole, left] = [tooth, &cut.teeth[gear]].map(|tooth| {
            let chord = 0.5 * tooth.land_half_angle_rad();
            area_mm2(&polyline(tooth, 4000)) / f64::from(tooth.teeth) + 2.0 * tip * tip * (chord - chord.sin())
        });
        assert_close("area", whole - left, removed, 1e-3);
    }
}

/// Seen along the normal, the chamfer is a line of the slope tan γ from the edge, tangent to its rounding.
#[test]
fn ver_chamfer_is_removed_material() {
    let pair = pair(&chamfered(HEIGHT_MM, 50.0));
    let tooth = &pair.teeth.pinion;
    let gamma = 50f64.to_radians() - (tooth.involute.base_radius_mm / (tooth.tip_radius_mm - HEIGHT_MM)).acos();
    let edge_mm = tooth.involute.arc_mm(tooth.edge_rho_mm());
    let at = |rounding_mm: f64, beyond_mm: f64| {
        tip_edge_mm(rounding_mm, tooth, tooth.involute.rho_at_arc_mm(edge_mm + beyond_mm))
    };
    assert_eq!(at(0.0, -1e-6), 0.0);
    assert_close("sharp", at(0.0, 0.1), 0.1 * gamma.tan(), 1e-9);
    assert_close("beyond the rounding", at(0.2, 0.1), 0.1 * gamma.tan(), 1e-9);
    // ρ_k (1/cos(γ/2) − 1) along the bisector, over cos(γ/2) along the normal, but for the square of the angle.
    assert_close("at the edge", at(0.2, 0.0), 0.2 * (1.0 - (1.0 - (0.5 * gamma).tan().powi(2)).sqrt()), 1e-9);
}

#[test]
fn impossible_chamfers_are_refused() {
    let refused = |height_mm: f64, angle_deg: f64| GearPair::new(&chamfered(height_mm, angle_deg)).unwrap_err();
    let PairError::TipChamferTooLarge { greatest_mm, .. } = refused(1.2, 70.0) else { panic!("no room") };
    assert!(GearPair::new(&chamfered(0.999 * greatest_mm, 70.0)).is_ok(), "{greatest_mm}");
    assert!(matches!(refused(1.001 * greatest_mm, 70.0), PairError::TipChamferTooLarge { .. }));
    assert!(matches!(refused(0.5, 30.0), PairError::TipChamferAngle { .. }));
    assert!(matches!(refused(3.0, 45.0), PairError::ContactRatioBelowOne { .. }));
    let mut rounded = chamfered(0.01, 45.0);
    rounded.gears.pinion.modification.tip_rounding_mm = 0.3;
    assert!(matches!(GearPair::new(&rounded).unwrap_err(), PairError::TipRoundingTooLarge { .. }));
}
