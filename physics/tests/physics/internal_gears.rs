//! Pairs with an internal wheel: published geometry, generated teeth turned through the mesh, the limit of a rack, contact after Hertz.

use std::f64::consts::PI;

use nalgebra::Vector2;

use gearwear_bodies::gear::{
    Gear, GearPair, PairError, PerGear,
    backlash::Backlash,
    internal_error::InternalError,
    outline::{OutlineCurve, outline},
    ring_fillet::{RingSpec, ShaperCutter},
    spec::{GearSpec, PairSpec},
    tooth::Tooth,
};
use gearwear_physics::contact::hertz;

use super::common::{Scene, assert_close, fzg_c, fzg_c_scene, gear, pair, spur, steel};

/// An internal wheel by teeth, shift (positive towards the tips) and tip diameter, both as magnitudes.
fn ring(teeth: u32, profile_shift: f64, tip_diameter_mm: Option<f64>) -> GearSpec {
    let own = gear(teeth, profile_shift, tip_diameter_mm.map(|diameter_mm| -diameter_mm));
    GearSpec { ring: Some(RingSpec::default()), ..own }
}

/// An internal pair without backlash.
fn tight(module_mm: f64, pinion: GearSpec, wheel: GearSpec) -> PairSpec {
    let mut spec = spur(module_mm, f64::NAN, 20.0, pinion, wheel);
    spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(0.0)).unwrap();
    spec
}

/// SDP/SI, *Elements of Metric Gear Technology* (D785), Table 5-1; KHK, *Gear Technical Reference*, section 4.2. Its shift of the wheel, 0.5, is positive away
/// from the tips.
fn of_khk() -> PairSpec {
    tight(3.0, gear(16, 0.0, Some(54.0)), ring(24, -0.5, Some(69.0)))
}

/// A planet in its ring, with room for the tips.
fn planet_in_ring() -> PairSpec {
    let mut spec = tight(3.0, gear(20, 0.3, None), ring(60, -0.3, Some(176.2)));
    spec.gears.wheel.ring = Some(RingSpec { cutter: Some(CUTTER), root_diameter_mm: None });
    spec
}

const CUTTER: ShaperCutter =
    ShaperCutter { teeth: 25, profile_shift: 0.1, addendum_factor: 1.25, tip_rounding_factor: 0.2 };

/// Published figures to their printed digits.
#[track_caller]
fn assert_printed(what: &str, found: f64, printed: f64, digits: i32) {
    let half_a_digit = 0.5001 * 10f64.powi(-digits);
    assert!((found - printed).abs() <= half_a_digit, "{what}: {found}, printed {printed}");
}

#[test]
fn val_table_of_a_gear_maker() {
    let spec = of_khk();
    assert_printed("a", spec.centre_distance_mm.abs(), 13.1683, 4);
    let pair = pair(&spec);
    assert_printed("alpha_w", pair.working_pressure_angle_rad.to_degrees(), 31.0937, 3);
    for (gear, base, working, root) in [(Gear::Pinion, 45.105, 52.673, 40.5), (Gear::Wheel, 67.658, 79.010, 82.5)] {
        let tooth = &pair.teeth[gear];
        assert_printed("d_b", 2.0 * tooth.involute.base_radius_mm.abs(), base, 3);
        assert_printed("d_w", 2.0 * pair.working_pitch_radius_mm(gear).abs(), working, 3);
        assert_printed("d_f", 2.0 * tooth.root_radius_mm.abs(), root, 1);
    }
}

