//! Calibration of the FZG type C pair at 302 N·m: against other finite elements, closed forms, and itself.

use std::f64::consts::PI;
use std::sync::OnceLock;

use gearwear_bodies::gear::conjugate::ConjugateFlanks;
use gearwear_bodies::gear::modification::{Relief, ReliefShape};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::{
    Gear, GearPair, PerGear,
    flank::{FlankGrid, PointSpacing},
};
use gearwear_bodies::gear_fem::position::WarmStart;
use gearwear_bodies::gear_mesh::settings::{Body, BodySettings, SectorSides, default_clamp};
use gearwear_fem::locate::locate;
use gearwear_physics::assessment::calibrate::{self, CalibrationExtent};
use gearwear_physics::calibration::bodies::Setup;
use gearwear_physics::calibration::identity::CalibrationIdentity;
use gearwear_physics::calibration::single_contact::{Purpose, SingleContact, TouchFigures};
use gearwear_physics::calibration::stiffness_variation::VariationOf;
use gearwear_physics::calibration::tooth_stiffness::LoadedPair;
use gearwear_physics::calibration::{Calibration, file::CalibrationFileError, foundation_fit, single_contact};
use gearwear_physics::contact::hertz::{self, Hertz};
use gearwear_physics::contact::settings::{ContactSettings, Foundation, MatchCriterion, SurfaceKind};
use gearwear_physics::contact::winkler::Winkler;
use gearwear_physics::contact::winkler::WinklerFoundation;
use gearwear_physics::contact::{ContactSurface, Flanks};
use gearwear_physics::mesh_cycle::pair_in_space::KeptInSpace;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::operation::Scene;
use gearwear_physics::simulation::settings::Operation;
use gearwear_physics::stiffness::{TeethSpring, settings::StiffnessSettings};
use gearwear_physics::wear::settings::WearSettings;
use nalgebra::Vector2;

use super::common::{self, assert_close, fzg_a, fzg_c, preset, steel};

/// 302 N·m over base radius and face width.
const LINE_LOAD_N_PER_MM: f64 = 637.66;
/// Root radius less 2.5 modules, as the reference values were computed.
const CLAMP_RADIUS_MM: PerGear<f64> = PerGear { pinion: 19.943, wheel: 37.897 };

fn setup(pair: &GearPair, body: Body, elements_per_half_width: f64) -> Setup<'_> {
    let bodies = BodySettings { body, ..BodySettings::rings(CLAMP_RADIUS_MM, elements_per_half_width) };
    Setup { pair, material: steel(), bodies, line_load_n_per_mm: LINE_LOAD_N_PER_MM }
}

/// A revolution of the preset `fzg-c` under 302 N·m. Calibrations read pair, material, torque, bodies and slices of it.
fn fzg_c_scene(elements_per_half_width: f64) -> Scene {
    let pair = preset("fzg-c");
    let clamp = |gear| default_clamp(pair.root_radius_mm(gear), pair.transverse_module_mm()).radius_mm;
    let fem = BodySettings::rings(PerGear::from_fn(clamp), elements_per_half_width);
    let numerics = common::fzg_c_scene().numerics();
    let foundation = Foundation::Matched(MatchCriterion::HalfWidth);
    Scene {
        pair,
        material: steel(),
        modulus: PerGear::default(),
        operation: Operation::steady(302e3, None, 1.0, vec![1.0]),
        contact: ContactSettings { surface: SurfaceKind::HalfSpace, foundation, tip_contact: true },
        surface_by_default: false,
        calibration_file: None,
        stiffness: StiffnessSettings::Fem,
        stiffness_by_default: true,
        stiffness_curve_file: None,
        fem,
        wear_elements_per_half_width: 3.0,
        slices: None,
        coupling_by_default: true,
        heat: None,
        lubrication: None,
        wear: PerGear::from_fn(|_| WearSettings::archard(1e-11)),
        numerics,
        verify: true,
    }
}

/// The whole calibration of the preset, made once for all tests.
fn calibration() -> &'static Calibration {
    static CALIBRATION: OnceLock<Calibration> = OnceLock::new();
    CALIBRATION.get_or_init(|| {
        calibrate::run(&fzg_c_scene(6.0), CalibrationExtent::Whole, &KeptInSpace::default(), &Unwatched)
            .unwrap()
            .calibration
    })
}

