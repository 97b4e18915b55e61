//! Carries out a plan.

use std::path::Path;

use crate::plan::Plan;
use crate::scene::Resolved;
use crate::simulation::record::RunRecord;

/// What is to be run.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// The scene.
    pub resolved: &'a Resolved,
    /// Its plan.
    pub plan: &'a Plan,
    /// The output folder.
    pub out: &'a Path,
}

/// Told of progress; says whether to go on.
pub trait Observer: Sync {
    /// A stage begins.
    fn stage(&self, name: &str);
    /// So much of the stage is done.
    fn progress(&self, done: f64, total: f64);
    /// Whether the user wants to stop.
    fn interrupted(&self) -> bool;
}

/// Why a run failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// This stage cannot be carried out.
    #[error("the stage {name} is not there yet")]
    Stage {
        /// Its name.
        name: &'static str,
    },
}

/// Carries out the plan and writes the output folder.
///
/// # Errors
/// A stage that fails.
pub fn run(request: &Request, observer: &dyn Observer) -> Result<RunRecord, RunError> {
    let kind = request.plan.stages[0].kind;
    observer.stage(kind.name());
    Err(RunError::Stage { name: kind.name() })
}
