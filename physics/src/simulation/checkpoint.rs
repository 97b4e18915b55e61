//! Checkpoint of a wear run, from which it goes on to the same bits as if it had never stopped.
//!
//! Equilibria are sought from the last ones, so that the state of a run is more than what its flanks have lost: starts, windows that
//! were widened, sets of contact that were found. All of that changes results in their last bits only, but it changes them. So a
//! long run forgets it now and then ([`WearingPair::reset`]), whether checkpoints are written or not, after a number of
//! evaluations that is fixed by the scene ([`MeshContact::evaluations_between_clean_starts`]). At such a moment what the flanks have
//! lost, the counters and the state of the step control are all there is, and only then a [`Checkpoint`] may be taken: a run that goes on from one
//! evaluates the same flanks from the same clean start as the unbroken run did.
//!
//! [`WearingPair::reset`]: crate::mesh_cycle::wearing_pair::WearingPair::reset
//! [`MeshContact::evaluations_between_clean_starts`]: super::mesh_contact::MeshContact::evaluations_between_clean_starts

use serde::{Deserialize, Serialize};

use super::advance::StepperState;
use crate::mesh_cycle::Work;
use crate::mesh_cycle::over_life::PeakToPeakOverLife;
use crate::mesh_cycle::wearing_pair::Snapshot;
use gearwear_bodies::gear::PerGear;

/// A run at a clean start: evaluated, and what was due there kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Index of its phase, from 0.
    pub phase: usize,
    /// Pinion revolutions reached.
    pub revolutions: f64,
    /// Wear depth at each place of the flanks, mm.
    pub wear_mm: PerGear<Vec<f64>>,
    /// State of the step control.
    pub stepper: StepperState,
    /// Work done, the evaluation of this state included.
    pub work: Work,
    /// Transmission error so far.
    pub over_life: PeakToPeakOverLife,
    /// The unworn pair, then each snapshot reached.
    pub states: Vec<Snapshot>,
}

impl Checkpoint {
    /// Whether the rows of its snapshots are `points` long, so that they can be those of a run with such flanks.
    pub(super) fn fits(&self, points: PerGear<usize>) -> bool {
        !self.states.is_empty()
            && self.states.iter().all(|state| {
                let cycle = &state.cycle;
                let rows = [&state.wear_mm, &state.depth_per_mesh_mm, &cycle.pressure_mpa, &cycle.sliding_mm];
                rows.into_iter().all(|row| row.as_ref().map(Vec::len) == points)
            })
    }
}

/// Keeper of checkpoints.
pub trait Keeper: Sync {
    /// Whether it is time for one.
    fn is_due(&self) -> bool;

    /// Keeps it in the place of the one before.
    fn keep(&self, checkpoint: &Checkpoint);
}

/// Keeper that keeps nothing.
pub struct NothingKept;

impl Keeper for NothingKept {
    fn is_due(&self) -> bool {
        false
    }

    fn keep(&self, _checkpoint: &Checkpoint) {}
}
