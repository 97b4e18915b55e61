//! Nominal root stress of the standards against the fillet that the rack cuts. Printed figures are in the case `micropitting-method-b`.

use gearwear_bodies::gear::{Gear, GearPair, spec::BasicRack};
use gearwear_bodies::root_stress::{LoadedAt, section};
use nalgebra::{Rotation2, Vector2};

use super::common::{assert_close, gear, spur};

/// FZG type C.
fn pair() -> GearPair {
    let spec = spur(4.5, 91.5, 14.0, gear(16, 0.1817, Some(82.46)), gear(24, 0.1715, Some(118.36)));
    GearPair::new(&spec).unwrap()
}

/// Thickness and radius of curvature where tangents at 30° touch the trochoid itself.
#[test]
fn ver_critical_section_of_the_trochoid() {
    let pair = pair();
    for gear in Gear::BOTH {
        let tooth = &pair.teeth[gear];
        let into_tooth = Rotation2::new(std::f64::consts::PI / f64::from(tooth.teeth));
        let trochoid = &tooth.trochoid;
        let point = |t: f64| into_tooth * trochoid.point_mm(t);
        let to_middle = |t: f64| {
            let tangent: Vector2<f64> = into_tooth * trochoid.tangent(t);
            tangent.x.abs().atan2(tangent.y.abs())
        };
        let (mut low, mut high) = (trochoid.first_angle_rad(), std::f64::consts::FRAC_PI_2);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if to_middle(middle) < 30f64.to_radians() { &mut low } else { &mut high }) = middle;
        }
        let (before, after) = (low - 1e-4, low + 1e-4);
        let radius = (point(after) - point(before)).norm() / (to_middle(after) - to_middle(before)).abs();
        let found = section(&pair, gear, LoadedAt::SinglePairContact).unwrap();
        assert_close("s_Fn", found.thickness_mm, 2.0 * point(low).x.abs(), 1e-9);
        assert_close("ρ_F", found.fillet_radius_mm, radius, 1e-6);
    }
}

/// The load at the tip has the longer arm; where two pairs always share the load, nothing is said of one that carries it alone.
#[test]
fn prop_single_pair_contact_is_below_the_tip_and_may_not_exist() {
    let pair = pair();
    for gear in Gear::BOTH {
        let [alone, tip] = [LoadedAt::SinglePairContact, LoadedAt::Tip].map(|at| section(&pair, gear, at).unwrap());
        assert!(alone.moment_arm_mm < tip.moment_arm_mm && alone.form_factor < tip.form_factor);
        assert_eq!(alone.thickness_mm, tip.thickness_mm);
    }
    let mut tall = spur(2.0, 120.0, 20.0, gear(60, 0.0, Some(125.2)), gear(60, 0.0, Some(125.2)));
    tall.rack = BasicRack { addendum_factor: 1.3, dedendum_factor: 1.55, fillet_radius_factor: 0.25 };
    let tall = GearPair::new(&tall).unwrap();
    assert!(tall.path.contact_ratio() > 2.0);
    assert!(section(&tall, Gear::Pinion, LoadedAt::SinglePairContact).is_none());
    assert!(section(&tall, Gear::Pinion, LoadedAt::Tip).is_some());
}
