//! One setting, run for its result and its time.
//!
//! Each is carried out alone, so that its wall time means something; a short run is repeated and its least
//! time counts.

use std::time::Instant;

use super::observed::ObservedRun;
use super::settings::Setting;
use crate::accuracy::record::{CALIBRATION_FILE, VariantRecord};
use gearwear::runs;
use gearwear::scene::loaded::LoadedScene;
use gearwear::varied_scene::in_words;
use gearwear_bodies::gear::PerGear;
use gearwear_physics::assessment::{Done, RunError};
use gearwear_physics::observer::{Observer, PartOf};
use gearwear_physics::plan::StageKind;
use gearwear_physics::results::run::{PathPoints, RunRecord, StopReason, Summary};

/// Total time of the repeats of a run, preparation included; the least time counts.
const LONG_ENOUGH_S: f64 = 0.1;
/// Greatest number of repeats.
const MOST_REPEATS: u32 = 20;

/// Outcome of one setting.
pub(super) struct MeasuredSetting {
    pub record: VariantRecord,
    pub finished: Option<Finished>,
}

impl MeasuredSetting {
    fn failed(record: VariantRecord, failure: String) -> Self {
        Self { record: VariantRecord { failure: Some(failure), ..record }, finished: None }
    }
}

/// Part of a run that is kept for the comparison; a hundred whole records would need too much memory.
pub(super) struct Finished {
    pub observed: ObservedRun,
    pub summary: Summary,
    /// Radii of the points A–E.
    pub path_point_radius_mm: PerGear<PathPoints>,
}

/// Runs one setting, a short one several times; `None` where the user interrupted it.
pub(super) fn measure(setting: &Setting, base: &LoadedScene, observer: &PartOf<'_>) -> Option<MeasuredSetting> {
    if observer.interrupted() {
        return None;
    }
    let mut record =
        VariantRecord { name: setting.name(), settings: setting.record(base.scene()), ..VariantRecord::default() };
    let mut resolved = match setting.scene(&base.resolved, Some(CALIBRATION_FILE)) {
        Ok(resolved) => resolved,
        Err(problems) => return Some(MeasuredSetting::failed(record, in_words(&problems))),
    };
    // The comparison has its own reference.
    resolved.scene.verify = false;
    resolved.scene.operation.torque_curve_n_mm.clear();
    record.settings = setting.record(&resolved.scene);
    let scene = match base.variant(resolved) {
        Ok(scene) => scene,
        Err(problem) => return Some(MeasuredSetting::failed(record, problem.to_string())),
    };
    let mut kept = None;
    let start = Instant::now();
    while record.repeats == 0 || (start.elapsed().as_secs_f64() < LONG_ENOUGH_S && record.repeats < MOST_REPEATS) {
        let done = match runs::run(&scene, observer) {
            Ok(Done { record: done, failure: None }) if done.summary.stopped == StopReason::Completed => done,
            Ok(Done { failure: Some(failure), .. }) => {
                return Some(MeasuredSetting::failed(record, failure.to_string()));
            }
            Ok(_) => return None,
            Err(_) if observer.interrupted() => return None,
            Err(failure) => return Some(MeasuredSetting::failed(record, RunError::to_string(&failure))),
        };
        let (simulation_s, setup_s) = times(&done);
        record.repeats += 1;
        record.simulation_s = Some(record.simulation_s.map_or(simulation_s, |least: f64| least.min(simulation_s)));
        record.setup_s = Some(record.setup_s.map_or(setup_s, |least: f64| least.min(setup_s)));
        kept = Some(done);
    }
    let run = kept?;
    record.work = Some(run.summary.work);
    record.peak_wear_um =
        Some(PerGear { pinion: run.summary.pinion.peak_wear_um, wheel: run.summary.wheel.peak_wear_um });
    let finished = Finished {
        observed: ObservedRun::of(&run),
        path_point_radius_mm: PerGear::from_fn(|gear| run.flanks[gear].path_point_radius_mm),
        summary: run.summary,
    };
    Some(MeasuredSetting { record, finished: Some(finished) })
}

/// Wall times of the wear run and of everything before it, s.
fn times(run: &RunRecord) -> (f64, f64) {
    let simulation = StageKind::Simulation.name();
    run.summary.stages.iter().fold((0.0, 0.0), |(simulation_s, setup_s), stage| {
        if stage.name == simulation {
            (simulation_s + stage.wall_s, setup_s)
        } else {
            (simulation_s, setup_s + stage.wall_s)
        }
    })
}
