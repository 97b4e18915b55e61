//! Calibrations.

use std::path::PathBuf;

use gearwear::Calibrated;
use gearwear::results::run::StageTime;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// A calibration, and how it came about.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Calibration {
    pub(crate) calibrated: Calibrated,
    /// Of the scene that it was made for.
    pub(crate) title: String,
}

#[pymethods]
impl Calibration {
    /// A calibration from the text of its file.
    #[staticmethod]
    fn from_json(text: &str, title: String, stages: Vec<(String, f64)>, wall_s: f64) -> PyResult<Self> {
        let calibration =
            gearwear::Calibration::from_json(text).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let stages = stages.into_iter().map(|(name, wall_s)| StageTime { name, wall_s }).collect();
        Ok(Self { calibrated: Calibrated { calibration, stages, wall_s }, title })
    }

    /// The text of its file.
    fn to_json(&self) -> String {
        self.calibrated.calibration.to_json()
    }

    #[getter]
    fn title(&self) -> &str {
        &self.title
    }

    /// Its stages with their wall times.
    #[getter]
    fn stages(&self) -> Vec<(String, f64)> {
        self.calibrated.stages.iter().map(|stage| (stage.name.clone(), stage.wall_s)).collect()
    }

    #[getter]
    fn wall_s(&self) -> f64 {
        self.calibrated.wall_s
    }

    /// Writes what `gearwear calibrate` writes.
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        let written = py.detach(|| gearwear::write_calibration(&self.calibrated, &self.title, &file));
        written.map_err(|error| errors::of_report(&error))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.calibrated.calibration == other.calibrated.calibration
    }
}
