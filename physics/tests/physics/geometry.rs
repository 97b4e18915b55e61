//! Gear geometry against the FZG test gears and against its own continuity.

use gearwear_bodies::gear::{
    Gear, PairError,
    flank_zones::{FlankZone, FlankZones},
    modification::{Modification, Relief, ReliefShape},
    outline::{OutlineCurve, outline},
    removed_material::{removed_mm, tip_edge_mm},
    tooth::Tooth,
};
use gearwear_physics::contact::hertz::flattening;

use super::common::{assert_close, fzg_a, fzg_c, gear, pair, spur, steel};

#[test]
fn val_the_wheel_of_fzg_type_a_is_undercut() {
    let a = pair(&fzg_a());
    // Trochoid and involute cross at 50.7472 mm (a brute-force envelope of the tool's rounding over 40 001 rack positions gives
    // the crossing between 50.7470 and 50.7475). The tabulated 50.759 is where the mirror image of the rack's straight end
    // would lie, √(r_b² + ρ²) with ρ = −1.27 mm: not on the gear.
    assert_close("r_Ff2", a.teeth.wheel.root_form_radius_mm, 50.7472, 1e-5);
    let alpha = 20f64.to_radians();
    let gearwear_bodies::gear::fillet::Fillet::Rack(trochoid) = a.teeth.wheel.trochoid else {
        panic!("an external gear has the fillet of a rack")
    };
    let rho = trochoid.involute_end_rho_mm(alpha);
    assert_close("mirror image", a.path.involute.wheel.radius_mm(rho), 50.759, 1e-5);
    assert!(a.teeth.wheel.undercut && !a.teeth.pinion.undercut);
}

/// The outline closes, its pieces join to 1e-9 mm, and where nothing is undercut they join without a kink.
fn check_outline(spec: &gearwear_bodies::gear::spec::PairSpec) {
    for g in Gear::BOTH {
        let tooth = &Tooth::new(spec, g, spec.tip_radius_mm(g)).expect("the tooth of the test is sound");
        let pieces = outline(tooth);
        assert_eq!(pieces.len(), 6 * tooth.teeth as usize);
        for (k, piece) in pieces.iter().enumerate() {
            let next = &pieces[(k + 1) % pieces.len()];
            let jump = (piece.point_mm(1.0) - next.point_mm(0.0)).norm();
            assert!(jump < 1e-9, "{g:?} {:?}-{:?}: jump {jump:e}", piece.curve, next.curve);
            let corner = matches!((piece.curve, next.curve), (OutlineCurve::TipArc, _) | (_, OutlineCurve::TipArc))
                || (tooth.undercut && piece.curve != OutlineCurve::RootArc && next.curve != OutlineCurve::RootArc);
            let (before, after) = (piece.tangent(1.0), next.tangent(0.0));
            if !corner {
                assert!(
                    (before - after).norm() < 1e-9,
                    "{g:?} {:?}-{:?}: {before:?} {after:?}",
                    piece.curve,
                    next.curve
                );
            }
            // The stated tangent is that of the curve.
            let chord = (piece.point_mm(0.5 + 1e-6) - piece.point_mm(0.5 - 1e-6)).normalize();
            assert!((chord - piece.tangent(0.5)).norm() < 1e-6, "{g:?} {:?}", piece.curve);
        }
    }
}

#[test]
fn ver_outlines_are_closed_continuous_and_tangent() {
    check_outline(&fzg_c());
    check_outline(&fzg_a());
    // A 9-tooth pinion without shift is undercut by far; a helical pair in its transverse section.
    check_outline(&spur(2.0, 59.65, 10.0, gear(10, 0.3, None), gear(49, 0.0, None)));
    let mut helical = spur(3.5, 91.5, 23.0, gear(20, 0.1809, None), gear(30, 0.0891, None));
    helical.helix_angle_rad = 15f64.to_radians();
    check_outline(&helical);
}

