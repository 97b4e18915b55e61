//! The working flanks in space: both gears in one frame, turned to any place of the mesh.

use gearwear_bodies::gear::{Gear, GearPair, PerGear, flank_surface::FlankSurface, spec::PairSpec};
use proptest::prelude::*;

use super::common::{fzg_c, pair};

/// FZG type C as a helical pair of the same transverse module.
fn helical(helix_angle_deg: f64) -> GearPair {
    let helix_angle_rad = helix_angle_deg.to_radians();
    pair(&PairSpec { helix_angle_rad, normal_module_mm: 4.5 * helix_angle_rad.cos(), ..fzg_c() })
}

fn surfaces(pair: &GearPair) -> PerGear<FlankSurface> {
    PerGear::from_fn(|gear| FlankSurface::new(pair, gear))
}

/// How far a point is outside the flank of `surface` with its tooth at `position`, along the flank's normal. The normals of an
/// involute are the tangents of its base circle: the flank's point on the tangent through the point is as long a string away from
/// the base circle as the tangent has turned.
fn outside_mm(surface: &FlankSurface, [x, y, z]: [f64; 3], position: f64) -> f64 {
    let (x, y) = (x, y - surface.axis_y_mm);
    let radius = x.hypot(y);
    let string = ((radius - surface.base_radius_mm) * (radius + surface.base_radius_mm)).sqrt();
    let touches_at = y.atan2(x) - (string / surface.base_radius_mm).atan();
    let turned = touches_at - surface.tangent_point_rad;
    let turned = turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round();
    string - (surface.contact_rho_mm(position, z) - surface.base_radius_mm * turned)
}

/// Both flanks have the points of the line of contact in common, with opposite normals, and are apart everywhere else, wherever
/// the gears stand; the distances are those of points in space, found without the line of contact.
#[test]
fn ver_flanks_touch_along_the_line_of_contact() {
    for helix in [15.0, -20.0, 0.0] {
        let pair = helical(helix);
        let surfaces = surfaces(&pair);
        let path = &pair.path;
        let mut touched = 0;
        for phase in 0..9 {
            let position = path.start_mm - 3.0 + (path.end_mm - path.start_mm + 6.0) * f64::from(phase) / 8.0;
            for station in 0..=10 {
                let width = pair.spec.face_width_mm * f64::from(station) / 10.0;
                let rho = surfaces.as_ref().map(|surface| surface.contact_rho_mm(position, width));
                if (path.start_mm..=path.end_mm).contains(&rho.pinion) {
                    touched += 1;
                    let points = PerGear::from_fn(|gear| surfaces[gear].point_mm(rho[gear], width, position));
                    let normals = PerGear::from_fn(|gear| surfaces[gear].transverse_normal(rho[gear], width, position));
                    for axis in 0..3 {
                        assert!((points.pinion[axis] - points.wheel[axis]).abs() < 1e-12, "{points:?}");
                        assert!((normals.pinion[axis] + normals.wheel[axis]).abs() < 1e-13, "{normals:?}");
                    }
                }
                // Every point of each flank against the other flank.
                for own in Gear::BOTH {
                    let (tooth, mate) = (&pair.teeth[own], own.mate());
                    let (low, high) = (tooth.root_form_rho_mm(), tooth.tip_rho_mm());
                    for i in 0..=40 {
                        let at = low + (high - low) * f64::from(i) / 40.0;
                        let point = surfaces[own].point_mm(at, width, position);
                        let reaches = point[0].hypot(point[1] - surfaces[mate].axis_y_mm);
                        let mates = &pair.teeth[mate];
                        if (mates.root_form_radius_mm..=mates.tip_radius_mm).contains(&reaches) {
                            let apart = outside_mm(&surfaces[mate], point, position);
                            assert!(apart > -1e-12, "{own:?} reaches {apart} mm into its mate");
                            let from_contact = at - rho[own];
                            assert!(from_contact.abs() < 1e-9 || apart > 0.0, "they touch {from_contact} mm away");
                        }
                    }
                    let contact = surfaces[own].point_mm(rho[own], width, position);
                    if rho[own] > 0.0 && rho[mate] > 0.0 {
                        assert!(outside_mm(&surfaces[mate], contact, position).abs() < 1e-12);
                    }
                }
            }
        }
        assert!(touched > 40, "{touched} places touch");
    }
}

proptest! {
    /// Turning the pinion by δ against the clock and the wheel by δ z1/z2 with it moves every flank point to where it is with the
    /// tooth r_b1 δ farther on its path.
    #[test]
    fn prop_gears_turn_as_the_tooth_moves(helix in -30.0..30.0_f64, turn in -0.3..0.3_f64, at in 0.0..1.0_f64, width in 0.0..14.0_f64) {
        let pair = helical(helix);
        let surfaces = surfaces(&pair);
        let position = pair.path.pitch_point_mm;
        for gear in Gear::BOTH {
            let surface = &surfaces[gear];
            let rho = at * pair.teeth[gear].tip_rho_mm();
            let [x, y, z] = surface.point_mm(rho, width, position);
            let turn_of_gear = match gear {
                Gear::Pinion => turn,
                Gear::Wheel => -turn * pair.wheel_turns_per_pinion_turn(),
            };
            let (sin, cos) = turn_of_gear.sin_cos();
            let (dx, dy) = (x, y - surface.axis_y_mm);
            let turned = [cos * dx - sin * dy, surface.axis_y_mm + sin * dx + cos * dy, z];
            let moved = surface.point_mm(rho, width, position + surfaces.pinion.base_radius_mm * turn);
            for axis in 0..3 {
                prop_assert!((turned[axis] - moved[axis]).abs() < 1e-11, "{turned:?} {moved:?}");
            }
        }
    }
}

/// For a positive helix angle the sections at larger width follow behind: the pinion, which turns against the clock, has them
/// turned clockwise, the wheel the other way, by z tan β / r each (ISO 21771, 4.3).
#[test]
fn ver_sections_follow_behind_for_a_positive_helix_angle() {
    let pair = helical(15.0);
    for (gear, sense) in [(Gear::Pinion, -1.0), (Gear::Wheel, 1.0)] {
        let surface = FlankSurface::new(&pair, gear);
        let angle = |width: f64| {
            let [x, y, _] = surface.point_mm(20.0, width, pair.path.pitch_point_mm);
            (y - surface.axis_y_mm).atan2(x)
        };
        let expected = sense * 10.0 * 15f64.to_radians().tan() / pair.teeth[gear].reference_radius_mm;
        assert!((angle(10.0) - angle(0.0) - expected).abs() < 1e-13, "{gear:?}");
    }
    let pinion = FlankSurface::new(&pair, Gear::Pinion);
    let first = pinion.contact_rho_mm(pair.path.start_mm, 0.0);
    assert!(first > pair.path.start_mm, "width 0 is in contact while the middle of the face width enters");
}
