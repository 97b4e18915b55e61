//! **gearwear** predicts how the flanks of a gear pair wear, and what the wear does to pressure, load sharing and
//! transmission error; finite elements verify the answer.
//!
//! # A wear run
//!
//! A scene is a TOML file, or a preset with some keys replaced. It is opened with every file it names, checked, and run:
//!
//! ```
//! use gearwear::{LoadedScene, Unwatched};
//!
//! let scene = LoadedScene::preset("fzg-c")?.with("operation.pinion_torque_Nm", 250.0)?.with("numerics.verify", false)?;
//! let run = gearwear::run(&scene, &Unwatched)?.complete()?;
//!
//! let pinion = &run.flanks.pinion;
//! println!("{:.2} µm at most", run.summary.pinion.peak_wear_um);
//! assert_eq!(pinion.radius_mm.len(), pinion.wear_um.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`LoadedScene::open`] does the same from a file. Everything found is in a [`RunRecord`], plain structures
//! in the units of the output files:
//!
//! | what | where | unit |
//! |---|---|---|
//! | wear at the points of a flank | `flanks.pinion.wear_um`, beside `radius_mm` | µm, mm |
//! | pressure there, new and worn | `flanks.pinion.pressure_new_MPa`, `pressure_worn_MPa` | MPa |
//! | load share and transmission error over the mesh cycle | `mesh_cycle`, one row a position | –, µm |
//! | wear, pressure and transmission error over the life | `history`, one row a snapshot | |
//! | the main figures and their errors | `summary`, `summary.error` | |
//!
//! Columns of rows become arrays with one `map`:
//!
//! ```
//! # use gearwear::{LoadedScene, Unwatched};
//! # let scene = LoadedScene::preset("thesis-spur")?.with("numerics.error_estimate", false)?.with("numerics.verify", false)?;
//! // A shorter life has no moments of the longer one.
//! let scene = scene.without("operation.snapshots_h")?.with("operation.hours", 1)?;
//! let run = gearwear::run(&scene, &Unwatched)?.complete()?;
//! let share: Vec<f64> = run.mesh_cycle.iter().map(|row| row.load_share_new).collect();
//! let transmission_error_um: Vec<f64> = run.mesh_cycle.iter().map(|row| row.transmission_error_new_um).collect();
//! # assert_eq!(share.len(), transmission_error_um.len());
//! # assert!(share.iter().all(|part| (0.0..=1.0 + 1e-9).contains(part)), "{share:?}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! An [`Observer`] is told of stages, progress and what comes up on the way, and may stop the run; what is noticed in the scene itself is
//! in [`LoadedScene::warnings`]. A value of several keys, such as a tip relief, is a [`toml`] table. [`write`](fn@write) makes the folder
//! that `gearwear run` makes. What is wrong with a scene is a [`SceneError`]: all of it at once, each [`Problem`] with its key, what was found and what is
//! allowed.
//!
//! ```
//! let error = gearwear::LoadedScene::from_toml("[pair]\npreset = \"fzg-d\"\n").unwrap_err();
//! assert!(error.to_string().contains("fzg-c"), "{error}");
//! ```
//!
//! # Many runs
//!
//! [`evaluate()`] runs a scene for rows of values of its keys on several threads, and gives the outputs asked for, by their path in the summary:
//!
//! ```
//! use gearwear::{LoadedScene, Unwatched};
//!
//! let scene = LoadedScene::preset("thesis-spur")?.with("contact.surface", "hertz-mean")?.with("numerics.positions", 40)?;
//! let rows = [vec![200.0.into()], vec![300.0.into()], vec![(-1.0).into()]];
//! let found = gearwear::evaluate(&scene, &["operation.pinion_torque_Nm"], &rows, &["pinion.peak_wear_um"], 2, &Unwatched)?;
//! assert!(found.values[0][0] < found.values[1][0]);
//! assert!(found.values[2][0].is_nan() && found.reasons[2].as_ref().is_some_and(|reason| reason.contains("pinion_torque_Nm")));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`sweep`](mod@sweep) runs all combinations of some keys, on the threads of this process or wherever their tasks are carried out, and [`uncertainty()`] samples
//! of uncertain ones.
//!
//! # Finite elements
//!
//! [`calibrate`] teaches the fast model from finite elements, [`fem_pair`] solves the contact of the pair itself over the mesh
//! cycle, [`fem_problem()`] any plane contact problem on a mesh of one's own ([`mesh`] reads and writes the formats).
//!
//! ```no_run
//! use gearwear::{LoadedScene, Unwatched};
//!
//! let scene = LoadedScene::preset("fzg-c")?.with("contact.surface", "winkler")?;
//! let calibration = gearwear::calibrate(&scene, &Unwatched)?.calibration;
//! let run = gearwear::run(&scene.with_calibration(calibration)?, &Unwatched)?.complete()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Units
//!
//! Records carry their unit in each name (`peak_wear_um`, `line_load_N_per_mm`). Inside, one consistent system is used: mm, N, MPa, s,
//! K, rad. Quantities of helical gears say *normal* or *transverse*.
//!
//! `ARCHITECTURE.md` is the map of the code, `docs/theory.md` the derivations that the modules cite.

