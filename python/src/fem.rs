//! Finite elements.

use std::path::PathBuf;

use gearwear::results::fem_pair::FemPairRecord;
use gearwear::results::fem_problem::FemRecord;
use gearwear::{FemProblemError, SceneError, SceneText, columns};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors;
use crate::mesh::Mesh;
use crate::record_bytes;
use crate::scene::json;
use crate::table::{self, Columns};
use crate::watched::watched;

/// The contact of a gear pair.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct FemPair {
    record: FemPairRecord,
}

impl FemPair {
    pub(crate) fn of(record: FemPairRecord) -> Self {
        Self { record }
    }
}

#[pymethods]
impl FemPair {
    /// `summary.json`.
    #[getter]
    fn summary_json(&self) -> PyResult<String> {
        json(&self.record.summary)
    }

    /// The columns of a table, as its CSV file has them; None where there is no such table.
    fn table(&self, py: Python<'_>, name: &str) -> PyResult<Option<Columns>> {
        columns::of_fem_pair(&self.record, name).map(|table| table::columns(py, table)).transpose()
    }

    /// Everything, for [`Self::from_bytes`] of the same version.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        record_bytes::of(py, &self.record)
    }

    /// The same from [`Self::to_bytes`].
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        record_bytes::read(py, bytes).map(Self::of)
    }

    /// Writes what `gearwear fem` writes.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| gearwear::write_fem_pair(&self.record, &folder)).map_err(|error| errors::of_report(&error))
    }
}

/// A problem on a mesh of one's own.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct FemProblem {
    record: FemRecord,
}

#[pymethods]
impl FemProblem {
    /// `summary.json`.
    #[getter]
    fn summary_json(&self) -> PyResult<String> {
        json(&self.record.summary)
    }

    /// The mesh with the solution at its nodes.
    fn mesh(&self, py: Python<'_>) -> Mesh {
        Mesh::of(py.detach(|| gearwear::solution_mesh(&self.record)))
    }

    /// Writes what `gearwear fem` writes.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| gearwear::write_fem_problem(&self.record, &folder)).map_err(|error| errors::of_report(&error))
    }
}

/// Solves the problem in a text on a mesh, or on the one that it names, which lies in `folder`.
#[pyfunction]
pub(crate) fn solve_fem_problem(
    py: Python<'_>,
    name: String,
    text: String,
    folder: PathBuf,
    mesh: Option<Bound<'_, Mesh>>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<FemProblem> {
    let asked = text.clone();
    let mesh = mesh.map(|mesh| mesh.get().mesh.clone());
    let work = move |observer: &dyn gearwear::Observer| match &mesh {
        Some(mesh) => gearwear::fem_problem_on(&asked, mesh, observer),
        None => gearwear::fem_problem(&asked, &folder, observer),
    };
    let record = watched(py, 1, progress, work)?.map_err(|error| match error {
        FemProblemError::Input(problems) => {
            errors::of_scene(py, &SceneError { given: SceneText { name, text }, problems })
        }
        FemProblemError::Memory(said) => errors::of_run(py, said),
        FemProblemError::Solve(error) => errors::of_run(py, error.to_string()),
    })?;
    Ok(FemProblem { record })
}
