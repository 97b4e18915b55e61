//! A scene of either kind, of a gear pair or of a planetary stage, as a study of many runs takes it: one scene of a pair, or one of each mesh.

use std::path::Path;

use serde::{Deserialize, Serialize};
use toml::Table;

use super::loaded::LoadedScene;
use super::planetary::PlanetaryScene;
use super::planetary::mesh::{PerMesh, StageMesh};
use super::scene_text::folder_of;
use super::{LoadError, Problem, SceneError, SceneText, short_hash};

/// Kind of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneKind {
    #[default]
    Pair,
    Stage,
}

impl SceneKind {
    pub fn is_pair(&self) -> bool {
        *self == Self::Pair
    }

    /// Meshes of such a scene; none of a pair, which is one itself.
    pub fn meshes(self) -> Vec<Option<StageMesh>> {
        match self {
            Self::Pair => vec![None],
            Self::Stage => StageMesh::BOTH.map(Some).into(),
        }
    }
}

/// One of each mesh of a stage, or the one of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum EachMesh<T> {
    Stage(PerMesh<T>),
    Pair(T),
}

impl<T> EachMesh<T> {
    /// Each changed by `change`.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> EachMesh<U> {
        match self {
            Self::Pair(one) => EachMesh::Pair(change(one)),
            Self::Stage(both) => EachMesh::Stage(both.map(change)),
        }
    }

    /// Made for each mesh of a kind of scene; none where one is none.
    pub fn for_each(kind: SceneKind, mut make: impl FnMut(Option<StageMesh>) -> Option<T>) -> Option<Self> {
        Some(match kind {
            SceneKind::Pair => Self::Pair(make(None)?),
            SceneKind::Stage => {
                let both = PerMesh::try_from_fn(|mesh| make(Some(mesh)).ok_or(()));
                Self::Stage(both.ok()?)
            }
        })
    }

    pub fn as_ref(&self) -> EachMesh<&T> {
        match self {
            Self::Pair(one) => EachMesh::Pair(one),
            Self::Stage(both) => EachMesh::Stage(both.as_ref()),
        }
    }

    pub fn kind(&self) -> SceneKind {
        match self {
            Self::Pair(_) => SceneKind::Pair,
            Self::Stage(_) => SceneKind::Stage,
        }
    }

    /// All, in their order.
    pub fn all(&self) -> Vec<&T> {
        match self {
            Self::Pair(one) => vec![one],
            Self::Stage(both) => both.both().into(),
        }
    }

    /// That of a mesh, of a stage; of a pair where no mesh is named.
    pub fn of(&self, mesh: Option<StageMesh>) -> Option<&T> {
        match (self, mesh) {
            (Self::Pair(one), None) => Some(one),
            (Self::Stage(both), Some(mesh)) => Some(&both[mesh]),
            (Self::Pair(_), Some(_)) | (Self::Stage(_), None) => None,
        }
    }
}

impl<T> EachMesh<T> {
    /// The same to be changed.
    pub fn of_mut(&mut self, mesh: Option<StageMesh>) -> Option<&mut T> {
        match (self, mesh) {
            (Self::Pair(one), None) => Some(one),
            (Self::Stage(both), Some(mesh)) => Some(&mut both[mesh]),
            (Self::Pair(_), Some(_)) | (Self::Stage(_), None) => None,
        }
    }
}

impl<T: Clone> EachMesh<T> {
    /// The same for each mesh.
    pub fn alike(kind: SceneKind, one: T) -> Self {
        match kind {
            SceneKind::Pair => Self::Pair(one),
            SceneKind::Stage => Self::Stage(PerMesh { sun_planet: one.clone(), planet_ring: one }),
        }
    }
}

/// A scene of either kind.
#[derive(Debug, Clone, PartialEq)]
pub enum OpenedScene {
    /// A gear pair.
    Pair(Box<LoadedScene>),
    /// A planetary stage.
    Planetary(Box<PlanetaryScene>),
}

