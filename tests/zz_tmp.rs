mod common;
use common::{Scene, fzg_c_scene};
#[test]
fn conv() {
    for (positions, points) in [(400,750),(1600,750), (400, 1500)] {
        let mut base = Scene { surface: "half-space", positions, flank_points: points, ..fzg_c_scene() };
        base.pair.gears.pinion.modification.tip_rounding_mm = 0.3;
        base.pair.gears.wheel.modification.tip_rounding_mm = 0.3;
        let o = base.run();
        let f = points/750;
        println!("{positions} {points}");
        let w = &o.worn.wear_mm.pinion;
        for i in (28*f)..(60*f) { print!("{:.4} ", w[i]*1e3); } println!();
        println!("second differences new");
        let w = &o.new.depth_per_mesh_mm.pinion;
        for i in (28*f)..(60*f) { print!("{:.4} ", w[i]*1e9); } println!();
    }
}
