//! Studies of uncertainty.

use std::path::PathBuf;

use gearwear::UncertaintyRecord;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::table::{self, Columns};

/// A finished study.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Uncertainty {
    pub(crate) record: UncertaintyRecord,
}

#[pymethods]
impl Uncertainty {
    /// `uncertainty.json`.
    #[getter]
    fn summary_json(&self) -> PyResult<String> {
        self.record.summary_json().map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The columns of `samples.csv`.
    fn samples(&self, py: Python<'_>) -> PyResult<Columns> {
        table::columns(py, py.detach(|| gearwear::uncertainty::report::table(&self.record)))
    }

    /// Writes what `gearwear uncertainty` writes.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| gearwear::write_uncertainty(&self.record, &folder)).map_err(|error| errors::of_report(&error))
    }
}
