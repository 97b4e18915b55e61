//! The centre distance of a backlash, and the backlash of a centre distance.

use gearwear_bodies::gear::GearPair;
use gearwear_bodies::gear::backlash::{Backlash, NoSuchBacklash};
use gearwear_bodies::gear::involute::{inv, inverse_inv};

use super::common::preset;

/// ISO 21771: inv α_wt = inv α_t + 2 tan α_n (x1 + x2)/(z1 + z2), without allowances and backlash.
#[test]
fn val_no_backlash_is_the_formula_of_the_standard() {
    for name in ["fzg-c", "h501"] {
        let spec = preset(name);
        let alpha_t = spec.transverse_pressure_angle_rad();
        let shifts = spec.gears.as_ref().map(|gear| gear.profile_shift).sum();
        let teeth = spec.gears.as_ref().map(|gear| f64::from(gear.teeth)).sum();
        let alpha_w = inverse_inv(inv(alpha_t) + 2.0 * spec.normal_pressure_angle_rad.tan() * shifts / teeth);
        let expected = 0.5 * spec.transverse_module_mm() * teeth * alpha_t.cos() / alpha_w.cos();
        for none in [Backlash::Normal(0.0), Backlash::Circumferential(0.0)] {
            let found = spec.centre_distance_with_mm(none).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-12, "{name}, {none:?}: {found}, {expected}");
        }
    }
}

/// The pair at that centre distance has the backlash, j_bn = j_wt cos α_wt cos β_b, whatever helix and allowances.
#[test]
fn ver_the_pair_has_the_backlash_asked_for() {
    for name in ["fzg-c", "h501"] {
        let mut spec = preset(name);
        spec.gears.pinion.tooth_thickness_allowance_mm = -0.05;
        for backlash_mm in [0.02, 0.15, 0.4] {
            spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(backlash_mm)).unwrap();
            let pair = GearPair::new(&spec).unwrap();
            assert!((pair.backlash_mm - backlash_mm).abs() < 1e-12, "{}", pair.backlash_mm);
            let normal_mm = backlash_mm * pair.working_pressure_angle_rad.cos() * pair.base_helix_angle_rad().cos();
            let again = spec.centre_distance_with_mm(Backlash::Normal(normal_mm)).unwrap();
            assert!((again / spec.centre_distance_mm - 1.0).abs() < 1e-12);
        }
    }
}

/// Teeth thinner than any pitch leaves: the least backlash is where α_wt = 0.
#[test]
fn teeth_that_are_too_thin_are_told() {
    let mut spec = preset("fzg-c");
    spec.gears.wheel.tooth_thickness_allowance_mm = -5.0;
    let Err(NoSuchBacklash::TeethTooThin { least_mm }) = spec.centre_distance_with_mm(Backlash::Circumferential(0.1))
    else {
        panic!("thin teeth have more backlash at any centre distance");
    };
    assert!(spec.centre_distance_with_mm(Backlash::Circumferential(1.01 * least_mm)).is_ok());
    assert!(spec.centre_distance_with_mm(Backlash::Normal(0.99 * least_mm)).is_err());
}
