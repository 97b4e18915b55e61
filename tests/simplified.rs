//! The simplified model of helical gears against the same model on flank points, and against what must hold of any.

mod common;

use common::{Scene, assert_close, fzg_c, fzg_c_scene, pair, steel};
use gearwear::contact::hertz_mean::HertzMean;
use gearwear::gear::{Gear, PerGear, spec::PairSpec};
use gearwear::simulation::{
    settings::{Numerics, Operation},
    wear_run::{MeshContact, Outcome, Unwatched, WearRun},
};
use gearwear::stiffness::{TeethSpring, settings::StiffnessSettings};
use gearwear::wear::{archard::Archard, settings::WearSettings};
use gearwear::working_cycle::{
    settings::{Coupling, SliceSettings},
    sliced_teeth::SlicedTeeth,
};

/// The transverse section of fzg-c with a helix angle, 20 mm wide.
fn helical(helix_angle_deg: f64) -> PairSpec {
    let helix_angle_rad = helix_angle_deg.to_radians();
    let (spur, to_normal) = (fzg_c(), helix_angle_rad.cos());
    let tan_alpha_n = spur.normal_pressure_angle_rad.tan() * to_normal;
    let mut spec = PairSpec {
        normal_module_mm: spur.normal_module_mm * to_normal,
        normal_pressure_angle_rad: tan_alpha_n.atan(),
        helix_angle_rad,
        face_width_mm: 20.0,
        ..spur
    };
    for gear in Gear::BOTH {
        spec.gears[gear].profile_shift /= to_normal;
    }
    spec.rack.addendum_factor /= to_normal;
    spec.rack.dedendum_factor /= to_normal;
    spec.rack.fillet_radius_factor /= to_normal;
    spec
}

/// The preset `helical` on the simplified surface.
fn scene(slices: usize, coupling: Coupling) -> Scene {
    Scene {
        pair: helical(15.0),
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
    let teeth = TeethSpring::new(scene.stiffness, scene.curve.as_ref(), &pair, &material, &surface, line_load);
    let law = Archard::new(&WearSettings { coefficient_mm2_per_n: scene.coefficient_mm2_per_n, severe: scene.severe });
    let sliced = SlicedTeeth::new(&pair, &material, scene.slices.expect("a scene with slices"));
    let operation = Operation {
        pinion_torque_n_mm: scene.torque_n_mm,
        pinion_speed_rpm: None,
        pinion_revolutions: scene.revolutions,
        snapshots_revolutions: scene.snapshots.clone(),
    };
    let numerics = Numerics {
        flank_points: scene.flank_points,
        positions: scene.positions,
        step_revolutions: scene.revolutions / scene.steps,
        error_estimate: false,
    };
    let contact = MeshContact::Simplified { material: &material, teeth: &teeth, sliced: &sliced };
    let run = WearRun { pair: &pair, contact, law: &law, line_load_n_per_mm: line_load, operation: &operation, numerics };
    run.run(&Unwatched).expect("the run of the test converges")
}

#[test]
fn first_look() {
    for coupling in [Coupling::None, Coupling::Slicing] {
        let scene = scene(20, coupling);
        for _ in 0..3 {
            let start = std::time::Instant::now();
            let outcome = run(&scene);
            println!("{:?} {:?} {:?}", coupling, start.elapsed(), outcome.work);
        }
        let fast = run(&scene);
        let start = std::time::Instant::now();
        let slow = scene.run();
        println!("generic {:?} {:?}", start.elapsed(), slow.work);
        for (a, b) in [(&fast.new, &slow.new), (&fast.worn, &slow.worn)] {
            let te = |o: &gearwear::simulation::wear_run::Snapshot| o.cycle.slices.as_ref().unwrap().transmission_error_mm.clone();
            let loads = |o: &gearwear::simulation::wear_run::Snapshot| o.cycle.slices.as_ref().unwrap().line_load_n_per_mm.clone();
            let d = te(a).iter().zip(te(b)).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
            let l = loads(a).iter().zip(loads(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("te {d:.2e} loads {l:.2e} imbalance {:.1e} {:.1e}", a.cycle.slices.as_ref().unwrap().load_imbalance, b.cycle.slices.as_ref().unwrap().load_imbalance);
            for gear in Gear::BOTH {
                for (n, x, y) in [("wear", &a.wear_mm, &b.wear_mm), ("depth", &a.depth_per_mesh_mm, &b.depth_per_mesh_mm), ("p", &a.cycle.pressure_mpa, &b.cycle.pressure_mpa), ("s", &a.cycle.sliding_mm, &b.cycle.sliding_mm)] {
                    let peak = y[gear].iter().copied().fold(0.0, f64::max);
                    let worst = x[gear].iter().zip(&y[gear]).enumerate().map(|(i, (x, y))| ((x - y).abs(), i)).fold((0.0, 0), |a: (f64, usize), b| if b.0 > a.0 { b } else { a });
                    let mean = x[gear].iter().zip(&y[gear]).map(|(x, y)| (x - y).abs()).sum::<f64>() / x[gear].len() as f64;
                    println!("  {gear:?} {n} peak {peak:.4e} {:.4e} worst {:.2e} at {} slice {} mean {:.2e}", x[gear].iter().copied().fold(0.0, f64::max), worst.0 / peak, worst.1 % 751, worst.1 / 751, mean / peak);
                }
            }
        }
    }
    let _ = (assert_close, PerGear { pinion: 0, wheel: 0 });
}

#[test]
fn timing() {
    let scene = scene(20, Coupling::None);
    for _ in 0..100 {
        run(&scene);
    }
}
