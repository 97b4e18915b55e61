//! Equilibrium of elastic bodies in contact.
//!
//! ```text
//! K u = F + Bᵀ f,        g = g⁰ + B u,        0 ≤ f ⟂ g ≥ 0
//! ```
//!
//! K is factorised once. With the bodies' free rigid motions R as unknowns of their own (amplitudes α, see
//! [`super::rigid_body`]) the displacements are u = K⁻¹(F + Bᵀ f) + R α, which leaves for the multipliers
//!
//! ```text
//! g = (g⁰ + B K⁻¹ F) + (B K⁻¹ Bᵀ) f + (B R) α,        (B R)ᵀ f = −Rᵀ F
//! ```
//!
//! a small dense problem for [`super::active_set`]. Loads may therefore move a body without supports until it touches.

use nalgebra::Vector2;
use sprs::{CsMat, TriMat};

use super::active_set::{ActiveSetError, Condensed};
use super::contact::mortar::MortarCoupling;
use super::contact::overlap::{Moved, largest_overlap_mm};
use super::contact::surface::Surface;
use super::contact::zones;
use super::elastic::Analysis;
use super::element::ElementError;
use super::factor::{Factor, FactorError};
use super::node_matrix::NodeMatrix;
use super::problem::{ContactNode, ContactState, Problem, Solution, Stop, Work};
use super::rigid_body::{RigidMotion, describe, free_motions};
use super::space::FoldedHexahedron;
use super::stiffness::Stiffness;

