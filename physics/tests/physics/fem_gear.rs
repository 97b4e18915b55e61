//! Finite-element contact of the FZG type C pair at 302 N·m: against Hertz, against other programs, against itself.

use std::sync::Arc;

use gearwear_bodies::gear::modification::{Relief, ReliefShape};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::{GearPair, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::cycle::cycle;
use gearwear_bodies::gear_fem::full;
use gearwear_bodies::gear_fem::model::MeshedGear;
use gearwear_bodies::gear_fem::position::{PositionContact, ToothPairContact, WarmStart};
use gearwear_bodies::gear_mesh::settings::{Body, BodySettings, SectorSides};
use gearwear_bodies::reference::hertz_line::HertzLine;
use gearwear_fem::elastic::Elastic;
use gearwear_physics::assessment::kept_elements::KeptElements;

use super::common::{assert_close, fzg_c};

/// Steel; contact modulus of two such bodies.
const YOUNG_MODULUS_MPA: f64 = 206e3;
const CONTACT_MODULUS_MPA: f64 = YOUNG_MODULUS_MPA / (1.0 - 0.3 * 0.3) / 2.0;
/// Root radius less 2.5 modules, as the reference values were computed.
const CLAMP_RADIUS_MM: PerGear<f64> = PerGear { pinion: 19.943, wheel: 37.897 };

fn steel() -> PerGear<Elastic> {
    PerGear::from_fn(|_| Elastic { young_modulus_mpa: YOUNG_MODULUS_MPA, poisson_ratio: 0.3 })
}

fn settings(body: Body, elements_per_half_width: f64) -> BodySettings {
    BodySettings { body, ..BodySettings::rings(CLAMP_RADIUS_MM, elements_per_half_width) }
}

/// 302 N·m over base radius and face width.
fn line_load(pair: &GearPair) -> f64 {
    302e3 / pair.path.involute.pinion.base_radius_mm / pair.spec.face_width_mm
}

fn meshed(pair: &GearPair, settings: &BodySettings) -> PerGear<MeshedGear> {
    PerGear::from_fn(|gear| MeshedGear::new(pair, gear, &steel(), line_load(pair), settings).unwrap())
}

fn condensed<'a>(pair: &'a GearPair, meshed: &PerGear<MeshedGear>) -> CondensedPair<'a> {
    let gears = PerGear::from_fn(|gear| meshed[gear].condense(pair, steel()[gear]).unwrap());
    CondensedPair::new(pair, &steel(), gears)
}

fn model(pair: &GearPair, settings: BodySettings) -> CondensedPair<'_> {
    condensed(pair, &meshed(pair, &settings))
}

fn positions(pair: &GearPair, count: usize) -> Vec<f64> {
    let (start, end) = (pair.path.start_mm, pair.path.end_mm);
    (0..count).map(|k| start + (end - start) * k as f64 / (count - 1) as f64).collect()
}

/// Position of a tooth pair, and Hertz for its own load there.
fn own_position_mm(pair: &GearPair, at: &PositionContact, contact: &ToothPairContact) -> f64 {
    at.position_mm + f64::from(contact.pair) * pair.path.base_pitch_mm
}

fn hertz(pair: &GearPair, at: &PositionContact, contact: &ToothPairContact) -> (f64, f64) {
    let rho = own_position_mm(pair, at, contact);
    let line = HertzLine::new([rho, pair.path.line_of_action_mm - rho], CONTACT_MODULUS_MPA).unwrap();
    let loaded = line.loaded(contact.line_load_n_per_mm);
    (loaded.peak_pressure_mpa, loaded.half_width_mm)
}

/// Whether a pair touches a half-width or more inside A and E, away from the tip edges.
fn is_regular(pair: &GearPair, at: &PositionContact, contact: &ToothPairContact) -> bool {
    let own = own_position_mm(pair, at, contact);
    // Along the flank a half-width a takes a r_b/ρ of the path of contact.
    let margin = |rho: f64, r_b: f64| 1.2 * hertz(pair, at, contact).1 * r_b / rho;
    let path = &pair.path;
    let from_start = margin(own, path.involute.pinion.base_radius_mm);
    let to_end = margin(path.line_of_action_mm - own, path.involute.wheel.base_radius_mm);
    !contact.at_sharp_edge && own > path.start_mm + from_start && own < path.end_mm - to_end
}

