//! From what the solver found, in the program's units, to the record, in those of the output files.

use nalgebra::Vector2;

use crate::scene::fem_problem::{FemProblem, Posed};
use gearwear_fem::elastic::Analysis;
use gearwear_fem::element::ElementError;
use gearwear_fem::problem::{ContactPair, ContactState, Problem, Solution};
use gearwear_fem::stress::{self, StressRecovery};
use gearwear_mesh::quality::{self, MeshQuality};
use gearwear_physics::assessment::UM_PER_MM;
use gearwear_physics::assessment::hertz_comparison::{self, ContactPatch};
use gearwear_physics::results::fem_problem::{
    ContactCurve, ContactRow, FemContactSummary, FemRecord, FemSolution, FemSummary, MeshSummary, NodalStress,
    PlaneSolution,
};

/// Elements along the half-width from which on pressures are trusted.
const ENOUGH_ELEMENTS: f64 = 8.0;
/// Half-width and contact width differ by less than this, relatively, where the model holds one half of the contact.
const SAME_WIDTH: f64 = 1e-9;
/// External forces must balance to this, relatively.
const BALANCED: f64 = 1e-6;

/// The record of a solution, without the times of its stages.
pub(super) fn record(
    problem: &FemProblem,
    posed: Posed<Problem>,
    solution: &Solution,
    stress: Vec<NodalStress>,
    mesh_hash: String,
) -> FemRecord {
    let Posed { problem: solved, bodies, warnings } = posed;
    let names = problem.file.contact.iter();
    let states = solved.contacts.iter().zip(&solution.contacts);
    let (contact, contacts): (Vec<_>, Vec<_>) = names
        .zip(states)
        .enumerate()
        .map(|(number, (names, (pair, state)))| {
            let curve = curve(number, state, solution);
            let summary = contact(&solved, pair, state, &curve, [names.slave.clone(), names.master.clone()]);
            (summary, curve)
        })
        .unzip();
    let mut warnings: Vec<String> = problem.warnings.iter().cloned().chain(warnings).collect();
    warnings.extend(contact.iter().enumerate().filter_map(|(number, contact)| contact_warning(number, contact)));
    warnings.extend(out_of_balance(solution.force_balance));
    let summary = FemSummary {
        title: problem.file.title.clone().unwrap_or_default(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        problem_hash: problem.hash(),
        mesh: mesh_summary(
            problem,
            mesh_hash,
            solved.solid.points_mm.len(),
            quality::of_mesh(&solved.solid.to_mesh()).ok(),
        ),
        analysis: problem.file.third_direction(),
        stopped: solution.stop,
        dofs: solved.solid.dofs(),
        elements: solved.solid.elements.len(),
        iterations: solution.work.iterations,
        residual: solution.residual,
        force_balance: solution.force_balance,
        work: solution.work,
        stages: Vec::new(),
        wall_s: 0.0,
        contact,
        peak_von_mises_MPa: stress.iter().map(|stress| stress.von_mises_MPa).fold(0.0, f64::max),
        in_space: None,
        warnings,
    };
    let displacement_mm = solution.displacement_mm.chunks_exact(2).map(|u| [u[0], u[1]]).collect();
    let solution = FemSolution::Plane(PlaneSolution { problem: solved, displacement_mm, stress, contacts });
    FemRecord { summary, problem_toml: problem.to_toml(), bodies, solution }
}

/// The mesh of `problem`, which has so many `nodes` that belong to a body.
pub(super) fn mesh_summary(
    problem: &FemProblem,
    hash: String,
    nodes: usize,
    quality: Option<MeshQuality>,
) -> MeshSummary {
    MeshSummary { file: problem.file.mesh.file.clone(), hash, nodes, quality }
}

/// Warning where external forces and reactions do not balance.
pub(super) fn out_of_balance(force_balance: f64) -> Option<String> {
    let balanced = force_balance <= BALANCED;
    (!balanced).then(|| format!("external forces and reactions are out of balance by {force_balance:.1e}, relatively"))
}

/// The pressure along a slave surface.
fn curve(number: usize, state: &ContactState, solution: &Solution) -> ContactCurve {
    let mut along_mm = 0.0;
    let mut before: Option<Vector2<f64>> = None;
    let rows: Vec<ContactRow> = state
        .nodes
        .iter()
        .map(|node| {
            along_mm += before.map_or(0.0, |before| (node.at_mm - before).norm());
            before = Some(node.at_mm);
            let dof = 2 * node.node as usize;
            ContactRow {
                x_mm: node.at_mm.x,
                y_mm: node.at_mm.y,
                gap_mm: node.gap_mm.is_finite().then_some(node.gap_mm),
                pressure_MPa: node.pressure_mpa,
                traction_MPa: 0.0,
                contact: number,
                along_mm,
                displacement_x_mm: solution.displacement_mm[dof],
                displacement_y_mm: solution.displacement_mm[dof + 1],
                node: node.node,
            }
        })
        .collect();
    let centre_along_mm = if is_half(state) { loaded_end_mm(&rows) } else { mean_along_mm(&rows) };
    ContactCurve { rows, centre_along_mm }
}

/// Whether the zone ends on a line of symmetry.
fn is_half(state: &ContactState) -> bool {
    state.half_width_mm > 0.0
        && (state.half_width_mm - state.contact_width_mm).abs() <= SAME_WIDTH * state.contact_width_mm
}

/// The end of the surface that carries the greater pressure: the line of symmetry.
fn loaded_end_mm(rows: &[ContactRow]) -> f64 {
    match (rows.first(), rows.last()) {
        (Some(first), Some(last)) if first.pressure_MPa < last.pressure_MPa => last.along_mm,
        (Some(first), _) => first.along_mm,
        (None, _) => 0.0,
    }
}

/// Mean place of the pressure: ∫ p s ds / ∫ p ds by the trapezoidal rule.
fn mean_along_mm(rows: &[ContactRow]) -> f64 {
    let (mut force, mut moment) = (0.0, 0.0);
    for pair in rows.windows(2) {
        let ds = pair[1].along_mm - pair[0].along_mm;
        for row in pair {
            force += 0.5 * ds * row.pressure_MPa;
            moment += 0.5 * ds * row.pressure_MPa * row.along_mm;
        }
    }
    if force > 0.0 { moment / force } else { 0.0 }
}

fn contact(
    problem: &Problem,
    pair: &ContactPair,
    state: &ContactState,
    curve: &ContactCurve,
    [slave, master]: [String; 2],
) -> FemContactSummary {
    let half_model = is_half(state);
    let of_revolution = problem.analysis == Analysis::Axisymmetric;
    let middle = curve.rows.iter().min_by(|a, b| {
        let distance = |row: &ContactRow| (row.along_mm - curve.centre_along_mm).abs();
        distance(a).total_cmp(&distance(b))
    });
    let middle = middle.map_or(state.centre_mm, |row| Vector2::new(row.x_mm, row.y_mm));
    let patch = ContactPatch {
        centre_mm: middle,
        half_width_mm: state.half_width_mm,
        force_n_per_mm: state.force_n_per_mm,
        half_model,
    };
    FemContactSummary {
        slave,
        master,
        peak_pressure_MPa: state.peak_pressure_mpa,
        half_width_mm: state.half_width_mm,
        contact_width_mm: state.contact_width_mm,
        force_N_per_mm: (!of_revolution).then(|| state.force_n_per_mm.into()),
        force_N: of_revolution.then(|| state.force_n_per_mm.into()),
        max_penetration_um: state.max_penetration_mm * UM_PER_MM,
        centre_mm: state.centre_mm.into(),
        half_model,
        elements_per_half_width: elements_per_half_width(problem, pair, patch),
        hertz: hertz_comparison::hertz(problem, pair, patch),
    }
}

/// Half-width over the mean length of the slave's edges that it covers.
fn elements_per_half_width(problem: &Problem, pair: &ContactPair, patch: ContactPatch) -> Option<f64> {
    let at = |node: u32| problem.solid.points_mm[node as usize];
    let lengths: Vec<f64> = pair
        .slave
        .iter()
        .map(|edge| edge.ends.map(at))
        .filter(|[a, b]| ((a + b) / 2.0 - patch.centre_mm).norm() <= patch.half_width_mm)
        .map(|[a, b]| (b - a).norm())
        .collect();
    if lengths.is_empty() {
        return (patch.half_width_mm > 0.0).then_some(1.0);
    }
    Some(patch.half_width_mm * lengths.len() as f64 / lengths.iter().sum::<f64>())
}

fn contact_warning(number: usize, contact: &FemContactSummary) -> Option<String> {
    let names = format!("contact[{number}], {:?} on {:?}", contact.slave, contact.master);
    match contact.elements_per_half_width {
        None => Some(format!("{names}: the surfaces do not touch")),
        Some(elements) if elements < ENOUGH_ELEMENTS => Some(format!(
            "{names}: {elements:.1} elements along the half-width of {:.4} mm; the peak pressure needs at least {ENOUGH_ELEMENTS}",
            contact.half_width_mm
        )),
        Some(_) => None,
    }
}

/// Stress of every node: the mean over the bodies that are joined there.
///
/// # Errors
/// An element that is none; the solver would have found it first.
pub(super) fn nodal_stress(problem: &Problem, solution: &Solution) -> Result<Vec<NodalStress>, ElementError> {
    let recovery = StressRecovery::new(&problem.solid, &problem.materials, problem.analysis)?;
    let found = recovery.nodal_stresses(&solution.displacement_mm)?;
    Ok(found.chunk_by(|a, b| a.node == b.node).map(mean_stress).collect())
}

fn mean_stress(of_bodies: &[stress::NodalStress]) -> NodalStress {
    let first = of_bodies[0];
    let mean =
        |value: fn(&stress::NodalStress) -> f64| of_bodies.iter().map(value).sum::<f64>() / of_bodies.len() as f64;
    let mean = stress::NodalStress {
        sigma_x_mpa: mean(|s| s.sigma_x_mpa),
        sigma_y_mpa: mean(|s| s.sigma_y_mpa),
        tau_xy_mpa: mean(|s| s.tau_xy_mpa),
        sigma_z_mpa: mean(|s| s.sigma_z_mpa),
        ..first
    };
    NodalStress {
        components_MPa: [mean.sigma_x_mpa, mean.sigma_y_mpa, mean.sigma_z_mpa, mean.tau_xy_mpa],
        von_mises_MPa: mean.von_mises_mpa(),
    }
}
