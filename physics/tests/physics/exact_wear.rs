//! The exact wear test: while radii, speeds and load are constant, ∫ p v_s dt at a passing point is the line load times
//! the specific sliding, whatever the pressure distribution.

use gearwear_bodies::gear::{
    Gear, GearPair, PerGear,
    conjugate::ConjugateFlanks,
    flank::FlankGrid,
    involute::{TangentFramePoint, inv, inverse_inv},
};
use gearwear_physics::contact::{
    ContactSurface, Flanks, PositionCell,
    foundation::matched_mpa_per_mm,
    half_space::HalfSpace,
    hertz,
    hertz::Hertz,
    hertz_mean::HertzMean,
    settings::MatchCriterion,
    winkler::{Winkler, WinklerFoundation},
};
use gearwear_physics::mesh_cycle::{LineOfActionCycle, LoadingPosition, MeshCycle, PairInMesh};
use gearwear_physics::simulation::wear_run::Outcome;
use gearwear_physics::wear::{
    WearModel,
    settings::{SevereTransition, WearSettings},
};

use super::common::{assert_close, fzg_c, fzg_c_scene, gear, pair, spur, steel};

/// Two discs rolling and sliding on each other: coordinates are arc lengths, the position is the time.
struct TwoDiscs {
    radius_mm: PerGear<f64>,
    speed: PerGear<f64>,
    length_mm: f64,
}

impl ConjugateFlanks for TwoDiscs {
    fn contact_coordinate_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        match gear {
            Gear::Pinion => self.speed.pinion * position_mm,
            Gear::Wheel => self.length_mm - self.speed.wheel * position_mm,
        }
    }

    fn position_at_mm(&self, gear: Gear, coordinate_mm: f64) -> f64 {
        match gear {
            Gear::Pinion => coordinate_mm / self.speed.pinion,
            Gear::Wheel => (self.length_mm - coordinate_mm) / self.speed.wheel,
        }
    }

    fn in_tangent_frame(&self, gear: Gear, coordinate_mm: f64, position_mm: f64) -> TangentFramePoint {
        let radius = self.radius_mm[gear];
        let angle = (coordinate_mm - self.contact_coordinate_mm(gear, position_mm)) / radius;
        TangentFramePoint { along_mm: radius * angle.sin(), drop_mm: 2.0 * radius * (0.5 * angle).sin().powi(2) }
    }

    fn at_along(&self, gear: Gear, along_mm: f64, position_mm: f64) -> (f64, f64) {
        let radius = self.radius_mm[gear];
        let angle = (along_mm / radius).asin();
        let coordinate = self.contact_coordinate_mm(gear, position_mm) + radius * angle;
        (coordinate, 2.0 * radius * (0.5 * angle).sin().powi(2))
    }

    fn flank_limits_mm(&self, _gear: Gear) -> (f64, f64) {
        (0.0, self.length_mm)
    }

    fn curvature_radius_mm(&self, gear: Gear, _position_mm: f64) -> f64 {
        self.radius_mm[gear]
    }

    fn rolling_ratio(&self, gear: Gear, _position_mm: f64) -> f64 {
        self.speed[gear]
    }

    fn sliding_mm(&self, from_mm: f64, to_mm: f64) -> f64 {
        (self.speed.pinion - self.speed.wheel).abs() * (to_mm - from_mm)
    }

    fn depth_mm(&self, _gear: Gear, _position_mm: f64) -> f64 {
        5.0
    }
}

