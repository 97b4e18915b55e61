//! Finite-element contact of the gear pair.

mod common;

use common::fzg_c;
use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::cycle::cycle;
use gearwear::fem::gear::model::{Body, MeshedGear, ModelSettings};
use gearwear::fem::gear::position::{CondensedPair, WarmStart};
use gearwear::gear::{Gear, GearPair, PerGear};
use std::time::Instant;

fn steel() -> PerGear<Elastic> {
    PerGear::from_fn(|_| Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 })
}

#[test]
fn explore() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let w = 302e3 / pair.path.involute.pinion.base_radius_mm / 14.0;
    let body: Body = match std::env::var("BODY").as_deref() {
        Ok("free") => Body::Sector { teeth: 3, clamped_sides: false },
        Ok("clamped") => Body::Sector { teeth: 3, clamped_sides: true },
        _ => Body::Ring,
    };
    for n in [3.0, 5.0, 7.0, 10.0] {
        let settings = ModelSettings {
            body,
            clamp_radius_mm: PerGear { pinion: 19.943, wheel: 37.897 },
            elements_per_half_width: n,
        };
        let t = Instant::now();
        let meshed = PerGear::from_fn(|g| MeshedGear::new(&pair, g, &steel(), w, &settings).unwrap());
        let t_mesh = t.elapsed().as_secs_f64();
        let t = Instant::now();
        let gears = PerGear::from_fn(|g| meshed[g].condense(&pair, steel()[g]).unwrap());
        let t_cond = t.elapsed().as_secs_f64();
        println!(
            "n {n} dofs {:?} fine {:?} coarse {:?} cand {:?} cut {} mesh {t_mesh:.3} cond {t_cond:.3}",
            Gear::BOTH.map(|g| meshed[g].dofs()),
            Gear::BOTH.map(|g| meshed[g].fine.dofs()),
            Gear::BOTH.map(|g| meshed[g].coarse.as_ref().map(|c| c.dofs())),
            Gear::BOTH.map(|g| gears[g].1.surface.points_mm.len()),
            gears.pinion.0.sector.sector.cut_dofs()
        );
        let model = CondensedPair::new(&pair, &steel(), gears);
        for at in pair.path.points_mm().into_iter().chain([12.0, 16.0, 7.0, 20.0]) {
            let t = Instant::now();
            match model.at(at, w, &WarmStart::default()) {
                Ok(found) => {
                    let t1 = t.elapsed().as_secs_f64();
                    let t = Instant::now();
                    let again = model.at(at, w, &found.warm).unwrap();
                    println!(
                        "  {at:.4} TE {:.4} um  mult {} it {} cyc {} warm it {} cold {:.2} ms warm {:.2} ms T2 {:.1e} bal {:.1e} pen {:.1e}",
                        1e3 * found.transmission_error_mm,
                        found.multipliers,
                        found.log.steps.len(),
                        found.log.cycles_broken,
                        again.log.steps.len(),
                        1e3 * t1,
                        1e3 * t.elapsed().as_secs_f64(),
                        found.torque_ratio_error,
                        found.load_balance,
                        found.max_penetration_mm
                    );
                    for p in &found.pairs {
                        let x = at + p.pair as f64 * pair.path.base_pitch_mm;
                        let rho = [x, pair.path.line_of_action_mm - x];
                        let r = rho[0] * rho[1] / (rho[0] + rho[1]);
                        let e = 206e3 / 0.91 / 2.0;
                        let hertz = (p.line_load_n_per_mm * e / std::f64::consts::PI / r).sqrt();
                        let a = (4.0 * p.line_load_n_per_mm * r / std::f64::consts::PI / e).sqrt();
                        println!(
                            "     pair {:+} w {:.3} share {:.4} p {:.1} (Hertz {:.1}, {:+.2} %) a {:.4} ({:.4}) r {:.3} sharp {}",
                            p.pair,
                            p.line_load_n_per_mm,
                            p.line_load_n_per_mm / w,
                            p.peak_pressure_mpa,
                            hertz,
                            100.0 * (p.peak_pressure_mpa / hertz - 1.0),
                            p.half_width_mm,
                            a,
                            p.pinion_radius_mm,
                            p.at_sharp_edge
                        );
                    }
                }
                Err(e) => println!("  {at:.4} {e}"),
            }
        }
        let positions: Vec<f64> =
            (0..400).map(|k| pair.path.start_mm + (pair.path.end_mm - pair.path.start_mm) * k as f64 / 399.0).collect();
        let t = Instant::now();
        let all = cycle(&model, &positions, w);
        println!("  cycle {:?} {:.3} s", all.as_ref().map(|a| a.len()), t.elapsed().as_secs_f64());
    }
}
