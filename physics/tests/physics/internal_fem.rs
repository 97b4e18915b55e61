//! Finite elements of internal wheels: meshes, Lamé's ring, the limit of a rack, Hertz, refinement, the whole model, teeth in space.

use gearwear_bodies::gear::backlash::Backlash;
use gearwear_bodies::gear::modification::{Modification, Relief, ReliefShape};
use gearwear_bodies::gear::outline::section_mm2;
use gearwear_bodies::gear::removed_material::removed_mm;
use gearwear_bodies::gear::ring_fillet::{RingSpec, ShaperCutter};
use gearwear_bodies::gear::spec::{GearSpec, PairSpec};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::{CondensedPair, hertz_half_width_mm};
use gearwear_bodies::gear_fem::full;
use gearwear_bodies::gear_fem::in_space::TeethInSpace;
use gearwear_bodies::gear_fem::model::{MeshedGear, sector};
use gearwear_bodies::gear_fem::position::{PositionContact, WarmStart};
use gearwear_bodies::gear_mesh::settings::{
    BodySettings, RimPins, SpaceBody, SpaceResolution, ToothOnPins, default_clamp,
};
use gearwear_bodies::gear_mesh::tooth_section::ExtrudedTooth;
use gearwear_bodies::gear_mesh::{ToothSector, gear_sector};
use gearwear_bodies::material::contact_modulus_mpa;
use gearwear_bodies::reference::lame_cylinder::LameCylinder;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::loads::add_traction;
use gearwear_fem::problem::Edge;
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::PI;

use super::common::{assert_close, gear, sector_mm2, spur};

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
const BOTH: PerGear<Elastic> = PerGear { pinion: STEEL, wheel: STEEL };
const CUTTER: ShaperCutter =
    ShaperCutter { teeth: 25, profile_shift: 0.0, addendum_factor: 1.25, tip_rounding_factor: 0.2 };
/// 150 N·m over 28.1908 mm and 20 mm.
const LINE_LOAD: f64 = 150e3 / 28.190_778 / 20.0;

fn ring(teeth: u32, profile_shift: f64, tip_diameter_mm: Option<f64>, cutter: Option<ShaperCutter>) -> GearSpec {
    let own = gear(teeth, profile_shift, tip_diameter_mm.map(|diameter_mm| -diameter_mm));
    GearSpec { ring: Some(RingSpec { root_diameter_mm: None, cutter }), ..own }
}

/// A planet in its ring, with tips rounded at 0.1 mm.
fn planet_in_ring(cutter: Option<ShaperCutter>) -> PairSpec {
    let mut spec = spur(3.0, f64::NAN, 20.0, gear(20, 0.3, None), ring(60, -0.3, Some(176.2), cutter));
    spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(0.0)).unwrap();
    for g in Gear::BOTH {
        spec.gears[g].modification.tip_rounding_mm = 0.1;
    }
    spec
}

fn settings(pair: &GearPair, elements_per_half_width: f64) -> BodySettings {
    let module_mm = pair.spec.normal_module_mm;
    let clamp_radius_mm = PerGear::from_fn(|g| default_clamp(pair.teeth[g].root_radius_mm, module_mm).radius_mm);
    BodySettings::rings(clamp_radius_mm, elements_per_half_width)
}

fn meshed(pair: &GearPair, settings: &BodySettings) -> PerGear<MeshedGear> {
    PerGear::from_fn(|gear| MeshedGear::new(pair, gear, &BOTH, LINE_LOAD, settings).unwrap())
}

fn condensed<'a>(pair: &'a GearPair, meshed: &PerGear<MeshedGear>) -> CondensedPair<'a> {
    CondensedPair::new(pair, &BOTH, PerGear::from_fn(|gear| meshed[gear].condense(pair, STEEL).unwrap()))
}

fn at(model: &CondensedPair<'_>, position_mm: f64) -> PositionContact {
    model.at(position_mm, LINE_LOAD, &WarmStart::default()).unwrap()
}