/// Depth that each disc's middle loses in one pass, over k w |1 − v_mate/v|.
fn disc_wear_over_exact(surface: impl Fn(f64, &TwoDiscs) -> Box<dyn ContactSurface>) -> PerGear<f64> {
    let discs = TwoDiscs {
        radius_mm: PerGear { pinion: 100.0, wheel: 250.0 },
        speed: PerGear { pinion: 1.0, wheel: 1.25 },
        length_mm: 3.0,
    };
    // Half-width 0.155 mm: 1/650 of the smaller radius, so that arc and tangent differ by less than 1e-6.
    let (line_load, k, spacing) = (30.0, 1e-11, 2e-4);
    let arcs: Vec<f64> = (0..=15_000).map(|i| f64::from(i) * spacing).collect();
    let grid = FlankGrid { coordinate_mm: arcs.clone(), arc_mm: arcs };
    let flanks = Flanks::new(&discs, PerGear { pinion: &grid, wheel: &grid });
    // Times from 0.8 to 1.6: the contact passes the middle of both discs completely.
    let (begin, step, count) = (0.8, 2e-4, 4000);
    let positions: Vec<LoadingPosition> = (0..count)
        .map(|j| {
            let at = begin + f64::from(j) * step;
            LoadingPosition {
                cell: PositionCell { position_mm: at, lower_mm: at - 0.5 * step, upper_mm: at + 0.5 * step },
                pairs: vec![PairInMesh { position_mm: at, teeth_n_per_mm2: 20e3, lever_ratio: 1.0 }],
                on_line_of_action: true,
            }
        })
        .collect();
    let surface = surface(line_load, &discs);
    let mut cycle = LineOfActionCycle::new(flanks, surface.as_ref(), &positions, line_load);
    let zeros = vec![0.0; grid.len()];
    let mut depth = PerGear { pinion: zeros.clone(), wheel: zeros.clone() };
    let law = gearwear_physics::wear::of(&WearSettings::archard(k));
    let nothing = PerGear { pinion: zeros.as_slice(), wheel: zeros.as_slice() };
    cycle.evaluate(nothing, &WearModel::cold(law.as_ref()), &mut depth, &|| false).unwrap();
    PerGear::from_fn(|gear| {
        let middle = discs.contact_coordinate_mm(gear, 1.2);
        let specific_sliding = 1.0 - discs.speed[gear.mate()] / discs.speed[gear];
        grid.value_at(&depth[gear], middle) / (k * line_load * specific_sliding.abs())
    })
}

#[test]
fn val_two_discs_wear_the_load_times_the_specific_sliding() {
    let winkler = |w: f64, discs: &TwoDiscs| -> Box<dyn ContactSurface> {
        let at = hertz::flattening(discs, &steel(), 1.0);
        let mpa_per_mm = matched_mpa_per_mm(MatchCriterion::HalfWidth, &at, w);
        Box::new(Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm }, expected_line_load_n_per_mm: w })
    };
    let half_space = |w: f64, _: &TwoDiscs| -> Box<dyn ContactSurface> {
        Box::new(HalfSpace { material: steel(), expected_line_load_n_per_mm: w })
    };
    let hertz = |w: f64, _: &TwoDiscs| -> Box<dyn ContactSurface> {
        Box::new(Hertz { material: steel(), expected_line_load_n_per_mm: w })
    };
    let hertz_mean = |_: f64, _: &TwoDiscs| -> Box<dyn ContactSurface> { Box::new(HertzMean { material: steel() }) };
    for (name, ratio) in [
        ("winkler", disc_wear_over_exact(winkler)),
        ("half-space", disc_wear_over_exact(half_space)),
        ("hertz", disc_wear_over_exact(hertz)),
        ("hertz-mean", disc_wear_over_exact(hertz_mean)),
    ] {
        for gear in Gear::BOTH {
            assert_close(&format!("{name} {gear:?}"), ratio[gear], 1.0, 1e-6);
        }
    }
}

/// A pair of 20 and 41 teeth at the centre distance without backlash.
fn twenty_to_forty_one() -> gearwear_bodies::gear::spec::PairSpec {
    let (x1, x2, alpha) = (0.3, 0.15, 20f64.to_radians());
    let working = inverse_inv(inv(alpha) + 2.0 * alpha.tan() * (x1 + x2) / 61.0);
    let centre_distance_mm = 0.5 * 3.0 * 61.0 * alpha.cos() / working.cos() + 0.01;
    spur(3.0, centre_distance_mm, 20.0, gear(20, x1, None), gear(41, x2, None))
}

/// One mesh of the unworn pair.
fn first_mesh(
    spec: &gearwear_bodies::gear::spec::PairSpec,
    torque_n_mm: f64,
    surface: &'static str,
) -> (GearPair, f64, Outcome) {
    let mut scene = fzg_c_scene();
    (scene.pair, scene.torque_n_mm, scene.surface) = (spec.clone(), torque_n_mm, surface);
    (scene.revolutions, scene.steps) = (1.0, 1.0);
    (pair(spec), scene.line_load(), scene.run())
}