#![allow(
    rustdoc::private_intra_doc_links,
    reason = "the documentation is read by those who work on it, private items with it"
)]

// Tests and examples name the library alike.
extern crate self as gearwear;

#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod evaluate;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod exchange;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod explore;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod fem_problem;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod journal;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod measured_flank;
pub mod planetary_run;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod report;
pub mod resume;
pub mod runs;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod scene;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod spread;
pub mod stamped_file;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod sweep;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod uncertainty;
#[allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]
pub mod varied_scene;

#[cfg(test)]
#[allow(unreachable_pub, reason = "test modules are of one crate")]
#[path = "../tests/inside/mod.rs"]
mod inside;

pub use evaluate::{EvaluateError, Evaluation, evaluate};
pub use fem_problem::FemProblemError;
pub use gearwear_bodies::gear::{Gear, PerGear, flank_surface::FlankSurface, flank_zones::FlankZones};
pub use gearwear_bodies::{material, reference};
pub use gearwear_mesh as mesh;
pub use gearwear_physics::assessment::calibrate::{CalibrateError, Calibrated};
pub use gearwear_physics::assessment::fem_scene::FemPairError;
pub use gearwear_physics::assessment::pair_mesh::PairMeshError;
pub use gearwear_physics::assessment::{Done, RunError};
pub use gearwear_physics::calibration::Calibration;
pub use gearwear_physics::contact::settings::MatchCriterion;
pub use gearwear_physics::observer::{Observer, Unwatched};
pub use gearwear_physics::plan::Plan;
pub use gearwear_physics::results;
pub use gearwear_physics::results::run::RunRecord;
pub use report::RunFiles;
pub use report::columns;
pub use report::figure::Figure;
pub use report::files::ReportError;
pub use report::unit::of as unit_of;
pub use resume::kept_run::{KeptRunError, run as run_kept};
pub use resume::result::ResultError;
pub use runs::run;
pub use scene::Resolved;
pub use scene::blame::SceneFault;
pub use scene::fem_problem::schema as fem_problem_schema;
pub use scene::loaded::{LoadError, LoadedScene, SceneError, SceneText};
pub use scene::opened::OpenedScene;
pub use scene::presets::{PRESETS, Preset};
pub use scene::schema::published as scene_schema;
pub use scene::{Problem, ProblemKind};
// The values that `LoadedScene::with` takes.
pub use toml;
pub use uncertainty::{
    asked::{UncertaintyError, UncertaintyQuestion},
    record::UncertaintyRecord,
};

/// What the errors of the calls are made of.
pub mod error {
    pub use gearwear_bodies::gear::error::PairError;
    pub use gearwear_bodies::gear_fem::{cycle::CycleError, full::FullError, in_space::SpaceError, model::ModelError};
    pub use gearwear_fem::active_set::ActiveSetError;
    pub use gearwear_fem::element::ElementError;
    pub use gearwear_fem::equilibrium::SolveError;
    pub use gearwear_fem::factor::FactorError;
    pub use gearwear_fem::space::FoldedHexahedron;
    pub use gearwear_physics::calibration::CalibrationError;
    pub use gearwear_physics::calibration::file::CalibrationFileError;
    pub use gearwear_physics::mesh_cycle::load_sharing::EquilibriumError;
    pub use gearwear_physics::mesh_cycle::pair_in_space::PairInSpaceError;
    pub use gearwear_physics::simulation::wear_run::SimulationError;
    pub use gearwear_physics::stiffness::{StiffnessError, curve_file::CurveFileError};
}

