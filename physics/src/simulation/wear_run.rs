//! The wear run: from the unworn pair through all phases of its operation.
//!
//! One evaluation of the mesh cycle on the flanks as they are gives the depth each point loses per mesh; [`super::advance`] takes
//! the flanks from there to where they are evaluated next. Snapshots and ends of phases are hit exactly. A phase begins with the
//! flanks that the one before has worn. Where a limit ends the life of the pair ([`super::life`]), the run ends there.
//!
//! Source: the thesis, equation 12 (single-point observation, section 3.3).

use super::advance::{self, Stepper, Stretch};
use super::checkpoint::{Checkpoint, Keeper, NothingKept};
use super::life::{LimitReached, LimitsOfPair, StepBeginning};
use super::mesh_contact::{LoadedMesh, MeshContact};
use super::settings::{LifeLimits, Numerics, Stepping, first_greatest};
use crate::contact::Flanks;
use crate::gear::{
    Gear, GearPair, PerGear, flank::FlankGrid, flank_zones::FlankZones, removed_material::modifications_mm,
    slices::Slices,
};
use crate::mesh_cycle::wearing_pair::{Snapshot, WearingPair};
use crate::mesh_cycle::{Work, load_sharing::EquilibriumError};
use crate::observer::Observer;
use crate::results::run::StopReason;
use crate::stiffness::StiffnessError;
use crate::wear::{WearModel, stepping::adaptive::StepCounts};

/// Up to this part of the module, wear on the stiffness of unworn teeth was measured to be within 6 % of that by finite elements, and that stiffness
/// within 3 % of the worn tooth's (`docs/materials.md`).
pub const SMALL_WEAR_MODULES: f64 = 0.2;

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
    /// More is worn off than there is.
    #[error(
        "worn through after {revolutions:.4e} pinion revolutions: with one more mesh a flank of the {} has lost {depth_mm:.3e} mm, and its \
         tooth is {thickness_mm:.3} mm thick there; look at the wear coefficient and the duration",
        gear.name()
    )]
    WornThrough {
        /// How far the run had come.
        revolutions: f64,
        /// Whose flank.
        gear: Gear,
        /// Its wear where there is least left.
        depth_mm: f64,
        /// Transverse thickness of its unworn teeth there, at least half a module.
        thickness_mm: f64,
    },
    /// A checkpoint with other rows or phases than the run has.
    #[error("the checkpoint is not of this run")]
    OtherRun,
}

/// A stretch of the run under constant load and speed.
#[derive(Clone, Copy)]
pub struct RunPhase<'a> {
    /// How the gears touch and yield.
    pub contact: MeshContact<'a>,
    /// How they wear.
    pub wear: WearModel<'a>,
    /// Whole load, N per mm of face width.
    pub line_load_n_per_mm: f64,
    /// When it ends, in pinion revolutions from the beginning of the run.
    pub end_revolutions: f64,
}

/// Everything a run is made of.
#[derive(Clone, Copy)]
pub struct WearRun<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// The parts of each flank that figures of its wear speak of.
    pub zones: PerGear<FlankZones>,
    /// What they go through: one phase at least.
    pub phases: &'a [RunPhase<'a>],
    /// When the state is kept, in pinion revolutions; the end of the run is always kept.
    pub snapshots_revolutions: &'a [f64],
    /// What ends it before its time.
    pub limits: LifeLimits,
    /// How finely.
    pub numerics: Numerics,
}