fn fine_wheel(pair: &GearPair) -> ToothSector {
    let half_width_mm = |at_mm: f64| hertz_half_width_mm(pair, contact_modulus_mpa(BOTH), LINE_LOAD, at_mm);
    gear_sector(pair, Gear::Wheel, true, &settings(pair, 6.0), &half_width_mm).unwrap()
}

/// The section of a ring, from its outline to its outside, is what its sectors fill.
#[test]
fn ver_sectors_fill_the_section_of_a_ring() {
    for cutter in [Some(CUTTER), None] {
        let pair = GearPair::new(&planet_in_ring(cutter)).unwrap();
        let (tooth, outside_mm) = (&pair.teeth.wheel, settings(&pair, 6.0).clamp_radius_mm.wheel);
        let filled_mm2 = f64::from(tooth.teeth) * sector_mm2(&fine_wheel(&pair));
        assert_close("section", section_mm2(tooth, 0.0, outside_mm), filled_mm2, 5e-4);
    }
}

/// All nodes of the surface lie on the true profile, with reliefs and rounded tips, of a cut and of a plain ring.
#[test]
fn ver_nodes_of_a_ring_lie_on_its_profile() {
    for cutter in [Some(CUTTER), None] {
        let mut spec = planet_in_ring(cutter);
        spec.gears.wheel.modification = Modification {
            tip_relief: Some(Relief { amount_mm: 0.02, length_mm: 2.0, shape: ReliefShape::Linear }),
            root_relief: Some(Relief { amount_mm: 0.015, length_mm: 1.5, shape: ReliefShape::Parabolic }),
            profile_crowning_mm: 0.005,
            tip_rounding_mm: 0.2,
            ..Modification::default()
        };
        let pair = GearPair::new(&spec).unwrap();
        let (tooth, sector) = (&pair.teeth.wheel, fine_wheel(&pair));
        let point = |node: u32| sector.points_mm[node as usize];
        let modification = Modification { tip_rounding_mm: 0.0, ..spec.gears.wheel.modification };
        let base_mm = tooth.involute.base_radius_mm.abs();
        for (chain, side) in [(&sector.working_flank, -1.0), (&sector.back_flank, 1.0)] {
            for k in chain.involute.clone() {
                let rho_mm = chain.rho_mm[k];
                let free_mm =
                    (rho_mm - removed_mm(&modification, tooth, pair.active_start_rho_mm(Gear::Wheel), rho_mm)).abs();
                // Half the angle of the tooth there, positive, by the string that leaves the base circle.
                let theta = rho_mm.abs() / base_mm - free_mm.atan2(base_mm) - tooth.base_half_angle_rad;
                let expected = base_mm.hypot(free_mm) * Vector2::new(side * theta.sin(), -theta.cos());
                assert!((point(chain.nodes[k]) - expected).norm() < 1e-10, "ρ = {rho_mm}: {expected}");
            }
            let (first, last) = (chain.involute.end - 1, chain.nodes.len() - 1);
            let end = point(chain.nodes[last]);
            // The rounding touches the tip circle from outside.
            let centre = end * (1.0 + 0.2 / tooth.tip_radius_mm.abs());
            for k in first..=last {
                assert!(((point(chain.nodes[k]) - centre).norm() - 0.2).abs() < 1e-8, "node {k} of the rounding");
            }
        }
        for (what, chain, radius_mm) in [
            ("tip", &sector.tip_land, tooth.tip_radius_mm),
            ("root", &sector.working_root_arc, tooth.root_radius_mm),
            ("clamp", &sector.clamp, settings(&pair, 6.0).clamp_radius_mm.wheel),
        ] {
            for &node in chain {
                assert!((point(node).norm() + radius_mm).abs() < 1e-9, "{what}: {}", point(node).norm());
            }
        }
        for (right, left) in sector.right_cut.iter().zip(&sector.left_cut) {
            let (right, left) = (point(*right), point(*left));
            assert!((right.x + left.x).abs() < 1e-10 && (right.y - left.y).abs() < 1e-10);
        }
    }
}

