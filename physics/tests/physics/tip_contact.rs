//! Contact at tip edges before A and after E.

use gearwear_bodies::gear::{
    Gear, GearPair, conjugate::ConjugateFlanks, flank_edge::PathEnd, removed_material::tip_edge_mm,
};
use gearwear_bodies::gear_fem::placement::{axis_mm, tooth_angle_rad};
use gearwear_physics::contact::{
    edge_foundation::EdgeFoundations,
    foundation::{FoundationCurve, half_width_mm, matched_mpa_per_mm},
    hertz,
    settings::MatchCriterion,
};
use gearwear_physics::mesh_cycle::PositionObservation;
use gearwear_physics::simulation::settings::Stepping;
use gearwear_physics::simulation::wear_run::Outcome;
use gearwear_physics::stiffness::settings::StiffnessSettings;
use nalgebra::{Rotation2, Vector2};

use super::common::{Scene, assert_close, fzg_c, fzg_c_scene, pair, steel};

/// 302 N·m over base radius and face width.
const LINE_LOAD_N_PER_MM: f64 = 637.66;

/// fzg-c at 302 N·m with tip roundings of 0.1 mm and Weber and Banaschek's teeth; one mesh.
fn rounded(surface: &'static str) -> Scene {
    let mut scene = Scene {
        surface,
        stiffness: StiffnessSettings::WeberBanaschek,
        revolutions: 1.0,
        steps: 1.0,
        tip_contact: true,
        ..fzg_c_scene()
    };
    scene.pair.gears.pinion.modification.tip_rounding_mm = 0.1;
    scene.pair.gears.wheel.modification.tip_rounding_mm = 0.1;
    scene
}

/// The tip edge leaves the mate's flank with the square of the path: along = s ρ₂/r_b2, gap = along²/2R, within the first tenth
/// of a millimetre of path, where curvatures are those at A and E.
#[test]
fn ver_tip_edges_leave_with_the_square_of_the_path() {
    let pair = pair(&fzg_c_scene().pair);
    let path = &pair.path;
    let of_gap = |tip_of: Gear, end: f64, gap: f64| {
        let radius = pair.relative_radius_mm(end);
        (2.0 * radius * gap).sqrt() * path.involute[tip_of].base_radius_mm / path.rho_mm(tip_of, end)
    };
    let gap = 2e-4;
    let [before, after] = pair.tip_reach_mm(gap);
    // Steps of a thousandth of a base pitch, 0.013 mm.
    assert!((before - of_gap(Gear::Wheel, path.start_mm, gap)).abs() < 0.02, "{before}");
    assert!((after - of_gap(Gear::Pinion, path.end_mm, gap)).abs() < 0.02, "{after}");
    assert_eq!(pair.tip_reach_mm(-1.0), [0.0; 2]);
    // As far as the tip circles reach each other.
    let [farthest, most] = [pair.farthest_touch_mm(), pair.tip_reach_mm(1e3)];
    assert!(most.iter().zip(farthest).all(|(most, farthest)| (0.0..0.014).contains(&(farthest - most))), "{most:?}");
}

fn share_at(positions: &[PositionObservation], at_mm: f64) -> f64 {
    let after = positions.partition_point(|p| p.position_mm <= at_mm).clamp(1, positions.len() - 1);
    let (low, high) = (&positions[after - 1], &positions[after]);
    let weight = (at_mm - low.position_mm) / (high.position_mm - low.position_mm);
    low.load_share + weight * (high.load_share - low.load_share)
}

