//! Wear on the finite-element contact: what each flank loses follows from load and sliding, and wear opens the gaps as a
//! modification of the same shape does.

use gearwear_bodies::gear::{
    Gear, GearPair, PerGear,
    flank::{FlankGrid, PointSpacing},
    modification::{Relief, ReliefShape},
    removed_material::modifications_mm,
    slices::Slices,
    spec::PairSpec,
};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::position::WarmStart;
use gearwear_bodies::gear_mesh::settings::{BodySettings, default_clamp};
use gearwear_fem::elastic::Elastic;
use gearwear_physics::contact::hertz;
use gearwear_physics::mesh_cycle::condensed::{CondensedCycle, WearingElements, at_radii, unworn_wear_mm};
use gearwear_physics::mesh_cycle::{CycleObservation, MeshCycle, Work};
use gearwear_physics::wear::{
    WearModel,
    settings::{SevereTransition, WearSettings},
};

use super::common::{assert_close, fzg_c, pair, steel};

const TORQUE_N_MM: f64 = 302e3;
const COEFFICIENT: f64 = 1e-11;

fn line_load(pair: &GearPair) -> f64 {
    TORQUE_N_MM / pair.path.involute.pinion.base_radius_mm / pair.spec.face_width_mm
}

fn condensed(pair: &GearPair, elements_per_half_width: f64) -> CondensedPair<'_> {
    condensed_for(pair, elements_per_half_width, line_load(pair))
}

fn condensed_for(pair: &GearPair, elements_per_half_width: f64, line_load_n_per_mm: f64) -> CondensedPair<'_> {
    let clamp = |gear| default_clamp(pair.teeth[gear].root_radius_mm, pair.spec.normal_module_mm).radius_mm;
    let settings = BodySettings::rings(PerGear::from_fn(clamp), elements_per_half_width);
    let material =
        steel().map(|own| Elastic { young_modulus_mpa: own.young_modulus_mpa, poisson_ratio: own.poisson_ratio });
    CondensedPair::build(pair, &material, line_load_n_per_mm, &settings, &|_| {})
        .expect("the pair of the test can be condensed")
}

/// Under a twentieth of the load multipliers of smooth contacts are half as far apart on twice as many elements: what they share follows the mesh where
/// it resolves contacts, not its large elements below the active profile.
#[test]
fn ver_multipliers_follow_the_elements_under_a_light_load() {
    let pair = pair(&fzg_c());
    let light = 0.05 * line_load(&pair);
    let farthest_mm = |elements| {
        let model = condensed_for(&pair, elements, light);
        let positions = [0.3, 0.5, 0.7].map(|part| {
            let [start, end] = [pair.path.start_mm, pair.path.end_mm];
            start + part * (end - start)
        });
        positions.map(|position_mm| {
            let found = model.at(position_mm, light, &Default::default()).expect("the position has an equilibrium");
            let contact = found.pairs.iter().find(|contact| contact.pair == 0).expect("the pair is in contact");
            let loaded: Vec<f64> = contact.pressure.iter().filter(|(_, p)| *p > 0.0).map(|(along, _)| *along).collect();
            assert!(loaded.len() > 6, "{position_mm}: {}", loaded.len());
            loaded.windows(2).map(|two| two[1] - two[0]).fold(0.0, f64::max)
        })
    };
    let (coarse, fine) = (farthest_mm(4.0), farthest_mm(8.0));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!((0.4..0.65).contains(&(fine / coarse)), "{coarse} {fine}");
    }
}

/// An even depth at all multipliers wears the nodes between them evenly, those of a multiplier that stands for several rows too.
#[test]
fn ver_an_even_depth_wears_all_nodes_evenly() {
    let mut spec = fzg_c();
    for gear in Gear::BOTH {
        spec.gears[gear].modification.tip_rounding_mm = 0.05;
    }
    let pair = pair(&spec);
    let model = condensed(&pair, 3.0);
    let nodes = model.flank_nodes();
    let position_mm = pair.path.start_mm + 0.1 * (pair.path.end_mm - pair.path.start_mm);
    let prepared = model.prepare(position_mm, line_load(&pair));
    let transfers = model.load_transfers(&prepared, (position_mm, position_mm), 0.0, nodes.as_ref());
    let contact = transfers.iter().find(|contact| contact.pair == 0).expect("the pair faces itself");
    let mut depth_mm = vec![0.0; nodes[contact.slave].len()];
    contact.wear_nodes(contact.slave, &nodes[contact.slave], &vec![1.0; contact.len()], &mut depth_mm);
    let worn: Vec<usize> = (0..depth_mm.len()).filter(|&k| depth_mm[k] > 0.0).collect();
    assert!(worn.len() > contact.len() + 10, "multipliers stand for several nodes: {} {}", worn.len(), contact.len());
    for &k in &worn[4..worn.len() - 4] {
        assert!((depth_mm[k] - 1.0).abs() < 0.2, "node {k}: {}", depth_mm[k]);
    }
}

