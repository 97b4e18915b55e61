//! Scenes.

use std::collections::hash_map::DefaultHasher;
use std::fs::File;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use gearwear::exchange::rexs;
use gearwear::exchange::rexs::container::{self, FileError};
use gearwear::results::run::InputFile;
use gearwear::sweep::SweepQuestion;
use gearwear::toml::{Table, Value};
use gearwear::{Done, LoadError, LoadedScene, Meshed, SceneText, UncertaintyQuestion};
use gearwear::{KeptRunError, SceneFault};
use pyo3::prelude::*;

use crate::calibration::Calibration;
use crate::errors;
use crate::fem::FemPair;
use crate::many_runs::{self, Evaluated};
use crate::mesh::Mesh;
use crate::run::Run;
use crate::study::Study;
use crate::sweep::Sweep;
use crate::uncertainty::Uncertainty;
use crate::value;
use crate::watched::{cores, watched};

/// A scene with every file it names.
#[pyclass(frozen, module = "gearwear._native")]
pub(crate) struct Scene {
    loaded: LoadedScene,
    content: OnceLock<Content>,
}

/// What makes two scenes equal: the resolved text, and the files that it names.
#[derive(PartialEq, Eq, Hash)]
struct Content {
    resolved: String,
    files: Vec<Vec<u8>>,
}

impl From<LoadedScene> for Scene {
    fn from(loaded: LoadedScene) -> Self {
        Self { loaded, content: OnceLock::new() }
    }
}

impl Scene {
    fn of(py: Python<'_>, loaded: Result<LoadedScene, LoadError>) -> PyResult<Self> {
        loaded.map(Self::from).map_err(|error| errors::of_loading(py, &error))
    }

    /// The resolved scene.
    fn table(&self) -> Table {
        self.content().resolved.parse().expect("a resolved scene is TOML")
    }

    fn content(&self) -> &Content {
        self.content.get_or_init(|| Content {
            resolved: self.loaded.to_toml(),
            files: self.loaded.input_files().into_iter().map(|file| file.bytes).collect(),
        })
    }
}

#[pymethods]
impl Scene {
    /// The scene in a text; of the files it names, those given need not be read, and the others lie in the folder.
    #[staticmethod]
    fn from_parts(
        py: Python<'_>,
        name: String,
        text: String,
        folder: PathBuf,
        files: Vec<(String, Vec<u8>)>,
    ) -> PyResult<Self> {
        let files = files.into_iter().map(|(name, bytes)| InputFile { name, bytes }).collect();
        Self::of(py, LoadedScene::from_parts(SceneText { name, text }, &folder, files))
    }

