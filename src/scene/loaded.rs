//! A scene with every file it names: what a run is made from.
//!
//! A scene may name a calibration (`contact.calibration`), a curve of tooth stiffness (`stiffness.curve`) and a measured flank of each gear
//! (`initial_flank`). A [`LoadedScene`] cannot lack one: it comes into being where they are read, or is a variant of one that has them.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::Arc;

use super::draft::Draft;
pub use super::named_files::{CALIBRATION, CURVE, NamedFile, NamedFiles};
use super::named_files::{KEYS, calibration, initial_flank, of_another_pair, stiffness_curve, warnings};
use super::planetary::mesh::StageMesh;
use super::scene_text::folder_of;
pub use super::scene_text::{LoadError, SceneError, SceneText};
use super::{Problem, ProblemKind, Resolved, presets};
use gearwear_bodies::gear::Gear;
use gearwear_physics::assessment::kept_elements::KeptElements;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::mesh_cycle::pair_in_space::KeptInSpace;
use gearwear_physics::operation::Scene;
use gearwear_physics::results::run::InputFile;
use gearwear_physics::simulation::settings::Stepping;

/// Finest resolution of a fast model.
#[derive(Debug, Clone, Copy)]
pub struct FinestNumerics {
    /// Positions from A to E.
    pub positions: usize,
    /// Points of a flank.
    pub flank_points: usize,
    /// Tolerance of adaptive steps, µm.
    pub tolerance_um: f64,
}

/// The folder of a run's input files within its own.
const INPUTS: &str = "inputs";
/// Ending of the name of a changed text.
const CHANGED: &str = " as changed";
/// A scene, checked and with every default filled in, and every file it names.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedScene {
    pub resolved: Resolved,
    pub files: Arc<NamedFiles>,
    pub given: Arc<SceneText>,
    /// Where files lie that are not read yet.
    pub folder: Arc<Path>,
    /// Teeth in space that a run of it, or of a scene it was made of, has condensed.
    pub teeth_in_space: KeptInSpace,
    /// Plane finite elements that runs of it leave to one another.
    pub elements: KeptElements,
}

