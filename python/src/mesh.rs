//! Meshes.

use std::collections::BTreeMap;
use std::path::PathBuf;

use gearwear::mesh::{self, CellBlock, CellKind, DataArray, Format, PhysicalTag, Values};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::array::borrowed;
use crate::errors;

/// Numbers of points or cells, integers or not.
#[derive(FromPyObject)]
pub(crate) enum Numbers<'py> {
    Integers(PyReadonlyArrayDyn<'py, i64>),
    Reals(PyReadonlyArrayDyn<'py, f64>),
}

type ByName<T> = BTreeMap<String, T>;

/// A mesh, shaped like those of meshio.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Mesh {
    pub(crate) mesh: mesh::Mesh,
}

impl Mesh {
    pub(crate) fn of(mesh: mesh::Mesh) -> Self {
        Self { mesh }
    }
}

#[pymethods]
impl Mesh {
    /// A mesh of its parts, as meshio has them; points are rows of three numbers.
    #[new]
    fn new(
        points: PyReadonlyArrayDyn<'_, f64>,
        cells: Vec<(String, PyReadonlyArrayDyn<'_, i64>)>,
        point_data: ByName<Numbers<'_>>,
        cell_data: ByName<Vec<Numbers<'_>>>,
        point_sets: ByName<PyReadonlyArrayDyn<'_, i64>>,
        cell_sets: ByName<Vec<PyReadonlyArrayDyn<'_, i64>>>,
        field_data: ByName<(i64, u8)>,
    ) -> PyResult<Self> {
        let flat: Vec<f64> = points.as_array().iter().copied().collect();
        let mesh = mesh::Mesh {
            points: flat.as_chunks().0.to_vec(),
            cells: cells.iter().map(|(kind, nodes)| block(kind, nodes)).collect::<PyResult<_>>()?,
            point_data: each(point_data, |name, numbers| data(&name, &numbers))?,
            cell_data: each(cell_data, |name, blocks| blocks.iter().map(|numbers| data(&name, numbers)).collect())?,
            point_sets: each(point_sets, |name, set| members(&name, &set))?,
            cell_sets: each(cell_sets, |name, sets| sets.iter().map(|set| members(&name, set)).collect())?,
            field_data: each(field_data, |_, (tag, dimension)| Ok(PhysicalTag { tag, dimension }))?,
            left_out: Vec::new(),
        };
        mesh.check().map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(Self { mesh })
    }

    /// The mesh in a file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| mesh::read(&path)).map(Self::of).map_err(|error| errors::of_mesh_file(&error))
    }

    /// Writes it into a file, whose ending tells the format.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let written = py.detach(|| mesh::write(&self.mesh, &path));
        written.map_err(|error| errors::of_mesh_file(&error))
    }

    /// Coordinates of the points in mm, rows of three.
    #[getter]
    fn points<'py>(slf: &Bound<'py, Self>) -> PyResult<Option<Bound<'py, PyAny>>> {
        borrowed(slf, |own| Some((own.mesh.points.as_flattened(), vec![own.mesh.points.len(), 3])))
    }

    /// Blocks of cells of one kind: its name, and a row of node numbers for each.
    #[getter]
    fn cells(&self, py: Python<'_>) -> PyResult<Vec<(String, Py<PyAny>)>> {
        let of_block =
            |block: &CellBlock| Ok((name_of(block.kind)?, places(py, &block.nodes, Some(block.kind.node_count()))?));
        self.mesh.cells.iter().map(of_block).collect()
    }

    /// Numbers at the points, by name.
    #[getter]
    fn point_data(&self, py: Python<'_>) -> PyResult<ByName<Py<PyAny>>> {
        self.mesh.point_data.iter().map(|(name, data)| Ok((name.clone(), numbers(py, data)?))).collect()
    }

    /// Numbers of the cells, by name, for each block.
    #[getter]
    fn cell_data(&self, py: Python<'_>) -> PyResult<ByName<Vec<Py<PyAny>>>> {
        let of_blocks = |blocks: &Vec<DataArray>| blocks.iter().map(|data| numbers(py, data)).collect::<PyResult<_>>();
        self.mesh.cell_data.iter().map(|(name, blocks)| Ok((name.clone(), of_blocks(blocks)?))).collect()
    }

    /// Sets of points by name.
    #[getter]
    fn point_sets(&self, py: Python<'_>) -> PyResult<ByName<Py<PyAny>>> {
        self.mesh.point_sets.iter().map(|(name, set)| Ok((name.clone(), places(py, set, None)?))).collect()
    }

    /// Sets of cells by name: for each block the numbers of its cells within the block.
    #[getter]
    fn cell_sets(&self, py: Python<'_>) -> PyResult<ByName<Vec<Py<PyAny>>>> {
        let of_blocks = |sets: &Vec<Vec<usize>>| sets.iter().map(|set| places(py, set, None)).collect::<PyResult<_>>();
        self.mesh.cell_sets.iter().map(|(name, sets)| Ok((name.clone(), of_blocks(sets)?))).collect()
    }

    /// Tag and dimension of the sets that come from physical groups of Gmsh.
    #[getter]
    fn field_data(&self) -> ByName<(i64, u8)> {
        self.mesh.field_data.iter().map(|(name, tag)| (name.clone(), (tag.tag, tag.dimension))).collect()
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.mesh == other.mesh
    }

    /// Everything, for [`Self::from_bytes`] of the same version.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| mesh::to_bytes(&self.mesh, Format::Json));
        bytes.map(|bytes| PyBytes::new(py, &bytes)).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The same from [`Self::to_bytes`].
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        let mesh = py.detach(|| mesh::from_bytes(Format::Json, bytes));
        mesh.map(Self::of).map_err(|error| PyValueError::new_err(format!("no mesh of this version: {error}")))
    }
}

