//! Question of a sweep, the same on the command line and in Python, and its errors.

use std::io;

use super::axis::{self, AxisError};
use super::combination::Sweep;
use super::goal::{FigureLimit, Goal, GoalError};
use crate::evaluate::{self, EvaluateError};
use crate::journal::JournalError;
use crate::report::ReportError;
use crate::scene::draft::Draft;
use crate::scene::loaded::SceneError;
use crate::scene::opened::OpenedScene;
use gearwear_physics::results::figures;

/// Question of a sweep.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SweepQuestion {
    /// Keys and their values: `KEY=FROM:TO:COUNT`, the same with `:log` for equal ratios, or `KEY=VALUE,VALUE,…` of rising numbers or of
    /// words. The first changes slowest.
    pub vary: Vec<String>,
    /// Figure to minimise, a column of `sweep.csv`: its path in `summary.json`.
    pub best: Option<String>,
    /// Limits of the optimum: `FIGURE<=VALUE` or `FIGURE>=VALUE`.
    pub subject_to: Vec<String>,
    /// Whether the errors of each combination are estimated.
    pub error_estimate: bool,
    /// Columns beside the main figures: paths of numbers in `summary.json`.
    pub outputs: Vec<String>,
}

impl SweepQuestion {
    /// Notes on figures that are named as in the previous version.
    pub fn notes(&self) -> Vec<String> {
        let of_limits = self.subject_to.iter().map(|limit| limit.split(['<', '>']).next().unwrap_or_default().trim());
        let outputs = self.outputs.iter().map(String::as_str);
        figures::notes(self.best.iter().map(String::as_str).chain(of_limits).chain(outputs))
    }
}

/// Error of a sweep or of its journal.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct SweepError(#[from] pub SweepFault);

#[derive(Debug, thiserror::Error)]
pub enum SweepFault {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Axis(#[from] AxisError),
    #[error(transparent)]
    Goal(#[from] GoalError),
    #[error(transparent)]
    Output(#[from] EvaluateError),
    #[error("none of the combinations makes a scene; the first: {0}")]
    NothingToVary(String),
    #[error(transparent)]
    Journal(#[from] JournalError),
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl SweepError {
    /// Error of the scene, if that is the reason.
    pub fn in_the_scene(&self) -> Option<&SceneError> {
        if let SweepFault::Scene(error) = &self.0 { Some(error) } else { None }
    }

    /// Error of the system, where a file cannot be read or written.
    pub fn of_system(&self) -> Option<io::ErrorKind> {
        match &self.0 {
            SweepFault::Journal(error) => error.of_system(),
            SweepFault::Report(ReportError::NotAFolder { .. }) => Some(io::ErrorKind::NotADirectory),
            SweepFault::Report(ReportError::CreateFolder { source, .. } | ReportError::WriteFile { source, .. }) => {
                Some(source.kind())
            }
            _ => None,
        }
    }
}

impl Sweep {
    /// The sweep of `scene` that `question` asks for.
    ///
    /// # Errors
    /// Keys, values or figures that do not exist or do not go together.
    pub fn of<S>(scene: &S, question: &SweepQuestion) -> Result<Self, SweepError>
    where
        for<'s> &'s S: Into<OpenedScene>,
    {
        Self::asked(&scene.into(), question).map_err(SweepError)
    }

    fn asked(scene: &OpenedScene, question: &SweepQuestion) -> Result<Self, SweepFault> {
        let axes = axis::parse_all(question.vary.iter().map(String::as_str))?;
        let draft = Draft::parse(&scene.given().text).map_err(|problems| scene.refused(problems))?;
        axis::check_phases(&axes, &draft)?;
        let kind = scene.kind();
        let limits = question.subject_to.iter().map(|limit| FigureLimit::parse(kind, limit));
        let limits = limits.collect::<Result<_, GoalError>>()?;
        let goal = question.best.as_ref().map(|figure| Goal::new(kind, figure, limits)).transpose()?;
        let outputs = evaluate::outputs(kind, &question.outputs)?;
        let sweep = Self::new(scene, axes, goal, question.error_estimate, outputs);
        Ok(sweep.map_err(|problems| scene.refused(problems))?)
    }

    /// Warnings: values that their key does not take.
    pub fn warnings(&self) -> Vec<String> {
        self.identity.axes.iter().filter_map(axis::partly_not_allowed).collect()
    }
}
