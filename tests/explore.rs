mod common;
use common::*;
use gearwear::gear::Gear;
use gearwear::simulation::figures::WearFigures;
#[test]
fn explore() {
    for surface in std::env::var("S").unwrap_or("winkler".into()).split(",").map(|s| &*s.to_string().leak()) {
        let mut scene = fzg_c_scene();
        scene.surface = surface;
        let p = pair(&scene.pair);
        let t = std::time::Instant::now();
        let out = scene.run();
        println!("{surface} {:?} steps {} work {:?}", t.elapsed(), out.wear_steps, out.work);
        for g in Gear::BOTH {
            let f = WearFigures::at(&p, g, &out, &out.worn);
            println!("{g:?}: {f:?} sap+{:.3}", f.peak_radius_mm - p.active_start_radius_mm(g));
        }
        println!("new peak p {} te {:?}", out.new.cycle.peak_pressure_mpa(), out.new.cycle.transmission_error_mm());
        println!("worn peak p {} te {:?}", out.worn.cycle.peak_pressure_mpa(), out.worn.cycle.transmission_error_mm());
        println!("share at A {}", out.new.cycle.positions[0].load_share);
        let worst = out
            .new
            .cycle
            .positions
            .iter()
            .chain(&out.worn.cycle.positions)
            .map(|p| p.load_imbalance.abs())
            .fold(0.0, f64::max);
        println!("imbalance {worst:e}");
        let vol = |g: Gear| out.grid[g].integral(&out.new.depth_per_mesh_mm[g]);
        println!(
            "vol {} {} ratio-1 {:e}",
            vol(Gear::Pinion),
            vol(Gear::Wheel),
            vol(Gear::Pinion) / vol(Gear::Wheel) - 1.0
        );
    }
}