fn grid(pair: &GearPair, flank_points: usize) -> PerGear<FlankGrid> {
    PerGear::from_fn(|gear| FlankGrid::new(pair, gear, flank_points, PointSpacing::Even))
}

/// One mesh of flanks that have lost `wear` at their nodes: the depth each node loses, what was observed, the work, and the cycle.
fn mesh_once<'a>(
    model: &'a CondensedPair<'a>,
    positions: usize,
    wear: Option<&PerGear<Vec<f64>>>,
) -> (PerGear<Vec<f64>>, CycleObservation, Work, CondensedCycle<'a>) {
    let mut cycle = CondensedCycle::new(model, positions, line_load(model.pair));
    let unworn = cycle.nodes().map(|nodes| vec![0.0; nodes.len()]);
    let lost = wear.unwrap_or(&unworn).as_ref().map(Vec::as_slice);
    let law = gearwear_physics::wear::of(&WearSettings::archard(COEFFICIENT));
    let mut depth = unworn.clone();
    let work = cycle
        .evaluate(lost, &WearModel::cold(law.as_ref()), &mut depth, &|| false)
        .expect("the cycle has an equilibrium");
    let observed = cycle.observe(lost).expect("the cycle has an equilibrium");
    (depth, observed, work, cycle)
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
    let (depth, .., cycle) = mesh_once(&model, 400, None);
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
    let lost = PerGear::from_fn(|gear| {
        cycle.nodes()[gear].share_mm.iter().zip(&depth[gear]).map(|(share, depth)| share * depth).sum::<f64>()
    });
    for gear in Gear::BOTH {
        assert_close(&format!("{gear:?}"), lost[gear], asked, 1e-3);
    }
    // What one flank loses the other does too, contact by contact.
    assert_close("pinion against wheel", lost.pinion, lost.wheel, 1e-12);
}

/// Away from A–E, where load and speed change, each point wears like a disc: k w |ζ| within 1 %.
#[test]
fn val_away_from_a_to_e_each_point_wears_like_a_disc() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 8.0);
    let grid = grid(&pair, 750);
    let (at_nodes, observed, _, cycle) = mesh_once(&model, 400, None);
    let depth = PerGear::from_fn(|gear| {
        let involute = pair.path.involute[gear];
        let radii = grid[gear].coordinate_mm.iter().map(|&rho| involute.radius_mm(rho));
        at_radii(cycle.radius_mm()[gear], &at_nodes[gear], radii)
    });
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

