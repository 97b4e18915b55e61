//! Where flanks end: undercut, interference with fillets, edges that count as sharp, dimensions of inspection.

use std::f64::consts::PI;

use gearwear_bodies::gear::{
    Gear, GearPair, PairError,
    flank_edge::PathEnd,
    involute::inv,
    outline,
    spec::{BasicRack, PairSpec},
};
use proptest::prelude::*;

use super::common::{assert_close, fzg_a, fzg_c, gear, pair, spur};

fn standard(module: f64, teeth: [u32; 2], pressure_angle_deg: f64) -> PairSpec {
    let centre = 0.5 * module * f64::from(teeth[0] + teeth[1]);
    let mut spec = spur(module, centre, 10.0, gear(teeth[0], 0.0, None), gear(teeth[1], 0.0, None));
    spec.normal_pressure_angle_rad = pressure_angle_deg.to_radians();
    spec
}

/// Deepest that a point of one outline lies within the other as both turn through a mesh, by polygons alone; mm, positive where they overlap.
fn overlap_by_turning(pair: &GearPair) -> f64 {
    let outlines = [Gear::Pinion, Gear::Wheel].map(|gear| outline::polyline(&pair.teeth[gear], 100));
    let axis = pair.spec.centre_distance_mm;
    let mut deepest = f64::NEG_INFINITY;
    for k in 0..10 {
        let position = pair.path.start_mm + pair.path.base_pitch_mm * f64::from(k) / 10.0;
        // Space 0 of either outline lies on +y; the tooth beside it is half a pitch on. Contact on the flank at x < 0 of the tooth.
        let turn = |gear: Gear| {
            let tooth = &pair.teeth[gear];
            let on_pitch_circle = tooth.half_angle_rad(pair.working_pitch_radius_mm(gear));
            let rolled = (position - pair.path.pitch_point_mm) / tooth.involute.base_radius_mm;
            let half_pitch = PI / f64::from(tooth.teeth);
            (if gear == Gear::Pinion { rolled } else { -rolled }) - on_pitch_circle + half_pitch
        };
        let placed = |gear: Gear| -> Vec<[f64; 2]> {
            let (sin, cos) = turn(gear).sin_cos();
            let flip = if gear == Gear::Pinion { 1.0 } else { -1.0 };
            outlines[gear as usize]
                .iter()
                .map(|[x, y]| {
                    [flip * (cos * x - sin * y), flip * (sin * x + cos * y) + if flip < 0.0 { axis } else { 0.0 }]
                })
                .collect()
        };
        let both = [placed(Gear::Pinion), placed(Gear::Wheel)];
        for (own, other) in [(0, 1), (1, 0)] {
            for point in &both[own] {
                let from_axis = if other == 0 { point[0].hypot(point[1]) } else { point[0].hypot(point[1] - axis) };
                let gear = if other == 0 { Gear::Pinion } else { Gear::Wheel };
                if from_axis < pair.teeth[gear].tip_radius_mm {
                    deepest = deepest.max(depth_in(&both[other], *point));
                }
            }
        }
    }
    deepest
}

