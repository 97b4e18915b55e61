//! Time and memory that a run will take, from its scene alone: what is said before it begins.
//!
//! The example `run_costs` of the validation holds both against random scenes.

use serde::Serialize;

use super::work::Work;
use super::{Plan, StageKind, loads};
use crate::contact::settings::SurfaceKind;
use crate::operation::Scene;
use crate::simulation::settings::Stepping;
use crate::wear::settings::WearOfPair;
use gearwear_bodies::gear::GearPair;

/// Time above which a run says at its beginning what it takes, s.
const MUCH_TIME_S: f64 = 20.0;
/// Memory above which it does, GB.
const MUCH_MEMORY_GB: f64 = 1.0;

/// Cost of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunCost {
    /// Time of all stages on one thread, s.
    pub seconds: f64,
    /// Peak memory, GB.
    #[serde(rename = "memory_GB")]
    pub memory_gb: f64,
    /// Time of each stage that takes any, s.
    pub stages: Vec<StageCost>,
    /// What of the scene, changed so, takes less, in words.
    #[serde(skip)]
    pub savings: String,
}

/// Plan of a run with its cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanAndCost {
    /// Stages, and those left out.
    #[serde(flatten)]
    pub plan: Plan,
    /// Cost of the run.
    pub cost: RunCost,
}

/// Cost of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StageCost {
    /// Kind of stage.
    #[serde(rename = "name")]
    pub kind: StageKind,
    /// Time on one thread, s.
    pub seconds: f64,
}

impl RunCost {
    /// Cost of a run of `scene`, whose gears are `pair`, as `plan` says.
    pub fn of(scene: &Scene, plan: &Plan, pair: &GearPair) -> Self {
        let work = Work::of(scene, pair);
        let all =
            plan.stages.iter().map(|stage| StageCost { kind: stage.kind, seconds: work.seconds(stage.kind, scene) });
        let stages: Vec<StageCost> = all.filter(|stage| stage.seconds > 0.0).collect();
        let memory_gb = work.memory_gb(scene, plan);
        let seconds = stages.iter().map(|stage| stage.seconds).sum();
        Self { seconds, memory_gb, stages, savings: savings(scene, plan) }
    }

    /// In words, where it is much.
    pub fn announcement(&self) -> Option<String> {
        if self.seconds <= MUCH_TIME_S && self.memory_gb <= MUCH_MEMORY_GB {
            return None;
        }
        let most = self.stages.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        Some(format!(
            "the run takes some {:.0} s on one thread, {:.0} s of them for the {}, and {:.1} GB; less with {}",
            self.seconds,
            most.seconds,
            most.kind.name(),
            self.memory_gb,
            self.savings
        ))
    }
}

/// What of `scene` takes less.
fn savings(scene: &Scene, plan: &Plan) -> String {
    let of_elements = scene.slices.is_none() && scene.contact.surface == SurfaceKind::Fem;
    let is_fixed = matches!(scene.numerics.stepping, Stepping::Fixed { .. });
    let repeats = plan.has(StageKind::ErrorEstimates) && scene.wear.may_be_severe();
    let keys = [
        (scene.slices.is_some(), "fewer helical.slices"),
        (true, "fewer numerics.positions"),
        (of_elements, "fewer fem.elements_per_half_width"),
        (!of_elements, "fewer numerics.flank_points"),
        (loads(scene) > 1.0, "fewer loads of operation.phases"),
        (is_fixed, "more revolutions in numerics.step"),
        (repeats, "numerics.error_estimate = false"),
        (plan.has(StageKind::Verification), "numerics.verify = false"),
    ];
    let said: Vec<&str> = keys.into_iter().filter_map(|(applies, key)| applies.then_some(key)).collect();
    said.join(", ")
}
