//! A planetary stage whose values are changed and which is resolved again for each of many runs: the scene of each mesh, and the stage that they make.

use super::VariedPair;
use crate::scene::Problem;
use crate::scene::draft::Draft;
use crate::scene::key::linked_keys;
use crate::scene::loaded::LoadedScene;
use crate::scene::planetary::PlanetaryScene;
use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use crate::scene::planetary::words;
use gearwear_physics::assessment::{Done, RunError};
use gearwear_physics::observer::Observer;

#[derive(Debug, Clone)]
pub struct VariedStage {
    /// The file of the stage.
    draft: Draft,
    given: PlanetaryScene,
    pub(super) meshes: PerMesh<VariedPair>,
}

impl VariedStage {
    /// Stage of runs of which only the end is kept, from `given` without snapshots.
    pub fn new(given: &PlanetaryScene, error_estimate: bool) -> Result<Self, Vec<Problem>> {
        Ok(Self {
            draft: Draft::parse(&given.given.text)?,
            meshes: PerMesh::try_from_fn(|mesh| VariedPair::new(&given.meshes[mesh], error_estimate))?,
            given: given.clone(),
        })
    }

    pub(super) fn with_each(self, change: impl Fn(VariedPair) -> VariedPair) -> Self {
        Self { meshes: self.meshes.map(change), ..self }
    }

    /// The text of the file, as given.
    pub fn given_text(&self) -> &str {
        &self.given.given.text
    }

    /// Stage with these values, not verified; a key with alternatives sets all of them.
    pub fn resolved<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a str, toml::Value)>,
    ) -> Result<PlanetaryScene, Vec<Problem>> {
        let values: Vec<(&str, toml::Value)> = values.into_iter().collect();
        let meshes = PerMesh::try_from_fn(|mesh| {
            let pair = &self.meshes[mesh];
            pair.variant(pair.resolved(values.iter().cloned())?).map_err(|problem| vec![*problem])
        })?;
        let mut draft = self.draft.clone();
        for (keys, value) in values {
            linked_keys(keys).iter().for_each(|key| draft.set(key, value.clone()));
        }
        self.given.varied(&draft, meshes)
    }
}

/// Runs both meshes of `stage` with `run`; the second is not begun where the first was interrupted.
pub(super) fn carried_out<R>(
    stage: &PlanetaryScene,
    observer: &dyn Observer,
    run: impl Fn(Option<StageMesh>, &LoadedScene, &dyn Observer) -> Result<Done<R>, RunError>,
) -> Result<PerMesh<R>, String> {
    PerMesh::try_from_fn(|mesh| {
        if mesh == StageMesh::PlanetRing && observer.interrupted() {
            return Err("interrupted".to_owned());
        }
        let run = |scene: &LoadedScene, observer: &dyn Observer| run(Some(mesh), scene, observer);
        super::pair::carried_out(&stage.meshes[mesh], observer, run)
            .map_err(|error| format!("{}: {}", mesh.in_words(), words::of_stage(&error, mesh)))
    })
}