#[test]
fn val_pressure_of_hertz_away_from_the_tip_edges() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let model = model(&pair, settings(Body::Ring, 10.0));
    let solved = cycle(&model, &positions(&pair, 80), line_load(&pair)).unwrap();
    let (mut compared, mut worst) = (0, 0.0_f64);
    for at in &solved {
        for contact in at.pairs.iter().filter(|contact| is_regular(&pair, at, contact)) {
            let (expected, _) = hertz(&pair, at, contact);
            let error = (contact.peak_pressure_mpa / expected - 1.0).abs();
            assert!(error < 0.015, "{} pair {}: {error}", at.position_mm, contact.pair);
            worst = worst.max(error);
            compared += 1;
        }
    }
    println!("{compared} contacts, worst {:.2} %", 100.0 * worst);
    assert!(compared > 90, "{compared}");
}

/// Equilibrium: shares add up, multipliers do not overlap, torques are in the ratio of the teeth (|T2/T1| = z2/z1).
#[test]
fn ver_forces_balance() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let model = model(&pair, settings(Body::Ring, 4.0));
    let solved = cycle(&model, &positions(&pair, 60), line_load(&pair)).unwrap();
    for at in &solved {
        assert!(at.load_balance < 1e-9, "{at:?}");
        assert!(at.max_penetration_mm < 1e-12, "{at:?}");
        assert!(at.pairs.iter().all(|contact| contact.line_load_n_per_mm > 0.0));
    }
    // The ratio of torques is that of the teeth where contact lies on the line of action; a deflected tooth shifts the contact a
    // little along the flank, a tip edge takes it off the line.
    for at in &solved {
        let allowed = if at.pairs.iter().any(|contact| contact.at_sharp_edge) { 5e-3 } else { 1e-3 };
        assert!(at.torque_ratio_error.abs() < allowed, "{} {}", at.position_mm, at.torque_ratio_error);
    }
}

/// Load shares and transmission error converge everywhere, peak pressures away from sharp edges.
#[test]
fn ver_three_meshes() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let at = positions(&pair, 25);
    let meshes = [4.0, 6.0, 9.0].map(|n| cycle(&model(&pair, settings(Body::Ring, n)), &at, line_load(&pair)).unwrap());
    let [coarse, middle, fine] = &meshes;
    let (mut worst_error, mut worst_share, mut worst_peak) = (0.0_f64, 0.0_f64, 0.0_f64);
    for ((c, m), f) in coarse.iter().zip(middle).zip(fine) {
        worst_error = worst_error.max((m.transmission_error_mm / f.transmission_error_mm - 1.0).abs());
        let share = |at: &PositionContact, number: i32| {
            at.pairs.iter().find(|p| p.pair == number).map_or(0.0, |p| p.line_load_n_per_mm) / line_load(&pair)
        };
        for number in -1..=1 {
            worst_share = worst_share.max((share(m, number) - share(f, number)).abs());
        }
        for contact in f.pairs.iter().filter(|contact| is_regular(&pair, f, contact)) {
            if let Some(other) = m.pairs.iter().find(|p| p.pair == contact.pair) {
                worst_peak = worst_peak.max((other.peak_pressure_mpa / contact.peak_pressure_mpa - 1.0).abs());
            }
        }
        // What the coarse mesh adds must be small too: the sequence settles.
        assert!((c.transmission_error_mm / f.transmission_error_mm - 1.0).abs() < 4e-3);
    }
    // Richardson: of second order in the element length, what is left on the fine mesh is the difference over 1.5² − 1.
    let left = [worst_error, worst_share, worst_peak].map(|difference| difference / (1.5 * 1.5 - 1.0));
    println!("left of the transmission error {:.1e}, of a share {:.1e}, of a peak {:.1e}", left[0], left[1], left[2]);
    assert!(left[0] < 2e-3 && left[1] < 2e-3 && left[2] < 1e-2);
    // Nor are the differences themselves larger.
    assert!(worst_error < 2e-3 && worst_share < 2e-3 && worst_peak < 1e-2);
}

fn rounded() -> PairSpec {
    let mut spec = fzg_c();
    spec.gears.pinion.modification.tip_rounding_mm = 0.1;
    spec.gears.wheel.modification.tip_rounding_mm = 0.1;
    spec
}

