//! Runs of a loaded scene: what its record says of the file, and the assessment that is carried out on it.

use crate::scene::file::ReportFile;
use crate::scene::{Resolved, loaded::LoadedScene, short_hash};
use gearwear_bodies::gear::Gear;
use gearwear_physics::assessment::calibrate::{self, CalibrateError, Calibrated, CalibrationExtent};
use gearwear_physics::assessment::fem_scene::{self, FemPairError, FemPairRequest};
use gearwear_physics::assessment::{self, Done, Resumption, RunError, RunInputs};
use gearwear_physics::observer::Observer;
use gearwear_physics::plan::Plan;
use gearwear_physics::results::fem_pair::FemPairRecord;
use gearwear_physics::results::provenance::Provenance;
use gearwear_physics::results::reported_by::ReportedBy;
use gearwear_physics::results::run::Summary;
use gearwear_physics::results::worn_pair::WornPair;

impl LoadedScene {
    /// The scene without the transmission error over torque, for runs of which nobody reads it.
    pub fn without_torque_curve(mut self) -> Self {
        self.resolved.scene.operation.torque_curve_n_mm.clear();
        self
    }

    /// The stages a run of it has, those left out, and why.
    pub fn plan(&self) -> Plan {
        Plan::of(self.scene())
    }

    /// Whether the springs of a run can be made, where that is known without finite elements of its own.
    ///
    /// # Errors
    /// The same as the run's.
    pub fn check_springs(&self) -> Result<(), RunError> {
        self.inputs(&Provenance::default()).check_springs()
    }

    /// Inputs of a run whose record quotes `provenance`.
    pub fn inputs<'a>(&'a self, provenance: &'a Provenance) -> RunInputs<'a> {
        RunInputs {
            scene: &self.resolved.scene,
            calibration: self.files.calibration.as_ref(),
            stiffness_curve: self.files.stiffness_curve.as_ref(),
            teeth_in_space: &self.teeth_in_space,
            elements: &self.elements,
            provenance,
        }
    }
}

/// Origin of the records of a scene, without copies of the files that it names.
fn provenance(resolved: &Resolved) -> Provenance {
    let report = resolved.file.report.clone();
    let report = report.map(|ReportFile { author, company, date }| ReportedBy { author, company, date });
    let scene_toml = resolved.to_toml();
    Provenance {
        title: resolved.title().to_owned(),
        report,
        scene_hash: short_hash(scene_toml.as_bytes()),
        scene_toml,
        inputs: Vec::new(),
        warnings: resolved.warnings.clone(),
    }
}

/// Runs `scene` as its plan says, the report apart: that is left to the caller, who knows where it goes.
///
/// A run that is interrupted or does not converge gives the record of what it had finished, and its failure in the latter
/// case.
///
/// # Errors
/// [`RunError`] where nothing was finished.
pub fn run(scene: &LoadedScene, observer: &dyn Observer) -> Result<Done, RunError> {
    scene.check_springs()?;
    run_from(&scene.clone().naming_copies(), Resumption::none(), observer)
}

/// Runs `scene`, which names the copies of its files, from its beginning or from a checkpoint.
///
/// # Errors
/// As [`run`].
pub fn run_from(scene: &LoadedScene, resumption: Resumption<'_>, observer: &dyn Observer) -> Result<Done, RunError> {
    let provenance = Provenance { inputs: scene.input_files(), ..provenance(&scene.resolved) };
    assessment::run(scene.inputs(&provenance), resumption, observer)
}

/// Main figures of a run of `scene`.
///
/// # Errors
/// As [`run`].
pub fn summarise(scene: &LoadedScene, observer: &dyn Observer) -> Result<Done<Summary>, RunError> {
    assessment::summarise(scene.inputs(&provenance(&scene.resolved)), observer)
}

/// Main figures, history and worn profiles of a run of `scene`.
///
/// # Errors
/// As [`run`].
pub fn worn_pair(scene: &LoadedScene, observer: &dyn Observer) -> Result<Done<WornPair>, RunError> {
    assessment::worn_pair(scene.inputs(&provenance(&scene.resolved)), observer)
}

/// Main figures, history and worn profiles of a run of `scene` at each of `revolutions`, which are snapshots of it.
///
/// # Errors
/// As [`run`].
pub fn worn_pairs(
    scene: &LoadedScene,
    revolutions: &[f64],
    observer: &dyn Observer,
) -> Result<Done<Vec<WornPair>>, RunError> {
    assessment::worn_pairs(scene.inputs(&provenance(&scene.resolved)), revolutions, observer)
}

/// Solves the contact of the scene's pair with plane finite elements.
///
/// # Errors
/// [`FemPairError`] where no position was solved.
pub fn fem_pair(
    resolved: &Resolved,
    request: FemPairRequest,
    observer: &dyn Observer,
) -> Result<Done<FemPairRecord, FemPairError>, FemPairError> {
    let mut provenance = provenance(resolved);
    let gears = &resolved.file.pair;
    let has_measured = |gear: &Gear| gears.gear(*gear).is_some_and(|gear| gear.initial_flank.is_some());
    if Gear::BOTH.iter().any(has_measured) {
        let unused = "initial_flank: the flanks of these finite elements are those of the design; gearwear run has the measured ones";
        provenance.warnings.push(unused.to_owned());
    }
    fem_scene::run(&resolved.scene, &provenance, request, observer)
}

/// Calibrates the pair of `scene` with finite elements.
///
/// # Errors
/// [`CalibrateError`]
pub fn calibrate(
    scene: &LoadedScene,
    extent: CalibrationExtent,
    observer: &dyn Observer,
) -> Result<Calibrated, CalibrateError> {
    calibrate::run(scene.scene(), extent, &scene.teeth_in_space, observer)
}