/// Reason why a problem has no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// An element or a material is invalid.
    #[error(transparent)]
    Element(#[from] ElementError),
    /// A hexahedron is inverted or degenerate.
    #[error(transparent)]
    Hexahedron(#[from] FoldedHexahedron),
    /// The stiffness matrix cannot be factorised.
    #[error(transparent)]
    Factor(#[from] FactorError),
    /// The contact has no equilibrium.
    #[error(transparent)]
    Contact(#[from] ActiveSetError),
    /// A body is held neither by supports nor by contact.
    #[error("{motion}; neither a support nor a contact holds it")]
    Floating {
        /// Description of the motion.
        motion: String,
    },
}

/// Contact of the problem with its surfaces and their coupling.
struct Interface {
    slave: Surface,
    master: Surface,
    coupling: MortarCoupling,
    /// Greatest distance of facing surfaces, mm.
    reach_mm: f64,
    /// First row of this contact among all multipliers.
    first_row: usize,
}

/// Finds the equilibrium of `problem`.
pub fn solve(problem: &Problem) -> Result<Solution, SolveError> {
    let solid = &problem.solid;
    let mut held = vec![false; solid.dofs()];
    for support in &problem.held {
        held[support.dof as usize] = true;
    }
    let motions = free_motions(solid, &held, problem.analysis);
    if !motions.is_empty() && problem.contacts.is_empty() {
        return Err(SolveError::Floating { motion: describe(&motions, &[1.0]) });
    }
    let mut anchored = held.clone();
    for motion in &motions {
        anchored[motion.anchor as usize] = true;
    }
    let stiffness = Stiffness::new(solid, &problem.materials, problem.analysis)?;
    let factor = Factor::new(&stiffness, &anchored)?;

    let interfaces = interfaces(problem);
    let coupling = global_operator(&interfaces, solid.dofs());
    let mut free = loaded(problem, &stiffness, &[]);
    factor.solve(1, &mut free);
    set_held(problem, &mut free);

    let mut work = Work { factorisations: 1, right_hand_sides: 2, ..Work::default() };
    let mut stop = Stop::Converged;
    let (force, rigid) = if interfaces.is_empty() {
        (Vec::new(), Vec::new())
    } else {
        let condensed = condensed(problem, &interfaces, &coupling, &factor, &motions, &free);
        work.right_hand_sides += coupling.rows();
        let found = condensed.solve(None).map_err(|error| name_the_motion(error, &motions))?;
        work.iterations = found.log.steps.len();
        work.active_set_changes = found.log.changes;
        work.cycles_broken = found.log.cycles_broken;
        if work.cycles_broken > 0 {
            stop = Stop::ConvergedAfterCycle;
        }
        (found.force, found.rigid)
    };

    let contact_forces = transpose_times(&coupling, &force, solid.dofs());
    let mut displacement_mm = loaded(problem, &stiffness, &contact_forces);
    factor.solve(1, &mut displacement_mm);
    set_held(problem, &mut displacement_mm);
    for (motion, alpha) in motions.iter().zip(&rigid) {
        for &node in &motion.nodes {
            let moved = *alpha * motion.at(solid.points_mm[node as usize]);
            displacement_mm[2 * node as usize] += moved.x;
            displacement_mm[2 * node as usize + 1] += moved.y;
        }
    }
    let balance = Balance::new(problem, &stiffness, &displacement_mm, &contact_forces, &held);
    let contacts =
        interfaces.iter().map(|interface| state(problem, interface, &coupling, &force, &displacement_mm)).collect();
    Ok(Solution { displacement_mm, contacts, stop, work, residual: balance.residual, force_balance: balance.forces })
}

/// The error with free motions described.
fn name_the_motion(error: ActiveSetError, motions: &[RigidMotion]) -> SolveError {
    match error {
        ActiveSetError::Floating { amplitudes } => SolveError::Floating { motion: describe(motions, &amplitudes) },
        error => error.into(),
    }
}

fn interfaces(problem: &Problem) -> Vec<Interface> {
    let mut first_row = 0;
    problem
        .contacts
        .iter()
        .map(|pair| {
            let slave = Surface::new(&pair.slave, &problem.solid.points_mm);
            let master = Surface::new(&pair.master, &problem.solid.points_mm);
            let reach_mm = slave.extent_mm() + master.extent_mm();
            let coupling = MortarCoupling::new(&slave, &master, reach_mm, problem.analysis);
            let interface = Interface { slave, master, coupling, reach_mm, first_row };
            first_row += interface.coupling.len();
            interface
        })
        .collect()
}

/// Coupling matrix B of all contacts, with a row for each multiplier and a column for each degree of freedom of the mesh.
fn global_operator(interfaces: &[Interface], dofs: usize) -> CsMat<f64> {
    let rows = interfaces.iter().map(|interface| interface.coupling.len()).sum();
    let mut triplets = TriMat::new((rows, dofs));
    for interface in interfaces {
        let sides = [(&interface.coupling.slave, &interface.slave), (&interface.coupling.master, &interface.master)];
        for (operator, surface) in sides {
            for (value, (row, column)) in operator {
                let dof = 2 * surface.mesh_nodes[column / 2] as usize + column % 2;
                triplets.add_triplet(interface.first_row + row, dof, *value);
            }
        }
    }
    triplets.to_csr()
}

/// Contact problem condensed onto the multipliers.
fn condensed(
    problem: &Problem,
    interfaces: &[Interface],
    coupling: &CsMat<f64>,
    factor: &Factor,
    motions: &[RigidMotion],
    free_displacement_mm: &[f64],
) -> Condensed {
    let columns: Vec<Vec<(u32, f64)>> =
        coupling.outer_iterator().map(|row| row.iter().map(|(dof, value)| (dof as u32, *value)).collect()).collect();
    let rigid_columns: Vec<Vec<f64>> = motions.iter().map(|motion| motion_field(problem, motion)).collect();
    let gap_mm = interfaces.iter().flat_map(|interface| interface.coupling.gap_mm.iter().copied());
    let moved = times(coupling, free_displacement_mm);
    let products: Vec<Vec<f64>> = rigid_columns.iter().map(|field| times(coupling, field)).collect();
    Condensed {
        compliance: factor.compliance(&columns),
        gap_mm: gap_mm.zip(moved).map(|(gap, moved)| gap + moved).collect(),
        rigid: faer::Mat::from_fn(coupling.rows(), motions.len(), |i, k| products[k][i]),
        rigid_load: rigid_columns.iter().map(|field| -dot(field, &problem.forces_n_per_mm)).collect(),
    }
}

/// Displacements of all degrees of freedom per amplitude of a rigid motion.
fn motion_field(problem: &Problem, motion: &RigidMotion) -> Vec<f64> {
    let mut field = vec![0.0; problem.solid.dofs()];
    for &node in &motion.nodes {
        let moved = motion.at(problem.solid.points_mm[node as usize]);
        field[2 * node as usize] = moved.x;
        field[2 * node as usize + 1] = moved.y;
    }
    field
}

/// External and contact forces less those of the given displacements.
fn loaded(problem: &Problem, stiffness: &Stiffness, contact_forces: &[f64]) -> Vec<f64> {
    let mut load = problem.forces_n_per_mm.clone();
    for (load, force) in load.iter_mut().zip(contact_forces) {
        *load += force;
    }
    if problem.held.iter().any(|support| support.displacement_mm != 0.0) {
        let mut given = vec![0.0; load.len()];
        set_held(problem, &mut given);
        for (load, taken) in load.iter_mut().zip(stiffness.matrix().multiply(&given)) {
            *load -= taken;
        }
    }
    load
}

fn set_held(problem: &Problem, displacement_mm: &mut [f64]) {
    for support in &problem.held {
        displacement_mm[support.dof as usize] = support.displacement_mm;
    }
}

/// Relative errors of equilibrium.
struct Balance {
    residual: f64,
    forces: f64,
}

/// Forces that are round-off of the stiffness times displacements: those of bodies that move as a whole, without loads.
pub(super) fn round_off_n(matrix: &NodeMatrix, displacement_mm: &[f64]) -> f64 {
    const ROUND_OFF: f64 = 1e-13;
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, value| most.max(value.abs()));
    let stiffest = greatest(&mut matrix.lower().data().iter().copied());
    ROUND_OFF * stiffest * greatest(&mut displacement_mm.iter().copied())
}

/// `value` over `scale`, 0 where both are 0.
pub(super) fn relative(value: f64, scale: f64) -> f64 {
    if scale > 0.0 { value / scale } else { 0.0 }
}

impl Balance {
    fn new(
        problem: &Problem,
        stiffness: &Stiffness,
        displacement_mm: &[f64],
        contact_forces: &[f64],
        held: &[bool],
    ) -> Self {
        let inner = stiffness.matrix().multiply(displacement_mm);
        let (mut greatest, mut unbalanced) = (0.0_f64, 0.0_f64);
        let (mut sum, mut sum_of_sizes) = ([0.0_f64; 2], 0.0_f64);
        for dof in 0..inner.len() {
            let outer = problem.forces_n_per_mm[dof] + contact_forces.get(dof).copied().unwrap_or(0.0);
            let rest = inner[dof] - outer;
            greatest = greatest.max(inner[dof].abs()).max(outer.abs());
            let external = problem.forces_n_per_mm[dof] + if held[dof] { rest } else { 0.0 };
            if !held[dof] {
                unbalanced = unbalanced.max(rest.abs());
            }
            sum[dof % 2] += external;
            sum_of_sizes += external.abs();
        }
        if problem.analysis == Analysis::Axisymmetric {
            // Forces along the radius balance by themselves.
            sum[0] = 0.0;
        }
        if greatest <= round_off_n(stiffness.matrix(), displacement_mm) {
            return Self { residual: 0.0, forces: 0.0 };
        }
        Self {
            residual: relative(unbalanced, greatest),
            forces: relative(sum[0].abs().max(sum[1].abs()), sum_of_sizes),
        }
    }
}

/// Contact of one interface in the solution.
fn state(
    problem: &Problem,
    interface: &Interface,
    coupling: &CsMat<f64>,
    force: &[f64],
    displacement_mm: &[f64],
) -> ContactState {
    let (slave, own) = (&interface.slave, &interface.coupling);
    let mut pressure = vec![0.0; slave.points_mm.len()];
    let mut gap = vec![f64::NAN; slave.points_mm.len()];
    let moved = times(coupling, displacement_mm);
    for (i, &node) in own.nodes.iter().enumerate() {
        let row = interface.first_row + i;
        pressure[node] = force[row] / own.weight_mm[i];
        gap[node] = own.gap_mm[i] + moved[row];
    }
    let local_force = &force[interface.first_row..interface.first_row + own.len()];
    let mut resultant = Resultant::of(slave, own, local_force);
    if problem.analysis == Analysis::Axisymmetric {
        // Around the circumference the radial part adds up to nothing.
        resultant.force.x = 0.0;
    }
    let mut nodes = Vec::with_capacity(pressure.len());
    let (mut contact_width_mm, mut half_width_mm) = (0.0, 0.0_f64);
    for path in slave.paths() {
        let along = slave.along_mm(&path);
        let values: Vec<f64> = path.iter().map(|&node| pressure[node]).collect();
        let on_symmetry = [path[0], path[path.len() - 1]].map(|node| held_along(problem, slave, node));
        for zone in zones::zones(&along, &values) {
            let half = zone.at_end.0 && on_symmetry[0] || zone.at_end.1 && on_symmetry[1];
            contact_width_mm += zone.width_mm();
            half_width_mm = half_width_mm.max(if half { zone.width_mm() } else { 0.5 * zone.width_mm() });
        }
        nodes.extend(path.iter().map(|&node| ContactNode {
            node: slave.mesh_nodes[node],
            at_mm: slave.points_mm[node],
            gap_mm: gap[node],
            pressure_mpa: pressure[node],
        }));
    }
    ContactState {
        force_n_per_mm: resultant.force,
        peak_pressure_mpa: pressure.iter().copied().fold(0.0, f64::max),
        contact_width_mm,
        half_width_mm,
        centre_mm: resultant.centre_mm,
        max_penetration_mm: overlap_mm(interface, displacement_mm),
        nodes,
    }
}

/// Greatest penetration of the deformed surfaces, mm.
fn overlap_mm(interface: &Interface, displacement_mm: &[f64]) -> f64 {
    let surfaces = [&interface.slave, &interface.master];
    let [slave, master] = surfaces.map(|surface| -> Vec<Vector2<f64>> {
        let dofs = surface.mesh_nodes.iter().map(|&node| 2 * node as usize);
        dofs.map(|dof| Vector2::from_column_slice(&displacement_mm[dof..dof + 2])).collect()
    });
    largest_overlap_mm(
        Moved { surface: surfaces[0], displacement_mm: &slave },
        Moved { surface: surfaces[1], displacement_mm: &master },
        interface.reach_mm,
    )
}

/// Whether supports hold an end of a surface in its own direction, as on a line of symmetry.
fn held_along(problem: &Problem, surface: &Surface, node: usize) -> bool {
    let normal = surface.normals[node];
    let along = if normal.x.abs() > normal.y.abs() { 1 } else { 0 };
    let dof = 2 * surface.mesh_nodes[node] + along;
    problem.held.iter().any(|support| support.dof == dof)
}

/// Force on the slave and its point of action on the surface.
struct Resultant {
    force: Vector2<f64>,
    centre_mm: Vector2<f64>,
}

impl Resultant {
    fn of(slave: &Surface, coupling: &MortarCoupling, force: &[f64]) -> Self {
        let nodal = transpose_times(&coupling.slave, force, 2 * slave.points_mm.len());
        let resultant: Vector2<f64> = nodal.chunks_exact(2).map(|pair| Vector2::new(pair[0], pair[1])).sum();
        let total: f64 = force.iter().sum();
        let weighted: Vector2<f64> =
            coupling.nodes.iter().zip(force).map(|(&node, f)| *f * slave.points_mm[node]).sum();
        let centre_mm = if total > 0.0 { weighted / total } else { Vector2::repeat(f64::NAN) };
        Self { force: resultant, centre_mm }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn times(operator: &CsMat<f64>, x: &[f64]) -> Vec<f64> {
    operator.outer_iterator().map(|row| row.iter().map(|(column, value)| value * x[column]).sum()).collect()
}

fn transpose_times(operator: &CsMat<f64>, f: &[f64], columns: usize) -> Vec<f64> {
    let mut result = vec![0.0; columns];
    for (row, f) in operator.outer_iterator().zip(f) {
        for (column, value) in row.iter() {
            result[column] += value * f;
        }
    }
    result
}
