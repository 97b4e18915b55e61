use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::position::CondensedPair;
use gearwear::gear::*;
use gearwear::scene::Scene;
use gearwear::fem::gear::prepared::NodalWear;
fn main() {
    let text = std::fs::read_to_string("/tmp/fz.toml").unwrap();
    let r = Scene::from_toml(&text).unwrap();
    let s = r.scene;
    let pair = GearPair::new(&s.pair).unwrap();
    let mat = s.material.map(|o| Elastic { young_modulus_mpa: o.young_modulus_mpa, poisson_ratio: o.poisson_ratio });
    let w = s.operation.pinion_torque_n_mm / pair.path.involute.pinion.base_radius_mm / s.pair.face_width_mm;
    let m = CondensedPair::build(&pair, &mat, w, &s.fem).unwrap();
    for g in Gear::BOTH {
        let f = &m.flanks[g];
        let mut v: Vec<(f64, f64)> = f.surface.points_mm.iter().zip(&f.from_tip_mm).map(|(p, t)| (p.norm(), *t)).collect();
        v.sort_by(|a, b| a.0.total_cmp(&b.0));
        println!("{:?} n {} lowest {:?} highest {:?} form {}", g, v.len(), v[0], v[v.len() - 1], pair.teeth[g].root_form_radius_mm);
        for k in v.iter().take(40).step_by(4) { print!("({:.4} {:.4}) ", k.0, k.1); }
        println!();
        for k in v.iter().rev().take(60).step_by(3) { print!("({:.4} {:.4}) ", k.0, k.1); }
        println!();
    }
    let wear: Option<NodalWear> = std::env::args().nth(1).map(|dir| PerGear::from_fn(|g| {
        let t = std::fs::read_to_string(format!("{dir}/{}.csv", g.name())).unwrap();
        let rows: Vec<(f64, f64)> = t.lines().filter(|l| !l.starts_with('#') && !l.starts_with('r')).map(|l| { let c: Vec<&str> = l.split(',').collect(); (c[0].parse().unwrap(), c[5].parse::<f64>().unwrap() * 1e-3) }).collect();
        m.flanks[g].surface.points_mm.iter().map(|p| { let r = p.norm(); let k = rows.partition_point(|x| x.0 <= r).clamp(1, rows.len() - 1); let (a, b) = (rows[k - 1], rows[k]); a.1 + ((r - a.0) / (b.0 - a.0)).clamp(0.0, 1.0) * (b.1 - a.1) }).collect()
    }));
    for at in [pair.path.start_mm + 0.4, pair.path.start_mm, pair.path.start_mm - 0.3] {
        let mut p = m.prepare(at, w);
        let found = m.solve(&mut p, wear.as_ref()).unwrap();
        println!("at {at} TE {} rows {} active {}", found.rigid[0], found.force.len(), found.active.iter().filter(|a| **a).count());
        for t in m.tooth_pairs(&p, &found) {
            println!(" pair {} load {:.2} peak {:.0} a {:.4} r {:.4} slave {:?}", t.pair, t.line_load_n_per_mm, t.peak_pressure_mpa, t.half_width_mm, t.pinion_radius_mm, t.slave);
            if t.pair == 0 { for (x, p) in &t.pressure { if *p > 0.0 { print!("({:.4} {:.0}) ", x, p); } } println!(); }
        }
    }
}