/// Independent quadratic finite elements (another program, converged to 0.02 %): whole ring 16.99, three teeth with free
/// sides 15.22, with clamped sides 18.09 N/(mm·µm), each to 0.5 %.
#[test]
fn val_stiffness_at_the_pitch_point() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let sector = |sides| Body::Sector { teeth: 3, sides };
    for (body, expected) in
        [(Body::Ring, 16.99), (sector(SectorSides::Free), 15.22), (sector(SectorSides::Clamped), 18.09)]
    {
        let setup = setup(&pair, body, 5.0);
        let condensed = setup.condensed(&setup.meshed().unwrap()).unwrap();
        let loaded = LoadedPair::new(&condensed, &steel());
        let at = loaded.deflections(&[pair.path.pitch_point_mm], LINE_LOAD_N_PER_MM)[0].unwrap();
        assert_close("stiffness", at.pair_n_per_mm_um(), expected, 5e-3);
    }
}

/// A load that is found by contact moves the gears as far as the ellipse that it nearly is: at 7 mm the pinion's radius of
/// curvature changes by a seventh from the middle of the strip to its ends, and the pressure is a little skew.
#[test]
fn ver_a_known_load_and_contact_give_the_same_approach() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let setup = setup(&pair, Body::Ring, 6.0);
    let condensed = setup.condensed(&setup.meshed().unwrap()).unwrap();
    let loaded = LoadedPair::new(&condensed, &steel());
    for (position_mm, tolerance) in [(7.0, 2e-3), (pair.path.pitch_point_mm, 5e-4), (19.0, 5e-4)] {
        let found = condensed.at_alone(position_mm, LINE_LOAD_N_PER_MM, &WarmStart::default()).unwrap();
        let known = loaded.deflections(&[position_mm], LINE_LOAD_N_PER_MM)[0].unwrap();
        let approach = LINE_LOAD_N_PER_MM * known.sum(|tooth| tooth.whole_mm2_per_n);
        assert_close("approach", found.transmission_error_mm, approach, tolerance);
        assert_eq!(found.pairs.len(), 1);
        assert_close("load", found.pairs[0].line_load_n_per_mm, LINE_LOAD_N_PER_MM, 1e-9);
    }
}

/// The ellipse's forces have its resultant and point along the line of action; a point inside moves as the whole field of
/// displacements says.
#[test]
fn ver_forces_carry_the_load_and_the_point_inside_is_that_of_the_field() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let setup = setup(&pair, Body::Ring, 3.0);
    let condensed = setup.condensed(&setup.meshed().unwrap()).unwrap();
    let loaded = LoadedPair::new(&condensed, &steel());
    for gear in Gear::BOTH {
        let tooth = &loaded.teeth[gear];
        let rho_mm = pair.path.rho_mm(gear, 12.0);
        let force = tooth.ellipse(rho_mm, 0.24, 500.0).unwrap();
        let along = |component: usize| force.iter().filter(|(c, _)| c % 2 == component).map(|(_, f)| f).sum::<f64>();
        let line = pair.teeth[gear].load_line(rho_mm);
        let direction = Vector2::new(line.load_angle_rad.cos(), -line.load_angle_rad.sin());
        assert!((Vector2::new(along(0), along(1)) - 500.0 * direction).norm() < 1e-10);

        let middle = tooth.middle();
        let mut forces = vec![Vec::new(); tooth.teeth()];
        forces[middle] = force;
        let inside = tooth.inside(&[rho_mm]).remove(0).unwrap();
        assert_close("depth", inside.depth_mm, pair.depth_mm(gear, 12.0), 1e-12);
        let body = &condensed.gears[gear];
        let cuts = body.cut_displacement_mm(middle, &forces);
        let field = body.sector.displacement_mm(&forces[middle], &cuts);
        let place = locate(&body.sector.sector.solid, Vector2::new(0.0, line.centre_line_mm)).unwrap();
        let moved: Vector2<f64> = place
            .weights
            .iter()
            .map(|&(node, weight)| Vector2::new(field[2 * node as usize], field[2 * node as usize + 1]) * weight)
            .sum();
        assert_close("inside", tooth.inside_mm(&inside, middle, &forces), moved.dot(&direction), 1e-9);
    }
}