/// Distance of a point within a closed polygon from its sides, negative outside.
fn depth_in(polygon: &[[f64; 2]], point: [f64; 2]) -> f64 {
    let (mut nearest, mut within) = (f64::INFINITY, false);
    for (k, a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let crosses = (a[1] > point[1]) != (b[1] > point[1]);
        if !crosses && (a[1] > point[1] + 1.0 || a[1] < point[1] - 1.0) {
            continue;
        }
        let (side, to) = ([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]]);
        let square = side[0] * side[0] + side[1] * side[1];
        let t = if square > 0.0 { ((side[0] * to[0] + side[1] * to[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
        nearest = nearest.min((to[0] - t * side[0]).hypot(to[1] - t * side[1]));
        if crosses && point[0] < a[0] + side[0] * (point[1] - a[1]) / side[1] {
            within = !within;
        }
    }
    if within { nearest } else { -nearest }
}

/// Undercut pairs run, with contact between the form circles, and their outlines do not overlap as they turn: polygons of 100 points a flank
/// are true to some 10⁻⁴ modules. Form radii: the rack turned through the gear, the deepest cut of its rounding
/// found by refinement, leaves the involute alone from 7.049776 mm (15 teeth, 20°) and 9.698881 mm (20 teeth, 14.5°) of module 1.
#[test]
fn val_undercut_pairs_run_and_do_not_overlap() {
    for (teeth, angle, form, ends) in
        [([15, 40], 20.0, 7.049_776, [true, false]), ([20, 20], 14.5, 9.698_881, [true, true])]
    {
        let undercut = pair(&standard(1.0, teeth, angle));
        assert!((undercut.teeth.pinion.root_form_radius_mm - form).abs() < 1e-6);
        assert_eq!(undercut.active_start_radius_mm(Gear::Pinion), undercut.teeth.pinion.root_form_radius_mm);
        assert_eq!(PathEnd::BOTH.map(|end| undercut.edge(end).at_root), ends);
        let overlap = overlap_by_turning(&undercut);
        assert!(overlap < 2e-4, "{teeth:?}: {overlap}");
    }
    // Without undercut the tips end the contact.
    let plain = pair(&fzg_c());
    assert_eq!(
        PathEnd::BOTH.map(|end| (plain.edge(end).gear, plain.edge(end).at_root)),
        [(Gear::Wheel, false), (Gear::Pinion, false)]
    );
}

/// A tip that the tool has not made room for is refused, and the limit named is where it has: there the polygons just part.
#[test]
fn val_interference_is_overlap() {
    // Tool without clearance below the straight flank: everything below it is fillet.
    let mut spec = standard(1.0, [20, 60], 20.0);
    spec.rack = BasicRack { addendum_factor: 1.0, dedendum_factor: 1.25, fillet_radius_factor: 0.38 };
    spec.gears.wheel.tip_diameter_mm = Some(62.4);
    let Err(PairError::Interference { gear: Gear::Pinion, overlap_mm, greatest_tip_diameter_mm }) =
        GearPair::new(&spec)
    else {
        panic!("the tip reaches into the fillet")
    };
    assert!(overlap_mm > 1e-4 && greatest_tip_diameter_mm > 62.0 && greatest_tip_diameter_mm < 62.4);
    spec.gears.wheel.tip_diameter_mm = Some(greatest_tip_diameter_mm - 1e-9);
    let overlap = overlap_by_turning(&pair(&spec));
    assert!(overlap < 3e-4, "{overlap}");
}

/// Where the form circle ends the path the corner there touches the mate: contact goes over to it without a jump, and outside the gap opens.
#[test]
fn ver_the_corner_of_undercut_takes_the_contact_over() {
    let undercut = pair(&standard(1.0, [15, 40], 20.0));
    let at = |before: f64| undercut.touch(undercut.path.start_mm - before);
    let (inside, outside, beyond) = (at(-1e-7), at(1e-7), at(0.05));
    assert_eq!((inside.edge_of, outside.edge_of), (None, Some(Gear::Pinion)));
    for gear in Gear::BOTH {
        assert!((inside.rho_mm[gear] - outside.rho_mm[gear]).abs() < 1e-5);
        let [a, b] = [inside, outside].map(|touch| touch.load_line[gear]);
        assert!((a.load_angle_rad - b.load_angle_rad).abs() < 1e-5 && (a.depth_mm - b.depth_mm).abs() < 1e-5);
    }
    assert!(beyond.gap_mm > 0.0 && (undercut.pinion_lever_ratio(&outside) - 1.0).abs() < 1e-5);
    // The corner stands still on the pinion, and the wheel is touched below its tip.
    assert_eq!(beyond.rho_mm.pinion, undercut.teeth.pinion.root_form_rho_mm());
    assert!(beyond.rho_mm.wheel < undercut.teeth.wheel.tip_rho_mm());
    // The gap is the distance of the corner from the wheel's involute: along a tangent of the base circle, longer than its arc by the gap.
    assert!(beyond.gap_mm < 0.05);
}

/// Rounding below a thousandth of the module is none, whoever asks; one at it is one.
#[test]
fn ver_one_decider_of_sharp_tips() {
    for (rounding_mm, sharp) in [(0.0, true), (0.002, true), (0.004499, true), (0.0046, false), (0.1, false)] {
        let mut spec = fzg_c();
        spec.gears.pinion.modification.tip_rounding_mm = rounding_mm;
        let pair = pair(&spec);
        assert_eq!(spec.is_tip_sharp(Gear::Pinion), sharp, "{rounding_mm}");
        assert_eq!(pair.edge(PathEnd::End).is_sharp, sharp);
        assert_eq!(pair.spec.gears.pinion.modification.tip_rounding_mm == 0.0, sharp);
        assert_eq!(pair.rounding_start_rho_mm(Gear::Pinion) == pair.teeth.pinion.tip_rho_mm(), sharp);
    }
}

/// The rack's tip circle where the centre distance leaves room, less where the clearance asks for it; of a helical gear in its normal module.
#[test]
fn val_tips_are_never_longer_than_the_rack_makes_them() {
    let larger = pair(&spur(3.0, 114.3, 30.0, gear(19, 0.0, None), gear(57, 0.0, None)));
    assert_eq!(
        larger.teeth.map(|tooth| tooth.tip_radius_mm),
        gearwear_bodies::gear::PerGear { pinion: 31.5, wheel: 88.5 }
    );
    assert_close("ε_α", larger.path.contact_ratio(), 1.562, 5e-4);
    // z 20/30, m_n 3.5, β 15°, x 0.1809/0.0891: d_a = d + 2 m_n (1 + x − 0.0…) of a = 91.5 mm is shortened; at 92 mm it is d + 2 m_n (1 + x).
    let mut helical = spur(3.5, 92.0, 23.0, gear(20, 0.1809, None), gear(30, 0.0891, None));
    helical.helix_angle_rad = 15f64.to_radians();
    let radius = 3.5 * 20.0 / 2.0 / 15f64.to_radians().cos() + 3.5 * 1.1809;
    assert!((helical.tip_radius_mm(Gear::Pinion) - radius).abs() < 1e-12);
    helical.centre_distance_mm = 91.5;
    let kept = helical.tip_radius_mm(Gear::Pinion) + helical.root_radius_mm(Gear::Wheel) + 0.25 * 3.5;
    assert!((kept - 91.5).abs() < 1e-12 && helical.tip_radius_mm(Gear::Pinion) < radius);
}

/// Span over teeth: tables of base tangent lengths for module 1, 20°, without shift (z 20, k 3: 7.6604; z 30, k 4: 10.7526; z 40, k 5: 13.8448;
/// ISO 21771, cos 20° [(k − ½) π + z inv 20°]); and on any gear k − 1 base pitches and a tooth on the base circle, normal.
#[test]
fn val_span_over_teeth() {
    for (teeth, k, span_mm) in [(20, 3, 7.6604), (30, 4, 10.7526), (40, 5, 13.8448)] {
        let span = pair(&standard(1.0, [teeth, 60], 20.0)).span(Gear::Pinion).expect("it can be measured");
        assert_eq!(span.teeth, k);
        assert!((span.span_mm - span_mm).abs() < 5e-5, "{}", span.span_mm);
    }
    let mut spec = spur(3.5, 92.5, 60.0, gear(20, 0.1809, None), gear(30, 0.0891, None));
    (spec.helix_angle_rad, spec.gears.pinion.tooth_thickness_allowance_mm) = (15f64.to_radians(), -0.08);
    let helical = pair(&spec);
    let span = helical.span(Gear::Pinion).expect("it can be measured");
    let tooth = &helical.teeth.pinion;
    let on_base_circle = 2.0 * tooth.base_half_angle_rad * tooth.involute.base_radius_mm;
    let transverse = f64::from(span.teeth - 1) * helical.path.base_pitch_mm + on_base_circle;
    assert_close("W_k", span.span_mm, transverse * helical.base_helix_angle_rad().cos(), 1e-12);
    spec.face_width_mm = 2.0;
    assert_eq!(pair(&spec).span(Gear::Pinion), None);
}

/// Balls in two opposite spaces: each touches both flanks of its space, which the outline itself shows; the allowance lets them sink.
#[test]
fn val_dimension_over_balls() {
    for spec in [standard(2.0, [20, 60], 20.0), standard(2.0, [21, 60], 20.0), fzg_a()] {
        let pair = pair(&spec);
        let balls = pair.over_balls(Gear::Pinion).expect("it can be measured");
        let z = f64::from(pair.teeth.pinion.teeth);
        let between = if pair.teeth.pinion.teeth % 2 == 1 { (0.5 * PI / z).cos() } else { 1.0 };
        let centre = 0.5 * (balls.dimension_mm - balls.ball_diameter_mm) / between;
        let outline = outline::polyline(&pair.teeth.pinion, 2000);
        let nearest = outline.iter().map(|[x, y]| x.hypot(y - centre)).fold(f64::INFINITY, f64::min);
        assert!((nearest - 0.5 * balls.ball_diameter_mm).abs() < 2e-6, "{nearest} {balls:?}");
    }
    let mut spec = standard(2.0, [20, 60], 20.0);
    let full = pair(&spec).over_balls(Gear::Pinion).unwrap();
    spec.gears.pinion.tooth_thickness_allowance_mm = -0.1;
    let thinned = pair(&spec).over_balls(Gear::Pinion).unwrap();
    // dM/dE = cos α_t/(sin α_Kt cos β), ISO 21771; α_Kt from the full dimension.
    let alpha_k =
        (pair(&spec).teeth.pinion.involute.base_radius_mm / (0.5 * (full.dimension_mm - full.ball_diameter_mm))).acos();
    let slope = 20f64.to_radians().cos() / alpha_k.sin();
    assert_close("change", full.dimension_mm - thinned.dimension_mm, 0.1 * slope, 2e-2);
    assert!(inv(alpha_k) > 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever pair is accepted has a path of contact on both flanks, and no tip in a fillet by more than rounding.
    #[test]
    fn prop_paths_lie_on_the_flanks(
        teeth in prop::array::uniform2(8u32..100),
        angle in 14.5..35.0_f64,
        shifts in prop::array::uniform2(-0.5..0.8_f64),
        apart in 0.0..0.1_f64,
    ) {
        let mut spec = standard(1.0, teeth, angle);
        spec.gears.pinion.profile_shift = shifts[0];
        spec.gears.wheel.profile_shift = shifts[1];
        let room = std::f64::consts::FRAC_PI_4 - 1.25 * angle.to_radians().tan();
        spec.rack.fillet_radius_factor = (room / (1.0 / angle.to_radians().cos() - angle.to_radians().tan())).clamp(0.0, 0.38);
        if let Ok(centre) = spec.centre_distance_with_mm(gearwear_bodies::gear::backlash::Backlash::Normal(apart)) {
            spec.centre_distance_mm = centre;
        }
        if let Ok(pair) = GearPair::new(&spec) {
            for gear in Gear::BOTH {
                let tooth = &pair.teeth[gear];
                let [from, to] = [pair.active_start_radius_mm(gear), pair.active_end_radius_mm(gear)];
                prop_assert!(from >= tooth.root_form_radius_mm * (1.0 - 1e-12) && to <= tooth.tip_radius_mm * (1.0 + 1e-12));
                prop_assert!(from < to);
                prop_assert!(pair.fillet_gap_mm(gear, pair.teeth[gear.mate()].tip_radius_mm) >= -1e-4);
            }
        }
    }
}