/// bolsover/UtilitiesForAlibre (revision f871250), unit tests of its calculators of internal spur and helical pairs: the pair above again, and 16/24 of module 3 with
/// helix angles of 30° and 10°. Its shift too is positive away from the tips, and of the transverse module in centre distances. Its contact ratios, reaching beyond
/// T1, and diameters of shifted helical gears, with the same shift of the normal module, are not compared.
#[test]
fn val_tests_of_a_cad_tool() {
    let spur_pair = pair(&of_khk());
    assert_printed("d_b", 2.0 * spur_pair.teeth.pinion.involute.base_radius_mm, 45.1052, 4);
    assert_printed("d_w", 2.0 * spur_pair.working_pitch_radius_mm(Gear::Pinion), 52.6731, 3);
    assert_printed("d_w", 2.0 * spur_pair.working_pitch_radius_mm(Gear::Wheel).abs(), 79.0097, 3);

    let helical = |helix_deg: f64, transverse_shift: f64| {
        let shift = transverse_shift / helix_deg.to_radians().cos();
        let mut spec = spur(3.0, f64::NAN, 20.0, gear(16, 0.0, None), ring(24, -shift, None));
        spec.helix_angle_rad = helix_deg.to_radians();
        spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(0.0)).unwrap();
        spec
    };
    let spec = helical(30.0, 0.042633);
    assert_printed("a", spec.centre_distance_mm.abs(), 14.0, 3);
    assert_printed("alpha_t", spec.transverse_pressure_angle_rad().to_degrees(), 22.79588, 4);
    assert_printed("overlap ratio", spec.overlap_ratio(), 1.0610, 4);
    let mut base_mm = 0.0;
    for (gear, reference, base, tip) in
        [(Gear::Pinion, 55.4256, 51.0963, 61.4256), (Gear::Wheel, 83.1384, 76.6445, -77.3942)]
    {
        assert_printed("d", 2.0 * spec.reference_radius_mm(gear).abs(), reference, 3);
        let tooth = Tooth::new(&spec, gear, 0.5 * tip).unwrap();
        assert_printed("d_b", 2.0 * tooth.involute.base_radius_mm.abs(), base, 3);
        base_mm -= tooth.involute.base_radius_mm;
    }
    assert_printed("alpha_wt", (base_mm / spec.centre_distance_mm.abs()).acos().to_degrees(), 24.1558, 3);

    let spec = helical(10.0, 0.0);
    assert_printed("a", spec.centre_distance_mm.abs(), 12.1852, 3);
    for (gear, root) in [(Gear::Pinion, 41.2404), (Gear::Wheel, 80.611)] {
        assert_printed("d_f", 2.0 * spec.root_radius_mm(gear).abs(), root, 3);
    }
}

/// Spreadsheet "Centre distance of profile shifted internal gear calculation" (scribd.com/doc/92821234): 17/96, m = 14 mm, shifts 0.2 and 0.5, the wheel's positive
/// away from the tips.
#[test]
fn val_centre_distance_of_a_spreadsheet() {
    let spec = tight(14.0, gear(17, 0.2, None), ring(96, -0.5, None));
    assert_printed("a", spec.centre_distance_mm.abs(), 557.0887, 4);
    let base_mm = 0.5 * 14.0 * 79.0 * 20f64.to_radians().cos();
    assert_printed("alpha_w", (base_mm / spec.centre_distance_mm.abs()).acos().to_degrees(), 21.1251, 4);
}

/// L. Kos, *Analysis of Planetary Transmissions*, test run (lecad.uni-lj.si/~leon/FS/PlanetryTransmissions): planet 43, ring −108, m = 1.75 mm.
#[test]
fn val_planet_and_ring_of_a_planetary_gear() {
    let spec = tight(1.75, gear(43, 0.0426, Some(78.817)), ring(108, 0.0, Some(185.4992)));
    assert_printed("a", spec.centre_distance_mm.abs(), 56.8, 3);
    assert_printed("d", 2.0 * spec.reference_radius_mm(Gear::Wheel), -189.0, 4);
    assert_printed("d, planet", 2.0 * spec.reference_radius_mm(Gear::Pinion), 75.25, 4);
}

