//! `gearwear._native`: the library `gearwear` for Python, as thin as it can be. What users see is in `gearwear/*.py`.
//!
//! Nothing here computes. Scenes and results are the library's own, behind classes that never change them; arrays borrow the memory of the
//! results ([`array`]), and work runs on threads of its own while the calling thread listens for signals ([`watched`]).

mod array;
mod calibration;
mod errors;
mod fem;
mod many_runs;
mod mesh;
mod record_bytes;
mod run;
mod scene;
mod stage;
mod study;
mod sweep;
mod table;
mod uncertainty;
mod value;
mod watched;

use std::ffi::OsString;

use gearwear::EvaluateError;
use gearwear::results::figures;
use pyo3::prelude::*;

/// The program `gearwear` with these arguments, of which the first is its name; its exit status.
#[pyfunction]
fn program(arguments: Vec<OsString>) -> u8 {
    gearwear_cli::with_arguments(arguments)
}

/// The names of the built-in scenes.
#[pyfunction]
fn presets() -> Vec<&'static str> {
    gearwear::PRESETS.iter().map(|preset| preset.name).collect()
}

/// The JSON schema of the scene, as `gearwear schema` prints it.
#[pyfunction]
fn scene_schema() -> String {
    gearwear::scene_schema().to_string()
}

/// Why no scene has a key at this path; None where one may.
#[pyfunction]
fn key_fault(key: String) -> Option<String> {
    let is_known = gearwear::scene::key::is_key(&key);
    let unknown = || EvaluateError::UnknownKey { nearest: gearwear::scene::key::nearest_key(&key), key: key.clone() };
    (!is_known).then(|| unknown().to_string())
}

/// A main figure: path in the summary, heading, heading for both gears or states, unit, meaning, whether short tables show it.
type MainFigure = (&'static str, &'static str, String, &'static str, &'static str, bool);

/// The main figures of a run, in the order of tables.
#[pyfunction]
fn main_figures() -> Vec<MainFigure> {
    let of = |figure: &'static figures::MainFigure| -> MainFigure {
        let family = figure.family;
        (&figure.name, &figure.heading, family.row(), family.unit, &figure.meaning, family.in_terminal)
    };
    figures::all().iter().map(of).collect()
}

/// Notes on figures that are named as in the previous version.
#[pyfunction]
fn notes_on_figures(names: Vec<String>) -> Vec<String> {
    figures::notes(names.iter().map(String::as_str))
}

/// The unit of a main figure, or the one that a name ends in; None where it has none.
#[pyfunction]
fn unit_of(name: &str) -> Option<&'static str> {
    gearwear::unit_of(name)
}

#[pymodule(gil_used = false)]
mod _native {
    #[pymodule_export]
    use super::calibration::Calibration;
    #[pymodule_export]
    use super::fem::{FemPair, FemProblem, solve_fem_problem};
    #[pymodule_export]
    use super::mesh::Mesh;
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::stage::{Stage, StageRun};
    #[pymodule_export]
    use super::study::{Study, compare, compare_runs, remaining_life, validate};
    #[pymodule_export]
    use super::sweep::{Sweep, UnfinishedSweep};
    #[pymodule_export]
    use super::uncertainty::Uncertainty;
    #[pymodule_export]
    use super::{key_fault, main_figures, notes_on_figures, presets, program, scene_schema, unit_of};

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
