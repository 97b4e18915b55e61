//! Arrays that borrow the memory of a result.
//!
//! The one place with `unsafe`: an array that does not own its memory needs a promise that nobody changes or frees it. Results are never
//! changed once made, and each array keeps the object alive that holds them.

#![allow(unsafe_code, reason = "borrowing the memory of a result")]

use numpy::ndarray::ArrayView;
use numpy::{Element, IxDyn, PyArray, PyArrayMethods};
use pyo3::PyClass;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;

/// Values with the shape in which they lie.
pub(crate) type Shaped<'a, T> = (&'a [T], Vec<usize>);

/// The values that `of` finds in the unchanging `owner`, as a read-only array that keeps it; None where it finds none.
pub(crate) fn borrowed<'py, C, T>(
    owner: &Bound<'py, C>,
    of: impl for<'a> FnOnce(&'a C) -> Option<Shaped<'a, T>>,
) -> PyResult<Option<Bound<'py, PyAny>>>
where
    C: PyClass<Frozen = True> + Sync,
    T: Element,
{
    let Some((values, shape)) = of(owner.get()) else { return Ok(None) };
    let view =
        ArrayView::from_shape(IxDyn(&shape), values).map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    // SAFETY: the values live as long as the object they were found in, which gives out no mutable reference and which the array keeps;
    // the array itself is read-only.
    let array = unsafe { PyArray::borrow_from_array(&view, owner.clone().into_any()) };
    array.readwrite().make_nonwriteable();
    Ok(Some(array.into_any()))
}
