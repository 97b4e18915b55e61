//! The wear run: explicit Euler over revolutions of the pinion.
//!
//! One evaluation of the working cycle on the flanks as they are gives the depth each point loses per mesh; it is taken
//! to hold for the next `step_revolutions`. Each pinion tooth meshes once per pinion turn, each wheel tooth z1/z2 times:
//!
//! ```text
//! h1 ← h1 + Δn · dh1          h2 ← h2 + Δn · (z1/z2) · dh2
//! ```
//!
//! Steps are shortened to hit the snapshots exactly.
//!
//! Source: the thesis, equation 12 (single-point observation, section 3.3).

use super::record::StopReason;
use super::settings::{Numerics, Operation};
use super::simplified::{SimplifiedPair, exact::Springs};
use super::wearing_pair::{OnFlankPoints, WearingPair};
use crate::contact::{ContactSurface, Flanks, settings::Material};
use crate::fem::gear::position::CondensedPair;
use crate::gear::{GearPair, PerGear, flank::FlankGrid, removed_material::modifications_mm, slices::Slices};
use crate::stiffness::{StiffnessError, TeethSpring};
use crate::wear::WearLaw;
use crate::working_cycle::{
    CycleObservation, MeshCycle, Work, WorkingCycle,
    condensed::CondensedCycle,
    load_sharing::EquilibriumError,
    phases::phases,
    positions::{loading_positions, positions_with_tip_contact},
    sliced::{SliceSprings, SlicedCycle, SpringAlongPath},
    sliced_teeth::SlicedTeeth,
    tip_contact,
};

/// Why a wear run could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// Stiffness model and contact surface do not go together.
    #[error(transparent)]
    Stiffness(#[from] StiffnessError),
    /// The tooth pairs found no equilibrium.
    #[error("after {revolutions:.4e} pinion revolutions: {source}")]
    Equilibrium {
        /// How far the run had come.
        revolutions: f64,
        /// What happened.
        source: EquilibriumError,
    },
}

/// Everything a run is made of.
#[derive(Clone, Copy)]
pub struct WearRun<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// How they touch and yield.
    pub contact: MeshContact<'a>,
    /// How they wear.
    pub law: &'a dyn WearLaw,
    /// Whole load, N per mm of face width.
    pub line_load_n_per_mm: f64,
    /// How long they run.
    pub operation: &'a Operation,
    /// How finely.
    pub numerics: Numerics,
}

/// The elastic model of the pair in mesh.
#[derive(Clone, Copy)]
pub enum MeshContact<'a> {
    /// Each tooth pair a spring of its teeth in series with its contact surface, on the theoretical line of action.
    LineOfAction {
        /// How the flanks touch.
        surface: &'a dyn ContactSurface,
        /// How the teeth yield.
        teeth: &'a TeethSpring<'a>,
        /// Whether tip edges are followed into contact before A and after E.
        tip_contact: bool,
        /// The slices over the face width; none where all sections are alike.
        sliced: Option<&'a SlicedTeeth>,
    },
    /// Slices with Hertz's mean pressure, whose wear is kept at their contact points.
    Simplified {
        /// Of each gear.
        material: &'a PerGear<Material>,
        /// How the teeth yield.
        teeth: &'a TeethSpring<'a>,
        /// The slices over the face width.
        sliced: &'a SlicedTeeth,
    },
    /// Both gears as finite elements, condensed onto their flanks.
    FiniteElements(&'a CondensedPair<'a>),
}

/// State kept at a snapshot.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Pinion revolutions so far.
    pub revolutions: f64,
    /// Wear depth of each flank point, slice after slice.
    pub wear_mm: PerGear<Vec<f64>>,
    /// What each flank point loses in the next mesh.
    pub depth_per_mesh_mm: PerGear<Vec<f64>>,
    /// The working cycle of the flanks as they are.
    pub cycle: CycleObservation,
}

/// What a run found.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Why it ended.
    pub stop: StopReason,
    /// What went wrong where it did not converge.
    pub failure: Option<SimulationError>,
    /// The points of each flank, the same in every slice.
    pub grid: PerGear<FlankGrid>,
    /// The slices over the face width: one where all sections are alike.
    pub slices: Slices,
    /// Material removed by the modifications, slice after slice as all fields of a flank.
    pub modification_mm: PerGear<Vec<f64>>,
    /// The unworn pair.
    pub new: Snapshot,
    /// The pair at each snapshot reached, in order; where the run was interrupted, also at that moment.
    pub snapshots: Vec<Snapshot>,
    /// The pair when the run ended: the last of the snapshots.
    pub worn: Snapshot,
    /// Wear steps taken.
    pub wear_steps: u64,
    /// Work done in all.
    pub work: Work,
}

