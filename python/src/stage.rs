//! Planetary stages, and what their runs find.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

use gearwear::planetary_run::record::PlanetaryRecord;
use gearwear::planetary_run::{self, PlanetaryRunError};
use gearwear::results::run::{InputFile, RunRecord};
use gearwear::scene::planetary::PlanetaryScene;
use gearwear::scene::planetary::mesh::{PerMesh, StageMesh};
use gearwear::sweep::SweepQuestion;
use gearwear::{
    Done, KeptRunError, LoadError, OpenedScene, RunFiles, SceneFault, SceneText, UncertaintyQuestion, columns,
};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors;
use crate::many_runs::{self, Evaluated};
use crate::record_bytes;
use crate::run::Run;
use crate::scene::{Scene, json};
use crate::sweep::Sweep;
use crate::table::{self, Columns};
use crate::uncertainty::Uncertainty;
use crate::value;
use crate::watched::watched;

/// A planetary stage with every file it names.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Stage {
    scene: PlanetaryScene,
}

fn mesh_of(name: &str) -> PyResult<StageMesh> {
    let found = StageMesh::BOTH.into_iter().find(|mesh| mesh.folder() == name);
    found.ok_or_else(|| PyKeyError::new_err(format!("found the mesh {name:?}; allowed: sun-planet, planet-ring")))
}

impl Stage {
    fn of(py: Python<'_>, scene: Result<PlanetaryScene, LoadError>) -> PyResult<Self> {
        scene.map(|scene| Self { scene }).map_err(|error| errors::of_loading(py, &error))
    }

    fn opened(&self) -> OpenedScene {
        OpenedScene::Planetary(Box::new(self.scene.clone()))
    }

    /// What makes two stages equal: the resolved texts of both meshes, and the files that they name.
    fn content(&self) -> ([String; 2], Vec<Vec<u8>>) {
        let files = self.scene.input_files().into_iter().map(|file| file.bytes);
        (self.scene.meshes.both().map(|mesh| mesh.to_toml()), files.collect())
    }
}

#[pymethods]
impl Stage {
    /// The stage in a text; of the files it names, those given need not be read, and the others lie in the folder.
    #[staticmethod]
    fn from_parts(
        py: Python<'_>,
        name: String,
        text: String,
        folder: PathBuf,
        files: Vec<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        let files: Vec<InputFile> = files.into_iter().map(|(name, bytes)| InputFile { name, bytes }).collect();
        Self::of(py, PlanetaryScene::from_parts(SceneText { name, text }, &folder, &files))
    }