impl From<LoadedScene> for OpenedScene {
    fn from(scene: LoadedScene) -> Self {
        Self::Pair(Box::new(scene))
    }
}

impl From<&LoadedScene> for OpenedScene {
    fn from(scene: &LoadedScene) -> Self {
        scene.clone().into()
    }
}

impl From<&OpenedScene> for OpenedScene {
    fn from(scene: &OpenedScene) -> Self {
        scene.clone()
    }
}

impl OpenedScene {
    /// Opens the file at `path` (`-`: standard input): of a gear pair, or of a planetary stage, `[planetary]`, that does not name one of its meshes.
    ///
    /// # Errors
    /// [`LoadError`], with everything that is wrong.
    pub fn open(path: &Path) -> Result<Self, LoadError> {
        Self::from_text(SceneText::read(path)?, folder_of(path))
    }

    /// The scene in a text; files it names lie in `folder`.
    ///
    /// # Errors
    /// [`LoadError`], with everything that is wrong.
    pub fn from_text(given: SceneText, folder: &Path) -> Result<Self, LoadError> {
        let stage = given.text.parse::<Table>().ok().and_then(|mut table| table.remove("planetary"));
        Ok(match stage.is_some_and(|stage| stage.get("mesh").is_none()) {
            true => Self::Planetary(Box::new(PlanetaryScene::from_text(given, folder)?)),
            false => Self::Pair(Box::new(LoadedScene::from_text(given, folder)?)),
        })
    }

    pub fn kind(&self) -> SceneKind {
        match self {
            Self::Pair(_) => SceneKind::Pair,
            Self::Planetary(_) => SceneKind::Stage,
        }
    }

    /// The text it was made from.
    pub fn given(&self) -> &SceneText {
        match self {
            Self::Pair(scene) => &scene.given,
            Self::Planetary(stage) => &stage.given,
        }
    }

    /// The error of these problems.
    pub fn refused(&self, problems: Vec<Problem>) -> SceneError {
        self.given().refused(problems)
    }

    /// Scene of the pair, or of each mesh.
    pub fn each(&self) -> EachMesh<&LoadedScene> {
        match self {
            Self::Pair(scene) => EachMesh::Pair(scene),
            Self::Planetary(stage) => EachMesh::Stage(stage.meshes.as_ref()),
        }
    }

    /// Changes the scene of the pair, or of each mesh.
    pub fn change_each(&mut self, mut change: impl FnMut(&mut LoadedScene)) {
        match self {
            Self::Pair(scene) => change(scene),
            Self::Planetary(stage) => StageMesh::BOTH.into_iter().for_each(|mesh| change(&mut stage.meshes[mesh])),
        }
    }

    pub fn title(&self) -> &str {
        match self {
            Self::Pair(scene) => scene.resolved.title(),
            Self::Planetary(stage) => &stage.title,
        }
    }

    pub fn warnings(&self) -> &[String] {
        match self {
            Self::Pair(scene) => scene.warnings(),
            Self::Planetary(stage) => &stage.warnings,
        }
    }

    /// First 16 hexadecimal digits of the SHA-256 of the resolved scene, of a stage of those of both meshes.
    pub fn scene_hash(&self) -> String {
        joined(&self.each().map(|scene| scene.resolved.scene_hash()))
    }

    /// Hash of the calibration, the curve and the measured flanks that it names; empty where it names none.
    pub fn inputs_hash(&self) -> String {
        joined(&self.each().map(|scene| scene.files.hash()))
    }

    /// Whether the run, or that of a mesh, is verified.
    pub fn verifies(&self) -> bool {
        self.each().all().iter().any(|scene| scene.scene().verify)
    }
}

/// One hash of each; empty where all are.
fn joined(hashes: &EachMesh<String>) -> String {
    match hashes {
        EachMesh::Pair(hash) => hash.clone(),
        EachMesh::Stage(both) if both.both().iter().all(|hash| hash.is_empty()) => String::new(),
        EachMesh::Stage(both) => short_hash(both.both().map(String::as_str).join(" ").as_bytes()),
    }
}