/// Betti: a load on this pair moves the one ahead as far as a load there moves this one.
#[test]
fn ver_coupling_is_mutual() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let setup = setup(&pair, Body::Ring, 4.0);
    let condensed = setup.condensed(&setup.meshed().unwrap()).unwrap();
    let loaded = LoadedPair::new(&condensed, &steel());
    for position_mm in [5.5, 7.5, 9.5] {
        let here = loaded.deflections(&[position_mm], LINE_LOAD_N_PER_MM)[0].unwrap();
        let ahead = loaded.deflections(&[position_mm + pair.path.base_pitch_mm], LINE_LOAD_N_PER_MM)[0].unwrap();
        // An ellipse on one side, a point on the other: the spread of the load hardly matters a pitch away.
        assert_close("coupling", here.ahead_mm2_per_n.unwrap(), ahead.behind_mm2_per_n.unwrap(), 1e-4);
    }
}

/// The fast model, with any surface, then has the whole compliance that finite elements found.
#[test]
fn ver_the_curve_gives_springs_that_have_the_whole_compliance() {
    let calibration = calibration();
    let pair = GearPair::new(&fzg_c()).unwrap();
    let load = calibration.line_load_n_per_mm;
    let surface = Hertz { material: steel(), expected_line_load_n_per_mm: load };
    let compliance = &calibration.pair_compliance;
    let spring = TeethSpring::new(StiffnessSettings::Fem, Some(compliance), &pair, &steel(), &surface, load).unwrap();
    let rows = &calibration.deflection;
    for (k, at) in rows.iter().enumerate() {
        let whole = spring.pair_n_per_mm2(at.position_mm).unwrap();
        // The first and the last rows feel the corner; the curve there is that of bending.
        let tolerance = if (3..rows.len() - 3).contains(&k) { 1e-9 } else { 1e-2 };
        assert_close("stiffness", 1e-3 * whole, at.pair_n_per_mm_um(), tolerance);
    }
    // It reaches as far before A and after E as tip edges do under twice the load.
    let contact_modulus = 206e3 / (2.0 * (1.0 - 0.3 * 0.3));
    let [before, after] = pair.ample_tip_reach_mm(2.0 * load, contact_modulus);
    let (first, last) = compliance.ends_mm();
    assert_close("first", first, pair.path.start_mm - before, 1e-12);
    assert_close("last", last, pair.path.end_mm + after, 1e-12);
}

/// Wanted: converged to 0.2 %. A deeper body is softer, so is one with fewer neighbours whose sides are free;
/// clamped sides make it stiffer.
#[test]
fn ver_stiffness_converges_and_follows_rim_and_neighbours() {
    let calibration = calibration();
    let finest = calibration.convergence.last().unwrap().pair_n_per_mm_um;
    for row in &calibration.convergence {
        assert_close("stiffness", row.pair_n_per_mm_um, finest, 2e-3);
    }
    let rims: Vec<f64> = calibration.rim_depth.iter().map(|row| row.pair_n_per_mm_um).collect();
    assert!(rims.len() >= 5 && rims.windows(2).all(|pair| pair[0] > pair[1]), "{rims:?}");
    let of = |name: &str| calibration.neighbours.iter().find(|row| row.body == name).unwrap().pair_n_per_mm_um;
    let ring = of("whole ring");
    let order = [
        of("1 tooth, sides free"),
        of("3 teeth, sides free"),
        of("5 teeth, sides free"),
        ring,
        of("5 teeth, sides clamped"),
        of("3 teeth, sides clamped"),
        of("1 tooth, sides clamped"),
    ];
    assert!(order.windows(2).all(|pair| pair[0] < pair[1]), "{order:?}");
    // The same model as the curve's: one loaded tooth, condensed onto fewer nodes, is no other gear.
    let at_c = calibration.deflection_at_points[2].unwrap().pair_n_per_mm_um();
    assert_close("ring", ring, at_c, 1e-3);
}

/// Contacts as Hertz has them, at some positions and loads.
fn hertz_contacts(pair: &GearPair) -> Vec<SingleContact> {
    let mut contacts = Vec::new();
    for k in 0..=32 {
        let position_mm = 5.0 + 18.0 * f64::from(k) / 32.0;
        let closed = hertz::flattening(pair, &steel(), position_mm);
        for (load, fitted) in [(1.5, true), (1.0, true), (0.7, false), (0.5, true), (0.25, true)] {
            let line_load_n_per_mm = load * LINE_LOAD_N_PER_MM;
            let strip = closed.contact.loaded(line_load_n_per_mm);
            let touch = TouchFigures {
                half_width_mm: strip.half_width_mm,
                peak_pressure_mpa: strip.peak_pressure_mpa,
                approach_mm: closed.approach_mm(line_load_n_per_mm),
            };
            contacts.push(SingleContact {
                position_mm,
                line_load_n_per_mm,
                relative_radius_mm: pair.relative_radius_mm(position_mm),
                purpose: if fitted && k % 2 == 0 { Purpose::Fitted } else { Purpose::HeldOut },
                fem: touch,
                hertz: touch,
            });
        }
    }
    contacts
}