/// What holds globally on a gear: ∫ h ds = k ∫ w v_s dt on each flank, so both gears lose the same volume per mesh.
#[test]
fn val_each_flank_loses_what_load_and_sliding_ask_for() {
    for (name, spec, torque) in
        [("fzg-c", fzg_c(), 302e3), ("fzg-c light", fzg_c(), 60.8e3), ("20/41", twenty_to_forty_one(), 150e3)]
    {
        for surface in ["winkler", "half-space", "hertz", "hertz-mean"] {
            let (pair, line_load, outcome) = first_mesh(&spec, torque, surface);
            let positions = &outcome.new.cycle.positions;
            // ∫ w v_s dt by the trapezoidal rule within each stretch of constant number of pairs: the load jumps between.
            let asked: f64 = positions
                .windows(2)
                .map(|two| {
                    let loads = two.iter().map(|p| p.load_share * line_load);
                    let jump = (two[0].load_share - two[1].load_share).abs() > 0.2;
                    let sliding = pair.sliding_mm(two[0].position_mm, two[1].position_mm);
                    if jump { jump_share(&pair, two, line_load) } else { 0.5 * loads.sum::<f64>() * sliding }
                })
                .sum::<f64>()
                * 1e-11;
            for gear in Gear::BOTH {
                let lost = outcome.grid[gear].integral(&outcome.new.depth_per_mesh_mm[gear]);
                assert_close(&format!("{name} {surface} {gear:?}"), lost, asked, 1e-3);
            }
            let [p, w] = Gear::BOTH.map(|g| outcome.grid[g].integral(&outcome.new.depth_per_mesh_mm[g]));
            assert_close(&format!("{name} {surface} pinion against wheel"), p, w, 1e-3);
        }
    }
}

/// ∫ w v_s over an interval in which the load jumps at B or D.
fn jump_share(pair: &GearPair, two: &[gearwear_physics::mesh_cycle::PositionObservation], line_load: f64) -> f64 {
    let jumps = [pair.path.lower_single_contact_mm(), pair.path.upper_single_contact_mm()];
    let at = jumps.into_iter().find(|&at| at >= two[0].position_mm - 1e-9 && at <= two[1].position_mm + 1e-9).unwrap();
    line_load
        * (two[0].load_share * pair.sliding_mm(two[0].position_mm, at)
            + two[1].load_share * pair.sliding_mm(at, two[1].position_mm))
}

/// Pointwise, a gear agrees with the discs only away from A–E, where load and speed change: within 1 % beyond three
/// half-widths of the whole load.
#[test]
fn val_away_from_a_to_e_each_point_wears_like_a_disc() {
    for (torque, surface) in [
        (302e3, "winkler"),
        (302e3, "half-space"),
        (302e3, "hertz"),
        (302e3, "hertz-mean"),
        (60.8e3, "winkler"),
        (60.8e3, "half-space"),
        (60.8e3, "hertz"),
    ] {
        let (pair, line_load, outcome) = first_mesh(&fzg_c(), torque, surface);
        let half_width =
            hertz::flattening(&pair, &steel(), pair.path.pitch_point_mm).contact.loaded(line_load).half_width_mm;
        let mut compared = 0;
        for gear in Gear::BOTH {
            let involute = pair.path.involute[gear];
            let marks = pair.path.points_mm().map(|at| involute.arc_mm(pair.path.rho_mm(gear, at)));
            for (i, &rho) in outcome.grid[gear].coordinate_mm.iter().enumerate() {
                let position = pair.position_at_mm(gear, rho);
                let on_path = position > pair.path.start_mm && position < pair.path.end_mm;
                let arc = outcome.grid[gear].arc_mm[i];
                if !on_path || marks.iter().any(|mark| (arc - mark).abs() < 3.0 * half_width) {
                    continue;
                }
                let load = outcome.new.cycle.nearest(position).unwrap().load_share * line_load;
                let exact = 1e-11 * load * pair.path.specific_sliding(gear, position).abs();
                let worn = outcome.new.depth_per_mesh_mm[gear][i];
                assert_close(&format!("{surface} {torque} {gear:?} at {rho:.3}"), worn, exact, 1e-2);
                compared += 1;
            }
        }
        assert!(compared > 200, "{compared} points compared");
    }
}