impl LoadedScene {
    /// Opens the scene file at `path` (`-`: standard input). Files it names lie beside it, where their names are not absolute; those of
    /// standard input in the current folder.
    ///
    /// # Errors
    /// [`LoadError`], with everything that is wrong with the scene.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, LoadError> {
        let path = path.as_ref();
        Self::from_text(SceneText::read(path)?, folder_of(path))
    }

    /// The scene in a text; files it names lie in the current folder.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn from_toml(text: &str) -> Result<Self, LoadError> {
        let given = SceneText { name: "scene".to_owned(), text: text.to_owned() };
        Self::from_text(given, Path::new(""))
    }

    /// The scene in the text `given`: of the files it names, those among `files` need not be read, and the others lie in `folder`. With
    /// [`Self::given`], [`Self::input_files`] and [`Self::folder`] of a scene it is that scene again.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn from_parts(given: SceneText, folder: &Path, files: Vec<InputFile>) -> Result<Self, LoadError> {
        let resolved = given.resolve()?;
        let known = KEYS.into_iter().flat_map(|key| {
            files.iter().map(move |InputFile { name, bytes }| NamedFile {
                key,
                name: name.clone(),
                bytes: bytes.clone(),
            })
        });
        Self::reading(resolved, given, folder.into(), &known.collect::<Vec<_>>())
    }

    /// A built-in scene, such as `fzg-c` ([`PRESETS`](crate::PRESETS)).
    ///
    /// # Errors
    /// A name that is no preset.
    pub fn preset(name: &str) -> Result<Self, LoadError> {
        match presets::find(name) {
            Some(preset) => Self::from_toml(preset.text),
            None => {
                let given = SceneText { name: name.to_owned(), text: String::new() };
                let allowed = presets::names().join(", ");
                let problem = Problem {
                    kind: ProblemKind::NotAllowed,
                    key: "preset".to_owned(),
                    found: format!("{name:?}"),
                    allowed,
                    help: presets::nearest(name).map(|near| format!("did you mean {near}?")),
                    span: None,
                };
                Err(SceneError { given, problems: vec![problem] }.into())
            }
        }
    }

    /// Scene with `value` for `key`, such as `"pair.face_width_mm"`, as if the file said so: a file that it names then lies in
    /// the same folder. Errors name lines of the changed text.
    ///
    /// # Errors
    /// What is wrong with the scene then; a calibration that does not belong to it.
    pub fn with(&self, key: &str, value: impl Into<toml::Value>) -> Result<Self, LoadError> {
        self.changed(|draft| draft.set(key, value), &self.files.as_read)
    }

    /// Scene with all these keys changed together, so that those that need one another need no order: with a value as
    /// [`Self::with`] gives it, without one as [`Self::without`] takes it away. A key with alternatives, `pair.{pinion,wheel}.teeth`, is all of
    /// them, and a number without a fraction is whole where the key takes whole numbers.
    ///
    /// # Errors
    /// As of [`Self::with`] and [`Self::without`].
    pub fn with_all(
        &self,
        changes: impl IntoIterator<Item = (String, Option<toml::Value>)>,
    ) -> Result<Self, LoadError> {
        self.changed(|draft| draft.change_all(changes), &self.files.as_read)
    }

    /// Scene without `key`, as if the file left it out.
    ///
    /// # Errors
    /// A key that no scene has; what is wrong with the scene then.
    pub fn without(&self, key: &str) -> Result<Self, LoadError> {
        self.with_all([(key.to_owned(), None)])
    }

    /// Resolves the scene in `given` and reads the files it names from `folder`.
    pub fn from_text(given: SceneText, folder: &Path) -> Result<Self, LoadError> {
        let resolved = given.resolve()?;
        Self::of(resolved, given, folder)
    }

    /// The resolved scene of `given` with the files it names, which lie in `folder`.
    pub fn of(resolved: Resolved, given: SceneText, folder: &Path) -> Result<Self, LoadError> {
        Self::reading(resolved, given, folder.into(), &[])
    }

    /// The resolved scene of `given` with the files it names; those that are `known` need not be read.
    fn reading(
        mut resolved: Resolved,
        given: SceneText,
        folder: Arc<Path>,
        known: &[NamedFile],
    ) -> Result<Self, LoadError> {
        let mut files = NamedFiles::default();
        if let Some((calibration, file)) = calibration(&folder, known, &given, &resolved)? {
            files.calibration = Some(calibration);
            files.as_read.push(file);
        }
        if let Some((curve, file)) = stiffness_curve(&folder, known, &given, &resolved)? {
            files.stiffness_curve = Some(curve);
            files.as_read.push(file);
        }
        for gear in Gear::BOTH {
            if let Some((flank, file)) = initial_flank(&folder, known, &given, &mut resolved, gear)? {
                files.initial_flanks[gear] = Some(flank);
                files.as_read.push(file);
            }
        }
        Ok(Self { folder, ..Self::with_files(resolved, given, files)? })
    }

    /// The resolved scene of `given` with `files`; what the user should know of the calibration joins the scene's warnings.
    ///
    /// # Errors
    /// A file that it needs and that is not among them; a calibration of another pair.
    pub fn with_files(mut resolved: Resolved, given: SceneText, files: NamedFiles) -> Result<Self, SceneError> {
        let foreign = files.foreign_to(&resolved);
        let name = resolved.scene.calibration_file.as_deref().unwrap_or_default();
        let belongs =
            if foreign.is_empty() { Ok(()) } else { Err(Box::new(of_another_pair(&given.text, name, &foreign))) };
        belongs
            .and_then(|()| files.complete(&given.text, &resolved.scene))
            .map_err(|problem| given.refused(vec![*problem]))?;
        if let Some(calibration) = files.calibration.as_ref().filter(|_| !name.is_empty()) {
            let warnings = warnings(name, calibration, &resolved.scene);
            resolved.warnings.extend(warnings);
        }
        files.put_flanks_into(&mut resolved);
        let (files, given, folder) = (Arc::new(files), Arc::new(given), Path::new("").into());
        Ok(Self {
            resolved,
            files,
            given,
            folder,
            teeth_in_space: KeptInSpace::default(),
            elements: KeptElements::default(),
        })
    }

    /// The scene as it stands in the folder of its run, naming the copies of its input files there.
    pub fn naming_copies(mut self) -> Self {
        if self.files.as_read.is_empty() {
            return self;
        }
        let mut taken: Vec<String> = Vec::new();
        for file in &mut Arc::make_mut(&mut self.files).as_read {
            let base = Path::new(&file.name).file_name().and_then(OsStr::to_str).unwrap_or(file.key);
            let mut name = format!("{INPUTS}/{base}");
            if taken.contains(&name) {
                name = format!("{INPUTS}/{}-{base}", file.key);
            }
            self.resolved.rename_file(file.key, &name);
            file.name.clone_from(&name);
            taken.push(name);
        }
        self
    }

    /// Scene of other values with the files of this one.
    ///
    /// # Errors
    /// A file that the other scene needs and this one does not have.
    pub fn variant(&self, mut resolved: Resolved) -> Result<Self, Box<Problem>> {
        self.files.put_flanks_into(&mut resolved);
        self.files.complete(&self.given.text, &resolved.scene)?;
        Ok(Self { resolved, ..self.clone() })
    }

    /// Scene with this calibration, as if the file named it.
    ///
    /// # Errors
    /// A calibration of another pair.
    pub fn with_calibration(&self, calibration: Calibration) -> Result<Self, LoadError> {
        self.calibrated_with(calibration, |_, _| {})
    }

    /// Scene on a Winkler foundation with this calibration, as if the file named both, at the resolution of this one but no finer than `finest`.
    ///
    /// # Errors
    /// A calibration of another pair.
    pub fn on_calibrated_foundation(
        &self,
        calibration: Calibration,
        finest: FinestNumerics,
    ) -> Result<Self, LoadError> {
        let resolved: toml::Table = self.to_toml().parse().unwrap_or_default();
        let numerics = &self.scene().numerics;
        let positions = numerics.positions.min(finest.positions) as i64;
        let points = numerics.flank_points.min(finest.flank_points) as i64;
        self.calibrated_with(calibration, |draft, of_mesh| {
            for foundation in ["contact.foundation_MPa_per_mm".to_owned(), of_mesh("contact.foundation_MPa_per_mm")] {
                draft.remove(&foundation);
            }
            draft.set(&of_mesh("contact.surface"), SurfaceKind::Winkler.name());
            // Defaults of the resolution follow the surface.
            if let Some(numerics) = resolved.get("numerics") {
                draft.set(&of_mesh("numerics"), numerics.clone());
            }
            draft.set(&of_mesh("numerics.positions"), positions);
            draft.set(&of_mesh("numerics.flank_points"), points);
            if let Stepping::Adaptive { tolerance_mm } = numerics.stepping
                && 1e3 * tolerance_mm < finest.tolerance_um
            {
                draft.set(&of_mesh("numerics.tolerance_um"), finest.tolerance_um);
            }
        })
    }

    /// Scene with this calibration and a further change, which gets the key of what holds for this pair alone.
    fn calibrated_with(
        &self,
        calibration: Calibration,
        change: impl FnOnce(&mut Draft, &dyn Fn(&str) -> String),
    ) -> Result<Self, LoadError> {
        let (key, name) = (CALIBRATION, "calibration.json".to_owned());
        let mut known = self.files.as_read.clone();
        known.retain(|file| file.key != key);
        known.push(NamedFile { key, name: name.clone(), bytes: calibration.to_json().into_bytes() });
        let changed = |draft: &mut Draft| {
            // Of a mesh of a planetary stage its own table lies above that of both.
            let table = StageMesh::BOTH.into_iter().find(|mesh| draft.word("planetary.mesh") == Some(mesh.folder()));
            let of_mesh = |key: &str| table.map_or_else(|| key.to_owned(), |mesh| format!("{}.{key}", mesh.table()));
            draft.set(&of_mesh(key), name);
            change(draft, &of_mesh);
        };
        self.changed(changed, &known)
    }

    fn changed(&self, change: impl FnOnce(&mut Draft), known: &[NamedFile]) -> Result<Self, LoadError> {
        let mut draft = Draft::parse(&self.given.text).map_err(|problems| self.given.refused(problems))?;
        change(&mut draft);
        let name = format!("{}{CHANGED}", self.given.name.trim_end_matches(CHANGED));
        let given = SceneText { name, text: draft.to_toml() };
        let changed = Self::reading(given.resolve()?, given, Arc::clone(&self.folder), known)?;
        Ok(Self { teeth_in_space: self.teeth_in_space.clone(), elements: self.elements.clone(), ..changed })
    }

    /// Scene with a calibration made for it, whether it asks for one or not.
    pub fn calibrated(&self, calibration: Calibration) -> Self {
        let files = NamedFiles { calibration: Some(calibration), ..(*self.files).clone() };
        Self { files: Arc::new(files), ..self.clone() }
    }

    /// The text it was made from.
    pub fn given(&self) -> &SceneText {
        &self.given
    }

    /// The folder that files lie in which it may be made to name.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The files it names, as they were read.
    pub fn input_files(&self) -> Vec<InputFile> {
        let files = self.files.as_read.iter();
        files.map(|file| InputFile { name: file.name.clone(), bytes: file.bytes.clone() }).collect()
    }

    /// Scene in the terms of physics.
    pub fn scene(&self) -> &Scene {
        &self.resolved.scene
    }

    /// Warnings: likely slips of unit, settings that are not used.
    pub fn warnings(&self) -> &[String] {
        &self.resolved.warnings
    }

    /// The scene as a file, every default filled in.
    pub fn to_toml(&self) -> String {
        self.resolved.to_toml()
    }
}