/// Fitted to Hertz himself, the exponent of the load is ½, and a bed of his half-width peaks 3π/8 times as high.
#[test]
fn ver_the_fit_finds_hertz() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let ends_mm = (pair.path.start_mm, pair.path.end_mm);
    let (curves, fits) = foundation_fit::all(&hertz_contacts(&pair), LINE_LOAD_N_PER_MM, ends_mm);
    for criterion in [MatchCriterion::HalfWidth, MatchCriterion::PeakPressure] {
        assert!(curves[&criterion].load_exponent.iter().all(|m| (m - 0.5).abs() < 1e-12), "{criterion:?}");
        assert!(fits[&criterion].fitted.worst_matched < 1e-12);
        // Between positions the curve is straight in ln K.
        assert!(fits[&criterion].held_out.worst_matched < 1e-3, "{:?}", fits[&criterion].held_out);
    }
    let price = 3.0 * PI / 8.0 - 1.0;
    assert_close("peak", fits[&MatchCriterion::HalfWidth].fitted.mean_peak_pressure, price, 1e-9);
    assert_close("width", fits[&MatchCriterion::PeakPressure].fitted.mean_half_width, price, 1e-9);
}

/// What a Winkler foundation calibrated on finite elements keeps and what it pays, at positions and loads that the fit has not
/// seen: 2 % in what it is matched on, 17.8 % (3π/8 − 1) in the other.
#[test]
fn val_calibrated_bed_where_it_was_held_out() {
    let calibration = calibration();
    let price = 3.0 * PI / 8.0 - 1.0;
    for (criterion, other) in [
        (MatchCriterion::HalfWidth, MatchCriterion::PeakPressure),
        (MatchCriterion::PeakPressure, MatchCriterion::HalfWidth),
    ] {
        let fit = &calibration.foundation_fit[&criterion];
        let held_out: Vec<_> = fit.rows.iter().filter(|row| !row.fitted).collect();
        assert!(held_out.len() > 100, "{}", held_out.len());
        for row in held_out {
            assert!(row.matched_error(criterion).abs() < 0.02, "{criterion:?} {row:?}");
            assert!((row.matched_error(other) - price).abs() < 0.03, "{criterion:?} {row:?}");
        }
    }
    // Edges are marked: both ends of the path are tip edges.
    let at_edge = |position: f64| {
        calibration.single_contact.iter().filter(|c| c.position_mm == position).all(|c| c.purpose == Purpose::AtEdge)
    };
    assert!(at_edge(calibration.path_points_mm[0]) && at_edge(calibration.path_points_mm[4]));
}

/// The same by the surface that wear runs use, on the true involutes instead of a parabola: the pair alone under the load,
/// at every position and load that was held out.
#[test]
fn val_calibrated_winkler_surface_in_single_contact() {
    let calibration = calibration();
    let pair = GearPair::new(&fzg_c()).unwrap();
    let grids = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 750, PointSpacing::Even));
    let unworn = PerGear::from_fn(|gear| vec![0.0; grids[gear].len()]);
    let flanks = Flanks::new(&pair, grids.as_ref());
    let mut compared = 0;
    for criterion in [MatchCriterion::HalfWidth, MatchCriterion::PeakPressure] {
        let surface = Winkler {
            foundation: WinklerFoundation::Curve {
                pressure: calibration.foundation[&criterion].clone(),
                approach: calibration.foundation[&MatchCriterion::Approach].clone(),
                edges: None,
            },
            expected_line_load_n_per_mm: calibration.line_load_n_per_mm,
        };
        for contact in calibration.single_contact.iter().filter(|c| c.purpose == Purpose::HeldOut) {
            let mut alone = surface.pair(flanks, contact.position_mm, None);
            alone.set_removed(unworn.as_ref().map(Vec::as_slice));
            let load = contact.line_load_n_per_mm;
            let (mut low, mut high) = (0.0, alone.ample_indentation_mm(load));
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if alone.load_at(middle).line_load_n_per_mm < load { low = middle } else { high = middle }
            }
            assert_close("load", alone.load_at(high).line_load_n_per_mm, load, 1e-9);
            alone.window_suffices(unworn.as_ref().map(Vec::as_slice));
            let found = alone.footprint();
            match criterion {
                MatchCriterion::HalfWidth => {
                    assert_close("half-width", found.half_width_mm, contact.fem.half_width_mm, 0.02);
                }
                _ => assert_close("peak", found.peak_pressure_mpa, contact.fem.peak_pressure_mpa, 0.02),
            }
            compared += 1;
        }
    }
    assert!(compared > 200, "{compared}");
}

