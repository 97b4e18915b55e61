#![allow(missing_docs)]
use gearwear::calibration::{bodies::Setup, tooth_stiffness::LoadedPair};
use gearwear::gear::GearPair;
use gearwear::scene::Scene;
use std::time::Instant;
fn main() {
    let text = std::fs::read_to_string("src/scene/presets/fzg-c.toml").unwrap();
    let scene = Scene::from_toml(&text).unwrap().scene;
    let pair = GearPair::new(&scene.pair).unwrap();
    let w = scene.operation.pinion_torque_n_mm / pair.path.involute.pinion.base_radius_mm / scene.pair.face_width_mm;
    let setup = Setup { pair: &pair, material: scene.material, bodies: scene.fem, line_load_n_per_mm: w };
    let t = Instant::now();
    let meshed = setup.meshed().unwrap();
    let cond = setup.condensed(&meshed).unwrap();
    println!("condensed {:?}", t.elapsed());
    let loaded = LoadedPair::new(&cond, &scene.material);
    let rows = loaded.along_the_path(41, w).unwrap();
    println!("path {:?}", t.elapsed());
    for r in &rows {
        println!(
            "{:.3} pair {:.3} WB {:.3} | p whole {:.4} bend {:.4} WB {:.4} flat {:.4} cf {:.4} | w bend {:.4} WB {:.4} flat {:.4} cf {:.4} | {:?} {:?}",
            r.position_mm,
            r.pair_n_per_mm_um(),
            r.weber_banaschek_n_per_mm_um(),
            206e3 * r.pinion.whole_mm2_per_n,
            206e3 * r.pinion.bending_mm2_per_n,
            206e3 * r.pinion.weber_banaschek_bending_mm2_per_n,
            206e3 * r.pinion.flattening_mm2_per_n(),
            206e3 * r.pinion.closed_form_flattening_mm2_per_n,
            206e3 * r.wheel.bending_mm2_per_n,
            206e3 * r.wheel.weber_banaschek_bending_mm2_per_n,
            206e3 * r.wheel.flattening_mm2_per_n(),
            206e3 * r.wheel.closed_form_flattening_mm2_per_n,
            r.ahead_mm2_per_n.map(|q| q * 206e3),
            r.behind_mm2_per_n.map(|q| q * 206e3)
        );
    }
    kh(&cond, &loaded, w);
    let c = loaded.deflection(pair.path.pitch_point_mm, w).unwrap();
    println!("C {:.4}", c.pair_n_per_mm_um());
    let t = Instant::now();
    println!("{:#?}", setup.convergence().unwrap());
    println!("{:?}", t.elapsed());
    println!("{:#?}", setup.rim_depths().unwrap());
    println!("{:?}", t.elapsed());
    println!("{:#?}", setup.neighbours().unwrap());
    println!("{:?}", t.elapsed());
}
#[allow(dead_code)]
fn kh(cond: &gearwear::fem::gear::position::CondensedPair, loaded: &LoadedPair, w: f64) {
    use gearwear::calibration::{foundation_fit, single_contact};
    let t = Instant::now();
    let all = single_contact::solve(cond, loaded, w).unwrap();
    println!("single {:?} {}", t.elapsed(), all.len());
    for c in &all {
        println!(
            "{:.3} {:.2} {:?} a {:+.3}% p {:+.3}% d {:+.3}%",
            c.position_mm,
            c.line_load_n_per_mm / w,
            c.purpose,
            100. * (c.fem.half_width_mm / c.hertz.half_width_mm - 1.),
            100. * (c.fem.peak_pressure_mpa / c.hertz.peak_pressure_mpa - 1.),
            100. * (c.fem.approach_mm / c.hertz.approach_mm - 1.)
        );
    }
    let (curves, fits) = foundation_fit::all(&all, w, (loaded.pair.path.start_mm, loaded.pair.path.end_mm));
    for (c, f) in &fits {
        println!("{c:?} {:?}\n{:?}", f.fitted, f.held_out);
        println!("{:?}", curves[c]);
    }
}
