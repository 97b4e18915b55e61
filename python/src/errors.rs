//! What goes wrong, as the exceptions of `gearwear.errors`.

use std::io;

use gearwear::exchange::rexs::container::FileError;
use gearwear::mesh::MeshFileError;
use gearwear::resume::folder::FolderError;
use gearwear::stamped_file::StampedFileError;
use gearwear::sweep::SweepError;
use gearwear::{
    KeptRunError, LoadError, Problem, ProblemKind, ReportError, ResultError, SceneError, SceneFault, SceneText,
    UncertaintyError,
};
use gearwear_validation::found::StudyError;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyMemoryError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// The exception called `name`, made of `arguments`.
fn exception<'py>(py: Python<'py>, name: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("gearwear.errors")?.getattr(name)?;
        Ok(PyErr::from_value(class.call1(arguments)?))
    };
    made().unwrap_or_else(|error| error)
}

/// A finding, in the order of the fields of `gearwear.Finding`.
type Finding = (&'static str, String, String, String, Option<String>, usize, String);

/// What is wrong with a scene.
pub(crate) fn of_scene(py: Python<'_>, error: &SceneError) -> PyErr {
    let finding = |problem: &Problem| -> Finding {
        let Problem { kind, key, found, allowed, help, .. } = problem;
        let (key, found, allowed, help) = (key.clone(), found.clone(), allowed.clone(), help.clone());
        (name_of(kind), key, found, allowed, help, error.line_of(problem), problem.to_string())
    };
    refused(py, &error.given.name, error.problems.iter().map(finding).collect())
}

/// The text called `name`, refused for these reasons.
fn refused(py: Python<'_>, name: &str, findings: Vec<Finding>) -> PyErr {
    match findings.into_py_any(py) {
        Ok(findings) => exception(py, "SceneError", (name, findings)),
        Err(error) => error,
    }
}

fn name_of(kind: &ProblemKind) -> &'static str {
    match kind {
        ProblemKind::Syntax => "syntax",
        ProblemKind::UnknownKey => "unknown-key",
        ProblemKind::WrongType => "wrong-type",
        ProblemKind::NotAllowed => "not-allowed",
        ProblemKind::Missing => "missing",
        ProblemKind::SaidTwice => "said-twice",
        ProblemKind::NotAvailable => "not-available",
        ProblemKind::Geometry(_) => "geometry",
        ProblemKind::Stiffness(_) => "stiffness",
    }
}

/// What keeps a scene from being opened.
pub(crate) fn of_loading(py: Python<'_>, error: &LoadError) -> PyErr {
    match error {
        LoadError::Scene(error) => of_scene(py, error),
        LoadError::Unreadable { reason, .. } => of_system(reason.kind(), error),
        LoadError::NotUtf8 { name, line, .. } => {
            let (found, allowed) = ("bytes that are no UTF-8 text".to_owned(), "UTF-8 text".to_owned());
            let help = Some("save the file as UTF-8".to_owned());
            refused(py, name, vec![("not-utf8", String::new(), found, allowed, help, *line, error.to_string())])
        }
        LoadError::Curve { name, error } => {
            let (found, allowed) = (error.to_string(), "a data file (CSV) of the stiffness".to_owned());
            let message = format!("{name}: {error}");
            refused(py, name, vec![("not-allowed", "stiffness.curve".to_owned(), found, allowed, None, 1, message)])
        }
    }
}

/// What is wrong with a file or folder: the exception that Python's own functions raise for this `kind`, such as `FileNotFoundError`.
fn of_system(kind: io::ErrorKind, said: impl ToString) -> PyErr {
    io::Error::new(kind, said.to_string()).into()
}

/// What keeps results from being written.
pub(crate) fn of_report(error: &ReportError) -> PyErr {
    match error {
        ReportError::CreateFolder { source, .. } | ReportError::WriteFile { source, .. } => {
            of_system(source.kind(), format!("{error}: {source}"))
        }
        ReportError::NotAFolder { .. } => of_system(io::ErrorKind::NotADirectory, error),
    }
}

/// What keeps a mesh from being read or written.
pub(crate) fn of_mesh_file(error: &MeshFileError) -> PyErr {
    match error {
        MeshFileError::Read { source, .. } | MeshFileError::Write { source, .. } => {
            of_system(source.kind(), format!("{error}: {source}"))
        }
        MeshFileError::Memory { .. } => PyMemoryError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// What keeps a sweep from being run or kept.
pub(crate) fn of_sweep(py: Python<'_>, error: &SweepError) -> PyErr {
    match (error.in_the_scene(), error.of_system()) {
        (Some(error), _) => of_scene(py, error),
        (None, Some(kind)) => of_system(kind, error),
        (None, None) => PyValueError::new_err(error.to_string()),
    }
}

/// Why a study came to nothing.
pub(crate) fn of_study(py: Python<'_>, error: &StudyError) -> PyErr {
    match (error.in_loading(), error.in_the_scene()) {
        (Some(error), _) => of_loading(py, error),
        (None, Some(error)) => of_scene(py, error),
        (None, None) if error.is_of_the_runs() => of_run(py, error.to_string()),
        (None, None) => PyValueError::new_err(error.to_string()),
    }
}

/// Why a study of uncertainty came to nothing.
pub(crate) fn of_uncertainty(py: Python<'_>, error: &UncertaintyError) -> PyErr {
    match error.in_the_scene() {
        Some(error) => of_scene(py, error),
        None if error.is_of_the_runs() => of_run(py, error.to_string()),
        None => PyValueError::new_err(error.to_string()),
    }
}

/// What keeps a run from being read from its folder.
pub(crate) fn of_result(error: &ResultError) -> PyErr {
    match error {
        ResultError::Unreadable { source, .. } => of_system(source.kind(), error),
        ResultError::Record { source: StampedFileError::Unreadable(source), .. } => of_system(source.kind(), error),
        ResultError::NoRun { .. } | ResultError::Record { .. } | ResultError::OtherSummary { .. } => {
            PyValueError::new_err(error.to_string())
        }
    }
}

/// What keeps a run in its folder from going on.
pub(crate) fn of_kept_run(py: Python<'_>, error: &KeptRunError, given: &SceneText) -> PyErr {
    match error {
        KeptRunError::Result(error) => of_result(error),
        KeptRunError::Report(error) => of_report(error),
        KeptRunError::Folder(FolderError::Unreadable { source, .. }) => of_system(source.kind(), error),
        KeptRunError::Folder(_) | KeptRunError::NothingLeft { .. } => PyValueError::new_err(error.to_string()),
        KeptRunError::Run(failure) => match failure.in_the_scene(given) {
            Some(error) => of_scene(py, &error),
            None => of_run(py, failure.to_string()),
        },
    }
}

/// What keeps a scene from being made of a file of another program.
pub(crate) fn of_rexs(error: &FileError, name: &str) -> PyErr {
    match error {
        FileError::Unreadable(source) => of_system(source.kind(), format!("{name}: {error}")),
        FileError::Rexs(_) => PyValueError::new_err(format!("{name}: {error}")),
    }
}

/// The computation failed.
pub(crate) fn of_run(py: Python<'_>, message: String) -> PyErr {
    exception(py, "RunError", (message,))
}

/// A thread ended without an answer: a fault of the program.
pub(crate) fn of_thread() -> PyErr {
    PyRuntimeError::new_err(
        "gearwear ended without a result: that is a fault of the program, which it names on standard error",
    )
}
