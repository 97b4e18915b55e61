//! The simplified model of helical gears against the same model on flank points, and against what must hold of any.

use gearwear_bodies::gear::{
    Gear, PerGear,
    conjugate::ConjugateFlanks,
    modification::{Modification, Relief, ReliefShape},
    spec::PairSpec,
};
use gearwear_physics::contact::{hertz::flattening, hertz_mean::HertzMean};
use gearwear_physics::mesh_cycle::simplified::closed_form::{AMPLE_LOADS, ContactForms, RANGES};
use gearwear_physics::mesh_cycle::wearing_pair::Snapshot;
use gearwear_physics::mesh_cycle::{
    settings::{Coupling, SliceSettings},
    slice_coupling::SliceCompliance,
    sliced_mesh::SlicedMesh,
    sliced_positions::{SliceEnds, sliced_positions},
    sliced_teeth::SlicedTeeth,
};
use gearwear_physics::observer::Unwatched;
use gearwear_physics::simulation::figures::WearFigures;
use gearwear_physics::simulation::mesh_contact::MeshContact;
use gearwear_physics::simulation::wear_run::{Outcome, RunPhase};
use gearwear_physics::stiffness::{TeethSpring, settings::StiffnessSettings};
use gearwear_physics::wear::{
    WearModel,
    settings::{SevereTransition, WearSettings},
};

use super::common::{Scene, assert_close, fzg_c, fzg_c_scene, pair, preset, steel, wear_run};

/// The preset `helical` on the simplified surface.
fn scene(slices: usize, coupling: Coupling) -> Scene {
    Scene {
        pair: preset("thesis-helical"),
        revolutions: 6e5,
        steps: 60.0,
        surface: "hertz-mean",
        stiffness: StiffnessSettings::WeberBanaschek,
        slices: Some(SliceSettings { count: slices, coupling }),
        ..fzg_c_scene()
    }
}

/// Runs it by the model whose wear is kept at contact points.
fn run(scene: &Scene) -> Outcome {
    let (pair, material) = (pair(&scene.pair), steel());
    let (surface, line_load) = (HertzMean { material }, scene.line_load());
    let teeth = TeethSpring::new(scene.stiffness, scene.curve.as_ref(), &pair, &material, &surface, line_load).unwrap();
    let law = gearwear_physics::wear::of(&WearSettings {
        severe: scene.severe,
        ..WearSettings::archard(scene.coefficient_mm2_per_n)
    });
    let compliance = SliceCompliance::of_plates(&pair, &material, teeth.states_the_section());
    let sliced = SlicedTeeth::new(&pair, &material, scene.slices.expect("a scene with slices"), compliance, None);
    let phase = RunPhase {
        contact: MeshContact::Simplified { material: &material, teeth: &teeth, sliced: &sliced },
        wear: WearModel::cold(law.as_ref()),
        line_load_n_per_mm: line_load,
        end_revolutions: scene.revolutions,
    };
    wear_run(&pair, &[phase], &scene.snapshots, scene.numerics())
        .run(&Unwatched)
        .expect("the run of the test converges")
}

/// The mesh of an unworn or worn pair.
fn mesh(snapshot: &Snapshot) -> &SlicedMesh {
    snapshot.cycle.slices.as_ref().expect("a pair with slices")
}

/// Greatest difference of any load and of the transmission error of two meshes, over the sum of all loads and the greatest
/// transmission error.
fn differences(a: &SlicedMesh, b: &SlicedMesh, line_load: f64) -> [f64; 2] {
    let greatest = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert_eq!(a.position_mm.len(), b.position_mm.len());
    let error = b.transmission_error_mm.iter().map(|error| error.abs()).fold(0.0, f64::max);
    [
        greatest(&a.line_load_n_per_mm, &b.line_load_n_per_mm) / (line_load * a.slices as f64),
        greatest(&a.transmission_error_mm, &b.transmission_error_mm) / error,
    ]
}

/// Unworn flanks: the same load sharing and transmission error as the general mesh cycle.
fn assert_same_mesh(what: &str, scene: &Scene, allowed: f64) {
    let scene = Scene { steps: 1.0, revolutions: 1.0, ..scene.clone() };
    let (simplified, general) = (run(&scene), scene.run());
    let [loads, error] = differences(mesh(&simplified.new), mesh(&general.new), scene.line_load());
    assert!(loads <= allowed && error <= allowed, "{what}: loads {loads:.1e}, transmission error {error:.1e}");
    assert!(mesh(&simplified.new).load_imbalance <= 1e-10);
}