/// Flanks that have lost the shape of a root relief touch as flanks that were meshed with it. (A tip relief would not do: wear takes the
/// tip edge with it, a mesh has it at the tip circle. Nor would sharp tip edges: they stay where they are, and what they meet moves under
/// load, of which a mesh knows nothing.) Both flanks of a meshed tooth are relieved, so that it is thinner at its root by twice the
/// relief, and softer: three times 8 µm over some 9 mm of the part of the deflection that is bending, or 4e-4 of all.
#[test]
fn val_wear_opens_the_gap_as_a_relief_does() {
    let with = |relief: Option<Relief>, tip_rounding_mm: f64| {
        let mut spec = fzg_c();
        for gear in Gear::BOTH {
            spec.gears[gear].modification.root_relief = relief;
            spec.gears[gear].modification.tip_rounding_mm = tip_rounding_mm;
        }
        pair(&spec)
    };
    let relief = Some(Relief { amount_mm: 0.004, length_mm: 6.0, shape: ReliefShape::Parabolic });
    let (plain, modified, relieved) = (with(None, 0.1), with(relief, 0.1), with(relief, 0.0));
    let grid = grid(&plain, 750);
    let (by_wear_model, by_mesh_model) = (condensed(&plain, 6.0), condensed(&modified, 6.0));
    let (.., cycle) = mesh_once(&by_wear_model, 400, None);
    let worn = PerGear::from_fn(|gear| {
        let removed = modifications_mm(&relieved, gear, &grid[gear], &Slices::new(&relieved, 1));
        let involute = plain.path.involute[gear];
        let rho = |radius: &f64| involute.curvature_radius_mm(*radius);
        cycle.radius_mm()[gear].iter().map(|radius| grid[gear].value_at(&removed, rho(radius))).collect()
    });
    let (_, by_wear, ..) = mesh_once(&by_wear_model, 400, Some(&worn));
    let (_, by_mesh, ..) = mesh_once(&by_mesh_model, 400, None);
    let off = by_wear.positions.iter().zip(&by_mesh.positions);
    let squares = off.map(|(worn, meshed)| (worn.transmission_error_mm / meshed.transmission_error_mm - 1.0).powi(2));
    let off = (squares.sum::<f64>() / by_wear.positions.len() as f64).sqrt();
    // The softness of the meshed tooth, and what lies between the positions; 8.6e-4 where the slave's material is not followed
    // along its flank.
    assert!(off < 7e-4, "transmission error, root mean square: {off}");
    for (worn, meshed) in by_wear.positions.iter().zip(&by_mesh.positions) {
        let what = format!("at {:.3}", worn.position_mm);
        // Rows lie between positions, which bend the kink where a tip edge takes over by some hundredths of a micrometre.
        assert_close(&what, worn.transmission_error_mm, meshed.transmission_error_mm, 1.5e-3);
        // Where pairs take over from each other, 0.02 µm of that softness are 1e-3 of the load.
        assert!((worn.load_share - meshed.load_share).abs() < 2e-3, "{what}: {worn:?} {meshed:?}");
        // The pressure is resolved to a per cent by 6 elements in a half-width; the mesh of the relieved tooth is another one.
        if meshed.load_share > 0.99 {
            assert_close(&what, worn.footprint.peak_pressure_mpa, meshed.footprint.peak_pressure_mpa, 0.02);
        }
    }
}

/// What is observed of the unworn pair is the finite-element contact as `gearwear fem` solves it, but for its interpolation between the
/// positions of a base pitch.
#[test]
fn ver_the_unworn_cycle_is_the_finite_element_contact() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 6.0);
    let (_, observed, ..) = mesh_once(&model, 400, None);
    for position in observed.positions.iter().step_by(17) {
        let found = model.at(position.position_mm, line_load(&pair), &WarmStart::default()).unwrap();
        let reference = found.pairs.iter().find(|contact| contact.pair == 0).unwrap();
        let what = format!("at {:.3}", position.position_mm);
        assert_close(&what, position.transmission_error_mm, found.transmission_error_mm, 1e-3);
        assert!(
            (position.load_share * line_load(&pair) - reference.line_load_n_per_mm).abs() < 2e-3 * line_load(&pair),
            "{what}"
        );
        // Sharp tip edges carry singular pressures about A and E.
        if reference.line_load_n_per_mm > 0.99 * line_load(&pair) {
            assert_close(&what, position.footprint.peak_pressure_mpa, reference.peak_pressure_mpa, 2e-2);
        }
        assert!(position.load_imbalance.abs() < 1e-10);
    }
}

/// A position is factorised again only where its active set changes, and threads do not change a bit.
#[test]
fn ver_work_and_bits() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 4.0);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let run = || mesh_once(&model, 40, None);
    let ((first, first_seen, work, mut cycle), (second, second_seen, ..)) = (one.install(run), two.install(run));
    assert_eq!(first, second);
    assert_eq!(first_seen, second_seen);
    let positions = cycle.positions() as u64;
    assert_eq!(work.equilibria, positions);
    assert!(work.newton_iterations <= 12 * positions, "{work:?}");

    let law = gearwear_physics::wear::of(&WearSettings::archard(COEFFICIENT));
    let mut wear = first.as_ref().map(|row| vec![0.0; row.len()]);
    let mut depth = wear.clone();
    let mut later = 0;
    for step in 0..5 {
        let lost = wear.as_ref().map(Vec::as_slice);
        let work = cycle.evaluate(lost, &WearModel::cold(law.as_ref()), &mut depth, &|| false).unwrap();
        later += if step == 0 { 0 } else { work.newton_iterations };
        for gear in Gear::BOTH {
            wear[gear].iter_mut().zip(&depth[gear]).for_each(|(wear, depth)| *wear += 2000.0 * depth);
        }
    }
    // Four warm evaluations: hardly more than one trial for each position.
    assert!(later <= 2 * 4 * positions, "{later} trials");
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

