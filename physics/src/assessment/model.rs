//! What a run is made of.

use crate::gear::{GearPair, PerGear, flank_zones::FlankZones};
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::operation::Scene;
use crate::reference::flattening::Flattening;
use crate::simulation::settings::LifeLimits;
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun, reference_phase};
use crate::stiffness::{TeethSpring, settings::StiffnessSettings};

/// What a run is made of, beyond the scene's own data. Where loads of phases differ, figures of one load are of the greatest.
pub(super) struct Model<'a> {
    pub scene: &'a Scene,
    /// The model of the teeth's stiffness that is used.
    pub stiffness: StiffnessSettings,
    pub pair: &'a GearPair,
    pub phases: Vec<RunPhase<'a>>,
    /// What ends a run before its time.
    pub limits: LifeLimits,
    /// The slices over the face width; none where all sections are alike.
    pub sliced: Option<&'a SlicedTeeth>,
    /// Springs of the teeth; none with finite elements.
    pub teeth: Option<&'a TeethSpring<'a>>,
    /// Hertz at the pitch point.
    pub at_pitch: Flattening,
    /// K/H under the load of each phase, of the surfaces that have one.
    pub foundations_mpa_per_mm: Vec<Option<f64>>,
}

impl Model<'_> {
    /// The scene's own run.
    pub(super) fn wear_run(&self) -> WearRun<'_> {
        WearRun {
            pair: self.pair,
            zones: self.zones(),
            phases: &self.phases,
            snapshots_revolutions: &self.scene.operation.snapshots_revolutions,
            limits: self.limits,
            numerics: self.scene.numerics,
        }
    }

    /// The parts of both flanks, as wide as the greatest load of any phase asks for.
    pub(super) fn zones(&self) -> PerGear<FlankZones> {
        let greatest = self.phases.iter().map(|phase| phase.line_load_n_per_mm).fold(0.0, f64::max);
        FlankZones::of_pair(self.pair, self.at_pitch.contact.loaded(greatest).half_width_mm)
    }

    /// How long a run is, pinion revolutions.
    pub(super) fn duration(&self) -> f64 {
        self.phases.last().map_or(0.0, |phase| phase.end_revolutions)
    }

    /// That of the runs which `outcome` is held against: as long as it was, whatever they wear.
    pub(super) fn ending_with(mut self, outcome: &Outcome) -> Self {
        self.limits = LifeLimits::default();
        if outcome.limit_reached.is_some() {
            let end = outcome.worn.revolutions;
            self.phases.iter_mut().for_each(|phase| phase.end_revolutions = phase.end_revolutions.min(end));
        }
        self
    }

    /// The phase of the greatest load.
    pub(super) fn reference(&self) -> &RunPhase<'_> {
        &self.phases[reference_phase(&self.phases)]
    }
}
