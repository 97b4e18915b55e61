//! Longest stable wear step of Euler's method.
//!
//! A wave of wear on both flanks, of the height e₁ + e₂, raises the pressure by K (e₁ + e₂) and wears down at the rate
//! k K (s₁ + s₂ z1/z2)(e₁ + e₂) per pinion revolution: the sum over both gears, s being how far a point slides in one mesh while it
//! is in contact. Euler's method swings, ever wider, where
//!
//! ```text
//! Δn · max k K (s₁ + s₂ z1/z2) > 2
//! ```
//!
//! K is that of the shortest wave that the surface tells apart: K/H on a Winkler foundation, E* π/(2 Δx) on elastic half-planes with
//! cells Δx, and on finite elements that of their nodes, for which there is no closed form. Positions, points and cells between them
//! damp what lies between; on half-planes the closed form is off by more than that is worth. So the largest of all these rates is
//! measured, as the spectral radius of the mesh cycle itself, on the unworn flanks, in some ten evaluations
//! ([`crate::wear::stepping::spectral_radius`]).

use super::advance;
use super::wear_run::{RunPhase, SimulationError, WearRun};

/// The product of step and rate that Euler's method is stable up to.
const STABLE: f64 = 2.0;

/// Bound of the wear steps of a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepBound {
    /// Longest stable step of Euler's method, pinion revolutions; infinite where nothing bounds it.
    pub revolutions: f64,
    /// Greatest pressure on the unworn flanks, MPa; `None` where it was not asked for.
    pub peak_pressure_mpa: Option<f64>,
    /// Mesh cycles evaluated to find it.
    pub evaluations: u64,
}

impl WearRun<'_> {
    /// The longest stable step of Euler's method on unworn flanks in the conditions of `phase`; with `pressure_too`, the greatest
    /// pressure on them beside it. `stopped` is asked now and then whether to give up.
    pub fn step_bound(
        &self,
        phase: &RunPhase<'_>,
        pressure_too: bool,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<StepBound, SimulationError> {
        let flanks = self.unworn_flanks(phase.contact.slices(self.pair));
        let mut pair = self.wearing_pair(phase, &flanks)?;
        let failed = |source| SimulationError::Equilibrium { revolutions: 0.0, source };
        pair.evaluate(&phase.wear, stopped).map_err(failed)?;
        let peak_pressure_mpa = match pressure_too {
            true => Some(pair.snapshot(0.0).map_err(failed)?.cycle.peak_pressure_mpa()),
            false => None,
        };
        let meshes = self.meshes_per_pinion_turn;
        let (fastest, evaluations) =
            advance::fastest_decay(&mut *pair, &phase.wear, meshes, stopped).map_err(failed)?;
        Ok(StepBound { revolutions: STABLE / fastest, peak_pressure_mpa, evaluations: evaluations + 1 })
    }
}
