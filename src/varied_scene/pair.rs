//! The scene of a pair whose values are changed and which is resolved again for each of many runs.

use crate::scene::draft::Draft;
use crate::scene::key::linked_keys;
use crate::scene::loaded::LoadedScene;
use crate::scene::planetary::mesh::StageMesh;
use crate::scene::{Problem, Resolved};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_physics::assessment::kept_elements::KeptElements;
use gearwear_physics::assessment::{Done, RunError};
use gearwear_physics::calibration::identity::CalibrationIdentity;
use gearwear_physics::observer::Observer;
use gearwear_physics::operation::Scene;

/// Memory of finite elements that runs leave to one another, GB.
const KEPT_GB: f64 = 0.3;

#[derive(Debug, Clone)]
pub struct VariedPair {
    /// The scene without what is left out of its runs.
    draft: Draft,
    /// The scene as given, with the files it names.
    given: LoadedScene,
    /// Whether its calibration is good for pairs that differ in their modifications alone.
    with_other_modifications: bool,
    /// Whether runs find the transmission error over torque.
    torque_curve: bool,
}

impl VariedPair {
    /// Scene of runs of which only the end is kept, from `given` without snapshots.
    pub fn new(given: &LoadedScene, error_estimate: bool) -> Result<Self, Vec<Problem>> {
        let mut draft = Draft::parse(&given.given.text)?;
        draft.remove("operation.snapshots_h");
        draft.remove("operation.snapshots_revolutions");
        draft.set("numerics.error_estimate", error_estimate);
        // Of a mesh of a stage, its own tables lie above those of both.
        for mesh in StageMesh::BOTH {
            let own = format!("{}.numerics.error_estimate", mesh.table());
            if draft.gives(&own) {
                draft.set(&own, error_estimate);
            }
        }
        let given = LoadedScene { elements: KeptElements::up_to_gb(KEPT_GB), ..given.clone() };
        Ok(Self { draft, given, with_other_modifications: false, torque_curve: false })
    }

    /// The same with the transmission error over torque, if that is `asked` for.
    pub fn with_torque_curve(self, asked: bool) -> Self {
        Self { torque_curve: asked, ..self }
    }

    /// Scene whose calibration is good for pairs that differ in their modifications alone.
    pub fn with_other_modifications(self) -> Self {
        Self { with_other_modifications: true, ..self }
    }

    /// Whether the pair of `resolved` is that of the scene as given but for its modifications.
    pub fn keeps_the_teeth(&self, resolved: &Resolved) -> bool {
        let of = |scene: &Scene| CalibrationIdentity::of_unmodified(&scene.pair, &scene.material, &scene.fem);
        of(&resolved.scene).is_some_and(|own| Some(own) == of(&self.given.resolved.scene))
    }

    /// Whether the run of the scene as given is verified.
    pub fn is_verified(&self) -> bool {
        self.given.resolved.scene.verify
    }

    /// The text of the scene, as given.
    pub fn given_text(&self) -> &str {
        &self.given.given.text
    }

    /// Scene with these values, not verified; a key with alternatives sets all of them.
    pub fn resolved<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a str, toml::Value)>,
    ) -> Result<Resolved, Vec<Problem>> {
        let mut draft = self.draft.clone();
        for (key, value) in values {
            linked_keys(key).iter().for_each(|key| draft.set(key, value.clone()));
        }
        let mut resolved = draft.resolve()?;
        resolved.scene.verify = false;
        let operation = &mut resolved.scene.operation;
        operation.snapshots_revolutions = vec![operation.pinion_revolutions];
        if !self.torque_curve {
            operation.torque_curve_n_mm.clear();
        }
        Ok(resolved)
    }

    /// Whether the files that the scene names were made for the pair of `resolved`.
    pub fn inputs_belong_to(&self, resolved: &Resolved) -> Result<(), String> {
        let differences = self.given.files.foreign_to(resolved);
        let is_good = self.with_other_modifications && self.keeps_the_teeth(resolved);
        if !is_good && !differences.is_empty() {
            return Err(format!("contact.calibration belongs to another pair: {}", differences.join("; ")));
        }
        if self.given.files.stiffness_curve.is_none() {
            return Ok(());
        }
        let pair = self.given.resolved.scene.pair.on_rigid_parallel_shafts();
        let same_section =
            |own: &PairSpec| PairSpec { face_width_mm: pair.face_width_mm, ..own.on_rigid_parallel_shafts() } == pair;
        match same_section(&resolved.scene.pair) {
            true => Ok(()),
            false => Err("stiffness.curve belongs to the pair of the scene as given".to_owned()),
        }
    }

    /// Runs `resolved` with `run`; any error, a panic included, is returned as text.
    pub fn carry_out<R>(
        &self,
        resolved: Resolved,
        observer: &dyn Observer,
        run: impl FnOnce(&LoadedScene, &dyn Observer) -> Result<Done<R>, RunError>,
    ) -> Result<R, String> {
        let scene = self.variant(resolved).map_err(|problem| problem.to_string())?;
        carried_out(&scene, observer, run)
    }

    /// Scene of `resolved` with the files of the one as given.
    ///
    /// # Errors
    /// A file that it needs and the scene as given does not name.
    pub fn variant(&self, resolved: Resolved) -> Result<LoadedScene, Box<Problem>> {
        self.given.variant(resolved)
    }
}

/// Runs `scene` with `run`; what ends it early is an error, as text.
pub(super) fn carried_out<R>(
    scene: &LoadedScene,
    observer: &dyn Observer,
    run: impl FnOnce(&LoadedScene, &dyn Observer) -> Result<Done<R>, RunError>,
) -> Result<R, String> {
    match run(scene, observer) {
        Ok(Done { failure: Some(failure), .. }) => Err(failure.to_string()),
        Ok(Done { record, failure: None }) => Ok(record),
        Err(failure) => Err(failure.to_string()),
    }
}
