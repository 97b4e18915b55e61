//! Failures of a run.

use crate::calibration::CalibrationError;
use crate::mesh_cycle::load_sharing::EquilibriumError;
use crate::mesh_cycle::pair_in_space::PairInSpaceError;
use crate::simulation::wear_run::SimulationError;
use crate::stiffness::StiffnessError;
use gearwear_bodies::gear::PairError;
use gearwear_bodies::gear_fem::model::ModelError;

/// Failure of a run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The pair cannot exist.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// Stiffness model and contact surface do not go together.
    #[error(transparent)]
    Stiffness(#[from] StiffnessError),
    /// The finite-element model cannot be made.
    #[error(transparent)]
    FiniteElements(#[from] ModelError),
    /// The teeth cannot be condensed in space.
    #[error("the three-dimensional teeth, which couple the slices: {0}")]
    TeethInSpace(#[from] PairInSpaceError),
    /// The tooth stiffness of finite elements cannot be computed.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The run needs more memory than there is.
    #[error("the run takes some {gb:.1} GB of memory, more than can be had; less with {savings}")]
    Memory {
        /// Memory of the run, GB.
        gb: f64,
        /// What of the scene takes less.
        savings: String,
    },
    /// The solver failed.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// Wear that oscillates has left flanks that touch nowhere as the solver expects: tilted by more than the angles that it is linear in.
    #[error(
        "{source}; the wear steps are {step_over_safe:.1} times as long as the longest stable one, so that wear oscillates and spoils the \
         flanks: choose a smaller numerics.step.revolutions, or numerics.step = \"adaptive\""
    )]
    UnstableSteps {
        /// Step over the longest stable one.
        step_over_safe: f64,
        /// Failure of the solver.
        source: SimulationError,
    },
}

impl RunError {
    /// Why a run ended before its time, whose steps are so many times as long as the longest stable one.
    pub(super) fn of_run(failure: SimulationError, step_over_safe: f64) -> Self {
        match failure {
            source @ SimulationError::Equilibrium { .. } if step_over_safe > 1.0 => {
                Self::UnstableSteps { step_over_safe, source }
            }
            other => Self::Simulation(other),
        }
    }

    /// Whether the run was interrupted before anything of it was finished.
    pub fn is_interrupted(&self) -> bool {
        matches!(self, Self::Simulation(SimulationError::Equilibrium { source: EquilibriumError::Interrupted, .. }))
    }

    /// The scene's contradiction between stiffness model and contact surface, if that is what is wrong.
    pub fn stiffness(&self) -> Option<&StiffnessError> {
        match self {
            RunError::Stiffness(error) | RunError::Simulation(SimulationError::Stiffness(error)) => {
                Some(error).filter(|error| matches!(error, StiffnessError::SurfaceTooSoft { .. }))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A contact that is not found after steps longer than the stable one names the step; nothing else does.
    #[test]
    fn a_contact_spoilt_by_long_steps_names_the_step() {
        let lost = SimulationError::Equilibrium {
            revolutions: 1e5,
            source: EquilibriumError::NotFinite { position_mm: 12.0 },
        };
        let said = RunError::of_run(lost.clone(), 560.5).to_string();
        assert!(
            said.starts_with(&lost.to_string()) && said.contains("560.5 times") && said.contains("numerics.step"),
            "{said}"
        );
        assert_eq!(RunError::of_run(lost.clone(), 1.0), RunError::Simulation(lost));
        assert_eq!(RunError::of_run(SimulationError::OtherRun, 2.0), RunError::Simulation(SimulationError::OtherRun));
    }
}
