//! Wear on the finite-element contact: what each flank loses follows from load and sliding, and wear opens the gaps as a
//! modification of the same shape does.

mod common;

use common::{assert_close, fzg_c, pair, steel};
use gearwear::contact::{Flanks, hertz};
use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::position::{CondensedPair, WarmStart};
use gearwear::gear::{
    Gear, GearPair, PerGear,
    flank::FlankGrid,
    modification::{Relief, ReliefShape},
    removed_material::modifications_mm,
    slices::Slices,
    spec::PairSpec,
};
use gearwear::mesh::settings::{Body, BodySettings, default_clamp};
use gearwear::wear::{WearModel, settings::WearSettings};
use gearwear::working_cycle::{CycleObservation, LostMaterial, MeshCycle, Work, condensed::CondensedCycle};

const TORQUE_N_MM: f64 = 302e3;
const COEFFICIENT: f64 = 1e-11;

fn line_load(pair: &GearPair) -> f64 {
    TORQUE_N_MM / pair.path.involute.pinion.base_radius_mm / pair.spec.face_width_mm
}

fn condensed(pair: &GearPair, elements_per_half_width: f64) -> CondensedPair<'_> {
    let clamp = |gear| default_clamp(pair.teeth[gear].root_radius_mm, pair.spec.normal_module_mm).radius_mm;
    let settings = BodySettings { body: Body::Ring, clamp_radius_mm: PerGear::from_fn(clamp), elements_per_half_width };
    let material =
        steel().map(|own| Elastic { young_modulus_mpa: own.young_modulus_mpa, poisson_ratio: own.poisson_ratio });
    CondensedPair::build(pair, &material, line_load(pair), &settings).expect("the pair of the test can be condensed")
}

fn grid(pair: &GearPair, flank_points: usize) -> PerGear<FlankGrid> {
    PerGear::from_fn(|gear| FlankGrid::new(pair, gear, flank_points))
}

/// One mesh of flanks that have lost `wear`: the depth each point loses, what was observed, the work.
fn mesh_once(
    model: &CondensedPair<'_>,
    grid: &PerGear<FlankGrid>,
    positions: usize,
    wear: &PerGear<Vec<f64>>,
) -> (PerGear<Vec<f64>>, CycleObservation, Work) {
    let flanks = Flanks { geometry: model.pair, grid: grid.as_ref() };
    let mut cycle = CondensedCycle::new(model, flanks, positions, line_load(model.pair));
    let wear_mm = wear.as_ref().map(Vec::as_slice);
    let lost = LostMaterial { removed_mm: wear_mm, wear_mm };
    let law = gearwear::wear::of(&WearSettings::archard(COEFFICIENT));
    let mut depth = none(grid);
    let work = cycle
        .evaluate(lost, &WearModel::cold(law.as_ref()), &mut depth, &|| false)
        .expect("the cycle has an equilibrium");
    let observed = cycle.observe(lost).expect("the cycle has an equilibrium");
    (depth, observed, work)
}

fn none(grid: &PerGear<FlankGrid>) -> PerGear<Vec<f64>> {
    grid.as_ref().map(|grid| vec![0.0; grid.len()])
}

fn relieved(spec: PairSpec, amount_mm: f64, length_mm: f64) -> PairSpec {
    let mut spec = spec;
    for gear in Gear::BOTH {
        spec.gears[gear].modification.tip_relief = Some(Relief { amount_mm, length_mm, shape: ReliefShape::Parabolic });
    }
    spec
}

