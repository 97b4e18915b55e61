//! A scene with every file it names: what a run is made from.
//!
//! A scene may name a calibration (`contact.calibration`) and a curve of tooth stiffness (`stiffness.curve`). A [`LoadedScene`] cannot lack
//! one: it comes into being where they are read, or is a variant of one that has them.

use std::ffi::OsStr;
use std::fmt;
use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use super::draft::Draft;
use super::key::is_key;
use super::{Problem, ProblemKind, Resolved, presets};
use crate::calibration::{Calibration, identity::CalibrationIdentity};
use crate::contact::settings::{Foundation, MatchCriterion, SurfaceKind};
use crate::gear::GearPair;
use crate::mesh_cycle::{pair_in_space::KeptInSpace, settings::Coupling};
use crate::operation::Scene;
use crate::results::run::InputFile;
use crate::stiffness::curve::PairCompliance;
use crate::stiffness::curve_file::{self, CurveFileError};
use crate::stiffness::settings::StiffnessSettings;

/// The key that names a calibration.
pub(crate) const CALIBRATION: &str = "contact.calibration";
/// The key that names a curve of tooth stiffness.
pub(crate) const CURVE: &str = "stiffness.curve";
/// The folder of a run's input files within its own.
const INPUTS: &str = "inputs";
/// What the name of a changed text ends in.
const CHANGED: &str = " as changed";
/// Part of a load that counts as within a range.
const ROUNDING: f64 = 1e-9;

/// The text of a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneText {
    /// Name of the file, as messages give it.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// What is wrong with a scene file, with the text it stands in.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error("{}", self.in_words())]
pub struct SceneError {
    /// The file.
    pub given: SceneText,
    /// At least one.
    pub problems: Vec<Problem>,
}

/// As its display: a program that returns it from `main` shows the problems, not the whole file.
impl fmt::Debug for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words())
    }
}

impl SceneError {
    /// The line of the text, from 1, where `problem` begins.
    pub fn line_of(&self, problem: &Problem) -> usize {
        let text = self.given.text.as_bytes();
        let begin = problem.span.as_ref().map_or(0, |span| span.start).min(text.len());
        text[..begin].iter().filter(|&&byte| byte == b'\n').count() + 1
    }

    fn in_words(&self) -> String {
        let name = &self.given.name;
        let help = |problem: &Problem| problem.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
        let of = |problem: &Problem| format!("{name}, line {}: {problem}{}", self.line_of(problem), help(problem));
        self.problems.iter().map(of).collect::<Vec<_>>().join("\n")
    }
}

/// Why a scene could not be opened.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error("{name} cannot be read: {reason}")]
    Unreadable {
        /// Name of the file.
        name: String,
        /// The system's reason.
        reason: io::Error,
    },
    /// The file is no text.
    #[error("{name} is not UTF-8 text: byte {byte}, line {line}")]
    NotUtf8 {
        /// Name of the file.
        name: String,
        /// Offset of the first byte that is no text.
        byte: usize,
        /// Its line.
        line: usize,
    },
    /// The scene is wrong, or names a file that is not what it should be.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The curve of tooth stiffness that the scene names cannot be read as one.
    #[error("{name}: {error}")]
    Curve {
        /// Name of the file.
        name: String,
        /// What is wrong with it.
        error: CurveFileError,
    },
}

/// A file that a scene names.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedFile {
    /// The key that names it, such as `contact.calibration`.
    pub key: &'static str,
    /// Its name, as the scene gives it.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// The files a scene names, read.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct NamedFiles {
    /// `contact.calibration`.
    pub calibration: Option<Calibration>,
    /// `stiffness.curve`.
    pub stiffness_curve: Option<PairCompliance>,
    /// The same as they were read.
    pub as_read: Vec<NamedFile>,
}

