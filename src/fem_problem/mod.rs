//! Carries out a finite-element problem of one's own: mesh, problem, solution, stresses, record.

mod in_space;
mod recording;

use std::borrow::Cow;
use std::path::Path;
use std::time::Instant;

use crate::scene::Problem;
use crate::scene::fem_problem::FemProblem;
use crate::scene::short_hash;
use gearwear_fem::{self as fem, SolveError};
use gearwear_files::memory;
use gearwear_mesh::{self as mesh, CellBlock, Format, Mesh, MeshFileError};
use gearwear_physics::assessment::stage_clock::StageClock;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::fem_problem::FemRecord;

/// A factor that takes more than this is announced, GB; in space it takes 20 s about there.
const MUCH_MEMORY_GB: f64 = 0.5;

/// Memory that a node takes beside the entries of element matrices, bytes: 800 to 1000, of quadrilaterals and hexahedra.
const MEMORY_PER_NODE: u64 = 1000;

/// Why a problem was not solved.
#[derive(Debug, thiserror::Error)]
pub enum FemProblemError {
    /// File and mesh disagree, or the mesh cannot be read.
    #[error("{} problems, the first: {}", .0.len(), .0.first().map(ToString::to_string).unwrap_or_default())]
    Input(Vec<Problem>),
    /// Mesh and stiffness need more memory than there is.
    #[error("{0}")]
    Memory(String),
    /// The solver failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// Solves `problem`, whose mesh file is named relative to `folder`.
///
/// # Errors
/// Everything that is wrong with problem and mesh, or why the solver failed.
pub fn run(problem: &FemProblem, folder: &Path, observer: &dyn Observer) -> Result<FemRecord, FemProblemError> {
    let unreadable = |reason: String| FemProblemError::Input(problem.mesh_unreadable(&reason));
    let read = || -> Result<_, FemProblemError> {
        let path = folder.join(&problem.file.mesh.file);
        let read = mesh::read_with_content(&path);
        let (mesh, content) = read.map_err(|error: MeshFileError| match error {
            MeshFileError::Memory { .. } => FemProblemError::Memory(error.to_string()),
            error => unreadable(with_causes(&error)),
        })?;
        Ok((Cow::Owned(mesh), short_hash(&content)))
    };
    solved(problem, read, observer)
}

/// Solves `problem` on a mesh that is no file; the one that it names is not read.
///
/// # Errors
/// As [`run`].
pub fn on_mesh(problem: &FemProblem, mesh: &Mesh, observer: &dyn Observer) -> Result<FemRecord, FemProblemError> {
    let given = || {
        let text = mesh::to_bytes(mesh, Format::Json);
        let text = text.map_err(|error| FemProblemError::Input(problem.mesh_unreadable(&with_causes(&error))))?;
        Ok((Cow::Borrowed(mesh), short_hash(&text)))
    };
    solved(problem, given, observer)
}

/// Solves `problem` on the mesh that `given` gives with its hash.
fn solved<'m>(
    problem: &FemProblem,
    given: impl FnOnce() -> Result<(Cow<'m, Mesh>, String), FemProblemError>,
    observer: &dyn Observer,
) -> Result<FemRecord, FemProblemError> {
    let start = Instant::now();
    let mut stages = StageClock::new(observer);
    let (mesh, mesh_hash) = stages.run("mesh", given)?;
    let problem = &problem.for_mesh(&mesh).map_err(FemProblemError::Input)?;
    ask_for_memory(&mesh)?;
    let mut record = match problem.file.third_direction().in_plane() {
        Some(_) => {
            let posed = stages.run("problem", || problem.on(&mesh)).map_err(FemProblemError::Input)?;
            let solution = stages.run("solution", || fem::solve(&posed.problem))?;
            let stress = stages
                .run("stresses", || recording::nodal_stress(&posed.problem, &solution))
                .map_err(SolveError::from)?;
            recording::record(problem, posed, &solution, stress, mesh_hash)
        }
        None => {
            let posed = stages.run("problem", || problem.in_space_on(&mesh)).map_err(FemProblemError::Input)?;
            let announce = |gb: f64| {
                if gb > MUCH_MEMORY_GB {
                    let much = "the factor of the stiffness takes some";
                    observer
                        .announcement(&format!("{much} {gb:.1} GB, and a minute or more; fewer elements take less"));
                }
            };
            let solution = stages.run("solution", || fem::space::problem::solve(&posed.problem, &announce))?;
            let stress = stages
                .run("stresses", || posed.problem.nodal_stresses_mpa(&solution.displacement_mm))
                .map_err(SolveError::from)?;
            in_space::record(problem, posed, &solution, &stress, mesh_hash)
        }
    };
    record.summary.stages = stages.times;
    record.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(record)
}

/// Asks for the memory that the stiffness of `mesh` takes before it is factorised, which asks for its own.
fn ask_for_memory(mesh: &Mesh) -> Result<(), FemProblemError> {
    let entries = |block: &CellBlock| {
        let dofs_of_node = u64::from(block.kind.dimension());
        dofs_of_node.pow(2) * (block.kind.node_count() * block.nodes.len()) as u64
    };
    let needed = 8 * mesh.cells.iter().map(entries).sum::<u64>() + MEMORY_PER_NODE * mesh.points.len() as u64;
    match memory::can_be_had(needed) {
        true => Ok(()),
        false => Err(FemProblemError::Memory(format!(
            "the stiffness of this mesh takes some {} MB of memory, more than can be had; a coarser mesh takes less",
            needed >> 20
        ))),
    }
}

/// An error with everything that led to it, on one line.
fn with_causes(error: &dyn std::error::Error) -> String {
    let chain = std::iter::successors(error.source(), |cause| cause.source());
    chain.fold(error.to_string(), |text, cause| format!("{text}: {cause}"))
}