/// Edges of a chain with the body on their left.
fn edges(chain: &[u32], along: bool) -> Vec<Edge> {
    let ends = |a, b| if along { [a, b] } else { [b, a] };
    chain.windows(3).step_by(2).map(|edge| Edge { ends: ends(edge[0], edge[2]), middle: Some(edge[1]) }).collect()
}

/// Lamé's field solves the toothed ring too, with the tractions of that field on its outline: held at the outside, every node of a sector moves as the closed
/// form says, within 1e-4 of the greatest displacement.
#[test]
fn val_a_ring_deforms_as_lame_says() {
    let pair = GearPair::new(&planet_in_ring(Some(CUTTER))).unwrap();
    let mesh = fine_wheel(&pair);
    let (nu, a, b) =
        (STEEL.poisson_ratio, pair.teeth.wheel.tip_radius_mm.abs(), settings(&pair, 6.0).clamp_radius_mm.wheel.abs());
    let p = 100.0;
    let tube = LameCylinder {
        inner_radius_mm: a,
        outer_radius_mm: b,
        inner_pressure_mpa: p,
        // No displacement of the outside.
        outer_pressure_mpa: p * a * a * (2.0 - 2.0 * nu) / ((1.0 - 2.0 * nu) * b * b + a * a),
        young_modulus_mpa: STEEL.young_modulus_mpa,
        poisson_ratio: nu,
    };
    assert!(tube.radial_displacement_mm(b).abs() < 1e-12);
    let outline: Vec<Edge> = [
        (&mesh.back_root_arc, true),
        (&mesh.back_fillet, true),
        (&mesh.back_flank.nodes, true),
        (&mesh.tip_land, false),
        (&mesh.working_flank.nodes, false),
        (&mesh.working_fillet, false),
        (&mesh.working_root_arc, false),
    ]
    .into_iter()
    .flat_map(|(chain, along)| edges(chain, along))
    .collect();
    let mut nodes: Vec<u32> = outline.iter().flat_map(|edge| edge.ends.into_iter().chain(edge.middle)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let condensed = sector(&mesh, -PI / 60.0, nodes.clone()).condense(STEEL, Analysis::PlaneStrain).unwrap();
    let solid = &condensed.sector.solid;
    let mut loads = vec![0.0; solid.dofs()];
    let traction = |x: Vector2<f64>, n: Vector2<f64>| {
        let (r, e) = (x.norm(), x.normalize());
        let radial = e * e.transpose();
        (radial * tube.radial_stress_mpa(r) + (Matrix2::identity() - radial) * tube.hoop_stress_mpa(r)) * n
    };
    add_traction(solid, &outline, Analysis::PlaneStrain, traction, &mut loads);
    let forces: Vec<(usize, f64)> = nodes
        .iter()
        .enumerate()
        .flat_map(|(k, node)| [0, 1].map(|i| (2 * k + i, loads[2 * *node as usize + i])))
        .collect();
    // Towards the tips, as radii that are negative increase, and along the circle.
    let cut_mm: Vec<f64> = condensed
        .sector
        .cuts
        .iter()
        .flatten()
        .flat_map(|node| [-tube.radial_displacement_mm(solid.points_mm[*node as usize].norm()), 0.0])
        .collect();
    let moved = condensed.displacement_mm(&forces, &cut_mm);
    let greatest_mm = tube.radial_displacement_mm(a);
    for (node, x) in solid.points_mm.iter().enumerate() {
        let expected = x.normalize() * tube.radial_displacement_mm(x.norm());
        let off_mm = (Vector2::new(moved[2 * node], moved[2 * node + 1]) - expected).norm();
        assert!(off_mm < 1e-4 * greatest_mm, "{x}: {off_mm:e} of {greatest_mm:e}");
    }
}

/// Wheels of ±20000 teeth are the same rack: transmission error and load sharing within 0.1 %, pressure and root stress as far as triangles resolve them.
#[test]
fn ver_internal_and_external_wheels_are_the_same_rack() {
    let teeth = 20_000;
    let [internal, external] = [ring(teeth, 0.0, None, None), gear(teeth, 0.0, None)].map(|wheel| {
        let mut spec = spur(3.0, f64::NAN, 20.0, gear(20, 0.2, None), wheel);
        spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(0.0)).unwrap();
        for g in Gear::BOTH {
            spec.gears[g].modification.tip_rounding_mm = 0.1;
        }
        GearPair::new(&spec).unwrap()
    });
    let [ours, theirs] = [&internal, &external].map(|pair| {
        let mut settings = settings(pair, 5.0);
        // Rims of the same thickness.
        settings.clamp_radius_mm.wheel = pair.teeth.wheel.root_radius_mm - 7.5;
        let model = condensed(pair, &meshed(pair, &settings));
        let path = &pair.path;
        [0.1, 0.35, 0.5, 0.8].map(|part| at(&model, path.start_mm + part * (path.end_mm - path.start_mm)))
    });
    for (ours, theirs) in ours.iter().zip(&theirs) {
        let what = |quantity: &str| format!("{quantity} at {:.3}", ours.position_mm);
        assert_close(&what("transmission error"), ours.transmission_error_mm, theirs.transmission_error_mm, 1e-3);
        for (one, other) in ours.pairs.iter().zip(&theirs.pairs) {
            assert_eq!(one.pair, other.pair);
            assert_close(&what("load"), one.line_load_n_per_mm, other.line_load_n_per_mm, 1e-3);
            assert_close(&what("pressure"), one.peak_pressure_mpa, other.peak_pressure_mpa, 1e-2);
        }
        for gear in Gear::BOTH {
            let [one, other] = [ours, theirs].map(|at| at.root[gear].working_side_mpa);
            assert_close(&what("root stress"), one, other, 5e-3);
        }
    }
}