/// Below the first node the involute has ended: nothing is worn there; up to the tip it is what it is at the last node.
#[test]
fn ver_nothing_wears_below_the_first_node() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 4.0);
    let cycle = CondensedCycle::new(&model, 20, line_load(&pair));
    for gear in Gear::BOTH {
        let nodes = model.nominal_radius_mm(gear);
        let first = nodes.iter().copied().fold(f64::INFINITY, f64::min);
        let last = nodes.iter().copied().fold(0.0, f64::max);
        let places = [first - 0.01, first, 0.5 * (first + last), last, last + 0.01];
        assert_eq!(
            at_radii(cycle.radius_mm()[gear], &vec![1.0; nodes.len()], places.into_iter()),
            [0.0, 1.0, 1.0, 1.0, 1.0]
        );
    }
}

/// A flank that turns by θ turns the load on it, whose lever on the pinion is r_b + θ ρ: the surface there moves along itself by ρ/r_b of
/// what the base circle moves.
#[test]
fn ver_tilt_changes_the_lever_by_the_radius_of_curvature() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 6.0);
    let path = &pair.path;
    // One pair is below the pitch point and one above it: each has its multipliers on the flank of another gear.
    for (position_mm, tilted) in [(path.start_mm + 2.0, Gear::Wheel), (path.end_mm - 2.0, Gear::Pinion)] {
        let mut prepared = model.prepare(position_mm, line_load(&pair));
        let found = model.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0).expect("the contact is found");
        let pairs = model.tooth_pairs(&prepared, &found);
        let theta = 1e-3;
        let tilts = prepared.mean_tilts(&found.force, |gear, _| if gear == tilted { theta } else { 0.0 });
        let change = prepared.lever_change(&found.force, &tilts);
        let of_pair = |ahead: i32| {
            let own = pairs.iter().find(|own| own.pair == ahead).expect("the pair is in contact");
            let rho_mm = path.rho_mm(Gear::Pinion, position_mm + f64::from(ahead) * path.base_pitch_mm);
            let others = 1.0 - own.line_load_n_per_mm / line_load(&pair);
            theta * rho_mm / path.involute.pinion.base_radius_mm * others
        };
        let on_tilted = pairs.iter().filter(|own| own.slave == tilted).map(|own| of_pair(own.pair));
        assert_close("change of the lever", change, on_tilted.fold(0.0, f64::max), 5e-3);
    }
}

/// Flanks tilted alike everywhere: the transmission error changes with the tilt, and with its sign, and the load is carried with the lever
/// that the tilted flanks have.
#[test]
fn ver_tilt_keeps_the_load_and_acts_in_proportion() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 6.0);
    let position_mm = pair.path.start_mm + 2.0;
    let transmission_error_mm = |theta: f64| {
        let mut prepared = model.prepare(position_mm, line_load(&pair));
        let level = model.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0).expect("the contact is found");
        model.tilt(&mut prepared, vec![theta; level.force.len()]);
        let found = model.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0).expect("the contact is found");
        (found.rigid[0], model.tooth_pairs(&prepared, &found).iter().map(|own| own.line_load_n_per_mm).sum::<f64>())
    };
    let (level, _) = transmission_error_mm(0.0);
    let (clockwise, carried) = transmission_error_mm(1e-3);
    let (anticlockwise, _) = transmission_error_mm(-1e-3);
    assert_close("line load", carried, line_load(&pair), 1e-9);
    let slope = (clockwise - anticlockwise) / 2e-3;
    assert!(
        (clockwise + anticlockwise - 2.0 * level).abs() < 2e-2 * (clockwise - anticlockwise).abs(),
        "{level} {clockwise}"
    );
    assert!(slope.abs() > 1e-3 * level, "{slope}");
}

/// B(θ) C B(θ)ᵀ takes work whatever the tilts, also where those of neighbouring multipliers are opposite: with its linear part alone it would not,
/// for forces of changing sign, which hardly press but shear.
#[test]
fn ver_contact_is_found_whatever_the_tilts() {
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 6.0);
    let mut prepared = model.prepare(pair.path.start_mm + 2.0, line_load(&pair));
    let level = model.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0).expect("the contact is found");
    model.tilt(&mut prepared, (0..level.force.len()).map(|row| if row % 2 == 0 { 0.3 } else { -0.3 }).collect());
    let tilted = model.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0).expect("the contact is found");
    let pairs = model.tooth_pairs(&prepared, &tilted);
    assert_close("line load", pairs.iter().map(|own| own.line_load_n_per_mm).sum(), line_load(&pair), 1e-9);
}

