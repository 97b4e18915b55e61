//! The record of a three-dimensional problem.

use nalgebra::{Vector3, Vector6};

use super::recording::{mesh_summary, out_of_balance};
use crate::scene::fem_problem::{Component, FemProblem, FemProblemFile, Posed};
use gearwear_fem::problem::Stop;
use gearwear_fem::space::problem::{SpaceEquilibrium, SpaceProblem};
use gearwear_fem::stress::von_mises_mpa;
use gearwear_physics::results::fem_problem::{
    BoundaryRow, FemRecord, FemSolution, FemSummary, InSpaceSummary, SpaceSolution,
};

/// The record of a solution, without the times of its stages.
pub(super) fn record(
    problem: &FemProblem,
    posed: Posed<SpaceProblem>,
    solution: &SpaceEquilibrium,
    stress_mpa: &[Vector6<f64>],
    mesh_hash: String,
) -> FemRecord {
    let Posed { problem: solved, bodies, warnings } = posed;
    let points_mm = &solved.solid.points_mm;
    let von_mises: Vec<f64> = stress_mpa.iter().map(|&stress| von_mises_mpa(stress.into())).collect();
    let displacement_mm: Vec<[f64; 3]> = solution.displacement_mm.chunks_exact(3).map(|u| [u[0], u[1], u[2]]).collect();
    let (peak_von_mises, peak_at) = greatest(von_mises.iter().copied());
    let (displacement, moved_at) = greatest(displacement_mm.iter().map(|u| Vector3::from(*u).norm()));
    let warnings = problem.warnings.iter().cloned().chain(warnings).chain(out_of_balance(solution.force_balance));
    let summary = FemSummary {
        title: problem.file.title.clone().unwrap_or_default(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        problem_hash: problem.hash(),
        mesh: mesh_summary(problem, mesh_hash, points_mm.len(), None),
        analysis: problem.file.third_direction(),
        stopped: Stop::Converged,
        dofs: solved.solid.dofs(),
        elements: solved.solid.elements.len(),
        iterations: solution.work.iterations,
        residual: solution.residual,
        force_balance: solution.force_balance,
        work: solution.work,
        stages: Vec::new(),
        wall_s: 0.0,
        contact: Vec::new(),
        peak_von_mises_MPa: peak_von_mises,
        in_space: Some(InSpaceSummary {
            peak_von_mises_at_mm: points_mm[peak_at].into(),
            greatest_displacement_mm: displacement,
            greatest_displacement_at_mm: points_mm[moved_at].into(),
        }),
        warnings: warnings.collect(),
    };
    let solution = SpaceSolution {
        boundary: boundary(&problem.file),
        problem: solved,
        displacement_mm,
        stress_MPa: stress_mpa.iter().map(|&stress| stress.into()).collect(),
        von_mises_MPa: von_mises,
    };
    FemRecord { summary, problem_toml: problem.to_toml(), bodies, solution: FemSolution::InSpace(solution) }
}

/// The greatest value, and the first place that has it.
fn greatest(values: impl Iterator<Item = f64>) -> (f64, usize) {
    let each = values.enumerate().map(|(place, value)| (value, place));
    each.reduce(|most, other| if other.0 > most.0 { other } else { most }).unwrap_or_default()
}

/// Supports and loads, direction by direction.
fn boundary(file: &FemProblemFile) -> Vec<BoundaryRow> {
    let row = |group: &str, (what, unit): (&'static str, &'static str), along| BoundaryRow {
        group: group.to_owned(),
        what,
        unit,
        along,
    };
    let given = |components: &Option<Vec<Component>>, values: &[f64]| {
        let is_given = |component: &Component| components.as_ref().is_some_and(|given| given.contains(component));
        Component::ALL.map(|component| values.get(component.index()).copied().filter(|_| is_given(&component)))
    };
    let supports =
        file.fixed.iter().map(|fixed| row(&fixed.group, ("held", "mm"), given(&fixed.components, &[0.0; 3])));
    let loads = file.load.iter().map(|load| match (&load.force_N, &load.displacement_mm) {
        (Some(force), _) => row(&load.group, ("force", "N"), [0, 1, 2].map(|along| force.get(along).copied())),
        (None, moved) => {
            let along = given(&load.components, moved.as_deref().unwrap_or_default());
            row(&load.group, ("displacement", "mm"), along)
        }
    });
    supports.chain(loads).collect()
}