/// Loads and transmission error converge, shares add up, pressures away from the tip edges are Hertz's, torques in the ratio of the teeth.
#[test]
fn val_conformal_contact_converges_to_hertz() {
    let pair = GearPair::new(&planet_in_ring(Some(CUTTER))).unwrap();
    let path = &pair.path;
    let places = [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9].map(|part| path.start_mm + part * (path.end_mm - path.start_mm));
    let meshes = [4.0, 6.0, 9.0].map(|elements| {
        let model = condensed(&pair, &meshed(&pair, &settings(&pair, elements)));
        places.map(|place| at(&model, place))
    });
    let [coarse, middle, fine] = &meshes;
    for ((coarse, middle), fine) in coarse.iter().zip(middle).zip(fine) {
        let te = fine.transmission_error_mm;
        assert_close("transmission error", middle.transmission_error_mm, te, 3e-4);
        assert_close("transmission error", coarse.transmission_error_mm, te, 1e-3);
        assert!(fine.load_balance < 1e-9);
        assert!(fine.torque_ratio_error.abs() < 2e-3, "{}: {}", fine.position_mm, fine.torque_ratio_error);
        for (middle, fine) in middle.pairs.iter().zip(&fine.pairs) {
            assert_close("load", middle.line_load_n_per_mm, fine.line_load_n_per_mm, 2e-3);
        }
        for contact in &fine.pairs {
            let own_mm = fine.position_mm + f64::from(contact.pair) * path.base_pitch_mm;
            if own_mm < path.start_mm + 1.0 || own_mm > path.end_mm - 1.0 {
                continue;
            }
            // By hand: p₀ = √(w E*/(π R)), 1/R = 1/ρ1 − 1/|ρ2|.
            let curvature = 1.0 / own_mm - 1.0 / path.rho_mm(Gear::Wheel, own_mm).abs();
            let peak_mpa = (contact.line_load_n_per_mm * contact_modulus_mpa(BOTH) * curvature / PI).sqrt();
            assert_close("pressure", contact.peak_pressure_mpa, peak_mpa, 0.015);
        }
    }
}