/// Load shares of the finite-element pair with the same tip roundings at A, B, D and E: 0.40, 0.59, 0.60 and 0.41; the next pair
/// touches 0.8 mm of path before A (gearwear fem of this scene).
#[test]
fn val_loads_are_shared_as_finite_elements_share_them() {
    for surface in ["winkler", "half-space"] {
        let scene = rounded(surface);
        let outcome = scene.run();
        let positions = &outcome.new.cycle.positions;
        let path = pair(&scene.pair).path;
        for (at, expected) in [
            (path.start_mm, 0.40),
            (path.lower_single_contact_mm(), 0.59),
            (path.upper_single_contact_mm(), 0.60),
            (path.end_mm, 0.41),
        ] {
            let share = share_at(positions, at);
            assert!((share - expected).abs() < 0.025, "{surface} at {at:.3}: {share} against {expected}");
        }
        // The reference pair alone carries everything until the pair behind it, a base pitch before, touches.
        let alone = positions.iter().rev().find(|p| p.load_share > 0.9999).unwrap().position_mm;
        let before_a = path.start_mm - (alone - path.base_pitch_mm);
        assert!((before_a - 0.8).abs() < 0.1, "{surface}: {before_a}");
    }
}

/// No load jumps any more where the number of pairs changes, nor does the transmission error: twice the positions, half the
/// steps between neighbours.
#[test]
fn loads_change_without_jumps() {
    let greatest_steps = |scene: &Scene| {
        let positions = scene.run().new.cycle.positions;
        [|p: &PositionObservation| p.load_share, |p: &PositionObservation| p.transmission_error_mm]
            .map(|of| positions.windows(2).map(|two| (of(&two[1]) - of(&two[0])).abs()).fold(0.0, f64::max))
    };
    for surface in ["winkler", "half-space"] {
        let ratios = |tip_contact| {
            let coarse = Scene { tip_contact, ..rounded(surface) };
            let fine = Scene { positions: 2 * coarse.positions, ..coarse.clone() };
            let (coarse, fine) = (greatest_steps(&coarse), greatest_steps(&fine));
            [0, 1].map(|of| coarse[of] / fine[of])
        };
        for (with, without) in ratios(true).into_iter().zip(ratios(false)) {
            assert!((1.8..2.2).contains(&with) && without < 1.1, "{surface}: {with} {without}");
        }
    }
}

/// ∫ w v_s dt over the whole course of a pair, from the rows A–E: outside them the pair carries what the other pair, a base
/// pitch away, does not.
fn asked_mm2(pair: &GearPair, scene: &Scene, outcome: &Outcome) -> f64 {
    let positions = &outcome.new.cycle.positions;
    let path = &pair.path;
    let pitch = path.base_pitch_mm;
    let share = |at: f64| {
        if at < path.start_mm {
            1.0 - share_at(positions, at + pitch)
        } else if at > path.end_mm {
            1.0 - share_at(positions, at - pitch)
        } else {
            share_at(positions, at)
        }
    };
    // Up to where the other pair is alone for sure, by the midpoint rule.
    let (from, to, parts) = (path.start_mm - 2.0, path.end_mm + 2.0, 20_000);
    let step = (to - from) / f64::from(parts);
    let part = |k: i32| {
        let lower = from + f64::from(k) * step;
        let middle = lower + 0.5 * step;
        // The share is that of the torque; after E the force has a shorter lever.
        share(middle) / pair.pinion_lever_ratio(&pair.touch(middle)) * pair.sliding_mm(lower, lower + step)
    };
    (0..parts).map(part).sum::<f64>() * scene.line_load() * scene.coefficient_mm2_per_n
}

/// The exact wear test, contact at the tip edges included: ∫ h ds = k ∫ w v_s dt on each flank.
#[test]
fn val_each_flank_loses_what_load_and_sliding_ask_for() {
    for surface in ["winkler", "half-space"] {
        for rounding_mm in [0.0, 0.1] {
            let mut scene = rounded(surface);
            scene.pair.gears.pinion.modification.tip_rounding_mm = rounding_mm;
            scene.pair.gears.wheel.modification.tip_rounding_mm = rounding_mm;
            if rounding_mm > 0.0 {
                // Winkler's samples are two points apart, and a rounding of 0.1 mm is no parabola of the flank's curvature.
                scene.flank_points = 1500;
            }
            let pair = pair(&scene.pair);
            let outcome = scene.run();
            let asked = asked_mm2(&pair, &scene, &outcome);
            for gear in Gear::BOTH {
                let lost = outcome.grid[gear].integral(&outcome.new.depth_per_mesh_mm[gear]);
                assert_close(&format!("{surface} {rounding_mm} {gear:?}"), lost, asked, 2e-3);
            }
        }
    }
}

