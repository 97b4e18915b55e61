//! Clock of the stages of a computation, which its observer is told of.

use std::time::Instant;

use crate::observer::Observer;
use crate::plan::{Plan, StageKind};
use crate::results::run::StageTime;

/// Stages carried out so far, with their times.
pub struct StageClock<'a> {
    /// Told of each stage.
    pub observer: &'a dyn Observer,
    /// Wall time of each stage.
    pub times: Vec<StageTime>,
}

impl<'a> StageClock<'a> {
    /// Clock before the first stage.
    pub fn new(observer: &'a dyn Observer) -> Self {
        Self { observer, times: Vec::new() }
    }

    /// Carries out the stage `name`.
    pub fn run<T>(&mut self, name: &str, work: impl FnOnce() -> T) -> T {
        self.observer.stage(name);
        let start = Instant::now();
        let result = work();
        self.times.push(StageTime { name: name.to_owned(), wall_s: start.elapsed().as_secs_f64() });
        result
    }

    /// Carries out a stage that `plan` has; none where it does not.
    pub(super) fn planned<T>(&mut self, plan: &Plan, stage: StageKind, work: impl FnOnce() -> T) -> Option<T> {
        plan.has(stage).then(|| self.run(stage.name(), work))
    }
}