/// Flanks that have lost the same depth everywhere touch where new ones do, only later: no window grows, for the flanks are held apart by what they have lost
/// and bend away from each other beside their contact.
#[test]
fn ver_windows_of_evenly_worn_flanks_do_not_grow() {
    // With the approach of some 30 µm less than four fifths of the distance that the first window looks across, 25 w/E*.
    const DEPTH_MM: f64 = 0.02;
    let pair = pair(&fzg_c());
    let model = condensed(&pair, 6.0);
    for k in 0..12 {
        let position_mm = pair.path.start_mm + pair.path.base_pitch_mm * f64::from(k) / 12.0;
        let mut prepared = model.prepare(position_mm, line_load(&pair));
        let new = model.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0).expect("the contact is found");
        let windows = prepared.windows();
        let opened = &mut |_: &_, gap_mm: &mut [f64]| gap_mm.iter_mut().for_each(|gap| *gap += 2.0 * DEPTH_MM);
        let worn = model.solve(&mut prepared, opened, &|_, _| DEPTH_MM).expect("the contact is found");
        assert_eq!((windows, prepared.windows()), (1, 1), "at {position_mm} mm");
        assert_close("transmission error", worn.rigid[0] - new.rigid[0], 2.0 * DEPTH_MM, 1e-2);
    }
}

/// At the state where a step begins, the wear that mild positions keep and that of the severe ones, found again, are the wear of all: rounded tip edges
/// wear severely above 2500 MPa, the flanks carry up to 1700 MPa.
#[test]
fn ver_kept_wear_is_that_of_the_whole_evaluation() {
    let mut spec = fzg_c();
    for gear in Gear::BOTH {
        spec.gears[gear].modification.tip_rounding_mm = 0.1;
    }
    let pair = pair(&spec);
    let model = condensed(&pair, 3.0);
    let mut cycle = CondensedCycle::new(&model, 60, line_load(&pair));
    let unworn = cycle.nodes().map(|nodes| vec![0.0; nodes.len()]);
    let lost = unworn.as_ref().map(Vec::as_slice);
    let severe = Some(SevereTransition { above_mpa: 2500.0, factor: 10.0, band_mpa: 100.0 });
    let law = gearwear_physics::wear::of(&WearSettings { severe, ..WearSettings::archard(COEFFICIENT) });
    let wear = WearModel::cold(law.as_ref());
    let (mut whole, mut stage) = (unworn.clone(), unworn.clone());
    let all = cycle.evaluate(lost, &wear, &mut whole, &|| false).expect("the cycle has an equilibrium");
    cycle.begin_stages(lost, &wear);
    let part = cycle.evaluate_stage(lost, &wear, &mut stage, &|| false).expect("the cycle has an equilibrium");
    assert!(part.equilibria > 0 && 2 * part.equilibria < all.equilibria, "{part:?} of {all:?}");
    assert_eq!((part.partial_equilibria, part.mesh_cycles), (part.equilibria, 0));
    assert_close_wear(&stage, &whole);

    // On other flanks a stage has the new wear of the severe positions alone, and its completion that of all.
    let mut other = unworn.clone();
    let nodes = other.pinion.len() as f64;
    other.pinion.iter_mut().enumerate().for_each(|(node, depth)| *depth = 1e-3 * node as f64 / nodes);
    let lost = other.as_ref().map(Vec::as_slice);
    let part = cycle.evaluate_stage(lost, &wear, &mut stage, &|| false).expect("the cycle has an equilibrium");
    let mut completed = unworn.clone();
    let rest = cycle.complete_stage(lost, &wear, &mut completed, &|| false).expect("the cycle has an equilibrium");
    let rest = rest.expect("positions keep their wear");
    assert_eq!((part.equilibria + rest.equilibria, rest.mesh_cycles), (all.equilibria, 0));
    let mut anew = unworn.clone();
    cycle.evaluate(lost, &wear, &mut anew, &|| false).expect("the cycle has an equilibrium");
    assert_close_wear(&completed, &anew);
    assert!(
        Gear::BOTH.iter().any(|&gear| greatest_difference(&stage[gear], &anew[gear]) > 1e-4 * greatest(&anew[gear]))
    );
}