/// Undercut limit: the rack's straight flank reaches the interference point at z = 2 (h_fP* − ρ_fP*(1 − sin α)) / sin² α
/// (Litvin, Gear Geometry, section 13): 17.1 teeth for the rack 1.25/0.38 without shift.
#[test]
fn val_undercut_begins_below_17_teeth() {
    let of =
        |z: u32| pair(&spur(1.0, 0.5 * f64::from(z + 60), 10.0, gear(z, 0.0, None), gear(60, 0.0, None))).teeth.pinion;
    assert!(!of(18).undercut && of(16).undercut);
}

#[test]
fn helical_quantities_of_feup_h501() {
    // m_n 3.5, beta 15 degrees, z 20/30, a 91.5: public pair; r = m_n z / (2 cos beta).
    let mut spec = spur(3.5, 91.5, 23.0, gear(20, 0.1809, None), gear(30, 0.0891, None));
    spec.helix_angle_rad = 15f64.to_radians();
    let h = pair(&spec);
    assert_close("r1", h.teeth.pinion.reference_radius_mm, 3.5 * 20.0 / 2.0 / 15f64.to_radians().cos(), 1e-12);
    assert_close("eps_beta", h.overlap_ratio(), 23.0 * 15f64.to_radians().sin() / (std::f64::consts::PI * 3.5), 1e-12);
    // The shifts fit the centre distance: no backlash beyond rounding.
    assert!(h.backlash_mm < 2e-3, "{}", h.backlash_mm);
}

#[test]
fn a_tooth_thickness_allowance_becomes_backlash() {
    let mut spec = fzg_c();
    spec.gears.pinion.tooth_thickness_allowance_mm = -0.1;
    let backlash = pair(&spec).backlash_mm;
    // The tooth is thinner by 0.1 at the reference circle, by 0.1 r_w/r at the working circle.
    assert_close("backlash", backlash, 0.1 * 36.6 / 36.0, 2e-3);
}

#[test]
fn tip_circles_from_the_rack_keep_the_full_clearance() {
    let mut spec = fzg_c();
    spec.gears.pinion.tip_diameter_mm = None;
    spec.gears.wheel.tip_diameter_mm = None;
    let c = pair(&spec);
    for g in Gear::BOTH {
        assert_close("clearance", c.tip_clearance_mm[g], 0.25 * 4.5, 1e-9);
    }
    // ISO 14635-1 gives 82.46 and 118.36 for the same rule.
    assert_close("d_a1", 2.0 * c.teeth.pinion.tip_radius_mm, 82.46, 2e-4);
    assert_close("d_a2", 2.0 * c.teeth.wheel.tip_radius_mm, 118.36, 2e-4);
}

#[test]
fn impossible_pairs_are_refused() {
    let refuse = |edit: &dyn Fn(&mut gearwear_bodies::gear::spec::PairSpec)| {
        let mut spec = fzg_c();
        edit(&mut spec);
        gearwear_bodies::gear::GearPair::new(&spec).unwrap_err()
    };
    assert!(matches!(refuse(&|s| s.centre_distance_mm = 84.0), PairError::NoMesh { .. }));
    assert!(matches!(refuse(&|s| s.centre_distance_mm = 91.3), PairError::NegativeBacklash { .. }));
    assert!(matches!(refuse(&|s| s.centre_distance_mm = 95.0), PairError::ContactRatioBelowOne { .. }));
    assert!(matches!(
        refuse(&|s| s.gears.pinion.tip_diameter_mm = Some(95.0)),
        PairError::PointedTooth { gear: Gear::Pinion, .. }
    ));
    assert!(matches!(refuse(&|s| s.gears.wheel.tip_diameter_mm = Some(100.0)), PairError::TipBelowForm { .. }));
    assert!(matches!(
        refuse(&|s| s.gears.wheel.tip_diameter_mm = Some(121.0)),
        PairError::NoTipClearance { gear: Gear::Wheel, .. }
    ));
    // The tip of a wheel that reaches below what the tool's straight flank has made runs into the fillet.
    let mates = spur(1.0, 40.0, 10.0, gear(20, 0.0, None), gear(60, 0.0, Some(62.4)));
    assert!(matches!(
        gearwear_bodies::gear::GearPair::new(&mates).unwrap_err(),
        PairError::Interference { gear: Gear::Pinion, .. }
    ));
    assert!(matches!(refuse(&|s| s.rack.dedendum_factor = 2.2), PairError::RackPointed { .. }));
    assert!(matches!(refuse(&|s| s.rack.fillet_radius_factor = 0.6), PairError::RackTipPointed { .. }));
    assert!(matches!(
        refuse(&|s| s.gears.wheel.bore_diameter_mm = Some(98.4)),
        PairError::BoreTooLarge { gear: Gear::Wheel, .. }
    ));
}