/// The condensed ring is the whole ring, held all round its outside or on seven pins, with the tooth in mesh between two or at one.
#[test]
fn ver_condensation_is_exact() {
    let pair = GearPair::new(&planet_in_ring(None)).unwrap();
    let on_pins = |tooth| Some(RimPins { count: 7, tooth });
    let supports = [None, on_pins(ToothOnPins::AtPin), on_pins(ToothOnPins::BetweenPins)];
    let errors_mm = supports.map(|rim_pins| {
        let meshed = meshed(&pair, &BodySettings { rim_pins, ..settings(&pair, 4.0) });
        let found = at(&condensed(&pair, &meshed), pair.path.start_mm + 2.0);
        let whole = full::solve(&pair, &meshed, &BOTH, LINE_LOAD, &found).unwrap();
        assert_close("transmission error", whole.transmission_error_mm, found.transmission_error_mm, 2e-5);
        assert!(whole.residual < 1e-9, "{}", whole.residual);
        for (number, load) in whole.line_load_n_per_mm {
            let own = found.pairs.iter().find(|contact| contact.pair == number).expect("the same pairs touch");
            assert_close("load", load, own.line_load_n_per_mm, 1e-4);
        }
        found.transmission_error_mm
    });
    let [all_round_mm, on_pins_mm @ ..] = errors_mm;
    assert!(on_pins_mm.into_iter().all(|on_pins_mm| on_pins_mm > 1.5 * all_round_mm), "pins yield: {errors_mm:?}");
}

/// Teeth of wheels with ±20000 teeth in space are those of the same helical rack: compliance of a tooth within 0.3 %, as few elements divide a trochoid and an
/// arc unlike, and that between neighbours, a fiftieth of it, within 2 %.
#[test]
fn ver_teeth_in_space_are_the_same_rack() {
    let teeth = 20_000;
    let mm_per_n = [ring(teeth, 0.0, None, None), gear(teeth, 0.0, None)].map(|wheel| {
        let mut spec = spur(3.0, f64::NAN, 20.0, gear(20, 0.2, None), wheel);
        spec.helix_angle_rad = 15f64.to_radians();
        spec.centre_distance_mm = spec.centre_distance_with_mm(Backlash::Circumferential(0.0)).unwrap();
        let pair = GearPair::new(&spec).unwrap();
        let tooth = &pair.teeth.wheel;
        let clamp_radius_mm = PerGear::from_fn(|g| pair.teeth[g].root_radius_mm - 7.5);
        let bodies = clamp_radius_mm.map(|clamp_radius_mm| SpaceBody { clamp_radius_mm, web: None });
        let mesh = ExtrudedTooth::of_gear(&pair, Gear::Wheel, &bodies, &SpaceResolution::USUAL);
        let teeth = TeethInSpace::new(tooth, mesh, STEEL, 2).unwrap();
        let load = |below_tip_mm: f64, z_mm: f64| teeth.load([(tooth.tip_radius_mm - below_tip_mm, z_mm, 1.0)]);
        let (low, high, end) = (load(4.0, 6.0), load(1.0, 11.0), load(2.5, 20.0));
        [
            teeth.mm_per_n(&low, &high, 0),
            teeth.mm_per_n(&end, &end, 0),
            teeth.mm_per_n(&low, &end, 1),
            teeth.mm_per_n(&low, &end, -1),
        ]
    });
    for ((one, other), within) in mm_per_n[0].iter().zip(&mm_per_n[1]).zip([3e-3, 3e-3, 0.02, 0.02]) {
        assert_close("compliance", *one, *other, within);
    }
}
