//! Tables as columns of arrays.

use gearwear::columns::{Column, Table, Values};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

/// The columns of a table: name, unit, meaning and values of each, which are a read-only array, or a list of texts.
pub(crate) type Columns = Vec<(String, Option<&'static str>, String, Py<PyAny>)>;

/// The columns of `table`; arrays take over its memory.
pub(crate) fn columns(py: Python<'_>, table: Table) -> PyResult<Columns> {
    let column = |Column { name, meaning, unit, values }| {
        let values = match values {
            Values::Numbers(values) => {
                let array = values.into_pyarray(py);
                array.readwrite().make_nonwriteable();
                array.into_any().unbind()
            }
            Values::Counts(values) => {
                let array = values.into_pyarray(py);
                array.readwrite().make_nonwriteable();
                array.into_any().unbind()
            }
            Values::Flags(values) => {
                let array = values.into_pyarray(py);
                array.readwrite().make_nonwriteable();
                array.into_any().unbind()
            }
            Values::Words(values) => values.into_py_any(py)?,
        };
        Ok((name, unit, meaning, values))
    };
    table.columns.into_iter().map(column).collect()
}