use std::path::Path;

use gearwear_physics::results::fem_pair::FemPairRecord;
use gearwear_physics::results::fem_problem::FemRecord;
use scene::fem_problem::FemProblem;

/// Calibrates the fast model of the scene's pair with finite elements: K/H of the Winkler foundation by position and load, and the
/// stiffness of the teeth ([`LoadedScene::with_calibration`] uses it).
///
/// # Errors
/// [`CalibrateError`]
pub fn calibrate(scene: &LoadedScene, observer: &dyn Observer) -> Result<Calibrated, CalibrateError> {
    runs::calibrate(scene, gearwear_physics::assessment::calibrate::CalibrationExtent::Whole, observer)
}

/// Solves the contact of the scene's pair with plane finite elements: at the position `position_mm` of the path of contact (radius of
/// curvature of the pinion, mm), or over the whole mesh cycle.
///
/// # Errors
/// [`FemPairError`] where no position was solved.
pub fn fem_pair(
    scene: &LoadedScene,
    position_mm: Option<f64>,
    observer: &dyn Observer,
) -> Result<Done<FemPairRecord, FemPairError>, FemPairError> {
    runs::fem_pair(
        &scene.resolved,
        gearwear_physics::assessment::fem_scene::FemPairRequest { position_mm, full: false },
        observer,
    )
}

/// Solves a problem of finite elements on a mesh of one's own, plane with contact or three-dimensional without: `problem_toml` is the text of a problem file
/// (`docs/fem-problems.md`), whose mesh file lies in `folder`.
///
/// # Errors
/// [`FemProblemError`]: everything that is wrong with problem and mesh, or why the solver failed.
pub fn fem_problem(problem_toml: &str, folder: &Path, observer: &dyn Observer) -> Result<FemRecord, FemProblemError> {
    let problem = FemProblem::from_toml(problem_toml).map_err(FemProblemError::Input)?;
    fem_problem::run(&problem, folder, observer)
}

/// Solves the same problem on `mesh`; the file that it names is not read.
///
/// # Errors
/// As [`fem_problem()`].
pub fn fem_problem_on(
    problem_toml: &str,
    mesh: &gearwear_mesh::Mesh,
    observer: &dyn Observer,
) -> Result<FemRecord, FemProblemError> {
    let problem = FemProblem::from_toml(problem_toml).map_err(FemProblemError::Input)?;
    fem_problem::on_mesh(&problem, mesh, observer)
}

/// The mesh of a problem with its solution at the nodes, as `solution.vtu` has it.
pub fn solution_mesh(record: &FemRecord) -> gearwear_mesh::Mesh {
    report::fem::solution_mesh(record)
}

/// What a mesh of a gear pair shows ([`pair_mesh`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meshed {
    /// Both gears in the plane.
    InPlane,
    /// One pitch of each gear over the whole face width.
    InSpace,
    /// The same with displacement and stress of the teeth under the scene's torque, on unworn flanks.
    Loaded,
}

/// The finite-element mesh of the scene's pair in contact at `position_mm` (radius of curvature of the pinion, from A to E; by default at the
/// pitch point), which `gearwear mesh` writes.
///
/// # Errors
/// [`PairMeshError`]
pub fn pair_mesh(
    scene: &LoadedScene,
    of: Meshed,
    position_mm: Option<f64>,
    observer: &dyn Observer,
) -> Result<gearwear_mesh::Mesh, PairMeshError> {
    use gearwear_physics::assessment::{deformed_teeth, pair_mesh};
    Ok(match of {
        Meshed::InPlane => pair_mesh::build(scene.scene(), position_mm)?.mesh,
        Meshed::InSpace => pair_mesh::in_space(scene.scene(), position_mm)?.mesh,
        Meshed::Loaded => {
            deformed_teeth::deformed_teeth(scene.inputs(&Default::default()), position_mm, observer)?.space.mesh
        }
    })
}

