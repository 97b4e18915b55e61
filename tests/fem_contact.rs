//! Contact of meshes against closed forms.

#[path = "common/grid.rs"]
mod grid;

use gearwear::fem::solid::ElementKind;
use gearwear::fem::solve;
use grid::CylinderOnBlock;

#[test]
fn val_nafems() {
    for kind in [ElementKind::Quad8, ElementKind::Quad4, ElementKind::Triangle6, ElementKind::Triangle3] {
        for n in [5.0, 10.0, 20.0] {
            let problem = CylinderOnBlock::nafems(kind, n).problem();
            let start = std::time::Instant::now();
            match solve(&problem) {
                Ok(solution) => {
                    let c = &solution.contacts[0];
                    println!(
                        "{kind:?} {n} dofs {} p {:.2} ({:+.3} %) a {:.4} ({:+.2} %) F {:?} pen {:.1e} res {:.1e} {:.1e} {:?} {:.2} s",
                        problem.solid.dofs(),
                        c.peak_pressure_mpa,
                        100.0 * (c.peak_pressure_mpa / 3585.4 - 1.0),
                        c.half_width_mm,
                        100.0 * (c.half_width_mm / 6.215 - 1.0),
                        c.force_n_per_mm,
                        c.max_penetration_mm,
                        solution.residual,
                        solution.force_balance,
                        solution.work,
                        start.elapsed().as_secs_f64()
                    );
                }
                Err(error) => println!("{kind:?} {n}: {error}"),
            }
        }
    }
}