/// A scene, checked and with every default filled in, and every file it names.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedScene {
    pub(crate) resolved: Resolved,
    pub(crate) files: Arc<NamedFiles>,
    pub(crate) given: Arc<SceneText>,
    /// Where files lie that are not read yet.
    pub(crate) folder: Arc<Path>,
    /// Teeth in space that a run of it, or of a scene it was made of, has condensed.
    pub(crate) teeth_in_space: KeptInSpace,
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
        let known = [CALIBRATION, CURVE].into_iter().flat_map(|key| {
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

    /// The same scene with `value` for `key`, such as `"pair.face_width_mm"`, as if the file said so: a file that it names then lies in
    /// the same folder. Errors name lines of the changed text.
    ///
    /// # Errors
    /// What is wrong with the scene then; a calibration that does not belong to it.
    pub fn with(&self, key: &str, value: impl Into<toml::Value>) -> Result<Self, LoadError> {
        self.changed(|draft| draft.set(key, value), &self.files.as_read)
    }

    /// The same scene with all these keys changed together, so that those that need one another need no order: with a value as
    /// [`Self::with`] gives it, without one as [`Self::without`] takes it away.
    ///
    /// # Errors
    /// As theirs.
    pub fn with_all(
        &self,
        changes: impl IntoIterator<Item = (String, Option<toml::Value>)>,
    ) -> Result<Self, LoadError> {
        let change = |draft: &mut Draft| {
            for (key, value) in changes {
                match value {
                    Some(value) => draft.set(&key, value),
                    None if is_key(&key) => draft.remove(&key),
                    // As a key that is given, it is refused with what was probably meant.
                    None => draft.set(&key, true),
                }
            }
        };
        self.changed(change, &self.files.as_read)
    }

    /// The same scene without `key`, as if the file left it out.
    ///
    /// # Errors
    /// A key that no scene has; what is wrong with the scene then.
    pub fn without(&self, key: &str) -> Result<Self, LoadError> {
        self.with_all([(key.to_owned(), None)])
    }

    /// Resolves the scene in `given` and reads the files it names from `folder`.
    pub(crate) fn from_text(given: SceneText, folder: &Path) -> Result<Self, LoadError> {
        let resolved = given.resolve()?;
        Self::of(resolved, given, folder)
    }

    /// The resolved scene of `given` with the files it names, which lie in `folder`.
    pub(crate) fn of(resolved: Resolved, given: SceneText, folder: &Path) -> Result<Self, LoadError> {
        Self::reading(resolved, given, folder.into(), &[])
    }

    /// The same where files that are `known` need not be read.
    fn reading(
        resolved: Resolved,
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
        Ok(Self { folder, ..Self::with_files(resolved, given, files)? })
    }

    /// The resolved scene of `given` with `files`; what the user should know of the calibration joins the scene's warnings.
    ///
    /// # Errors
    /// A file that it needs and that is not among them; a calibration of another pair.
    pub(crate) fn with_files(mut resolved: Resolved, given: SceneText, files: NamedFiles) -> Result<Self, SceneError> {
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
        let (files, given, folder) = (Arc::new(files), Arc::new(given), Path::new("").into());
        Ok(Self { resolved, files, given, folder, teeth_in_space: KeptInSpace::default() })
    }

    /// The scene as it stands in the folder of its run, naming the copies of its input files there.
    pub(crate) fn naming_copies(mut self) -> Self {
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

    /// Another scene with the files of this one.
    ///
    /// # Errors
    /// A file that the other scene needs and this one does not have.
    pub(crate) fn variant(&self, resolved: Resolved) -> Result<Self, Box<Problem>> {
        self.files.complete(&self.given.text, &resolved.scene)?;
        Ok(Self { resolved, ..self.clone() })
    }

    /// The same scene with this calibration, as if the file named it.
    ///
    /// # Errors
    /// A calibration of another pair.
    pub fn with_calibration(&self, calibration: Calibration) -> Result<Self, LoadError> {
        let (key, name) = (CALIBRATION, "calibration.json".to_owned());
        let mut known = self.files.as_read.clone();
        known.retain(|file| file.key != key);
        known.push(NamedFile { key, name: name.clone(), bytes: calibration.to_json().into_bytes() });
        self.changed(|draft| draft.set(key, name), &known)
    }

    fn changed(&self, change: impl FnOnce(&mut Draft), known: &[NamedFile]) -> Result<Self, LoadError> {
        let mut draft = Draft::parse(&self.given.text).map_err(|problems| self.given.refused(problems))?;
        change(&mut draft);
        let name = format!("{}{CHANGED}", self.given.name.trim_end_matches(CHANGED));
        let given = SceneText { name, text: draft.to_toml() };
        let changed = Self::reading(given.resolve()?, given, Arc::clone(&self.folder), known)?;
        Ok(Self { teeth_in_space: self.teeth_in_space.clone(), ..changed })
    }

    /// The same with a calibration made for it, whether it asks for one or not.
    pub(crate) fn calibrated(&self, calibration: Calibration) -> Self {
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
        let of = |file: &NamedFile| InputFile { name: file.name.clone(), bytes: file.bytes.clone() };
        self.files.as_read.iter().map(of).collect()
    }

    /// What it asks for.
    pub(crate) fn scene(&self) -> &Scene {
        &self.resolved.scene
    }

    /// What the user should know about it: likely slips of unit, settings that are not used.
    pub fn warnings(&self) -> &[String] {
        &self.resolved.warnings
    }

    /// The scene as a file, every default filled in.
    pub fn to_toml(&self) -> String {
        self.resolved.to_toml()
    }
}

impl SceneText {
    /// Reads the text at `path` (`-`: standard input).
    pub(crate) fn read(path: &Path) -> Result<Self, LoadError> {
        let (name, bytes) = if path == Path::new("-") {
            let mut bytes = Vec::new();
            ("standard input".to_owned(), io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes))
        } else {
            (path.display().to_string(), fs::read(path))
        };
        let bytes = bytes.map_err(|reason| LoadError::Unreadable { name: name.clone(), reason })?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let byte = error.utf8_error().valid_up_to();
            let line = error.as_bytes()[..byte].iter().filter(|&&b| b == b'\n').count() + 1;
            LoadError::NotUtf8 { name: name.clone(), byte, line }
        })?;
        Ok(Self { name, text })
    }

    /// Resolves the scene it holds; the files it names stay unread.
    pub(crate) fn resolve(&self) -> Result<Resolved, SceneError> {
        Resolved::from_toml(&self.text).map_err(|problems| self.refused(problems))
    }

    /// What is wrong with it.
    pub(crate) fn refused(&self, problems: Vec<Problem>) -> SceneError {
        SceneError { given: self.clone(), problems }
    }
}