/// Told how far a run has come; says whether to go on.
pub trait Progress: Sync {
    /// `done` of `total` pinion revolutions are run.
    fn progress(&self, done: f64, total: f64);

    /// Whether the user wants it to stop: it does at the end of the wear step, whose state is kept.
    fn interrupted(&self) -> bool;

    /// Whether the user has waited for that long enough: it then stops at once, and what is kept is the last snapshot.
    fn gives_up(&self) -> bool;
}

/// Nobody watches, nobody interrupts.
pub struct Unwatched;

impl Progress for Unwatched {
    fn progress(&self, _done: f64, _total: f64) {}

    fn interrupted(&self) -> bool {
        false
    }

    fn gives_up(&self) -> bool {
        false
    }
}

/// A remainder of a step shorter than this part of it is not worth a step of its own.
const NEGLIGIBLE_STEP: f64 = 1e-9;

/// Tip edges are looked at within this many times the approach at the pitch point under the whole load: off it the teeth
/// are softer, and wear adds to it.
const AMPLE_APPROACH: f64 = 2.0;

impl WearRun<'_> {
    /// Runs the whole duration, or until interrupted.
    ///
    /// # Errors
    /// [`SimulationError`].
    pub fn run(&self, progress: &dyn Progress) -> Result<Outcome, SimulationError> {
        let slices = match self.contact {
            MeshContact::LineOfAction { sliced: Some(teeth), .. } | MeshContact::Simplified { sliced: teeth, .. } => {
                teeth.slices.clone()
            }
            _ => Slices::new(self.pair, 1),
        };
        let grid = PerGear::from_fn(|gear| FlankGrid::new(self.pair, gear, self.numerics.flank_points));
        let modification_mm = PerGear::from_fn(|gear| modifications_mm(self.pair, gear, &grid[gear], &slices));
        let flanks = Flanks { geometry: self.pair, grid: grid.as_ref() };
        let stopped: &(dyn Fn() -> bool + Sync) = &|| progress.gives_up();
        let mut pair = self.wearing_pair(flanks, &modification_mm)?;

        let end = self.operation.pinion_revolutions;
        let wheel_meshes = self.pair.wheel_turns_per_pinion_turn();
        let mut due = self.operation.snapshots_revolutions.iter().copied().chain([end]).peekable();
        let (mut revolutions, mut wear_steps, mut work) = (0.0, 0, Work::default());
        // The unworn pair first, then each snapshot.
        let mut states: Vec<Snapshot> = Vec::new();

        let mut failure = None;
        loop {
            let evaluated = pair.evaluate(self.law, stopped);
            let is_due = due.peek().is_some_and(|&next| revolutions >= next);
            let interrupted = progress.interrupted();
            let keep = states.is_empty() || is_due || interrupted;
            let state = evaluated.and_then(|done| {
                work += done;
                keep.then(|| pair.snapshot(revolutions)).transpose()
            });
            match state {
                Ok(state) => states.extend(state),
                // Before anything is finished there is nothing to keep.
                Err(source) if states.is_empty() => return Err(SimulationError::Equilibrium { revolutions, source }),
                Err(EquilibriumError::Interrupted) => break,
                Err(source) => {
                    failure = Some(SimulationError::Equilibrium { revolutions, source });
                    break;
                }
            }
            if keep {
                while due.next_if(|&next| next <= revolutions).is_some() {}
            }
            progress.progress(revolutions, end);
            let Some(&next) = due.peek() else { break };
            if interrupted {
                break;
            }

            let mut step = self.numerics.step_revolutions;
            let arrives = revolutions + step * (1.0 + NEGLIGIBLE_STEP) >= next;
            if arrives {
                step = next - revolutions;
            }
            revolutions = if arrives { next } else { revolutions + step };
            wear_steps += 1;
            pair.wear_for(PerGear { pinion: step, wheel: step * wheel_meshes });
        }
        drop(pair);
        let stop = match &failure {
            Some(_) => StopReason::NotConverged,
            None if due.peek().is_none() => StopReason::Completed,
            None => StopReason::Interrupted,
        };
        let new = states.remove(0);
        let worn = states.last().unwrap_or(&new).clone();
        Ok(Outcome { stop, failure, grid, slices, modification_mm, new, snapshots: states, worn, wear_steps, work })
    }

    /// The pair, ready to wear.
    fn wearing_pair<'b>(
        &'b self,
        flanks: Flanks<'b>,
        modification_mm: &'b PerGear<Vec<f64>>,
    ) -> Result<Box<dyn WearingPair + 'b>, SimulationError> {
        let (count, line_load) = (self.numerics.positions, self.line_load_n_per_mm);
        let cycle: Box<dyn MeshCycle + 'b> = match self.contact {
            MeshContact::LineOfAction { surface, teeth, tip_contact, sliced } => {
                self.on_line_of_action(flanks, surface, teeth, tip_contact, sliced)?
            }
            MeshContact::Simplified { material, teeth, sliced } => {
                return Ok(Box::new(self.simplified(flanks, modification_mm, material, teeth, sliced)?));
            }
            MeshContact::FiniteElements(model) => Box::new(CondensedCycle::new(model, flanks, count, line_load)),
        };
        Ok(Box::new(OnFlankPoints::new(cycle, modification_mm)))
    }

    /// The simplified model of a pair with slices.
    fn simplified<'b>(
        &'b self,
        flanks: Flanks<'b>,
        modification_mm: &PerGear<Vec<f64>>,
        material: &'b PerGear<Material>,
        teeth: &TeethSpring<'_>,
        sliced: &'b SlicedTeeth,
    ) -> Result<SimplifiedPair<'b>, SimulationError> {
        let (path, count, line_load) = (&self.pair.path, self.numerics.positions, self.line_load_n_per_mm);
        let springs = Springs {
            pair: self.pair,
            material,
            along_path: SpringAlongPath::new(path, count, |at| teeth.own_n_per_mm2(at))?,
            sliced,
            line_load_n_per_mm: line_load * sliced.slices.count() as f64,
        };
        let phases = phases(path, &sliced.slices, count, None);
        let bodies_mm = teeth.shared_mm2_per_n() * line_load;
        Ok(SimplifiedPair::new(springs, phases, flanks.grid, modification_mm, count, bodies_mm))
    }

    /// Springs on the line of action, at every loading position.
    fn on_line_of_action<'b>(
        &'b self,
        flanks: Flanks<'b>,
        surface: &'b dyn ContactSurface,
        teeth: &TeethSpring<'_>,
        tip_contact: bool,
        sliced: Option<&'b SlicedTeeth>,
    ) -> Result<Box<dyn MeshCycle + 'b>, SimulationError> {
        let line_load = self.line_load_n_per_mm;
        let (path, count) = (&self.pair.path, self.numerics.positions);
        let spring = |at| teeth.own_n_per_mm2(at);
        let bodies = teeth.shared_mm2_per_n() * line_load;
        let lever_ratio = |at| tip_contact::lever_ratio(self.pair, at);
        let beyond = if tip_contact {
            let pitch_point = path.pitch_point_mm;
            let surfaces = surface.plain_approach_mm(self.pair, pitch_point, line_load);
            let approach = bodies + surfaces + line_load / spring(pitch_point)?;
            Some(tip_contact::reach_mm(self.pair, AMPLE_APPROACH * approach))
        } else {
            None
        };
        if let Some(sliced) = sliced {
            let along = SpringAlongPath::new(path, count, spring)?;
            let phases = phases(path, &sliced.slices, count, beyond);
            let springs = SliceSprings { along_path: &along, lever_ratio: &lever_ratio };
            let cycle = SlicedCycle::new(flanks, surface, sliced, &phases, &springs, path, count, line_load);
            return Ok(Box::new(cycle.on_bodies_that_yield_by(bodies)));
        }
        let positions = match beyond {
            Some(beyond) => positions_with_tip_contact(path, count, beyond, lever_ratio, spring)?,
            None => loading_positions(path, count, spring)?,
        };
        let cycle = WorkingCycle::new(flanks, surface, &positions, line_load);
        Ok(Box::new(cycle.on_bodies_that_yield_by(bodies)))
    }
}