/// Planet and ring of a stage as a gear program reports them, lengths in mm.
struct ReportedStage {
    module_mm: f64,
    centre_mm: f64,
    /// Numbers of teeth of planet, ring and shaper cutter.
    teeth: [u32; 3],
    /// Root diameters, which have one digit more of the profile shifts than are printed.
    roots_mm: [f64; 2],
    tips_mm: [f64; 2],
    working_angle_deg: f64,
    bases_mm: [f64; 2],
    working_mm: [f64; 2],
    /// Root form diameters.
    forms_mm: [f64; 2],
    /// Diameters of the starts of active profile.
    starts_mm: [f64; 2],
    /// Arc thicknesses on the reference circles.
    thicknesses_mm: [f64; 2],
    tip_thicknesses_mm: [f64; 2],
    /// Radii of curvature of the planet at A, B, C, D, E.
    path_mm: [f64; 5],
    contact_ratio: f64,
    /// Teeth and length of the planet's span.
    span: (u32, f64),
    /// Diameter of balls and dimension over or between them.
    balls_mm: [[f64; 2]; 2],
}

/// Reports of KISSsoft 03/2017 (ISO 21771:2007) of both planetary stages of the NREL 5 MW gearbox, public repository gfsReboucas/Drivetrain (revision 4a88df34).
/// Its points A to E are those of the planet driven by the ring, and it cuts the ring to the root circle of the basic rack, from which the addendum of the cutter follows.
const REPORTED_STAGES: [ReportedStage; 2] = [
    ReportedStage {
        module_mm: 45.0,
        centre_mm: 863.0,
        teeth: [17, 56, 36],
        roots_mm: [724.692, 2677.618],
        tips_mm: [905.470, 2475.118],
        working_angle_deg: 17.161,
        bases_mm: [718.865, 2368.025],
        working_mm: [752.359, 2478.359],
        forms_mm: [748.795, 2662.682],
        starts_mm: [749.170, 2594.369],
        thicknesses_mm: [96.962, 54.264],
        tip_thicknesses_mm: [26.588, 38.407],
        path_mm: [105.462, 142.431, 110.993, 238.308, 275.277],
        contact_ratio: 1.278,
        span: (3, 367.520),
        balls_mm: [[110.0, 1008.755], [80.0, -2445.378]],
    },
    ReportedStage {
        module_mm: 21.0,
        centre_mm: 584.0,
        teeth: [36, 93, 30],
        roots_mm: [724.663, 2000.581],
        tips_mm: [815.663, 1906.081],
        working_angle_deg: 15.630,
        bases_mm: [710.408, 1835.220],
        working_mm: [737.684, 1905.684],
        forms_mm: [737.389, 1987.879],
        starts_mm: [738.082, 1969.750],
        thicknesses_mm: [40.689, 34.777],
        tip_thicknesses_mm: [14.858, 18.937],
        path_mm: [100.108, 138.396, 99.372, 162.102, 200.391],
        contact_ratio: 1.618,
        span: (5, 296.803),
        balls_mm: [[40.0, 836.492], [35.0, -1900.511]],
    },
];

/// Two digits in the third place: half a digit of the figure, and what half a digit of the printed root diameters, tips and centre distance moves it by.
#[track_caller]
fn assert_reported(what: &str, found: f64, reported: f64) {
    assert!((found - reported).abs() <= 2e-3, "{what}: {found}, reported {reported}");
}