/// ∫ h ds = k ∫ w v_s dt on each flank, the load of each pair from the contact without any wear, by the trapezoidal rule over
/// its whole way. With the tips relieved by more than the teeth bend all contact is on the line of action, where
/// v_s dt = (1/r_b1 + 1/r_b2) |ξ − ξ_C| dξ.
#[test]
fn val_each_flank_loses_what_load_and_sliding_ask_for() {
    let pair = pair(&relieved(fzg_c(), 0.060, 5.0));
    let model = condensed(&pair, 6.0);
    let grid = grid(&pair, 750);
    let (depth, ..) = mesh_once(&model, &grid, 400, &none(&grid));
    let path = &pair.path;
    let curvatures = path.involute.map(|involute| 1.0 / involute.base_radius_mm).sum();
    let count = 300;
    let step = path.base_pitch_mm / f64::from(count);
    let mut asked = 0.0;
    let mut warm = WarmStart::default();
    for j in 0..count {
        let at = model.at(path.start_mm + f64::from(j) * step, line_load(&pair), &warm).unwrap();
        for contact in &at.pairs {
            let own = at.position_mm + f64::from(contact.pair) * path.base_pitch_mm;
            assert!(own > path.start_mm && own < path.end_mm, "contact at {own} is outside the line of action");
            // The force itself, not its part in the torque: the normals of a relieved flank have another lever.
            let tooth = (model.gears.pinion.teeth() / 2) as i32 + contact.pair;
            let force = at.forces.pinion[tooth as usize].iter().fold([0.0; 2], |mut sum, &(column, f)| {
                sum[column % 2] += f;
                sum
            });
            asked += force[0].hypot(force[1]) * curvatures * (own - path.pitch_point_mm).abs() * step;
        }
        warm = at.warm.clone();
    }
    asked *= COEFFICIENT;
    // A flank that lies m behind the nominal one, along normals that meet at its centre of curvature, is shorter by m/ρ.
    let lost = PerGear::from_fn(|gear| {
        let removed = modifications_mm(&pair, gear, &grid[gear], &Slices::new(&pair, 1));
        let shortened: Vec<f64> = (0..grid[gear].len())
            .map(|i| depth[gear][i] * (1.0 - removed[i] / grid[gear].coordinate_mm[i].max(1.0)))
            .collect();
        grid[gear].integral(&shortened)
    });
    for gear in Gear::BOTH {
        assert_close(&format!("{gear:?}"), lost[gear], asked, 1e-3);
    }
    assert_close("pinion against wheel", lost.pinion, lost.wheel, 1e-3);
}

/// Away from A–E, where load and speed change, each point wears like a disc: k w |ζ| within 1 %.
#[test]
fn val_away_from_a_to_e_each_point_wears_like_a_disc() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 8.0);
    let grid = grid(&pair, 750);
    let (depth, observed, _) = mesh_once(&model, &grid, 400, &none(&grid));
    let at_pitch = hertz::flattening(&pair, &steel(), pair.path.pitch_point_mm);
    let half_width = at_pitch.contact.loaded(line_load(&pair)).half_width_mm;
    let mut compared = 0;
    for gear in Gear::BOTH {
        let involute = pair.path.involute[gear];
        let marks = pair.path.points_mm().map(|at| involute.arc_mm(pair.path.rho_mm(gear, at)));
        for (i, &rho) in grid[gear].coordinate_mm.iter().enumerate() {
            let position = pair.path.rho_mm(gear, rho);
            let on_path = position > pair.path.start_mm && position < pair.path.end_mm;
            // Pairs touch early and part late, so that load changes over a longer stretch than between springs.
            if !on_path || marks.iter().any(|mark| (grid[gear].arc_mm[i] - mark).abs() < 5.0 * half_width) {
                continue;
            }
            let load = observed.nearest(position).unwrap().load_share * line_load(&pair);
            let exact = COEFFICIENT * load * pair.path.specific_sliding(gear, position).abs();
            assert_close(&format!("{gear:?} at {rho:.3}"), depth[gear][i], exact, 1e-2);
            compared += 1;
        }
    }
    assert!(compared > 120, "{compared} points compared");
}

