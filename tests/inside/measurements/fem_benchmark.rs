//! The NAFEMS cylinder on a block over four meshes, the finest with about 70,000 unknowns: one thread, times of this machine.

use std::time::Instant;

use super::super::common::grid::CylinderOnBlock;
use gearwear::fem::solid::ElementKind;
use gearwear::fem::{SolveError, solve};

#[test]
#[ignore = "prints the tables of docs/fem-verification.md"]
fn fem_benchmark_tables() -> Result<(), SolveError> {
    println!(
        "| element | per half-width | unknowns | p₀ MPa | a mm | active sets | s |\n|---|---|---|---|---|---|---|"
    );
    for kind in [ElementKind::Quad4, ElementKind::Triangle6, ElementKind::Quad8] {
        for n in [8.0, 16.0, 32.0, 64.0] {
            let problem = CylinderOnBlock::nafems(kind, n).problem();
            let start = Instant::now();
            let solution = solve(&problem)?;
            let contact = &solution.contacts[0];
            println!(
                "| {kind:?} | {n} | {} | {:.2} | {:.4} | {} | {:.2} |",
                problem.solid.dofs(),
                contact.peak_pressure_mpa,
                contact.half_width_mm,
                solution.work.iterations,
                start.elapsed().as_secs_f64()
            );
        }
    }
    Ok(())
}