/// A sharp edge has a singular pressure; one rounded by 0.1 mm has not.
#[test]
fn ver_pressure_at_a_rounded_tip_converges() {
    let pair = GearPair::new(&rounded()).unwrap();
    let at = [pair.path.start_mm, pair.path.start_mm + 0.3, pair.path.end_mm];
    let [middle, fine] = [6.0, 9.0].map(|n| {
        let solved = cycle(&model(&pair, settings(Body::Ring, n)), &at, line_load(&pair)).unwrap();
        assert!(solved.iter().flat_map(|at| &at.pairs).all(|contact| !contact.at_sharp_edge));
        solved.iter().map(|at| at.pairs.iter().map(|p| p.peak_pressure_mpa).fold(0.0, f64::max)).collect::<Vec<_>>()
    });
    println!("{middle:?} {fine:?}");
    for (middle, fine) in middle.iter().zip(&fine) {
        assert_close("peak at the rounded tip", *middle, *fine, 0.03);
    }
}

/// Condensation is exact: the model of both whole gears gives the same.
#[test]
fn ver_condensed_is_the_whole_model() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let bodies = [
        Body::Ring,
        Body::Sector { teeth: 5, sides: SectorSides::Clamped },
        Body::Sector { teeth: 3, sides: SectorSides::Free },
    ];
    for body in bodies {
        let meshed = meshed(&pair, &settings(body, 3.0));
        let model = condensed(&pair, &meshed);
        for position_mm in [pair.path.start_mm, pair.path.pitch_point_mm, 20.0] {
            let found = model.at(position_mm, line_load(&pair), &WarmStart::default()).unwrap();
            let whole = full::solve(&pair, &meshed, &steel(), line_load(&pair), &found).unwrap();
            assert_close("transmission error", found.transmission_error_mm, whole.transmission_error_mm, 1e-8);
            for (contact, (load, peak)) in
                found.pairs.iter().zip(whole.line_load_n_per_mm.iter().zip(&whole.peak_pressure_mpa))
            {
                assert_eq!(contact.pair, load.0);
                assert_close("line load", contact.line_load_n_per_mm, load.1, 1e-8);
                assert_close("peak pressure", contact.peak_pressure_mpa, peak.1, 1e-8);
            }
        }
    }
}

/// The field recovered inside a tooth is the one that its condensed form speaks of.
#[test]
fn ver_recovered_field_is_that_of_the_condensed_tooth() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let model = model(&pair, settings(Body::Ring, 3.0));
    let found = model.at(pair.path.pitch_point_mm, line_load(&pair), &WarmStart::default()).unwrap();
    for gear in gearwear_bodies::gear::Gear::BOTH {
        let (body, forces) = (&model.gears[gear], &found.forces[gear]);
        let condensed = &body.sector;
        for tooth in 0..body.teeth() {
            let cuts = body.cut_displacement_mm(tooth, forces);
            let field = condensed.displacement_mm(&forces[tooth], &cuts);
            for (k, &node) in condensed.sector.candidates.iter().enumerate() {
                for component in 0..2 {
                    let row = 2 * k + component;
                    let by_force: f64 =
                        forces[tooth].iter().map(|&(c, f)| condensed.matrices.compliance[(row, c)] * f).sum();
                    let by_cut: f64 =
                        cuts.iter().enumerate().map(|(b, u)| condensed.matrices.carried[(row, b)] * u).sum();
                    let difference = field[2 * node as usize + component] - (by_force + by_cut);
                    assert!(difference.abs() < 1e-9 * found.transmission_error_mm, "{} {tooth} {k}", gear.name());
                }
            }
        }
    }
}

/// A cold start and a warm one end in the same state, and so does any number of threads.
#[test]
fn ver_same_bits_from_any_start_and_on_any_number_of_threads() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let model = model(&pair, settings(Body::Ring, 3.0));
    let at = positions(&pair, 40);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| cycle(&model, &at, line_load(&pair)).unwrap())
    };
    let (one, two) = (run(1), run(2));
    assert_eq!(one, two);
    let cold: usize = at
        .iter()
        .zip(&one)
        .map(|(&position_mm, warm)| {
            let cold = model.at(position_mm, line_load(&pair), &WarmStart::default()).unwrap();
            assert_eq!(cold.transmission_error_mm, warm.transmission_error_mm);
            assert_eq!(cold.pairs, warm.pairs);
            cold.log.steps.len()
        })
        .sum();
    let warm: usize = one.iter().map(|at| at.log.steps.len()).sum();
    assert!(3 * warm < 2 * cold, "{warm} active sets from warm starts, {cold} from cold ones");
}