    /// The scene in a file.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::of(py, LoadedScene::open(path))
    }

    /// A built-in scene.
    #[staticmethod]
    fn preset(py: Python<'_>, name: &str) -> PyResult<Self> {
        Self::of(py, LoadedScene::preset(name))
    }

    /// The text of the scene of a stage in a REXS file, and what of the stage it leaves out.
    #[staticmethod]
    fn text_of_rexs(py: Python<'_>, path: PathBuf, stage: Option<usize>) -> PyResult<(String, Vec<String>)> {
        let read = || -> Result<_, FileError> {
            let bytes = container::read(File::open(&path).map_err(FileError::Unreadable)?)?;
            let text = container::text(&bytes).map_err(FileError::Rexs)?;
            rexs::scene(&text, stage).map_err(FileError::Rexs)
        };
        let scene = py.detach(read).map_err(|error| errors::of_rexs(&error, &path.display().to_string()))?;
        Ok((scene.text, scene.warnings))
    }

    /// The text of a scene file that says what a mapping does.
    #[staticmethod]
    fn text_of(mapping: &Bound<'_, PyAny>) -> PyResult<String> {
        value::table("", mapping).map(|table| table.to_string())
    }

    /// The same scene with keys changed, each to a value or, by None, to nothing.
    fn with_all(&self, py: Python<'_>, changes: Vec<(String, Bound<'_, PyAny>)>) -> PyResult<Self> {
        let change = |(key, value): (String, Bound<'_, PyAny>)| {
            let value = if value.is_none() { None } else { Some(value::of(&key, &value)?) };
            Ok((key, value))
        };
        let changes: Vec<_> = changes.into_iter().map(change).collect::<PyResult<_>>()?;
        Self::of(py, self.loaded.with_all(changes))
    }

    /// The same scene with a calibration.
    fn with_calibration(&self, py: Python<'_>, calibration: &Calibration) -> PyResult<Self> {
        Self::of(py, self.loaded.with_calibration(calibration.calibrated.calibration.clone()))
    }

    /// The name of the text, as messages give it.
    #[getter]
    fn name(&self) -> &str {
        &self.loaded.given().name
    }

    /// The text it was made from.
    #[getter]
    fn text(&self) -> &str {
        &self.loaded.given().text
    }

    /// The folder of the files it names.
    #[getter]
    fn folder(&self) -> &Path {
        self.loaded.folder()
    }

    /// The files it names: names and bytes.
    #[getter]
    fn files(&self) -> Vec<(String, Vec<u8>)> {
        self.loaded.input_files().into_iter().map(|InputFile { name, bytes }| (name, bytes)).collect()
    }

    /// What the user should know about it.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.loaded.warnings().to_vec()
    }

    /// The resolved scene.
    fn to_toml(&self) -> &str {
        &self.content().resolved
    }

    /// The same as JSON.
    fn to_json(&self) -> PyResult<String> {
        json(&self.table())
    }

    /// What it is called.
    #[getter]
    fn title(&self) -> String {
        self.table().get("title").and_then(Value::as_str).unwrap_or_default().to_owned()
    }

    /// The stages it needs and those left out, as JSON.
    fn plan_json(&self) -> PyResult<String> {
        json(&self.loaded.plan())
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
    ) -> PyResult<(Run, Option<String>)> {
        let scene = self.loaded.clone();
        let work = move |observer: &dyn gearwear::Observer| match folder {
            Some(folder) => gearwear::run_kept(&scene, &folder, observer),
            None => gearwear::run(&scene, observer).map_err(KeptRunError::Run),
        };
        let done = watched(py, threads, progress, work)?;
        let given = self.loaded.given();
        let Done { record, failure } = done.map_err(|error| errors::of_kept_run(py, &error, given))?;
        Ok((Run::of(record), failure.map(|failure| failure.to_string())))
    }

    /// Runs it for each of `rows`, which hold a value for each of `keys`, one row a thread: the outputs of each row, and why one has none.
    fn evaluate(
        &self,
        py: Python<'_>,
        keys: Vec<String>,
        rows: Vec<Vec<Bound<'_, PyAny>>>,
        outputs: Vec<String>,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Evaluated> {
        many_runs::evaluate(py, &self.loaded, keys, rows, outputs, (threads, progress))
    }

    /// The error of every model that fits it against its run time.
    fn accuracy(
        &self,
        py: Python<'_>,
        within: f64,
        quick: bool,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Study> {
        let scene = self.loaded.clone();
        let work = move |observer: &dyn gearwear::Observer| {
            gearwear_validation::found::accuracy(&scene, within, quick, observer)
        };
        Study::of(py, watched(py, threads, progress, work)?)
    }

    /// Better designs, as its table `[improve]` asks.
    fn improve(
        &self,
        py: Python<'_>,
        folder: Option<PathBuf>,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Study> {
        let (scene, count) = (self.loaded.clone(), cores(threads));
        let work = move |observer: &dyn gearwear::Observer| {
            gearwear_validation::found::improve(&scene, folder.as_deref(), count, observer)
        };
        Study::of(py, watched(py, 1, progress, work)?)
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
        many_runs::sweep(py, &self.loaded, SweepQuestion { vary, best, subject_to, error_estimate, outputs })
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
        many_runs::uncertainty(py, &self.loaded, question, folder, (threads, progress))
    }

    /// Calibrates the fast model of its pair.
    fn calibrate(&self, py: Python<'_>, threads: usize, progress: Option<Bound<'_, PyAny>>) -> PyResult<Calibration> {
        let scene = self.loaded.clone();
        let done = watched(py, threads, progress, move |observer| gearwear::calibrate(&scene, observer))?;
        let given = self.loaded.given();
        let calibrated = done.map_err(|error| match error.in_the_scene(given) {
            Some(error) => errors::of_scene(py, &error),
            None => errors::of_run(py, error.to_string()),
        })?;
        Ok(Calibration { calibrated, title: self.title() })
    }

    /// The finite-element mesh of its pair in the plane, or of a pitch of each gear in space, under load or not.
    fn mesh(
        &self,
        py: Python<'_>,
        position_mm: Option<f64>,
        in_space: bool,
        loaded: bool,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Mesh> {
        let scene = self.loaded.clone();
        let of = match (in_space, loaded) {
            (_, true) => Meshed::Loaded,
            (true, false) => Meshed::InSpace,
            (false, false) => Meshed::InPlane,
        };
        let work = move |observer: &dyn gearwear::Observer| gearwear::pair_mesh(&scene, of, position_mm, observer);
        let given = self.loaded.given();
        let mesh = watched(py, threads, progress, work)?.map_err(|error| match error.in_the_scene(given) {
            Some(error) => errors::of_scene(py, &error),
            None => errors::of_run(py, error.to_string()),
        })?;
        Ok(Mesh::of(mesh))
    }

    /// Solves the contact of its pair with finite elements: the answer, and what went wrong where it is not whole.
    fn fem(
        &self,
        py: Python<'_>,
        position_mm: Option<f64>,
        threads: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<(FemPair, Option<String>)> {
        let scene = self.loaded.clone();
        let work = move |observer: &dyn gearwear::Observer| gearwear::fem_pair(&scene, position_mm, observer);
        let given = self.loaded.given();
        let Done { record, failure } =
            watched(py, threads, progress, work)?.map_err(|error| match error.in_the_scene(given) {
                Some(error) => errors::of_scene(py, &error),
                None => errors::of_run(py, error.to_string()),
            })?;
        Ok((FemPair::of(record), failure.map(|failure| failure.to_string())))
    }
}

/// A record as JSON.
pub(crate) fn json(record: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(record).map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
}