#[test]
fn val_planets_and_rings_of_a_gear_program() {
    for stage in REPORTED_STAGES {
        let ReportedStage { module_mm, teeth: [z_planet, z_ring, z_cutter], roots_mm, tips_mm, .. } = stage;
        let shift_of = |z: f64, root_mm: f64| 0.5 * (root_mm / module_mm - z) + 1.25;
        let x_planet = shift_of(f64::from(z_planet), roots_mm[0]);
        let x_ring = shift_of(-f64::from(z_ring), -roots_mm[1]);
        let cut_by = |addendum_factor: f64| {
            let mut wheel = ring(z_ring, x_ring, Some(tips_mm[1]));
            let cutter =
                ShaperCutter { teeth: z_cutter, profile_shift: 0.0, addendum_factor, tip_rounding_factor: 0.3 };
            wheel.ring = Some(RingSpec { cutter: Some(cutter), root_diameter_mm: None });
            tight(module_mm, gear(z_planet, x_planet, Some(tips_mm[0])), wheel)
        };
        let missing_mm = 0.5 * roots_mm[1] + cut_by(1.25).root_radius_mm(Gear::Wheel);
        let mut spec = cut_by(1.25 + missing_mm / module_mm);
        assert_reported("a", spec.centre_distance_mm.abs(), stage.centre_mm);
        spec.face_width_mm = 500.0;
        let pair = pair(&spec);
        assert_reported("alpha_w", pair.working_pressure_angle_rad.to_degrees(), stage.working_angle_deg);
        for (k, gear) in Gear::BOTH.into_iter().enumerate() {
            let tooth = &pair.teeth[gear];
            let diameter = |radius_mm: f64| 2.0 * radius_mm.abs();
            assert_reported("d_b", diameter(tooth.involute.base_radius_mm), stage.bases_mm[k]);
            assert_reported("d_w", diameter(pair.working_pitch_radius_mm(gear)), stage.working_mm[k]);
            assert_reported("d_f", diameter(tooth.root_radius_mm), roots_mm[k]);
            assert_reported("d_Ff", diameter(tooth.root_form_radius_mm), stage.forms_mm[k]);
            assert_reported("d_Nf", diameter(pair.active_start_radius_mm(gear)), stage.starts_mm[k]);
            assert_reported("s_n", tooth.thickness_mm(tooth.reference_radius_mm), stage.thicknesses_mm[k]);
            assert_reported("s_an", tooth.thickness_mm(tooth.tip_radius_mm), stage.tip_thicknesses_mm[k]);
            let [ball_mm, over_mm] = stage.balls_mm[k];
            assert_reported("M_dK", pair.dimension_over_balls_mm(gear, ball_mm).unwrap(), over_mm);
        }
        for (found_mm, reported_mm) in pair.path.points_mm().into_iter().zip(stage.path_mm) {
            assert_reported("path", found_mm, reported_mm);
        }
        assert_printed("contact ratio", pair.path.contact_ratio(), stage.contact_ratio, 3);
        let span = pair.span(Gear::Pinion).unwrap();
        assert_eq!(span.teeth, stage.span.0);
        assert_reported("W_k", span.span_mm, stage.span.1);
    }
}

/// Load comes in at once where the tip circles part only if teeth approach by the gap that is left there.
#[test]
fn ver_tips_meet_where_their_circles_part() {
    let planet = pair(&planet_in_ring());
    assert_eq!(planet.tips_meet_mm(100.0), planet.farthest_touch_mm().map(Some));
    assert_eq!(planet.tips_meet_mm(0.0), [None; 2]);
    assert_eq!(pair(&fzg_c()).tips_meet_mm(0.02), [None; 2]);
}

/// standardsapplied.com, *Internal Ring Gear Design*: 72 teeth, diametral pitch 8, 20°, cutter with 32 teeth; inches.
#[test]
fn val_ring_of_a_calculator() {
    let inch = 25.4;
    let wheel = ring(72, 0.0, Some(8.75 * inch));
    let spec = tight(inch / 8.0, gear(32, 0.0, None), wheel);
    let tooth = Tooth::new(&spec, Gear::Wheel, spec.tip_radius_mm(Gear::Wheel)).unwrap();
    assert_printed("d", 2.0 * tooth.reference_radius_mm.abs() / inch, 9.0, 5);
    assert_printed("d_b", 2.0 * tooth.involute.base_radius_mm.abs() / inch, 8.45723, 5);
    assert_printed("d_f", 2.0 * tooth.root_radius_mm.abs() / inch, 9.3125, 5);
    assert_printed("s", tooth.thickness_mm(tooth.reference_radius_mm) / inch, 0.19635, 5);
    assert_printed("s_a", tooth.thickness_mm(tooth.tip_radius_mm) / inch, 0.11281, 5);
    let roll_deg =
        |radius_mm: f64| tooth.involute.roll_angle_rad(tooth.involute.curvature_radius_mm(radius_mm)).to_degrees();
    assert_printed("roll at the tip", roll_deg(tooth.tip_radius_mm), 15.21, 2);
    assert_printed("roll at the reference circle", roll_deg(tooth.reference_radius_mm), 20.85, 2);
}

