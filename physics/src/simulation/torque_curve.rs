//! The new and the worn pair under loads other than those of the run: what the transmission error depends on.
//!
//! A relief suits one torque. Below it the relieved tips stay out of contact and the transmission error follows the relief, above it the teeth yield
//! by more than the relief gives way; in between lies the least transmission error (Harris, Proc. Inst. Mech. Eng. 172, 1958). Wear moves it, as it
//! takes most where the flanks slide most.
//!
//! Bodies, springs of the teeth and couplings of slices are those of the run. Positions of the mesh cycle are found anew for each load, as the reach
//! of tip edges and the width of contact depend on it; finite elements keep the mesh that they have for the run's load.

use super::advance;
use super::wear_run::{Outcome, RunPhase, SimulationError, WearRun, fits};
use crate::mesh_cycle::wearing_pair::WearingPair;
use crate::mesh_cycle::{CycleObservation, Work};

/// Mesh cycles of the new and of the worn pair under one load; `None` where there is no equilibrium under it, or nothing is worn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CyclesUnderLoad {
    /// Mesh cycle of the unworn pair.
    pub new: Option<CycleObservation>,
    /// Mesh cycle of the pair at the end of the run.
    pub worn: Option<CycleObservation>,
    /// Work of both.
    pub work: Work,
}

impl WearRun<'_> {
    /// Mesh cycles of the new and the worn pair of `outcome` under the load of `phase`, which need not be one of the run's.
    ///
    /// # Errors
    /// [`SimulationError::Stiffness`] where the springs of the teeth do not hold under this load.
    pub fn cycles_under(
        &self,
        phase: &RunPhase<'_>,
        outcome: &Outcome,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<CyclesUnderLoad, SimulationError> {
        let flanks = self.unworn_flanks(outcome.slices.clone());
        let mut pair = self.wearing_pair(phase, &flanks)?;
        let mut cycles = CyclesUnderLoad::default();
        cycles.new = observed(&mut *pair, phase, &mut cycles.work, stopped);
        if let Some(wear_mm) = outcome.worn_places_mm.as_ref().filter(|wear_mm| fits(&*pair, wear_mm)) {
            pair.set_wear_mm(wear_mm);
            cycles.worn = observed(&mut *pair, phase, &mut cycles.work, stopped);
        }
        Ok(cycles)
    }
}

/// Mesh cycle of `pair` on its present flanks; `None` without an equilibrium.
fn observed(
    pair: &mut dyn WearingPair,
    phase: &RunPhase<'_>,
    work: &mut Work,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<CycleObservation> {
    *work += advance::evaluate(pair, &phase.wear, stopped).ok()?;
    pair.snapshot(0.0).ok().map(|state| state.cycle)
}
