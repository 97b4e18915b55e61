//! A random scene carried out, and how it ended.

use toml::Table;

use gearwear::runs;
use gearwear::scene::loaded::LoadedScene;
use gearwear::varied_scene::one_line;
use gearwear_physics::assessment::RunError;
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::{RunRecord, StopReason};

/// Outcome of a scene that does not run to its end.
#[derive(Debug, Clone, PartialEq)]
pub enum Ended {
    /// Refused with a message.
    Refused(String),
    /// A tooth is worn through.
    WornThrough,
    /// The solver did not converge.
    NotConverged(String),
    /// A defect of the program.
    Panicked(String),
    /// The user stopped it.
    Interrupted,
}

impl Ended {
    /// Defect of the program that the run shows, if any.
    pub(super) fn defect(&self) -> Option<String> {
        match self {
            Ended::NotConverged(said) => Some(format!("did not converge: {said}")),
            Ended::Panicked(said) => Some(format!("a defect of the program: {said}")),
            Ended::Refused(_) | Ended::WornThrough | Ended::Interrupted => None,
        }
    }
}

/// Runs the scene; only a run that comes to its end has a record.
pub(super) fn carried_out(table: &Table, observer: &dyn Observer) -> Result<RunRecord, Ended> {
    guarded(|| run(table, observer)).unwrap_or_else(|said| Err(Ended::Panicked(one_line(&said))))
}

fn refused(error: impl ToString) -> Ended {
    Ended::Refused(one_line(&error.to_string()))
}

fn run(table: &Table, observer: &dyn Observer) -> Result<RunRecord, Ended> {
    let scene = LoadedScene::from_toml(&table.to_string()).map_err(refused)?;
    let done = runs::run(&scene, observer).map_err(|error| match &error {
        error if error.is_interrupted() => Ended::Interrupted,
        RunError::Simulation(_) if error.stiffness().is_none() => Ended::NotConverged(one_line(&error.to_string())),
        _ => refused(error),
    })?;
    match (done.record.summary.stopped, done.failure) {
        (StopReason::Completed | StopReason::LimitReached, None) => Ok(done.record),
        (StopReason::WornThrough, _) => Err(Ended::WornThrough),
        (StopReason::Interrupted, _) => Err(Ended::Interrupted),
        (_, Some(unstable @ RunError::UnstableSteps { .. })) => Err(refused(unstable)),
        (_, failure) => {
            Err(Ended::NotConverged(failure.map_or_else(String::new, |failure| one_line(&failure.to_string()))))
        }
    }
}
