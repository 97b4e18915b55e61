use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::condensed_pair::CondensedPair;
use gearwear::gear::{modification::Modification, spec::*, *};
use gearwear::gear_mesh::settings::{Body, BodySettings, NO_WEBS, default_clamp};
use gearwear::mesh_cycle::{LostMaterial, MeshCycle, condensed::CondensedCycle};
use gearwear::wear::{WearModel, settings::WearSettings};
use gearwear_physics as gearwear;
fn main() {
    let file = std::env::args().nth(1).unwrap();
    let gear = |teeth, profile_shift, a: f64| GearSpec {
        teeth,
        profile_shift,
        tip_diameter_mm: None,
        tooth_thickness_allowance_mm: a,
        bore_diameter_mm: None,
        modification: Modification { tip_rounding_mm: 0.2, ..Modification::default() },
        shaft: None,
    };
    let spec = PairSpec {
        normal_module_mm: 3.0,
        normal_pressure_angle_rad: 20f64.to_radians(),
        helix_angle_rad: 0.0,
        centre_distance_mm: 114.74,
        face_width_mm: 30.0,
        rack: BasicRack::default(),
        axis_parallelism: AxisParallelism::default(),
        gears: PerGear { pinion: gear(19, 0.35, -0.06), wheel: gear(57, -0.1, -0.08) },
    };
    let pair = GearPair::new(&spec).unwrap();
    let clamp = |gear| default_clamp(pair.teeth[gear].root_radius_mm, 3.0).radius_mm;
    let settings = BodySettings {
        body: Body::Ring,
        clamp_radius_mm: PerGear::from_fn(clamp),
        web: NO_WEBS,
        elements_per_half_width: 4.0,
    };
    let material = PerGear {
        pinion: Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 },
        wheel: Elastic { young_modulus_mpa: 3200.0, poisson_ratio: 0.35 },
    };
    let w = 15e3 / pair.path.involute.pinion.base_radius_mm / 30.0;
    let model = CondensedPair::build(&pair, &material, w, &settings, &|_| {}).unwrap();
    let mut cycle = CondensedCycle::new(&model, 100, w);
    let r = cycle.radius_mm();
    eprintln!("nodes {:?} wheel from {} {}", r.map(|r| r.len()), r.wheel[0], r.wheel[1]);
    let mut worn = PerGear { pinion: vec![0.0; r.pinion.len()], wheel: vec![0.0; r.wheel.len()] };
    let law = gearwear::wear::of(&WearSettings::archard(1e-9));
    let wear = WearModel::cold(law.as_ref());
    let mut depth = PerGear { pinion: vec![0.0; worn.pinion.len()], wheel: vec![0.0; worn.wheel.len()] };
    let steps: usize = std::env::args().nth(2).map_or(0, |s| s.parse().unwrap());
    let step_mm: f64 = file.parse::<f64>().unwrap() * 1e-3;
    for k in 0..steps {
        let wm = worn.as_ref().map(Vec::as_slice);
        let lost = LostMaterial { removed_mm: wm, wear_mm: wm };
        cycle.evaluate(lost, &wear, &mut depth, &|| false).unwrap();
        cycle.linearise_anew_pub(lost, &wear, &mut depth);
        let g = depth.wheel.iter().copied().fold(0.0, f64::max);
        let most = worn.wheel.iter().copied().fold(0.0, f64::max);
        if most > 0.2 || k + 1 == steps {
            println!("steps {k} most {most}");
            break;
        }
        worn.wheel.iter_mut().zip(&depth.wheel).for_each(|(w, d)| *w += step_mm * d / g);
    }
    cycle.debug();
    for k in 0..80 {
        println!("{:.4} {:.2}", cycle.radius_mm().wheel[k], 1e3 * worn.wheel[k]);
    }
}