/// The prepared closed form is the closed form, anywhere on the path and up to the load where it ends, to what its range of (a/t)²
/// allows: an independent calculation of the same polynomials is wrong by 7e-13, 3e-10, 7e-8 and 1.2e-5 of the flattening at most.
#[test]
fn ver_prepared_form_is_the_closed_form() {
    let mut hardest = 0;
    for name in ["helical", "h501", "h951"] {
        // Closed forms know no rounded tip edge.
        let mut spec = preset(name);
        Gear::BOTH.into_iter().for_each(|gear| spec.gears[gear].modification.tip_rounding_mm = 0.0);
        let (pair, material) = (pair(&spec), steel());
        for line_load in [100.0, 450.0, 4000.0] {
            let forms = ContactForms::new(&pair, &material, line_load);
            let phi = forms.log_compliance_mm2_per_n();
            for at in pair.path.evenly_mm(97) {
                let section = pair.normal_section();
                let (form, exact) = (forms.at(at), flattening(&section, &material, at));
                let depth = Gear::BOTH.map(|gear| pair.depth_mm(gear, at)).into_iter().fold(f64::INFINITY, f64::min);
                let per_load = form.square_half_width / (depth * depth);
                let range =
                    RANGES.into_iter().position(|range| range >= AMPLE_LOADS * line_load * per_load).unwrap_or(3);
                hardest = hardest.max(range);
                let allowed = [1e-9, 1e-9, 1e-7, 2e-5][range];
                for w in [1e-3, 1.0, 100.0, 0.3 * form.greatest_load_n_per_mm, form.greatest_load_n_per_mm] {
                    let [a1, a2, a3, a4] = form.series;
                    let rest = w * (a1 + w * (a2 + w * (a3 + w * a4)));
                    let approach = w * (form.surface_mm2_per_n - 0.5 * phi * w.ln() + rest);
                    let transverse_mm = section.obliquity.transverse_mm(exact.approach_mm(w));
                    assert_close(&format!("{name} at {at}, {w} N/mm"), approach, transverse_mm, allowed);
                }
                let half_width = (form.square_half_width * 100.0).sqrt();
                assert_close("half-width", half_width, exact.contact.loaded(100.0).half_width_mm, 1e-12);
            }
        }
    }
    assert_eq!(hardest, 3, "the widest range is tried too");
}

/// The general mesh cycle with the surface `hertz-mean` solves the same equations on unworn flanks; the least load leaves
/// contacts of the crowned flanks without load.
#[test]
fn val_unworn_flanks_share_the_load_as_on_the_general_cycle() {
    for coupling in [Coupling::None, Coupling::Slicing] {
        for count in [1, 2, 7, 20] {
            let plain = Scene { positions: 100, ..scene(count, coupling) };
            assert_same_mesh(&format!("{count} slices {coupling:?}"), &plain, 1e-9);
        }
        let small = Scene { positions: 100, flank_points: 200, ..scene(9, coupling) };
        let mut modified = small.clone();
        modified.pair.gears.pinion.modification = Modification {
            lead_crowning_mm: 0.03,
            tip_relief: Some(Relief { amount_mm: 0.02, length_mm: 2.0, shape: ReliefShape::Linear }),
            ..Modification::default()
        };
        modified.pair.gears.wheel.modification.helix_slope_mm = -0.02;
        // At a hundred times the load the strip is as wide as the tooth, at ten thousand times so wide that the general solver is asked.
        for (torque_n_mm, allowed) in [(3e3, 1e-9), (302e3, 1e-9), (3e7, 1e-5), (3e9, 1e-9)] {
            for scene in [&small, &modified] {
                let what = format!("{torque_n_mm} N·mm {coupling:?}");
                assert_same_mesh(&what, &Scene { torque_n_mm, ..scene.clone() }, allowed);
            }
        }
        let light = run(&Scene { torque_n_mm: 3e3, steps: 1.0, ..modified });
        let idle = |mesh: &SlicedMesh| mesh.line_load_n_per_mm.iter().filter(|&&load| load == 0.0).count();
        let outside = idle(mesh(&run(&Scene { steps: 1.0, ..small }).new));
        assert!(idle(mesh(&light.new)) > outside, "some contacts of the crowned flanks carry nothing");
    }
}