/// Half of a space of a gear as a polyline of radius and angle from the space's centre line, both as magnitudes, from root to tip.
fn half_space_of(tooth: &Tooth, points: usize) -> Vec<[f64; 2]> {
    let segments = outline(tooth);
    let of = |curve: OutlineCurve| {
        let segment = *segments.iter().find(|segment| segment.curve == curve).unwrap();
        (0..=points).map(move |k| {
            let point = segment.point_mm(k as f64 / points as f64);
            [point.norm(), point.x.abs().atan2(point.y.abs())]
        })
    };
    of(OutlineCurve::Fillet).chain(of(OutlineCurve::Flank)).collect()
}

/// Angle of a half space at a radius; `None` beside the polyline, which runs outside in on an internal gear.
fn angle_at(space: &[[f64; 2]], radius_mm: f64) -> Option<f64> {
    let after = space.partition_point(|[radius, _]| *radius > radius_mm);
    let ([r0, t0], [r1, t1]) = (*space.get(after.checked_sub(1)?)?, *space.get(after)?);
    Some(t0 + (t1 - t0) * (radius_mm - r0) / (r1 - r0))
}

/// Least gap, along circles about the wheel's axis, of the outlines of a pair turned through the mesh: pinion by `turned_rad` from contact at the pitch point, wheel in
/// the ratio of the numbers of teeth. Knows the outlines and nothing of their contact.
fn least_gap_mm(pair: &GearPair, wheel_space: &[[f64; 2]], pinion_tooth: &[[f64; 2]], turned_rad: f64) -> f64 {
    let PerGear { pinion, wheel } = &pair.teeth;
    let centre_mm = pair.spec.centre_distance_mm.abs();
    let pitch_mm = PerGear::from_fn(|gear| pair.working_pitch_radius_mm(gear).abs());
    // Clockwise flank of the pinion's tooth and of the wheel's space on the line of centres, +y.
    let tooth_at_pitch = pinion.half_angle_rad(pitch_mm.pinion);
    let space_at_pitch = angle_at(wheel_space, pitch_mm.wheel).unwrap();
    let wheel_pitch = 2.0 * PI / f64::from(wheel.teeth);
    let ratio = f64::from(pinion.teeth) / f64::from(wheel.teeth);
    let mut least = f64::INFINITY;
    for tooth in -3..=3 {
        let centre = f64::from(tooth) * 2.0 * PI / f64::from(pinion.teeth) - tooth_at_pitch + turned_rad;
        for [radius, half_angle] in pinion_tooth {
            for side in [-1.0, 1.0] {
                let angle = centre + side * half_angle;
                let point = Vector2::new(radius * angle.sin(), centre_mm + radius * angle.cos());
                let seen = point.x.atan2(point.y) - (turned_rad * ratio - space_at_pitch);
                let from_middle = seen - wheel_pitch * (seen / wheel_pitch).round();
                if let Some(room) = angle_at(wheel_space, point.norm()) {
                    least = least.min(point.norm() * (room - from_middle.abs()));
                }
            }
        }
    }
    least
}

/// Teeth of ring and pinion, turned through two pitches, touch without gap or overlap: 0 ± 0.01 µm, with cutter and with circular fillet, with and without
/// backlash.
#[test]
fn ver_generated_teeth_are_conjugate() {
    let mut with_backlash = planet_in_ring();
    with_backlash.centre_distance_mm = with_backlash.centre_distance_with_mm(Backlash::Circumferential(0.2)).unwrap();
    let circular = PairSpec {
        gears: PerGear { wheel: ring(60, -0.3, Some(176.2)), ..planet_in_ring().gears },
        ..planet_in_ring()
    };
    for spec in [planet_in_ring(), circular, with_backlash, of_khk()] {
        let pair = pair(&spec);
        let wheel_space = half_space_of(&pair.teeth.wheel, 20_000);
        let tooth = &pair.teeth.pinion;
        let (form, tip) = (tooth.root_form_radius_mm, tooth.tip_radius_mm);
        let pinion_tooth: Vec<[f64; 2]> = (0..=4000)
            .map(|k| form + (tip - form) * f64::from(k) / 4000.0)
            .map(|radius| [radius, tooth.half_angle_rad(radius)])
            .collect();
        for k in 0..16 {
            let turned_rad = (f64::from(k) / 8.0 - 1.0) * 2.0 * PI / f64::from(tooth.teeth);
            let gap_mm = least_gap_mm(&pair, &wheel_space, &pinion_tooth, turned_rad);
            assert!(gap_mm.abs() < 1e-5, "{turned_rad}: {gap_mm} mm");
        }
    }
}