/// At A, with a third of the load at 302 N·m: k w |ζ| = 7.52e-12 m per mesh (independent calculation for the project).
#[test]
fn val_rate_at_the_start_of_contact() {
    let pair = pair(&fzg_c());
    let load = 302e3 / pair.path.involute.pinion.base_radius_mm / 14.0 / 3.0;
    let depth_mm = 1e-11 * load * pair.path.specific_sliding(Gear::Pinion, pair.path.start_mm).abs();
    assert_close("k w |zeta| at A", depth_mm * 1e-3, 7.52e-12, 1e-3);
}

/// At the state where a step begins, the wear that mild positions keep and that of the severe ones, found again, are the wear of all. A third of the
/// positions has one contact, which wears severely, the others share the load between two.
#[test]
fn ver_kept_wear_is_that_of_the_whole_evaluation() {
    let discs = TwoDiscs {
        radius_mm: PerGear { pinion: 100.0, wheel: 250.0 },
        speed: PerGear { pinion: 1.0, wheel: 1.25 },
        length_mm: 3.0,
    };
    let arcs: Vec<f64> = (0..=1500).map(|i| f64::from(i) * 2e-3).collect();
    let grid = FlankGrid { coordinate_mm: arcs.clone(), arc_mm: arcs };
    let flanks = Flanks::new(&discs, PerGear { pinion: &grid, wheel: &grid });
    let (line_load, step) = (30.0, 0.02);
    let positions: Vec<LoadingPosition> = (0..30)
        .map(|j| {
            let at = 0.9 + f64::from(j) * step;
            let pair = || PairInMesh { position_mm: at, teeth_n_per_mm2: 20e3, lever_ratio: 1.0 };
            LoadingPosition {
                cell: PositionCell { position_mm: at, lower_mm: at - 0.5 * step, upper_mm: at + 0.5 * step },
                pairs: if j < 10 { vec![pair()] } else { vec![pair(), pair()] },
                on_line_of_action: true,
            }
        })
        .collect();
    let whole_mpa = hertz::flattening(&discs, &steel(), 1.0).contact.loaded(line_load).peak_pressure_mpa;
    let severe = Some(SevereTransition { above_mpa: 0.85 * whole_mpa, factor: 10.0, band_mpa: 0.0 });
    let law = gearwear_physics::wear::of(&WearSettings { severe, ..WearSettings::archard(1e-11) });
    let wear = WearModel::cold(law.as_ref());
    for surface in [
        Box::new(HalfSpace { material: steel(), expected_line_load_n_per_mm: line_load }) as Box<dyn ContactSurface>,
        Box::new(Hertz { material: steel(), expected_line_load_n_per_mm: line_load }),
    ] {
        let mut cycle = LineOfActionCycle::new(flanks, surface.as_ref(), &positions, line_load);
        let zeros = vec![0.0; grid.len()];
        let lost = PerGear { pinion: zeros.as_slice(), wheel: zeros.as_slice() };
        let [mut whole, mut stage] = [(); 2].map(|()| PerGear { pinion: zeros.clone(), wheel: zeros.clone() });
        let all = cycle.evaluate(lost, &wear, &mut whole, &|| false).unwrap();
        cycle.begin_stages(lost, &wear);
        let part = cycle.evaluate_stage(lost, &wear, &mut stage, &|| false).unwrap();
        assert_eq!((all.equilibria, part.equilibria, part.partial_equilibria, part.mesh_cycles), (30, 10, 10, 0));
        let mut completed = PerGear { pinion: zeros.clone(), wheel: zeros.clone() };
        let rest = cycle.complete_stage(lost, &wear, &mut completed, &|| false).unwrap().unwrap();
        assert_eq!((rest.equilibria, rest.mesh_cycles), (20, 0));
        for gear in Gear::BOTH {
            let greatest = whole[gear].iter().copied().fold(0.0, f64::max);
            let apart =
                whole[gear].iter().zip(&stage[gear]).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
            assert!(greatest > 0.0 && apart < 1e-9 * greatest, "{gear:?}: {apart:e} of {greatest:e}");
            assert_eq!(whole[gear], completed[gear], "the same contacts in the same order");
        }
    }
}