/// Mean over both flanks' points of the difference of two fields, over the greatest value.
fn mean_difference(a: &PerGear<Vec<f64>>, b: &PerGear<Vec<f64>>) -> f64 {
    let of_gear = |gear: Gear| {
        let peak = b[gear].iter().copied().fold(0.0, f64::max);
        let sum: f64 = a[gear].iter().zip(&b[gear]).map(|(a, b)| (a - b).abs()).sum();
        sum / a[gear].len() as f64 / peak
    };
    PerGear::from_fn(of_gear).sum() / 2.0
}

/// Whole wear runs of both models differ by what interpolating worn flanks between points costs the general one: it halves the
/// wear of the points at A and E, and loads them more. Every slice loses the same area.
#[test]
fn val_wear_is_that_of_the_general_cycle() {
    let severe = Some(SevereTransition { above_mpa: 1100.0, factor: 3.0, band_mpa: 0.0 });
    for (coupling, severe) in [(Coupling::None, None), (Coupling::Slicing, None), (Coupling::None, severe)] {
        let scene = Scene { severe, steps: 20.0, positions: 200, ..scene(8, coupling) };
        let (simplified, general) = (run(&scene), scene.run());
        let what = format!("{coupling:?} {severe:?}");
        // Where wear turns severe it jumps, between two points.
        let allowed = if severe.is_some() { 4e-3 } else { 2e-3 };
        for (a, b) in [(&simplified.new, &general.new), (&simplified.worn, &general.worn)] {
            assert!(mesh(a).load_imbalance <= 1e-10, "{what}");
            let fields = [
                ("depth", mean_difference(&a.depth_per_mesh_mm, &b.depth_per_mesh_mm)),
                ("pressure", mean_difference(&a.cycle.pressure_mpa, &b.cycle.pressure_mpa)),
                ("sliding", mean_difference(&a.cycle.sliding_mm, &b.cycle.sliding_mm)),
            ];
            for (name, difference) in fields {
                assert!(difference <= allowed, "{what} {name}: {difference:.1e}");
            }
        }
        let difference = mean_difference(&simplified.worn.wear_mm, &general.worn.wear_mm);
        assert!(difference <= 1e-3, "{what} wear: {difference:.1e}");
        let pair = pair(&scene.pair);
        for gear in Gear::BOTH {
            let of = |outcome: &Outcome| WearFigures::at(&pair, gear, outcome, &outcome.worn).slices;
            for (a, b) in of(&simplified).iter().zip(of(&general)) {
                assert_close(&format!("{what} {gear:?} area"), a.area_mm2, b.area_mm2, allowed);
            }
        }
    }
}

/// The flank integral of every slice's wear in a mesh is k ∫ w v_s dt of its own loads, new and worn, on both gears.
#[test]
fn val_exact_wear_of_every_slice() {
    for (count, coupling) in [(1, Coupling::None), (6, Coupling::None), (20, Coupling::None), (20, Coupling::Slicing)] {
        let scene = Scene { steps: 10.0, ..scene(count, coupling) };
        let (outcome, pair) = (run(&scene), pair(&scene.pair));
        let phases = sliced_positions(&pair.path, &outcome.slices, scene.positions, SliceEnds::AtOnce);
        for snapshot in [&outcome.new, &outcome.worn] {
            let mesh = mesh(snapshot);
            let spacing = mesh.base_pitch_mm / mesh.transmission_error_mm.len() as f64;
            let mut expected = vec![0.0; count];
            for phase in &phases {
                for contact in &phase.contacts {
                    let at = phase.position_mm + f64::from(contact.tooth) * mesh.base_pitch_mm;
                    let row = ((at - mesh.position_mm[0]) / spacing).round() as usize;
                    let load = mesh.line_load_n_per_mm[row * mesh.slices + contact.slice];
                    let sliding = pair.sliding_mm(contact.cell.lower_mm, contact.cell.upper_mm);
                    expected[contact.slice] += scene.coefficient_mm2_per_n * load * sliding;
                }
            }
            for gear in Gear::BOTH {
                let grid = &outcome.grid[gear];
                for (slice, depth) in snapshot.depth_per_mesh_mm[gear].chunks_exact(grid.len()).enumerate() {
                    let what = format!("{count} {coupling:?} {gear:?} slice {slice}");
                    assert_close(&what, grid.integral(depth), expected[slice], 1e-3);
                }
            }
        }
    }
}