/// Half angle of a tooth of the cutter at a radius, from the thickness of its teeth at the reference circle.
fn cutter_half_angle(module_mm: f64, radius_mm: f64) -> f64 {
    let inv = |angle: f64| angle.tan() - angle;
    let (alpha, reference_mm) = (20f64.to_radians(), 0.5 * module_mm * f64::from(CUTTER.teeth));
    let thickness_mm = module_mm * (0.5 * PI + 2.0 * CUTTER.profile_shift * alpha.tan());
    0.5 * thickness_mm / reference_mm + inv(alpha) - inv((reference_mm * alpha.cos() / radius_mm).acos())
}

/// Half of the outline of a cutter tooth with its centre line on +y: involute, and rounding by the circle of that radius that touches tip circle and involute, found by
/// bisection of the distance of its centre from the involute.
fn cutter_outline(module_mm: f64) -> Vec<Vector2<f64>> {
    let reference_mm = 0.5 * module_mm * f64::from(CUTTER.teeth);
    let (base_mm, tip_mm) = (
        reference_mm * 20f64.to_radians().cos(),
        reference_mm + module_mm * (CUTTER.addendum_factor + CUTTER.profile_shift),
    );
    let rounding_mm = CUTTER.tip_rounding_factor * module_mm;
    let flank: Vec<Vector2<f64>> = (0..=4000)
        .map(|k| base_mm + (tip_mm - base_mm) * f64::from(k) / 4000.0)
        .map(|radius| (radius, cutter_half_angle(module_mm, radius)))
        .map(|(radius, angle)| radius * Vector2::new(angle.sin(), angle.cos()))
        .collect();
    let nearest = |centre: Vector2<f64>| {
        let distances = flank.iter().map(|point| (point - centre).norm()).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    };
    let centre_at = |angle: f64| (tip_mm - rounding_mm) * Vector2::new(angle.sin(), angle.cos());
    let (mut inside, mut outside) = (0.0, cutter_half_angle(module_mm, tip_mm - rounding_mm));
    for _ in 0..50 {
        let middle = 0.5 * (inside + outside);
        if nearest(centre_at(middle)).1 > rounding_mm { inside = middle } else { outside = middle }
    }
    let centre = centre_at(inside);
    let (last, _) = nearest(centre);
    let towards = flank[last] - centre;
    let (from, to) = (towards.x.atan2(towards.y), inside);
    let arc = (0..=400)
        .map(|k| from + (to - from) * f64::from(k) / 400.0)
        .map(|angle| centre + rounding_mm * Vector2::new(angle.sin(), angle.cos()));
    flank[..=last].iter().copied().chain(arc).collect()
}