fn each<A, B>(all: ByName<A>, mut of: impl FnMut(String, A) -> PyResult<B>) -> PyResult<ByName<B>> {
    all.into_iter().map(|(name, one)| Ok((name.clone(), of(name, one)?))).collect()
}

/// Its name, meshio's.
fn name_of(kind: CellKind) -> PyResult<String> {
    match serde_json::to_value(kind) {
        Ok(serde_json::Value::String(name)) => Ok(name),
        other => Err(PyValueError::new_err(format!("a kind of cells without a name: {other:?}"))),
    }
}

fn block(name: &str, nodes: &PyReadonlyArrayDyn<'_, i64>) -> PyResult<CellBlock> {
    let kind: CellKind = serde_json::from_value(name.into()).map_err(|_| {
        let known: Vec<String> = CellKind::ALL.into_iter().filter_map(|kind| name_of(kind).ok()).collect();
        PyValueError::new_err(format!("cells: found {name:?}; allowed: {}", known.join(", ")))
    })?;
    let (array, count) = (nodes.as_array(), kind.node_count());
    if array.ndim() != 2 || array.shape()[1] != count {
        let message =
            format!("cells {name:?}: found an array of shape {:?}; allowed: rows of {count} nodes", array.shape());
        return Err(PyValueError::new_err(message));
    }
    Ok(CellBlock::new(kind, members(name, nodes)?))
}

/// Numbers of points or cells, from 0.
fn members(name: &str, set: &PyReadonlyArrayDyn<'_, i64>) -> PyResult<Vec<usize>> {
    let place = |place: &i64| {
        usize::try_from(*place)
            .map_err(|_| PyValueError::new_err(format!("{name}: found the number {place}; allowed: 0 or more")))
    };
    set.as_array().iter().map(place).collect()
}

fn data(name: &str, numbers: &Numbers<'_>) -> PyResult<DataArray> {
    let components = |shape: &[usize]| match shape {
        [_] => Ok(1),
        [_, components] => Ok(*components),
        _ => Err(PyValueError::new_err(format!(
            "{name}: found an array of shape {shape:?}; allowed: one or two dimensions"
        ))),
    };
    Ok(match numbers {
        Numbers::Integers(array) => {
            let (array, components) = (array.as_array(), components(array.as_array().shape())?);
            DataArray { components, values: Values::Integers(array.iter().copied().collect()) }
        }
        Numbers::Reals(array) => {
            let (array, components) = (array.as_array(), components(array.as_array().shape())?);
            DataArray { components, values: Values::Reals(array.iter().copied().collect()) }
        }
    })
}

fn numbers(py: Python<'_>, data: &DataArray) -> PyResult<Py<PyAny>> {
    let columns = (data.components > 1).then_some(data.components);
    match &data.values {
        Values::Integers(values) => shaped(py, values.clone(), columns),
        Values::Reals(values) => shaped(py, values.clone(), columns),
    }
}

fn places(py: Python<'_>, places: &[usize], columns: Option<usize>) -> PyResult<Py<PyAny>> {
    shaped(py, places.iter().map(|place| *place as i64).collect(), columns)
}

/// An array of its own, in rows where there are `columns`.
fn shaped<T: numpy::Element>(py: Python<'_>, values: Vec<T>, columns: Option<usize>) -> PyResult<Py<PyAny>> {
    let count = values.len();
    let array = values.into_pyarray(py);
    Ok(match columns {
        Some(columns) => array.reshape([count / columns, columns])?.into_any().unbind(),
        None => array.into_any().unbind(),
    })
}