/// The same bits on one thread and on two, of so many contacts that both have some.
#[test]
fn ver_threads_do_not_change_a_bit() {
    let scene = Scene { steps: 3.0, ..scene(90, Coupling::None) };
    let on =
        |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| run(&scene));
    let (one, two) = (on(1), on(2));
    assert_eq!(one.worn, two.worn);
    assert_eq!(one.work, two.work);
}

/// A negative helix angle is the mirror image: the last slice enters first. A spur pair with lead crowning is its own.
#[test]
fn val_mirrored_widths() {
    for (coupling, spur) in [(Coupling::None, false), (Coupling::Slicing, false), (Coupling::None, true)] {
        let mut right = Scene { steps: 5.0, positions: 100, ..scene(6, coupling) };
        if spur {
            right.pair = fzg_c();
            right.pair.gears.pinion.modification.lead_crowning_mm = 0.01;
        }
        let helix_angle_rad = -right.pair.helix_angle_rad;
        let left = Scene { pair: PairSpec { helix_angle_rad, ..right.pair.clone() }, ..right.clone() };
        let (right, left) = (run(&right), run(&left));
        for gear in Gear::BOTH {
            let points = right.grid[gear].len();
            let peak = right.worn.wear_mm[gear].iter().copied().fold(0.0, f64::max);
            assert!(peak > 0.0);
            for slice in 0..6 {
                let a = &right.worn.wear_mm[gear][slice * points..(slice + 1) * points];
                let b = &left.worn.wear_mm[gear][(5 - slice) * points..(6 - slice) * points];
                assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-7 * peak), "{coupling:?} {gear:?} {slice}");
            }
        }
    }
}

/// Contacts come and go while deep crowning wears away: loads stay positive and balanced, and the middle wears more than the ends.
#[test]
fn val_contact_comes_where_crowning_wears_away() {
    for coupling in [Coupling::None, Coupling::Slicing] {
        let mut scene = Scene { steps: 40.0, positions: 100, torque_n_mm: 30e3, ..scene(12, coupling) };
        scene.pair.gears.pinion.modification.lead_crowning_mm = 0.02;
        (scene.revolutions, scene.snapshots) = (1e7, vec![1e6, 5e6]);
        let outcome = run(&scene);
        let idle = |snapshot: &Snapshot| mesh(snapshot).line_load_n_per_mm.iter().filter(|&&load| load == 0.0).count();
        assert!(idle(&outcome.worn) < idle(&outcome.new), "{} {}", idle(&outcome.worn), idle(&outcome.new));
        for snapshot in outcome.snapshots.iter().chain([&outcome.new]) {
            assert!(mesh(snapshot).load_imbalance <= 1e-10);
            assert!(mesh(snapshot).line_load_n_per_mm.iter().all(|&load| load >= 0.0));
        }
        let slices = WearFigures::at(&pair(&scene.pair), Gear::Pinion, &outcome, &outcome.worn).slices;
        assert!(slices[6].area_mm2 > 2.0 * slices[0].area_mm2, "{coupling:?}");
    }
}

/// Two thousand slices give the wear of forty, to the error of forty.
#[test]
fn ver_as_many_slices_as_one_likes() {
    let figures = |count: usize| {
        let scene = Scene { steps: 3.0, positions: 40, flank_points: 100, ..scene(count, Coupling::Slicing) };
        let outcome = run(&scene);
        WearFigures::at(&pair(&scene.pair), Gear::Pinion, &outcome, &outcome.worn)
    };
    let (many, few) = (figures(2000), figures(40));
    assert_close("area", few.area_mm2, many.area_mm2, 5e-3);
}

/// Work of the preset's run: loads are followed with hardly more than one Newton step an equilibrium.
#[test]
fn ver_one_newton_step_follows_an_equilibrium() {
    for (coupling, most) in [(Coupling::None, 1.1), (Coupling::Slicing, 2.0)] {
        let work = run(&scene(20, coupling)).work;
        assert_eq!(work.mesh_cycles, 61);
        assert!(work.newton_iterations as f64 <= most * work.equilibria as f64, "{coupling:?}: {work:?}");
    }
}
