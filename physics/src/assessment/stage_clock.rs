//! Times the stages of a computation and tells its observer of them.

use std::time::Instant;

use crate::observer::Observer;
use crate::results::run::StageTime;

/// The stages so far, with their times.
pub struct StageClock<'a> {
    /// Told of each stage.
    pub observer: &'a dyn Observer,
    /// Wall time of each stage.
    pub times: Vec<StageTime>,
}

impl<'a> StageClock<'a> {
    /// No stage yet.
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
}