/// The tooth is Hertz's half-plane for pressure (1 %), and not for the approach down to its centre line.
#[test]
fn val_hertz_away_from_the_edges() {
    for contact in calibration().single_contact.iter().filter(|c| c.purpose != Purpose::AtEdge) {
        assert_close("pressure", contact.fem.peak_pressure_mpa, contact.hertz.peak_pressure_mpa, 1.2e-2);
        assert_close("half-width", contact.fem.half_width_mm, contact.hertz.half_width_mm, 1e-2);
        let excess = contact.fem.approach_mm / contact.hertz.approach_mm - 1.0;
        assert!((0.03..0.12).contains(&excess), "{contact:?}");
    }
}

/// Targets K1 and K2: the family rises from root to tip and lies within the axis of the figure, 0 to 30; the combined
/// stiffness varies by 1.2 to 1.6 with its greatest in the middle third (flattening included), the pinion's alone by 3 to
/// 5 (flattening apart).
#[test]
fn val_families_of_curves() {
    let calibration = calibration();
    let teeth: Vec<u32> = calibration.family.iter().map(|member| member.teeth).collect();
    assert_eq!((teeth.first(), teeth.last(), teeth.len()), (Some(&10), Some(&30), 11));
    for member in &calibration.family {
        assert!(member.deflection.windows(2).all(|pair| pair[0] < pair[1]), "{member:?}");
        assert!(member.deflection.iter().all(|value| (0.0..30.0).contains(value)), "{member:?}");
        // No undercut: x = 1 − z sin²20°/2 where that is above 0 (h_fP* − ρ_fP* (1 − sin α) = 1.0 for the rack 1.25, 0.38).
        let least = 1.0 - 0.5 * f64::from(member.teeth) * 20f64.to_radians().sin().powi(2);
        assert!((member.profile_shift - least.max(0.0)).abs() < 1e-3, "{member:?}");
    }
    let course = |of| calibration.courses.iter().find(|course| course.of == of).unwrap();
    let pair = course(VariationOf::PairWhole);
    assert!((1.2..1.6).contains(&pair.max_over_min) && (1.0 / 3.0..2.0 / 3.0).contains(&pair.greatest_at), "{pair:?}");
    assert!((3.0..5.0).contains(&course(VariationOf::PinionBending).max_over_min));
}

#[test]
fn a_file_comes_back_as_it_was_and_keeps_its_hash() {
    let calibration = calibration();
    let text = calibration.to_json();
    assert_eq!(&Calibration::from_json(&text).unwrap(), calibration);
    let changed = Calibration { line_load_n_per_mm: 600.0, ..calibration.clone() };
    let kept = text.replace(&format!("{}", calibration.line_load_n_per_mm), "600.0");
    assert!(matches!(Calibration::from_json(&kept), Err(CalibrationFileError::Hash { .. })));
    assert_ne!(changed.content_hash(), calibration.hash);
    let cut = &text[..text.len() / 2];
    assert!(matches!(Calibration::from_json(cut), Err(CalibrationFileError::Form { .. })));
    // A hash that is right does not make curves of nonsense.
    let mut upside_down = calibration.clone();
    upside_down.pair_compliance.position_mm.reverse();
    let refused = Calibration::from_json(&upside_down.to_json());
    assert!(matches!(refused, Err(CalibrationFileError::Content { .. })), "{refused:?}");
}

