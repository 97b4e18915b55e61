//! Studies whose record is read as JSON and whose files are written on demand.

use std::path::{Path, PathBuf};

use gearwear::{LoadError, Observer, SceneText};
use gearwear_validation::found::{CompareQuestion, LifeQuestion};
use pyo3::prelude::*;

use crate::errors;
use crate::watched::{cores, watched};

/// What a study found.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Study {
    study: gearwear_validation::found::Study,
}

impl Study {
    pub(crate) fn of(
        py: Python<'_>,
        found: Result<gearwear_validation::found::Study, gearwear_validation::found::StudyError>,
    ) -> PyResult<Self> {
        found.map(|study| Self { study }).map_err(|error| errors::of_study(py, &error))
    }
}

#[pymethods]
impl Study {
    /// The record, as the command writes it.
    #[getter]
    fn summary_json(&self) -> &str {
        self.study.json()
    }

    /// Writes what the command writes.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| self.study.write(&folder)).map_err(|error| errors::of_report(&error))
    }
}

/// Measured profiles against the finished run in a folder: their names, and their texts where they are no files.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the arguments of the Python function")]
pub(crate) fn compare(
    py: Python<'_>,
    run: PathBuf,
    measured: Vec<(String, Option<String>)>,
    gear: Option<String>,
    form: Option<String>,
    fit: Option<String>,
    shift_within_mm: f64,
    tooth: Option<u32>,
    flank: Option<String>,
    width_mm: Option<f64>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Study> {
    let measured: Result<Vec<_>, _> = py.detach(|| measured.into_iter().map(text_of).collect());
    let measured = measured.map_err(|error| errors::of_loading(py, &error))?;
    let question = CompareQuestion { gear, form, fit, shift_within_mm, tooth, flank, width_mm };
    let work = move |observer: &dyn Observer| gearwear_validation::found::compare(&run, &measured, &question, observer);
    Study::of(py, watched(py, threads, progress, work)?)
}

/// Remaining life by measurements: the name of their table, and its text where it is no file.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the arguments of the Python function")]
pub(crate) fn remaining_life(
    py: Python<'_>,
    run: PathBuf,
    table: (String, Option<String>),
    limits: Vec<String>,
    prior: Option<String>,
    gear: Option<String>,
    form: Option<String>,
    shift_within_mm: f64,
    other_k: Option<String>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Study> {
    let table = py.detach(|| text_of(table)).map_err(|error| errors::of_loading(py, &error))?;
    let question = LifeQuestion { gear, limits, prior, form, shift_within_mm, other_k };
    let work =
        move |observer: &dyn Observer| gearwear_validation::found::remaining_life(&run, &table, &question, observer);
    Study::of(py, watched(py, threads, progress, work)?)
}

/// Text of a file, or the one given.
fn text_of((name, text): (String, Option<String>)) -> Result<SceneText, LoadError> {
    match text {
        Some(text) => Ok(SceneText { name, text }),
        None => SceneText::read_foreign(Path::new(&name)),
    }
}

/// Finished runs side by side: their folders and what they are called.
#[pyfunction]
pub(crate) fn compare_runs(py: Python<'_>, runs: Vec<(PathBuf, String)>) -> PyResult<Study> {
    Study::of(py, py.detach(|| gearwear_validation::found::compare_runs(&runs)))
}

/// The validation suite.
#[pyfunction]
pub(crate) fn validate(
    py: Python<'_>,
    cases: Vec<String>,
    tier: Option<String>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Study> {
    let count = cores(threads);
    let work =
        move |observer: &dyn Observer| gearwear_validation::found::validate(&cases, tier.as_deref(), count, observer);
    Study::of(py, watched(py, threads, progress, work)?)
}