/// 128 h: what the tip edges do to their mates' roots is a third more wear there; both surfaces agree on it within 3 %, where springs and half-planes have another
/// pressure at an edge (8.30 µm and 8.52 µm).
#[test]
fn tip_edges_wear_their_mates_roots() {
    let peak = |surface, tip_contact| {
        let scene = Scene { revolutions: 1_149_750.0, steps: 150.0, tip_contact, ..rounded(surface) };
        let outcome = scene.run();
        assert!(outcome.failure.is_none());
        outcome.worn.wear_mm.pinion.iter().copied().fold(0.0, f64::max)
    };
    let [winkler, half_space] = ["winkler", "half-space"].map(|surface| peak(surface, true));
    println!("{winkler:.5} {half_space:.5} mm");
    assert_close("surfaces", half_space, winkler, 0.03);
    assert!(winkler > 1.2 * peak("winkler", false));
}

/// Points far closer together than the positions: the wear of the addenda has no waves as long as the positions are apart. (Gaps read at one
/// place of each position alone make some of 1.6 µm in this life.)
#[test]
fn ver_fine_points_make_no_grooves() {
    let outcome = Scene {
        positions: 200,
        flank_points: 2000,
        revolutions: 1_149_750.0,
        stepping: Some(Stepping::Adaptive { tolerance_mm: 1e-4 }),
        ..rounded("half-space")
    }
    .run();
    assert!(outcome.failure.is_none());
    for gear in Gear::BOTH {
        let wear_mm = &outcome.worn.wear_mm[gear];
        let addendum = &wear_mm[wear_mm.len() * 7 / 10..];
        let greatest = addendum.iter().copied().fold(0.0, f64::max);
        let before_the_edge: Vec<f64> = addendum.iter().copied().take_while(|wear| *wear < greatest).collect();
        // From the least wear on it rises towards the edge: a valley is as deep as wear falls below what it has been since.
        let least = before_the_edge.iter().copied().fold(f64::INFINITY, f64::min);
        let rising = before_the_edge.iter().copied().skip_while(|wear| *wear > least);
        let (_, deepest) = rising.fold((least, 0.0_f64), |(highest, deepest), wear| {
            let highest = highest.max(wear);
            (highest, deepest.max(highest - wear))
        });
        println!("{gear:?}: {:.4} µm", 1e3 * deepest);
        assert!(deepest < 1e-4, "{gear:?}: {deepest}");
    }
}

/// The maximum wear of rounded tip edges hardly depends on the distance of the positions, though the contact on them is narrower than a flank passes it
/// from one position to the next: within 0.2 and 1.6 % at 200 positions of that at 1600 (with a pressure that stands still on the path within
/// a position: 3.8 and 7.0 %), since the pressure goes with the edge.
#[test]
fn ver_rounded_tip_edges_wear_alike_whatever_the_positions() {
    let at = |positions| {
        let outcome = Scene { positions, revolutions: 1e4, steps: 1.0, ..rounded("half-space") }.run();
        Gear::BOTH.map(|gear| {
            let wear_mm = &outcome.worn.wear_mm[gear];
            wear_mm[wear_mm.len() * 9 / 10..].iter().copied().fold(0.0, f64::max)
        })
    };
    let [few, many] = [200, 1600].map(at);
    println!("{few:?} {many:?} mm");
    for (few, many) in few.into_iter().zip(many) {
        assert_close("wear of the tip edge", few, many, 0.02);
    }
}

