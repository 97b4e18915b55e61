//! Time and memory that a run will take, from its scene alone: what is said before it begins.
//!
//! The example `run_costs` of the validation holds both against random scenes.

use serde::Serialize;

use super::work::Work;
use super::{Plan, StageKind};
use crate::operation::Scene;
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
        Self { seconds: stages.iter().map(|stage| stage.seconds).sum(), memory_gb, stages }
    }

    /// In words, where it is much.
    pub fn announcement(&self) -> Option<String> {
        if self.seconds <= MUCH_TIME_S && self.memory_gb <= MUCH_MEMORY_GB {
            return None;
        }
        let most = self.stages.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        Some(format!(
            "the run takes some {:.0} s on one thread, {:.0} s of them for the {}, and {:.1} GB; fewer helical.slices, numerics.positions or \
             loads of operation.phases, or numerics.verify = false take less",
            self.seconds,
            most.seconds,
            most.kind.name(),
            self.memory_gb
        ))
    }
}