/// Lengths in another unit, moduli and load along with it: the same relative answer.
#[test]
fn ver_same_in_mm_and_in_m() {
    let scaled = |s: f64| {
        let mut spec = fzg_c();
        spec.normal_module_mm *= s;
        spec.centre_distance_mm *= s;
        spec.face_width_mm *= s;
        for gear in [&mut spec.gears.pinion, &mut spec.gears.wheel] {
            gear.tip_diameter_mm = gear.tip_diameter_mm.map(|d| d * s);
        }
        let pair = GearPair::new(&spec).unwrap();
        let material =
            PerGear::from_fn(|_| Elastic { young_modulus_mpa: YOUNG_MODULUS_MPA / s / s, poisson_ratio: 0.3 });
        let settings = BodySettings::rings(CLAMP_RADIUS_MM.map(|r| r * s), 3.0);
        let load = 637.66 / s;
        let gears = PerGear::from_fn(|gear| {
            let meshed = MeshedGear::new(&pair, gear, &material, load, &settings).unwrap();
            meshed.condense(&pair, material[gear]).unwrap()
        });
        let model = CondensedPair::new(&pair, &material, gears);
        let found = model.at(pair.path.pitch_point_mm, load, &WarmStart::default()).unwrap();
        (found.transmission_error_mm / s, found.pairs[0].peak_pressure_mpa * s * s)
    };
    let (mm, m) = (scaled(1.0), scaled(1e-3));
    assert_close("transmission error", m.0, mm.0, 1e-9);
    assert_close("peak pressure", m.1, mm.1, 1e-9);
}

/// Runs of one study share gears of the same mesh: other loads, sizes of elements and materials have their own, and one gear is another beside a mate that
/// changes its mesh alone.
#[test]
fn gears_of_the_same_mesh_are_condensed_once() {
    let sectors = |kept: &KeptElements, load: f64, elements: f64, material: &PerGear<Elastic>, spec: &PairSpec| {
        let pair = GearPair::new(spec).unwrap();
        let built = kept.condensed(&pair, material, load * line_load(&pair), &settings(Body::Ring, elements), &|_| {});
        built.unwrap().gears.map(|gear| gear.sector)
    };
    let kept = KeptElements::up_to_gb(0.0);
    let of_pair = |kept: &KeptElements, load, elements| sectors(kept, load, elements, &steel(), &fzg_c()).pinion;
    let first = of_pair(&kept, 1.0, 2.0);
    assert!(Arc::ptr_eq(&first, &of_pair(&kept.clone(), 1.0, 2.0)));
    assert!(!Arc::ptr_eq(&first, &of_pair(&kept, 0.5, 2.0)));
    // That of the first pair has made room.
    assert!(!Arc::ptr_eq(&first, &of_pair(&kept, 1.0, 2.0)));
    assert!(!Arc::ptr_eq(&of_pair(&kept, 1.0, 2.0), &of_pair(&kept, 1.0, 3.0)));
    let none = KeptElements::default();
    assert!(!Arc::ptr_eq(&of_pair(&none, 1.0, 2.0), &of_pair(&none, 1.0, 2.0)));

    // A relief of the wheel that begins elsewhere makes another mesh of the pinion, one that is deeper does not.
    let relieved = |amount_mm: f64, length_mm: f64| {
        let mut spec = fzg_c();
        spec.gears.wheel.modification.tip_relief = Some(Relief { amount_mm, length_mm, shape: ReliefShape::Linear });
        spec
    };
    let kept = KeptElements::up_to_gb(0.2);
    let [one, deeper, longer, again] = [(0.02, 2.0), (0.03, 2.0), (0.02, 1.5), (0.02, 2.0)]
        .map(|(amount_mm, length_mm)| sectors(&kept, 1.0, 2.0, &steel(), &relieved(amount_mm, length_mm)));
    assert!(Arc::ptr_eq(&one.pinion, &deeper.pinion) && !Arc::ptr_eq(&one.wheel, &deeper.wheel));
    assert!(!Arc::ptr_eq(&one.pinion, &longer.pinion));
    assert!(Arc::ptr_eq(&one.pinion, &again.pinion) && Arc::ptr_eq(&one.wheel, &again.wheel));
    let softer = PerGear { wheel: Elastic { young_modulus_mpa: 1e5, ..steel().wheel }, ..steel() };
    let other = sectors(&kept, 1.0, 2.0, &softer, &relieved(0.02, 2.0));
    assert!(!Arc::ptr_eq(&one.wheel, &other.wheel));
}
