mod common;
use common::{Scene, fzg_c_scene, pair};
use gearwear::stiffness::settings::StiffnessSettings;
use gearwear::working_cycle::tip_contact::reach_mm;
#[test]
fn zz() {
    let mut base = Scene { stiffness: StiffnessSettings::WeberBanaschek, revolutions: 1.0, steps: 1.0, positions: 41, tip_contact: true, ..fzg_c_scene() };
    base.pair.gears.pinion.modification.tip_rounding_mm = 0.1;
    base.pair.gears.wheel.modification.tip_rounding_mm = 0.1;
    let g = pair(&base.pair);
    println!("reach {:?} {:?} points {:?}", reach_mm(&g, 0.04), reach_mm(&g, 0.08), g.path.points_mm());
    for (surface, tip, stiffness) in [("half-space", true, StiffnessSettings::WeberBanaschek), ("winkler", true, StiffnessSettings::WeberBanaschek), ("half-space", false, StiffnessSettings::WeberBanaschek)] {
        let scene = Scene { surface, tip_contact: tip, stiffness, ..base.clone() };
        let o = scene.run();
        println!("{surface} {tip}");
        for p in &o.new.cycle.positions {
            println!("  {:.4} share {:.4} te {:.3} p {:.0} a {:.4}", p.position_mm, p.load_share, p.transmission_error_mm*1e3, p.footprint.peak_pressure_mpa, p.footprint.half_width_mm);
        }
    }
    for surface in ["winkler","half-space"] { for tip in [false, true] {
        let t = std::time::Instant::now();
        let o = Scene { surface, tip_contact: tip, revolutions: 127.75*9000.0, steps: 150.0, positions: 400, ..base.clone() }.run();
        let w = &o.worn.wear_mm.pinion; let m = w.iter().cloned().fold(0.0, f64::max);
        println!("{surface} {tip} peak wear {:.4} {:?} work {:?}", m*1e3, t.elapsed(), o.work);
        for i in (0..w.len()).step_by(6) { print!("{:.2} ", w[i]*1e3); } println!();
    }}
}
