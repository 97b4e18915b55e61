//! Studies of many runs, of a scene of either kind.

use std::path::PathBuf;
use std::sync::Arc;

use gearwear::sweep::{self, SweepQuestion};
use gearwear::toml::Value;
use gearwear::{EvaluateError, Evaluation, Observer, OpenedScene, UncertaintyQuestion};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::sweep::Sweep;
use crate::uncertainty::Uncertainty;
use crate::value;
use crate::watched::{cores, watched};

/// The outputs of each row, and why one has none.
pub(crate) type Evaluated = (Vec<Vec<f64>>, Vec<Option<String>>);

/// Number of threads, and who is told of progress.
type Work<'py> = (usize, Option<Bound<'py, PyAny>>);

/// Runs `scene` for each of `rows`, which hold a value for each of `keys`, one row a thread: the outputs of each row, and why one has none.
pub(crate) fn evaluate(
    py: Python<'_>,
    scene: impl Into<OpenedScene>,
    keys: Vec<String>,
    rows: Vec<Vec<Bound<'_, PyAny>>>,
    outputs: Vec<String>,
    (threads, progress): Work<'_>,
) -> PyResult<Evaluated> {
    let name = |column: usize| keys.get(column).map_or("X", String::as_str);
    let row = |row: Vec<Bound<'_, PyAny>>| -> PyResult<Vec<Value>> {
        row.iter().enumerate().map(|(column, value)| value::of(name(column), value)).collect()
    };
    let rows = rows.into_iter().map(row).collect::<PyResult<Vec<_>>>()?;
    let (scene, count) = (scene.into(), cores(threads));
    let done = watched(py, threads, progress, move |observer| {
        gearwear::evaluate(&scene, &keys, &rows, &outputs, count, observer)
    })?;
    let Evaluation { values, reasons } = done.map_err(|error| match error {
        EvaluateError::Scene(error) => errors::of_scene(py, &error),
        other => PyValueError::new_err(other.to_string()),
    })?;
    Ok((values, reasons))
}

/// The sweep of `scene` that `question` asks for.
pub(crate) fn sweep(py: Python<'_>, scene: impl Into<OpenedScene>, question: SweepQuestion) -> PyResult<Sweep> {
    let scene = scene.into();
    let sweep = py.detach(|| sweep::Sweep::of(&scene, &question));
    let sweep = Arc::new(sweep.map_err(|error| errors::of_sweep(py, &error))?);
    Ok(Sweep { sweep, notes: question.notes() })
}

/// Quantiles and Sobol indices of figures of `scene` where keys are uncertain.
pub(crate) fn uncertainty(
    py: Python<'_>,
    scene: impl Into<OpenedScene>,
    question: UncertaintyQuestion,
    folder: Option<PathBuf>,
    (threads, progress): Work<'_>,
) -> PyResult<Uncertainty> {
    let (scene, count) = (scene.into(), cores(threads));
    let work =
        move |observer: &dyn Observer| gearwear::uncertainty(&scene, &question, folder.as_deref(), count, observer);
    let record = watched(py, threads, progress, work)?.map_err(|error| errors::of_uncertainty(py, &error))?;
    Ok(Uncertainty { record })
}
