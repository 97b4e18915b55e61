//! The wear run of a spur pair: explicit Euler over revolutions of the pinion.
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
use crate::contact::{ContactSurface, Flanks};
use crate::fem::gear::position::CondensedPair;
use crate::gear::{Gear, GearPair, PerGear, flank::FlankGrid, removed_material::modifications_mm};
use crate::stiffness::{StiffnessError, TeethSpring};
use crate::wear::WearLaw;
use crate::working_cycle::{
    CycleObservation, LostMaterial, MeshCycle, Work, WorkingCycle,
    condensed::CondensedCycle,
    load_sharing::EquilibriumError,
    positions::{loading_positions, positions_with_tip_contact},
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
    },
    /// Both gears as finite elements, condensed onto their flanks.
    FiniteElements(&'a CondensedPair<'a>),
}

/// State kept at a snapshot.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Pinion revolutions so far.
    pub revolutions: f64,
    /// Wear depth of each flank point.
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
    /// The points of each flank.
    pub grid: PerGear<FlankGrid>,
    /// Material removed by the modifications.
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
        let grid = PerGear::from_fn(|gear| FlankGrid::new(self.pair, gear, self.numerics.flank_points));
        let modification_mm = PerGear::from_fn(|gear| modifications_mm(self.pair, gear, &grid[gear]));
        let flanks = Flanks { geometry: self.pair, grid: grid.as_ref() };
        let stopped: &(dyn Fn() -> bool + Sync) = &|| progress.gives_up();
        let mut cycle = self.mesh_cycle(flanks)?;

        let end = self.operation.pinion_revolutions;
        let meshes_per_turn = PerGear { pinion: 1.0, wheel: self.pair.wheel_turns_per_pinion_turn() };
        let mut due = self.operation.snapshots_revolutions.iter().copied().chain([end]).peekable();
        let mut removed_mm = modification_mm.clone();
        let mut wear_mm = PerGear::from_fn(|gear| vec![0.0; grid[gear].len()]);
        let mut depth_mm = wear_mm.clone();
        let (mut revolutions, mut wear_steps, mut work) = (0.0, 0, Work::default());
        // The unworn pair first, then each snapshot.
        let mut states: Vec<Snapshot> = Vec::new();

        let mut failure = None;
        loop {
            let lost = LostMaterial {
                removed_mm: removed_mm.as_ref().map(Vec::as_slice),
                wear_mm: wear_mm.as_ref().map(Vec::as_slice),
            };
            match cycle.evaluate(lost, self.law, &mut depth_mm, stopped) {
                Ok(done) => work += done,
                // Before anything is finished there is nothing to keep.
                Err(source) if states.is_empty() => return Err(SimulationError::Equilibrium { revolutions, source }),
                Err(EquilibriumError::Interrupted) => break,
                Err(source) => {
                    failure = Some(SimulationError::Equilibrium { revolutions, source });
                    break;
                }
            }
            let is_due = due.peek().is_some_and(|&next| revolutions >= next);
            let interrupted = progress.interrupted();
            if states.is_empty() || is_due || interrupted {
                let cycle = match cycle.observe(lost) {
                    Ok(cycle) => cycle,
                    Err(source) if states.is_empty() => {
                        return Err(SimulationError::Equilibrium { revolutions, source });
                    }
                    Err(source) => {
                        failure = Some(SimulationError::Equilibrium { revolutions, source });
                        break;
                    }
                };
                states.push(Snapshot {
                    revolutions,
                    wear_mm: wear_mm.clone(),
                    depth_per_mesh_mm: depth_mm.clone(),
                    cycle,
                });
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
            for gear in Gear::BOTH {
                let meshes = step * meshes_per_turn[gear];
                let points = wear_mm[gear].iter_mut().zip(&mut removed_mm[gear]);
                for ((wear, removed), (depth, modification)) in
                    points.zip(depth_mm[gear].iter().zip(&modification_mm[gear]))
                {
                    *wear += meshes * depth;
                    *removed = modification + *wear;
                }
            }
        }
        drop(cycle);
        let stop = match &failure {
            Some(_) => StopReason::NotConverged,
            None if due.peek().is_none() => StopReason::Completed,
            None => StopReason::Interrupted,
        };
        let new = states.remove(0);
        let worn = states.last().unwrap_or(&new).clone();
        Ok(Outcome { stop, failure, grid, modification_mm, new, snapshots: states, worn, wear_steps, work })
    }

    /// The pair in mesh at every loading position.
    fn mesh_cycle<'b>(&'b self, flanks: Flanks<'b>) -> Result<Box<dyn MeshCycle + 'b>, SimulationError> {
        match self.contact {
            MeshContact::LineOfAction { surface, teeth, tip_contact } => {
                let (path, count) = (&self.pair.path, self.numerics.positions);
                let spring = |at| teeth.own_n_per_mm2(at);
                let bodies = teeth.shared_mm2_per_n() * self.line_load_n_per_mm;
                let positions = if tip_contact {
                    let pitch_point = path.pitch_point_mm;
                    let surfaces = surface.plain_approach_mm(self.pair, pitch_point, self.line_load_n_per_mm);
                    let approach = bodies + surfaces + self.line_load_n_per_mm / spring(pitch_point)?;
                    let beyond = tip_contact::reach_mm(self.pair, AMPLE_APPROACH * approach);
                    let lever_ratio = |at| tip_contact::lever_ratio(self.pair, at);
                    positions_with_tip_contact(path, count, beyond, lever_ratio, spring)?
                } else {
                    loading_positions(path, count, spring)?
                };
                let cycle = WorkingCycle::new(flanks, surface, &positions, self.line_load_n_per_mm);
                Ok(Box::new(cycle.on_bodies_that_yield_by(bodies)))
            }
            MeshContact::FiniteElements(model) => {
                let positions = self.numerics.positions;
                Ok(Box::new(CondensedCycle::new(model, flanks, positions, self.line_load_n_per_mm)))
            }
        }
    }
}
