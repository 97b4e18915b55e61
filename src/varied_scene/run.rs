//! A run as a study of many keeps it: that of a pair, or those of both meshes of a stage with what follows for the stage.

use serde::Serialize;

use crate::planetary_run;
use crate::planetary_run::record::PlanetarySummary;
use crate::scene::opened::{EachMesh, OpenedScene};
use crate::scene::planetary::PlanetaryScene;
use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use gearwear_physics::plan::StageKind;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::run::{StopReason, Summary};
use gearwear_physics::results::worn_pair::WornPair;

/// A finished run of a scene of either kind.
#[derive(Debug, Clone, PartialEq)]
pub enum StudiedRun {
    Pair(Box<WornPair>),
    Stage(Box<StudiedStage>),
}

/// A finished run of a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct StudiedStage {
    meshes: PerMesh<WornPair>,
    summary: PlanetarySummary,
    /// Turns of each mesh's pinion on the carrier in one revolution of the given member.
    turns: PerMesh<f64>,
}

impl StudiedStage {
    fn of(stage: &PlanetaryScene, meshes: PerMesh<WornPair>) -> Self {
        Self {
            summary: planetary_run::summary(stage, meshes.as_ref()),
            turns: planetary_run::revolutions_per_turn(stage),
            meshes,
        }
    }
}

/// `summary.json` of a run of either kind.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(untagged)]
pub enum SceneSummary<'a> {
    Pair(&'a Summary),
    Stage(&'a PlanetarySummary),
}

impl StudiedRun {
    /// The run of `scene` whose pairs are these; none where they are of another kind.
    pub fn of(scene: &OpenedScene, pairs: EachMesh<WornPair>) -> Option<Self> {
        match (scene, pairs) {
            (OpenedScene::Pair(_), EachMesh::Pair(pair)) => Some(Self::Pair(Box::new(pair))),
            (OpenedScene::Planetary(stage), EachMesh::Stage(meshes)) => {
                Some(Self::Stage(Box::new(StudiedStage::of(stage, meshes))))
            }
            (OpenedScene::Pair(_), EachMesh::Stage(_)) | (OpenedScene::Planetary(_), EachMesh::Pair(_)) => None,
        }
    }

    /// Run of the pair, or of each mesh.
    pub fn pairs(&self) -> EachMesh<&WornPair> {
        match self {
            Self::Pair(pair) => EachMesh::Pair(pair),
            Self::Stage(stage) => EachMesh::Stage(stage.meshes.as_ref()),
        }
    }

    pub fn summary(&self) -> SceneSummary<'_> {
        match self {
            Self::Pair(pair) => SceneSummary::Pair(&pair.summary),
            Self::Stage(stage) => SceneSummary::Stage(&stage.summary),
        }
    }

    /// Turns of the pinion of a mesh in one revolution that the scene counts in.
    pub fn turns(&self, mesh: Option<StageMesh>) -> f64 {
        match (self, mesh) {
            (Self::Stage(stage), Some(mesh)) => stage.turns[mesh],
            (Self::Stage(_), None) | (Self::Pair(_), _) => 1.0,
        }
    }

    /// Errors that the run of each pair states.
    pub fn total_errors(&self) -> EachMesh<TotalError> {
        self.pairs().map(|pair| pair.summary.error.total.clone())
    }

    /// Wall time of the wear alone, s.
    pub fn simulation_s(&self) -> Option<f64> {
        let name = StageKind::Simulation.name();
        let of =
            |pair: &WornPair| pair.summary.stages.iter().find(|stage| stage.name == name).map(|stage| stage.wall_s);
        self.pairs().all().into_iter().map(|pair| of(pair)).sum()
    }
}

impl SceneSummary<'_> {
    pub fn stopped(self) -> StopReason {
        match self {
            Self::Pair(summary) => summary.stopped,
            Self::Stage(summary) => summary.stopped,
        }
    }

    pub fn hours(self) -> Option<f64> {
        match self {
            Self::Pair(summary) => summary.hours,
            Self::Stage(summary) => summary.hours,
        }
    }

    pub fn warnings(self) -> usize {
        match self {
            Self::Pair(summary) => summary.warnings.len(),
            Self::Stage(summary) => summary.warnings.len(),
        }
    }
}