/// The least centre distance named in the error is the one without backlash: one above it is accepted, one below not.
#[test]
fn ver_least_centre_distance_is_exact() {
    let mut spec = fzg_c();
    spec.centre_distance_mm = 91.0;
    let Err(PairError::NegativeBacklash { least_mm, .. }) = gearwear_bodies::gear::GearPair::new(&spec) else {
        panic!("91 mm is too close")
    };
    spec.centre_distance_mm = least_mm + 1e-6;
    let loose = pair(&spec).backlash_mm;
    assert!(loose > 0.0 && loose < 1e-5, "{loose}");
}

/// Hertz pressure at the pitch point with the whole load, FZG load stages 1, 4, 6, 8, 9, 10 and 12: independent
/// calculation for the project in double precision, given to 0.1 MPa for type A (b 20) and to 1 MPa for type C (b 14).
#[test]
fn val_hertz_pressure_of_the_load_stages() {
    let torques_nm = [3.3, 60.8, 135.3, 239.3, 302.0, 372.6, 534.5];
    let type_a = [144.8, 621.5, 927.1, 1233.0, 1385.1, 1538.5, 1842.7];
    let type_c = [173.0, 743.0, 1108.0, 1474.0, 1656.0, 1839.0, 2203.0];
    for (spec, pressures, rounding) in [(fzg_a(), type_a, 0.05), (fzg_c(), type_c, 0.5)] {
        let pair = pair(&spec);
        let contact = flattening(&pair, &steel(), pair.path.pitch_point_mm).contact;
        for (torque, expected) in torques_nm.iter().zip(pressures) {
            let load = 1e3 * torque / pair.path.involute.pinion.base_radius_mm / spec.face_width_mm;
            let pressure = contact.loaded(load).peak_pressure_mpa;
            assert!(
                (pressure - expected).abs() <= 2e-3 * expected + rounding,
                "{torque} N·m: {pressure} MPa, {expected}"
            );
        }
    }
}

