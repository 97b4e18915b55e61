//! What a run found.

use std::path::PathBuf;

use gearwear::results::run::{FlankRecord, RunRecord, SliceRecord};
use gearwear::{Gear, RunFiles, columns};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::array::borrowed;
use crate::errors;
use crate::record_bytes;
use crate::scene::json;
use crate::table::{self, Columns};

/// A finished run, or what an unfinished one came to.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Run {
    record: RunRecord,
}

/// How the values of a field lie.
#[derive(Clone, Copy)]
enum Place {
    /// One a point from root to tip.
    Points,
    /// One a slice over the face width.
    Slices,
    /// One a point and slice, slice after slice.
    Flank,
    /// One a position of the tooth.
    Positions,
    /// One a slice and position, position after position.
    Mesh,
}

/// The fields of a record that are arrays, by name: values and place.
macro_rules! fields {
    ($record:expr, $name:expr, $($field:ident: $place:ident),* $(,)?) => {
        match $name {
            $(stringify!($field) => Some((&$record.$field[..], Place::$place)),)*
            _ => None,
        }
    };
}

/// A field of a flank.
fn of_flank<'a>(flank: &'a FlankRecord, name: &str) -> Option<(&'a [f64], Place)> {
    if name == "verified_wear_um" {
        return flank.verified_wear_um.as_deref().map(|values| (values, Place::Flank));
    }
    fields!(
        flank, name,
        radius_mm: Points,
        roll_angle_deg: Points,
        width_mm: Slices,
        removed_um: Flank,
        sliding_mm_per_mesh: Flank,
        wear_um: Flank,
        pressure_new_MPa: Flank,
        pressure_worn_MPa: Flank,
    )
}

/// A field of the mesh of one tooth slice by slice.
fn of_slices<'a>(slices: &'a SliceRecord, name: &str) -> Option<(&'a [f64], Place)> {
    fields!(
        slices, name,
        width_mm: Slices,
        ahead_mm: Slices,
        position_mm: Positions,
        line_load_new_N_per_mm: Mesh,
        line_load_worn_N_per_mm: Mesh,
        peak_pressure_new_MPa: Mesh,
        peak_pressure_worn_MPa: Mesh,
    )
}

/// The same of what is so or not.
fn flags_of_slices<'a>(slices: &'a SliceRecord, name: &str) -> Option<(&'a [bool], Place)> {
    fields!(slices, name, at_sharp_edge_new: Mesh, at_sharp_edge_worn: Mesh)
}

fn gear_of(name: &str) -> PyResult<Gear> {
    let found = Gear::BOTH.into_iter().find(|gear| gear.name() == name);
    found.ok_or_else(|| PyKeyError::new_err(format!("found the gear {name:?}; allowed: pinion, wheel")))
}

fn slice_shape(slices: &SliceRecord, place: Place) -> Vec<usize> {
    let (across, along) = (slices.width_mm.len(), slices.position_mm.len());
    match place {
        Place::Mesh => vec![along, across],
        Place::Positions => vec![along],
        _ => vec![across],
    }
}

impl Run {
    pub(crate) fn of(record: RunRecord) -> Self {
        Self { record }
    }

    /// Shape of a field over a flank: points alone where all sections are alike.
    fn flank_shape(&self, flank: &FlankRecord) -> Vec<usize> {
        match self.record.slices {
            None => vec![flank.radius_mm.len()],
            Some(_) => vec![flank.width_mm.len(), flank.radius_mm.len()],
        }
    }
}

#[pymethods]
impl Run {
    /// A field of a flank, without a copy; None where it is not known.
    fn flank_array<'py>(slf: &Bound<'py, Self>, gear: &str, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let gear = gear_of(gear)?;
        borrowed(slf, |run| {
            let flank = &run.record.flanks[gear];
            let (values, place) = of_flank(flank, name)?;
            let shape = match place {
                Place::Flank => run.flank_shape(flank),
                _ => vec![values.len()],
            };
            Some((values, shape))
        })
    }

    /// Wear, or by `pressure` pressure, of a flank at every snapshot, without a copy.
    fn snapshot_arrays<'py>(slf: &Bound<'py, Self>, gear: &str, pressure: bool) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let gear = gear_of(gear)?;
        let at = |number: usize| {
            borrowed(slf, |run| {
                let flank = &run.record.flanks[gear];
                let snapshots = if pressure { &flank.snapshot_pressure_MPa } else { &flank.snapshot_wear_um };
                Some((&snapshots.get(number)?[..], run.flank_shape(flank)))
            })
        };
        (0..).map_while(|number| at(number).transpose()).collect()
    }

    /// A field of the mesh of one tooth slice by slice, without a copy; None where the sections are alike.
    fn slice_array<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let numbers = borrowed(slf, |run| {
            let slices = run.record.slices.as_ref()?;
            of_slices(slices, name).map(|(values, place)| (values, slice_shape(slices, place)))
        })?;
        match numbers {
            Some(array) => Ok(Some(array)),
            None => borrowed(slf, |run| {
                let slices = run.record.slices.as_ref()?;
                flags_of_slices(slices, name).map(|(values, place)| (values, slice_shape(slices, place)))
            }),
        }
    }

    /// The columns of a table, as its CSV file has them; None where the run has no such table.
    fn table(&self, py: Python<'_>, name: &str) -> PyResult<Option<Columns>> {
        let table = py.detach(|| columns::of_run(&self.record, name));
        table.map(|table| table::columns(py, table)).transpose()
    }

    /// `summary.json`.
    #[getter]
    fn summary_json(&self) -> PyResult<String> {
        json(&self.record.summary)
    }

    /// The resolved scene.
    #[getter]
    fn scene_toml(&self) -> &str {
        &self.record.scene_toml
    }

    /// The files that it names: names and bytes.
    #[getter]
    fn input_files(&self) -> Vec<(String, Vec<u8>)> {
        self.record.inputs.iter().map(|file| (file.name.clone(), file.bytes.clone())).collect()
    }

    /// Names and radii of A to E on a flank.
    fn path_points(&self, gear: &str) -> PyResult<Vec<(String, f64)>> {
        let points = self.record.flanks[gear_of(gear)?].path_point_radius_mm.named();
        Ok(points.into_iter().map(|(name, radius_mm)| (name.to_owned(), radius_mm)).collect())
    }

    /// The pair in mesh, to scale, as JSON.
    #[getter]
    fn drawing_json(&self) -> PyResult<String> {
        json(&self.record.drawing)
    }

    /// The plots of its page: names and SVG.
    fn figures(&self, py: Python<'_>) -> Vec<(String, String)> {
        let figures = py.detach(|| gearwear::figures(&self.record));
        figures.into_iter().map(|figure| (figure.name, figure.svg)).collect()
    }

    /// Writes what `gearwear run` writes.
    fn write(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        page: bool,
        workbook: bool,
        series: bool,
        figures: Option<PathBuf>,
    ) -> PyResult<()> {
        let files = RunFiles { page, workbook, series, figures };
        py.detach(|| gearwear::write_with(&self.record, &files, &folder)).map_err(|error| errors::of_report(&error))
    }

    /// The run in a folder.
    #[staticmethod]
    fn read(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        py.detach(|| gearwear::read(&folder)).map(Self::of).map_err(|error| errors::of_result(&error))
    }

    /// Everything, for [`Self::from_bytes`] of the same version.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        record_bytes::of(py, &self.record)
    }

    /// A run from [`Self::to_bytes`].
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        record_bytes::read(py, bytes).map(Self::of)
    }
}