/// Positions are prepared once for the cycles of one resolution and load after another, however deeply the flanks of the one before were worn; what they find is
/// to the last bit what positions of their own find.
#[test]
fn ver_positions_are_prepared_once_for_many_cycles() {
    let pair = pair(&fzg_c());
    let severe = Some(SevereTransition { above_mpa: 1200.0, factor: 10.0, band_mpa: 100.0 });
    let law = gearwear_physics::wear::of(&WearSettings { severe, ..WearSettings::archard(COEFFICIENT) });
    let wear = WearModel::cold(law.as_ref());
    // A ramp on both flanks turns the normals, and opens the gaps beyond the first window.
    let ramp = |cycle: &CondensedCycle<'_>, ramp_mm: f64| {
        cycle.nodes().map(|nodes| {
            let last = nodes.len() as f64 - 1.0;
            (0..nodes.len()).map(|node| ramp_mm * (node as f64 / last)).collect::<Vec<_>>()
        })
    };
    let find = |cycle: &mut CondensedCycle<'_>, ramp_mm: f64| {
        let lost_mm = ramp(cycle, ramp_mm);
        let lost = lost_mm.as_ref().map(Vec::as_slice);
        let mut depth_mm = lost_mm.clone();
        cycle.evaluate(lost, &wear, &mut depth_mm, &|| false).expect("the cycle has an equilibrium");
        cycle.linearise_anew(lost, &wear, &mut depth_mm, &|| false).expect("the cycle has an equilibrium");
        (depth_mm, cycle.peak_to_peak_mm())
    };
    // A stage in which positions keep their wear, and an interruption.
    let leave_half_done = |cycle: &mut CondensedCycle<'_>| {
        let lost_mm = ramp(cycle, 0.01);
        let lost = lost_mm.as_ref().map(Vec::as_slice);
        let mut depth_mm = lost_mm.clone();
        cycle.begin_stages(lost, &wear);
        cycle.evaluate_stage(lost, &wear, &mut depth_mm, &|| false).expect("the cycle has an equilibrium");
        cycle.evaluate(lost, &wear, &mut depth_mm, &|| true).expect_err("the cycle was interrupted");
    };
    let elements = WearingElements::new(condensed(&pair, 3.0));
    let own = CondensedCycle::new(&elements.model, 40, line_load(&pair));
    let positions = own.positions() as u64;
    drop(own);
    for ramps_mm in [[0.0, 0.0], [0.0, 0.002], [0.3, 0.0], [0.01, 0.02], [0.0, 0.3], [0.02, 0.01]] {
        let mut cycle = elements.cycle(40, line_load(&pair));
        let found = ramps_mm.map(|ramp_mm| find(&mut cycle, ramp_mm));
        leave_half_done(&mut cycle);
        let mut own = CondensedCycle::new(&elements.model, 40, line_load(&pair));
        assert_eq!(found, ramps_mm.map(|ramp_mm| find(&mut own, ramp_mm)), "{ramps_mm:?} mm");
    }
    assert_eq!(elements.prepared_positions(), positions);
    // Nor do positions that are dropped one by one find anything else.
    let mut own = CondensedCycle::new(&elements.model, 40, line_load(&pair));
    let mut depth_mm = own.nodes().map(|nodes| vec![0.0; nodes.len()]);
    let unworn = depth_mm.clone();
    own.evaluate(unworn.as_ref().map(Vec::as_slice), &wear, &mut depth_mm, &|| false)
        .expect("the cycle has an equilibrium");
    assert_eq!(unworn_wear_mm(&elements.model, 40, line_load(&pair), &wear, &|| false), Ok(depth_mm));
    for (asked, load) in [(40, 0.9 * line_load(&pair)), (30, 0.9 * line_load(&pair))] {
        let before = elements.prepared_positions();
        let cycle = elements.cycle(asked, load);
        assert_eq!(elements.prepared_positions(), before + cycle.positions() as u64);
    }
    let before = elements.prepared_positions();
    elements.drop_idle();
    let cycle = elements.cycle(30, 0.9 * line_load(&pair));
    assert_eq!(elements.prepared_positions(), before + cycle.positions() as u64);
}

fn greatest(row: &[f64]) -> f64 {
    row.iter().copied().fold(0.0, f64::max)
}

fn greatest_difference(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

/// Fails where the wear of a flank is not that `expected` to the ninth digit.
fn assert_close_wear(found: &PerGear<Vec<f64>>, expected: &PerGear<Vec<f64>>) {
    for gear in Gear::BOTH {
        let (apart, most) = (greatest_difference(&found[gear], &expected[gear]), greatest(&expected[gear]));
        assert!(most > 0.0 && apart < 1e-9 * most, "{gear:?}: {apart:e} of {most:e}");
    }
}
