//! Model of a run: its pair, phases, springs and slices.

use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::operation::Scene;
use crate::simulation::settings::LifeLimits;
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun, reference_phase};
use crate::stiffness::{TeethSpring, settings::StiffnessSettings};
use crate::wear::settings::WearOfPair;
use gearwear_bodies::gear::{GearPair, PerGear, flank_zones::FlankZones};
use gearwear_bodies::reference::flattening::Flattening;

/// Model of a run, beyond the scene's own data. Where loads of phases differ, figures of one load are of the greatest.
pub(super) struct RunModel<'a> {
    pub scene: &'a Scene,
    /// Stiffness model in use: the scene's, or its fallback.
    pub stiffness: StiffnessSettings,
    pub pair: &'a GearPair,
    pub phases: Vec<RunPhase<'a>>,
    /// The pair under each torque of the curve, N·mm; none where nobody asks for it.
    pub torque_curve: Vec<(f64, RunPhase<'a>)>,
    /// Limits that end the run early.
    pub limits: LifeLimits,
    /// The slices over the face width; none where all sections are alike.
    pub sliced: Option<&'a SlicedTeeth>,
    /// Springs of the teeth; none with finite elements.
    pub teeth: Option<&'a TeethSpring<'a>>,
    /// Hertz's contact at the pitch point.
    pub at_pitch: Flattening,
    /// K/H under the load of each phase, of the surfaces that have one.
    pub foundations_mpa_per_mm: Vec<Option<f64>>,
}

impl RunModel<'_> {
    /// Wear run of the scene itself.
    pub(super) fn wear_run(&self) -> WearRun<'_> {
        WearRun {
            pair: self.pair,
            zones: self.zones(),
            phases: &self.phases,
            snapshots_revolutions: &self.scene.operation.snapshots_revolutions,
            meshes_per_pinion_turn: self.scene.operation.meshes_per_pinion_turn(self.pair),
            limits: self.limits,
            numerics: self.scene.numerics,
        }
    }

    /// Drops the positions that the simulations of the run prepared on its finite elements.
    pub(super) fn drop_idle_positions(&self) {
        let under_torques = self.torque_curve.iter().map(|(_, phase)| phase);
        self.phases.iter().chain(under_torques).for_each(|phase| phase.contact.drop_idle_positions());
    }

    /// Zones of both flanks, for the half-width of contact under the greatest load of any phase.
    pub(super) fn zones(&self) -> PerGear<FlankZones> {
        FlankZones::of_pair(self.pair, self.at_pitch.contact.loaded(self.greatest_load_n_per_mm()).half_width_mm)
    }

    /// Greatest load of any phase.
    pub(super) fn greatest_load_n_per_mm(&self) -> f64 {
        self.phases.iter().map(|phase| phase.line_load_n_per_mm).fold(0.0, f64::max)
    }

    /// Duration of the run, pinion revolutions.
    pub(super) fn duration(&self) -> f64 {
        self.phases.last().map_or(0.0, |phase| phase.end_revolutions)
    }

    /// Model of the runs that `outcome` is compared with: without limits, ending when it ended.
    pub(super) fn ending_with(mut self, outcome: &Outcome) -> Self {
        self.limits = LifeLimits::default();
        if outcome.limit_reached.is_some() {
            let end = outcome.worn.revolutions;
            self.phases.iter_mut().for_each(|phase| phase.end_revolutions = phase.end_revolutions.min(end));
        }
        self
    }

    /// Whether any wear of `outcome` is severe.
    pub(super) fn wears_severely(&self, outcome: &Outcome) -> bool {
        self.scene.wear.severe_factor_under(outcome.greatest_pressure_mpa()).is_some()
    }

    /// Phase of the greatest load.
    pub(super) fn reference(&self) -> &RunPhase<'_> {
        &self.phases[reference_phase(&self.phases)]
    }
}