/// What a run found.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Why it ended.
    pub stop: StopReason,
    /// The limit that ended it.
    pub limit_reached: Option<LimitReached>,
    /// What went wrong where it did not converge.
    pub failure: Option<SimulationError>,
    /// The points of each flank, the same in every slice.
    pub grid: PerGear<FlankGrid>,
    /// The parts of each flank that figures of its wear speak of.
    pub zones: PerGear<FlankZones>,
    /// The slices over the face width: one where all sections are alike.
    pub slices: Slices,
    /// Material removed by the modifications, slice after slice as all fields of a flank.
    pub modification_mm: PerGear<Vec<f64>>,
    /// The unworn pair, under the greatest load of any phase.
    pub new: Snapshot,
    /// The pair at each snapshot reached, in order; where the run was interrupted, also at that moment.
    pub snapshots: Vec<Snapshot>,
    /// The pair when the run ended: the last of the snapshots, but under the load that `new` is under.
    pub worn: Snapshot,
    /// Index of the phase of that load. Where the worn pair finds no equilibrium under it, `worn` is under that of its own phase.
    pub reference_phase: usize,
    /// Wear steps taken, and what else came of them.
    pub steps: StepCounts,
    /// Of adaptive steps: the estimated error of each gear's wear at the place where it is greatest, mm.
    pub step_error_mm: Option<PerGear<f64>>,
    /// Work done in all.
    pub work: Work,
}

/// Both flanks before the first mesh.
pub(super) struct UnwornFlanks {
    pub grid: PerGear<FlankGrid>,
    pub slices: Slices,
    pub modification_mm: PerGear<Vec<f64>>,
    /// Wear that is as deep as the tooth is thick, at every point of the grid.
    thickness_mm: PerGear<Vec<f64>>,
}

/// A run on its way.
struct RunState {
    /// Number of its phase.
    phase: usize,
    revolutions: f64,
    stepper: Stepper,
    work: Work,
    /// The unworn pair first, then each snapshot.
    states: Vec<Snapshot>,
    /// What the flanks have lost, where they are not new.
    wear_mm: Option<PerGear<Vec<f64>>>,
    /// What they had lost, place by place, at the last of the states; none before the first and after a checkpoint.
    wear_of_last_state_mm: Option<PerGear<Vec<f64>>>,
    /// How many of the snapshots asked for were due so far.
    passed: usize,
    /// The limit that it has come to.
    limit_reached: Option<LimitReached>,
    /// Whether it goes on from a checkpoint: its state is evaluated once more, but its work and its snapshot are already there.
    is_repeated: bool,
}

/// How a phase ended.
enum PhaseEnd {
    /// Where it should.
    Reached,
    /// The whole run ended there, or was interrupted.
    Stopped,
    /// In failure, after something was finished.
    Failed(SimulationError),
}

/// Whoever looks on while a run runs.
#[derive(Clone, Copy)]
struct Attendants<'a> {
    keeper: &'a dyn Keeper,
    progress: &'a dyn Observer,
}