impl NamedFiles {
    /// In what the pair of the calibration differs from that of `resolved`; empty where there is none, or none differs.
    pub(crate) fn foreign_to(&self, resolved: &Resolved) -> Vec<String> {
        self.calibration.as_ref().map_or_else(Vec::new, |calibration| foreign(calibration, resolved))
    }

    /// Whether they are all that `scene`, of the file with this text, needs.
    fn complete(&self, text: &str, scene: &Scene) -> Result<(), Box<Problem>> {
        if let (SurfaceKind::Winkler, Foundation::Calibrated(criterion)) =
            (scene.contact.surface, scene.contact.foundation)
        {
            let has = |criterion| self.calibration.as_ref().is_some_and(|c| c.foundation.contains_key(criterion));
            if let Some(lacking) = [&criterion, &MatchCriterion::Approach].into_iter().find(|one| !has(one)) {
                let found = match self.calibration {
                    None => "no file".to_owned(),
                    Some(_) => format!("one without K/H for the {}", lacking.name()),
                };
                return Err(
                    Problem::of_named_file(text, CALIBRATION, found, CALIBRATION_ALLOWED, MAKE_CALIBRATION).into()
                );
            }
        }
        if let StiffnessSettings::Simon | StiffnessSettings::WangCheng = scene.stiffness
            && self.stiffness_curve.is_none()
        {
            return Err(Problem::of_named_file(text, CURVE, "no file".to_owned(), CURVE_ALLOWED, CURVE_HELP).into());
        }
        Ok(())
    }
}

/// The folder that files named in the scene at `path` lie in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    if path == Path::new("-") { Path::new("") } else { path.parent().unwrap_or(Path::new("")) }
}

const CALIBRATION_ALLOWED: &str = "a file that gearwear calibrate wrote for this pair";
const MAKE_CALIBRATION: &str = "gearwear calibrate SCENE --out FILE makes one";
const CURVE_ALLOWED: &str = "a data file (CSV) of the stiffness along the path of contact";
const CURVE_HELP: &str = "the file lies beside the scene; gearwear schema says what stands in it";

/// The text of the file `name` that `key` names: one that is `known`, or as it lies in `folder`. An error says what is wrong with it.
fn text_of(folder: &Path, known: &[NamedFile], key: &str, name: &str) -> Result<String, String> {
    let bytes = match known.iter().find(|file| file.key == key && file.name == name) {
        Some(file) => file.bytes.clone(),
        None => fs::read(folder.join(name)).map_err(|reason| format!("which cannot be read: {reason}"))?,
    };
    String::from_utf8(bytes)
        .map_err(|error| format!("which is not UTF-8 text: byte {}", error.utf8_error().valid_up_to()))
}

