//! Sweeps, whose rows are run here or by the executors of others.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use gearwear::Observer;
use gearwear::sweep::{self, SweepError, SweepRecord};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::table::{self, Columns};
use crate::watched::{cores, watched};

/// What is run.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Sweep {
    pub(crate) sweep: Arc<sweep::Sweep>,
    /// Notes on the names that were asked for.
    pub(crate) notes: Vec<String>,
}

#[pymethods]
impl Sweep {
    /// Figures that are called by older names, and values that their key does not take.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.notes.iter().cloned().chain(self.sweep.warnings()).collect()
    }

    /// Begins it, or goes on with it where the folder has rows of it already; without a folder rows are kept in memory alone.
    fn begin(&self, py: Python<'_>, folder: Option<PathBuf>) -> PyResult<UnfinishedSweep> {
        let begun = py.detach(|| sweep::UnfinishedSweep::begin(&self.sweep, folder.as_deref()));
        let begun = begun.map_err(|error| errors::of_sweep(py, &error))?;
        Ok(UnfinishedSweep { state: Arc::new(Mutex::new(Some(begun))) })
    }

    /// Does a task on one thread: the row as its line of the journal.
    fn carry_out(&self, py: Python<'_>, task: String) -> PyResult<String> {
        let sweep = Arc::clone(&self.sweep);
        let line = watched(py, 1, None, move |observer| sweep.carry_out(&task, observer))?;
        line.map_err(|error| errors::of_sweep(py, &error))?.ok_or_else(errors::of_thread)
    }

    /// The line of a task that came to nothing.
    fn lost(&self, py: Python<'_>, task: &str, reason: &str) -> PyResult<String> {
        self.sweep.lost(task, reason).map_err(|error| errors::of_sweep(py, &error))
    }
}

/// A sweep under way; closed when it is finished.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct UnfinishedSweep {
    state: Arc<Mutex<Option<sweep::UnfinishedSweep>>>,
}

type State = Mutex<Option<sweep::UnfinishedSweep>>;

/// What `of` makes of the sweep; an error where it is closed.
fn with<R>(
    state: &State,
    of: impl FnOnce(&mut sweep::UnfinishedSweep) -> Result<R, SweepError>,
) -> Option<Result<R, SweepError>> {
    // Rows that were kept before a panic are.
    state.lock().unwrap_or_else(PoisonError::into_inner).as_mut().map(of)
}

fn told<R>(py: Python<'_>, done: Option<Result<R, SweepError>>) -> PyResult<R> {
    let done = done.ok_or_else(|| PyValueError::new_err("the sweep is closed"))?;
    done.map_err(|error| errors::of_sweep(py, &error))
}

#[pymethods]
impl UnfinishedSweep {
    /// What can be done now, one text each; none: it is finished.
    fn tasks(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        told(py, py.detach(|| with(&self.state, |sweep| sweep.tasks())))
    }

    /// Keeps what a task came to.
    fn keep(&self, py: Python<'_>, line: &str) -> PyResult<()> {
        told(py, py.detach(|| with(&self.state, |sweep| sweep.keep(line))))
    }

    /// Does all that is left in this process, one combination a thread.
    fn run(&self, py: Python<'_>, threads: usize, progress: Option<Bound<'_, PyAny>>) -> PyResult<()> {
        let (state, count) = (Arc::clone(&self.state), cores(threads));
        let work = move |observer: &dyn Observer| with(&state, |sweep| sweep.run(count, observer));
        told(py, watched(py, 1, progress, work)?).map(drop)
    }

    /// Writes the files, where there is a folder, and closes it: the table and `sweep.json`.
    fn finish(&self, py: Python<'_>) -> PyResult<(Columns, String)> {
        let unfinished = self.state.lock().unwrap_or_else(PoisonError::into_inner).take();
        let finished = py.detach(|| unfinished.map(sweep::UnfinishedSweep::finish));
        let record: SweepRecord = told(py, finished)?;
        let summary = record.summary_json().map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok((table::columns(py, record.table())?, summary))
    }

    /// Closes its journal, so that another process may go on with it. What is at work in it now keeps it.
    fn close(&self) {
        if let Ok(mut state) = self.state.try_lock() {
            state.take();
        }
    }
}
