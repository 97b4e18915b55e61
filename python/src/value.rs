//! Values of a scene from Python: numbers, texts, lists, tables, and what NumPy makes of them.

use gearwear::scene::key::takes_list;
use gearwear::toml::{Table, Value};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyMapping, PyString};

/// What a value may be.
const ALLOWED: &str = "a number, a text, True or False, a list, or a dict";

/// The value of the key at the path `key`.
pub(crate) fn of(key: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(value) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(value.is_true()));
    }
    if value.is_instance_of::<PyInt>() {
        let too_great = |_| PyOverflowError::new_err(format!("{key}: found {value}; allowed: an integer of 64 bits"));
        return value.extract().map(Value::Integer).map_err(too_great);
    }
    if let Ok(value) = value.cast::<PyFloat>() {
        return Ok(Value::Float(value.value()));
    }
    if let Ok(value) = value.cast::<PyString>() {
        return Ok(Value::String(value.to_str()?.to_owned()));
    }
    if value.is_instance_of::<PyDict>() || value.cast::<PyMapping>().is_ok() {
        return table(key, value).map(Value::Table);
    }
    // A path that names a file.
    if value.hasattr("__fspath__")? {
        return of(key, &value.call_method0("__fspath__")?);
    }
    // NumPy's scalars and arrays; an array of one number is that number where no list is meant.
    if value.hasattr("tolist")? && value.hasattr("dtype")? {
        if value.getattr("size")?.extract::<usize>()? == 1 && !takes_list(key) {
            return of(key, &value.call_method0("item")?);
        }
        return of(key, &value.call_method0("tolist")?);
    }
    if let Ok(items) = value.try_iter() {
        let items: Vec<_> = items.collect::<PyResult<_>>()?;
        let item = |(number, item): (usize, &Bound<'_, PyAny>)| of(&format!("{key}.{}", number + 1), item);
        return items.iter().enumerate().map(item).collect::<PyResult<_>>().map(Value::Array);
    }
    Err(refused(key, value))
}

/// The table at the path `key` that a mapping is; a key whose value is None is left out.
pub(crate) fn table(key: &str, mapping: &Bound<'_, PyAny>) -> PyResult<Table> {
    let mapping = mapping.cast::<PyMapping>().map_err(|_| refused(key, mapping))?;
    let mut table = Table::new();
    for item in mapping.items()?.iter() {
        let (name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let no_text = |_| {
            let place = if key.is_empty() { "the scene" } else { key };
            PyTypeError::new_err(format!("{place}: found the key {name}; allowed: keys that are texts"))
        };
        let name: String = name.extract().map_err(no_text)?;
        let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
        if !value.is_none() {
            table.insert(name, of(&path, &value)?);
        }
    }
    Ok(table)
}

fn refused(key: &str, value: &Bound<'_, PyAny>) -> PyErr {
    let kind = value.get_type().name().map_or_else(|_| "something else".to_owned(), |name| name.to_string());
    let place = if key.is_empty() { "the scene" } else { key };
    let allowed = if key.is_empty() { "a dict" } else { ALLOWED };
    PyTypeError::new_err(format!("{place}: found a value of type {kind}; allowed: {allowed}"))
}