/// The turn of the pinion, times its base radius, after which its sharp tip edge touches the wheel's involute, on the true profiles:
/// the edge at P is ρ − L behind the flank along the normal through it, with L the tangent from P to the wheel's base circle and
/// ρ the radius of curvature where that normal leaves the flank.
fn exact_touch_mm(pair: &GearPair, position_mm: f64) -> f64 {
    let (pinion, wheel) = (&pair.teeth.pinion, &pair.teeth.wheel);
    let half_angle = pinion.half_angle_rad(pinion.tip_radius_mm);
    let edge = pinion.tip_radius_mm * Vector2::new(-half_angle.sin(), half_angle.cos());
    let turned = |gear| tooth_angle_rad(pair, gear, position_mm, 0);
    let behind = |approach_mm: f64| {
        let further = approach_mm / pinion.involute.base_radius_mm;
        let in_place = Rotation2::new(turned(Gear::Pinion) + further) * edge - axis_mm(pair, Gear::Wheel);
        let in_wheel = Rotation2::new(-turned(Gear::Wheel)) * in_place;
        let rho = wheel.involute.curvature_radius_mm(wheel.nominal_radius_mm(in_wheel));
        rho - wheel.involute.curvature_radius_mm(in_wheel.norm())
    };
    let (mut low, mut high) = (0.0, 0.1);
    let apart = behind(low);
    assert!(apart * behind(high) < 0.0, "{apart} {}", behind(high));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if apart * behind(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Gap along the normal and lever together give the approach at which a sharp tip edge touches after E: the lever halfway, for the pinion
/// turns on while the gap closes.
#[test]
fn val_lever_after_the_end_of_contact() {
    let pair = pair(&fzg_c());
    for beyond in [0.2, 0.4, 0.6, 0.8, 1.0] {
        let position = pair.path.end_mm + beyond;
        let touch = pair.touch(position);
        let halfway = pair.touch(position + 0.5 * touch.gap_mm);
        let (approach, exact) = (touch.gap_mm / pair.pinion_lever_ratio(&halfway), exact_touch_mm(&pair, position));
        assert_close(&format!("{beyond} mm after E"), approach, exact, 1e-4);
        assert!((touch.gap_mm / exact - 1.0).abs() > 0.05 * beyond, "the lever matters: {} {exact}", touch.gap_mm);
    }
}

/// fzg-c with roundings of 0.1 mm, from an independent finite-element calculation
/// (validation/tip-contact-independent): l/r_b1 at E + 0.2, 0.4, 0.6 mm, ε' at A − 0.6 and E + 0.6 mm. And the lever as what it is, the
/// distance of the touching normal from the pinion's axis.
#[test]
fn val_normal_of_a_rounded_tip_edge() {
    let pair = pair(&rounded("half-space").pair);
    let path = &pair.path;
    let (base, centre_distance_mm) = (path.involute.map(|flank| flank.base_radius_mm), pair.spec.centre_distance_mm);
    for (beyond, ratio) in [(0.2, 0.983), (0.4, 0.970), (0.6, 0.957)] {
        let touch = pair.touch(path.end_mm + beyond);
        assert_eq!(touch.edge_of, Some(Gear::Pinion));
        let found = pair.pinion_lever_ratio(&touch);
        assert!((found - ratio).abs() < 5e-4, "{beyond}: {found}");
        // The line of action touches both base circles; the normal has turned with it about the wheel's.
        let lever_mm = centre_distance_mm * (pair.working_pressure_angle_rad + touch.turned_rad).cos() - base.wheel;
        assert_close("lever", base.pinion * found, lever_mm, 1e-12);
    }
    for (tip_of, position, turned) in
        [(Gear::Wheel, path.start_mm - 0.6, 0.092), (Gear::Pinion, path.end_mm + 0.6, 0.059)]
    {
        let touch = pair.touch(position);
        assert_eq!(touch.edge_of, Some(tip_of));
        let flank = pair.teeth[tip_of].load_line(touch.rho_mm[tip_of]);
        let found = touch.load_line[tip_of].load_angle_rad - flank.load_angle_rad;
        // 0.0598 after E.
        assert!((found - turned).abs() < 1e-3, "{position}: {found}");
        // Before A the normal is a tangent of the pinion's base circle.
        assert_eq!(pair.pinion_lever_ratio(&touch) == 1.0, tip_of == Gear::Wheel);
    }
}

/// From flank to rounding nothing jumps, and between the roundings the theoretical contact points touch.
#[test]
fn ver_flanks_hand_over_to_roundings_without_a_jump() {
    let pair = pair(&rounded("half-space").pair);
    let path = &pair.path;
    for tip_of in Gear::BOTH {
        let edge = path.rho_mm(tip_of, pair.rounding_start_rho_mm(tip_of));
        let [inside, outside] =
            [-1e-7, 1e-7].map(|beyond| pair.touch(edge + if tip_of == Gear::Wheel { -beyond } else { beyond }));
        assert_eq!((inside.edge_of, outside.edge_of), (None, Some(tip_of)));
        assert!(outside.turned_rad.abs() < 1e-7 && outside.gap_mm.abs() < 1e-12, "{outside:?}");
        for gear in Gear::BOTH {
            assert!((inside.rho_mm[gear] - outside.rho_mm[gear]).abs() < 1e-5);
            let [before, after] = [inside, outside].map(|touch| touch.load_line[gear]);
            assert!((before.centre_line_mm - after.centre_line_mm).abs() < 1e-5);
            assert!((before.depth_mm - after.depth_mm).abs() < 1e-5);
        }
    }
}

/// The gap along the normal is the least gap of the tangent frame with its rounding, which is measured along the line of action, to
/// 0.05 µm (the same independent calculation).
#[test]
fn val_the_tangent_frame_has_the_gap_of_the_rounded_edge() {
    let pair = pair(&rounded("half-space").pair);
    for position in [pair.path.start_mm - 0.6, pair.path.start_mm - 0.2, pair.path.end_mm + 0.2, pair.path.end_mm + 0.6]
    {
        let gap = |along: f64| {
            Gear::BOTH.map(|gear| {
                let along = if gear == Gear::Pinion { along } else { -along };
                let (rho, drop) = pair.at_along(gear, along, position);
                drop + tip_edge_mm(0.1, &pair.teeth[gear], rho)
            })
        };
        let least = (-10_000..10_000).map(|k| gap(1e-4 * f64::from(k)).iter().sum()).fold(f64::INFINITY, f64::min);
        let touch = pair.touch(position);
        let along_normal = least * touch.turned_rad.cos();
        assert!((along_normal - touch.gap_mm).abs() < 5e-5, "{position}: {along_normal} {}", touch.gap_mm);
    }
}

/// Away from the edge the half-planes that a bed is matched to are Hertz's contact (a bed with the approach is wider, and reaches the
/// edge); where the edge touches, K/H is many times as high, for the contact is a tenth as wide.
#[test]
fn ver_beds_at_edges_are_hertzs_where_no_edge_is() {
    let pair = pair(&rounded("winkler").pair);
    // The rounding begins 0.28 mm of flank beside the contact, whose half-width is 0.17 mm under the whole load.
    let (at, load) = (pair.path.start_mm + 0.44, LINE_LOAD_N_PER_MM);
    let flattening = hertz::flattening(&pair, &steel(), at);
    let radius = flattening.contact.relative_radius_mm();
    // A bed with the closed form's approach: nothing is left beside it.
    let approach = FoundationCurve {
        position_mm: vec![at - 0.1, at + 0.1],
        mpa_per_mm: vec![matched_mpa_per_mm(MatchCriterion::Approach, &flattening, load); 2],
        load_exponent: vec![0.5; 2],
        reference_line_load_n_per_mm: load,
    };
    for criterion in [MatchCriterion::HalfWidth, MatchCriterion::PeakPressure] {
        let beds = EdgeFoundations::new(&pair, &steel(), load, criterion, &approach);
        let springs = beds.at(at).unwrap();
        for load in [0.3 * load, load] {
            let expected = matched_mpa_per_mm(criterion, &flattening, load);
            assert_close(criterion.name(), springs.mpa_per_mm(load), expected, 0.02);
            let whole = flattening.approach_mm(load);
            let bed = half_width_mm(expected, radius, load).powi(2) / (2.0 * radius);
            let further = springs.further_approach_mm(load).0;
            assert!((further - (whole - bed)).abs() < 0.02 * whole, "{}: {further}", criterion.name());
        }
        assert!(beds.at(pair.path.pitch_point_mm).is_none());
        let edge = beds.at(pair.path.start_mm - 0.6).unwrap();
        assert!(edge.mpa_per_mm(0.15 * load) > 5.0 * matched_mpa_per_mm(criterion, &flattening, 0.15 * load));
    }
}

/// Where the range ends, the tip edge of the one gear is on the tip circle of the other: seen from the pinion's axis at (0, 0) and the
/// wheel's at (a, 0), each edge turned by the roll that the position asks for.
#[test]
fn ver_tip_edges_are_followed_until_the_tip_circles_part() {
    for scene in [fzg_c(), fzg_c_scene().pair] {
        let pair = pair(&scene);
        let path = &pair.path;
        let ends = pair.farthest_touch_mm();
        for (tip_of, sign, end) in [(Gear::Wheel, -1.0, ends[0]), (Gear::Pinion, 1.0, ends[1])] {
            let (own, mate) = (&pair.teeth[tip_of], &pair.teeth[tip_of.mate()]);
            // Angle of the edge from the line of centres while it is on the line of action, and how far it turns from there.
            let on_line = (own.involute.base_radius_mm / own.tip_radius_mm).acos() - pair.working_pressure_angle_rad;
            let angle = on_line + end / own.involute.base_radius_mm;
            let (x, y) = (own.tip_radius_mm * angle.cos(), own.tip_radius_mm * angle.sin());
            let from_mate = (pair.spec.centre_distance_mm - x).hypot(y);
            assert_close("radius from the mate's axis", from_mate, mate.tip_radius_mm, 1e-12);
            // Farther in, the edge is among the mate's teeth, clear of its flank, and farther out the more.
            let gaps: Vec<f64> = (1..20)
                .map(|k| {
                    let (at, end_mm) = match sign < 0.0 {
                        true => (PathEnd::Start, path.start_mm),
                        false => (PathEnd::End, path.end_mm),
                    };
                    pair.edge_gap_mm(at, end_mm + sign * end * f64::from(k) / 20.0)
                })
                .collect();
            assert!(gaps[0] > 0.0 && gaps.windows(2).all(|two| two[1] > two[0]), "{gaps:?}");
        }
    }
}

/// The theoretical contact point of a tip edge may lie beyond T1, where the tip circles of FZG type C still reach each other: gap and radii of
/// curvature stay those of the flank that is touched.
#[test]
fn ver_tip_edges_may_touch_beyond_the_end_of_the_line_of_action() {
    let few = pair(&fzg_c());
    let path = &few.path;
    let before = few.farthest_touch_mm()[0];
    assert!(before > path.start_mm, "{before} {}", path.start_mm);
    let mut last = 0.0;
    for k in 1..=40 {
        let at = path.start_mm - before * f64::from(k) / 40.0;
        let touch = few.touch(at);
        assert!(touch.rho_mm.pinion > path.start_mm && touch.gap_mm > last, "{at} {touch:?}");
        // The gap by brute force: the nearest of many points of the pinion's involute to the edge.
        let edge = few.in_tangent_frame(Gear::Wheel, few.teeth.wheel.tip_rho_mm(), at);
        let nearest = (0..200_000)
            .map(|i| {
                let rho = 1.2 * few.teeth.pinion.tip_rho_mm() * f64::from(i) / 200_000.0;
                let own = few.in_tangent_frame(Gear::Pinion, rho, at);
                (own.along_mm + edge.along_mm).hypot(own.drop_mm + edge.drop_mm)
            })
            .fold(f64::INFINITY, f64::min);
        assert!((touch.gap_mm - nearest).abs() < 1e-5, "{at}: {} {nearest}", touch.gap_mm);
        last = touch.gap_mm;
        assert!(few.relative_radius_mm(at) > 0.0 && few.rolling_ratio(Gear::Pinion, at) > 0.0);
    }
}