impl WearRun<'_> {
    /// Runs the whole duration, or until interrupted.
    pub fn run(&self, progress: &dyn Observer) -> Result<Outcome, SimulationError> {
        self.run_from(None, &NothingKept, progress)
    }

    /// The same from a checkpoint of this same run on, to the same bits; `keeper` gets new ones.
    pub fn run_from(
        &self,
        checkpoint: Option<Checkpoint>,
        keeper: &dyn Keeper,
        progress: &dyn Observer,
    ) -> Result<Outcome, SimulationError> {
        let slices = self.phases.first().map_or_else(|| Slices::new(self.pair, 1), |one| one.contact.slices(self.pair));
        let flanks = self.unworn_flanks(slices);
        let mut run_state = match checkpoint {
            None => self.beginning(),
            Some(checkpoint) if checkpoint.fits(flanks.modification_mm.as_ref().map(Vec::len)) => {
                self.resumed(checkpoint)?
            }
            Some(_) => return Err(SimulationError::OtherRun),
        };
        let mut failure = None;
        while run_state.phase < self.phases.len() {
            let phase = &self.phases[run_state.phase];
            let mut pair = self.wearing_pair(phase, &flanks)?;
            match self.through_phase(&mut run_state, &mut *pair, &flanks, Attendants { keeper, progress })? {
                PhaseEnd::Reached => run_state.wear_mm = Some(pair.wear_mm()),
                PhaseEnd::Stopped => break,
                PhaseEnd::Failed(error) => {
                    failure = Some(error);
                    break;
                }
            }
            run_state.phase += 1;
        }
        let stop = match &failure {
            Some(SimulationError::WornThrough { .. }) => StopReason::WornThrough,
            Some(_) => StopReason::NotConverged,
            None if run_state.limit_reached.is_some() => StopReason::LimitReached,
            None if self.due(run_state.passed).is_none() => StopReason::Completed,
            None => StopReason::Interrupted,
        };
        let (steps, step_error_mm) = (run_state.stepper.counts(), run_state.stepper.error_mm());
        let [new, worn] = self.new_and_worn(&mut run_state, &flanks)?;
        run_state.states.remove(0);
        let UnwornFlanks { grid, slices, modification_mm, .. } = flanks;
        Ok(Outcome {
            stop,
            limit_reached: run_state.limit_reached.filter(|_| stop == StopReason::LimitReached),
            failure,
            grid,
            zones: self.zones,
            slices,
            modification_mm,
            new,
            snapshots: run_state.states,
            worn,
            reference_phase: reference_phase(self.phases),
            steps,
            step_error_mm,
            work: run_state.work,
        })
    }

    /// The first and the last of the states under the load of the reference phase, where that finds an equilibrium.
    fn new_and_worn(&self, run_state: &mut RunState, flanks: &UnwornFlanks) -> Result<[Snapshot; 2], SimulationError> {
        let reference = reference_phase(self.phases);
        let last_phase = run_state.phase.min(self.phases.len() - 1);
        let last_wear_mm = run_state.wear_of_last_state_mm.take();
        let RunState { states, work, .. } = run_state;
        let mut under_reference = |own: &Snapshot, phase: usize, wear_mm: Option<&PerGear<Vec<f64>>>| {
            if phase == reference {
                return Ok(own.clone());
            }
            let mut pair = self.wearing_pair(&self.phases[reference], flanks)?;
            if let Some(wear_mm) =
                wear_mm.filter(|wear_mm| wear_mm.as_ref().map(Vec::len) == pair.wear_mm().map(|row| row.len()))
            {
                pair.set_wear_mm(wear_mm);
            }
            let evaluated = pair.evaluate(&self.phases[reference].wear, &|| false);
            let state = evaluated.and_then(|done| {
                *work += done;
                pair.snapshot(own.revolutions)
            });
            Ok::<_, SimulationError>(state.unwrap_or_else(|_| own.clone()))
        };
        let (first, last) = (&states[0], &states[states.len() - 1]);
        let new = under_reference(first, 0, None)?;
        let worn = match (states.len(), last_wear_mm) {
            (1, _) => new.clone(),
            (_, None) => last.clone(),
            (_, Some(wear_mm)) => under_reference(last, last_phase, Some(&wear_mm))?,
        };
        Ok([new, worn])
    }

    /// The flanks as they are made, in these slices.
    pub(super) fn unworn_flanks(&self, slices: Slices) -> UnwornFlanks {
        let grid = PerGear::from_fn(|gear| {
            FlankGrid::new(self.pair, gear, self.numerics.flank_points, self.numerics.point_spacing)
        });
        let modification_mm = PerGear::from_fn(|gear| modifications_mm(self.pair, gear, &grid[gear], &slices));
        let thickness_mm = PerGear::from_fn(|gear| thickness_mm(self.pair, gear, &grid[gear]));
        UnwornFlanks { grid, slices, modification_mm, thickness_mm }
    }

    /// The pair under the load of `phase`.
    pub(super) fn wearing_pair<'b>(
        &'b self,
        phase: &RunPhase<'b>,
        flanks: &'b UnwornFlanks,
    ) -> Result<Box<dyn WearingPair + 'b>, SimulationError> {
        let mesh = LoadedMesh {
            pair: self.pair,
            contact: phase.contact,
            line_load_n_per_mm: phase.line_load_n_per_mm,
            numerics: self.numerics,
            zones: self.zones,
        };
        Ok(mesh.wearing_pair(Flanks::of_gears(self.pair, flanks.grid.as_ref()), &flanks.modification_mm)?)
    }

    /// A run that has not begun.
    fn beginning(&self) -> RunState {
        RunState {
            phase: 0,
            revolutions: 0.0,
            stepper: Stepper::new(
                self.numerics.stepping,
                self.end_revolutions(),
                self.pair.wheel_turns_per_pinion_turn(),
            ),
            work: Work::default(),
            states: Vec::new(),
            wear_mm: None,
            wear_of_last_state_mm: None,
            passed: 0,
            limit_reached: None,
            is_repeated: false,
        }
    }

    /// A run that goes on.
    fn resumed(&self, from: Checkpoint) -> Result<RunState, SimulationError> {
        let mut run_state = RunState {
            phase: from.phase,
            revolutions: from.revolutions,
            work: from.work,
            states: from.states,
            is_repeated: true,
            ..self.beginning()
        };
        let is_within = from.phase < self.phases.len() && (0.0..self.end_revolutions()).contains(&from.revolutions);
        if !is_within || !run_state.stepper.resume(from.stepper, &from.wear_mm) {
            return Err(SimulationError::OtherRun);
        }
        run_state.wear_mm = Some(from.wear_mm);
        self.pass_due(&mut run_state);
        Ok(run_state)
    }

    fn end_revolutions(&self) -> f64 {
        self.phases.last().map_or(0.0, |phase| phase.end_revolutions)
    }

    /// The first snapshot that is asked for after the first `passed` of them; the last is the end of the run.
    fn due(&self, passed: usize) -> Option<f64> {
        let end = self.end_revolutions();
        self.snapshots_revolutions.iter().copied().chain([end]).nth(passed)
    }

    /// Passes over the snapshots that are reached.
    fn pass_due(&self, run_state: &mut RunState) {
        while self.due(run_state.passed).is_some_and(|next| next <= run_state.revolutions) {
            run_state.passed += 1;
        }
    }

    /// What is wrong where `pair`, which is evaluated, has lost the thickness of a tooth, or will have with one more mesh.
    fn worn_through(
        pair: &dyn WearingPair,
        thickness_mm: &PerGear<Vec<f64>>,
        revolutions: f64,
    ) -> Option<SimulationError> {
        let wear_mm = pair.wear_mm();
        let mut next_mm = wear_mm.clone();
        pair.depth_mm(&mut next_mm);
        Gear::BOTH.into_iter().find_map(|gear| {
            let depths_mm = wear_mm[gear].iter().zip(&next_mm[gear]).map(|(worn, next)| worn + next);
            let points = depths_mm.zip(thickness_mm[gear].iter().cycle());
            let (depth_mm, &thickness_mm) = points.max_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)))?;
            (depth_mm >= thickness_mm).then_some(SimulationError::WornThrough {
                revolutions,
                gear,
                depth_mm,
                thickness_mm,
            })
        })
    }

    /// Runs to the end of the phase that `run_state` is in.
    ///
    /// # Errors
    /// [`SimulationError`] before anything is finished.
    fn through_phase(
        &self,
        run_state: &mut RunState,
        pair: &mut dyn WearingPair,
        flanks: &UnwornFlanks,
        Attendants { keeper, progress }: Attendants<'_>,
    ) -> Result<PhaseEnd, SimulationError> {
        let phase = &self.phases[run_state.phase];
        let stopped: &(dyn Fn() -> bool + Sync) = &|| progress.gives_up();
        if let Some(wear_mm) = &run_state.wear_mm {
            if wear_mm.as_ref().map(Vec::len) != pair.wear_mm().map(|row| row.len()) {
                return Err(SimulationError::OtherRun);
            }
            pair.set_wear_mm(wear_mm);
        }
        let mut evaluated = pair.evaluate(&phase.wear, stopped);
        if std::mem::take(&mut run_state.is_repeated) {
            evaluated = evaluated.map(|_| Work::default());
        } else {
            run_state.stepper.begin_phase();
        }
        // A phase begins with a pair made anew, which is a clean start.
        let (mut is_clean, mut cleaned_at) = (true, 0);
        let clean_after = phase.contact.evaluations_between_clean_starts(self.numerics.positions);
        loop {
            let revolutions = run_state.revolutions;
            let is_due = self.due(run_state.passed).is_some_and(|next| revolutions >= next);
            let interrupted = progress.interrupted();
            let ends = run_state.limit_reached.is_some();
            let worn_through =
                evaluated.is_ok().then(|| Self::worn_through(pair, &flanks.thickness_mm, revolutions)).flatten();
            let keep = run_state.states.is_empty() || (worn_through.is_none() && (is_due || interrupted || ends));
            let state = evaluated.and_then(|done| {
                run_state.work += done;
                keep.then(|| pair.snapshot(revolutions)).transpose()
            });
            match state {
                Ok(Some(state)) => {
                    run_state.states.push(state);
                    run_state.wear_of_last_state_mm = Some(pair.wear_mm());
                }
                Ok(None) => {}
                // Before anything is finished there is nothing to keep.
                Err(source) if run_state.states.is_empty() => {
                    return Err(SimulationError::Equilibrium { revolutions, source });
                }
                Err(EquilibriumError::Interrupted) => return Ok(PhaseEnd::Stopped),
                Err(source) => return Ok(PhaseEnd::Failed(SimulationError::Equilibrium { revolutions, source })),
            }
            if let Some(worn_through) = worn_through {
                return Ok(PhaseEnd::Failed(worn_through));
            }
            self.pass_due(run_state);
            progress.progress(revolutions, self.end_revolutions());
            let Some(next) = self.due(run_state.passed).filter(|_| !interrupted && !ends) else {
                return Ok(PhaseEnd::Stopped);
            };
            if revolutions >= phase.end_revolutions {
                return Ok(PhaseEnd::Reached);
            }
            if is_clean {
                cleaned_at = run_state.work.mesh_cycles;
                if revolutions > 0.0 && keeper.is_due() {
                    keeper.keep(&run_state.checkpoint(pair.wear_mm()));
                }
            }
            is_clean = run_state.work.mesh_cycles - cleaned_at >= clean_after;
            let limit = next.min(phase.end_revolutions);
            let stretch = Stretch { from: revolutions, limit, clean_start: is_clean };
            let beginning = self.limits.are_set().then(|| StepBeginning::of(pair, revolutions));
            let advanced = run_state.stepper.advance(pair, &phase.wear, stretch, stopped);
            (run_state.revolutions, evaluated) = (advanced.revolutions, advanced.evaluated);
            // A step that was taken may have passed a limit, even if there is no equilibrium at its end.
            let is_taken = run_state.revolutions > revolutions && evaluated != Err(EquilibriumError::Interrupted);
            if let Some(beginning) = beginning.filter(|_| is_taken) {
                let smooth = matches!(self.numerics.stepping, Stepping::Adaptive { .. });
                let limits =
                    LimitsOfPair { limits: self.limits, pair: self.pair, grid: &flanks.grid, zones: &self.zones };
                if let Some(within) = beginning.limit_within(&limits, pair, run_state.revolutions, smooth) {
                    run_state.work += evaluated.unwrap_or_default();
                    run_state.revolutions = within.revolutions;
                    evaluated = advance::evaluate(pair, &phase.wear, stopped);
                    run_state.limit_reached = evaluated.is_ok().then_some(within.reached);
                }
            }
        }
    }
}

/// Transverse thickness of a tooth at every point of its flank; near a pointed tip half a module.
fn thickness_mm(pair: &GearPair, gear: Gear, grid: &FlankGrid) -> Vec<f64> {
    let tooth = &pair.teeth[gear];
    let at = |&rho: &f64| tooth.thickness_mm(tooth.involute.radius_mm(rho)).max(0.5 * pair.spec.normal_module_mm);
    grid.coordinate_mm.iter().map(at).collect()
}

/// Index of the phase of the greatest load, the first of equals: what is said of the new and of the worn pair is under that load.
pub fn reference_phase(phases: &[RunPhase<'_>]) -> usize {
    first_greatest(phases.iter().map(|phase| phase.line_load_n_per_mm))
}

impl RunState {
    /// The run as it is, on flanks that have lost `wear_mm`.
    fn checkpoint(&self, wear_mm: PerGear<Vec<f64>>) -> Checkpoint {
        Checkpoint {
            phase: self.phase,
            revolutions: self.revolutions,
            wear_mm,
            stepper: self.stepper.state(),
            work: self.work,
            states: self.states.clone(),
        }
    }
}
