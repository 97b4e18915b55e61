//! Records as bytes, for pickles that the same version reads.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The bytes of a record.
pub(crate) fn of<'py>(py: Python<'py>, record: &(impl Serialize + Sync)) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = py.detach(|| postcard::to_stdvec(record));
    bytes.map(|bytes| PyBytes::new(py, &bytes)).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The record of these bytes.
pub(crate) fn read<R: DeserializeOwned + Send>(py: Python<'_>, bytes: &[u8]) -> PyResult<R> {
    let record = py.detach(|| postcard::from_bytes(bytes));
    record.map_err(|error| PyValueError::new_err(format!("no result of this version: {error}")))
}