/// Reliefs, crowning and rounding as material removed along the normal: their values where the definition gives them.
#[test]
fn ver_modifications_remove_what_they_say() {
    let c = pair(&fzg_c());
    let tooth = &c.teeth.pinion;
    let (start, tip) = (c.active_start_rho_mm(Gear::Pinion), tooth.tip_rho_mm());
    let at = |modification: &Modification, rho: f64| removed_mm(modification, tooth, start, rho);

    let relief = |shape| Relief { amount_mm: 0.02, length_mm: 4.0, shape };
    let linear = Modification { tip_relief: Some(relief(ReliefShape::Linear)), ..Modification::default() };
    assert_eq!([at(&linear, tip), at(&linear, tip - 4.0), at(&linear, start)], [0.02, 0.0, 0.0]);
    assert_close("half-way", at(&linear, tip - 2.0), 0.01, 1e-12);
    let parabolic = Modification { root_relief: Some(relief(ReliefShape::Parabolic)), ..Modification::default() };
    assert_eq!([at(&parabolic, start), at(&parabolic, start + 4.0), at(&parabolic, start - 1.0)], [0.02, 0.0, 0.02]);
    assert_close("half-way", at(&parabolic, start + 2.0), 0.005, 1e-12);

    let crowned = Modification { profile_crowning_mm: 0.008, ..Modification::default() };
    assert_close("ends", at(&crowned, start), 0.008, 1e-12);
    assert_close("ends", at(&crowned, tip), 0.008, 1e-12);
    assert!(at(&crowned, 0.5 * (start + tip)) < 1e-15);

    // f_Hα > 0: material rises towards the tip, so that it is missing at the start of the active profile.
    for (slope, at_start, at_tip) in [(0.006, 0.006, 0.0), (-0.006, 0.0, 0.006)] {
        let sloped = Modification { profile_slope_mm: slope, ..Modification::default() };
        assert!((at(&sloped, start) - at_start).abs() < 1e-15 && (at(&sloped, tip) - at_tip).abs() < 1e-15, "{slope}");
        assert_close("middle", at(&sloped, 0.5 * (start + tip)), 0.003, 1e-12);
        assert_eq!(at(&sloped, start - 1.0), at(&sloped, start));
        assert!(sloped.has_profile_modification());
    }

    // The rounding's circle touches the flank where it begins and the tip circle at the tip: with the turn γ between
    // them the flank's end lies ρ − √(ρ² − d²) off the circle along its normal, with d = ρ tan(γ/2).
    let turn = std::f64::consts::FRAC_PI_2 - tooth.involute.pressure_angle_rad(tip);
    let length = 0.2 * (0.5 * turn).tan();
    assert_close("length", tooth.tip_rounding_length_mm(0.2), length, 1e-12);
    assert_close("at the tip", tip_edge_mm(0.2, tooth, tip), 0.2 - (0.04 - length * length).sqrt(), 1e-9);
    assert_eq!(tip_edge_mm(0.2, tooth, tip - 2.0), 0.0);
}

/// Length along the pinion's involute from r to the tip circle, s = (r_a² − r²)/(2 r_b): r_b = 36 cos 20°, r_a = 41.23 mm. Three half-widths
/// of 0.1 mm are 0.3 mm; of 0.2452 mm (Hertz at C, 302 N·m) they would be more than 0.15 · 4.5 mm = 0.675 mm. A rounding of 0.1 mm takes
/// ρ tan(γ/2) with γ = 90° − arccos(r_b/r_a).
#[test]
fn ver_the_tip_edge_zone_has_its_length_along_the_flank() {
    let (base, tip): (f64, f64) = (36.0 * 20f64.to_radians().cos(), 41.23);
    let rounding = 0.1 * (0.5 * (std::f64::consts::FRAC_PI_2 - (base / tip).acos())).tan();
    for (rounding_mm, half_width_mm, length) in
        [(0.0, 0.1, 0.3), (0.0, 0.2452, 0.675), (0.1, 0.1, 0.3 + rounding), (0.1, 0.2452, 0.675 + rounding)]
    {
        let mut spec = fzg_c();
        spec.gears.pinion.modification.tip_rounding_mm = rounding_mm;
        let pair = pair(&spec);
        let zones = FlankZones::new(&pair, Gear::Pinion, half_width_mm);
        let arc = (tip * tip - zones.tip_edge_radius_mm.powi(2)) / (2.0 * base);
        assert!((arc - length).abs() < 1e-9, "{rounding_mm}, {half_width_mm}: {arc} instead of {length}");
        assert_eq!(zones.active_start_radius_mm, pair.active_start_radius_mm(Gear::Pinion));
        let (sap, edge) = (zones.active_start_radius_mm, zones.tip_edge_radius_mm);
        let at = [sap - 1e-9, sap, edge - 1e-9, edge, tip].map(|radius| zones.at(radius));
        let [below, active, tip_edge] = [FlankZone::BelowActive, FlankZone::Active, FlankZone::TipEdge];
        assert_eq!(at, [below, active, active, tip_edge, tip_edge]);
    }
}