/// The cutter, rolled through the ring, leaves the ring's fillet and flank: no point of it beyond them by more than 0.01 µm, and everywhere one within 0.3 µm, as
/// far as its steps let it.
#[test]
fn ver_a_rolling_cutter_leaves_the_outline() {
    let pair = pair(&planet_in_ring());
    let (module_mm, wheel) = (pair.spec.normal_module_mm, &pair.teeth.wheel);
    let space = half_space_of(wheel, 3000);
    // Distance of the axes at which a tooth of the cutter fills a space on the pitch circles.
    let inv = |angle: f64| angle.tan() - angle;
    let alpha = 20f64.to_radians();
    let (z, z_0) = (f64::from(wheel.teeth), f64::from(CUTTER.teeth));
    let shifts = pair.spec.gears.wheel.profile_shift + CUTTER.profile_shift;
    let working = gearwear_bodies::gear::involute::inverse_inv(inv(alpha) + 2.0 * alpha.tan() * shifts / (z_0 - z));
    let centre_mm = 0.5 * module_mm * (z - z_0) * alpha.cos() / working.cos();
    let cutter = cutter_outline(module_mm);
    let mut beyond = vec![f64::NEG_INFINITY; space.len()];
    for step in -8000..=8000 {
        let rolled = f64::from(step) / 8000.0 * 0.6;
        let turn = rolled - rolled * z_0 / z;
        let (sin, cos) = rolled.sin_cos();
        for point in &cutter {
            let seen = point + centre_mm * Vector2::new(sin, cos);
            let (radius, angle) = (seen.norm(), seen.x.atan2(seen.y) - turn);
            let after = space.partition_point(|[own, _]| *own > radius);
            let (Some(before), Some([r1, t1])) = (after.checked_sub(1), space.get(after)) else { continue };
            let [r0, t0] = space[before];
            if r0 == *r1 {
                continue;
            }
            let room = t0 + (t1 - t0) * (radius - r0) / (r1 - r0);
            // Normal to the outline instead of along the circle.
            let slope = (r0 - r1) / (r0 - r1).hypot(radius * (t1 - t0));
            beyond[before] = beyond[before].max(radius * (angle - room) * slope);
        }
    }
    let reached: Vec<f64> = beyond.into_iter().filter(|own| own.is_finite()).collect();
    let greatest = reached.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = reached.iter().copied().fold(f64::INFINITY, f64::min);
    println!("{} of {} pieces, from {least:.2e} to {greatest:.2e} mm", reached.len(), space.len());
    assert!(greatest < 1e-5 && least > -3e-4, "{least} to {greatest} mm");
}

/// With a million teeth an internal and an external wheel are the same rack: path of contact, loads and pressures within 0.1 %.
#[test]
fn ver_internal_and_external_wheels_meet_the_same_rack() {
    let teeth = 1_000_000;
    let rack = |wheel: GearSpec| {
        let mut spec = spur(4.5, f64::NAN, 14.0, gear(20, 0.2, None), wheel);
        spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(0.0)).unwrap();
        Scene { pair: spec, surface: "hertz", revolutions: 1.0, steps: 1.0, ..fzg_c_scene() }
    };
    let [internal, external] = [ring(teeth, 0.0, None), gear(teeth, 0.0, None)].map(rack);
    let [ours, theirs] = [&internal, &external].map(|scene| pair(&scene.pair).path);
    assert_close("contact ratio", ours.contact_ratio(), theirs.contact_ratio(), 1e-3);
    assert_close("A", ours.start_mm, theirs.start_mm, 1e-3);
    let [ours, theirs] = [internal, external].map(|scene| scene.run().new.cycle);
    for (one, other) in ours.positions.iter().zip(&theirs.positions) {
        let what = |quantity: &str| format!("{quantity} at {:.3}", one.position_mm);
        assert_close(&what("load"), one.load_share, other.load_share, 1e-3);
        assert_close(&what("peak"), one.footprint.peak_pressure_mpa, other.footprint.peak_pressure_mpa, 1e-3);
        assert_close(&what("width"), one.footprint.half_width_mm, other.footprint.half_width_mm, 1e-3);
    }
}

/// Contact of a convex and a concave flank on half-planes has Hertz's pressure and half-width a millimetre away from the tips: 1/R = 1/ρ1 − 1/|ρ2|.
#[test]
fn val_conformal_flanks_touch_as_hertz_says() {
    let scene = Scene {
        pair: PairSpec { face_width_mm: 14.0, ..planet_in_ring() },
        torque_n_mm: 50e3,
        surface: "half-space",
        revolutions: 1.0,
        steps: 1.0,
        ..fzg_c_scene()
    };
    let gears = pair(&scene.pair);
    for at in &scene.run().new.cycle.positions {
        if at.position_mm < gears.path.start_mm + 1.0 || at.position_mm > gears.path.end_mm - 1.0 {
            continue;
        }
        let [rho_1, rho_2] = Gear::BOTH.map(|gear| gears.path.rho_mm(gear, at.position_mm).abs());
        let load = at.load_share * scene.line_load();
        let strip = hertz::flattening(&gears, &steel(), at.position_mm).contact.loaded(load);
        let radius_mm = 1.0 / (1.0 / rho_1 - 1.0 / rho_2);
        let by_hand_mm = (4.0 * load * radius_mm / (PI * 206e3 / (2.0 * (1.0 - 0.3 * 0.3)))).sqrt();
        let what = |quantity| format!("{quantity} at {:.3}", at.position_mm);
        assert_close(&what("Hertz"), strip.half_width_mm, by_hand_mm, 1e-9);
        assert_close(&what("peak"), at.footprint.peak_pressure_mpa, strip.peak_pressure_mpa, 5e-3);
        assert_close(&what("half-width"), at.footprint.half_width_mm, strip.half_width_mm, 1e-2);
    }
}