    /// The stage in a file.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let given = SceneText::read(&path).map_err(|error| errors::of_loading(py, &error))?;
        Self::of(py, PlanetaryScene::from_text(given, folder))
    }

    /// The same stage with keys changed, each to a value or, by None, to nothing.
    fn with_all(&self, py: Python<'_>, changes: Vec<(String, Bound<'_, PyAny>)>) -> PyResult<Self> {
        let change = |(key, value): (String, Bound<'_, PyAny>)| {
            let value = if value.is_none() { None } else { Some(value::of(&key, &value)?) };
            Ok((key, value))
        };
        let changes: Vec<_> = changes.into_iter().map(change).collect::<PyResult<_>>()?;
        Self::of(py, self.scene.with_all(changes))
    }

    /// The name of the text, as messages give it.
    #[getter]
    fn name(&self) -> &str {
        &self.scene.given.name
    }

    /// The text it was made from.
    #[getter]
    fn text(&self) -> &str {
        &self.scene.given.text
    }

    /// The folder of the files it names.
    #[getter]
    fn folder(&self) -> &Path {
        self.scene.meshes.sun_planet.folder()
    }

    /// The files it names: names and bytes.
    #[getter]
    fn files(&self) -> Vec<(String, Vec<u8>)> {
        self.scene.input_files().into_iter().map(|InputFile { name, bytes }| (name, bytes)).collect()
    }

    /// What the user should know about it.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.scene.warnings.clone()
    }

    /// What it is called.
    #[getter]
    fn title(&self) -> &str {
        &self.scene.title
    }

    /// The scene of a mesh, as a pair.
    fn mesh(&self, name: &str) -> PyResult<Scene> {
        Ok(self.scene.meshes[mesh_of(name)?].clone().into())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.content() == other.content()
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.content().hash(&mut hasher);
        hasher.finish()
    }

    /// Runs it, in a folder where one is given, with the run that is there: the run, and what went wrong where it did not come to its end.
    fn run(
        &self,
        py: Python<'_>,
        folder: Option<PathBuf>,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<(StageRun, Option<String>)> {
        let scene = self.scene.clone();
        let work = move |observer: &dyn gearwear::Observer| match folder {
            Some(folder) => planetary_run::run_kept(&scene, &folder, &RunFiles::default(), true, observer),
            None => planetary_run::run(&scene, observer),
        };
        let done = watched(py, threads, progress, work)?;
        let Done { record, failure } = done.map_err(|error| self.refused(py, error))?;
        Ok((StageRun { record }, failure.map(|failure| failure.to_string())))
    }

    /// Runs it for each of `rows`, which hold a value for each of `keys`.
    fn evaluate(
        &self,
        py: Python<'_>,
        keys: Vec<String>,
        rows: Vec<Vec<Bound<'_, PyAny>>>,
        outputs: Vec<String>,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Evaluated> {
        many_runs::evaluate(py, self.opened(), keys, rows, outputs, (threads, progress))
    }

    /// Its sweep over these keys.
    fn sweep(
        &self,
        py: Python<'_>,
        vary: Vec<String>,
        best: Option<String>,
        subject_to: Vec<String>,
        error_estimate: bool,
        outputs: Vec<String>,
    ) -> PyResult<Sweep> {
        many_runs::sweep(py, self.opened(), SweepQuestion { vary, best, subject_to, error_estimate, outputs })
    }

    /// Quantiles and Sobol indices of its figures where keys are uncertain.
    #[allow(clippy::too_many_arguments, reason = "the arguments of the Python function")]
    fn uncertainty(
        &self,
        py: Python<'_>,
        uncertain: Vec<String>,
        correlation: Vec<String>,
        outputs: Vec<String>,
        limits: Vec<String>,
        samples: usize,
        seed: u32,
        on_own_surface: bool,
        run_all: bool,
        folder: Option<PathBuf>,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Uncertainty> {
        let question =
            UncertaintyQuestion { uncertain, correlation, outputs, limits, samples, seed, on_own_surface, run_all };
        many_runs::uncertainty(py, self.opened(), question, folder, (threads, progress))
    }
}

impl Stage {
    /// What keeps it from being run.
    fn refused(&self, py: Python<'_>, error: PlanetaryRunError) -> PyErr {
        match error {
            PlanetaryRunError::Report(error) => errors::of_report(&error),
            PlanetaryRunError::Mesh { mesh, source: KeptRunError::Run(failure) } => {
                match failure.in_the_scene(&self.scene.meshes[mesh].given) {
                    Some(error) => errors::of_scene(py, &self.scene.told_of_stage(mesh, error.problems)),
                    None => errors::of_run(py, format!("{}: {failure}", mesh.in_words())),
                }
            }
            PlanetaryRunError::Mesh { source, .. } => errors::of_kept_run(py, &source, &self.scene.given),
        }
    }
}

/// A finished run of a stage, or what an unfinished one came to.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct StageRun {
    record: PlanetaryRecord,
}

#[pymethods]
impl StageRun {
    /// The run of a mesh; None where it was not begun.
    fn mesh(&self, name: &str) -> PyResult<Option<Run>> {
        Ok(self.record.meshes[mesh_of(name)?].clone().map(Run::of))
    }

    /// `summary.json`.
    #[getter]
    fn summary_json(&self) -> PyResult<String> {
        json(&self.record.summary)
    }

    /// The file, as given.
    #[getter]
    fn scene_toml(&self) -> &str {
        &self.record.scene_toml
    }

    /// The columns of `transmission_error.csv`.
    fn transmission_error(&self, py: Python<'_>) -> PyResult<Columns> {
        let table = columns::table("transmission_error", &self.record.transmission_error);
        table::columns(py, table)
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
        let written = py.detach(|| planetary_run::folder::write(&self.record, &files, &folder));
        written.map_err(|error| errors::of_report(&error))
    }

    /// The run in a folder.
    #[staticmethod]
    fn read(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let record = py.detach(|| planetary_run::folder::read(&folder)).map_err(|error| errors::of_result(&error))?;
        Ok(Self { record })
    }

    /// Everything, for [`Self::from_bytes`] of the same version.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let PlanetaryRecord { scene_toml, meshes, transmission_error, .. } = &self.record;
        record_bytes::of(py, &(json(&self.record.summary)?, scene_toml, meshes, transmission_error))
    }

    /// A run from [`Self::to_bytes`].
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        type Parts = (String, String, PerMesh<Option<RunRecord>>, Vec<planetary_run::record::StageTransmissionRow>);
        let (summary, scene_toml, meshes, transmission_error): Parts = record_bytes::read(py, bytes)?;
        let summary = serde_json::from_str(&summary)
            .map_err(|error| pyo3::exceptions::PyValueError::new_err(format!("no result of this version: {error}")))?;
        Ok(Self { record: PlanetaryRecord { summary, scene_toml, meshes, transmission_error } })
    }
}