#[test]
fn differences_are_told_by_the_keys_of_the_scene() {
    let identity = |spec: &PairSpec, clamp_mm: f64| {
        let clamp_radius_mm = PerGear { pinion: clamp_mm, wheel: 37.9 };
        let bodies = BodySettings::rings(clamp_radius_mm, 4.0);
        CalibrationIdentity::of(&GearPair::new(spec).unwrap(), &steel(), &bodies)
    };
    let own = identity(&fzg_c(), 20.0);
    assert_eq!(own.differences(&own, true), Vec::<String>::new());
    // The face width and round-off are no difference.
    let mut wide = fzg_c();
    wide.face_width_mm *= 2.0;
    wide.centre_distance_mm *= 1.0 + 1e-12;
    assert_eq!(own.differences(&identity(&wide, 20.0), true), Vec::<String>::new());
    // Neither is another helix angle of the same transverse section.
    assert_eq!(own.differences(&identity(&preset("thesis-helical"), 20.0), true), Vec::<String>::new());
    let mut flatter = preset("thesis-helical");
    flatter.helix_angle_rad *= 0.99;
    let told = own.differences(&identity(&flatter, 20.0), true);
    assert!(
        told.iter().any(|difference| difference.starts_with("pair.transverse_module_mm: calibration 4.5, scene 4.49")),
        "{told:?}"
    );
    let mut other = fzg_c();
    other.gears.wheel.profile_shift = 0.17;
    other.gears.pinion.modification.tip_rounding_mm = 0.1;
    assert_eq!(
        own.differences(&identity(&other, 19.0), true),
        [
            "pair.pinion.tip_rounding_mm: calibration 0, scene 0.1",
            "pair.wheel.profile_shift: calibration 0.1715, scene 0.17",
            "fem.clamp_radius_mm.pinion: calibration 20, scene 19",
        ]
    );
    assert_eq!(own.differences(&identity(&other, 19.0), false).len(), 2);
    assert!(own.differences(&identity(&fzg_a(), 20.0), false).len() >= 4);
}

/// Rounded tips: pressure on a rounding is marked as well, and the stiffness ends where the involute does.
#[test]
fn rounded_tips_and_other_orders_of_the_points_are_calibrated_too() {
    let mut rounded = fzg_c();
    rounded.gears.pinion.modification.tip_rounding_mm = 0.1;
    rounded.gears.wheel.modification.tip_rounding_mm = 0.1;
    // Type A has C before B.
    for (spec, clamp_radius_mm) in [(rounded, CLAMP_RADIUS_MM), (fzg_a(), PerGear { pinion: 22.9, wheel: 34.9 })] {
        let pair = GearPair::new(&spec).unwrap();
        let bodies = BodySettings::rings(clamp_radius_mm, 3.0);
        let load = LINE_LOAD_N_PER_MM;
        let setup = Setup { pair: &pair, material: steel(), bodies, line_load_n_per_mm: load };
        let condensed = setup.condensed(&setup.meshed().unwrap()).unwrap();
        let loaded = LoadedPair::new(&condensed, &steel());
        let (low, high) = loaded.clear_of_the_edges_mm(load, 1.0).unwrap();
        assert!(low > pair.path.start_mm && high < pair.path.end_mm);
        let rows = loaded.along_the_path(9, load).unwrap();
        // Between single teeth of steel: some 10 to 20 N/(mm·µm).
        assert!(rows.iter().all(|row| (8.0..22.0).contains(&row.pair_n_per_mm_um())), "{rows:?}");
        // At the greatest load, and two elements of a third of a half-width inside it.
        let greatest = single_contact::FITTED_LOADS[0] * load;
        let (low, high) = loaded.clear_of_the_edges_mm(greatest, 1.0 + 2.0 / 3.0).unwrap();
        let contacts = single_contact::solve(&condensed, &loaded, load).unwrap();
        for contact in &contacts {
            let near_edge = contact.position_mm < low || contact.position_mm > high;
            assert!(near_edge || contact.purpose != Purpose::AtEdge, "{contact:?}");
        }
        assert!(contacts.iter().any(|contact| contact.purpose == Purpose::AtEdge));
        assert_eq!(contacts.first().unwrap().purpose, Purpose::AtEdge);
    }
}

/// A relief changes the curvature of a flank where it begins; K/H is fitted without it, and is as good as that of plain flanks.
#[test]
fn relieved_flanks_have_the_foundation_of_plain_ones() {
    let mut scene = fzg_c_scene(5.0);
    for gear in Gear::BOTH {
        let relief = Relief { amount_mm: 0.020, length_mm: 2.0, shape: ReliefShape::Linear };
        scene.pair.gears[gear].modification.tip_relief = Some(relief);
    }
    let calibration =
        calibrate::run(&scene, CalibrationExtent::FastModel, &KeptInSpace::default(), &Unwatched).unwrap().calibration;
    assert!(Calibration::from_json(&calibration.to_json()).is_ok());
    for criterion in [MatchCriterion::HalfWidth, MatchCriterion::PeakPressure] {
        let held_out = &calibration.foundation_fit[&criterion].held_out;
        assert!(held_out.worst_matched < 0.02, "{criterion:?}: {}", held_out.worst_matched);
    }
}