/// The same wear coefficient takes the same volume off both flanks, whatever their curvature.
#[test]
fn ver_both_flanks_lose_the_same_volume() {
    let scene = Scene { pair: planet_in_ring(), surface: "half-space", tip_contact: true, ..fzg_c_scene() };
    let gears = pair(&scene.pair);
    let outcome = scene.run();
    let [pinion, wheel] =
        Gear::BOTH.map(|gear| gears.over_all_flanks(gear, outcome.grid[gear].integral(&outcome.worn.wear_mm[gear])));
    assert_close("volumes", pinion, wheel, 1e-2);
}

fn refused(spec: &PairSpec) -> InternalError {
    match GearPair::new(spec) {
        Err(PairError::Internal(error)) => error,
        other => panic!("{other:?}"),
    }
}

/// Interferences with the figures of their equations (KHK, section 4.2).
#[test]
fn impossible_pairs_are_refused() {
    // Involute interference: the tip of a ring without shortened teeth reaches below the base circle of a small pinion.
    let InternalError::InvoluteInterference { of, overlap_mm } =
        refused(&tight(3.0, gear(12, 0.0, None), ring(60, 0.0, None)))
    else {
        panic!("involute interference");
    };
    assert!(of.ratio < of.limit && overlap_mm > 0.0 && of.tip_diameter_mm < of.least_tip_diameter_mm, "{of:?}");
    // Trochoidal interference: few teeth between pinion and ring.
    let spec = tight(3.0, gear(55, 0.0, None), ring(60, 0.0, None));
    let InternalError::TrochoidalInterference { overlap_mm, greatest_pinion_tip_mm } = refused(&spec) else {
        panic!("trochoidal interference");
    };
    assert!(overlap_mm > 0.0);
    let mut mended = spec;
    mended.gears.pinion.tip_diameter_mm = Some(greatest_pinion_tip_mm - 1e-4);
    assert!(!matches!(GearPair::new(&mended), Err(PairError::Internal(InternalError::TrochoidalInterference { .. }))));
    assert!(matches!(
        refused(&tight(3.0, gear(20, 0.3, None), ring(60, -0.3, Some(169.0)))),
        InternalError::TipInsideBase { .. }
    ));
    let mut close = planet_in_ring();
    close.centre_distance_mm -= 0.5;
    assert!(matches!(refused(&close), InternalError::NegativeBacklash { .. }));
    close.centre_distance_mm = -50.0;
    assert!(matches!(refused(&close), InternalError::NoMesh { .. }));
    assert!(matches!(
        refused(&spur(3.0, -10.0, 20.0, gear(60, 0.0, None), ring(60, 0.0, None))),
        InternalError::Teeth { .. }
    ));
    let mut cut = planet_in_ring();
    cut.gears.wheel.ring =
        Some(RingSpec { cutter: Some(ShaperCutter { teeth: 60, ..CUTTER }), root_diameter_mm: None });
    assert!(matches!(refused(&cut), InternalError::CutterTeeth { most: 59, .. }));
    cut.gears.wheel.ring =
        Some(RingSpec { cutter: Some(ShaperCutter { tip_rounding_factor: 0.9, ..CUTTER }), root_diameter_mm: None });
    assert!(matches!(refused(&cut), InternalError::CutterTip { greatest, .. } if (0.2..0.9).contains(&greatest)));
}