/// Flanks that have lost the shape of a root relief touch as flanks that were meshed with it. (A tip relief would not do:
/// wear takes the tip edge with it, a mesh has it at the
/// tip circle.) Both flanks of a meshed tooth are relieved, so that it is thinner at its root by twice the relief, and softer:
/// three times 10 µm over some 9 mm of the part of the deflection that is bending, or 5e-4 of all.
#[test]
fn val_wear_opens_the_gap_as_a_relief_does() {
    let mut spec = fzg_c();
    for gear in Gear::BOTH {
        let relief = Relief { amount_mm: 0.005, length_mm: 6.0, shape: ReliefShape::Parabolic };
        spec.gears[gear].modification.root_relief = Some(relief);
    }
    let (plain, modified) = (pair(&fzg_c()), pair(&spec));
    let grid = grid(&plain, 750);
    let worn = PerGear::from_fn(|gear| modifications_mm(&modified, gear, &grid[gear], &Slices::new(&modified, 1)));
    let (_, by_wear, _) = mesh_once(&condensed(&plain, 6.0), &grid, 60, &worn);
    let (_, by_mesh, _) = mesh_once(&condensed(&modified, 6.0), &grid, 60, &none(&grid));
    for (worn, meshed) in by_wear.positions.iter().zip(&by_mesh.positions) {
        let what = format!("at {:.3}", worn.position_mm);
        assert_close(&what, worn.transmission_error_mm, meshed.transmission_error_mm, 1e-3);
        // Where pairs take over from each other, 0.02 µm of that softness are 1e-3 of the load.
        assert!((worn.load_share - meshed.load_share).abs() < 2e-3, "{what}: {worn:?} {meshed:?}");
        // The pressure is resolved to a per cent by 6 elements in a half-width; the mesh of the relieved tooth is another one.
        if meshed.load_share > 0.99 {
            assert_close(&what, worn.footprint.peak_pressure_mpa, meshed.footprint.peak_pressure_mpa, 0.02);
        }
    }
}

/// What is observed of the unworn pair is the finite-element contact as `gearwear fem` solves it.
#[test]
fn ver_the_unworn_cycle_is_the_finite_element_contact() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 6.0);
    let grid = grid(&pair, 200);
    let (_, observed, _) = mesh_once(&model, &grid, 24, &none(&grid));
    for position in &observed.positions {
        let found = model.at(position.position_mm, line_load(&pair), &WarmStart::default()).unwrap();
        let reference = found.pairs.iter().find(|contact| contact.pair == 0).unwrap();
        let what = format!("at {:.3}", position.position_mm);
        assert_close(&what, position.transmission_error_mm, found.transmission_error_mm, 1e-9);
        assert_close(&what, position.load_share * line_load(&pair), reference.line_load_n_per_mm, 1e-9);
        assert_close(&what, position.footprint.peak_pressure_mpa, reference.peak_pressure_mpa, 1e-9);
        assert!(position.load_imbalance.abs() < 1e-10);
    }
}

/// A position is factorised again only where its active set changes, and threads do not change a bit.
#[test]
fn ver_work_and_bits() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 4.0);
    let grid = grid(&pair, 200);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let run = || mesh_once(&model, &grid, 40, &none(&grid));
    let (first, second) = (one.install(run), two.install(run));
    assert_eq!(first.0, second.0);
    assert_eq!(first.1, second.1);
    // 40 positions from A to E are 39/1.4375 = 27.1 intervals in a base pitch.
    assert_eq!(first.2.equilibria, 27);
    assert!(first.2.newton_iterations <= 12 * 27, "{:?}", first.2);

    let flanks = Flanks { geometry: &pair, grid: grid.as_ref() };
    let mut cycle = CondensedCycle::new(&model, flanks, 40, line_load(&pair));
    let law = gearwear::wear::of(&WearSettings::archard(COEFFICIENT));
    let mut wear = none(&grid);
    let mut depth = none(&grid);
    let mut later = 0;
    for step in 0..5 {
        let wear_mm = wear.as_ref().map(Vec::as_slice);
        let lost = LostMaterial { removed_mm: wear_mm, wear_mm };
        let work = cycle.evaluate(lost, &WearModel::cold(law.as_ref()), &mut depth, &|| false).unwrap();
        later += if step == 0 { 0 } else { work.newton_iterations };
        for gear in Gear::BOTH {
            wear[gear].iter_mut().zip(&depth[gear]).for_each(|(wear, depth)| *wear += 2000.0 * depth);
        }
    }
    // Four warm evaluations of 27 positions: hardly more than one trial each.
    assert!(later <= 2 * 4 * 27, "{later} trials");
}

/// A node of an unmodified flank stands for the flank point at its own radius.
#[test]
fn ver_nodes_of_the_nominal_flank_stand_for_themselves() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 4.0);
    for gear in Gear::BOTH {
        let nominal = model.nominal_radius_mm(gear);
        for (point, radius) in model.flanks[gear].surface.points_mm.iter().zip(nominal) {
            assert!((point.norm() - radius).abs() < 1e-9, "{gear:?} {point} {radius}");
        }
    }
}