/// Runs `scene` for samples of its uncertain keys, on `threads` threads: quantiles and Sobol indices. Where the observer interrupts it, of the
/// points that are finished, if they are a few. Finished runs are kept in a journal in `folder`, with which the same study goes on; without a folder in
/// memory.
///
/// # Errors
/// What is wrong with the question; runs that all failed; a folder with the runs of another study, or that cannot be written.
pub fn uncertainty<S>(
    scene: &S,
    question: &UncertaintyQuestion,
    folder: Option<&Path>,
    threads: usize,
    observer: &dyn Observer,
) -> Result<UncertaintyRecord, UncertaintyError>
where
    for<'s> &'s S: Into<OpenedScene>,
{
    let scene = &scene.into();
    let question = uncertainty::sampled_run::SampledQuestion::of(scene, question)?;
    let of_study = uncertainty::asked::UncertaintyFault::Study;
    let prepared = uncertainty::study::PreparedStudy::new(scene, &question, observer).map_err(of_study)?;
    let study = prepared.study().map_err(uncertainty::asked::UncertaintyFault::Scene)?;
    let mut journal = match folder {
        None => journal::Journal::in_memory(study),
        Some(folder) => journal::Journal::open(folder, study).map_err(uncertainty::asked::UncertaintyFault::Journal)?,
    };
    Ok(prepared.run(&mut journal, threads, observer, |_| {}).map_err(of_study)?)
}

/// Writes what `gearwear uncertainty` writes into `folder`, which is made if need be.
///
/// # Errors
/// [`ReportError`] where a file cannot be written.
pub fn write_uncertainty(record: &UncertaintyRecord, folder: &Path) -> Result<(), ReportError> {
    uncertainty::report::write(record, folder)
}

/// The plots of the page of a run as drawings, SVG; surfaces in space are left out.
pub fn figures(run: &RunRecord) -> Vec<Figure> {
    report::figures(run)
}

/// Writes what `gearwear fem` of a gear pair writes into `folder`, which is made if need be.
///
/// # Errors
/// [`ReportError`] where a file cannot be written.
pub fn write_fem_pair(record: &FemPairRecord, folder: &Path) -> Result<(), ReportError> {
    report::remove_summary(folder)?;
    report::fem_pair::write_data_and_page(record, folder)?;
    report::write_summary(&record.summary, folder).map(drop)
}

/// Writes what `gearwear fem` of a problem of one's own writes into `folder`, which is made if need be.
///
/// # Errors
/// [`ReportError`] where a file cannot be written.
pub fn write_fem_problem(record: &FemRecord, folder: &Path) -> Result<(), ReportError> {
    report::remove_summary(folder)?;
    report::fem::write_data_and_page(record, folder)?;
    report::write_summary(&record.summary, folder).map(drop)
}

/// Writes what `gearwear calibrate` writes: the calibration as the JSON `file` that scenes name, and a page beside it, headed by `title`;
/// who reports (`[report]` of a scene) stands on the page of the program alone.
///
/// # Errors
/// [`ReportError`] where a file cannot be written.
pub fn write_calibration(calibrated: &Calibrated, title: &str, file: &Path) -> Result<(), ReportError> {
    report::calibration::write(&calibrated.calibration, &calibrated.stages, [title, ""], file)
}

/// Writes what `gearwear run` writes into `folder`, which is made if need be: scene and input files, tables, page, summary.
///
/// # Errors
/// [`ReportError`] where a file cannot be written.
pub fn write(run: &RunRecord, folder: &Path) -> Result<(), ReportError> {
    write_with(run, &RunFiles::default(), folder)
}

/// Writes the same with `files` beside the tables.
///
/// # Errors
/// [`ReportError`] where a file cannot be written.
pub fn write_with(run: &RunRecord, files: &RunFiles, folder: &Path) -> Result<(), ReportError> {
    resume::result::write_all(run, files, folder)
}

/// The run in a folder that [`write()`] or `gearwear run` filled, equal to the one that was written.
///
/// # Errors
/// [`ResultError`]: no folder, none of a finished run, or one of another version of the program.
pub fn read(folder: &Path) -> Result<RunRecord, ResultError> {
    resume::result::read(folder)
}