/// The calibration that the scene names, and its file.
fn calibration(
    folder: &Path,
    known: &[NamedFile],
    given: &SceneText,
    resolved: &Resolved,
) -> Result<Option<(Calibration, NamedFile)>, LoadError> {
    let Some(name) = resolved.scene.calibration_file.clone() else { return Ok(None) };
    let refused = |what: String, help: &str| {
        let found = format!("{name:?}, {what}");
        given.refused(vec![Problem::of_named_file(&given.text, CALIBRATION, found, CALIBRATION_ALLOWED, help)])
    };
    let text = text_of(folder, known, CALIBRATION, &name).map_err(|what| refused(what, MAKE_CALIBRATION))?;
    let calibration = Calibration::from_json(&text)
        .map_err(|error| refused(format!("which is no calibration: {error}"), "calibrate anew"))?;
    Ok(Some((calibration, NamedFile { key: CALIBRATION, name, bytes: text.into_bytes() })))
}

fn of_another_pair(text: &str, name: &str, differences: &[String]) -> Problem {
    let found = format!("{name:?}, which belongs to another pair: {}", differences.join("; "));
    let help = "calibrate this scene, or name the calibration that belongs to it";
    Problem::of_named_file(text, CALIBRATION, found, CALIBRATION_ALLOWED, help)
}

/// In what the pair of `calibration` differs from that of the scene. Bodies of finite elements count where the scene says
/// what they are.
fn foreign(calibration: &Calibration, resolved: &Resolved) -> Vec<String> {
    match GearPair::new(&resolved.scene.pair) {
        Ok(pair) => {
            let own = CalibrationIdentity::of(&pair, &resolved.scene.material, &resolved.scene.fem);
            calibration.belongs_to.differences(&own, resolved.file.fem.is_some())
        }
        Err(error) => vec![error.to_string()],
    }
}

fn warnings(name: &str, calibration: &Calibration, scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    let version = env!("CARGO_PKG_VERSION");
    if calibration.program_version != version {
        let made = &calibration.program_version;
        warnings.push(format!("{CALIBRATION}: {name} was made by gearwear {made}, this is {version}"));
    }
    let (least, greatest) = calibration.fitted_loads_n_per_mm();
    let Ok(pair) = GearPair::new(&scene.pair) else { return warnings };
    let plates = scene.slices.is_some_and(|slices| slices.coupling != Coupling::Fem);
    if plates && scene.stiffness == StiffnessSettings::Fem && calibration.slices.is_none_or(|fit| !fit.is_of(&pair)) {
        warnings.push(format!(
            "{CALIBRATION}: {name} has no slices of this helix angle and face width: their compliance is that of plate theory, in closed form"
        ));
    }
    let loads = scene.operation.phases.iter().map(|phase| pair.line_load_n_per_mm(phase.pinion_torque_n_mm));
    let is_outside = |load: &f64| *load < least * (1.0 - ROUNDING) || *load > greatest * (1.0 + ROUNDING);
    if let Some(load) = loads.into_iter().find(is_outside) {
        warnings.push(format!(
            "{CALIBRATION}: the line load of {load:.1} N/mm lies outside the loads that {name} was fitted on, {least:.1} to \
             {greatest:.1} N/mm"
        ));
    }
    warnings
}

/// The curve of tooth stiffness that the scene names, where its stiffness model has one, and its file.
fn stiffness_curve(
    folder: &Path,
    known: &[NamedFile],
    given: &SceneText,
    resolved: &Resolved,
) -> Result<Option<(PairCompliance, NamedFile)>, LoadError> {
    let scene = &resolved.scene;
    let (StiffnessSettings::Simon | StiffnessSettings::WangCheng, Some(name)) =
        (scene.stiffness, &scene.stiffness_curve_file)
    else {
        return Ok(None);
    };
    let refused = |what: String| {
        let found = format!("{name:?}, {what}");
        given.refused(vec![Problem::of_named_file(&given.text, CURVE, found, CURVE_ALLOWED, CURVE_HELP)])
    };
    let text = text_of(folder, known, CURVE, name).map_err(refused)?;
    // The pair was checked when the scene was resolved.
    let pair = GearPair::new(&scene.pair).map_err(|error| refused(format!("but {error}")))?;
    let curve = curve_file::parse(&text, &pair.path)
        .map_err(|error| LoadError::Curve { name: folder.join(name).display().to_string(), error })?;
    Ok(Some((curve, NamedFile { key: CURVE, name: name.clone(), bytes: text.into_bytes() })))
}
